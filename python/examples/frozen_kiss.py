"""A frozen kiss: two object balls touch, and the cue ball hits the first.

Which way does the second go?

Both contacts last, and overlap in time: carom solves them together, as a cluster. Resolved one
after the other they send the second ball elsewhere. Momentum and energy hold either way; only the
law of the contacts decides.

    python frozen_kiss.py kiss.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

table = carom.tables.pool_9ft()
RADIUS = 0.028575
first = np.array([0.6, 1.2])
second = first + 2 * RADIUS * np.array([np.cos(np.radians(40)), np.sin(np.radians(40))])
layout, cue = (
    carom.balls(np.array([[0.6, 0.8], first, second])),
    carom.cue(speed=2.0, phi=90.0, b=0.0),
)

shots = {}
for how in ("cluster", "pairs"):
    shot = shots[how] = carom.simulate(table, layout, cue, simultaneous=how)
    contact_time = shot.events["time"][shot.events["type"] == carom.EventType.BALL_BALL][0] + 0.01
    v = shot.states([contact_time])["v"][0, :, :2]
    print(
        f"{how:8s} ball 1 at {np.degrees(np.arctan2(*v[1][::-1])):6.1f} degrees, ball 2 at {np.degrees(np.arctan2(*v[2][::-1])):5.1f} degrees"
    )

assert not np.allclose(shots["cluster"].final["r"], shots["pairs"].final["r"], atol=1e-3)
Path(sys.argv[1] if len(sys.argv) > 1 else "kiss.svg").write_text(
    shots["cluster"]._repr_svg_(), encoding="utf-8"
)
