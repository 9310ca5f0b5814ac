"""systems.py: systems of players, data/pool_systems.csv: sets P G V C F T. A diamond is an eighth of
the length of the table. The ball starts on the long rail x = 0; sights lie `SIGHT` behind the noses.
"""

import csv
import sys
from functools import cache
from math import atan2, cos, degrees, hypot, isnan, nan, radians, sin, sqrt, tan
from pathlib import Path

from study.lab.computed.library import (
    EVENT_JAW,
    EVENT_POCKET,
    EVENT_RAIL,
    TABLE_POOL_9FT,
    ball,
    shoot,
    shot_ball,
    table,
)

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
def system(of_set, kind=TABLE_POOL_9FT):
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


def systems(kind=TABLE_POOL_9FT):
    """The error of all six sets: rms of those of each; T counts in diamonds of a crossing."""
    errors = [system(of_set, kind) for of_set in "PGVCF"]
    errors.append(sqrt(sum(tan(radians(a)) ** 2 for a in twice_across(kind)) / 3) * 4)
    return sqrt(sum(e * e for e in errors) / len(errors))


def twice_across(kind=TABLE_POOL_9FT):
    """T: degrees from straight across after two, three and four rails."""
    row = next(row for row in rows_of_systems() if row["set"] == "T")
    direction = radians(float(row["start"]))
    motions = [
        flight(kind, (0.2, 0.15), direction, float(row["speeds"]), 0, 0, nth) for nth in (3, 4, 5)
    ]
    return [degrees(atan2(v[1], abs(v[0]))) for _, v in motions]


def most_twice_across():
    return max(abs(angle) for angle in twice_across())


def sliding_bank(aim, kind, speed):
    """Diamonds of the far rail where the line of aim of a sliding bank starts that ends in the corner;
    the line passes through a sight of the banking rail.
    """

    def arrives(start):
        return bank(kind, {"set": "P", "start": start, "aim": aim, "roll": 0.0}, speed, 0)

    starts = [aim * (1.6 + 0.05 * k) for k in range(41)]
    pairs = [(start, arrives(start)) for start in starts]
    for (first, before), (second, after) in zip(pairs, pairs[1:]):
        if not isnan(before) and not isnan(after) and min(before, after) <= 0 < max(before, after):
            return first + (second - first) * before / (before - after)
    return nan
