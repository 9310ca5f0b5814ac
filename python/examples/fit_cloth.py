"""Fitting the cloth: friction of sliding and of rolling from the recorded path of one ball.

A camera sees the centre of a ball 120 times a second, to half a millimetre. The ball slides at first, on a curve, as it spins
aslant to its way; then it rolls. Unknown are both frictions, where the ball began, its velocity and its spin about the two
horizontal axes: eight numbers x. The residuals r(x) are simulated less recorded positions. Gauss and Newton's method takes steps
dx = -(J^T J + l diag(J^T J))^-1 J^T r, here with Levenberg and Marquardt's damping l: the columns of the Jacobian J are central
differences, each of two whole shots, several l are tried and the best step is taken. All the shots of a step are two batches. With
noise of the same variance in all coordinates, the covariance of what is found is s^2 (J^T J)^-1, s^2 the sum of squares over its
degrees of freedom.

The recording is the simulator's own, with known frictions and noise of a known seed; and so that the stated uncertainty is tested
too, many recordings with other noise are fitted at once: their scatter has to be that of the covariance.

    python fit_cloth.py --draws 400 --seed 1 --out fit_cloth.svg
"""

from __future__ import annotations

import argparse
import time
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from matplotlib.patches import Circle
from tqdm import tqdm

import carom
import picture

Doubles = npt.NDArray[np.float64]
NAMES = ("mu_slide", "mu_roll", "x", "y", "v_x", "v_y", "w_x", "w_y")
TRUTH = np.array([0.212, 0.012, 0.40, 0.25, 1.0, 1.4, 25.0, -100.0])  # -, -, m, m, m/s, m/s, rad/s, rad/s
SCALES = np.array([0.1, 0.01, 0.1, 0.1, 1.0, 1.0, 30.0, 30.0])  # what is a large change of each
DIFFERENCE = 1e-4  # step of the differences, in scales
DAMPINGS = np.array([1e-10, 1e-4, 1e-2, 1.0, 100.0])  # the first is as good as none, and keeps what is singular solvable
NOISE = 0.0005  # standard deviation of each coordinate, m
TIMES = np.arange(0, 2.0, 1 / 120)  # s

table = carom.tables.pool_9ft()


class Fit(NamedTuple):
    """Of recordings, shape (n, times, 2), what was found, (n, 8), and its covariance, (n, 8, 8)."""

    found: Doubles
    covariance: Doubles
    iterations: int
    shots: int


def paths(x: Doubles) -> Doubles:
    """The positions at TIMES of balls that move by x, of shape (..., 8): (..., times, 2). NaN where x cannot be."""
    flat = x.reshape(-1, 8)
    none = np.zeros((len(flat), 1, 1))
    balls = carom.balls(
        flat[:, None, 2:4],
        v=np.concatenate([flat[:, None, 4:6], none], axis=-1),
        w=np.concatenate([flat[:, None, 6:8], none], axis=-1),
        mu_slide=flat[:, None, 0],
        mu_roll=flat[:, None, 1],
    )
    shots = carom.simulate_batch(table, balls, room=64, cushion_model="han", threads=carom.ALL_THREADS)
    at = shots.positions(TIMES, threads=carom.ALL_THREADS)[:, :, 0, :2]
    return at.reshape((*x.shape[:-1], len(TIMES), 2))


def record(seed: int, count: int = 1) -> Doubles:
    """Noisy recordings of the true path, of shape (count, times, 2)."""
    noise = np.random.default_rng(seed).normal(scale=NOISE, size=(count, len(TIMES), 2))
    return paths(TRUTH) + noise


