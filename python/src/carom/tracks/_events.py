"""Events on recorded tracks: pieces of rolling and sliding, impacts on cushions, and hits.

No shot is simulated.

Pieces. On a cloth with constant friction a ball's path is quadratic in time while it slides, and
nearly so while it rolls. Dynamic programming cuts each track into pieces: the cuts minimise the sum
over pieces of chi^2 of a quadratic and a penalty. The standard deviation of a coordinate is s(v) =
hypot(s_0, s_t v), from the noise of positions and, for a fast ball, of times.

Impacts and hits. At a cut where a ball is at a cushion and turns, or touches a ball and changes its
velocity, a local model is fitted to the samples around it, by least squares: before, a path of
constant deceleration; after, sliding from velocity w with slip u,

    r(t) = r_c + w t - (mu_s g/2) u/|u| t^2      until t_s = 2|u|/(7 mu_s g), then rolling with w -
        (2/7) u.

A ball leaves a cushion some milliseconds after it arrived, so the normal component of its path
begins late. This delay is fitted with a prior of 3 +- 6 ms, because 50 frames per second hardly
determine it. Standard errors follow from the least squares.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import lib
from carom._rows import Arrays, pointer
from carom.dtypes import Doubles, Records
from carom.tracks._recordings import Recording

_NOISE, _JITTER = 1.3, 0.25e-3  # s_0 over the noise of the recording, and s_t (s)
# Penalty of a piece, in chi^2; 18 is the log of how many cuts there could be, doubled, for its 7
# numbers. Half of it cuts noise, twice of it leaves out the end of sliding where little slip was
# left.
_PENALTY = 18.0
_LONGEST = 150  # samples of a piece
_SLIDES, _ROLLS = 1.0, 0.5  # m/s^2: a piece slides above, rolls below
_DELAY, _DELAY_ERROR = 0.003, 0.006  # s
_TOUCH = 0.02  # m: at a cut a ball is this close to what it met
_TURN = 0.03  # m/s: least change of velocity in a hit
_BEFORE, _AFTER = 0.6, 0.9  # s: samples of an impact, at most

piece = np.dtype(
    [
        ("shot", "i8"),
        ("ball", "i8"),
        ("begin", "f8"),
        ("end", "f8"),
        ("samples", "i8"),
        ("time", "f8"),
        ("r", "f8", 2),
        ("v", "f8", 2),
        ("a", "f8", 2),
        ("v_error", "f8"),
        ("a_error", "f8"),
        ("rms", "f8"),
        ("sliding", "?"),
        ("rolling", "?"),
    ]
)
"""A piece of a track: index of the recording and of the ball; first and last time (s); place,
velocity and acceleration at `time`; errors of a component; root of the mean squared distance of the
samples (m); whether the ball slides or rolls (neither: not known).
"""

impact = np.dtype(
    [
        ("shot", "i8"),
        ("ball", "i8"),
        ("rail", "i8"),
        ("time", "f8"),
        ("r", "f8", 2),
        ("v_n", "f8"),
        ("v_t", "f8"),
        ("w_n", "f8"),
        ("w_t", "f8"),
        ("u_n", "f8"),
        ("u_t", "f8"),
        ("delay", "f8"),
        ("v_error", "f8"),
        ("w_error", "f8"),
        ("u_error", "f8"),
        ("chi2", "f8"),
        ("rolling", "?"),
        ("first", "?"),
    ]
)
"""An impact on rail 0 (x = 0), 1 (x = W), 2 (y = 0) or 3 (y = L).

Along n, into the cushion, and t = (n_y, -n_x), m/s: velocity v before, w after, slip over the cloth
u after; errors of a component; chi^2 over its degrees of freedom; whether the ball rolled before,
and whether it is a ball that was not struck before its first cushion, which has hardly any side
spin.
"""

hit = np.dtype(
    [
        ("shot", "i8"),
        ("a", "i8"),
        ("b", "i8"),
        ("time", "f8"),
        ("n", "f8", 2),
        ("v_n", "f8"),
        ("v_t", "f8"),
        ("w_n", "f8"),
        ("w_t", "f8"),
        ("z_n", "f8"),
        ("z_t", "f8"),
        ("v_error", "f8"),
        ("w_error", "f8"),
        ("z_error", "f8"),
        ("chi2", "f8"),
    ]
)
"""A hit of ball a on ball b at rest.

