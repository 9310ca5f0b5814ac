"""Recorded shots, and the artefacts of cameras: noise, false detections, and swapped names.

All artefacts are detected from the rows, without simulating shots. A ball is not faster than it was
just before or after a row. A row is therefore false if it is out of reach from the rows before and
after it, while these are in reach of each other. If two balls simultaneously jump to each other's
positions, which are out of reach, their names were swapped.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.dtypes import Doubles
from carom.layouts import Table

NOISE = 0.35e-3
"""m: standard deviation of a coordinate that a good camera gives for a slow ball, as found on real
tracks.
"""
MOVED = 3e-3
"""m: a ball that is farther than this from its place of rest has moved; more where the noise is
large.
"""

# the least square, in errors, of three numbers of a bent picture; of straight ones it is 3 in the
# mean
_BENT = 40.0
_NOISY = (
    7e-4  # m: noise above which places are averaged over bins of time before turns are looked for,
)
_BIN = 0.016  # s
# standard deviations from its place of rest where a ball has moved: noise goes so far in 3 of ten
# million rows
_NOISES = 5.5
_FASTER = 1.5  # a ball goes so many times as fast as it was seen to, at most
_THINNED = 0.03  # m: a ball goes so far without a row, at most
_SLIDING = 2.0  # m/s^2: about how fast a ball that slides away from a cushion slows down
_FAR = 8e-3  # m: a ball moves that goes farther in five rows
_FROZEN = 0.05  # share of steps without motion above which a film repeats places
# m: a centre that is farther outside its bounds was measured in other units or on another table; a
# crooked one is nearer
OUTSIDE = 0.06
ON_TABLE = 0.9  # share of the places that lie on the right table, at least
_HOLE = 0.1  # m: a centre that is nearer to that of a pocket is in it
_DEPTH = 2.5e-3  # s: a nose gives way by so much times the speed
_SCATTER = 4e-3  # m: of where balls turn at a rail, at least
_BLOCK = 3  # false detections one after another, at most


class TrackError(ValueError):
    """A file of tracks is invalid; the message contains the line and a remedy."""


@dataclass(frozen=True, eq=False)
class View:
    """How a camera sees the table: the noise of a place is a pixel's, spread by the perspective.

    With the pixel u of a place p, the matrix du/dp turns a deviation of a place into one in the
    picture, where both coordinates have the same noise everywhere.
    """

    matrix: Doubles  # (3, 3): turns homogeneous pixels into places, m
    scale: (
        float  # m a pixel: the root of the mean square over the rows of a file and both coordinates
    )

    @classmethod
    def over(cls, matrix: Doubles, places: Doubles) -> View:
        """The view of a file whose rows are at these places, m, (n, 2)."""
        steps = np.linalg.inv(cls(matrix, 1.0).evening(places))
        return cls(matrix, float(np.sqrt(0.5 * (steps**2).sum(axis=(1, 2)).mean())))

    def evening(self, places: Doubles) -> Doubles:
        """The matrices, (..., 2, 2), that turn deviations of places, m, into ones of equal noise,
        which are those in the picture times `scale`.
        """
        back = np.linalg.inv(self.matrix)
        q = places @ back[:, :2].T + back[:, 2]
        pixels, depths = q[..., :2] / q[..., 2:], q[..., 2:, np.newaxis]
        return np.asarray(
            self.scale * (back[:2, :2] - pixels[..., np.newaxis] * back[2, :2]) / depths
        )


@dataclass(frozen=True, eq=False)
class Recording:
    """One recorded shot."""

    id: int | str  # As in the file
    balls: tuple[int | str, ...]  # The names of the balls, as in the file
    tracks: tuple[Doubles, ...]  # Of each ball t (s), x and y (m); the first row is at rest
    noise: float = NOISE
    """m: standard deviation of a coordinate; with a view, its root of the mean square in the file."""
    view: View | None = None  # Without: all rows have the same noise

    def evened(self, places: Doubles, offsets: Doubles) -> Doubles:
        """Deviations from places, m, (..., 2), as ones with the standard deviation `noise`."""
        if self.view is None:
            return offsets
        found: Doubles = (self.view.evening(places) @ offsets[..., np.newaxis])[..., 0]
        return found

    def deviations(self, places: Doubles) -> Doubles:
        """The standard deviations of x and y at places, m, (..., 2)."""
        if self.view is None:
            return np.full(np.shape(places), self.noise)
        steps = np.linalg.inv(self.view.evening(places))
        return np.asarray(self.noise * np.sqrt((steps**2).sum(axis=-1)))

    def noises(self, places: Doubles) -> Doubles:
        """The standard deviation of a coordinate at places, m, (...): the root of the mean square of
        x and y.
        """
        return np.asarray(np.sqrt((self.deviations(places) ** 2).mean(axis=-1)))

    def moved(
        self, places: Doubles, offsets: Doubles, noises: float = _NOISES
    ) -> NDArray[np.bool_]:
        """Whether balls at places, (..., 2), with these offsets from where they were, m, moved: by
        more than MOVED and than so many standard deviations.
        """
        evened = self.evened(places, offsets)
        far = np.hypot(offsets[..., 0], offsets[..., 1]) > MOVED
        return np.asarray(far & (np.hypot(evened[..., 0], evened[..., 1]) > noises * self.noise))

    @functools.cached_property
    def still(self) -> list[int]:
        """The number of rows of each ball before it moved, shape (balls,)."""
        return [self._still(track) for track in self.tracks]

    @functools.cached_property
    def rest(self) -> Doubles:
        """The initial positions of the balls, m, shape (balls, 2): the mean of the rows before they
        moved.
        """
        return np.array(
            [track[:still, 1:].mean(axis=0) for track, still in zip(self.tracks, self.still)]
        )

    @functools.cached_property
    def moves(self) -> Doubles:
        """The time of each ball's first row away from its initial position, s, shape (balls,); inf
        if it never moves.
        """
        return np.array(
            [(*track[still:, 0], math.inf)[0] for track, still in zip(self.tracks, self.still)]
        )

    @functools.cached_property
    def cue(self) -> int:
        """The index of the struck ball: the one that moves first.

        Of balls that begin to move within 60 ms, it is the one whose path looks least like the
        result of a hit: a ball that is hit moves away from the other.
        """
        moves = self.moves
        if not np.isfinite(moves).any():
            raise TrackError(
                f"shot {self.id}: no ball moves by more than {1e3 * MOVED:g} mm and {_NOISES:g} times the noise, "
                f"{1e3 * self.noise:.2g} mm, so there is no strike to fit"
            )
        first = np.flatnonzero(moves <= moves.min() + 0.06)
        ways = [self.tracks[k][self.still[k], 1:] - self.rest[k] for k in first]
        # cosines of the ways with the directions from the other balls that move
        hit = [
            max(
                [
                    way
                    @ (self.rest[k] - self.rest[j])
                    / np.hypot(*way)
                    / max(np.hypot(*(self.rest[k] - self.rest[j])), 1e-9)
                    for j in first
                    if j != k
                ],
                default=0.0,
            )
            for k, way in zip(first, ways)
        ]
        return int(first[int(np.argmin(hit))])

    @functools.cached_property
    def moving(self) -> list[NDArray[np.intp]]:
        """The moving rows of each ball: each has `moved` from the one before, and the first from the
        initial position.
        """
        found = []
        for track, rest_time in zip(self.tracks, self.rest):
            rows = []
            for k, place in enumerate(track[:, 1:]):
                if self.moved(place, place - rest_time):
                    rows.append(k)
                    rest_time = place
            found.append(np.array(rows, np.intp))
        return found

    @property
    def end(self) -> float:
        """The time of the last row, s."""
        return float(max(track[-1, 0] for track in self.tracks))

    def _still(self, track: Doubles) -> int:
        """The number of rows at the initial position: near the first row, then near the mean of the
        first few.
        """
        rest, noises = track[0, 1:], 1.5 * _NOISES
        for _ in range(3):
            away = self.moved(track[:, 1:], track[:, 1:] - rest, noises)
            # motion needs two rows in sequence: a single one is noise, which is larger at the far
            # end of a camera's view
            away[:-1] &= away[1:]
            still = max(int(np.argmax(away)), 1) if away.any() else len(track)
            rest, noises = track[: min(still, 12), 1:].mean(axis=0), _NOISES
        return still


# ---- Positions


def is_inside(
    places: Doubles, table: Sequence[float], radius: float, pockets: Doubles | None = None
) -> NDArray[np.bool_]:
    """Whether centres, (n, 2), are on the table, slightly outside, or in a pocket."""
    low, high = radius - OUTSIDE, np.array(table) - radius + OUTSIDE
    inside = ((low <= places) & (places <= high)).all(axis=-1)
    if pockets is not None and len(pockets):
        gaps = places[..., None, :] - pockets
        inside |= (np.hypot(gaps[..., 0], gaps[..., 1]) < _HOLE).any(axis=-1)
    return np.asarray(inside)


def exchanged(places: Doubles, table: tuple[float, float], radius: float, pockets: Doubles) -> bool:
    """Whether the extents of a table are exchanged."""
    return bool(
        is_inside(places, table, radius, pockets).mean() < ON_TABLE
        and is_inside(places[:, ::-1], table, radius, pockets).mean() >= ON_TABLE
    )


# ---- Noise


@dataclass(frozen=True)
class Noise:
    """The noise of recordings, m."""

    value: float  # the standard deviation of a coordinate: the root of the mean of both squares
    axes: tuple[float, float]  # of x and of y, evened
    rest: float  # from the rows at rest; 0 without any
    is_frozen: bool  # whether a film repeats the positions of balls at rest


def _spread(values: Doubles) -> float:
    """A standard deviation by the median."""
    return 1.4826 * float(np.median(np.abs(values)))


def _misfits(recordings: Sequence[Recording]) -> tuple[Doubles, Doubles, Doubles]:
    """For each row: its residuals in x and y from the quadratic through five rows, evened and
    relative to noise; the path through these rows relative to a slow ball's; and the distance from the first to
    the last, m.
    """
    misfits, ways, moves = [np.zeros((0, 2))], [np.zeros(0)], [np.zeros(0)]
    for shot in recordings:
        for track in shot.tracks:
            if len(track) < 5:
                continue
            windows = np.lib.stride_tricks.sliding_window_view(track, 5, axis=0)
            t = windows[:, 0] - windows[:, 0, 2:3]
            span = t[:, -1] - t[:, 0]
            windows, t, span = windows[span < 0.4], t[span < 0.4], span[span < 0.4]
            places = windows[:, 1:]
            t = t / span[:, None]
            # the row of the middle of the hat matrix: its t is 0
            A = np.stack([np.ones_like(t), t, t * t], axis=-1)
            hat = (A @ np.linalg.inv(A.transpose(0, 2, 1) @ A)[:, :, :1])[..., 0]
            left = places[..., 2] - (places @ hat[..., None])[..., 0]
            left = left / np.sqrt(np.maximum(1.0 - hat[:, 2:3], 1e-9))
            misfits.append(shot.evened(places[..., 2], left))
            steps = np.hypot(*np.diff(places, axis=2).transpose(1, 0, 2))
            ways.append(steps.sum(axis=1) / (1.0 * span + 0.02))
            moves.append(np.hypot(*(places[..., -1] - places[..., 0]).T))
    return np.concatenate(misfits), np.concatenate(ways), np.concatenate(moves)


def moving_scatter(recordings: Sequence[Recording]) -> float:
    """The scatter of a coordinate of balls that move, about quadratics through five rows, m."""
    misfits, _, moves = _misfits(recordings)
    misfits = misfits[moves > _FAR]
    return _spread(misfits) if len(misfits) else math.inf


def noise_of(recordings: Sequence[Recording]) -> Noise:
    """The noise, from rows at rest, or from slow balls if there are too few; if a film freezes
    balls at rest, from slow moving balls; NOISE without any.
    """
    misfits, ways, moves = _misfits(recordings)
    slow = misfits[ways < 1.0]
    sample = slow if len(slow) >= 10 else np.full((1, 2), NOISE / 1.4826)
    # rows at rest are those within what moves
    lain: list[Doubles] = [np.zeros((0, 2))]
    for shot in recordings:
        known = replace(shot, noise=max(_spread(sample), 1e-4))
        for track, still in zip(known.tracks, known.still):
            if still >= 8:
                rows = track[:still, 1:]
                offsets = (rows - np.median(rows, axis=0)) * math.sqrt(still / (still - 1.0))
                lain.append(shot.evened(rows, offsets))
    at_rest = np.concatenate(lain)
    rest = _spread(at_rest) if len(at_rest) >= 30 else 0.0
    if rest > 0.0:
        sample = at_rest
    # a film that freezes balls repeats their places, which noise does in one row of 400
    moving = misfits[(ways < 1.0) & (moves > max(_FAR, 8.0 * _spread(sample)))]
    scatter = _spread(moving) if len(moving) >= 30 else 0.0
    steps = np.concatenate(
        [np.hypot(*np.diff(track[:, 1:], axis=0).T) for s in recordings for track in s.tracks]
    )
    is_frozen = scatter > 1e-4 and float(np.mean(steps < 0.1 * scatter)) > _FROZEN
    axes = tuple(_spread((moving if is_frozen else sample)[:, axis]) for axis in (0, 1))
    value = math.hypot(*axes) / math.sqrt(2.0) if is_frozen else _spread(sample)
    return Noise(max(value, 5e-5), (axes[0], axes[1]), rest, is_frozen)


# ---- Balls that fall


def until_pocketed(shot: Recording, table: Table) -> Recording:
    """A recording in which each track ends when its ball falls.

    This is the first row in or behind a pocket that is the last row or is followed by another such
    row. A ball without rows before it is removed.
    """
    if len(table.pockets) == 0:
        return shot
    holes, kept = table.pockets["centre"], []
    for name, track in zip(shot.balls, shot.tracks):
        r = track[:, 1:]
        gaps = np.hypot(*np.moveaxis(r[:, None] - holes, 2, 0)) - table.pockets["radius"]
        behind = (r < holes.min(axis=0)) | (r > holes.max(axis=0))
        inside = np.append((gaps < 0.0).any(axis=1) | behind.any(axis=1), True)
        falls = np.flatnonzero(inside[:-1] & inside[1:])
        rows = track[: falls[0]] if len(falls) else track
        if len(rows):
            kept.append((name, rows))
    names, tracks = zip(*(kept or [(shot.balls[0], shot.tracks[0][:1])]))
    return replace(shot, balls=names, tracks=tracks)


# ---- False detections and swapped names


def _reached(
    track: Doubles,
    first: NDArray[np.intp],
    last: NDArray[np.intp],
    noises: Doubles,
    ends: tuple[Any, Any] | None = None,
) -> NDArray[np.bool_]:
    """Whether a ball can move from row `first` to row `last` at its speed around the rows `ends`.

    `noises` are those of the rows, m. A ball without rows for a long time is at rest.
    """
    t, r = track[:, 0], track[:, 1:]
    dt = np.diff(t)
    speed = np.where(dt < 0.2, np.hypot(*np.diff(r, axis=0).T) / dt, 0.0)
    left, right = ends or (first, last)
    speed_before = np.where(left > 0, speed[left - 1], 0.0)
    speed_after = np.where(right < len(speed), speed[np.minimum(right, len(speed) - 1)], 0.0)
    most = (
        _FASTER * np.maximum(speed_before, speed_after) * np.minimum(t[last] - t[first], 0.12)
        + 8.0 * np.maximum(noises[first], noises[last])
        + 2e-3
    )
    return np.asarray(
        np.hypot(*(r[last] - r[first]).T)
        <= most + np.where(t[last] - t[first] < 0.2, 0.0, _THINNED)
    )


def without_false(track: Doubles, shot: Recording) -> Doubles:
    """A track of a shot without its false rows."""
    for block in (1, 2, 1, _BLOCK, 1):
        n = len(track)
        if n < block + 4:
            break
        k, noises = np.arange(1, n - block), shot.noises(track[:, 1:])
        # neither reached from before nor from behind, while these reach each other
        preceding, following = k - 1, k + block
        reached = [
            _reached(track, *rows, noises, (preceding, following))
            for rows in ((preceding, k), (following - 1, following), (preceding, following))
        ]
        false = k[~reached[0] & ~reached[1] & reached[2]]
        track = np.delete(track, np.unique(false[:, None] + np.arange(block)), axis=0)
    # the first row, where those after it are at rest, and the last
    if len(track) >= 5:
        off = track[:5, 1:] - track[1:5, 1:].mean(axis=0)
        moved = shot.moved(track[1:5, 1:], off[1:])
        jumped = shot.moved(track[0, 1:], off[0], 1.5 * _NOISES) and np.hypot(*off[0]) > 2.0 * MOVED
        if jumped and not moved.any():
            track = track[1:]
        last, noises = np.array([len(track) - 1]), shot.noises(track[:, 1:])
        if track[-1, 0] - track[-2, 0] < 0.2 and not _reached(track, last - 1, last, noises)[0]:
            track = track[:-1]
    return track


def without_swaps(shot: Recording) -> tuple[list[Doubles], list[tuple[int, int, float]]]:
    """The tracks of a shot with corrected names, and which two were swapped from which time."""
    mended, swaps = list(shot.tracks), list[tuple[int, int, float]]()
    reach = 0.04 + 6.0 * shot.noise

    def place(track: Doubles, k: int, time: float) -> Doubles:
        """The position of a ball at a time, from its row k and the one before."""
        dt = track[k, 0] - track[k - 1, 0] if k else math.inf
        velocity = (track[k, 1:] - track[k - 1, 1:]) / dt if dt < 0.2 else np.zeros(2)
        point: Doubles = track[k, 1:] + velocity * min(time - track[k, 0], 0.1)
        return point

    while len(swaps) < 20:
        found = None
        for a, track in enumerate(mended):
            k = np.arange(len(track) - 1)
            noises = shot.noises(track[:, 1:])
            for row in (k[~_reached(track, k, k + 1, noises)] + 1).tolist():
                time = track[row, 0]
                for b, partner in enumerate(mended):
                    index = int(np.searchsorted(partner[:, 0], time - 1e-6))
                    if b == a or index == 0 or (found is not None and time >= found[2]):
                        continue
                    # the one goes to where the other was, which goes to its place or is not seen
                    # where rows at rest are left out
                    point = np.hypot(*(track[row, 1:] - place(partner, index - 1, time))) < reach
                    back = index == len(partner) or partner[index, 0] > time + 0.2
                    back = (
                        back
                        or np.hypot(
                            *(partner[index, 1:] - place(track, row - 1, partner[index, 0]))
                        )
                        < reach
                    )
                    if point and back:
                        found = (a, b, time)
        if found is None:
            break
        a, b, time = found
        cuts = [int(np.searchsorted(mended[ball][:, 0], time - 1e-6)) for ball in (a, b)]
        mended[a], mended[b] = (
            np.concatenate([mended[a][: cuts[0]], mended[b][cuts[1] :]]),
            np.concatenate([mended[b][: cuts[1]], mended[a][cuts[0] :]]),
        )
        swaps.append((min(a, b), max(a, b), float(time)))
    return mended, swaps


def sound(recordings: Sequence[Recording], noise: float) -> tuple[list[Recording], list[list[str]]]:
    """Recordings with their noise, without false rows and swapped names; and the corrections in
    each.
    """
    mended: list[Recording] = []
    notes: list[list[str]] = []
    for shot in recordings:
        shot = replace(shot, noise=noise)
        tracks, swaps = without_swaps(shot)
        tracks = [without_false(track, shot) for track in tracks]
        lost = 1.0 - sum(map(len, tracks)) / sum(map(len, shot.tracks))
        remarks = [
            f"balls {shot.balls[a]} and {shot.balls[b]} swapped from {time:.2f} s on"
            for a, b, time in swaps
        ]
        if lost > 0.0:
            remarks.append(f"{100.0 * lost:.2g} % false detections, left out")
        mended.append(replace(shot, tracks=tuple(tracks)))
        notes.append(remarks)
    return mended, notes


# ---- Alignment with the table


@dataclass(frozen=True)
class Lie:
    """The alignment of tracks with the table: positions are rotated about (0, 0), scaled and
    shifted, and distorted by a lens or an oblique camera.
    """

    angle: float = 0.0  # degrees, from x to y
    scale: float = 1.0
    shift: tuple[float, float] = (0.0, 0.0)  # m
    far: float = 0.0  # m: how far a place is off by it, at most
    error: float = math.inf  # m: of that
    impacts: int = 0  # which tell it
    bend: tuple[float, ...] = (
        0.0,
        0.0,
        0.0,
    )  # k, 1/m^2, and g, 1/m: a place is off by q (k |q|^2 + g q), q being r - middle
    middle: tuple[float, float] = (0.0, 0.0)  # m, of the table
    bent: float = 0.0  # m: how far a corner is off by that, at most

    def places(self, r: Doubles) -> Doubles:
        """Corrected positions."""
        turn = math.radians(self.angle)
        back = (
            np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
            / self.scale
        )
        return np.asarray((r - self.shift) @ back - self.field(r))

    def field(self, r: Doubles) -> Doubles:
        """The displacement of positions by the lens and the obliqueness of the camera."""
        q = r - self.middle
        return np.asarray(q * (self.bend[0] * (q * q).sum(axis=-1) + q @ self.bend[1:])[..., None])

    def __str__(self) -> str:
        reach = math.hypot(*self.middle)
        is_lens = abs(self.bend[0]) * reach > math.hypot(*self.bend[1:])
        cause = "a lens" if is_lens else "a camera that looks askew"
        bent = f", bent by up to {1e3 * self.bent:.1f} mm as by {cause}," if self.bent else ""
        return (
            f"turned by {self.angle:.2f} degrees, {self.scale:.4f} times as large as the table{bent} and moved by "
            f"{1e3 * self.shift[0]:.1f}, {1e3 * self.shift[1]:.1f} mm"
        )


def _averaged(track: Doubles) -> Doubles:
    """Rows averaged over bins of time, in which noise causes no turns."""
    _, first = np.unique(np.floor(track[:, 0] / _BIN), return_index=True)
    return np.asarray(
        np.add.reduceat(track, first, axis=0) / np.diff(np.append(first, len(track)))[:, None]
    )


def _turns(track: Doubles, axis: int, noise: float) -> Doubles:
    """The turning points of the coordinate along an axis, for example at cushions: rows of its
    value, the other coordinate, and its speed before.
    """
    gap = 1e-4
    if noise > _NOISY:
        track, gap = (
            _averaged(track),
            1.1 * _BIN,
        )  # a bin beside that of the turn may have a part of it
    x = track[:, 1 + axis]
    found = []
    for k in (np.flatnonzero(np.diff(x[:-1]) * np.diff(x[1:]) < 0.0) + 1).tolist():
        # lines through the rows before and after, fewer after, where the ball slides; without the
        # row of the turn itself
        t = track[:, 0] - track[k, 0]
        incoming, outgoing = (
            np.flatnonzero((t < -gap) & (t > -0.1))[-4:],
            np.flatnonzero((t > gap) & (t < 0.1))[:4],
        )
        outgoing = outgoing[: max(int((t[outgoing] < 0.045).sum()), 2)]
        if len(incoming) < 2 or len(outgoing) < 2:
            continue
        slid = np.sign(x[outgoing[-1]] - x[k]) * 0.5 * _SLIDING * t[outgoing] ** 2
        (v, x_0), (w, x_1) = (
            np.polyfit(t[incoming], x[incoming], 1),
            np.polyfit(t[outgoing], x[outgoing] + slid, 1),
        )
        if v * w < 0.0 and min(abs(v), abs(w)) > 0.15:
            time = (x_0 - x_1) / (w - v)
            along = np.interp(time, t, track[:, 2 - axis])
            found.append((x_0 + v * time, along, v))
    return np.array(found).reshape(-1, 3)


def _least(off: Doubles, A: Doubles) -> tuple[Doubles, Doubles, float]:
    """Robust least squares: the parameters for which A @ parameters fits `off`, their covariance,
    and the typical residual, m.
    """
    weight: Doubles = np.ones(len(A))
    numbers: Doubles = np.zeros(A.shape[1])
    spread = 0.0
    for _ in range(30):
        numbers = np.asarray(
            np.linalg.lstsq(A * weight[:, None], off * weight, rcond=None)[0], np.float64
        )
        left = off - A @ numbers
        spread = max(1.4826 * float(np.median(np.abs(left))), 1e-4)
        weight = np.asarray(1.0 / np.sqrt(1.0 + (left / (2.0 * spread)) ** 2))
    weighted = A * weight[:, None]
    return numbers, np.asarray(spread**2 * np.linalg.pinv(weighted.T @ weighted)), spread


def _impacts(
    recordings: Sequence[Recording], table: tuple[float, float], radius: float
) -> tuple[NDArray[np.intp], Doubles]:
    """Impacts on cushions: rail 0 (x = 0), 1 (x = W), 2 (y = 0) or 3 (y = L), the offset of the
    turn from one radius along its axis, and the row of least squares of `lie_of`.
    """
    middle = (0.5 * table[0], 0.5 * table[1])
    rails, rows = [np.zeros(0, np.intp)], [np.zeros((0, 9))]
    for shot in recordings:
        for track, still in zip(shot.tracks, shot.still):
            for axis in (0, 1):
                found = _turns(track[max(still - 1, 0) :], axis, shot.noise)
                places = np.where(found[:, 2] > 0.0, table[axis] - radius, radius)
                close = np.abs(found[:, 0] - places) < 0.07
                x, along, v, c = found[close, 0], found[close, 1], found[close, 2], places[close]
                ones, none = np.ones_like(x), np.zeros_like(x)
                turn = along if axis == 0 else -along
                q = np.stack([x, along] if axis == 0 else [along, x], axis=-1) - middle
                bent = q[:, axis, None] * np.column_stack([(q * q).sum(axis=1), q])
                rails.append((2 * axis + (v > 0.0)).astype(np.intp))
                rows.append(
                    np.column_stack(
                        [x - c, x, -turn, *((ones, none) if axis == 0 else (none, ones)), v, bent]
                    )
                )
    return np.concatenate(rails), np.concatenate(rows)


def beyond_rails(
    recordings: Sequence[Recording], table: tuple[float, float], radius: float
) -> dict[int, tuple[float, int]]:
    """For each rail at which two or more balls turn, the offset of the turns, m, and their number.

    Rails with offsets within the scatter are omitted.
    """
    rails, rows = _impacts(recordings, table, radius)
    found = {}
    for rail in np.unique(rails).tolist():
        chosen = rows[rails == rail]
        off = (chosen[:, 0] - _DEPTH * chosen[:, 5]) * (1.0 if rail % 2 else -1.0)
        middle = float(np.median(off))
        scatter = max(1.4826 * float(np.median(np.abs(off - middle))), _SCATTER)
        if len(off) >= 2 and abs(middle) > 4.0 * scatter / math.sqrt(len(off)):
            found[rail] = middle, len(off)
    return found


def lie_of(recordings: Sequence[Recording], table: tuple[float, float], radius: float) -> Lie:
    """The alignment of tracks with the table from impacts on cushions: linear least squares of
    eight parameters.

    A turn at the cushion x = c satisfies c = (1 - s) x + turn y + a + depth v - q_x (k |q|^2 + g
    q), with the scale s, the shift a, and q relative to the middle of the table; the nose yields by
    `depth` times the speed v. Outliers have less weight. k and g are used if they differ
    significantly from 0.
    """
    middle = (0.5 * table[0], 0.5 * table[1])
    _, A = _impacts(recordings, table, radius)
    if len(A) < 30:
        return Lie()
    numbers, covariance, spread = _least(A[:, 0], A[:, 1:])
    bend = numbers[5:]
    if bend @ np.linalg.pinv(covariance[5:, 5:]) @ bend < _BENT:
        numbers, covariance, spread = _least(A[:, 0], A[:, 1:6])
        bend = np.zeros(3)
    # turned and scaled places p of places r are (1 + s) T r + shift; the rows tell r = p - (s p +
    # turn + shift)
    s, turn, a, b = numbers[:4].tolist()
    scale = 1.0 / math.hypot(1.0 - s, turn)
    angle = math.atan2(turn, 1.0 - s)
    back = (
        np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]) / scale
    )
    shift = np.linalg.solve(back.T, np.array([a, b]))
    lie = Lie(
        math.degrees(angle),
        scale,
        (float(shift[0]), float(shift[1])),
        bend=tuple(bend.tolist()),
        middle=middle,
    )
    corners = np.array([[0.0, 0.0], [table[0], 0.0], [table[0], table[1]], [0.0, table[1]]])
    far = float(np.hypot(*(lie.places(corners) - corners).T).max())
    error = math.sqrt(float(covariance[0, 0] + covariance[1, 1])) * math.hypot(*table)
    bent = float(np.hypot(*lie.field(corners).T).max())
    return replace(lie, far=far, error=error, impacts=len(A), bent=bent)
