"""A rule of one's own: only a kick counts.

The cue ball touches a cushion before it meets the object ball, which then falls.

`features` has what rules ask about, for a whole batch and without events: the first ball met,
cushions before it, pockets. A rule is then a line of NumPy, and a search for the stroke that obeys
it is a batch.

    python custom_rule.py kick_shot.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

table = carom.tables.pool_9ft()
layout = carom.balls([[0.45, 0.7], [0.8, 1.3]])
cues = carom.cue(
    speed=np.array([1.5, 2.5, 3.5])[:, None], phi=np.arange(0.0, 360.0, 0.05), b=0.1
)  # (3, 7200)
shots = carom.simulate_batch(table, layout, cues, features=True, threads=carom.ALL_THREADS)

facts = shots.features
potted, scratch = facts.pocket[..., 1] >= 0, facts.pocket[..., 0] >= 0
kick = (facts.contact[..., 0] == 1) & (facts.cushions_before[..., 0] >= 1) & potted & ~scratch
print(
    f"{kick.sum()} of {kick.size} strokes are good kicks; {np.sum(potted & ~kick)} pot the ball otherwise"
)
assert kick.any() and not (kick & ~potted).any()

# The easiest kick is in the middle of the widest window of directions.
neighborhood = np.stack([np.convolve(row, np.ones(21), "same") for row in kick]) * kick
best = np.unravel_index(neighborhood.argmax(), neighborhood.shape)
shot = carom.simulate(table, layout, cues[best])
print(
    f"{cues['speed'][best]:g} m/s at {cues['phi'][best]:.2f} degrees, after {facts.cushions_before[best][0]} cushions"
)
Path(sys.argv[1] if len(sys.argv) > 1 else "kick_shot.svg").write_text(
    shot._repr_svg_(), encoding="utf-8"
)
