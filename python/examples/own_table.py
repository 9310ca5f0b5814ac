"""A table of one's own: a hexagon with a pocket in the middle, and a shot that finds it.

A rail is a line from p to q with a height, and the side on which balls lie. `check()` finds holes
between rails and rails that are played from the wrong side. Corners need a jaw or none: here rails
meet.

    python own_table.py hexagon.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

SIDE, NOSE = 0.9, 0.0366  # m
angles = np.radians(np.arange(6) * 60.0)
centre = np.array([SIDE, SIDE * np.sqrt(0.75)])
corners = centre + SIDE * np.stack([np.cos(angles), np.sin(angles)], axis=-1)

rails = np.zeros(6, carom.dtypes.rail)
rails["p"], rails["q"], rails["height"] = corners, np.roll(corners, -1, axis=0), NOSE
# Which side is inside: that of the centre, by the line lx x + ly y + l0 = 0 through p and q.
along = rails["q"] - rails["p"]
rails["line"][:, 0], rails["line"][:, 1] = -along[:, 1] / SIDE, along[:, 0] / SIDE
rails["line"][:, 2] = -(rails["line"][:, :2] * rails["p"]).sum(axis=1)
rails["side"] = (rails["line"][:, :2] @ centre + rails["line"][:, 2] > 0).astype(int)
pocket = np.zeros(1, carom.dtypes.pocket)
pocket["centre"], pocket["radius"], pocket["depth"] = centre, 0.06, 0.08

table = carom.Table(2 * SIDE, 2 * centre[1], rails=rails, pockets=pocket)
table.check()
start = centre + [0.4, 0.3]
cues = carom.cue(speed=2.5, phi=np.arange(0.0, 360.0, 0.5), b=0.2)
shots = carom.simulate_batch(table, carom.balls([start]), cues, features=True)
facts = shots.features
assert facts is not None  # as it was asked for
found = np.flatnonzero((facts.pocket[:, 0] == 0) & (facts.cushions[:, 0] >= 2))
print(
    f"{len(found)} of {len(cues)} directions find the pocket after two rails or more, such as {cues['phi'][found[0]]:.1f} degrees"
)
assert len(found) > 0
Path(sys.argv[1] if len(sys.argv) > 1 else "hexagon.svg").write_text(
    carom.simulate(table, carom.balls([start]), cues[found[0]])._repr_svg_(), encoding="utf-8"
)
