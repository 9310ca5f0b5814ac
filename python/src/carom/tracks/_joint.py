"""Constants from all complete shots together.

The cost of a set of constants is the sum over shots of n m log(1 + c/(n m)), where c is the
smallest cost of a strike (`_strikes`), n the number of its samples and m twice the median of c/n,
so that shots with missed events do not dominate; plus the priors of the constants, ((c - c_0)/s)^2
each. As the fit approaches the noise, m decreases and the priors count less. With the derivatives
J_c and J_p of the distances by the constants and by one shot's strike, the strike follows a step dc
of the constants by -(J_p^T W J_p)^-1 J_p^T W J_c dc. Inserted into the normal equations of dc, this
leaves (variable projection)

    sum over shots of (J_c^T W J_c - J_c^T W J_p (J_p^T W J_p)^-1 J_p^T W J_c) dc = - sum of (J_c^T
    W d - J_c^T W J_p (...)^-1 J_p^T W d).

A step of Levenberg and Marquardt's method is accepted if the cost decreases after every strike has
descended. The first seconds are fitted first, because later samples depend on earlier events, and
small errors of the constants grow beyond the range of a descent. Because a shot's cost jumps when
events appear and vanish, all strikes are searched again from time to time. At the end Newton steps
with derivatives in double precision lead into the minimum (`finish`).
"""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from carom import dtypes
from carom._carom import lib
from carom.dtypes import Doubles
from carom.layouts import balls
from carom.status import CaromError
from carom.tracks._constants import SLOPE
from carom.tracks._search import find
from carom.tracks._strikes import HUBER, Plays, derivatives, descend, normal

# m^2: a shot whose cost a sample is more does not count; that of samples that are 8 cm off
MOST = 1.4e-3
# What one deviation of a prior costs, m^2: the variance of the noise, and so many times what a
# sample is off by beyond the noise, as the misfits of a shot that follow from one error are no
# independent evidence; at most that of samples that are 2 cm off.
ALIKE, PRIOR_MOST = 300.0, 0.1
# Of each constant: the deviation of its prior, about the value that single events gave, and its
# bounds.
PRIORS = {
    "mu_slide": (0.02, 0.01, 1.0),
    "mu_roll": (5e-4, 1e-4, 0.1),
    "drag": (4e-3, 0.0, 0.2),
    "mu_spin": (3e-3, 1e-4, 0.5),
    "law_a": (0.03, 0.0, 0.4),
    "law_b": (0.2, 0.0, 0.6),
    "restitution": (0.03, 0.3, 1.0),
    "restitution_cushion": (0.03, 0.2, 1.0),
    "mu_cushion": (0.06, 0.0, 1.0),
    "roll_loss": (0.06, 0.0, 0.5),
    "nose_height": (1.8e-3, 0.0, np.inf),
    "restitution_log": (0.01, -0.2, 0.2),
    "mu_log": (0.01, -0.2, 0.2),
}
# Properties of a table, not laws: with deviations so wide that five shots outweigh them.
TABLE = {
    "restitution_cushion": 0.12,
    "mu_cushion": 0.12,
    "nose_height": 1.8e-3,
    "mu_slide": 0.04,
    "mu_roll": 1e-3,
    "drag": 8e-3,
    "slope_x": 1e-3,
    "slope_y": 1e-3,
}
_STEEPEST = 2.5e-3  # of a slope along x or y, so that balls come to rest
# Relative sizes of errors on synthetic recordings, whose truth is known.
_SHAPE = {
    "mu_slide": 1.2e-3,
    "mu_roll": 1.5e-5,
    "drag": 6e-4,
    "mu_spin": 6e-5,
    "law_a": 4e-3,
    "law_b": 0.03,
    "restitution": 3e-3,
    "restitution_cushion": 9e-4,
    "mu_cushion": 9e-4,
    "roll_loss": 3e-3,
    "nose_height": 8e-5,
    "restitution_log": 2e-3,
    "mu_log": 2e-3,
    "slope_x": 3e-6,
    "slope_y": 3e-6,
}
_WIDE = 10.0  # a wider range does not determine the deviation of a constant
# the deviation of a prior of other constants over the width of their range, and _SHAPE over the
# deviation
_OTHER = 0.1
_ABOUT = 0.5  # and over the value that a constant begins with, where its range is wide
_STEP = 1e-3  # of the differences, in deviations
_FARTHEST = 0.3  # m: what one deviation of the priors moves farther counts less
ROUNDS, _NEAR = (
    4,
    0.1,
)  # Newton's steps at the end, at most; and one so many standard errors long is the last
_HORIZONS = (3.0, 6.0, np.inf, np.inf)  # samples up to a time (s), one search after another
_ELSEWHERE = 4  # the stage before which a search may begin again
_AT_NOISE = 4.0  # variances of a coordinate: twice the cost a sample that noise alone gives
_STEPS = 12  # at most, of each
# What a search leaves of each constant, over _SHAPE and the misfit over that of the noise: above
# _CLEAR times the noise it stopped early, and so much more for each time.
_LEFT, _CLEAR, _STOPPED = 0.1, 1.2, 1.0
LEAST = 8  # shots, that errors follow from


