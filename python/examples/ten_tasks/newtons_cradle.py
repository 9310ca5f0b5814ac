"""An imperfect Newton's cradle of four balls. pooltool: sandbox/newtons_cradle.py."""

import numpy as np

import carom

table, rng = carom.tables.pool_9ft(), np.random.default_rng(42)
angles = np.radians(90.0 + rng.uniform(-0.3, 0.3, 3))
steps = 0.05715 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
chain = np.array([0.635, 1.0]) + np.concatenate([np.zeros((1, 2)), steps.cumsum(axis=0)])
balls = carom.balls([[0.635, 0.3], *chain])
shot = carom.simulate(table, balls, carom.aim(table, balls, carom.cue(speed=2.0), ball=1).cue)
shot.show()
print(shot)
