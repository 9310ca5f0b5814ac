"""A bot: it plans each stroke by playing shots with a player's errors, then errs as that player
does.

`carom.plan` gives the strokes that pot most in a visit. The bot plays the first one on the table,
with noise, and plans again from where the balls lie, until it misses or the table is empty.

    python bot.py visit.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

random = np.random.default_rng(2)
table = carom.tables.pool_9ft()
layout = carom.balls([[0.6, 0.9], [0.3, 0.4], [1.0, 1.5], [0.7, 2.0]])
potted = 0
while True:
    best = carom.plan(table, layout, rules="potting", shots=100)
    cue = best["cue"][0].copy()
    cue["phi"] += random.normal(0.0, 0.1)  # degrees
    shot = carom.simulate(table, layout, cue)
    down = int((shot.final["label"][1:] == carom.Label.POCKETED).sum())
    scratch = shot.final["label"][0] == carom.Label.POCKETED
    print(
        f"plans to pot {best['value'][0]:.0%} of the balls: {'a scratch' if scratch else f'{down} down'}"
    )
    if scratch or down == 0:
        break
    potted += down
    layout = layout[shot.final["label"] != carom.Label.POCKETED].copy()
    left = shot.final[shot.final["label"] != carom.Label.POCKETED]
    layout["state"] = left
    if len(layout) == 1:
        break
print(f"the visit pots {potted} balls")
Path(sys.argv[1] if len(sys.argv) > 1 else "visit.svg").write_text(
    shot._repr_svg_(), encoding="utf-8"
)