def prior(name: str, begin: float = 0.0) -> tuple[float | None, float, float]:
    """The deviation of a constant's prior for an initial value, or None if it must be given, and
    its bounds.
    """
    if name in PRIORS:
        return PRIORS[name]
    if name in SLOPE:
        return TABLE[name], -_STEEPEST, _STEEPEST
    row = lib.carom_number_of(lib.CAROM_PART_BALL, list(dtypes.ball_kind.names or ()).index(name))
    width = row.high - row.low
    return (_OTHER * width if width <= _WIDE else _ABOUT * abs(begin) or None), row.low, row.high


def damped(square: Doubles) -> Doubles:
    """J_p^T W J_p, (..., 6, 6), increased enough to be inverted if no sample determines a parameter
    of the strike.

    A larger increase would hold back the strikes, whose parameters depend on each other; constants
    would then creep along a valley and stop in it.
    """
    diagonal, larger = np.arange(6), square.copy()
    larger[..., diagonal, diagonal] = square[..., diagonal, diagonal] * (1.0 + 1e-8) + 1e-12
    return larger


class Search:
    """The search for constants with the shots `rows`, starting from `strikes`, (shots, 6).

    `priors` contains the mean and the deviation of each constant to find.
    """

    def __init__(
        self,
        plays: Plays,
        strikes: Doubles,
        rows: Sequence[int],
        priors: Mapping[str, tuple[float, float]],
    ) -> None:
        self.rows = np.array([row for row in rows if np.isfinite(strikes[row]).all()], np.int32)
        self.plays, self.names = plays, list(priors)
        self.values = np.array([plays.constants[name] for name in priors])
        self.first, self.scale = np.array(list(priors.values())).T
        self.low, self.high = np.array([prior(name)[1:] for name in priors]).T
        self.strikes, self.ends = strikes[self.rows], plays.ends[self.rows]
        self.counts = plays.counts[self.rows].astype(float)
        self.noise, self.prior_cost, self.middle = plays.recordings[0].noise, PRIOR_MOST, MOST

    def constants(self, values: Doubles) -> dict[str, float]:
        return {**self.plays.constants, **dict(zip(self.names, values.tolist()))}

    def cost(self, values: Doubles, strikes: Doubles, iterations: int) -> tuple[float, Doubles]:
        """The cost of constants after the strikes have descended, and the strikes."""
        self.plays.set(self.constants(values))
        strikes, sums = descend(self.plays, self.rows, strikes, self.ends, iterations)
        prior = self.prior_cost * float((((values - self.first) / self.scale) ** 2).sum())
        return float(
            self.counts @ (self.middle * np.log1p(sums[:, 0] / self.counts / self.middle))
        ) + prior, strikes

    def step(self, damping: float, cost: float) -> tuple[float, float]:
        """Take a step; returns the cost after it, unchanged if no step was found, and the next
        damping.
        """
        self.plays.set(self.constants(self.values), dict(zip(self.names, _STEP * self.scale)))
        most = MOST * self.counts
        sums = self.plays.misfit(self.rows, self.strikes, self.ends, most)
        counted = sums[:, 0] < most
        # in deviations of the constants
        square, gradient = normal(sums)
        size = np.concatenate([np.ones(6), self.scale])
        square, gradient = square * np.outer(size, size), gradient * size
        weight = 1.0 / (1.0 + sums[:, 0] / self.counts / self.middle)
        square, gradient = square * weight[:, None, None], gradient * weight[:, None]
        # the strikes put in; what no sample depends on stays where it is
        square[~counted] = np.eye(square.shape[1])
        P, X, C = damped(square[:, :6, :6]), square[:, :6, 6:], square[:, 6:, 6:]
        follow = np.linalg.solve(P, np.concatenate([X, gradient[:, :6, None]], axis=2))
        whole = (C - np.swapaxes(X, 1, 2) @ follow[..., :-1])[counted].sum(axis=0)
        slope = (gradient[:, 6:] - (np.swapaxes(X, 1, 2) @ follow[..., -1:])[..., 0])[counted].sum(
            axis=0
        )
        whole[np.diag_indices(len(whole))] += self.prior_cost
        slope = slope + self.prior_cost * (self.values - self.first) / self.scale
        for _ in range(6):
            shorter = whole + damping * np.diag(whole.diagonal())
            values = np.clip(
                self.values - self.scale * np.linalg.solve(shorter, slope), self.low, self.high
            )
            moved = (values - self.values) / self.scale
            strikes = self.strikes - np.where(
                counted[:, None], follow[..., :-1] @ moved + follow[..., -1], 0.0
            )
            # a strike follows, or stays where that is better
            self.plays.set(self.constants(values))
            both = np.stack([strikes, self.strikes])
            costs = [
                self.plays.misfit(self.rows, candidates, self.ends, -np.inf)[:, 0]
                for candidates in both
            ]
            best = np.where((costs[0] < costs[1])[:, None], both[0], both[1])
            new, best = self.cost(values, best, 4)
            if new < cost:
                self.values, self.strikes = values, best
                return new, max(0.2 * damping, 1e-8)
            damping *= 6.0
        return cost, damping

    def anew(self, seed: int) -> None:
        """Search all strikes again, and keep the better ones."""
        self.plays.set(self.constants(self.values))
        current = self.plays.misfit(self.rows, self.strikes, self.plays.ends[self.rows], -np.inf)[
            :, 0
        ]
        found, costs = find(self.plays.some(self.rows), seed)
        better = costs < current
        self.strikes[better] = found[better]

    def weigh(self) -> float:
        """Set the weights of shots and priors from the median over the shots of the cost per
        sample.
        """
        sums = self.plays.misfit(self.rows, self.strikes, self.ends, -np.inf)
        self.counts = np.maximum(sums[:, 2], 1.0)
        middle = float(np.median(sums[:, 0] / self.counts)) if len(sums) else MOST
        self.middle = min(max(2.0 * middle, _AT_NOISE * self.noise**2), MOST)
        self.prior_cost = min(
            self.noise**2 + ALIKE * max(middle - 2.5 * self.noise**2, 0.0), PRIOR_MOST
        )
        return middle

    def equations(self) -> tuple[Doubles, Doubles, dict[int, Doubles]]:
        """The normal equations of all shots from derivatives in double precision, without the
        strikes, in deviations.

        Returns their matrix, (n, n), with the priors; each shot's gradient, (shots, n); and for
        each shot the response of its strike, (6, n + 1), to the constants and its own step.
        """
        plays, n = self.plays, len(self.names)
        plays.set(self.constants(self.values))
        whole, gradients, follow = self.prior_cost * np.eye(n), [], {}
        for index, (row, strike) in enumerate(zip(self.rows, self.strikes)):
            try:
                d, X, C, _ = derivatives(plays, int(row), strike, self.names, rest=False)
            except CaromError:
                continue  # the play ends in an error
            C = C * self.scale
            size = (d.reshape(-1, 2) ** 2).sum(axis=1)
            root = np.sqrt(1.0 + size / HUBER**2)
            size_of_cost = 2.0 * HUBER**2 * float((root - 1.0).mean())
            if size_of_cost >= MOST:
                continue  # it does not count in the search either
            root = root * (1.0 + size_of_cost / self.middle)
            # a derivative is meaningless beyond its reach
            moved = (C.reshape(len(size), -1) ** 2).sum(axis=1)
            W = np.repeat(np.minimum(1.0, _FARTHEST**2 / np.maximum(moved, 1e-12)) / root, 2)[
                :, None
            ]
            follow[index] = np.linalg.solve(
                damped(X.T @ (W * X)), X.T @ (W * np.column_stack([C, d]))
            )
            A = C - X @ follow[index][:, :-1]
            whole += C.T @ (W * A)
            gradients.append(A.T @ (W[:, 0] * d))
        return whole, np.array(gradients).reshape(-1, n), follow

    def moved(self, part: float, step: Doubles, follow: Mapping[int, Doubles], seed: int) -> Search:
        """The search after a fraction of a Newton step; each strike is updated, kept or searched
        again, whichever is best.
        """
        trial = copy.copy(self)
        trial.values = np.clip(self.values + part * self.scale * step, self.low, self.high)
        strikes = self.strikes.copy()
        for index, change in follow.items():
            strikes[index] -= part * (change[:, :-1] @ step) + change[:, -1]
        both = np.stack(
            [trial.cost(trial.values, candidates, 6)[1] for candidates in (strikes, self.strikes)]
        )
        costs = [
            self.plays.misfit(self.rows, candidates, self.ends, -np.inf)[:, 0]
            for candidates in both
        ]
        trial.strikes = np.where((costs[0] < costs[1])[:, None], both[0], both[1])
        trial.anew(seed)
        _, trial.strikes = trial.cost(trial.values, trial.strikes, 4)
        return trial

    def finish(self, seed: int, rounds: int) -> list[Any]:
        """Newton steps with derivatives in double precision, as long as half of the shots improve.

        The finite differences of `step` have the noise of single precision, and creep if a small
        change of a strike moves a shot far. On synthetic recordings they end up to seven standard
        errors from the truth; after one to three of these steps the error is below one.
        """
        self.ends = self.plays.ends[self.rows]
        middle = self.weigh()
        for number in range(rounds):
            whole, gradients, follow = self.equations()
            slope = (
                gradients.sum(axis=0) + self.prior_cost * (self.values - self.first) / self.scale
            )
            step = -np.linalg.solve(whole, slope)
            for part in (1.0, 0.3):
                trial = self.moved(part, step, follow, seed + number)
                if (new := trial.weigh()) < middle:
                    break
            else:
                break
            middle = new
            self.resume([trial.values, trial.strikes, trial.middle, trial.prior_cost])
            self.counts = trial.counts
            inverse = np.linalg.inv(whole)
            if (
                np.abs(step)
                < _NEAR * np.sqrt((inverse @ (gradients.T @ gradients) @ inverse).diagonal())
            ).all():
                break
        return [self.values.tolist(), self.strikes.tolist(), self.middle, self.prior_cost]

    def stage(self, number: int, seed: int) -> list[Any]:
        """One of STAGES searches: the constants and the strikes, as `resume` takes them."""
        if number >= len(_HORIZONS) and self.middle < 1.1 * _AT_NOISE * self.noise**2:
            return [
                self.values.tolist(),
                self.strikes.tolist(),
                self.middle,
                self.prior_cost,
            ]  # nothing is left to find
        if number == _ELSEWHERE and self.middle > 2.5 * _AT_NOISE * self.noise**2:
            # a search that stopped early begins again elsewhere
            trial = copy.copy(self)
            moved = self.values + 0.5 * self.scale * np.random.default_rng(seed).normal(
                size=len(self.values)
            )
            trial.values, trial.strikes = np.clip(moved, self.low, self.high), self.strikes.copy()
            for earlier in range(1, len(_HORIZONS)):
                trial.stage(earlier, seed + _ELSEWHERE)
            if trial.middle < self.middle:
                self.resume([trial.values, trial.strikes, trial.middle, trial.prior_cost])
        if number:
            self.anew(seed + number)
        self.ends = np.minimum(
            _HORIZONS[min(number, len(_HORIZONS) - 1)], self.plays.ends[self.rows]
        )
        _, self.strikes = self.cost(self.values, self.strikes, 4)
        self.weigh()
        cost, _ = self.cost(self.values, self.strikes, 0)
        damping = 1e-2
        for _ in range(_STEPS):
            previous = cost
            cost, damping = self.step(damping, cost)
            if cost > previous * (1.0 - 1e-3) and (cost == previous or damping < 1e-5):
                break
        return [self.values.tolist(), self.strikes.tolist(), self.middle, self.prior_cost]

    def resume(self, found: Sequence[Any]) -> None:
        """Continue from the result of a stage."""
        self.values, self.strikes = np.array(found[0]), np.array(found[1])
        self.middle, self.prior_cost = found[2:]


