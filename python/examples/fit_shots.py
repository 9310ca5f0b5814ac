"""Fitting constants to shots: five of them, with their covariance, by derivatives of whole shots.

Eight shots of two balls were recorded: a dozen places of each ball over three seconds, with noise of 2 mm. Layouts and strokes are known.
Unknown are x = (friction of sliding and of rolling, restitution of the balls, friction and restitution of the cushions), which the start
has wrong by 15 %. The residuals r(x) are played less recorded places over the noise. Levenberg and Marquardt's method takes steps

    dx = -(J^T W J + l diag(J^T W J))^-1 J^T W r,      W = 1/sqrt(1 + r^2/c^2),

which weights down what is far off, as a start that is wrong makes balls meet something else. All shots are one batch, and the Jacobian J of all of
them is one call of carom.tangents(). The covariance of what is found is (J^T J)^-1: it costs nothing more.

Whether that is right is tested by fitting many recordings of the same shots with other noise and other starts: their scatter has to be
that of the covariance. For comparison the Jacobian can be made of differences of shots, which takes six batches instead of one.

    python fit_shots.py --draws 200 --seed 1 --out fit_shots.svg
"""

from __future__ import annotations

import argparse
import time
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from tqdm import tqdm

import carom
import picture

Doubles = npt.NDArray[np.float64]
NAMES = ("mu_slide", "mu_roll", "restitution", "mu_cushion", "restitution_cushion")
TRUTH = np.array([0.2, 0.01, 0.95, 0.2, 0.85])
LOW, HIGH = 0.3 * TRUTH, np.array([0.5, 0.03, 0.999, 0.5, 0.999])
OFF = 0.15  # by how much a start is off, of the constants themselves, one standard deviation
NOISE = 0.002  # standard deviation of each coordinate, m
WIDE = 3.0  # c, in standard deviations of the noise
SHOTS = 8
TIMES = np.linspace(0.1, 3.0, 12)  # s
DIFFERENCE = 1e-4  # step of the differences, of the constants themselves

table = carom.tables.pool_9ft()


class Fit(NamedTuple):
    """Of one set of recordings: the constants after each step, their covariance, and how many shots were played."""

    steps: Doubles
    covariance: Doubles
    played: int

    @property
    def found(self) -> Doubles:
        """The constants after the last step."""
        return np.asarray(self.steps[-1])


class Plays:
    """The shots that were recorded, ready to be played with other constants."""

    def __init__(self, seed: int) -> None:
        random = np.random.default_rng(seed)
        layouts, cues = list[carom.dtypes.Records](), list[carom.dtypes.Records]()
        while len(layouts) < SHOTS:
            centres = random.uniform([0.2, 0.2], [1.05, 2.3], (2, 2))
            to = centres[1] - centres[0]
            if np.hypot(*to) < 0.25:
                continue
            phi = np.degrees(np.arctan2(to[1], to[0]) + random.uniform(-0.6, 0.6) * 0.05715 / np.hypot(*to))
            cue = carom.cue(speed=random.uniform(0.8, 2.0), phi=phi, a=random.uniform(-0.3, 0.3), b=random.uniform(-0.2, 0.4))
            balls = carom.balls(centres)
            if not (carom.simulate(table, balls, cue, cushion_model="han").final["label"] == carom.Label.POCKETED).any():
                layouts.append(balls)
                cues.append(cue)
        self.layouts, self.cues, self.count = np.array(layouts), np.array(cues), 0

    def play(self, x: Doubles) -> carom.Shots:
        """All shots with these constants."""
        for name, value in zip(NAMES, x):
            self.layouts["kind"][name] = value
        self.count += SHOTS
        return carom.simulate_batch(table, self.layouts, self.cues, room=256, cushion_model="han")

    def places(self, shots: carom.Shots) -> Doubles:
        """Where the balls are at TIMES, (shots, times, 2, 2)."""
        return np.asarray(shots.positions(TIMES)[..., :2])

    def jacobian(self, x: Doubles, shots: carom.Shots, differences: bool) -> Doubles:
        """Derivatives of the places by the constants, (numbers, 5)."""
        if not differences:
            return carom.tangents(shots, [f"kind.{name}" for name in NAMES], times=TIMES).at["r"].reshape(-1, 5)
        first = self.places(shots)
        moved = [self.places(self.play(x + step)) for step in np.diag(DIFFERENCE * x)]
        return np.stack([(other - first).ravel() / (DIFFERENCE * value) for other, value in zip(moved, x)], axis=-1)


