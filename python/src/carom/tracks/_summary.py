"""The results of a fit, and their report: a single HTML file with its figures."""

from __future__ import annotations

import copy
import functools
import html
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import pictures
from carom._described import Game
from carom._rows import Seed, seed_of
from carom._rows import whole as _whole
from carom._shot_options import ShotCushion
from carom.dtypes import Doubles, Records
from carom.layouts import Table
from carom.results import Shot
from carom.shots import simulate
from carom.tracks import _constants, _covariance, _joint, _kicks, _strikes
from carom.tracks._design import Design, design
from carom.tracks._events import events
from carom.tracks._forecast import Forecast, forecast
from carom.tracks._kicks import Kicks
from carom.tracks._player import Player, player_of
from carom.tracks._recordings import Recording, until_pocketed

_ROUGH_MOST = 8  # so many are told one by one
BANDS, _CONTACTS = (
    (0.68, 0.95),
    (0, 1, 2, 3, 4, 6, 8, 11),
)  # shares of the samples, and contacts from which a row of bands holds
# of `model_error`: the least share of a kick that a track tells, how many kicks tell it, and its least
_KNOWN, _KICKS_LEAST, _ERROR_LEAST = 0.3, 20, 1e-3
_WIDTH, _HEIGHT, _LEFT, _BELOW, _ABOVE = 460.0, 300.0, 60.0, 45.0, 12.0  # of a chart, pixels
_INK, _MARK, _LINE = "#333333", "#1f5fae", "#c0392b"
_STYLE = (
    "body{font:16px/1.4 sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;color:#222}table{border-collapse:collapse}"
    "td,th{padding:.15em .8em;border-bottom:1px solid #ccc;text-align:right}td:first-child,th:first-child{text-align:left}"
    "figure{display:inline-block;margin:.5em;vertical-align:top}figcaption{font-size:14px;max-width:460px}svg{max-width:100%;height:auto}"
)