def without_slip(search: Search) -> Search:
    """The same search before its first stage, with a friction that does not depend on slip: only
    law_a.

        If the true friction does not depend on slip, a search that starts from a law with slip may
        stop at several times the noise, because law_a and law_b are correlated.
    """
    priors = {
        name: (mean, scale)
        for name, mean, scale in zip(search.names, search.first.tolist(), search.scale.tolist())
        if name != "law_b"
    }
    kind = balls([[0.0, 0.0]], game="billiard")["kind"][0]
    priors["law_a"] = (float(kind["mu_ball"]), PRIORS["law_a"][0])
    plays = search.plays.some(range(len(search.plays.recordings)))
    plays.set({**plays.constants, "law_a": priors["law_a"][0], "law_b": 0.0})
    strikes = np.full((len(plays.recordings), 6), np.nan)
    strikes[search.rows] = search.strikes
    return Search(plays, strikes, range(len(strikes)), priors)


STAGES = 5  # the last horizon is searched again and again


def left(search: Search) -> Doubles:
    """The remaining error of each constant, which grows with the misfit above the noise."""
    above = min(math.sqrt(0.25 * search.middle) / search.noise, 6.0)
    shape = np.array(
        [
            _SHAPE.get(name, _OTHER * scale)
            for name, scale in zip(search.names, search.scale.tolist())
        ]
    )
    return (_LEFT * above + _STOPPED * max(above - _CLEAR, 0.0)) * shape
