"""Recorded shots as plays of a strike, and the least-squares descent of a strike.

The unknowns of a shot are six parameters p: v_x, v_y and R w_x, R w_y, R w_z of the struck ball
just after the strike (m/s), and the time of the strike (s), on a clock that begins with the last
sample of the struck ball at rest. The cost is the sum over all samples of all balls of the
pseudo-Huber loss 2 c^2 (sqrt(1 + d^2/c^2) - 1) of the distance d between recorded and played
position, evened if rows have unlike noise (`_recordings.View`), c = 1 cm: quadratic for small distances, and linear for large ones, which follow an event
that the play misses. Levenberg and Marquardt's step is dp = -(J^T W J + l diag(J^T W J))^-1 J^T W
d.

`starts` returns the strikes that the first rows allow, and `_search` finds the lowest of the many
minima from these. The plays of all strikes of all shots are one batch, in C.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Array, pointer, workers
from carom._shot_options import Options, ShotCushion, shot_options
from carom.derivatives import tangents
from carom.dtypes import Doubles, Records
from carom.layouts import Table
from carom.shots import simulate
from carom.status import CaromError
from carom.tracks import _constants
from carom.tracks._recordings import Recording

Integers = NDArray[np.int32]

HUBER = 0.01  # c, m
# of the forward differences, m/s and s: small against what moves an event, large against rounding
STEP = 1e-7
EARLIEST, LATEST = -0.03, 0.13  # of a strike on the clock of a play, s
_STILL = 0.12  # s: a ball was struck no longer before the first row that shows its motion
# Strikes at a near rail: the speed into it over that away from it, how long the ball may have been
# on its way to it (s), rows since the first motion that show it leaving (s), and their grid: turns,
# factors of the speed, side and follow over the speed.
_REBOUND, _NEAR = 1.4, 0.15
_WINDOWS = ((0.0, 0.05), (0.04, 0.1), (0.08, 0.16))
_ROUGH = (
    np.linspace(-0.16, 0.16, 5),
    np.array([0.85, 1.0, 1.2]),
    np.linspace(-1.0, 1.0, 4),
    np.linspace(-0.8, 0.9, 3),
)
_SPIN_MOST = 2.0  # greatest |R w| of a strike over |v|: a tip that does not slip gives 1.3
_NUMBERS = 6
KICKS = 5  # numbers of a contact's kicks, which follow a strike
EVENTS_MOST = 1000  # of a play
FIRST = 0.9  # s: the first samples of a search


class Plays:
    """Recorded shots, prepared for playing with given constants.

    `table` is a built-in table or the extents of x and y, m; `radius` is the radius of the balls,
    m; `threads` is as for `carom.simulate_batch`.
    """

    def __init__(
        self,
        recordings: Sequence[Recording],
        table: str | tuple[float, float],
        radius: float,
        constants: Mapping[str, float],
        cushion_model: ShotCushion,
        threads: int = 0,
    ) -> None:
        self.recordings = recordings
        self.kind, self.ground = table, _constants.ground(table, radius)
        self.table_size = self.ground.size
        self.radius = radius
        self.threads, self.workers = threads, workers(threads) if threads else 1
        # the clock of a play begins with the last row at rest of the struck ball, wherever that is
        # in the recording
        self.origins = np.array([origin(shot) for shot in recordings])
        self.tracks = [
            [track[track[:, 0] >= begin] - (begin, 0.0, 0.0) for track in shot.tracks]
            for shot, begin in zip(recordings, self.origins)
        ]
        # shots with fewer balls are padded with positions without balls
        self.balls = np.array([len(shot.balls) for shot in recordings], np.int32)
        self.centres = np.zeros((len(recordings), max(self.balls, default=0), 2))
        for shot, centres in zip(recordings, self.centres):
            centres[: len(shot.balls)] = apart(shot.rest, self.ground.table, radius)
        self.struck = np.array([shot.cue for shot in recordings], np.int32)
        self.ends = np.array([shot.end for shot in recordings]) - self.origins
        self.counts = np.array([sum(map(len, shot)) for shot in self.tracks])
        self.samples, self.first, self.evening = self._samples(self.tracks)
        self.cushion_model: ShotCushion = cushion_model
        self.set(constants)

    def set(self, constants: Mapping[str, float], steps: Mapping[str, float] | None = None) -> None:
        """Set the constants, and the finite-difference steps of those that `misfit` differentiates
        by.
        """
        steps = steps or {}
        self.constants = dict(constants)
        self.steps = np.array(list(steps.values()), np.float64)
        self.table = _constants.sloped(self.ground.table, constants)
        changed = [
            self.constants,
            *({**self.constants, name: constants[name] + step} for name, step in steps.items()),
        ]
        self.layouts = np.array(
            [_constants.layout(self.centres, self.radius, constants) for constants in changed]
        )
        self.tables = np.array(
            [_constants.sloped(self.table, constants).record for constants in changed], dtypes.table
        )

    def _samples(
        self, tracks: Sequence[Sequence[Doubles]]
    ) -> tuple[Doubles, NDArray[np.int64], Doubles | None]:
        """The concatenated samples of all balls of all shots; the start of each ball, including
        balls that a shot does not have; and the matrices that even the samples, (samples, 2, 2), or
        None if all have the same noise.
        """
        lengths = np.zeros(self.centres.shape[:2], np.int64)
        for shot, row in zip(tracks, lengths):
            row[: len(shot)] = [len(track) for track in shot]
        samples = np.concatenate([track for shot in tracks for track in shot])
        first = np.concatenate([[0], np.cumsum(lengths)])
        if all(shot.view is None for shot in self.recordings):
            return np.ascontiguousarray(samples), first, None
        evening = [
            np.tile(np.eye(2), (len(track), 1, 1))
            if shot.view is None
            else shot.view.evening(track[:, 1:])
            for shot, rows in zip(self.recordings, tracks)
            for track in rows
        ]
        return np.ascontiguousarray(samples), first, np.ascontiguousarray(np.concatenate(evening))

    def some(self, rows: ArrayLike) -> Plays:
        """Some of the shots."""
        shots = [self.recordings[row] for row in np.asarray(rows)]
        return Plays(
            shots, self.kind, self.radius, self.constants, self.cushion_model, self.threads
        )

    def _of_c(self, strikes: Doubles, huber: float = HUBER) -> Any:
        """The recordings for C, for strikes with a number of parameters."""
        return ffi.new(
            "carom_python_tracks *",
            {
                "tables": pointer("carom_table[]", self.tables),
                "options": shot_options(Options(cushion_model=self.cushion_model)),
                "balls": pointer("carom_shot_ball[]", self.layouts),
                "struck": pointer("int32_t[]", self.struck),
                "counts": pointer("int32_t[]", self.balls),
                "samples": pointer("double[]", self.samples),
                "evening": ffi.NULL if self.evening is None else pointer("double[]", self.evening),
                "first": pointer("int64_t[]", self.first),
                "steps": pointer("double[]", self.steps),
                "count": self.layouts.shape[2],
                "shots": self.layouts.shape[1],
                "constants": len(self.steps),
                "kicks": (strikes.shape[-1] - _NUMBERS) // KICKS,
                "step": STEP,
                "huber": huber,
            },
        )

    def played(
        self, row: int, strike: Doubles, times: Doubles | None = None
    ) -> tuple[Records, Doubles]:
        """Play one shot; return its events on the play's clock, with states `after` that exclude
        kicks, and the positions of the balls at ascending times of the plays' clock, (balls, n, 2).

        Raises
        ------
        CaromError
            The play fails.
        """
        strike, when = (
            np.ascontiguousarray(strike),
            np.ascontiguousarray([] if times is None else times, np.float64),
        )
        events: Array = np.empty(EVENTS_MOST, dtypes.event)
        places, many = np.empty((self.layouts.shape[2], len(when), 2)), ffi.new("int32_t *")
        code = lib.carom_python_kicked(
            self._of_c(strike),
            row,
            pointer("double[]", strike),
            self.ends[row],
            len(when),
            pointer("double[]", when),
            pointer("carom_event[]", events),
            many,
            pointer("double[]", places),
        )
        if code < 0:
            raise CaromError(code)
        return events[: many[0]], places[: self.balls[row]]

    def misfit(
        self,
        shots: Integers,
        strikes: Doubles,
        end: Doubles,
        most: Doubles | float,
        *,
        huber: float = HUBER,
    ) -> Doubles:
        """Costs of n plays, with normal equations if the cost is below `most`; see loops.h.

        Shape (n, 4 + m + m (m + 1)/2), where m is 6 plus the number of steps. Play k is recording
        of[k] with strikes[k] and the samples up to until[k], s. Kicks of contacts follow each
        strike and add five to m each.
        """
        numbers = strikes.shape[1] + len(self.steps)
        sums = np.empty((len(shots), 4 + numbers + numbers * (numbers + 1) // 2))
        shots, strikes, end = (
            np.ascontiguousarray(shots, np.int32),
            np.ascontiguousarray(strikes),
            np.ascontiguousarray(end),
        )
        most = np.ascontiguousarray(np.broadcast_to(most, len(shots)), np.float64)
        tracks = self._of_c(strikes, huber)

        def part(rows: slice) -> int:
            # at most some milliseconds of C at a time, so that Ctrl-C is heard
            code = lib.CAROM_OK
            for begin in range(rows.start, rows.stop, 256):
                cut = slice(begin, min(begin + 256, rows.stop))
                code = code or lib.carom_python_misfit(
                    tracks,
                    cut.stop - begin,
                    pointer("int32_t[]", shots[cut]),
                    pointer("double[]", strikes[cut]),
                    pointer("double[]", end[cut]),
                    pointer("double[]", most[cut]),
                    pointer("double[]", sums[cut]),
                )
            return int(code)

        cuts = np.linspace(0, len(shots), self.workers + 1).astype(int)
        parts = [slice(int(a), int(b)) for a, b in zip(cuts[:-1], cuts[1:])]
        if len(parts) == 1:
            codes = [part(parts[0])]
        else:
            with ThreadPoolExecutor(self.workers) as pool:
                codes = list(pool.map(part, parts))
        if any(codes):
            raise CaromError(next(code for code in codes if code))
        return sums

    def rmse(self, strikes: Doubles) -> Doubles:
        """Root mean squared distance over the moving samples of each shot, m, shape (shots,); inf
        if the play fails.
        """
        moving = copy.copy(self)
        moving.samples, moving.first, moving.evening = self._samples(
            [
                [track[rows] - (begin, 0.0, 0.0) for track, rows in zip(shot.tracks, shot.moving)]
                for shot, begin in zip(self.recordings, self.origins)
            ]
        )
        sums = moving.misfit(np.arange(len(strikes), dtype=np.int32), strikes, self.ends, -np.inf)
        return np.asarray(np.sqrt(sums[:, 1] / np.maximum(sums[:, 2], 1.0)))


_NEAR_BALLS = 3e-3  # m: balls that are farther apart than this stay as they lie
_OVERLAP = 5e-7  # m: half of what a shot allows
_ROUNDS = 400  # of pushes: a rack of 15 balls seen with 0.5 mm of noise takes some 100


def apart(rest: Doubles, table: Table, radius: float) -> Doubles:
    """Valid initial positions: within the cushions, outside pockets, and without overlaps.

    Positions from a camera have errors of a millimetre. Overlapping balls are pushed apart, half of
    the overlap each, one pair after another until none overlaps; in a rack each push causes
    another, smaller overlap.
    """
    centres = np.array(rest, np.float64)
    pairs = [
        (i, j)
        for i in range(len(centres))
        for j in range(i)
        if np.hypot(*(centres[j] - centres[i])) < 2.0 * radius + _NEAR_BALLS
    ]
    for _ in range(_ROUNDS):
        centres = _within(centres, table, radius)
        moved = False
        for i, j in pairs:
            x, y = (centres[j] - centres[i]).tolist()
            distance = math.hypot(x, y)
            if distance < 2.0 * radius - _OVERLAP:
                # along x where the centres coincide
                way = np.array([x, y]) / distance if distance > 0.0 else np.array([1.0, 0.0])
                shift = (0.5 * (2.0 * radius - distance) + 1e-8) * way
                centres[i], centres[j], moved = centres[i] - shift, centres[j] + shift, True
        if not moved:
            break
    return centres


def inward(table: Table) -> Doubles:
    """The unit normals of the rails of a table, (rails, 2), towards the balls."""
    along = table.rails["q"] - table.rails["p"]
    line = table.rails["line"][:, :2]
    known = (table.rails["line"] != 0.0).any(axis=1, keepdims=True)
    normals = np.where(known, line, np.stack([-along[:, 1], along[:, 0]], axis=1))
    normals = normals * np.where(table.rails["side"], 1.0, -1.0)[:, None]
    return np.asarray(normals / np.hypot(*normals.T)[:, None])


def _within(centres: Doubles, table: Table, radius: float) -> Doubles:
    """Centres moved away from noses and jaws, even from behind them, and out of pockets."""
    if len(table.pockets) == 0:
        return np.clip(
            centres, radius + 1e-9, np.array([table.width, table.length]) - radius - 1e-9
        )
    centres = centres.copy()
    for rail, normal in zip(table.rails, inward(table)):
        p, along = rail["p"], rail["q"] - rail["p"]
        share, gap = (centres - p) @ along / (along @ along), (centres - p) @ normal
        behind = (share > 0.0) & (share < 1.0) & (np.abs(gap) < radius)
        centres[behind] += np.outer(radius + 1e-9 - gap[behind], normal)
    for circles, reach in ((table.jaws, radius), (table.pockets, 0.0)):
        for circle in circles:
            way = centres - circle["centre"]
            distance: Doubles = np.hypot(way[:, 0], way[:, 1])
            least = float(circle["radius"]) + reach + 1e-9
            inside = np.flatnonzero((distance < least) & (distance > 0.0))
            centres[inside] += way[inside] * (least / distance[inside] - 1.0)[:, None]
    return centres


# A break: so many balls beside the struck one begin to move within a time, s. The samples of its
# first stage end so soon after that, s.
_BROKEN, _AT_ONCE, _AFTER_CONTACT = 4, 0.15, 0.05


def _contact(shot: Recording) -> tuple[float, int]:
    """The time at which the first ball other than the struck one moves, s, or inf, and how many
    begin to move at about that time.
    """
    moves = np.delete(shot.moves, shot.cue)
    time = float(min(moves, default=np.inf))
    return time, int((moves < time + _AT_ONCE).sum())


def is_break(shot: Recording) -> bool:
    """Whether the struck ball breaks up a pack.

    The result of a break depends on gaps that no camera resolves: at positions with 0.5 mm of
    noise, the true strike of a break at 6 m/s has an error of 50 to 190 mm after 1 s.
    """
    return bool(np.isfinite(shot.moves).any()) and _contact(shot)[1] >= _BROKEN


def first_end(shot: Recording) -> float:
    """The time on the clock of a play up to which the first stage takes samples, s."""
    if not is_break(shot):
        return FIRST
    return min(FIRST, _contact(shot)[0] + _AFTER_CONTACT - origin(shot))


def origin(shot: Recording) -> float:
    """The time on the clock of a recording at which the clock of a play begins, s."""
    cue = shot.cue
    return float(max(shot.tracks[cue][shot.still[cue] - 1, 0], shot.moves[cue] - _STILL))


def _line(rows: Doubles) -> tuple[Doubles, Doubles]:
    """The middle (t, x, y) of rows, and the velocity by the line through them."""
    t = rows[:, 0] - rows[:, 0].mean()
    return rows.mean(axis=0), t @ rows[:, 1:] / (t @ t)


def _off_rails(
    shot: Recording, table: tuple[float, float], radius: float
) -> list[tuple[float, float, float]]:
    """Speeds, directions and times of strikes at a rail that is so near that the first recorded
    motion may be the rebound.

    The ball leaves a rail with a speed w across it, within reach of it. It may have arrived with
    _REBOUND times w; the time of the strike then precedes the path to the rail and back.
    """
    track, rest = shot.tracks[shot.cue], shot.rest[shot.cue]
    elapsed = track[:, 0] - shot.moves[shot.cue]
    found = []
    for begin, end in _WINDOWS:
        rows = track[(elapsed >= begin) & (elapsed <= end)]
        if len(rows) < 2:
            continue
        middle, velocity = _line(rows)
        for axis in range(2):
            for away, gap in (
                (1.0, rest[axis] - radius),
                (-1.0, table[axis] - radius - rest[axis]),
            ):
                leaving, gap = away * float(velocity[axis]), max(float(gap), 0.0)
                if leaving < 0.2 or gap > _NEAR * leaving:
                    continue
                arriving = velocity.copy()
                arriving[axis] = -away * _REBOUND * leaving
                way = away * float(middle[axis + 1] - rest[axis])
                time = middle[0] - gap / (_REBOUND * leaving) - (way + gap) / leaving
                speed, angle = np.hypot(*arriving), np.arctan2(arriving[1], arriving[0])
                found.append((float(speed), float(angle), float(time)))
    return found


def starts(shot: Recording, table: tuple[float, float], radius: float) -> Doubles:
    """Strikes to start from, (n, 6), on the clock of the recording."""
    cue = shot.cue
    track, rest = shot.tracks[cue], shot.rest[cue]
    still = int(np.searchsorted(track[:, 0], shot.moves[cue]))
    second_start = min(
        (time for ball, time in enumerate(shot.moves) if ball != cue), default=np.inf
    )
    # moving samples, up to 80 ms, at least a frame before another ball is seen to move
    picture = (
        float(np.median(np.diff(track[still : still + 12, 0]))) if len(track) > still + 1 else 0.02
    )
    known = 1
    while still + known < len(track) and track[still + known, 0] <= min(
        track[still, 0] + 0.082, second_start - 1.05 * picture
    ):
        known += 1
    # velocity by the line through all but the first quarter, the strike's time by the way back to
    # rest
    rows = (
        track[still + known // 4 : still + known]
        if known >= 2
        else np.array([[track[still, 0] - picture, *rest], track[still]])
    )
    t = rows[:, 0] - rows[:, 0].mean()
    velocity = t @ rows[:, 1:] / (t @ t)
    speed, angle = float(np.hypot(*velocity)), float(np.arctan2(velocity[1], velocity[0]))
    middle = rows.mean(axis=0)
    begin = (
        middle[0] - float(np.hypot(*(middle[1:] - rest))) / max(speed, 0.1)
        if known > 1
        else track[still, 0] - 0.5 * picture
    )
    # a few samples before the first hit determine the direction as roughly as their noise, and a single
    # one does not determine the speed
    rough = 0.108 if known <= 2 else 0.016 if known == 3 else 0.0
    noise = float(shot.noises(rest))
    rough = max(rough, 2.0 * min(noise / (max(speed, 0.3) * float(np.sqrt(t @ t))), 0.1))
    turns = np.linspace(-rough, rough, 13 if rough > 0.05 else 5) if rough > 0.008 else np.zeros(1)
    faster = np.array([1.0, 1.5, 2.2]) if known == 1 else np.ones(1)
    sides, follows = (
        (np.linspace(-1.3, 1.3, 5), np.linspace(-0.9, 1.0, 4))
        if known <= 3
        else (np.linspace(-1.3, 1.3, 9), np.linspace(-0.9, 1.0, 6))
    )
    grids = [_grid(speed, angle, begin, turns, faster, sides, follows)]
    for motion in _off_rails(shot, table, radius):
        grids.append(_grid(*motion, *_ROUGH))
    return np.concatenate(grids)


def _grid(
    speed: float,
    angle: float,
    begin: float,
    turns: Doubles,
    faster: Doubles,
    sides: Doubles,
    follows: Doubles,
) -> Doubles:
    """Strikes around a speed, a direction and a time, with spins relative to the speed."""
    turn, fast, side, follow = (
        grid.ravel() for grid in np.meshgrid(turns, faster, sides, follows, indexing="ij")
    )
    v, x, y = speed * fast, np.cos(angle + turn), np.sin(angle + turn)
    return np.stack(
        [v * x, v * y, -y * follow * v, x * follow * v, side * v, np.full_like(v, begin)], axis=-1
    )


def allowed(strikes: Doubles) -> Doubles:
    """Strikes within their bounds."""
    strikes = strikes.copy()
    most = _SPIN_MOST * np.hypot(strikes[:, :1], strikes[:, 1:2]) + 0.2
    strikes[:, 2:5] = np.clip(strikes[:, 2:5], -most, most)
    strikes[:, 5] = np.clip(strikes[:, 5], EARLIEST, LATEST)
    return strikes


def at_bound(strike: Doubles) -> str:
    """The parameter of a strike, on the clock of its play, that is at its bound, if any."""
    within = allowed(np.array([strike - 1e-6, strike + 1e-6]))[[0, 1], :] - (
        strike - 1e-6,
        strike + 1e-6,
    )
    names = ("speed", "speed", "spin", "spin", "spin", "time")
    return next((name for name, off in zip(names, np.abs(within).max(axis=0)) if off > 5e-7), "")


def normal(sums: Doubles) -> tuple[Doubles, Doubles]:
    """J^T W J, (n, m, m), and J^T W d, (n, m), of the sums of n plays."""
    m = (int(math.isqrt(9 + 8 * (sums.shape[1] - 4))) - 3) // 2
    lower = np.tril_indices(m)
    square = np.zeros((len(sums), m, m))
    square[:, lower[0], lower[1]] = square[:, lower[1], lower[0]] = sums[:, 4 + m :]
    return square, sums[:, 4 : 4 + m]


def descend(
    plays: Plays,
    shots: Integers,
    strikes: Doubles,
    end: Doubles,
    iterations: int,
    *,
    huber: float = HUBER,
    held: Doubles | None = None,
    sums: Doubles | None = None,
) -> tuple[Doubles, Doubles]:
    """Levenberg and Marquardt's method from each strike: the strikes found, (n, numbers), and the
    sums of `misfit` there.

    An iteration plays each unfinished start once, and if its cost decreases, once more per
    parameter for the next step. `held`, (n, numbers), is the cost of the square of each parameter,
    such as kicks after the six parameters of a strike; default: none. `sums` are the sums of
    `misfit` at the strikes, if they are known.
    """
    strikes = allowed(strikes)
    n, numbers = strikes.shape
    held = np.zeros((n, numbers)) if held is None else held
    if sums is None:
        sums = plays.misfit(shots, strikes, end, np.inf, huber=huber)
    sums = sums.copy()
    costs = sums[:, 0] + (held * strikes**2).sum(axis=1)
    damping, failed = np.full(n, 1e-2), np.zeros(n, int)
    active = np.isfinite(costs)
    diagonal = np.arange(numbers)
    for _ in range(iterations):
        rows = np.flatnonzero(active)
        if len(rows) == 0:
            break
        # the step; what no sample depends on stays where it is
        square, gradient = normal(sums[rows])
        square[:, diagonal, diagonal] += held[rows]
        scale = square[:, diagonal, diagonal]
        square[:, diagonal, diagonal] += damping[rows, None] * scale + 1e-12 * (
            1.0 + scale.sum(axis=1, keepdims=True)
        )
        step = np.linalg.solve(square, -(gradient + held[rows] * strikes[rows])[..., None])[..., 0]
        tried = allowed(strikes[rows] + step)
        # taken where the cost falls; else a shorter one next time, up to six times
        price = (held[rows] * tried**2).sum(axis=1)
        new = plays.misfit(shots[rows], tried, end[rows], costs[rows] - price, huber=huber)
        cost = new[:, 0] + price
        better = cost < costs[rows]
        drop = 1.0 - cost / costs[rows]
        strikes[rows[better]], sums[rows[better]], costs[rows[better]] = (
            tried[better],
            new[better],
            cost[better],
        )
        damping[rows] = np.where(better, np.maximum(0.2 * damping[rows], 1e-9), 6.0 * damping[rows])
        failed[rows] = np.where(better, 0, failed[rows] + 1)
        active[rows] = np.where(better, drop > 1e-5, failed[rows] < 6)
    return strikes, sums


def derivatives(
    plays: Plays, row: int, strike: Doubles, names: list[str], rest: bool = True
) -> tuple[Doubles, Doubles, Doubles, Doubles]:
    """For one shot: the distances of all samples, evened, (2 n,), and their derivatives by the
    strike, (2 n, 6), by constants, and with `rest` by initial positions.

    The derivatives are tangents of the complete shot in double precision. The time of the strike is
    on the clock of the plays.
    """
    tracks, struck = plays.tracks[row], int(plays.struck[row])
    balls = plays.layouts[0, row, : plays.balls[row]].copy()
    balls["state"]["v"][struck, :2] = strike[:2]
    balls["state"]["w"][struck] = strike[2:5] / plays.radius
    played = simulate(plays.table, balls, cushion_model=plays.cushion_model)

    # the tangents at all times of samples, on the clock of the play
    times = np.unique(np.concatenate([track[:, 0] for track in tracks]))
    moments = np.maximum(times - strike[5], 0.0)
    wrt = [f"balls[{struck}].v", f"balls[{struck}].w", *map(_constants.path, names)]
    wrt += [f"balls[{ball}].r" for ball in range(len(balls)) if rest]
    found = tangents(played, wrt, times=moments).at["r"]
    states = played.states(moments)

    distances, slopes, shot = [], [], plays.recordings[row]
    for ball, track in enumerate(tracks):
        when = np.searchsorted(times, track[:, 0])
        J = found[when, ball, :2]
        J[..., 2:5] /= plays.radius  # by R w
        later = np.where((times[when] > strike[5])[:, None], -states["v"][when, ball, :2], 0.0)
        distance = states["r"][when, ball, :2] - track[:, 1:]
        slope = np.concatenate([J[..., :5], later[..., None], J[..., 5:]], axis=-1)
        if shot.view is not None:
            evening = shot.view.evening(track[:, 1:])
            distance, slope = shot.evened(track[:, 1:], distance), evening @ slope
        distances.append(distance)
        slopes.append(slope)
    d, J = np.concatenate(distances).ravel(), np.concatenate(slopes)
    J = J.reshape(len(d), -1)
    return d, J[:, :6], J[:, 6 : 6 + len(names)], J[:, 6 + len(names) :]
