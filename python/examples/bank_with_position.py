"""A bank with position play: ball 1 goes to a corner by one cushion, and the cue ball comes to rest
where the next stroke is easy.

Unknown are speed and height of the tip; the direction follows from them, as carom.aim() finds it.
So does its derivative: carom.aim_slope() tells how the direction turns with speed and tip where
ball 1 still falls. With it the derivative of the place of the cue ball along such strokes is J_x +
J_phi dphi/dx, and Newton's method solves two equations for two unknowns.

    python bank_with_position.py --goal 0.17,1.18
"""

from __future__ import annotations

import argparse

import numpy as np
from numpy.typing import NDArray

import carom

Doubles = NDArray[np.float64]
TABLE = carom.tables.pool_9ft()
BALLS = carom.balls([[0.34, 1.21], [0.52, 1.47]])
VARIED = ["cue.speed", "cue.b"]


def bank(x: Doubles) -> carom.Shot:
    """The stroke with speed x[0], m/s, and tip x[1] R above the centre, by which ball 1 goes by the
    right rail to the left corner.
    """
    pot = carom.aim(
        TABLE, BALLS, carom.cue(speed=x[0], b=x[1]), ball=1, pocket="foot-left", via=["right"]
    )
    return carom.simulate(TABLE, BALLS, pot.cue)


def solve(goal: Doubles, start: Doubles, steps: int) -> list[tuple[Doubles, float]]:
    """Each stroke, and how far from its goal, m, the cue ball rests."""
    x, found = start, []
    for _ in range(steps + 1):
        shot = bank(x)
        off = shot.final["r"][0, :2] - goal
        found.append((x, float(np.hypot(*off))))
        J = carom.tangents(shot, ["cue.phi", *VARIED]).final["r"][0]
        along = J[:, 1:] + np.outer(J[:, 0], carom.aim_slope(shot, 1, VARIED))
        x = x - np.linalg.solve(along, off)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--goal", default="0.17,1.18", help="where the cue ball is to rest, m")
    parser.add_argument("--steps", type=int, default=3)
    options = parser.parse_args()
    goal = np.array([float(part) for part in options.goal.split(",")])
    for step, (x, miss) in enumerate(solve(goal, np.array([1.8, 0.0]), options.steps)):
        print(
            f"step {step}: speed {x[0]:.4f} m/s, tip {x[1]:+.4f} R, the cue ball rests {1000 * miss:.2f} mm from its goal"
        )


if __name__ == "__main__":
    main()
