"""breaks.py: breaks by a good player. A break has a rack, a table, the gap in mm, how far the cue ball
is from the long string in m, its speed in m/s, and the tip above its centre in R. Values are pairs,
with the standard error.
"""

from functools import cache
from math import atan2, degrees, hypot, isnan, nan, sqrt
from random import Random
from statistics import median

from study.lab.computed.library import (
    CONDITION_FAST_CLOTH,
    EVENT_BALL_BALL,
    GAME_POOL,
    LIBRARY,
    OF,
    RACKS,
    ball,
    ctypes,
    cue,
    reference,
    shoot,
    table,
)
from study.lab.computed.strikes import struck

BREAKS = 1600

# Breaks of events, on `fast_cloth`: the speed of professionals, m/s; and the gaps, mm, and the
# positions about an offset, m, which their sources leave open. Each cell of positions and gaps has
# CELL breaks.
EVENT_SPEED = 10
EVENT_GAPS, EVENT_POSITIONS, CELL = (0, 0.05, 0.1), (-0.05, 0, 0.05), 400


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
def breaks(rack, kind, gap, offset, speed, above=0, cloth=None, number=BREAKS):
    """Of each break: the positions of the balls that fell, in rows from the cue ball and from the
    left; what is counted; the cue ball's velocity back, and how far from the middle of the table it
    stops, m. The errors are those of a good player: 0.2 degrees, 3 % of the speed, 0.03 R.
    """
    rack_kind = RACKS[rack]
    count, shape = LIBRARY.carom_rack_size(rack_kind), table(kind)
    draw, all_of_them = Random(1), []

    def normal(deviation):
        return deviation * (sum(draw.random() for _ in range(12)) - 6)

    for k in range(number):
        balls = (OF["carom_shot_ball"] * count)()
        LIBRARY.carom_rack(
            rack_kind,
            reference(shape),
            ctypes.c_double(1e-3 * gap),
            ctypes.c_uint64(k),
            balls,
            count,
        )
        for placed_ball in balls if cloth is not None else ():
            placed_ball.kind.mu_roll = cloth
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
                "made": bool(fell),
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
    results = breaks(*numbers)
    p = sum(result[name] for result in results) / len(results)
    return 100 * p, 100 * sqrt(p * (1 - p) / len(results))


def cells(function, rack, kind, offset):
    """The values of a function in all cells of the breaks of events: their middle, and half of their
    range as the error.
    """
    fast = OF["carom_ball_kind"]()
    LIBRARY.carom_condition_give(CONDITION_FAST_CLOTH, reference(fast))
    cloth = fast.mu_roll
    values = [
        function(rack, kind, gap, offset + beside, EVENT_SPEED, 0, cloth, CELL)[0]
        for gap in EVENT_GAPS
        for beside in EVENT_POSITIONS
    ]
    return 0.5 * (max(values) + min(values)), 0.5 * (max(values) - min(values))


def event_share(name, *numbers):
    return cells(lambda *cell: share(name, *cell), *numbers)


def event_balls(*numbers):
    return cells(balls_of_a_break, *numbers)


def event_wings(*numbers):
    return cells(wings, *numbers)


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
