"""Forecasts of recorded shots from their first seconds.

The strike, the constants c, the initial positions r and the models of contacts all have errors, and
a draw includes all four.

1. Before. Constants and initial positions are drawn from their errors. Given c and r, the strike and
   the kicks y of the contacts in the first t seconds follow

       log P(y) = - (E(y) + sum of V_1 y^2/s^2) / (2 V),   V_1 = m^2 PRICE,

   where E is the cost of `_strikes`, whose first numbers are the strike. PRICE is that of `_kicks`,
   and s is m times its deviations, which single contacts of recorded shots have. m <= 1 is the size
   of the errors of the models, by the kicks of the fitted shots (`Fit.model_error`): 1 on recorded
   matches, near 0 where carom's own laws played. V is V_1, or the cost of the best draw per row
   less the variance of the noise where that is more, as it is where kicks do not explain the rows.

   Levenberg and Marquardt's method finds the top of P, and the normal equations the normal
   distribution about it, from which a draw comes. P has edges where events change, so draws are
   drawn again by their weights. A share of the draws, m times a tenth, has the same, largest
   weight, because P trusts a wrong strike too much. By the search of 2026-11-27, 73 and 95 % of the
   places of the match of 2017 lay in the regions of 68 and 95 % with this limit, 2 s being known.
   They were 70 and 94 % where a twentieth of the draws had the largest weight, 77 and 95 % where a
   fifth had, and 55 and 76 % without a limit.

2. After. Each later contact has a kick, normal with the deviations s.

Kicks tie the draws to the last places that are known, which strikes alone miss by a centimetre.
`reality.py --forecast 2,4` of the examples counts how many recorded places lie in the regions of
68 and 95 %. Only the tenth was chosen by them.
"""

from __future__ import annotations

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
_STEPS = 6  # iterations of the descent to the maximum of P
_ALIKE = 0.1  # the share of the draws that have the largest weight
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
    plays: _strikes.Plays  # A shot for each draw, with its constants and places of rest

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
        off = np.linalg.norm(places + self.recording.noise * camera - middle, axis=-1)
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
    plays, numbers = _Before(part, end, draws, error, random).drawn(random)
    plays.ends = np.full(draws, _LONG)
    numbers = _kicked(plays, numbers, end - plays.origins[0], error, random)
    good = np.isfinite(numbers[:, 0])
    plays.layouts = plays.layouts[:, good]
    return Forecast(whole, after, end, numbers[good], plays)


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
    """P of strikes and kicks in the first seconds, a row for each draw of constants and places."""

    def __init__(
        self, fit: Any, end: float, count: int, error: float, random: np.random.Generator
    ) -> None:
        play = fit._plays([0])
        start = fit.strikes[:1] - [0.0, 0.0, 0.0, 0.0, 0.0, play.origins[0]]
        whole = _kicks.find(play, start)
        first_contacts = _kicks.contacts(play, 0, whole[0])
        first_contacts = first_contacts[
            first_contacts["time"] + whole[0, 5] <= end - play.origins[0]
        ]
        self.start = whole[:, : 6 + _strikes.KICKS * len(first_contacts)]
        price = _kicks.PRICE / _kicks.deviations(first_contacts)[: len(first_contacts)].ravel() ** 2
        self.error, self.variance, self.noise = error, _kicks.PRICE * error**2, fit.noise**2
        self.held = np.concatenate([self.variance / _covariance.bounds(whole[0]) ** 2, price])

        # the constants and initial positions of each draw
        changes: Doubles = np.zeros((count, len(fit.fitted)))
        if fit.covariance is not None and fit.fitted:
            changes = random.multivariate_normal(changes[0], fit.covariance, count)
        shot = fit.recordings[0]
        rest = shot.noise / np.sqrt(shot.still)[:, np.newaxis]
        moved = rest * random.normal(size=(count, len(rest), 2))
        _, layouts = fit._struck(
            0, np.repeat(fit.strikes, count, axis=0), moved, fit.changed(changes)
        )
        layouts["state"]["v"], layouts["state"]["w"] = 0.0, 0.0
        self.plays = _strikes.Plays(
            fit.recordings * count, fit.table, fit.radius, fit.constants, fit.cushion_model
        )
        self.plays.layouts = layouts[np.newaxis]

    def costs(self, numbers: Doubles) -> Doubles:
        """- 2 V log P, of a row for each draw; infinite where a play ends in an error."""
        rows = np.arange(len(numbers), dtype=np.int32)
        found = self.plays.misfit(rows, numbers, self.plays.ends, -np.inf)
        misfit = np.where(np.isfinite(found[:, 0]), found[:, 0], np.inf)
        return np.asarray(misfit + numbers**2 @ self.held)

    def drawn(self, random: np.random.Generator) -> tuple[_strikes.Plays, Doubles]:
        """Draws of P, and their plays."""
        plays, count = self.plays, len(self.plays.ends)
        top, sums = _strikes.descend(
            plays,
            np.arange(count, dtype=np.int32),
            np.repeat(self.start, count, axis=0),
            plays.ends,
            _STEPS,
            held=np.repeat(self.held[np.newaxis], count, axis=0),
        )
        least = float(np.min(sums[:, 0] / np.maximum(sums[:, 2], 1.0)))
        variance = max(self.variance, least - self.noise, self.noise)

        # one root of the covariance serves all: that of the best draw
        best = int(np.argmin(sums[:, 0]))
        square = _strikes.normal(sums[[best]])[0][0] + np.diag(self.held)
        scale = 1.0 / np.sqrt(square.diagonal())
        scaled = square * np.outer(scale, scale) + 1e-11 * np.eye(len(scale))
        root = (
            np.sqrt(variance) * scale[:, np.newaxis] * np.linalg.inv(np.linalg.cholesky(scaled)).T
        )

        # drawn again by their weights, of which none has more than that of a share of the draws
        normal = random.normal(size=top.shape)
        numbers = top + normal @ root.T
        cost = self.costs(numbers)
        logarithms = 0.5 * ((normal**2).sum(axis=1) - (cost - cost.min()) / variance)
        most = np.quantile(logarithms, 1.0 - _ALIKE * self.error, method="lower")
        weights = np.exp(np.minimum(logarithms - most, 0.0))
        chosen = random.choice(count, count, p=weights / weights.sum())
        plays.layouts = plays.layouts[:, chosen]
        return plays, numbers[chosen]
