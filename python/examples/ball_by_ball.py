"""A nine-ball break, looked at ball by ball: who was hit by whom first, how far each ball went, and
where it ended.

A shot is a list of events with the states of the balls before and after each. So "the first contact
of a ball" is a question to an array, and the length of a path is a sum over positions, which are
exact at any time.

    python ball_by_ball.py break.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

table = carom.tables.pool_9ft()
shot = carom.simulate(table, carom.racks.nineball(table, seed=3), carom.cue(speed=9.0, phi=90.5))
contacts = shot.events[shot.events["type"] == carom.EventType.BALL_BALL]
paths = shot.positions(np.linspace(0.0, shot.time, 2000))[..., :2]  # (2000, balls, 2)
ways = np.hypot(*np.moveaxis(np.diff(paths, axis=0), -1, 0)).sum(axis=0)

for ball, (way, state) in enumerate(zip(ways, shot.final)):
    touched = contacts[(contacts["a"] == ball) | (contacts["b"] == ball)]
    first = "meets no ball"
    if len(touched):
        partner = int(touched["b"][0] if touched["a"][0] == ball else touched["a"][0])
        first = f"meets {partner or 'cue'} after {touched['time'][0]:.3f} s"
    end = (
        "is potted"
        if state["label"] == carom.Label.POCKETED
        else f"rests at {state['r'][0]:.2f}, {state['r'][1]:.2f} m"
    )
    print(f"{ball or 'cue':>3}  {first}, goes {way:5.2f} m, {end}")

# The distance that a ball goes is at least the way between its ends.
assert (ways + 1e-9 >= np.hypot(*(paths[-1] - paths[0]).T)).all() and len(contacts) >= 9
Path(sys.argv[1] if len(sys.argv) > 1 else "break.svg").write_text(
    shot._repr_svg_(), encoding="utf-8"
)