def cost(residuals: Doubles) -> float:
    """The pseudo-Huber cost of residuals in standard deviations."""
    return float(2.0 * WIDE**2 * (np.sqrt(1.0 + (residuals / WIDE) ** 2) - 1.0).sum())


def fit(plays: Plays, recorded: Doubles, start: Doubles, differences: bool = False, most: int = 40) -> Fit:
    """The constants by which the shots are most like the recorded ones."""
    before, x, damping = plays.count, start, 1e-3
    shots = plays.play(x)
    r = ((plays.places(shots) - recorded) / NOISE).ravel()
    steps = [x]
    for _ in range(most):
        J = plays.jacobian(x, shots, differences) / NOISE
        W = 1.0 / np.sqrt(1.0 + (r / WIDE) ** 2)
        normal, slope = J.T @ (W[:, None] * J), J.T @ (W * r)
        now = cost(r)
        # shorter and shorter steps until the cost falls
        for _ in range(10):
            tried = np.clip(x - np.linalg.solve(normal + damping * np.diag(normal.diagonal()), slope), LOW, HIGH)
            shots = plays.play(tried)
            r = ((plays.places(shots) - recorded) / NOISE).ravel()
            if cost(r) < now:
                break
            damping = max(10.0 * damping, 1e-3)
        else:
            break
        x, damping = tried, 0.1 * damping
        steps.append(x)
        if np.abs(steps[-1] / steps[-2] - 1.0).max() < 1e-7 or now - cost(r) < 1e-9 * now:
            break
    J = plays.jacobian(x, plays.play(x), differences) / NOISE
    return Fit(np.array(steps), np.asarray(np.linalg.inv(J.T @ J), np.float64), plays.count - before)


def recordings(plays: Plays, draws: int, seed: int) -> tuple[Doubles, Doubles]:
    """Recorded places with other noise, and starts that are off."""
    random = np.random.default_rng(seed)
    exact = plays.places(plays.play(TRUTH))
    starts = TRUTH * (1.0 + OFF * random.normal(size=(draws, 5)))
    return exact + NOISE * random.normal(size=(draws, *exact.shape)), np.clip(starts, 1.05 * LOW, 0.995 * HIGH)


def fit_all(plays: Plays, recorded: Doubles, starts: Doubles, differences: bool = False) -> tuple[list[Fit], float]:
    """The fits of all recordings, and the processor time that they took, s."""
    begin, fits = time.process_time(), list[Fit]()
    for seen, start in tqdm(zip(recorded, starts), total=len(starts), desc="fitting", unit=" fits", disable=None):
        fits.append(fit(plays, seen, start, differences))
    return fits, time.process_time() - begin


def solved(fits: list[Fit]) -> npt.NDArray[np.bool_]:
    """Which fits found the truth within 5 %; the others stopped where the balls meet something else."""
    return np.array([np.abs(one.found / TRUTH - 1.0).max() < 0.05 for one in fits])


def errors(fits: list[Fit]) -> Doubles:
    """What was found less the truth, in stated standard deviations, (n, 5): standard normal, if all is well."""
    return np.array([(one.found - TRUTH) / np.sqrt(one.covariance.diagonal()) for one in fits])


