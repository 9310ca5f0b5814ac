"""Refining an aim: the strike by which both balls come to rest at chosen places, by derivatives of
the shot.

Unknown are the four numbers of a strike, x = (speed, phi, a, b); the residuals r(x) are where the
two balls end less where they should, in metres: four numbers too. Gauss and Newton's method takes
steps dx = -(J^T J + l)^-1 J^T r with the Jacobian J of carom.tangents(), and halves a step that
does not help. A derivative says nothing beyond its reach, where the balls meet something else; so
the search starts near the solution, as a player who knows the shot does.

    python refine_aim.py --draws 40 --seed 1 --out refine_aim.svg
"""

from __future__ import annotations

import argparse

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

import carom

matplotlib.use("Agg")
Doubles = NDArray[np.float64]
NAMES = ("cue.speed", "cue.phi", "cue.a", "cue.b")
SCALES = np.array([1.0, 1.0, 0.1, 0.1])  # what is a moderate change of each: m/s, degrees, R, R
OFF = np.array([0.03, 0.3, 0.2, 0.2])  # by how much a start is off, in scales

table = carom.tables.pool_9ft()


def play(x: Doubles, balls: carom.dtypes.Records) -> carom.Shot | None:
    """The shot of a strike; None where that is in error."""
    try:
        return carom.simulate(
            table, balls, carom.cue(speed=x[0], phi=x[1], a=x[2], b=x[3]), cushion_model="han"
        )
    except carom.CaromError:
        return None


def ends(shot: carom.Shot) -> Doubles:
    """Where the balls end."""
    return np.asarray(shot.final["r"][:, :2].ravel(), dtype=np.float64)


def refine(
    start: Doubles, balls: carom.dtypes.Records, goal: Doubles, steps: int = 12
) -> tuple[Doubles, list[float]]:
    """The strike found from `start`, and the largest miss, m, before and after each step."""
    x = start
    shot = play(x, balls)
    misses: list[float] = []
    while shot is not None:
        residuals = ends(shot) - goal
        misses.append(float(np.abs(residuals).max()))
        if misses[-1] < 1e-6 or len(misses) > steps:
            break
        # the step in scales, damped a little against directions in which nothing changes
        J = carom.tangents(shot, NAMES).final["r"].reshape(4, 4) * SCALES
        step = -np.linalg.solve(J.T @ J + 1e-9 * np.eye(4), J.T @ residuals) * SCALES
        for _ in range(12):
            shot = play(x + step, balls)
            if shot is not None and np.abs(ends(shot) - goal).max() < misses[-1]:
                break
            step *= 0.5
        else:
            break
        x = x + step
    return x, misses


def tasks(draws: int, seed: int) -> list[tuple[carom.dtypes.Records, Doubles, Doubles, Doubles]]:
    """Layouts, the strikes that were drawn, where the balls ended, and starts nearby."""
    random = np.random.default_rng(seed)
    found: list[tuple[carom.dtypes.Records, Doubles, Doubles, Doubles]] = []
    while len(found) < draws:
        centres = random.uniform([0.2, 0.3], [1.0, 2.2], (2, 2))
        d = centres[1] - centres[0]
        if np.hypot(*d) < 0.2:
            continue
        cut = random.uniform(-0.6, 0.6) * 0.05715 / np.hypot(*d)
        x = np.array(
            [
                random.uniform(0.8, 1.6),
                np.degrees(np.arctan2(d[1], d[0]) + cut),
                random.uniform(-0.2, 0.2),
                random.uniform(-0.2, 0.3),
            ]
        )
        balls = carom.balls(centres, cushion_model="han")
        shot = play(x, balls)
        if shot is not None and not (shot.final["label"] == carom.Label.POCKETED).any():
            found.append((balls, x, ends(shot), x + random.normal(size=4) * OFF * SCALES))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--draws", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="refine_aim.svg")
    options = parser.parse_args()
    runs = [
        refine(start, balls, goal)[1]
        for balls, _, goal, start in tasks(options.draws, options.seed)
    ]
    solved = sum(misses[-1] < 1e-3 for misses in runs)
    counts = [len(misses) - 1 for misses in runs if misses[-1] < 1e-3]
    print(
        f"{solved} of {len(runs)} aims end within 1 mm of both places, after {np.median(counts):.0f} steps in the median"
    )
    figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
    for misses in runs:
        axes.semilogy(
            np.maximum(misses, 1e-9), color="#0072b2" if misses[-1] < 1e-3 else "#d9d9d9", lw=0.9
        )
    axes.set(
        xlabel="step",
        ylabel="largest miss of the two balls, m",
        title=f"{solved} of {len(runs)} within 1 mm (blue)",
    )
    plt.rcParams["svg.hashsalt"] = "carom"
    figure.savefig(
        options.out, dpi=150, metadata={"Date": None} if options.out.endswith(".svg") else None
    )
    print(f"wrote {options.out}")


if __name__ == "__main__":
    main()
