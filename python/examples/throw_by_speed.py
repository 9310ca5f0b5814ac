"""Throw: friction between the balls turns the object ball from the line of centres, by an angle
that depends on cut and speed.

While the balls slip on each other, tan(throw) is their friction, which falls with the speed of slip
(Alciatore's law). Where they stick before they part, tan(throw) = 2 tan(cut)/(7 (1 + e)). So throw
grows with the cut up to a maximum and falls behind it, and slow shots are thrown most. One batch
computes the whole picture.

    python throw_by_speed.py throw.svg
"""

import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import carom

matplotlib.use("Agg")
cuts, speeds = np.radians(np.linspace(0.0, 80.0, 161)), np.array([0.5, 1.5, 4.0])
centres = np.stack([np.cos(cuts), -np.sin(cuts), np.zeros_like(cuts)], axis=-1)
moving = np.stack([speeds, 0 * speeds, 0 * speeds], axis=-1)
pairs = carom.impacts(v_a=moving[:, None], r_b=centres)  # (3 speeds, 161 cuts)
pairs["mu_ball"] = carom.mu_ball(pairs)
motions, status = carom.collide(pairs)
velocity = motions["b"]["v"]
throw = np.degrees(cuts + np.arctan2(velocity[..., 1], velocity[..., 0]))

for speed, curve in zip(speeds, throw):
    plt.plot(np.degrees(cuts), curve, label=f"{speed:g} m/s")
    print(
        f"{speed:g} m/s: most throw {curve.max():.2f} degrees, at a cut of {np.degrees(cuts)[curve.argmax()]:.0f}"
    )
assert (status == 0).all() and throw.max(axis=1)[0] > throw.max(axis=1)[1] > throw.max(axis=1)[2]
# At small cuts the balls stick.
assert np.allclose(np.tan(np.radians(throw[:, 4])), 2 * np.tan(cuts[4]) / (7 * 1.95), rtol=1e-3)
plt.xlabel("cut angle, degrees")
plt.ylabel("throw, degrees")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "throw.svg")
