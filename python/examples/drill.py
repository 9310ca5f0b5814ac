"""A drill: how often does a player pot a straight shot, by its length and by the speed of the cue?

The player errs: the direction by 0.3 degrees, the speed by 3 %, the tip by 0.02 R (standard
deviations). Each number is the share of a batch of strokes that pot the ball. Slow shots are thrown
more by side spin that was not meant, and long ones forgive less.

    python drill.py drill.svg
"""

import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import carom

matplotlib.use("Agg")
STROKES = 400
random = np.random.default_rng(1)
table = carom.tables.pool_9ft()
pocket = table.pockets["centre"][
    np.argmin(table.pockets["centre"].sum(axis=1))
]  # the corner near the origin
way = np.array([1.0, 1.6]) / np.hypot(1.0, 1.6)
lengths = np.linspace(0.3, 1.3, 6)

for speed in (1.5, 3.0):
    potted = []
    for length in lengths:
        layout = carom.balls([pocket + way * (length + 0.5), pocket + way * length])
        phi = np.degrees(np.arctan2(-way[1], -way[0])) + random.normal(0.0, 0.3, STROKES)
        tip = random.normal(0.0, 0.02, (2, STROKES))
        cues = carom.cue(
            speed=speed * random.normal(1.0, 0.03, STROKES), phi=phi, a=tip[0], b=tip[1]
        )
        shots = carom.simulate_batch(table, layout, cues, features=True, threads=carom.ALL_THREADS)
        potted.append(float(np.mean(shots.features.pocket[:, 1] >= 0)))
    print(
        f"{speed:g} m/s:",
        ", ".join(f"{length:.1f} m {share:.0%}" for length, share in zip(lengths, potted)),
    )
    assert potted[0] > potted[-1]
    plt.plot(lengths, potted, marker="o", label=f"{speed:g} m/s")
plt.xlabel("object ball to pocket, m")
plt.ylabel("share that is potted")
plt.ylim(0, 1)
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "drill.svg")
