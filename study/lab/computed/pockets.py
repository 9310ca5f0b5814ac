"""pockets.py: the effective sizes of pockets with the measures of Alciatore's TP 3.5 and TP 3.6, whose
points are sharp.
"""

from functools import cache
from math import cos, hypot, radians, sin

from study.lab.computed.library import (
    EVENT_POCKET,
    LIBRARY,
    OF,
    TABLE_POOL_9FT,
    ball,
    ctypes,
    reference,
    shoot,
    shot_ball,
    table,
)


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
    shape = table(shape) if isinstance(shape, (int, str)) else shape
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


def corner_size(angle):
    return size(False, angle, 1.5)


def side_size(angle):
    return size(True, angle, 1.5)
