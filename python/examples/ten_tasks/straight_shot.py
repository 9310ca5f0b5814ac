"""How often a straight shot goes in, by the distance to the object ball, for three players.
pooltool: straight_shot.ipynb."""

import matplotlib.pyplot as plt
import numpy as np

import carom

table = carom.tables.polygon([(x, y, 0.118) for x, y in ((0, 0), (10, 0), (10, 10), (0, 10))])
toward, distances = np.array([1.0, 1.0]) / np.sqrt(2), np.linspace(0.0575, 1.999, 12)
pocket, length, rng = 0.06 * toward, 2.0, np.random.default_rng(42)
cue_ball = np.broadcast_to(pocket + length * toward, (12, 2))
layouts = carom.balls(np.stack([cue_ball, cue_ball - distances[:, None] * toward], axis=1))

for spread in (0.15, 0.25, 0.4):
    cues = carom.cue(speed=1.0, b=0.0, phi=225.0 + rng.uniform(-spread, spread, (12, 400)))
    shots = carom.simulate_batch(table, layouts[:, None], cues)
    shares = shots.potted(1).mean(axis=1)
    print(f"{spread} degrees:", " ".join(f"{share:.2f}" for share in shares))
    plt.plot(distances, shares, "o-", label=f"{spread} degrees")
plt.legend()
plt.savefig("straight_shot.svg")