@dataclass(frozen=True, eq=False)
class Fit:
    """The result of a fit: the recorded shots with their strikes and constants."""

    recordings: list[Recording]
    table: str | tuple[float, float]  # A built-in table, or the extents of x and y, m
    radius: float  # m
    cushion_model: ShotCushion
    constants: dict[
        str, float
    ]  # What the shots are played with: fields of `carom.dtypes.ball_kind`, and slope_x, slope_y
    spread: dict[
        str, float
        # Of each constant that was fitted, how far it is off by the evidence itself: a standard
        # deviation
    ]
    # (shots, 6): v_x, v_y, R w_x, R w_y, R w_z (m/s) of the struck ball just after the strike, and
    # its time (s). NaN where there is none.
    strikes: Doubles
    # "ok"; "mended: ...", "rough: ..." or "doubtful: ...", with what was mended, is above the noise
    # or is in doubt; else why the shot does not count
    status: list[str]
    # (shots,): Root of the mean squared distance between recorded and played places, m, over the
    # samples of balls that move (`Recording.moving`), so that it depends little on how long and how
    # often a camera sees balls at rest; NaN without a play
    rmse: Doubles
    train: list[bool] | None = None  # Which shots the constants were fitted to, if not all
    fitted: tuple[str, ...] = ()  # The constants fitted to complete shots
    # (fitted, fitted): Of these; the roots of its diagonal are their `spread`. None where fewer
    # than 8 shots tell.
    covariance: Doubles | None = None
    warnings: Sequence[
        str
        # Remarks on all shots: a rotated table, constants at their bounds, a misfit far above the noise
    ] = ()
    game: Game | None = None  # The game that supplies constants that were not given
    # The 95 % interval of each constant fitted to complete shots, from the profile of the cost; None if
    # the shots do not determine it
    intervals: dict[str, tuple[float, float] | None] = field(default_factory=dict)

    @property
    def ground(self) -> _constants.Ground:
        """The table, its game, and the radius of the balls."""
        ground = _constants.ground(self.table, self.radius, self.game)
        return ground._replace(table=_constants.sloped(ground.table, self.constants))

    @property
    def noise(self) -> float:
        """The standard deviation of a coordinate of the recordings, m."""
        return self.recordings[0].noise

    @property
    def counts(self) -> list[bool]:
        """Which shots are used."""
        return [
            status.partition(":")[0] in ("ok", "mended", "rough", "doubtful")
            for status in self.status
        ]

    def _counted(self, train: bool | None) -> NDArray[np.bool_]:
        part = [
            train is None or self.train is None or item == train
            for item in self.train or [True] * len(self.status)
        ]
        return np.asarray(np.array(self.counts) & np.array(part), np.bool_)

    def counted(self, train: bool | None = None) -> Doubles:
        """The RMSE, m, of all used shots, of the ones to which constants were fitted, or of the
        others.
        """
        rmse: Doubles = self.rmse[self._counted(train)]
        return rmse

    @property
    def median_rmse(self) -> float:
        """Median RMSE of the used shots, m."""
        return float(np.median(self.counted())) if len(self.counted()) else float("nan")

    @property
    def p90_rmse(self) -> float:
        """90th percentile of the RMSE of the used shots, m."""
        return float(np.percentile(self.counted(), 90)) if len(self.counted()) else float("nan")

    def shot(self, i: int) -> Shot:
        """Play shot i; its clock begins at the strike, `strikes[i, 5]`.

        Raises
        ------
        ValueError
            No strike was found.
        """
        table, balls = self._struck(i, self.strikes[[i]], 0.0, {})
        return simulate(table, balls[0], cushion_model=self.cushion_model)

    def _struck(
        self, i: int, strikes: Doubles, moved: Doubles | float, changed: Mapping[str, Doubles]
    ) -> tuple[Table, Records]:
        """The table, and the balls of shot i just after each of the strikes, with shifted initial
        positions and changed constants.
        """
        recording = self.recordings[i]
        if not np.isfinite(self.strikes[i]).all():
            raise ValueError(
                f"shot {recording.id}: no strike was found ({self.status[i]}); choose another shot"
            )
        centres = [
            _strikes.apart(places, self.ground.table, self.radius)
            for places in recording.rest + np.zeros((len(strikes), 1, 1)) + moved
        ]
        balls = _constants.layout(np.array(centres), self.radius, self.constants)
        for name, values in changed.items():
            if name in _constants.KINDS:  # all plays have one table, so its slope stays
                balls["kind"][name] = values[:, None]
        balls["state"]["v"][:, recording.cue, :2] = strikes[:, :2]
        balls["state"]["w"][:, recording.cue] = strikes[:, 2:5] / self.radius
        return self.ground.table, balls

    def strike_covariance(self, i: int) -> Doubles:
        """Return the covariance of the six parameters of `strikes[i]`, shape (6, 6), for exact
        constants.

        It is computed from derivatives of the shot. It includes the noise of the samples, from
        their residuals, and of the initial positions, which contacts magnify.

        Raises
        ------
        ValueError
            No strike was found.
        """
        block, follow, rest = self._strike_off(i)
        follow = follow[:, len(self.fitted) :] * rest
        return np.asarray(block + follow @ follow.T)

    def _strike_off(self, i: int) -> tuple[Doubles, Doubles, Doubles]:
        self.shot(i)
        plays = self._plays([i])
        return _covariance.of_strike(
            plays, 0, self.strikes[i] - [0.0, 0.0, 0.0, 0.0, 0.0, plays.origins[0]], self.fitted
        )

    def draws(self, i: int, count: int, seed: Seed = 0) -> tuple[Table, Records, Doubles]:
        """Draw versions of shot i within its errors, for `simulate_batch`.

        Returns the table, layouts just after the strike, (count, balls), and times of the strike,
        s. Constants are drawn from `covariance`, if there is one, initial positions from the noise,
        and strikes given both.

        Raises
        ------
        ValueError
            No strike was found.
        """
        block, follow, rest = self._strike_off(i)
        random, changes, names = (
            np.random.default_rng(seed_of(seed, 2**64 - 1)),
            np.zeros((count, len(self.fitted))),
            self.fitted,
        )
        if self.covariance is not None and names:
            changes = random.multivariate_normal(np.zeros(len(names)), self.covariance, count)
        moved = random.normal(0.0, rest, (count, len(rest)))
        strikes = (
            random.multivariate_normal(self.strikes[i], block, count)
            + np.hstack([changes, moved]) @ follow.T
        )
        moved = moved.reshape(count, -1, 2)
        return (*self._struck(i, strikes, moved, self.changed(changes)), strikes[:, 5])

    def design(self, count: int = 3, *, seed: Seed = 0) -> list[Design]:
        """Design further shots to play and record; printed, they are instructions.

        Each is the one of 60 random shots that determines the constants best, given the ones before
        it.

        Raises
        ------
        ValueError
            No constant was fitted to complete shots.
        """
        return design(self, _whole(count, "count", least=1), seed_of(seed))

    def player(self, groups: Sequence[Sequence[int]] | None = None) -> Player:
        """Estimate the errors of the player, with intervals, from repeated strokes.

        Also returns them as a rating, and as a player for plans (`record`).

        Parameters
        ----------
        groups : sequence of sequences of int, optional
            The shots, from 0, of each group with the same intention. Default: shots with balls
            within 30 mm, and strikes within 6 degrees and 30 % of the speed, of the first one's.

        Raises
        ------
        ValueError
            There are too few repeated strokes, or a shot has no strike.
        """
        return player_of(self, groups)

    @functools.cached_property
    def model_error(self) -> float:
        """The errors of the models relative to those in recorded matches, at most 1.

        They are estimated from the kicks of the shots to which constants were fitted. 1 if the
        tracks determine fewer than 20 kicks.
        """
        kicks = self.kicks().contacts
        if self.train is not None:
            kicks = kicks[np.array(self.train)[kicks["shot"]]]
        scale = np.where((kicks["rail"] >= 0)[:, np.newaxis], _kicks.CUSHION, _kicks.BALLS)
        size, error, share = kicks["kick"] / scale, kicks["error"] / scale, kicks["share"]
        # a kick comes out too small by its share, and has the error of the noise besides
        known = (share > _KNOWN) & (error < 1.0)
        if known.sum() < _KICKS_LEAST:
            return 1.0
        square, told = np.where(known, size**2 - error**2, 0.0), np.where(known, share**2, 0.0)
        # shot by shot, as one that misses an event has large kicks
        shots = [kicks["shot"] == k for k in np.unique(kicks["shot"][known.any(axis=1)])]
        each = [square[shot].sum() / told[shot].sum() for shot in shots]
        return float(np.sqrt(np.clip(np.median(each), _ERROR_LEAST**2, 1.0)))

    def forecast(
        self, shot: int | Recording, *, after: float, draws: int = 200, seed: Seed = 0
    ) -> Forecast:
        """Forecast a shot from its first seconds.

        Parameters
        ----------
        shot : int or Recording
            The index of a shot of this fit, or a recording of the same table.
        after : float
            Duration of the known part, s from the first motion of a ball. The strike is fitted to
            its rows; later rows are not used.
        draws : int
            Number of draws of the strike, the constants (from `covariance`) and the initial
            positions. docs/understanding/reality.md compares the regions of 200 draws, for 2 s and
            more, with recorded shots.
        seed : int or numpy.random.Generator

        Returns
        -------
        Forecast
            `positions` returns the draws, and `regions` circles that contain the balls.

        Raises
        ------
        ValueError
            No strike explains the known rows, or there are no rows after the first.
        """
        whole = self.recordings[shot] if isinstance(shot, int) else shot
        whole = until_pocketed(whole, self.ground.table)
        if not 0.0 < after < np.inf:
            raise ValueError(f"after: {after!r} s is not positive and finite")
        draws, seed = _whole(draws, "draws", least=10), seed_of(seed)
        return forecast(self, whole, after, draws, seed)

    def changed(self, changes: Doubles) -> dict[str, Doubles]:
        """The fitted constants, shifted by amounts of shape (n, fitted), within their bounds."""
        return {
            name: np.clip(self.constants[name] + off, *_joint.prior(name)[1:])
            for name, off in zip(self.fitted, changes.T)
        }

    def positions(self, i: int, times: ArrayLike) -> Doubles:
        """Return the centres of shot i's balls as played, m, at times of the recording's clock.

        Shape (..., balls, 2); before the strike the balls are at rest.
        """
        moments = np.asarray(times, np.float64)
        return self.shot(i).positions(np.maximum(moments - self.strikes[i, 5], 0.0))[..., :2]

    def off(self, train: bool | None = None) -> Doubles:
        """Return the residuals of used shots, shape (samples of moving balls, 3).

        The columns are the number of preceding contacts of all balls, the distance (m), and a
        weight that makes shots count equally. For all shots, the ones to which constants were
        fitted, or the others.
        """
        found = [np.zeros((0, 3))]
        for k in np.flatnonzero(self._counted(train)):
            shot, recording = self.shot(int(k)), self.recordings[k]
            contacts = shot.events["time"][np.isin(shot.events["type"], _kicks.CONTACT_TYPES)]
            rows = [
                (track[moving], ball)
                for ball, (track, moving) in enumerate(zip(recording.tracks, recording.moving))
            ]
            t = np.concatenate([track[:, 0] for track, _ in rows]) - self.strikes[k, 5]
            apart = np.concatenate(
                [
                    shot.positions(np.maximum(track[:, 0] - self.strikes[k, 5], 0.0))[:, ball, :2]
                    - track[:, 1:]
                    for track, ball in rows
                ]
            )
            found.append(
                np.stack(
                    [
                        np.searchsorted(contacts, t),
                        np.hypot(*apart.T),
                        np.full(len(t), 1.0 / len(t)),
                    ],
                    axis=1,
                )
            )
        return np.concatenate(found)

    def bands(self, train: bool | None = None) -> Doubles:
        """Return the distances, m, that contain 68 and 95 % of the samples of a new shot with a
        fitted strike.

        Shape (rows, 3): the number of contacts from which a row applies, and the two distances. For
        n shots the shares are multiplied by (n + 1)/n, because a new shot may exceed all of them.

        This is not a forecast: if the strike is fitted only to the first seconds, later errors are
        several times larger. Use `forecast` for these.
        """
        off, bands = self.off(train), []
        larger = 1.0 + 1.0 / max(off[:, 2].sum(), 1.0)
        for least, below in zip(_CONTACTS, (*_CONTACTS[1:], np.inf)):
            part = off[(off[:, 0] >= least) & (off[:, 0] < below)]
            if len(part):
                part = part[np.argsort(part[:, 1])]
                reached = np.cumsum(part[:, 2]) / part[:, 2].sum()
                bands.append(
                    [
                        least,
                        *(
                            part[np.searchsorted(reached[:-1], larger * share), 1]
                            for share in BANDS
                        ),
                    ]
                )
        return np.array(bands).reshape(-1, 3)

    def covered(self, bands: Doubles, train: bool | None = None) -> Doubles:
        """Return the fractions of the samples within bands: 68 and 95 % for correct bands."""
        off = self.off(train)
        band = np.maximum(np.searchsorted(bands[:, 0], off[:, 0], side="right") - 1, 0)
        return np.asarray(off[:, 2] @ (off[:, 1:2] <= bands[band, 1:]) / off[:, 2].sum())

    def kicks(self) -> Kicks:
        """Find the kicks of the used shots: small changes of the motion just after each contact
        with which the shots match their recordings. They measure the errors of the models.
        """
        rows = [k for k, counts in enumerate(self.counts) if counts]
        plays = self._plays(rows)
        strikes = self.strikes[rows].copy()
        strikes[:, 5] -= plays.origins
        return _kicks.report(plays, strikes, rows, len(self.recordings))

    def _plays(self, rows: Sequence[int]) -> _strikes.Plays:
        return _strikes.Plays(
            [self.recordings[k] for k in rows],
            self.table,
            self.radius,
            self.constants,
            self.cushion_model,
        )

    def plot(self, i: int, kicks: Kicks | None = None) -> pictures.Picture:
        """Draw shot i: lines as played, dots as recorded; `svg` of the result is the text of a
        file.

        With kicks, the shot is played with them. Each contact then has a circle that grows with its
        contribution to the RMSE, and above 3 mm the dominant kick as text.
        """
        shot: Any = self.shot(i)
        marks = []
        if kicks is not None:
            plays, numbers = self._plays([i]), kicks.numbers[i]
            shot = copy.copy(shot)
            shot.events = plays.played(0, numbers)[0]
            shot.time, shot.count = float(plays.ends[0] - numbers[5]), len(shot.events)
            shot.positions = lambda times: plays.played(0, numbers, np.asarray(times) + numbers[5])[
                1
            ].transpose(1, 0, 2)
            shot.final = shot.final.copy()
            shot.final["r"][:, :2] = shot.positions([shot.time])[0]
            marks = [
                (r, min(0.015 + 3.0 * size, 0.1), long, short if size > 3e-3 else "")
                for r, size, long, short in kicks.marks(i)
            ]
        return pictures.Picture(
            pictures.picture(
                shot.table, shot, [track[:, 1:] for track in self.recordings[i].tracks], marks
            )
        )

    def to_dict(self, kicks: Kicks | None = None) -> dict[str, Any]:
        """Return the result as the command writes it, for JSON."""
        shots: list[dict[str, Any]] = []
        for recording, strike, status, rmse in zip(
            self.recordings, self.strikes, self.status, self.rmse
        ):
            found = bool(np.isfinite(strike).all())
            v_x, v_y, w_x, w_y, w_z, start = strike.tolist()
            cue = (
                {
                    "ball": recording.balls[recording.cue],
                    "v_x": v_x,
                    "v_y": v_y,
                    "w_x": w_x / self.radius,
                    "w_y": w_y / self.radius,
                    "w_z": w_z / self.radius,
                    "start": start,
                }
                if found
                else None
            )
            part = {} if self.train is None else {"train": self.train[len(shots)]}
            shots.append(
                {
                    **part,
                    "id": recording.id,
                    "status": status,
                    "rmse": float(rmse) if found else None,
                    "cue": cue,
                }
            )
        return {
            "constants": self.constants,
            "spread": self.spread,
            "intervals": self.intervals,
            "covariance": None
            if self.covariance is None
            else {"constants": list(self.fitted), "matrix": self.covariance.tolist()},
            "cushion_model": self.cushion_model,
            "table": self.table if isinstance(self.table, str) else list(self.table),
            "radius": self.radius,
            "game": self.ground.game,
            "shots": shots,
            "median_rmse": self.median_rmse if len(self.counted()) else None,
            "p90_rmse": self.p90_rmse if len(self.counted()) else None,
            "bands": self.bands(None if self.train is None else True).tolist(),
            "noise": self.noise,
            "warnings": list(self.warnings),
            **({} if kicks is None else {"kicks": kicks.to_list()}),
        }


