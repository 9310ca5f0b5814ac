"""A kick by diamonds: over three rails of a three-cushion table from the long rail back to it, and
on to the fourth: where does it arrive?

Players count in diamonds, the marks on the wood, and subtract: aim higher, arrive lower. The start
    is 5 in the corner, and half a number less
for each diamond along the long rail; the third and the fourth rail count from the foot, so that the
    corner at the head is 8. Each ball is sent,
with running english, so that it meets the third rail at 2. Players take such a ball from 5 to be on
    its way to the corner, and one from 4.5, 4,
3.5 and 3 to arrive 0.25, 0.5, 0.75 and 1 before it. Two tables are played: that of carom, measured
    in 2022, and that of a match of 2017.
With a third argument the corner and the difference from 5 to 3 are told for other cushions.

    python kick_by_diamonds.py kick.svg [map]
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np

import carom

table = carom.tables.threecushion()
DIAMOND = table.length / 8  # m
STARTS = [5.0, 4.5, 4.0, 3.5, 3.0]


def kick(start: float, first: float, **numbers: Any) -> tuple[carom.Shot, float, float]:
    """The shot from a start to a number of the first rail, and its places on the third and the
    fourth: NaN where it meets others.
    """
    point = np.array([0.2 * DIAMOND, max(2 * (5 - start), 0.2) * DIAMOND])
    phi = np.degrees(np.arctan2(*(np.array([table.width, (8 - first) * DIAMOND]) - point)[::-1]))
    layout = carom.balls([point], game="billiard", **numbers)
    shot = carom.simulate(
        table, layout, carom.cue(speed=3.0, phi=phi, a=0.3, b=0.2, game="billiard")
    )
    rails = np.flatnonzero(shot.events["type"] == carom.EventType.RAIL)
    place = shot.events["before"][rails[2], 0]["r"]
    if place[0] > 0.1:
        return shot, np.nan, np.nan
    # Where the way crosses the line of the other long rail once the ball rolls, whatever rail it
    # meets there.
    rolls = shot.events["after"][
        rails[2] + np.argmax(shot.events["type"][rails[2] :] == carom.EventType.SLIDING_ROLLING), 0
    ]
    fourth = (
        rolls["r"][1] + (table.width - place[0] - rolls["r"][0]) * rolls["v"][1] / rolls["v"][0]
    )
    return shot, 8 - place[1] / DIAMOND, 8 - fourth / DIAMOND


def through_two(start: float, **numbers: Any) -> list[float]:
    """The number of the first rail with which the third is met at 2, and the place on the fourth."""
    firsts = np.linspace(start - 2.2, start - 1.4, 9)
    third, fourth = np.transpose([kick(start, first, **numbers)[1:] for first in firsts])
    hits = np.isfinite(third)
    return [float(np.interp(-2.0, -third[hits], values[hits])) for values in (firsts, fourth)]


for name, numbers in ("2022", {}), ("2017", {"restitution_cushion": 0.753, "mu_cushion": 0.238}):
    for start in STARTS:
        first, fourth = through_two(start, **numbers)
        print(f"{name}: from {start} at {first:.2f} over 2 to {fourth:.2f}")
        assert 0 < first < start and 6 < fourth < 9
if len(sys.argv) > 2:
    for e in np.linspace(0.7, 0.82, 4):
        ends = [
            [through_two(start, restitution_cushion=e, mu_cushion=mu)[1] for start in (5.0, 3.0)]
            for mu in (0.18, 0.22, 0.26)
        ]
        print(
            f"restitution {e:.2f}, friction 0.18, 0.22, 0.26:",
            "  ".join(f"{five:.2f} {three - five:+.2f}" for five, three in ends),
        )
Path(sys.argv[1] if len(sys.argv) > 1 else "kick.svg").write_text(
    kick(5.0, 3.1)[0]._repr_svg_(), encoding="utf-8"
)
