"""Chaos: how far does each ball end from its place, for a degree of the cue's direction, after one
contact, two, and more?

Every contact of two balls multiplies derivatives by about six. Random layouts of 2 to 9 balls are
played at random speeds, and `carom.tangents` gives the exact derivative of each ball's end. A ball
is counted by the largest number of contacts between the cue and it. A derivative of hundreds of
metres per degree is exact and of no use: it holds for a thousandth of a degree only.

    python chaos.py chaos.svg
"""

import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import carom

matplotlib.use("Agg")
table, random = carom.tables.pool_9ft(), np.random.default_rng(7)
found: list[tuple[np.ndarray, np.ndarray]] = []
while len(found) < 2000:
    r = random.uniform([0.1, 0.1], [1.17, 2.44], (random.integers(2, 10), 2))
    if np.hypot(*(r[:, None] - r)[np.triu_indices(len(r), 1)].T).min() < 0.06:
        continue
    phi = np.degrees(np.arctan2(*(r[1] - r[0])[::-1])) + random.uniform(-1, 1)
    cue = carom.cue(
        speed=random.uniform(0.9, 5.8),
        phi=phi,
        a=random.uniform(-0.3, 0.3),
        b=random.uniform(-0.3, 0.3),
        follow=0.0,
    )
    shot = carom.simulate(table, carom.balls(r), cue)
    contacts = np.zeros(len(r), int)
    for event in shot.events[shot.events["type"] == carom.EventType.BALL_BALL]:
        contacts[[event["a"], event["b"]]] = contacts[[event["a"], event["b"]]].max() + 1
    tangents = carom.tangents(shot, ["cue.phi"])
    found.append((contacts, np.hypot(*tangents.final["r"][..., 0].T)))  # m per degree

contacts, d = (np.concatenate(values) for values in zip(*found, strict=True))
balls = [d[(contacts == n) & (d > 0)] for n in range(1, 6)]
medians = [np.median(values) for values in balls]
for n, (values, median) in enumerate(zip(balls, medians, strict=True), 1):
    print(f"{n} contacts: {len(values)} balls, median {median:.3g} m per degree")
assert (
    all(later > 1.5 * sooner for sooner, later in zip(medians, medians[1:], strict=False))
    and medians[3] > 100 * medians[0]
)

plt.boxplot(balls, sym="", whis=(10, 90))
plt.yscale("log")
plt.xlabel("contacts between the cue and a ball")
plt.ylabel("change of its end, m per degree of the aim")
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "chaos.svg")
