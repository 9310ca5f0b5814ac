"""A batch on all cores: two thousand breaks with a player's errors, and what falls. The number of threads changes no bit.

Leading dimensions of layouts and cues are broadcast against each other: one rack, many cues. Only final states are kept, so the batch needs
little memory; `features` tells what fell without keeping an event.

    python all_cores.py falls.svg
"""

import sys
import time

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import carom

matplotlib.use("Agg")
BREAKS = 2000
random = np.random.default_rng(1)
table = carom.tables.pool_9ft()
cues = carom.cue(speed=random.normal(9.0, 0.3, BREAKS), phi=random.normal(90.0, 0.3, BREAKS))
rack = carom.racks.nineball(table, seed=1)

began = time.perf_counter()
shots = carom.simulate_batch(table, rack, cues, features=True, threads=carom.ALL_THREADS)
took = time.perf_counter() - began
alone = carom.simulate_batch(table, rack, cues[:50])
assert shots.final[:50].tobytes() == alone.final.tobytes()  # bit for bit

good = shots.status == 0
fell = (shots.features.pocket[good][:, 1:] >= 0).sum(axis=1)
print(f"{BREAKS / took:.0f} breaks a second; {fell.mean():.2f} balls fall, {np.mean(fell == 0):.0%} of the breaks are dry")
plt.hist(fell, bins=[k - 0.5 for k in range(11)])
plt.xlabel("object balls that fall")
plt.ylabel("breaks")
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "falls.svg")
