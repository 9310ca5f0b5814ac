"""Forecasts of recorded shots from their first seconds.

The strike, the constants c, the initial positions r and the models of contacts all have errors, and
a draw includes all four.

1. Before. The constants are drawn from their errors. Given these, the strike p, the kicks y of the
   contacts in the first t seconds and the deviations r of the initial positions follow

       log P(p, y, r) = - 1/2 (E(p, y, r)/V + sum of y^2/s^2 + sum of r^2/q^2 + sum of p^2/b^2),

   where E is the cost of `_strikes`, s is m times the deviations of `_kicks`, which single contacts
   of recorded shots have, q is the error of an initial position, and b are the bounds of a strike.
   m <= 1 is the size of the errors of the models, by the kicks of the fitted shots
   (`Fit.model_error`): 1 on recorded matches, near 0 where carom's own laws played. V is the
   variance of a coordinate: m^2 PRICE of `_kicks`, or what the best play leaves per row less the
   variance of the noise where that is more, and at least the variance of the noise.

   Levenberg and Marquardt's method finds the maximum of P, and its normal equations the normal
   distribution about it (Laplace's approximation). A chain for each draw begins with a value of this
   distribution and takes Metropolis steps of P, which has edges where events change. `effective`
   counts the draws that no longer depend on where their chains began.

   If the best play misses the known rows by far more than noise and models explain, its strike is
   not the player's, and there is no forecast.

2. After. Each later contact has a kick, normal with the deviations s.

Kicks tie the draws to the last places that are known, which strikes alone miss by a centimetre.
`reality.py --forecast 2,4` of the examples counts how many recorded places lie in the regions of
68 and 95 %.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import pictures
from carom._rows import Arrays
from carom.dtypes import Doubles
from carom.status import CaromError
from carom.tracks import _covariance, _kicks, _recordings, _search, _strikes
from carom.tracks._recordings import Recording

SHARES = (0.68, 0.95)
_DESCENT = 10  # iterations of the descent to the maximum of P, at most
_CHAIN = 60  # Metropolis steps of a draw
# The length of a step over the deviations of the normal distribution and the root of the number of
# parameters; one in three steps is shorter, because edges of P stop long ones.
_STEP, _SHORTER = 2.0, 0.25
# The known rows are off by so many times the noise, or m times so much (m), where no strike was found
_NOISES, _FAR = 5.0, 0.02
# an RMSE so many times that of the noise is no longer ok: with the true constants nine in ten shots
# are below
ROUGH = 2.0
_LONG = 100.0  # s: longer than a shot lasts
_APART = 0.5  # s between the regions of to_dict()


@dataclass(frozen=True, eq=False, repr=False)
class Forecast(Arrays):
    """Draws of the continuation of a recorded shot after its first seconds."""

    recording: Recording
    after: float  # s from the first motion: the strikes are fitted to the rows until then
    until: float  # s, the same on the clock of the recording
    numbers: Doubles  # (draws, 6 + 5 * 16): Strikes, on the clock of the plays, and kicks
    plays: _strikes.Plays  # A shot for each draw, with its constants and initial positions
    effective: float  # The number of draws that are independent of the normal approximation

    def positions(self, times: ArrayLike) -> Doubles:
        """Return the centres of all balls in all draws, m, at times of the recording's clock.

        Shape (draws, times..., balls, 2).
        """
        moments = np.asarray(times, np.float64)
        sorted_times, back = np.unique(moments, return_inverse=True)
        on_clock = sorted_times - self.plays.origins[0]
        places = [
            self.plays.played(k, numbers, on_clock)[1].transpose(1, 0, 2)[
                back.reshape(moments.shape)
            ]
            for k, numbers in enumerate(self.numbers)
        ]
        return np.array(places)

    def regions(self, times: ArrayLike, shares: ArrayLike = SHARES) -> tuple[Doubles, Doubles]:
        """Return circles that contain given shares of the draws of each ball.

        Returns centres, m, of shape (times..., balls, 2), which are medians, and radii, m, of shape
        (shares..., times..., balls). The camera's noise is added to each draw, as in the rows.
        """
        places = self.positions(times)
        middle: Doubles = np.median(places, axis=0)
        camera = np.random.default_rng(len(places)).normal(size=places.shape)
        noise = self.recording.deviations(middle)
        off = np.linalg.norm(places + noise * camera - middle, axis=-1)
        levels = np.asarray(shares, np.float64)
        return middle, np.quantile(off, levels, axis=0)

    def later(self, *, moving: bool = False) -> tuple[Doubles, NDArray[np.int64]]:
        """Return the rows (t, x, y) after the first seconds, and the ball of each: all rows, or
        only the moving ones (`Recording.moving`).
        """
        shot = self.recording
        parts = [
            track[rows if moving else slice(None)] for track, rows in zip(shot.tracks, shot.moving)
        ]
        parts = [part[part[:, 0] > self.until] for part in parts]
        return np.concatenate(parts), np.repeat(np.arange(len(parts)), list(map(len, parts)))

    def covered(self, shares: ArrayLike = SHARES, *, moving: bool = False) -> Doubles:
        """Return the fraction of later rows, or of moving ones, in the regions; nan without rows."""
        rows, balls = self.later(moving=moving)
        if not len(rows):
            return np.full(np.shape(shares), np.nan)
        middle, radii = self.regions(rows[:, 0], shares)
        each = np.arange(len(rows))
        off = np.linalg.norm(rows[:, 1:] - middle[each, balls], axis=-1)
        return np.asarray((off <= radii[..., each, balls]).mean(axis=-1))

    def to_dict(self) -> dict[str, Any]:
        """Return the regions every half second until the recording ends, for JSON."""
        end = max(float(track[-1, 0]) for track in self.recording.tracks)
        times = np.arange(self.until + _APART, max(end, self.until + _APART) + 1e-9, _APART)
        middle, radii = self.regions(times)
        return {
            "id": self.recording.id,
            "after": self.after,
            "effective": self.effective,
            "times": times.tolist(),
            "centres": middle.tolist(),
            "radii": radii.tolist(),
        }

    def plot(self, waits: ArrayLike = (1.0, 2.0, 4.0)) -> pictures.Picture:
        """Draw the regions after the first seconds: circles of 68 and 95 %, with the recorded
        positions as dots. `svg` of the result is the text of a file.
        """
        durations = np.asarray(waits, np.float64)
        middle, radii = self.regions(self.until + durations)
        marks = [
            (
                middle[k, ball],
                float(radii[share, k, ball]),
                f"ball {name} {wait:g} s later: {100 * part:.0f} %",
                f"{wait:g} s" if share else "",
            )
            for k, wait in enumerate(durations.tolist())
            for ball, name in enumerate(self.recording.balls)
            for share, part in enumerate(SHARES)
            if radii[0, k, ball] > 3.0 * self.recording.noise  # others are as small as a dot
        ]
        seen = [track[:, 1:] for track in self.recording.tracks]
        return pictures.Picture(pictures.picture(self.plays.table, None, seen, marks))


def first_seconds(recording: Recording, duration: float) -> Recording:
    """The rows until `after` seconds from the first motion, at least one for each ball."""
    end = recording.moves.min() + duration
    rows = [(track[:, 0] <= end) | (np.arange(len(track)) == 0) for track in recording.tracks]
    return replace(
        recording, tracks=tuple(track[keep] for track, keep in zip(recording.tracks, rows))
    )


def forecast(fit: Any, whole: Recording, after: float, draws: int, seed: int) -> Forecast:
    """Forecast a recording from its first seconds with the constants of a `Fit`."""
    random = np.random.default_rng(seed)
    whole, error = replace(whole, noise=fit.noise), fit.model_error
    end = float(whole.moves.min() + after)
    part = _part(fit, whole, after)
    plays, numbers, effective = _Before(part, end, draws, error, random).drawn(random)
    plays.ends = np.full(draws, _LONG)
    numbers = _kicked(plays, numbers, end - plays.origins[0], error, random)
    good = np.isfinite(numbers[:, 0])
    plays.layouts = plays.layouts[:, good]
    return Forecast(whole, after, end, numbers[good], plays, effective)


def _part(fit: Any, whole: Recording, duration: float) -> Any:
    """A `Fit` of only the first seconds, with the constants of another."""
    (part,), _ = _recordings.sound([first_seconds(whole, duration)], fit.noise)
    plays = _strikes.Plays([part], fit.table, fit.radius, fit.constants, fit.cushion_model)
    found, _ = _search.find(plays, squares=True)
    rmse = plays.rmse(found)
    if not np.isfinite(rmse[0]):
        raise ValueError(
            f"shot: no playable strike was found in its first {duration:g} s; use a longer time"
        )
    found[:, 5] += plays.origins
    return replace(fit, recordings=[part], strikes=found, status=["ok"], rmse=rmse, train=None)


def _kicked(
    plays: _strikes.Plays,
    strikes: Doubles,
    duration: float,
    error: float,
    random: np.random.Generator,
) -> Doubles:
    """Strikes and kicks up to a time of the plays' clock, with random kicks of the later contacts.

    nan if a play fails. A kick changes which contacts follow, so kicks are scaled one contact after
    another by its kind until all kinds agree with the play.
    """
    known = strikes.shape[1]
    kicks = random.normal(size=(len(strikes), _kicks.CONTACTS, _strikes.KICKS))
    numbers = np.zeros((len(strikes), 6 + kicks[0].size))
    numbers[:, :known] = strikes
    for row, row_numbers in enumerate(numbers):
        for _ in range(_kicks.CONTACTS + 1):
            met_contacts = _kicks.contacts(plays, row, row_numbers)
            sizes = error * _kicks.deviations(met_contacts)
            sizes[: len(met_contacts)][met_contacts["time"] + row_numbers[5] <= duration] = 0.0
            offsets = (sizes * kicks[row]).ravel()
            offsets[: known - 6] = strikes[row, 6:]
            if np.array_equal(offsets, row_numbers[6:]):
                break
            row_numbers[6:] = offsets
        try:
            plays.played(row, row_numbers)
        except CaromError:
            row_numbers[:] = np.nan
    return numbers


class _Before:
    """P of strike, kicks and initial positions in the first seconds, with a chain for each draw of
    the constants.
    """

    def __init__(
        self, fit: Any, end: float, count: int, error: float, random: np.random.Generator
    ) -> None:
        self.play, shot = fit._plays([0]), fit.recordings[0]
        strike = fit.strikes[:1] - [0.0, 0.0, 0.0, 0.0, 0.0, self.play.origins[0]]
        kicked = _kicks.find(self.play, strike)
        met_contacts = _kicks.contacts(self.play, 0, kicked[0])
        known = int((met_contacts["time"] + kicked[0, 5] <= end - self.play.origins[0]).sum())
        self.moved = 6 + _strikes.KICKS * known  # the index of the first initial position
        rest = (shot.deviations(shot.rest) / np.sqrt(shot.still)[:, np.newaxis]).ravel()
        self.start = np.concatenate([kicked[0, : self.moved], np.zeros(len(rest))])
        sizes = error * _kicks.deviations(met_contacts)[:known].ravel()
        # 1 over the variance of each parameter before the shot is seen
        self.held = np.concatenate([_covariance.bounds(strike[0]), sizes, rest]) ** -2.0
        self.error, self.noise = error, fit.noise
        self.variance = max(_kicks.PRICE * error**2, fit.noise**2)

        # the constants of each draw
        changes: Doubles = np.zeros((count, len(fit.fitted)))
        if fit.covariance is not None and fit.fitted:
            changes = random.multivariate_normal(changes[0], fit.covariance, count)
        strikes = np.repeat(fit.strikes, count, axis=0)
        _, self.layouts = fit._struck(0, strikes, 0.0, fit.changed(changes))
        self.layouts["state"]["v"], self.layouts["state"]["w"] = 0.0, 0.0
        self.plays = _strikes.Plays(
            fit.recordings * count, fit.table, fit.radius, fit.constants, fit.cushion_model
        )

    def equations(self, numbers: Doubles) -> tuple[float, float, Doubles, Doubles]:
        """E of a row, the number of samples, J^T W J and J^T W d, with the fitted constants."""
        play = copy.copy(self.play)
        play.centres = play.centres + numbers[self.moved :].reshape(play.centres.shape)
        varied, sign = _kicks.with_positions(play)
        sums = varied.misfit(
            np.zeros(1, np.int32), numbers[np.newaxis, : self.moved], varied.ends, np.inf
        )
        square, gradient = _strikes.normal(sums)
        turn = np.concatenate([np.ones(self.moved), sign[0]])
        return sums[0, 0], sums[0, 2], square[0] * np.outer(turn, turn), gradient[0] * turn

    def top(self) -> tuple[Doubles, Doubles]:
        """The maximum of P, and a root of the covariance of the normal distribution about it.

        Raises
        ------
        ValueError
            The best play is too far from the known rows.
        """
        numbers, damping = self.start, 1e-3
        cost, count, square, gradient = self.equations(numbers)
        price = self.variance * self.held
        for _ in range(_DESCENT):
            whole = square + np.diag(price)
            whole += np.diag(damping * whole.diagonal() + 1e-12)
            tried = numbers - np.linalg.solve(whole, gradient + price * numbers)
            new = self.equations(tried)
            drop = cost + price @ numbers**2 - (new[0] + price @ tried**2)
            if drop > 0.0:
                numbers, (cost, count, square, gradient) = tried, new
                damping = max(0.2 * damping, 1e-9)
                if drop < 1e-4 * self.variance:
                    break
            else:
                damping *= 6.0
        off = np.sqrt(cost / count)
        if off > max(_NOISES * np.sqrt(2.0) * self.noise, _FAR * self.error):
            raise ValueError(
                f"shot: its strike was not found: the best one misses the known rows by "
                f"{1e3 * off:.1f} mm, {off / self.noise / np.sqrt(2.0):.0f} times the noise; "
                f"use a longer or shorter time, or leave the shot out"
            )
        self.variance = max(self.variance, cost / count - self.noise**2)
        whole = square + np.diag(self.variance * self.held)
        scale = 1.0 / np.sqrt(whole.diagonal())
        scaled = whole * np.outer(scale, scale) + 1e-11 * np.eye(len(scale))
        root = scale[:, np.newaxis] * np.linalg.inv(np.linalg.cholesky(scaled)).T
        return numbers, np.sqrt(self.variance) * root

    def costs(self, numbers: Doubles) -> Doubles:
        """- 2 log P of a row for each draw; infinite where a play ends in an error."""
        rows, moved = np.arange(len(numbers), dtype=np.int32), numbers[:, self.moved :]
        self.layouts["state"]["r"][..., :2] = self.play.centres + moved.reshape(len(numbers), -1, 2)
        self.plays.layouts = self.layouts[np.newaxis]
        found = self.plays.misfit(
            rows, np.ascontiguousarray(numbers[:, : self.moved]), self.plays.ends, -np.inf
        )
        cost = found[:, 0] / self.variance + numbers**2 @ self.held
        return np.asarray(np.where(np.isfinite(cost), cost, np.inf))

    def drawn(self, random: np.random.Generator) -> tuple[_strikes.Plays, Doubles, float]:
        """The plays, strikes and kicks of draws of P, and the effective number of draws."""
        top, root = self.top()
        shape = len(self.plays.ends), len(top)
        numbers = top + random.normal(size=shape) @ root.T
        cost = self.costs(numbers)
        numbers[~np.isfinite(cost)] = top
        cost, first = self.costs(numbers), numbers.copy()
        for step in range(_CHAIN):
            length = _STEP / np.sqrt(len(top)) * (_SHORTER if step % 3 == 0 else 1.0)
            tried = numbers + length * (random.normal(size=shape) @ root.T)
            new = self.costs(tried)
            taken = np.log(random.uniform(size=len(cost))) < 0.5 * (cost - new)
            numbers[taken], cost[taken] = tried[taken], new[taken]
        self.costs(numbers)  # the layouts of the plays are those of the last steps that were taken

        # how much of a draw follows from where its chain began
        begun, ended = (part - part.mean(axis=0) for part in (first, numbers))
        sizes = (begun**2).sum(axis=0) * (ended**2).sum(axis=0)
        memory = (begun * ended).sum(axis=0) ** 2 / np.maximum(sizes, 1e-300)
        effective = float(len(cost) * (1.0 - memory.mean()))
        return self.plays, numbers[:, : self.moved], effective