def draw(out: str, plays: Plays, recorded: Doubles, fits: list[Fit]) -> None:
    """The picture: a shot before and after the fit, the way of the constants, and what all recordings gave."""
    figure, (above, way, cloud) = picture.start(3, (12.6, 4.0), width_ratios=(1.65, 1, 1))
    shown = next(one for one, good in zip(fits, solved(fits)) if good)
    which = next(k for k, one in enumerate(fits) if one is shown)

    # one shot with the constants of the start and of the end
    picture.draw_table(above, table)
    above.set_anchor("N")
    shot = 3
    for x, style, wide in ((shown.steps[0], ":", 1.2), (shown.found, "-", 1.5)):
        r = plays.play(x).positions(np.linspace(0.0, TIMES[-1], 400))[shot, :, :, :2]
        for ball, color in enumerate((picture.BLUE, picture.ORANGE)):
            above.plot(r[:, ball, 1], -r[:, ball, 0], style, color=color, lw=wide, zorder=3)
    seen = recorded[which, shot]
    above.plot(seen[..., 1], -seen[..., 0], ".", color=picture.RED, ms=5, zorder=4)
    above.set_title("One of eight shots, by the start (dotted) and by the fit")
    lines = [f"{name:20} {value:.5f} ± {np.sqrt(variance):.5f}" for name, value, variance in zip(NAMES, shown.found, shown.covariance.diagonal())]
    above.text(0, -0.03, "\n".join(lines), transform=above.transAxes, va="top", family="DejaVu Sans Mono", fontsize=8.5, linespacing=1.5)

    # how each constant comes near
    for k, (name, color) in enumerate(zip(NAMES, (picture.BLUE, picture.ORANGE, picture.GREEN, picture.RED, picture.PURPLE))):
        way.semilogy(np.abs(shown.steps[:, k] / TRUTH[k] - 1.0), "o-", color=color, ms=3.5, label=name)
    way.set(title="Off by, of the constant", xlabel="step", ylim=(1e-5, 1))
    way.legend(frameon=False, fontsize=8)

    # the two constants of the cushion, and the ellipses that the first fit states
    good = [one for one, yes in zip(fits, solved(fits)) if yes]
    off = 1e3 * np.array([one.found[3:] - TRUTH[3:] for one in good])
    cloud.plot(off[:, 0], off[:, 1], ".", color=picture.GREY, ms=4, alpha=0.6)
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    root = np.linalg.cholesky(shown.covariance[3:, 3:])
    distance = np.array([one.found[3:] - TRUTH[3:] for one in good]) @ np.linalg.inv(root).T
    for deviations in (1, 2):
        ring = 1e3 * deviations * root @ np.stack([np.cos(angle), np.sin(angle)])
        inside = np.mean((distance**2).sum(axis=1) < deviations**2)
        cloud.plot(ring[0], ring[1], color=picture.BLUE, lw=1.5, label=f"{deviations} σ: {inside:.0%} inside")
    cloud.legend(frameon=False, fontsize=8)
    cloud.set(title=f"{len(good)} recordings, other noise", xlabel="friction of the cushion − truth (0.001)")
    cloud.set_ylabel("restitution of the cushion − truth (0.001)")
    picture.save(figure, out)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=200, help="sets of recordings to fit")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="fit_shots.svg", help="the picture, .svg or .png")
    given = parser.parse_args(arguments)
    plays = Plays(given.seed)
    recorded, starts = recordings(plays, given.draws, given.seed)
    fits: list[Fit] = []
    for differences in (True, False):
        fits, took = fit_all(plays, recorded, starts, differences)
        played = np.median([one.played for one in fits])
        what = "differences" if differences else "tangents"
        near = f"{solved(fits).sum()} of {len(fits)} fits within 5 %"
        print(f"{what:11}: {near}, {played:.0f} shots in the median, {1e3 * took / len(fits):.1f} ms a fit")
    good = [one for one, yes in zip(fits, solved(fits)) if yes]
    z = np.abs(errors(good))
    for k, name in enumerate(NAMES):
        deviation = np.sqrt(good[0].covariance[k, k])
        within = f"{np.mean(z[:, k] < 1):.0%} within 1 sigma, {np.mean(z[:, k] < 2):.0%} within 2"
        print(f"{name:20} {good[0].found[k]:8.5f} +- {deviation:.5f}  truth {TRUTH[k]:<5g} {within}")
    draw(given.out, plays, recorded, fits)


if __name__ == "__main__":
    main()