def guess(recorded: Doubles) -> Doubles:
    """Where to begin, of shape (n, 8): usual frictions, velocity of the first tenth of a second, spin by that in the middle.

    Sliding leaves 5 v / 7 + 2 R (w_y, -w_x) / 7 alone: this is the velocity with which rolling begins.
    """

    def velocity(at: int) -> Doubles:
        return np.asarray((recorded[:, at + 12] - recorded[:, at]) / (TIMES[12] - TIMES[0]))

    radius = float(carom.balls([(0, 0)])["kind"]["radius"][0])
    surface = (7 * velocity(len(TIMES) // 2) - 5 * velocity(0)) / (2 * radius)
    usual = np.broadcast_to([0.3, 0.02], (len(recorded), 2))
    return np.concatenate([usual, recorded[:, 0], velocity(0), np.stack([-surface[:, 1], surface[:, 0]], axis=-1)], axis=-1)


def fit(recorded: Doubles, most: int = 40) -> Fit:
    """Fit each of the recordings, all side by side."""
    x = guess(recorded)
    moved = DIFFERENCE * np.diag(SCALES)
    shots = 0
    with tqdm(desc="fitting", unit=" shots", unit_scale=True, disable=None) as progress:
        for iteration in range(1, most + 1):
            # One batch for the path and its derivatives, of shape (n, 17, times, 2): here, to the right and to the left of it.
            tried = x[:, None, :] + np.concatenate([np.zeros((1, 8)), moved, -moved])
            at = paths(tried).reshape(len(x), 17, -1)
            residual = at[:, 0] - recorded.reshape(len(x), -1)
            jacobian = (at[:, 1:9] - at[:, 9:]).transpose(0, 2, 1) / (2 * DIFFERENCE)  # by scaled numbers
            normal = jacobian.transpose(0, 2, 1) @ jacobian
            slope = jacobian.transpose(0, 2, 1) @ residual[..., None]

            # Another for the steps, of which the best is taken if it is any better.
            diagonal = normal * np.eye(8)
            damped = normal[:, None] + DAMPINGS[:, None, None] * (diagonal + 1e-9 * np.eye(8))[:, None]
            step = -np.linalg.solve(damped, slope[:, None])[..., 0]
            ends = x[:, None, :] + SCALES * step
            ends[..., :2] = np.clip(ends[..., :2], 1e-4, 1.0)
            squares = ((paths(ends).reshape(len(x), len(DAMPINGS), -1) - recorded.reshape(len(x), 1, -1)) ** 2).sum(axis=-1)
            squares = np.concatenate([(residual**2).sum(axis=1)[:, None], np.nan_to_num(squares, nan=np.inf)], axis=1)
            x = np.concatenate([x[:, None], ends], axis=1)[np.arange(len(x)), squares.argmin(axis=1)]
            shots += tried.size // 8 + ends.size // 8
            progress.update(tried.size // 8 + ends.size // 8)
            if np.abs(step[:, 0]).max() < 1e-7:
                break
        else:
            raise RuntimeError(f"a step is still {np.abs(step[:, 0]).max():.1e} of the scales after {most} iterations")
    variance = (residual**2).sum(axis=1) / (residual.shape[1] - 8)
    covariance = variance[:, None, None] * np.linalg.inv(normal) * SCALES[:, None] * SCALES
    return Fit(x, covariance, iteration, shots)


def errors(fits: Fit) -> Doubles:
    """What was found less the truth, in stated standard deviations, of shape (n, 8): standard normal, if all is well."""
    return np.asarray((fits.found - TRUTH) / np.sqrt(np.diagonal(fits.covariance, axis1=1, axis2=2)))


def ellipse(covariance: Doubles, deviations: float) -> Doubles:
    """The ellipse of that many standard deviations about 0, of shape (2, points)."""
    angle = np.linspace(0, 2 * np.pi, 200)
    return np.asarray(deviations * np.linalg.cholesky(covariance) @ np.stack([np.cos(angle), np.sin(angle)]))


def inside(fits: Fit, deviations: float) -> float:
    """The share of the fits whose ellipse of both frictions has the truth in it; of normal errors 1 - exp(-deviations^2 / 2)."""
    off = fits.found[:, :2] - TRUTH[:2]
    distance = (off[:, None, :] @ np.linalg.inv(fits.covariance[:, :2, :2]) @ off[:, :, None])[:, 0, 0]
    return float((distance < deviations**2).mean())


def draw(out: str, recorded: Doubles, fits: Fit) -> None:
    """The picture: path, speed, what all the recordings gave."""
    figure, (path, speed, cloud) = picture.start(3, (12.2, 4.1), width_ratios=(1.6, 1, 1))

    # The table, with every fourth of what was recorded, and the path that was found.
    picture.draw_table(path, table)
    path.set_anchor("N")
    seen, found = recorded[0], paths(fits.found[0])
    path.plot(found[:, 1], -found[:, 0], color=picture.BLUE, lw=1.5, zorder=3)
    path.plot(seen[::4, 1], -seen[::4, 0], ".", color=picture.RED, ms=5, zorder=4)
    path.add_patch(Circle((seen[0, 1], -seen[0, 0]), 0.0286, fc="white", ec=picture.BLUE, lw=2, zorder=5))
    path.text(0.38, -0.42, "slides", color=picture.BLUE)
    path.text(1.4, -0.72, "rolls", color=picture.BLUE)
    path.set_title("A ball whose spin pulls it aside, recorded")
    lines = [f"noise {1000 * NOISE:g} mm, {len(TIMES)} pictures; found from the first recording:"]
    for k, name in enumerate(("friction of sliding", "friction of rolling")):
        deviation = np.sqrt(fits.covariance[0, k, k])
        lines.append(f"    {name} {fits.found[0, k]:.5f} ± {deviation:.5f}   (truth {TRUTH[k]:g})")
    path.text(0, -0.04, "\n".join(lines), transform=path.transAxes, va="top", linespacing=1.6)

    # The speed: recorded by differences over a twelfth of a second, and found.
    wide = 5
    middle, over = TIMES[wide:-wide], TIMES[2 * wide] - TIMES[0]
    speed.plot(middle, np.linalg.norm(seen[2 * wide :] - seen[: -2 * wide], axis=-1) / over, ".", color=picture.RED, ms=4)
    speed.plot(middle, np.linalg.norm(found[2 * wide :] - found[: -2 * wide], axis=-1) / over, color=picture.BLUE, lw=1.5)
    speed.text(0.6, 1.45, "recorded", color=picture.RED)
    speed.text(0.6, 1.35, "found", color=picture.BLUE)
    speed.set(title="Two slopes, two frictions", xlabel="time (s)", ylabel="speed (m/s)")

    # The frictions of all recordings beside the truth, and the ellipses that the first one states.
    off = 1e4 * (fits.found - TRUTH)
    cloud.plot(off[:, 0], off[:, 1], ".", color=picture.GREY, ms=4, alpha=0.6, zorder=1)
    cloud.plot(off[0, 0], off[0, 1], "o", color=picture.BLUE, ms=6, zorder=3)
    thin = {"arrowstyle": "-", "color": picture.BLUE, "lw": 0.8}
    place = (0.98 * off[:, 0].max(), 0.92 * off[:, 1].max())
    cloud.annotate("the first", off[0, :2], place, color=picture.BLUE, ha="right", arrowprops=thin, zorder=4)
    for deviations in (1, 2):
        ring = 1e4 * ellipse(fits.covariance[0, :2, :2], deviations)
        cloud.plot(ring[0], ring[1], color=picture.BLUE, lw=1.5)
        words = f"{deviations} σ: {inside(fits, deviations):.0%} inside"
        box = {"fc": "white", "ec": "none", "alpha": 0.85, "pad": 1.5}
        cloud.text(0, ring[1].max(), words, color=picture.BLUE, ha="center", va="center", bbox=box, zorder=4)
    cloud.axhline(0, color=picture.INK, lw=0.8)
    cloud.axvline(0, color=picture.INK, lw=0.8)
    cloud.set(title=f"{len(off)} recordings, other noise", xlabel="friction of sliding − truth (0.0001)")
    cloud.set_ylabel("friction of rolling − truth (0.0001)")
    picture.save(figure, out)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=400, help="recordings to fit")
    parser.add_argument("--seed", type=int, default=1, help="of their noise")
    parser.add_argument("--out", default="fit_cloth.svg", help="the picture, .svg or .png")
    given = parser.parse_args(arguments)
    recorded = record(given.seed, given.draws)
    begin = time.perf_counter()
    fits = fit(recorded)
    took = time.perf_counter() - begin
    print(f"{given.draws} fits, {fits.iterations} iterations, {fits.shots} shots in {took:.1f} s")
    for k, name in enumerate(NAMES):
        print(f"{name:8} {fits.found[0, k]:10.5f} +- {np.sqrt(fits.covariance[0, k, k]):.5f}  truth {TRUTH[k]:g}")
    print(f"truth inside the ellipses: 1 sigma {inside(fits, 1):.1%} (39.3% if normal), 2 sigma {inside(fits, 2):.1%} (86.5%)")
    draw(given.out, recorded, fits)


if __name__ == "__main__":
    main()
