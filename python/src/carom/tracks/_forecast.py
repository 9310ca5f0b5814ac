"""Forecasts: what may come after the first seconds of a recorded shot.

The strike p is fitted to the rows of the first t seconds alone. It is not exact, nor are the
constants c, the places of rest r and the models of contacts. A draw has all four errors.

1. Strike, constants and places of rest. With the cost E(p, c, r), the sum over the coordinates of
   the first rows of their squared distances d^2 (beyond 1 cm linear in d, as in `_strikes`), and
   its least value per row s^2, the posterior is

       log P = - E / (2 s^2 T) - c^T C^-1 c / 2 - r^2 / (2 rho^2),

   where C is the covariance of the constants and rho the error of a place of rest. T, TEMPERATURE,
   says how much less rows tell than independent ones, as errors of the models last from row to row.

   P has edges where events change, so a normal distribution about its top is much too wide.
   Particles are drawn from that normal distribution Q and moved by sequential Monte Carlo (Del
   Moral, Doucet and Jasra, J. R. Stat. Soc. B 68, 2006, 411) along Q^(1-b) P^b, b from 0 to 1: a
   step of b leaves half of the particles' weight, they are drawn again by their weights, and each
   makes MOVES steps of Metropolis's, as long as their own covariance says.

2. Models. After t each contact has a kick, as `_kicks` has them: normal with KICK times the
   deviations that single contacts of recorded shots have.

`reality.py --forecast 2` of the examples counts how many recorded places lie in the regions of 68 and
95 %, and found T and KICK: 69 and 98 % of the match of 2017, 66 and 91 % of that of 2022. With a KICK
of 2 these are 66 and 97 %, 62 and 90 %; with a KICK of 2.2 and 1.6 times T 74 and 98 %, 62 and 91 %.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from carom import pictures
from carom._carom import lib
from carom._rows import Arrays
from carom.dtypes import Doubles
from carom.status import CaromError
from carom.tracks import _kicks, _recordings, _strikes
from carom.tracks._recordings import Recording

SHARES = (0.68, 0.95)
TEMPERATURE = 1000.0
KICK = 2.8
MOVES = 4
_HALF = 0.5  # of the particles' weight that a step of b leaves
_STEP = 1.2  # of a move, in deviations over the root of the dimension: 2.4 is best for a normal P
# an RMSE so many times that of the noise is no longer ok: with the true constants nine in ten shots
# are below
ROUGH = 2.0
_LONG = 100.0  # s: longer than a shot lasts
_APART = 0.5  # s between the regions of to_dict()


@dataclass(frozen=True, eq=False, repr=False)
class Forecast(Arrays):
    """Draws of what may come after the first seconds of a recorded shot."""

    recording: Recording
    after: float  # s from the first motion: the strikes know the rows until then
    until: float  # s, the same on the clock of the recording
    numbers: Doubles  # (draws, 6 + 5 * 16): Strikes, on the clock of the plays, and kicks
    plays: _strikes.Plays  # A shot for each draw, with its constants and places of rest

    def positions(self, times: npt.ArrayLike) -> Doubles:
        """The centres of all balls in all draws at times of the recording's clock, m: shape (draws,
        times..., balls, 2).
        """
        at = np.asarray(times, np.float64)
        sorted_times, back = np.unique(at, return_inverse=True)
        on_clock = sorted_times - self.plays.origins[0]
        places = [
            self.plays.played(k, numbers, on_clock)[1].transpose(1, 0, 2)[back.reshape(at.shape)]
            for k, numbers in enumerate(self.numbers)
        ]
        return np.array(places)

    def regions(
        self, times: npt.ArrayLike, shares: npt.ArrayLike = SHARES
    ) -> tuple[Doubles, Doubles]:
        """Where balls will be: centres, m, of shape (times..., balls, 2), and radii, m, of shape
        (shares..., times..., balls), of the circles that hold these shares of the draws.

        A centre is the median of the draws. A radius is at least three deviations of the noise.
        """
        places = self.positions(times)
        middle: Doubles = np.median(places, axis=0)
        off = np.linalg.norm(places - middle, axis=-1)
        given = np.asarray(shares, np.float64)
        return middle, np.maximum(np.quantile(off, given, axis=0), 3.0 * self.recording.noise)

    def later(self) -> tuple[Doubles, npt.NDArray[np.int64]]:
        """The rows of the recording (t, x, y) after the first seconds, and the ball of each."""
        parts = [track[track[:, 0] > self.until] for track in self.recording.tracks]
        return np.concatenate(parts), np.repeat(np.arange(len(parts)), list(map(len, parts)))

    def covered(self, shares: npt.ArrayLike = SHARES) -> Doubles:
        """Which part of the later rows is in the regions of these shares; nan without any."""
        rows, balls = self.later()
        if not len(rows):
            return np.full(np.shape(shares), np.nan)
        middle, radii = self.regions(rows[:, 0], shares)
        each = np.arange(len(rows))
        off = np.linalg.norm(rows[:, 1:] - middle[each, balls], axis=-1)
        return np.asarray((off <= radii[..., each, balls]).mean(axis=-1))

    def to_dict(self) -> dict[str, Any]:
        """Where balls will be each half a second until the recording ends, of numbers that JSON
        has.
        """
        end = max(float(track[-1, 0]) for track in self.recording.tracks)
        times = np.arange(self.until + _APART, max(end, self.until + _APART) + 1e-9, _APART)
        middle, radii = self.regions(times)
        return {
            "id": self.recording.id,
            "after": self.after,
            "times": times.tolist(),
            "centres": middle.tolist(),
            "radii": radii.tolist(),
        }

    def plot(self, waits: npt.ArrayLike = (1.0, 2.0, 4.0)) -> pictures.Picture:
        """The regions so many seconds after the last one that is known, as circles of 68 and 95 %,
        on the recorded places, dots. Its `svg` is the text of a file.
        """
        given = np.asarray(waits, np.float64)
        middle, radii = self.regions(self.until + given)
        marks = [
            (
                middle[k, ball],
                float(radii[share, k, ball]),
                f"ball {name} {wait:g} s later: {100 * part:.0f} %",
                f"{wait:g} s" if share else "",
            )
            for k, wait in enumerate(given.tolist())
            for ball, name in enumerate(self.recording.balls)
            for share, part in enumerate(SHARES)
            if radii[0, k, ball] > 3.0 * self.recording.noise
        ]
        seen = [track[:, 1:] for track in self.recording.tracks]
        return pictures.Picture(pictures.picture(self.plays.table, None, seen, marks))


def first_seconds(recording: Recording, after: float) -> Recording:
    """The rows until `after` seconds from the first motion, and at least one of each ball."""
    until = recording.moves.min() + after
    rows = [(track[:, 0] <= until) | (np.arange(len(track)) == 0) for track in recording.tracks]
    return replace(
        recording, tracks=tuple(track[keep] for track, keep in zip(recording.tracks, rows))
    )


def forecast(fit: Any, whole: Recording, after: float, draws: int, seed: int) -> Forecast:
    """By the constants of a `Fit`, of the first seconds of a recording."""
    random = np.random.default_rng(seed)
    particles = _Particles(_part(fit, whole, after, seed), draws, random)
    particles.anneal(random)
    strikes = particles.lay(particles.numbers)
    plays, until = particles.plays, float(whole.moves.min() + after)
    plays.ends = np.full(draws, _LONG)
    numbers = _kicked(plays, strikes, until - plays.origins[0], random)
    good = np.isfinite(numbers[:, 0])
    plays.layouts = plays.layouts[:, good]
    return Forecast(whole, after, until, numbers[good], plays)


def _part(fit: Any, whole: Recording, after: float, seed: int) -> Any:
    """A `Fit` of the first seconds alone, with the constants of another."""
    (part,), _ = _recordings.sound([first_seconds(whole, after)], fit.noise)
    plays = _strikes.Plays([part], fit.table, fit.radius, fit.constants, fit.cushion_model)
    found, _ = _strikes.find(plays, seed, squares=True)
    rmse = plays.rmse(found)
    if ROUGH * fit.noise * np.sqrt(2.0) < rmse[0] < np.inf:
        other = _kicks.eased(plays, found)
        if plays.rmse(other)[0] < rmse[0]:
            found, rmse = other, plays.rmse(other)
    if not np.isfinite(rmse[0]):
        raise ValueError(f"shot: in its first {after:g} s no strike was found that can be played")
    found[:, 5] += plays.origins
    return replace(fit, recordings=[part], strikes=found, status=["ok"], rmse=rmse, train=None)


def _kicked(
    plays: _strikes.Plays, strikes: Doubles, after: float, random: np.random.Generator
) -> Doubles:
    """Strikes with random kicks of the contacts after a time of the plays' clock; nan where a play
    ends in an error.

    A kick changes which contacts follow. So the kicks of one contact after the other are as large
    as its kind asks, until the kinds of all are those of the play.
    """
    kicks = KICK * random.normal(size=(len(strikes), _kicks.CONTACTS, _strikes.KICKS))
    numbers = np.zeros((len(strikes), 6 + kicks[0].size))
    numbers[:, :6] = strikes
    for row, own in enumerate(numbers):
        for _ in range(_kicks.CONTACTS + 1):
            met = _kicks.contacts(plays, row, own)
            sizes = np.zeros(kicks[row].shape)
            balls = met["type"] == lib.CAROM_EVENT_BALL_BALL
            sizes[: len(met)] = np.where(balls[:, np.newaxis], _kicks.BALLS, _kicks.CUSHION)
            sizes[: len(met)][met["time"] + own[5] <= after] = 0.0
            wanted = (sizes * kicks[row]).ravel()
            if np.array_equal(wanted, own[6:]):
                break
            own[6:] = wanted
        try:
            plays.played(row, own)
        except CaromError:
            own[:] = np.nan
    return numbers


class _Particles:
    """Strikes, constants and places of rest, (particles, 6 + constants + 2 balls), as they may
    have been: numbers less those of the fit.
    """

    def __init__(self, fit: Any, count: int, random: np.random.Generator) -> None:
        self.fit = fit
        self.own, follow, self.rest = fit._strike_off(0)
        m = len(fit.fitted)
        covariance: Doubles = np.zeros((m, m))
        if fit.covariance is not None:
            covariance = fit.covariance
        self.follow = follow
        by = np.zeros((count, m))
        if m:
            by = random.multivariate_normal(np.zeros(m), covariance, count)
        others = np.hstack([by, random.normal(0.0, self.rest, (count, len(self.rest)))])
        strikes = random.multivariate_normal(np.zeros(6), self.own, count)
        self.numbers = np.hstack([strikes + others @ self.follow.T, others])
        # the inverses of what the normal distributions have, by the strike and by the others
        self.to_own = np.linalg.inv(self.own)
        prior = np.zeros((m + len(self.rest),) * 2)
        prior[:m, :m] = np.linalg.pinv(covariance)
        prior[m:, m:] = np.diag(self.rest**-2)
        self.to_others = prior
        plays = _strikes.Plays(
            fit.recordings * count,
            fit.table,
            fit.radius,
            fit.constants,
            fit.cushion_model,
        )
        self.plays, self.ends = plays, plays.ends
        self.rows = np.arange(count, dtype=np.int32)
        best = self.costs(np.zeros((1, self.numbers.shape[1])))[0]
        self.variance = TEMPERATURE * best / max(2.0 * plays.counts[0] - 6.0, 1.0)

    def lay(self, numbers: Doubles) -> Doubles:
        """Gives the plays the layouts of particles, just before the strikes, which are returned, on
        the plays' clock.
        """
        m, fit = len(self.fit.fitted), self.fit
        moved = numbers[:, 6 + m :].reshape(len(numbers), -1, 2)
        strikes = fit.strikes[0] + numbers[:, :6]
        changed = fit.changed(numbers[:, 6 : 6 + m])
        _, layouts = fit._struck(0, strikes, moved, changed)
        layouts["state"]["v"], layouts["state"]["w"] = 0.0, 0.0
        self.plays.layouts = layouts[np.newaxis]
        strikes[:, 5] -= self.plays.origins[0]
        return np.asarray(strikes)

    def costs(self, numbers: Doubles) -> Doubles:
        """E of each particle; infinite where a play ends in an error."""
        strikes = self.lay(numbers)
        rows = self.rows[: len(numbers)]
        found = self.plays.misfit(rows, strikes, self.ends[: len(numbers)], -np.inf)
        return np.where(np.isfinite(found[:, 0]), found[:, 0], np.inf)

    def logarithms(self, numbers: Doubles) -> tuple[Doubles, Doubles]:
        """log Q and log P."""
        others = numbers[:, 6:]
        off = numbers[:, :6] - others @ self.follow.T
        prior = -0.5 * np.einsum("ni,ij,nj->n", others, self.to_others, others)
        q = prior - 0.5 * np.einsum("ni,ij,nj->n", off, self.to_own, off)
        return q, prior - 0.5 * self.costs(numbers) / self.variance

    def anneal(self, random: np.random.Generator) -> None:
        """Moves the particles from Q to P."""
        q, p = self.logarithms(self.numbers)
        b = 0.0
        while b < 1.0:
            step = _next(p - q, 1.0 - b)
            b = min(b + step, 1.0)
            weights = _weights(step * (p - q))
            chosen = random.choice(len(weights), len(weights), p=weights)
            self.numbers, q, p = self.numbers[chosen], q[chosen], p[chosen]
            q, p = self.move(b, q, p, random)

    def move(
        self, b: float, q: Doubles, p: Doubles, random: np.random.Generator
    ) -> tuple[Doubles, Doubles]:
        """Metropolis's steps along Q^(1-b) P^b; the logarithms afterwards."""
        varied = self.numbers.std(axis=0) > 0.0
        size = _STEP / np.sqrt(max(varied.sum(), 1))
        spread = np.cov(self.numbers[:, varied], rowvar=False)
        for k in range(MOVES):
            off = random.multivariate_normal(np.zeros(len(spread)), spread, len(q))
            tried = self.numbers.copy()
            # by turns far and near, as edges of events may be close
            tried[:, varied] += size * 0.3 ** (k % 2) * off
            new_q, new_p = self.logarithms(tried)
            gain = (1.0 - b) * (new_q - q) + b * (new_p - p)
            better = np.log(random.random(len(q))) < gain
            self.numbers[better] = tried[better]
            q, p = np.where(better, new_q, q), np.where(better, new_p, p)
        return q, p


def _weights(logarithms: Doubles) -> Doubles:
    weights = np.exp(logarithms - logarithms.max())
    return np.asarray(weights / weights.sum())


def _next(gain: Doubles, most: float) -> float:
    """The step of b that leaves half of the particles' weight, by bisection."""

    def left(step: float) -> float:
        return float(1.0 / (_weights(step * gain) ** 2).sum() / len(gain))

    return most if left(most) >= _HALF else _halved(left, most)


def _halved(left: Callable[[float], float], most: float) -> float:
    low, high = 0.0, most
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if left(middle) >= _HALF else (low, middle)
    return max(low, 1e-6 * most)
