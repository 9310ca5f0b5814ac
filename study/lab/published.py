"""published.py LIBRARY MEASURED.csv [csv], which `carom-lab published` runs: values that others
measured or stated, compared with those that carom computes.

The columns of a row end with the verdict that is wanted, and with the name in COMPUTED of the
function that computes carom's value; "-" where nothing of carom can be compared, which the
conditions explain. A row without bounds is printed and not judged.
"""

import csv
import ctypes
import sys
from functools import cache, partial
from math import atan2, cos, degrees, exp, hypot, inf, isnan, nan, radians, sin, sqrt, tan
from pathlib import Path
from random import Random
from statistics import median

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bindings"))
import api  # noqa: E402

# ---- The library, by ctypes


def types():
    """{name: type} of what the headers declare."""
    found = {name: getattr(ctypes, f"c_{name.removesuffix('_t')}") for name in api.SIZES}
    for declaration in api.types(api.describe(ROOT / "core/include")):
        fields = []
        for field in declaration.get("fields", ()):
            kind = (
                ctypes.c_void_p if field.get("pointer") else found.get(field["type"], ctypes.c_int)
            )
            for length in reversed(field.get("array", [])):
                kind *= length
            fields.append((field["name"], kind))
        found[declaration["name"]] = (
            type(declaration["name"], (ctypes.Structure,), {"_fields_": fields})
            if fields
            else ctypes.c_int
        )
        globals().update(
            {
                value["name"].removeprefix("CAROM_"): value["value"]
                for value in declaration.get("values", ())
            }
        )
    return found


LIBRARY, OF = ctypes.CDLL(sys.argv[1]), types()
Triple = ctypes.c_double * 3
for name, kind in {
    "ball_kind_of": "carom_ball_kind",
    "cue_of": "carom_cue",
    "alciatore": "carom_speed_law",
    "mu_ball": "double",
}.items():
    getattr(LIBRARY, f"carom_{name}").restype = OF[kind]
reference = ctypes.byref


@cache
def ball(game=0):
    return LIBRARY.carom_ball_kind_of(game)


@cache
def cue(game=0):
    return LIBRARY.carom_cue_of(game)


@cache
def table(kind):
    shape = OF["carom_table"]()
    LIBRARY.carom_table_make(kind, reference(shape))
    return shape


# What all balls have instead of the numbers of their game, and the model of the cushion that they
# meet; 0 is the default. study/lab/cushions.py plays on other tables by these.
PLAYED_ON = {}
CUSHION_MODEL = [0]


def shot_ball(r, v=(0, 0, 0), w=(0, 0, 0), game=0, **numbers):
    placed_ball = OF["carom_shot_ball"](ball(game), (Triple(*r), Triple(*v), Triple(*w)))
    for name, value in (PLAYED_ON | numbers).items():
        setattr(placed_ball.kind, name, value)
    return placed_ball


def shoot(kind, balls, stroke=None, room=100):
    """The events of a shot on a table or on one of a kind, its facts, and where the first ball
    ends.
    """
    table_shape = table(kind) if isinstance(kind, int) else kind
    events, facts, final = (
        (OF["carom_event"] * room)(),
        OF["carom_facts"](),
        (OF["carom_ball_state"] * len(balls))(),
    )
    shot = OF["carom_shot"](room=room)
    shot.events, shot.facts, shot.final = (
        ctypes.cast(output, ctypes.c_void_p) for output in (events, reference(facts), final)
    )
    options = OF["carom_shot_options"](cushion_model=CUSHION_MODEL[0])
    LIBRARY.carom_shoot(
        reference(table_shape),
        (OF["carom_shot_ball"] * len(balls))(*balls),
        len(balls),
        reference(stroke) if stroke else None,
        reference(options) if CUSHION_MODEL[0] else None,
        reference(shot),
    )
    return events[: min(shot.count, room)], facts, final[0].r


def angle(v):
    return degrees(atan2(v[0], v[1]))


def marlow(slip):
    law = LIBRARY.carom_alciatore()
    return law.a + law.b * exp(-law.c * slip)


def friction_of(game, slip):
    return ball(game).law_a + ball(game).law_b * exp(-ball(game).law_c * slip)


# ---- Two balls of pool: cut in degrees, speed, fraction of rolling, friction (0: Alciatore's),
# side spin R w_z / v