Along n, from a to b, and t = (n_y, -n_x), m/s: velocity of a before (v) and after (w), and of b
after (z); errors of a component; chi^2 over its degrees of freedom.
"""


@dataclass(frozen=True, eq=False, repr=False)
class Events(Arrays):
    """The events of recorded tracks, and the friction of the cloth that they determine.

    `pieces`, `impacts` and `hits` are structured arrays of the dtypes of these names in
    `carom.tracks`.
    """

    pieces: Records  # (n,)
    impacts: Records  # (n,)
    hits: Records  # (n,)
    slide: tuple[float, float]  # Deceleration of sliding, m/s^2, and its error
    # a and its error (m/s^2), b and its error (1/m) of the deceleration of rolling, a + b v^2
    roll: tuple[tuple[float, float], tuple[float, float]]


# ---- Least squares


def least_squares(
    residuals: Callable[[Doubles], Doubles], start: Doubles, scale: Doubles, iterations: int = 40
) -> tuple[Doubles, float, Doubles]:
    """Levenberg and Marquardt's method: the parameters, the sum of squares, and the standard
    errors.

    `residuals` evaluates many sets of parameters at once, (k, p) to (k, m). Finite differences use
    a step of 1e-5 of the scale.
    """
    x: Doubles = start.copy()
    damping = 1e-3
    steps = np.vstack([np.zeros_like(scale), np.diag(1e-5 * scale)])
    values = residuals(x + steps)
    for _ in range(iterations):
        slopes = ((values[1:] - values[0]) / 1e-5).T
        square, gradient = slopes.T @ slopes, slopes.T @ values[0]
        cost = float(values[0] @ values[0])
        drop = 0.0
        # shorter and shorter steps until the cost falls
        for _ in range(8):
            damped = square + np.diag(damping * square.diagonal() + 1e-12 * (1.0 + square.trace()))
            tried: Doubles = x - scale * np.linalg.solve(damped, gradient)
            new = residuals(tried + steps)
            drop = 1.0 - float(new[0] @ new[0]) / max(cost, 1e-300)
            if drop > 0.0:
                x, values, damping = tried, new, max(0.2 * damping, 1e-9)
                break
            damping *= 6.0
        if drop < 1e-6:
            break
    slopes = ((values[1:] - values[0]) / 1e-5).T
    covariance: Doubles = np.linalg.pinv(slopes.T @ slopes)
    errors: Doubles = scale * np.sqrt(np.abs(np.diagonal(covariance)))
    return x, float(values[0] @ values[0]), errors


# ---- Pieces


def _sigma(speed: Doubles, noise: Doubles | float) -> Doubles:
    """Standard deviation of a coordinate of a ball at a speed, m."""
    return np.asarray(np.hypot(_NOISE * noise, _JITTER * np.minimum(speed, 8.0)))


def _cuts(track: Doubles, weight: Doubles) -> list[tuple[int, int]]:
    """First row and end of each piece of a track, (rows, 3), with weights 1/s^2."""
    n = len(track)
    best, back = np.empty(n + 1), np.zeros(n + 1, np.int32)
    lib.carom_python_cuts(
        pointer("double[]", np.ascontiguousarray(track)),
        pointer("double[]", np.ascontiguousarray(weight)),
        n,
        _LONGEST,
        _PENALTY,
        pointer("double[]", best),
        pointer("int32_t[]", back),
    )
    cuts: list[tuple[int, int]] = []
    j = n
    while j > 0:
        cuts.append((int(back[j]), j))
        j = int(back[j])
    return cuts[::-1]


def _free(track: Doubles, moves: float, low: float, high: Doubles) -> Doubles:
    """The rows of a track that determine the motion: from its start, without the last row and rows
    clamped to a cushion.
    """
    rows = track[track[:, 0] >= moves][:-1]
    clamped = (np.abs(rows[:, 1:] - low) < 1e-5) | (np.abs(rows[:, 1:] - high) < 1e-5)
    free_rows: Doubles = rows[~clamped.any(axis=1)]
    return free_rows


def _pieces(shot: int, ball: int, rows: Doubles, noises: Doubles) -> list[Any]:
    """The pieces of the rows of a track, whose noises are given."""
    if len(rows) < 8:
        return []
    time: Doubles = rows[:, 0]
    velocity = np.gradient(rows[:, 1], time), np.gradient(rows[:, 2], time)
    speed: Doubles = np.hypot(velocity[0], velocity[1])
    sigma = _sigma(speed, noises)
    found: list[Any] = []
    for begin, end in _cuts(rows, 1.0 / sigma**2):
        n = end - begin
        if n < 4:
            continue
        # the weighted quadratic about the middle, its errors, its misfit
        t = rows[begin:end, 0]
        middle = float(t.mean())
        u = t - middle
        A = np.stack([np.ones(n), u, u * u], axis=1)
        weighted = A / sigma[begin:end, None]
        covariance = np.linalg.pinv(weighted.T @ weighted)
        c = covariance @ weighted.T @ (rows[begin:end, 1:] / sigma[begin:end, None])
        misfit = A @ c - rows[begin:end, 1:]
        a, a_error = 2.0 * c[2], 2.0 * math.sqrt(covariance[2, 2])
        size = float(np.hypot(a[0], a[1]))
        sure = n >= 8 and a_error < 0.3
        found.append(
            (
                shot,
                ball,
                t[0],
                t[-1],
                n,
                middle,
                c[0],
                c[1],
                a,
                math.sqrt(covariance[1, 1]),
                a_error,
                math.sqrt(float((misfit**2).sum(axis=1).mean())),
                sure and size > _SLIDES,
                sure and size < _ROLLS,
            )
        )
    return found


def _state(record: Any, time: ArrayLike) -> tuple[Doubles, Doubles]:
    """Position and velocity of a piece at times, (..., 2) each."""
    u = (np.asarray(time, np.float64) - record["time"])[..., None]
    return record["r"] + u * (record["v"] + 0.5 * u * record["a"]), record["v"] + u * record["a"]


def _cloth(
    pieces: Records,
) -> tuple[tuple[float, float], tuple[tuple[float, float], tuple[float, float]]]:
    """Deceleration of sliding, and a, b of a + b v^2 of rolling, each with its error; NaN without
    suitable pieces.
    """
    slides = pieces[pieces["sliding"] & (pieces["a_error"] < 0.15)]
    size = np.hypot(*slides["a"].T)
    slide = median(size)
    # rolling: along the way, weighted, with far-off pieces counted less
    rolls = pieces[
        pieces["rolling"] & (pieces["a_error"] < 0.03) & (pieces["end"] - pieces["begin"] > 0.4)
    ]
    speed = np.hypot(*rolls["v"].T)
    nothing = (math.nan, math.nan)
    if len(rolls) < 8:
        return slide, (nothing, nothing)
    slowing = -(rolls["a"] * rolls["v"]).sum(axis=1) / speed
    A = np.stack([np.ones(len(rolls)), speed**2], axis=1)
    weight, law, covariance = 1.0 / np.maximum(rolls["a_error"], 0.005) ** 2, np.zeros(2), np.eye(2)
    robust, spread = np.ones(len(rolls)), 1.0
    for _ in range(20):
        covariance = np.linalg.inv(A.T @ (A * (weight * robust)[:, None]))
        law = covariance @ A.T @ (weight * robust * slowing)
        left = (slowing - A @ law) * np.sqrt(weight)
        spread = 1.4826 * float(np.median(np.abs(left)))
        robust = 1.0 / (1.0 + (left / (2.0 * max(spread, 1e-9))) ** 2)
    errors = np.sqrt(covariance.diagonal()) * max(spread, 1.0)
    return slide, ((float(law[0]), float(errors[0])), (float(law[1]), float(errors[1])))


def median(values: Doubles) -> tuple[float, float]:
    """The median, and its standard error by the scatter."""
    if len(values) < 3:
        return math.nan, math.nan
    middle = float(np.median(values))
    return middle, 1.2533 * 1.4826 * float(np.median(np.abs(values - middle))) / math.sqrt(
        len(values)
    )


def halves(
    n: int,
    splits: int,
    random: np.random.Generator,
    find: Callable[[NDArray[np.intp]], Doubles],
) -> Doubles:
    """The standard errors of the result of `find` for all n rows, from random halves.

    The difference of two halves is twice this error.
    """
    parts = [np.array_split(random.permutation(n), 2) for _ in range(splits)]
    apart = np.array([find(first) - find(second) for first, second in parts])
    return np.asarray(0.5 * np.sqrt((apart**2).mean(axis=0)))


# ---- Impacts and hits


def _unit(vectors: Doubles) -> tuple[Doubles, Doubles]:
    """Lengths, (..., 1), and directions, 0 for 0."""
    length = np.sqrt((vectors**2).sum(axis=-1, keepdims=True))
    return length, vectors / np.maximum(length, 1e-12)


class _Motion:
    """The local models of motion, vectorised over sets of parameters: (k, 2) vectors and (k, m)
    times return (k, m, 2) positions.
    """

    def __init__(self, slide: float, roll: tuple[float, float]) -> None:
        self.slide, self.roll = slide, roll

    def slowing(self, speed: Doubles) -> Doubles:
        """Deceleration of rolling, m/s^2."""
        return self.roll[0] + self.roll[1] * speed**2

    def place_after(self, t: Doubles, r: Doubles, w: Doubles, u: Doubles) -> Doubles:
        """The position of a ball that slides from velocity w with slip u, then rolls and stops."""
        size, way = _unit(u)
        lasts = 2.0 * size / (7.0 * self.slide)
        sliding = np.minimum(t, lasts)[..., None]
        rolling = w - (2.0 / 7.0) * u
        speed, along = _unit(rolling)
        slows = self.slowing(0.95 * speed)
        rolling_time = np.minimum(np.maximum(t - lasts, 0.0), speed / np.maximum(slows, 1e-6))[
            ..., None
        ]
        r, w, way, rolling = r[:, None], w[:, None], way[:, None], rolling[:, None]
        slid = r + w * sliding - 0.5 * self.slide * way * sliding**2
        return np.asarray(
            slid + rolling * rolling_time - 0.5 * (slows * along)[:, None] * rolling_time**2
        )


def _cushion(
    rows: Doubles,
    window: tuple[float, float, float],
    incoming: Any,
    outgoing: Any,
    n: Doubles,
    motion: _Motion,
    noise: float,
) -> Any:
    """The parameters of an impact on a cushion at about window[1], from the samples between
    window[0] and window[2]; None with too few samples.
    """
    begin, time, end = window
    first = (rows[:, 0] >= begin) & (rows[:, 0] < time - 0.004)
    second = (rows[:, 0] > time + 0.009) & (rows[:, 0] <= end)
    if first.sum() < 6 or second.sum() < 8:
        return None
    # in the frame of the cushion, along and into it, relative to the position of the cut
    frame = np.array([[n[1], -n[0]], n])
    place, v = _state(incoming, time)
    _, w = _state(outgoing, time)
    seen = (rows[:, 1:] - place) @ frame.T
    t_1, t_2 = rows[first, 0] - time, rows[second, 0] - time
    v, w = frame @ v, frame @ w
    sigma = _sigma(np.hypot(*v), noise)
    slides = bool(np.hypot(*incoming["a"]) > _ROLLS)

    def residuals(q: Doubles) -> Doubles:
        contact_time, r, v, a, w, u, delay = (
            q[:, :1],
            q[:, 1:3],
            q[:, 3:5],
            q[:, 5:7],
            q[:, 7:9],
            q[:, 9:11],
            q[:, 11:],
        )
        if not slides:
            speed, way = _unit(v)
            a = a - motion.slowing(speed) * way
        s = (t_1 - contact_time)[..., None]
        come = r[:, None] + v[:, None] * s + 0.5 * a[:, None] * s**2
        left = r.copy()
        left[:, 1:] -= w[:, 1:] * delay
        gone = motion.place_after(t_2 - contact_time, left, w, u)
        distances = np.concatenate([come - seen[first], gone - seen[second]], axis=1) / sigma
        prior = [(delay - _DELAY) / _DELAY_ERROR] + ([] if slides else [10.0 * q[:, 5:7]])
        return np.concatenate([distances.reshape(len(q), -1), *prior], axis=1)

    scale = np.array([0.005, 0.005, 0.005, 0.1, 0.1, 0.5, 0.5, 0.1, 0.1, 0.2, 0.2, 0.005])
    best: tuple[Doubles, float, Doubles] | None = None
    for slip in (-1.15, -0.4):
        start = np.array(
            [
                0.0,
                0.0,
                0.0,
                *v,
                *(incoming["a"] @ frame.T if slides else (0.0, 0.0)),
                *w,
                0.0,
                slip * v[1],
                _DELAY,
            ]
        )
        found = least_squares(residuals, start, scale)
        if best is None or found[1] < best[1]:
            best = found
    assert best is not None
    q, cost, error = best
    freedom = 2 * int(first.sum() + second.sum()) - 10
    return (
        time + q[0],
        place + q[1:3] @ frame,
        q[4],
        q[3],
        q[8],
        q[7],
        q[10],
        q[9],
        q[11],
        float(np.hypot(*error[3:5])),
        float(np.hypot(*error[7:9])),
        float(np.hypot(*error[9:11])),
        cost / freedom,
        not slides,
    )


def _hit(
    rows: Doubles,
    others: Doubles,
    rest: Doubles,
    window: tuple[float, float, float, float],
    radius: float,
    motion: _Motion,
    noise: float,
) -> Any:
    """The parameters of a hit on a ball at rest that is first seen to move at window[1].

    Uses the samples from window[0] to window[2] of the hitting ball, and to window[3] of the other;
    None with too few samples.
    """
    begin, time, end, other_end = window
    first = (rows[:, 0] >= begin) & (rows[:, 0] < time - 0.021)
    second = (rows[:, 0] > time + 0.003) & (rows[:, 0] < end)
    third = (others[:, 0] >= time) & (others[:, 0] < other_end)
    if first.sum() < 5 or second.sum() < 6 or third.sum() < 6:
        return None
    t_1, t_2, t_3 = rows[first, 0] - time, rows[second, 0] - time, others[third, 0] - time
    # where the approach, a quadratic, comes within two radii
    come = np.polyfit(t_1, rows[first, 1:], 2)
    times = np.linspace(-0.05, 0.02, 281)
    ways = come[0] * times[:, None] ** 2 + come[1] * times[:, None] + come[2]
    gaps = np.hypot(*(ways - rest).T)
    k = int(np.argmax(gaps < 2.0 * radius)) if (gaps < 2.0 * radius).any() else int(np.argmin(gaps))
    v = 2.0 * come[0] * times[k] + come[1]
    w, z = np.polyfit(t_2, rows[second, 1:], 1)[0], np.polyfit(t_3, others[third, 1:], 1)[0]
    sigma = float(_sigma(np.hypot(*v), noise))

    def residuals(q: Doubles) -> Doubles:
        time, r, v, a, w, u, z, slip, o = q[:, :1], *(q[:, k : k + 2] for k in range(1, 17, 2))
        s = (t_1 - time)[..., None]
        distances = [
            r[:, None] + v[:, None] * s + 0.5 * a[:, None] * s**2 - rows[first, 1:],
            motion.place_after(t_2 - time, r, w, u) - rows[second, 1:],
            motion.place_after(t_3 - time, o, z, slip) - others[third, 1:],
        ]
        # the balls touch; the other lay where it was seen
        touch = (np.hypot(*(o - r).T)[:, None] - 2.0 * radius) / 3e-4
        return np.concatenate(
            [
                np.concatenate(distances, axis=1).reshape(len(q), -1) / sigma,
                touch,
                (o - rest) / max(5e-4, noise),
                a / 1.5,
            ],
            axis=1,
        )

    start = np.concatenate([times[k : k + 1], ways[k], v, np.zeros(2), w, v - w, 1.1 * z, z, rest])
    scale = np.array(
        [0.003, 0.003, 0.003, 0.1, 0.1, 0.5, 0.5, *[0.1, 0.1, 0.2, 0.2] * 2, 0.001, 0.001]
    )
    q, cost, error = least_squares(residuals, start, scale, 60)
    n = _unit(q[15:17] - q[1:3])[1]
    t = np.array([n[1], -n[0]])
    freedom = 2 * int(first.sum() + second.sum() + third.sum()) - 14
    return (
        time + q[0],
        n,
        q[3:5] @ n,
        q[3:5] @ t,
        q[7:9] @ n,
        q[7:9] @ t,
        q[11:13] @ n,
        q[11:13] @ t,
        float(np.hypot(*error[3:5])),
        float(np.hypot(*error[7:9])),
        float(np.hypot(*error[11:13])),
        cost / freedom,
    )


_NORMALS = np.array([[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]])


@dataclass(frozen=True)
class _Cut:
    """A cut between two pieces: its time, its kind ("cushion", "ball", "other", "smooth"), the
    rail, and the pieces.
    """

    time: float
    kind: str
    rail: int
    incoming: Any
    outgoing: Any


def _cuts_of(
    shot: Recording, pieces: Records, ball: int, radius: float, table: tuple[float, float]
) -> list[_Cut]:
    """The cuts between a ball's pieces, classified."""
    found: list[_Cut] = []
    for preceding, following in zip(pieces[:-1], pieces[1:]):
        # where the two quadratics come closest
        times: Doubles = np.linspace(preceding["end"] - 0.02, following["begin"] + 0.02, 121)
        (r_0, v_0), (r_1, v_1) = _state(preceding, times), _state(following, times)
        k = int(np.argmin(np.hypot(*(r_0 - r_1).T)))
        r, turn = 0.5 * (r_0[k] + r_1[k]), float(np.hypot(*(v_1[k] - v_0[k])))
        walls = np.array(
            [r[0] - radius, table[0] - radius - r[0], r[1] - radius, table[1] - radius - r[1]]
        )
        rail = int(np.argmin(walls))
        n = _NORMALS[rail]
        gaps = [
            math.hypot(
                np.interp(times[k], track_of_ball[:, 0], track_of_ball[:, 1]) - r[0],
                np.interp(times[k], track_of_ball[:, 0], track_of_ball[:, 2]) - r[1],
            )
            for number, track_of_ball in enumerate(shot.tracks)
            if number != ball
        ]
        kind = "smooth"
        if walls[rail] < _TOUCH and v_0[k] @ n > 0.02 and v_1[k] @ n < 0.0:
            kind = "cushion"
        elif min(gaps, default=math.inf) < 2.0 * radius + _TOUCH and turn > _TURN:
            kind = "ball"
        elif turn > 0.12:
            kind = "other"
        found.append(_Cut(float(times[k]), kind, rail, preceding, following))
    return found


