"""By how much the cue ball is deflected, by the cut. pooltool: 30_degree_rule.ipynb."""

import matplotlib.pyplot as plt
import numpy as np

import carom

table = carom.tables.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])
balls = carom.balls([[2.5, 1.5], [2.5, 3.0]], game="pooltool_pool", restitution=1.0)
cuts = np.linspace(2, 88, 50)
models = {"world": "pooltool", "ball_model": "mirror"}
cue = carom.cue(speed=2.5, b=0.4, game="pooltool_pool")
cues = carom.aim(table, balls, cue, ball=1, cut=cuts, **models).cue
shots = carom.simulate_batch(table, balls, cues, room=64, **models)

# The cue ball's directions before the collision, and once it rolls again.
hits = shots.first("ball_ball", ball=0)
rolls = shots.first("sliding_rolling", ball=0, after=hits.time)
incoming, outgoing = hits.before["v"], rolls.after["v"]
sine, cosine = np.cross(incoming, outgoing)[:, 2], (incoming * outgoing).sum(axis=1)
angles = np.degrees(np.abs(np.arctan2(sine, cosine)))

phi = np.radians(cuts)
theory = np.degrees(np.arctan2(np.sin(phi) * np.cos(phi), np.sin(phi) ** 2 + 0.4))
print(f"at most {np.abs(angles - theory).max():.1e} degrees from the theory of rolling balls")
plt.plot(1.0 - np.sin(phi), angles, "o", 1.0 - np.sin(phi), theory, "-")
plt.xlabel("ball-hit fraction")
plt.ylabel("degrees")
plt.savefig("thirty_degrees.svg")