def hit(cut, speed, roll=0, friction=0, side=0):
    R, v = ball().radius, (speed * sin(radians(cut)), speed * cos(radians(cut)))
    w = (-roll * v[1] / R, roll * v[0] / R, side * speed / R)
    numbers_of_ball = (R, ball().mass, ball().mu_slide)
    pair = OF["carom_impact"](
        (Triple(), Triple(*v, 0), Triple(*w), *numbers_of_ball),
        (Triple(0, 2 * R, 0), Triple(), Triple(), *numbers_of_ball),
        friction,
        ball().restitution,
    )
    if friction == 0:
        pair.mu_ball = LIBRARY.carom_mu_ball(reference(pair), LIBRARY.carom_alciatore())
    out = OF["carom_result"]()
    LIBRARY.carom_collide(reference(pair), None, reference(out))
    return out.a, out.b


def throw(*numbers):
    """degrees from the line of centres, along which the ball would go without friction"""
    return abs(angle(hit(*numbers)[1].v))


def speeds(*numbers):
    return [hypot(*motion.v[:2]) for motion in hit(*numbers)]


def rolling(motion):
    v = Triple()
    LIBRARY.carom_rolling_velocity(motion.v, motion.w, ctypes.c_double(ball().radius), v)
    return v


def deflection(cut, *numbers):
    """degrees from the path before to the path once the ball rolls"""
    return angle(rolling(hit(cut, *numbers)[0])) - cut


def found(function, low, high, value):
    """Where a function between two numbers has a value."""
    rises = function(high) > function(low)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if (function(middle) > value) == rises else (middle, high)
    return 0.5 * (low + high)


def draw_angle(cut, speed):
    """between the path to the ball and the path back, with the draw that turns that of a half-ball
    hit by 90 degrees
    """
    return 180 - deflection(cut, speed, found(lambda roll: deflection(30, speed, roll), -2, 0, 90))


def gearing(cut, speed, roll):
    """the offset of the tip at which nothing is thrown, over that of the point of contact"""
    return (
        found(lambda side: hit(cut, speed, roll, 0, side)[1].v[0], -1.25, 1.25, 0)
        / 2.5
        / sin(radians(cut))
    )


def throw_most(speed):
    """the cut at which the throw is greatest"""
    return max((throw(0.5 * k, speed), 0.5 * k) for k in range(2, 179))[1]


def distance_ratio(*numbers):
    """of the object ball over the cue ball: of the distances that they roll, which grow with the
    square of the speed
    """
    a, b = (hypot(*rolling(motion)) for motion in hit(*numbers))
    return (b / a) ** 2


def kiss_share(angle, speed):
    """of the first of two frozen balls: how far from the kiss line to the line of centres its path
    lies, by tangents; a third ball drives it
    """
    R, along, across = ball().radius, sin(radians(angle)), cos(radians(angle))
    balls = (
        shot_ball((0, 0, R)),
        shot_ball((2 * R, 0, R)),
        shot_ball((-2 * R * along, -2 * R * across, R), (speed * along, speed * across, 0)),
    )
    out = (OF["carom_motion"] * 3)()
    LIBRARY.carom_cluster((OF["carom_shot_ball"] * 3)(*balls), 3, None, out, None, 0, None)
    return out[0].v[0] / out[0].v[1] / tan(radians(angle))


# ---- Strikes of pool: the butt's elevation and direction in degrees, the cue's speed, the tip's
# place, another ball, its friction (0: the law of pool), the cue's numbers


def strike(theta, speed, tip=(0, 0), object_place=None, friction=0, phi=90, **numbers):
    stroke, balls = (
        LIBRARY.carom_cue_of(GAME_POOL),
        [shot_ball(place) for place in [(0.635, 0.635, ball().radius), object_place] if place],
    )
    for name, value in dict(numbers, phi=phi, theta=theta, speed=speed, a=tip[0], b=tip[1]).items():
        setattr(stroke, name, value)
    for struck_ball in balls if friction else ():
        struck_ball.kind.law_a, struck_ball.kind.law_b = friction, 0
    return shoot(TABLE_POOL_9FT, balls, stroke)[0]


def struck(a, b):
    """The motion of a ball by a level cue whose tip touches it there, in R."""
    return strike(0, cue().speed, (a, b))[0].after[0]


def rise(ahead, *numbers, **of_cue):
    """mm, of a ball that hops, at a position ahead; 0: at its highest"""
    _, forward, up = strike(*numbers, **of_cue)[0].after[0].v
    time = ahead / forward or up / ball().gravity
    return 1e3 * time * (up - 0.5 * ball().gravity * time)


def in_the_air(*numbers):
    """the fraction of the time from the head spot to a ball on the foot spot, %"""
    events = strike(*numbers, object_place=(0.635, 1.905, ball().radius))
    impact_index = next(k for k, e in enumerate(events) if e.type == EVENT_BALL_BALL)
    return (
        100
        * sum(
            b.time - a.time
            for a, b in zip(events[:impact_index], events[1:])
            if a.after[0].v[2] > 0
        )
        / events[impact_index].time
    )