def _ticks(low: float, high: float) -> list[float]:
    """Round numbers between two."""
    size = (high - low) / 4.0
    unit = 10.0 ** math.floor(math.log10(size))
    step = next(unit * k for k in (1.0, 2.0, 2.5, 5.0, 10.0) if unit * k >= size)
    return [
        step * k for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)
    ]


def _dashed(dashes: str) -> str:
    return f' stroke-dasharray="{dashes}"' if dashes else ""


class _Chart:
    """A chart with axes, as SVG."""

    def __init__(
        self, x: tuple[float, float], y: tuple[float, float], x_name: str, y_name: str
    ) -> None:
        self.ends = x, y
        bottom, right = _HEIGHT - _BELOW, _WIDTH - 10.0
        self.parts = [f'<path d="M{_LEFT},{_ABOVE}V{bottom}H{right}" stroke="{_INK}" fill="none"/>']
        self._text(0.5 * (_LEFT + right), _HEIGHT - 8.0, x_name)
        self._text(
            14.0,
            0.5 * (_ABOVE + bottom),
            y_name,
            f' transform="rotate(-90 14 {0.5 * (_ABOVE + bottom):.1f})"',
        )
        for value in _ticks(*x):
            self._text(self._at(value, y[0])[0], bottom + 16.0, f"{value:g}")
        for value in _ticks(*y):
            self._text(
                _LEFT - 6.0,
                self._at(x[0], value)[1] + 4.0,
                f"{value:g}",
                ' style="text-anchor:end"',
            )

    def _text(self, x: float, y: float, text: str, rest: str = "") -> None:
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}"{rest}>{html.escape(text)}</text>')

    def _at(self, x: float, y: float) -> tuple[float, float]:
        (x_0, x_1), (y_0, y_1) = self.ends
        return (
            _LEFT + (x - x_0) / (x_1 - x_0) * (_WIDTH - 10.0 - _LEFT),
            _HEIGHT - _BELOW - (y - y_0) / (y_1 - y_0) * (_HEIGHT - _BELOW - _ABOVE),
        )

    def dots(self, x: Doubles, y: Doubles) -> None:
        (x_0, x_1), (y_0, y_1) = self.ends
        for a, b in zip(x.tolist(), y.tolist()):
            if x_0 <= a <= x_1 and y_0 <= b <= y_1:
                point = self._at(a, b)
                self.parts.append(
                    f'<circle cx="{point[0]:.1f}" cy="{point[1]:.1f}" r="2" fill="{_MARK}" fill-opacity="0.45"/>'
                )

    def line(self, x: Doubles, y: Doubles, dashes: str = "") -> None:
        points = " ".join(
            "{:.1f},{:.1f}".format(*self._at(a, b)) for a, b in zip(x.tolist(), y.tolist())
        )
        self.parts.append(
            f'<polyline points="{points}" stroke="{_LINE}" stroke-width="2" fill="none"{_dashed(dashes)}/>'
        )

    def legend(self, lines: Sequence[tuple[str, str]], dot: str) -> None:
        """Names lines, each with its dashes, and dots, in a row at the top on the right."""
        wide, y = 110.0, _ABOVE + 8.0
        x = _WIDTH - wide * (len(lines) + 1)
        for name, dashes in lines:
            self.parts.append(
                f'<path d="M{x:.1f},{y:.1f}h24" stroke="{_LINE}" stroke-width="2"{_dashed(dashes)}/>'
            )
            self._text(x + 30.0, y + 4.0, name, ' style="text-anchor:start"')
            x += wide
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2" fill="{_MARK}"/>')
        self._text(x + 8.0, y + 4.0, dot, ' style="text-anchor:start"')

    def bars(self, edges: Doubles, heights: Sequence[int]) -> None:
        for left, right, height in zip(edges[:-1].tolist(), edges[1:].tolist(), heights):
            (x, y), (end, bottom) = self._at(left, height), self._at(right, 0.0)
            size = f'width="{max(end - x - 1.0, 0.5):.1f}" height="{bottom - y:.1f}"'
            self.parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" {size} fill="{_MARK}"/>')

    def svg(self) -> str:
        head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="{_WIDTH:g}" height="{_HEIGHT:g}"'
        return (
            head
            + ' font-family="sans-serif" font-size="12" text-anchor="middle">'
            + "".join(self.parts)
            + "</svg>"
        )