def events(recordings: Sequence[Recording], table: tuple[float, float], radius: float) -> Events:
    """Find the events of recorded tracks.

    `table` contains the extents of x and y, and `radius` is the radius of the balls, m.

    Returns
    -------
    Events
        The pieces of all tracks, and the impacts and hits with enough samples. Improbable events
        are included; select by chi2 and errors.
    """
    low, high = radius, np.array(table) - radius
    rows = [
        [_free(*pieces, low, high) for pieces in zip(shot.tracks, shot.moves.tolist())]
        for shot in recordings
    ]
    by_track = [
        [
            np.array(_pieces(s, b, track, recordings[s].noises(track[:, 1:])), piece)
            for b, track in enumerate(tracks)
        ]
        for s, tracks in enumerate(rows)
    ]
    pieces = (
        np.concatenate([pieces for tracks in by_track for pieces in tracks])
        if by_track
        else np.zeros(0, piece)
    )
    slide, roll = _cloth(pieces)
    # without evidence of the friction, impacts are fitted with an ordinary cloth's
    usual = (
        2.0 if math.isnan(slide[0]) else slide[0],
        (0.05, 0.01) if math.isnan(roll[0][0]) else (roll[0][0], roll[1][0]),
    )
    motion = _Motion(*usual)
    impacts: list[Any] = []
    hits: list[Any] = []
    for s, shot in enumerate(recordings):
        if not np.isfinite(shot.moves).any():
            continue
        cuts = [
            _cuts_of(shot, pieces, ball, radius, table) for ball, pieces in enumerate(by_track[s])
        ]
        hard = [np.array([cut.time for cut in pieces if cut.kind != "smooth"]) for pieces in cuts]
        for ball, ball_cuts in enumerate(cuts):
            track = rows[s][ball]
            for number, cut in enumerate(ball_cuts):
                if cut.kind != "cushion":
                    continue
                # samples up to the neighbouring events, and before the impact of a single phase
                smooth = [
                    c.time for c in ball_cuts if c.kind == "smooth" and c.time < cut.time - 0.02
                ]
                past, next_ones = (
                    hard[ball][hard[ball] < cut.time - 1e-9],
                    hard[ball][hard[ball] > cut.time + 1e-9],
                )
                begin = max(cut.time - _BEFORE, *(past + 0.015), *smooth[-1:], track[0, 0] - 1e-9)
                end = min(cut.time + _AFTER, *(next_ones - 0.015), track[-1, 0] + 1e-9)
                numbers = _cushion(
                    track,
                    (begin, cut.time, end),
                    cut.incoming,
                    cut.outgoing,
                    _NORMALS[cut.rail],
                    motion,
                    float(shot.noises(_state(cut.incoming, cut.time)[0])),
                )
                if numbers is not None:
                    first = ball != shot.cue and not any(
                        c.kind == "cushion" for c in ball_cuts[:number]
                    )
                    impacts.append((s, ball, cut.rail, *numbers, first))
        # the struck ball's hits on balls that lie still
        cue, rest, moves = shot.cue, shot.rest, shot.moves
        for ball in range(len(shot.tracks)):
            if ball == cue or not math.isfinite(moves[ball]) or len(rows[s][ball]) < 8:
                continue
            time, track = float(moves[ball]), rows[s][cue]
            later = [hard[k][hard[k] > time + 0.03] for k in (cue, ball)]
            past = hard[cue][hard[cue] < time - 0.05]
            smooth = [c.time for c in cuts[cue] if c.kind == "smooth" and c.time < time - 0.06]
            begin = max([time - 0.35, *(past + 0.015), *smooth[-1:]])
            ends = [min([time + 0.6, *(pieces - 0.012)]) for pieces in later]
            numbers = _hit(
                track,
                rows[s][ball],
                rest[ball],
                (begin, time, ends[0], ends[1]),
                radius,
                motion,
                float(shot.noises(rest[ball])),
            )
            if numbers is not None:
                hits.append((s, cue, ball, *numbers))
    return Events(pieces, np.array(impacts, impact), np.array(hits, hit), slide, roll)