def inside(offset_angle, friction, speed):
    """how far the tip is from the centre where a frozen ball leaves in the direction of the cue,
    that angle off the line of centres, in R
    """

    def to_the_left(a):
        events = strike(
            0,
            speed,
            (-a, 0),
            (0.635, 0.635 + 2 * ball().radius, ball().radius),
            friction,
            90 + offset_angle,
        )
        impact = next(e for e in events if e.type == EVENT_BALL_BALL)
        return -angle(impact.after[(impact.a, impact.b).index(1)].v)

    return found(to_the_left, 0, 0.5, offset_angle)


# ---- Cushions and slate


# Of the table that was played on in 2017, by a fit of 21 shots; that of 2022 has those of the game.
MATCH_2017 = {
    "restitution_cushion": 0.753,
    "mu_cushion": 0.238,
    "mu_slide": 0.203,
    "mu_roll": 0.0045,
    "drag": 0.0126,
}


def rebound(game, speed, **numbers):
    """of a ball that rolls into a rail, full on: once to find where it meets the rail, and once
    from just before it
    """
    kind, R, x = (TABLE_POOL_9FT, TABLE_SNOOKER, TABLE_THREECUSHION)[game], ball(game).radius, 0.5
    for _ in range(2):
        events, _, _ = shoot(
            kind, [shot_ball((x, 0.7, R), (-speed, 0, 0), (0, -speed / R, 0), game, **numbers)]
        )
        contact = next(e for e in events if e.type == EVENT_RAIL)
        x = contact.before[0].r[0] + 1e-6
    return -contact.after[0].v[0] / contact.before[0].v[0]


def lengths_of_travel(speed):
    """lengths of a 9 ft table that a ball goes from the head spot through the foot spot"""
    shape = table(TABLE_POOL_9FT)
    head_spot = 0.25 * shape.length
    events, _, _ = shoot(
        TABLE_POOL_9FT, [shot_ball((0.5 * shape.width, head_spot, ball().radius), (0, speed, 0))]
    )
    places = [head_spot] + [e.before[0].r[1] for e in events]
    return sum(abs(b - a) for a, b in zip(places, places[1:])) / shape.length


def diamond(kind, game, start, aim, speed, side, nth, **numbers):
    """How far beyond its aim a ball meets a rail, in diamonds: it rolls from one long rail to the
    other, with side spin R w_z / v to run on. Diamonds count from the end that it nears, 94 mm
    behind the noses. Of the rail `nth`, which is that from which it came.
    """
    shape, R, back, x = table(kind), ball(game).radius, 0.094, 0.3
    diamond_length, across = shape.length / 8, shape.width + 2 * back
    along = (start - aim) * diamond_length
    v = speed * across / hypot(across, along), speed * along / hypot(across, along)
    place = (x, shape.length - start * diamond_length + (x + back) * along / across, R)
    events, _, _ = shoot(
        kind, [shot_ball(place, (*v, 0), (-v[1] / R, v[0] / R, -side * speed / R), game, **numbers)]
    )
    contact = [e for e in events if e.type == EVENT_RAIL][nth - 1].before[0]
    return (
        (shape.length - contact.r[1] + (contact.r[0] + back) * contact.v[1] / contact.v[0])
        / diamond_length
        if contact.r[0] < 0.5 * shape.width
        else nan
    )


# ---- Systems of players, data/pool_systems.csv: sets P G V C F T. A diamond is an eighth of the
# length of the table. The ball starts on the long rail x = 0; sights lie `SIGHT` behind the noses.

SIGHT, MOST_OFF = 0.094, 1.5  # m; diamonds that a shot counts that does not arrive
ENGLISH = [0.25 + 0.15 * k for k in range(7)]  # R w / v, of what texts call one tip


