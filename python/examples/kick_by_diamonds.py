"""A kick by diamonds: from a corner of a three-cushion table to the long rail, over the short one, and where on the other long rail?

Players count in diamonds, the marks on the wood, and subtract: aim higher, arrive lower. Here the cue ball is played at each half diamond of
the first rail, with running english, and the place on the third rail is read off the events. Beyond the last row the ball meets another rail.

    python kick_by_diamonds.py kick.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

table = carom.tables.threecushion()
DIAMOND = table.length / 8  # m
start = np.array([0.1, 0.1])
layout = carom.balls([start], game="billiard")

arrivals, shots = {}, {}
for diamond in np.arange(3.0, 7.01, 0.5):
    target = np.array([table.width, diamond * DIAMOND])
    phi = np.degrees(np.arctan2(*(target - start)[::-1]))
    shot = carom.simulate(table, layout, carom.cue(speed=3.5, phi=phi, a=0.3, b=0.2, game="billiard"))
    rails = shot.events[shot.events["type"] == carom.EventType.RAIL]
    place = rails["before"][2][0]["r"]
    if place[0] < 0.1:  # the third rail is the long one
        arrivals[diamond], shots[diamond] = place[1] / DIAMOND, shot
        print(f"aimed at diamond {diamond:.1f}, arrives at {arrivals[diamond]:.2f}")

found = list(arrivals.values())
assert len(found) >= 3 and all(later < sooner for sooner, later in zip(found, found[1:]))
Path(sys.argv[1] if len(sys.argv) > 1 else "kick.svg").write_text(list(shots.values())[len(shots) // 2]._repr_svg_(), encoding="utf-8")
