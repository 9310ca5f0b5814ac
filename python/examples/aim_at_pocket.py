"""Aiming at a pocket by derivatives: Newton's method on the direction of the cue.

A ball in a pocket lies there whatever happens, so the derivative of its end is 0 and no gradient leads towards a pocket. A smooth number does:
by how much the straight path of the ball misses the middle of the pocket, from a time at which the ball rolls. Its derivative follows from
those of the ball's place and velocity at that time, which `carom.tangents` gives exactly.

    python aim_at_pocket.py pot.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

table = carom.tables.pool_9ft()
balls = carom.balls([[0.6, 0.8], [0.75, 1.6]])
pocket, quarter = table.pockets["centre"][5], np.array([[0.0, 1.0], [-1.0, 0.0]])  # a quarter turn


def miss(phi: float) -> tuple[carom.Shot, float, float]:
    """The shot; by how much ball 1 misses the pocket, m; and the derivative, m per degree."""
    shot = carom.simulate(table, balls, carom.cue(speed=1.5, phi=phi, b=0.0))
    at = shot.events["time"][shot.events["type"] == carom.EventType.BALL_BALL][0] + 0.4  # ball 1 rolls by then
    ball, d = shot.states([at])[0, 1], carom.tangents(shot, ["cue.phi"], times=[at]).at
    to, v, dr, dv = pocket - ball["r"][:2], ball["v"][:2], d["r"][0, 1, :, 0], d["v"][0, 1, :, 0]
    u = v / np.hypot(*v)  # where the ball goes
    du = (dv - u * (u @ dv)) / np.hypot(*v)
    return shot, to @ quarter @ u, to @ quarter @ du - dr @ quarter @ u


phi, shot, off = 80.0, miss(80.0)[0], np.inf
while abs(off) > 1e-9:
    shot, off, slope = miss(phi)
    print(f"aim {phi:.4f} degrees: ball 1 misses the middle of the pocket by {1000 * abs(off):.3g} mm")
    assert abs(off) < 0.25
    phi -= off / slope
assert shot.final["label"][1] == carom.Label.POCKETED
Path(sys.argv[1] if len(sys.argv) > 1 else "pot.svg").write_text(shot._repr_svg_(), encoding="utf-8")