@cache
def rows_of_systems():
    with open(Path(sys.argv[2]).parent / "pool_systems.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def flight(kind, place, direction, speed, roll, side, nth):
    """Place and velocity of a lone ball just before its contact number `nth` with a rail, a jaw or
    a pocket: it starts at a position in a direction, radians from +x, with side spin R w / v to the
    left. The speed is that of the 9 ft table. The texts say how hard a stroke is, not how fast, so
    on another table the ball goes as many lengths of that one: the speed has the root of the ratio.
    """
    R, x, y = ball().radius, cos(direction), sin(direction)
    speed *= sqrt(table(kind).length / table(TABLE_POOL_9FT).length)
    events, _, _ = shoot(
        kind,
        [
            shot_ball(
                (*place, R),
                (speed * x, speed * y, 0),
                (-roll * speed * y / R, roll * speed * x / R, side * speed / R),
            )
        ],
    )
    contacts = [e for e in events if e.type in (EVENT_RAIL, EVENT_JAW, EVENT_POCKET)]
    last_motion = contacts[nth - 1].before[0] if len(contacts) >= nth else None
    return (last_motion.r, last_motion.v) if last_motion else ((nan, nan), (nan, nan))


def place_at(motion, x):
    """How far along the table the line of a motion has this x, in m."""
    r, v = motion
    return r[1] + v[1] / v[0] * (x - r[0]) if v[0] else nan


def through(start, end, x):
    """The position on the line through two others that has this x, and the direction of the
    line."""
    way = (end[0] - start[0], end[1] - start[1])
    return (x, start[1] + way[1] * (x - start[0]) / way[0]), atan2(way[1], way[0])


def bank(kind, row, speed, side):
    """P: from a sight of the long rail to one of the other; read where it returns to the nose.
    F: the same along the grooves, and towards the corner at 0.
    """
    shape, groove = table(kind), row["set"] == "F"
    diamond_, back = shape.length / 8, -ball().radius if groove else SIGHT
    start, end = (-back, row["start"] * diamond_), (shape.width + back, row["aim"] * diamond_)
    if row["set"] == "P" and row["start"] == 0:
        start = (-back, -back)
    length = hypot(end[0] - start[0], end[1] - start[1])
    x = 0.35 if not groove else -back + 0.12 * (end[0] - start[0]) / length
    place, direction = through(start, end, x)
    return place_at(flight(kind, place, direction, speed, row["roll"], side, 2), 0) / diamond_


def two_rails(kind, row, speed, side):
    """G, V: from a sight of the long rail to one of the short rail y = 0, counted from the far
    corner; read through the sights of the first rail, which it meets third.
    """
    shape = table(kind)
    diamond_ = shape.length / 8
    start = (-SIGHT, row["start"] * diamond_)
    end = ((4 - row["aim"]) * diamond_, -SIGHT)
    place, direction = through(start, end, 0.06)
    motion = flight(kind, place, direction, speed, row["roll"], -side, 3)
    return place_at(motion, -SIGHT) / diamond_ if motion[0][0] < 0.05 else nan


def corner_five(kind, row, speed, side):
    """C: from an origin, 5 in the corner, to the first rail; read on the third, from the far end."""
    shape = table(kind)
    diamond_ = shape.length / 8
    start = (-SIGHT, (5 - row["start"]) * 2 * diamond_ if row["start"] < 5 else -SIGHT)
    end = (shape.width + SIGHT, (8 - row["aim"]) * diamond_)
    place, direction = through(start, end, 0.06)
    place = (place[0], max(place[1], ball().radius + 1e-4))
    motion = flight(kind, place, direction, speed, row["roll"], -side, 3)
    on_it = motion[0][0] < 0.05 and motion[1][0] < 0
    return 8 - place_at(motion, -SIGHT) / diamond_ if on_it else nan


ARRIVES = {"P": bank, "F": bank, "G": two_rails, "V": two_rails, "C": corner_five}


def mean_square(kind, of_set, side):
    """Of the errors of a set in diamonds, with this english."""
    squares = []
    for text in rows_of_systems():
        if text["set"] != of_set:
            continue
        row = {name: float(text[name]) for name in ("start", "aim", "arrives", "roll")}
        row["set"] = of_set
        for speed in text["speeds"].split():
            off = ARRIVES[of_set](kind, row, float(speed), side) - row["arrives"]
            squares.append(MOST_OFF**2 if isnan(off) else min(abs(off), MOST_OFF) ** 2)
    return sum(squares) / len(squares)


@cache
def system(of_set, kind=2):
    """The error of a set, rms in diamonds. A set with english has that which fits it best, between
    the points of a parabola.
    """
    if all(row["english"] == "0" for row in rows_of_systems() if row["set"] == of_set):
        return sqrt(mean_square(kind, of_set, 0))
    means = [mean_square(kind, of_set, side) for side in ENGLISH]
    k = min(range(len(means)), key=means.__getitem__)
    if not 0 < k < len(means) - 1:
        return sqrt(means[k])
    a, b, c = means[k - 1 : k + 2]
    shift = 0.5 * (a - c) / (a - 2 * b + c)
    return sqrt(mean_square(kind, of_set, ENGLISH[k] + shift * (ENGLISH[1] - ENGLISH[0])))


def systems(kind=2):
    """The error of all six sets: rms of those of each; T counts in diamonds of a crossing."""
    errors = [system(of_set, kind) for of_set in "PGVCF"]
    errors.append(sqrt(sum(tan(radians(a)) ** 2 for a in twice_across(kind)) / 3) * 4)
    return sqrt(sum(e * e for e in errors) / len(errors))


def twice_across(kind=2):
    """T: degrees from straight across after two, three and four rails."""
    row = next(row for row in rows_of_systems() if row["set"] == "T")
    direction = radians(float(row["start"]))
    motions = [
        flight(kind, (0.2, 0.15), direction, float(row["speeds"]), 0, 0, nth) for nth in (3, 4, 5)
    ]
    return [degrees(atan2(v[1], abs(v[0]))) for _, v in motions]


# ---- Pockets with the measures of Alciatore's TP 3.5 and TP 3.6, whose points are sharp


@cache
def pockets_of_tp():
    inch = 0.0254
    measures = OF["carom_measures"]()
    LIBRARY.carom_table_measures(TABLE_POOL_9FT, reference(measures))
    measures.corner_mouth, measures.corner_shelf, measures.corner_hole = (
        4.5875 * inch,
        1.125 * inch,
        2.75 * inch,
    )
    measures.side_mouth, measures.side_shelf, measures.side_hole = (
        5.0625 * inch,
        0.1875 * inch,
        3 * inch,
    )
    measures.corner_jaw = measures.side_jaw = 0.0005
    shape = OF["carom_table"]()
    LIBRARY.carom_table_measured(
        reference(measures), ctypes.c_double(ball().radius), reference(shape), None
    )
    return shape


def size(side_pocket, angle, speed, kind=None, step=0.001):
    """The width, mm, of the paths of a rolling ball that end in a pocket without another cushion
    farther than half a meter: at an angle to the rail of a corner, or to the line across the table.
    Paths lie `step` apart, m.
    """
    shape = kind if kind is not None else pockets_of_tp()
    shape = table(shape) if isinstance(shape, int) else shape
    R, away = ball().radius, 0.45
    middle = (0, 0.5 * shape.length) if side_pocket else (0, 0)
    along, across = cos(radians(angle)), sin(radians(angle))
    way = (-along, -across) if side_pocket else (-across, -along)
    fall = 0
    for k in range(-round(0.07 / step), round(0.07 / step) + 1):
        x = middle[0] - away * way[0] - k * step * way[1]
        y = middle[1] - away * way[1] + k * step * way[0]
        if min(x, y) <= R:
            continue
        events, _, _ = shoot(
            shape,
            [
                shot_ball(
                    (x, y, R),
                    (speed * way[0], speed * way[1], 0),
                    (-speed * way[1] / R, speed * way[0] / R, 0),
                )
            ],
            room=16,
        )
        for e in events:
            r = e.before[0].r
            if hypot(r[0] - middle[0], r[1] - middle[1]) > 0.6:
                break
            if e.type == EVENT_POCKET:
                fall += 1
                break
    return 1e3 * step * fall


def bounce(height):
    """how high a ball bounces on the slate, over the height from which it falls"""
    first = shoot(TABLE_POOL_9FT, [shot_ball((0.5, 0.7, ball().radius + height))])[0][0]
    return (first.after[0].v[2] / first.before[0].v[2]) ** 2 if first.type == EVENT_SLATE else nan


# ---- Breaks: the rack, the table, the gap in mm, how far the cue ball is off the long string,
# m, its speed, the tip above its centre in R. Values are pairs, with the standard error.

BREAKS = 1600


def back_of(events):
    """The velocity of the cue ball along the table once it has met the rack, over that before:
    contacts within a millisecond are one.
    """
    impacts = [
        (e, (e.a, e.b).index(0)) for e in events if e.type == EVENT_BALL_BALL and 0 in (e.a, e.b)
    ]
    last, cue_side = [impact for impact in impacts if impact[0].time <= impacts[0][0].time + 1e-3][
        -1
    ]
    return last.after[cue_side].v[1] / impacts[0][0].before[impacts[0][1]].v[1]


@cache
def breaks(rack, kind, gap, offset, speed, above=0):
    """Of each break: the positions of the balls that fell, in rows from the cue ball and from the
    left; what is counted; the cue ball's velocity back, and how far from the middle of the table it
    stops, m. The errors are those of a good player: 0.2 degrees, 3 % of the speed, 0.03 R.
    """
    count, shape, draw, all_of_them = LIBRARY.carom_rack_size(rack), table(kind), Random(1), []

    def normal(deviation):
        return deviation * (sum(draw.random() for _ in range(12)) - 6)

    for k in range(BREAKS):
        balls = (OF["carom_shot_ball"] * count)()
        LIBRARY.carom_rack(
            rack, reference(shape), ctypes.c_double(1e-3 * gap), ctypes.c_uint64(k), balls, count
        )
        balls[0].state.r[0], balls[0].state.r[1] = 0.5 * shape.width + offset, 0.25 * shape.length
        R, places = ball().radius, [tuple(placed_ball.state.r) for placed_ball in balls]
        order = [
            sum(b[0] < a[0] if abs(b[1] - a[1]) < R else b[1] < a[1] for b in places[1:])
            for a in places
        ]
        front = places[1 + order[1:].index(0)]
        stroke = LIBRARY.carom_cue_of(GAME_POOL)
        stroke.b, stroke.a = above + normal(0.03), normal(0.03)
        stroke.phi = degrees(atan2(front[1] - places[0][1], front[0] - places[0][0])) + normal(0.2)
        stroke.speed = speed * cue().speed / struck(0, above).v[1] * (1 + normal(0.03))
        events, facts, end = shoot(kind, balls, stroke, 64)
        fell = [b for b in range(1, count) if facts.down >> b & 1]
        side = [
            b
            for b in fell
            if abs(shape.pocket[facts.pocket[b]].centre[1] - 0.5 * shape.length)
            < 0.25 * shape.length
        ]
        scratch = bool((facts.down | facts.off) & 1)
        rest = nan if scratch else hypot(end[0] - 0.5 * shape.width, end[1] - 0.5 * shape.length)
        all_of_them.append(
            {
                "places": [order[b] for b in fell],
                "success": bool(fell) and not scratch,
                "scratch": scratch,
                "eight": 8 in fell,
                "front_in_side": 0 in [order[b] for b in side],
                "back": back_of(events),
                "rest": rest,
            }
        )
    return all_of_them


def share(name, *numbers):
    """In %, of the breaks that count."""
    p = sum(result[name] for result in breaks(*numbers)) / BREAKS
    return 100 * p, 100 * sqrt(p * (1 - p) / BREAKS)


def balls_of_a_break(*numbers):
    """that made one"""
    counts = [len(result["places"]) for result in breaks(*numbers) if result["places"]]
    mean = sum(counts) / len(counts)
    return mean, sqrt((sum(n * n for n in counts) / len(counts) - mean * mean) / len(counts))


def wings(*numbers):
    """how often the likelier wing ball of nine-ball falls over how often the likeliest other ball
    does; the error is that of both
    """
    count = [sum(k in result["places"] for result in breaks(*numbers)) for k in range(16)]
    wing, likeliest = (
        max(count[3], count[5]),
        max([1] + [n for k, n in enumerate(count) if k not in (3, 5)]),
    )
    return wing / likeliest, wing / likeliest * sqrt(1 / (wing + 1) + 1 / likeliest)


def median_of(name, *numbers):
    """Of what is a number; the error as of a normal distribution."""
    sample = [result[name] for result in breaks(*numbers) if not isnan(result[name])]
    m = median(sample)
    return m, 1.86 * median(abs(x - m) for x in sample) / sqrt(len(sample))


# ---- What computes the value of a row of measured.csv, by the name in its column `computed`

POOL, SNOOKER, BILLIARD = GAME_POOL, GAME_SNOOKER, GAME_BILLIARD


def bank_by_diamonds(origin, beyond):
    """The diamonds to where a bank returns, aimed so many half diamonds beyond its origin."""
    return origin - diamond(TABLE_POOL_9FT, POOL, origin, origin - 0.5 * beyond, 1.5, 0, 2)


def third_rail(origin, aim, **numbers):
    """Where the corner-five system arrives on the third rail; 3 m/s, side spin R w_z / v of 0.6."""
    start = 2 * (origin - 1)
    return diamond(TABLE_THREECUSHION, BILLIARD, start, aim, 3, 0.6, 3, **numbers)


def rolling_deceleration(game, speed):
    return ball(game).mu_roll * ball(game).gravity + ball(game).drag * speed**2


def sliding_deceleration(game):
    return ball(game).mu_slide * ball(game).gravity


def share_of_tangent_line(cut):
    """The deflection of a rolling ball over that of a sliding one."""
    return deflection(cut, 1, 1) / (90 - cut)


def most_side():
    """R w_z / v of a ball that is struck half a radius off its centre."""
    motion = struck(0.5, 0)
    return ball().radius * abs(motion.w[2]) / hypot(*motion.v[:2])


def roll_at_once():
    """R w / v of a ball that is struck 2/5 of a radius above its centre."""
    motion = struck(0, 0.4)
    return -ball().radius * motion.w[0] / motion.v[1]


def of_constants_and_strikes():
    """{name: function} of rows that stand alone."""
    stun_45 = cache(lambda: speeds(45, 1, 0))
    cue_speed, object_speed = (lambda: stun_45()[0]), (lambda: stun_45()[1])
    jump_cue = {"mass": 0.28, "tip_time": 0.0008, "tip_restitution": 0.85}
    return {
        "pool ball-ball friction": lambda: ball(POOL).mu_ball,
        "pool ball-ball restitution": lambda: ball(POOL).restitution,
        "billiard ball-ball restitution": lambda: ball(BILLIARD).restitution,
        "pool rolling resistance": lambda: ball(POOL).mu_roll,
        "pool sliding friction": lambda: ball(POOL).mu_slide,
        "pool spin deceleration": lambda: (
            2.5 * ball(POOL).mu_spin * ball(POOL).gravity / ball(POOL).radius
        ),
        "pool tip restitution": lambda: cue(POOL).tip_restitution,
        "snooker rolling deceleration": lambda: rolling_deceleration(SNOOKER, 0.5),
        "snooker sliding deceleration": lambda: sliding_deceleration(SNOOKER),
        "billiard sliding deceleration": lambda: sliding_deceleration(BILLIARD),
        "billiard nose height": lambda: 1000 * table(TABLE_THREECUSHION).rail[0].height,
        "length of the 9 ft table": lambda: table(TABLE_POOL_9FT).length,
        "length of the 8 ft table": lambda: table(TABLE_POOL_8FT).length,
        "pool ball diameter": lambda: 2000 * ball(POOL).radius,
        "pool ball mass": lambda: ball(POOL).mass,
        "pool rebound at 1 m/s": lambda: rebound(POOL, 1),
        "twice across": lambda: max(abs(angle) for angle in twice_across()),
        "all systems": systems,
        "bounce": lambda: bounce(0.1),
        "speeds of object and cue ball": lambda: object_speed() / cue_speed(),
        "speed of the object ball": object_speed,
        "distance of the object ball": lambda: object_speed() ** 2,
        "distances of a full rolling hit": lambda: distance_ratio(0, 1, 1),
        "distances of a rolling hit of 32 degrees": lambda: distance_ratio(32, 1, 1),
        "distances of a stun hit of 45 degrees": lambda: distance_ratio(45, 1, 0),
        "cut of the greatest throw": lambda: throw_most(1),
        "share of a frozen kiss": lambda: kiss_share(60, 2),
        "hop": lambda: rise(0, 10, 3),
        "rise at 30 degrees": lambda: rise(0.28, 30, 4),
        "rise by a jump cue": lambda: rise(0.28, 45, 4, **jump_cue),
        "break in the air": lambda: in_the_air(5, 9, (0, 0.1)),
        "inside english": lambda: inside(18.435, 0.5, 2),
        "ball speed over cue speed": lambda: struck(0, 0).v[1] / cue().speed,
        "squirt": lambda: abs(angle(struck(0.25, 0).v)),
        "most side spin": most_side,
        "roll at once": roll_at_once,
    }


def of_cushions_and_pockets():
    found = {}
    for speed in (2, 0.6):
        found[f"billiard rebound at {speed} m/s"] = partial(rebound, BILLIARD, speed)
    for speed in (0.55, 0.9, 1.6):
        found[f"rebound of 2017 at {speed} m/s"] = partial(rebound, BILLIARD, speed, **MATCH_2017)
    for speed in (0.5, 1, 1.5, 2, 2.5):
        found[f"snooker rebound at {speed} m/s"] = partial(rebound, SNOOKER, speed)
    for speed in (4.5, 7):
        found[f"lengths of travel at {speed} m/s"] = partial(lengths_of_travel, speed)
    for origin, beyond in ((7, 1), (7, 2), (7.5, 3)):
        found[f"bank from {origin} by {beyond}"] = partial(bank_by_diamonds, origin, beyond)
    for origin, aim in ((4.5, 2), (5, 1), (5, 2), (5, 3), (4, 1)):
        found[f"third rail of {origin} - {aim}"] = partial(third_rail, origin, aim)
    for aim in (1, 2, 3):
        found[f"third rail of 5 - {aim} in 2017"] = partial(third_rail, 5, aim, **MATCH_2017)
    for of_set in "PGVCF":
        found[f"system {of_set}"] = partial(system, of_set)
    for angle_to_rail in (45, 35, 25, 20, 15, 10, 6):
        found[f"corner pocket at {angle_to_rail} degrees"] = partial(
            size, False, angle_to_rail, 1.5
        )
    for angle_to_rail in (0, 20, 40, 50):
        found[f"side pocket at {angle_to_rail} degrees"] = partial(size, True, angle_to_rail, 1.5)
    return found


def of_two_balls():
    found = {"throw": partial(throw, 45, 0.45, 0)}
    for friction in (0.06, 0.2, 0.5):
        found[f"throw with friction {friction}"] = partial(throw, 45, 0.45, 0, friction)
    for speed in (0.1, 1, 10):
        found[f"friction by Marlow at {speed} m/s"] = partial(marlow, speed * sin(radians(45)))
    for slip in (1.85, 2.6, 3.5):
        found[f"billiard friction at a slip of {slip} m/s"] = partial(friction_of, BILLIARD, slip)
    for cut in (48.59, 30, 14.48):
        found[f"deflection at {cut} degrees"] = partial(deflection, cut, 1, 1)
    for cut in (61.04, 53.13):
        found[f"share of the tangent line at {cut} degrees"] = partial(share_of_tangent_line, cut)
    for cut in (5, 10):
        found[f"deflection over the cut of {cut} degrees"] = partial(
            lambda cut: deflection(cut, 1, 1) / cut, cut
        )
    for cut in (10, 15, 20):
        found[f"draw at {cut} degrees"] = partial(draw_angle, cut, 1)
    for cut in (30, 45, 60):
        found[f"gearing at {cut} degrees"] = partial(gearing, cut, 1, 0)
    return found


def of_breaks():
    """A break has a rack, a table, the gaps in mm, the offset of the cue ball in m, its speed in m/s."""
    found = {}
    for gap in (0, 0.05, 0.1, 0.3):
        nine = (RACK_NINEBALL, TABLE_POOL_9FT, gap, 0.45, 9)
        found[f"nine-ball break succeeds with gaps of {gap} mm"] = partial(share, "success", *nine)
        found[f"nine-ball break scratches with gaps of {gap} mm"] = partial(share, "scratch", *nine)
        found[f"nine-ball break's wing ball with gaps of {gap} mm"] = partial(wings, *nine)
        found[f"nine-ball break's 1 ball with gaps of {gap} mm"] = partial(
            share, "front_in_side", *nine
        )
        eight = (RACK_EIGHTBALL, TABLE_POOL_7FT, gap, 0.2, 9)
        found[f"eight-ball break succeeds with gaps of {gap} mm"] = partial(
            share, "success", *eight
        )
        found[f"eight on the break with gaps of {gap} mm"] = partial(share, "eight", *eight)
        ten = (RACK_TENBALL, TABLE_POOL_9FT, gap, 0.3, 10)
        found[f"ten-ball break makes a ball with gaps of {gap} mm"] = partial(
            share, "success", *ten
        )
        found[f"balls of a ten-ball break with gaps of {gap} mm"] = partial(balls_of_a_break, *ten)
    for game, rack in (("nine-ball", RACK_NINEBALL), ("eight-ball", RACK_EIGHTBALL)):
        for gap in (0, 0.1):
            found[f"cue ball back after the {game} break with gaps of {gap} mm"] = partial(
                median_of, "back", rack, TABLE_POOL_9FT, gap, 0, 9, 0
            )
    for above in (0, 0.1, 0.2):
        found[f"cue ball's rest with the tip {above} R above"] = partial(
            median_of, "rest", RACK_EIGHTBALL, TABLE_POOL_9FT, 0, 0, 9, above
        )
    return found


COMPUTED = {
    **of_constants_and_strikes(),
    **of_cushions_and_pockets(),
    **of_two_balls(),
    **of_breaks(),
}


# ---- The table


def judged(row):
    """carom's value, its error and the verdict, as texts."""
    low, high = float(row["low"] or -inf), float(row["high"] or inf)
    if row["computed"] == "-":
        return "-", "", "-"
    value = COMPUTED[row["computed"]]()
    value, error = value if isinstance(value, tuple) else (value, 0)
    if isnan(value):
        raise ValueError
    verdict = (
        "-"
        if low == -inf and high == inf
        else "low"
        if value < low
        else "high"
        if value > high
        else "ok"
    )
    return f"{value:.4g}", f"{error:.2g}" if error else "", verdict


def main(path, as_csv):
    out, code = csv.writer(sys.stdout, lineterminator="\n"), 0
    heads = [
        "quantity",
        "published",
        "low",
        "high",
        "unit",
        "carom",
        "error",
        "verdict",
        "conditions",
        "source",
    ]
    line = "{:<42.42} {:>9} {:>7} {:>7} {:>9} {:<7} {:<6} {:<4}  {}"
    print(
        ",".join(heads)
        if as_csv
        else "quantity                                   published     low    high     carom error   unit   verdict"
    )
    with open(path, encoding="utf-8", newline="") as file:
        for row in (rows := csv.DictReader(file)):
            if row["computed"] == "":
                continue
            try:
                value, error, verdict = judged(row)
            except (ValueError, TypeError, KeyError):
                print(
                    f"carom-lab: {path}:{rows.line_num}: not a row of {len(rows.fieldnames)} columns with bounds and a function",
                    file=sys.stderr,
                )
                return 2
            code |= row["verdict"] == "ok" != verdict
            cells = [row["quantity"], row["value"], row["low"], row["high"]]
            if as_csv:
                out.writerow(
                    [*cells, row["unit"], value, error, verdict, row["conditions"], row["source"]]
                )
            else:
                print(line.format(*cells, value, error, row["unit"], verdict, row["conditions"]))
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[2], "csv" in sys.argv[3:]))
