"""Twenty shots with more and more draw: saved, loaded and shown. pooltool: sandbox/collection.py."""

import numpy as np

import carom

table = carom.tables.pool_9ft()
balls = carom.balls(np.array([[1 / 2, 1 / 3], [1 / 4, 0.2]]) * [table.width, table.length])
cues = carom.cue(speed=2.0, phi=225.0, b=-np.linspace(0.0, 0.5, 20))
shots = carom.simulate_batch(table, balls, cues)
shots.save("collection.carom")
loaded = carom.load("collection.carom")
assert (loaded.final == shots.final).all()
loaded.show()
print(loaded)
