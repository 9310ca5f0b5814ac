"""The 30-degree rule: a rolling cue ball is turned by about 30 degrees, for hits from a quarter to
three quarters of the ball.

The ball leaves along the tangent line, keeps nearly all of its forward spin, and the cloth turns
its path until it rolls with 5/7 v + 2/7 R (w_y, -w_x). The angle has its maximum near a half-ball
hit, so it changes slowly around it. A stun shot has no such rule.

    python thirty_degrees.py rule.svg
"""

import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import carom

matplotlib.use("Agg")
RADIUS, SPEED = 0.028575, 1.5
fraction = np.linspace(0.02, 0.98, 97)  # of the object ball that the cue ball covers
cuts = np.arcsin(1.0 - fraction)
centres = np.stack([np.cos(cuts), np.sin(cuts), np.zeros_like(cuts)], axis=-1)


def turned(spin: float) -> np.ndarray:
    """The angle by which the path is turned once the ball rolls, degrees; spin 1 is that of a
    rolling ball.
    """
    pairs = carom.impacts(v_a=(SPEED, 0.0, 0.0), w_a=(0.0, spin * SPEED / RADIUS, 0.0), r_b=centres)
    pairs["mu_ball"] = carom.mu_ball(pairs)
    motions, _ = carom.collide(pairs)
    v, w = motions["a"]["v"], motions["a"]["w"]
    rolling = 5 / 7 * v[:, :2] + 2 / 7 * RADIUS * np.stack([w[:, 1], -w[:, 0]], axis=-1)
    return np.asarray(np.degrees(np.abs(np.arctan2(rolling[:, 1], rolling[:, 0]))))


follow, stun = turned(1.0), turned(0.0)
middle = follow[(fraction >= 0.25) & (fraction <= 0.75)]
print(
    f"rolling ball: {middle.min():.1f} to {middle.max():.1f} degrees from quarter to three-quarter hits"
)
assert 25 < middle.min() and middle.max() < 35 and (stun > follow).all()
plt.plot(fraction, follow, label="rolling")
plt.plot(fraction, stun, "--", label="stun")
plt.axhline(30, color="grey", linewidth=0.5)
plt.xlabel("part of the ball that is hit")
plt.ylabel("deflection once it rolls, degrees")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "rule.svg")
