"""Breaks of nine-ball from many places, and the one that pots most. pooltool:
sandbox/break_forever.py plays such breaks one after another."""

import numpy as np

import carom

table, rng = carom.tables.pool_9ft(), np.random.default_rng(1)
places = np.stack([rng.uniform(0.1, 1.17, 300), np.full(300, 0.6)], axis=1)
racks = carom.racks.nineball(table, gap=2e-4, seed=np.arange(300), cue_ball=places)
ways = racks["state"]["r"][:, 1] - racks["state"]["r"][:, 0]
cues = carom.cue(speed=8.0, phi=np.degrees(np.arctan2(ways[:, 1], ways[:, 0])))
shots = carom.simulate_batch(table, racks, cues)
potted = shots.potted()[:, 1:].sum(axis=1)
best = shots[int(potted.argmax())]
print(
    f"{potted.mean():.2f} balls a break, {potted.max()} in the best one, from {best.balls['state']['r'][0]}"
)
best.show()