def histogram(fit: Fit) -> str:
    """A histogram of the shots' RMSE."""
    rmse = 100.0 * fit.counted()
    end = float(_ticks(0.0, 1.05 * float(rmse.max()))[-1] or 1.0) if len(rmse) else 1.0
    end = max(end, float(rmse.max(initial=0.0)) * 1.001)
    edges: Doubles = np.linspace(0.0, end, 31)
    heights = np.histogram(rmse, edges)[0].tolist()
    chart = _Chart((0.0, end), (0.0, max([*heights, 1]) * 1.05), "RMSE of a shot, cm", "shots")
    chart.bars(edges, heights)
    return chart.svg()


def bands(fit: Fit) -> str:
    """A chart of the residuals of fitted strikes over the number of preceding contacts, with the 68
    and 95 % bands.
    """
    unseen = None if fit.train is None else False
    off, rows = fit.off(unseen), fit.bands(None if fit.train is None else True)
    shown = off[:: max(len(off) // 1000, 1)]
    top = 200.0 * float(np.median(rows[:, 2]))
    ends = np.append(rows[1:, 0], max(float(off[:, 0].max(initial=0.0)), rows[-1, 0]) + 1.0)
    chart = _Chart(
        (0.0, float(ends[-1])),
        (0.0, top),
        "contacts of the shot before",
        "residual of a fitted strike, cm",
    )
    chart.dots(shown[:, 0] + np.modf(0.618034 * np.arange(len(shown)))[0], 100.0 * shown[:, 1])
    for column, dashes in ((1, ""), (2, "6 3")):
        chart.line(
            np.stack([rows[:, 0], ends], axis=1).ravel(),
            np.repeat(np.minimum(100.0 * rows[:, column], top), 2),
            dashes=dashes,
        )
    chart.legend([("68 % below", ""), ("95 % below", "6 3")], "one position")
    return chart.svg()


def laws(fit: Fit) -> list[tuple[str, str]]:
    """Charts of the evidence of single events, with the fitted laws; each with its caption."""
    seen, constants = events(fit.recordings, fit.ground.size, fit.radius), fit.constants
    gravity = constants["gravity"]
    rolls = seen.pieces[seen.pieces["rolling"] & (seen.pieces["a_error"] < 0.03)]
    speed = np.hypot(*rolls["v"].T)
    chart = _Chart((0.0, 3.0), (0.0, 0.2), "speed, m/s", "deceleration of rolling, m/s²")
    chart.dots(speed, -(rolls["a"] * rolls["v"]).sum(axis=1) / np.maximum(speed, 1e-9))
    x: Doubles = np.linspace(0.0, 3.0, 61)
    chart.line(x, constants["mu_roll"] * gravity + constants["drag"] * x**2)
    found = [
        (
            "Rolling: one dot for each piece of a track. Line: mu_roll g + drag v² of the fit.",
            chart.svg(),
        )
    ]

    slides = seen.pieces[seen.pieces["sliding"] & (seen.pieces["a_error"] < 0.15)]
    chart = _Chart((0.0, 6.0), (0.0, 4.0), "speed, m/s", "deceleration of sliding, m/s²")
    chart.dots(np.hypot(*slides["v"].T), np.hypot(*slides["a"].T))
    chart.line(np.array([0.0, 6.0]), np.full(2, constants["mu_slide"] * gravity))
    found.append(("Sliding: one dot for each piece. Line: mu_slide g of the fit.", chart.svg()))

    good = seen.impacts[
        (seen.impacts["chi2"] < 3)
        & (seen.impacts["w_error"] < 0.05)
        & (seen.impacts["v_error"] < 0.05)
    ]
    chart = _Chart((0.0, 4.0), (0.5, 1.1), "speed into the cushion, m/s", "speed out / speed in")
    chart.dots(good["v_n"], -good["w_n"] / np.maximum(good["v_n"], 1e-9))
    found.append(
        ("Cushions: the speed across the cushion after an impact over that before.", chart.svg())
    )

    hits = seen.hits[
        (seen.hits["chi2"] < 3) & (seen.hits["w_error"] < 0.1) & (seen.hits["z_error"] < 0.1)
    ]
    chart = _Chart((0.0, 5.0), (0.7, 1.1), "closing speed, m/s", "restitution")
    chart.dots(hits["v_n"], (hits["z_n"] - hits["w_n"]) / np.maximum(hits["v_n"], 1e-9))
    chart.line(np.array([0.0, 5.0]), np.full(2, constants["restitution"]))
    found.append(
        (
            "Hits on a ball at rest: speed of parting over closing speed. Line: restitution of the fit.",
            chart.svg(),
        )
    )
    return found


def summary_lines(fit: Fit) -> list[str]:
    """The summary of a result: the noise, the remarks on all shots, and the shots that are not ok."""
    lines = [
        f"balls of radius {1e3 * fit.radius:.5g} mm, constants of {fit.ground.game} unless given, "
        f"cushions: {fit.cushion_model}",
        f"noise of a coordinate: {1e3 * fit.noise:.2f} mm",
        *(f"warning: {text}" for text in fit.warnings),
    ]
    rough = [
        float(rmse) for rmse, status in zip(fit.rmse, fit.status) if status.startswith("rough")
    ]
    if len(rough) > _ROUGH_MOST:
        noise = math.sqrt(2.0) * fit.noise
        lines.append(
            f"{len(rough)} of {len(fit.status)} shots are rough: RMSE {min(rough) / noise:.2g} to {max(rough) / noise:.2g} times that of the noise"
        )
    silent = ("ok", "rough") if len(rough) > _ROUGH_MOST else ("ok",)
    return lines + [
        f"shot {shot.id}: {status}"
        for shot, status in zip(fit.recordings, fit.status)
        if not status.startswith(silent)
    ]


def told_forecasts(seen: Sequence[Forecast]) -> str:
    """The fractions of later positions in the regions of forecasts: of all, and of moving ones."""
    told = []
    for moving, places in ((False, "later places"), (True, "places of moving balls")):
        counts = [len(item.later(moving=moving)[0]) for item in seen]
        some = [item.covered(moving=moving) for item, count in zip(seen, counts) if count]
        if some:
            inside = 100.0 * np.average(some, axis=0, weights=[count for count in counts if count])
            told.append(f"{inside[0]:.0f} and {inside[1]:.0f} % of {sum(counts)} {places}")
    return (
        f"forecasts from the first {seen[0].after:g} s of {len(seen)} shots: {', '.join(told)} "
        "lie in the regions of 68 and 95 %"
    )


def page(
    fit: Fit, name: str, kicks: Kicks | None = None, forecasts: Sequence[Forecast] = ()
) -> str:
    """The report on tracks with a name.

    With kicks it includes their tables, and figures of the shots played with kicks; with forecasts,
    a figure of the forecast with the median width.
    """
    ok = [k for k, counts in enumerate(fit.counts) if counts]
    order = sorted(ok, key=lambda k: float(fit.rmse[k]))
    parts = [f"<h1>{html.escape(name)}</h1>"]
    if order:
        parts.append(
            f"<p>{len(ok)} of {len(fit.status)} shots, cushion model {fit.cushion_model}: RMSE median {100 * fit.median_rmse:.2f} cm, "
            f"9 in 10 below {100 * fit.p90_rmse:.2f} cm.</p>"
        )
    parts.append(
        f"<ul>{''.join(f'<li>{html.escape(line)}</li>' for line in summary_lines(fit))}</ul>"
    )
    figures = [("RMSE over all samples of all balls of a shot.", histogram(fit))] if order else []
    if order:
        whose = "shots" if fit.train is None else "shots that the constants were not fitted to"
        figures.append(
            (
                f"Residuals of {whose}, each with a strike fitted to the whole shot: no forecast. Lines: 68 and 95 %.",
                bands(fit),
            )
        )
    for what, k in (
        [("best", order[0]), ("median", order[len(order) // 2]), ("worst", order[-1])]
        if order
        else []
    ):
        text = f"The {what} shot, {fit.recordings[k].id}: {100 * fit.rmse[k]:.2f} cm. Lines as played, dots as recorded."
        if kicks is not None:
            text += f" Played with kicks: {100 * kicks.rmse[k]:.2f} cm. Circles: contacts, the larger the more of the RMSE they have."
        figures.append((text, fit.plot(k, kicks).svg))
    if forecasts:
        wide = [float(np.median(item.regions([item.until + 2.0])[1])) for item in forecasts]
        median = forecasts[int(np.argsort(wide)[len(wide) // 2])]
        text = f"Shot {median.recording.id}, {told_forecasts(forecasts)}. Circles: these regions of this shot. Dots as recorded."
        figures.append((text, median.plot().svg))
    figures += laws(fit)
    rows = [
        f"<tr><td>{constant}</td><td>{value:.5g}</td><td>{f'{fit.spread[constant]:.2g}' if constant in fit.spread else 'given'}</td></tr>"
        for constant, value in fit.constants.items()
    ]
    parts += [
        f"<figure>{svg}<figcaption>{html.escape(text)}</figcaption></figure>"
        for text, svg in figures
    ]
    parts.append(
        f"<table><tr><th>constant</th><th>value</th><th>spread</th></tr>{''.join(rows)}</table>"
    )
    for table in kicks.tables if kicks is not None else ():
        cells = ["".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in table]
        parts.append(f"<h2>Kicks</h2><table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>")
    head = f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(name)}</title><style>{_STYLE}</style></head>'
    return f"{head}<body>{''.join(parts)}</body></html>\n"
