"""Examines recorded shots before a fit: their clock, their noise, and their alignment with the
table.

Errors are corrected if the rows determine the correction, and always reported.

Clock. A film of r frames per second in a file with a higher rate repeats frames, or rounds their
times up to the file's. The positions of a moving ball then do not match the times. With the phase p
of a shot, frame k = floor(t r - p) was taken at k/r; p is in the widest gap of the fractions of t
r. The rate is the common one that makes the paths of moving balls smoothest.

If t counts frames, sliding determines the rate: a ball that was just hit slides, and its
deceleration mu_slide g, about 1.95 m/s^2, varies little between cloths.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.dtypes import Doubles
from carom.tracks import _constants
from carom.tracks._recordings import (
    Noise,
    Recording,
    TrackError,
    beyond_rails,
    exchanged,
    is_inside,
    lie_of,
    moving_scatter,
    noise_of,
    sound,
    until_pocketed,
)

_RATES = (25.0, 30.0, 24.0, 50.0, 60.0, 100.0, 120.0, 240.0, 23.976, 29.97, 48.0, 59.94)  # 1/s
_SLIDING = 1.95  # m/s^2: mu_slide g of most cloths, 0.17 to 0.22 times g
_ROWS = (7, 14, 28, 56)  # rows that show sliding, at 25 to 240 frames per second
_SLIDES = (0.18, 0.6)  # s: duration of sliding
_CLOCK = 1.18  # a clock that is wrong by less is no other than a cloth that is unlike most
_HELD = 0.03  # fraction of repeated frames of moving balls, above chance
_SMOOTHER = 0.6  # of the scatter that a right clock leaves, at most
_MOVES, _FAST = 2e-3, 20e-3  # m: least steps of balls that move, for their clock, and move fast
_CROOKED = 8e-3  # m: deviation above which a misaligned track is reported
_BEYOND = 15e-3  # m: a turn farther from a cushion means another table
_GAP, _GAP_WAY = (
    2.5,
    0.04,
)  # frames, and m that a ball moves meanwhile, above which a gap is reported
_DRIFT, _BEFORE = 2e-3, 0.05  # m and s: of a ball at rest, so long before the strike
_UNLIKE = 1.6  # ratio of the noise of two coordinates above which it is reported


_CAUSES = ("clock", "table", "radius", "rest")
_KINDS = (*_CAUSES, "file", "gap", "noise")  # in the order of the report


@dataclass(frozen=True)
class Finding:
    """A finding of an examination: what, where, and its correction."""

    kind: str  # "clock", "table", "radius", "rest", "gap", "file" or "noise"
    text: str  # a sentence
    shots: tuple[int | str, ...] = ()  # which shots have it; of none it holds for all
    rows: int = 0  # how many rows it concerns
    is_mended: bool = False  # whether the recordings are put right


class _Findings(list[Finding]):
    def say(
        self,
        kind: str,
        text: str,
        shots: Sequence[int | str] = (),
        rows: int = 0,
        is_mended: bool = False,
    ) -> None:
        self.append(Finding(kind, text, tuple(shots), rows, is_mended))


@dataclass(frozen=True, eq=False)
class Examination:
    """Corrected recordings, and the findings."""

    recordings: list[Recording]
    findings: list[Finding]
    mended: list[list[str]]  # of each shot: swapped names, false detections
    indices: list[int]  # of the shots among those that were given
    noise: Noise

    @property
    def causes(self) -> list[str]:
        """The kinds of uncorrected findings, which make fits worse."""
        open_ones = {finding.kind for finding in self.findings if not finding.is_mended}
        return [kind for kind in _CAUSES if kind in open_ones]

    @property
    def sentences(self) -> list[str]:
        """Sentences on the findings that concern all shots."""
        return [finding.text for finding in self.findings]


def _names(shots: Sequence[int | str]) -> str:
    """The shots, as a phrase."""
    some = ", ".join(map(str, shots[:4])) + (" and others" if len(shots) > 4 else "")
    return f"{'shot' if len(shots) == 1 else 'shots'} {some}"


# ---- The unit of time


def _slowing(recordings: Sequence[Recording], rows: int, with_struck: bool) -> Doubles:
    """The decelerations of balls in their first rows of motion, in which balls slide that were hit,
    and usually the struck ball.
    """
    found = []
    for shot in recordings:
        for ball, (track, still) in enumerate(zip(shot.tracks, shot.still)):
            first = track[still : still + rows]
            if len(first) < rows or (ball == shot.cue and not with_struck):
                continue
            t = first[:, 0] - first[0, 0]
            picture = float(np.diff(t).min())
            if t[-1] > 1.3 * rows * picture or first[0, 0] - track[0, 0] < 1.5 * picture:
                continue
            coefficients = np.polyfit(t, first[:, 1:], 2)
            a, v = coefficients[:2]
            left = np.vander(t, 3) @ coefficients - first[:, 1:]
            speed = float(np.hypot(*v))
            end = float(np.hypot(*(v + 2.0 * a * t[-1])))
            slowing = -2.0 * float(a @ v) / speed
            error = math.sqrt(720.0 / rows * float((left**2).mean())) / float(t[-1]) ** 2
            # a ball that rolls has lost two sevenths of its speed
            if 0.02 * speed < speed - end < 0.29 * speed and error < 0.1 * slowing:
                found.append(slowing)
    return np.array(found)


def _time_scale(recordings: Sequence[Recording], least: int, with_struck: bool = False) -> float:
    """The number of units of t per second, from sliding; NaN with fewer than `least` balls."""
    steps = [np.diff(track[:, 0]) for shot in recordings for track in shot.tracks]
    picture = float(np.median(np.concatenate(steps)))
    for rows in _ROWS:
        slowing = np.sort(_slowing(recordings, rows, with_struck))
        half = len(slowing) // 2 + 1
        if len(slowing) < least:
            continue
        # the closest half only slides; some of the others hit or roll meanwhile
        widths = slowing[half - 1 :] - slowing[: len(slowing) - half + 1]
        first = int(np.argmin(widths))
        middle = float(slowing[first : first + half].mean())
        scale = math.sqrt(_SLIDING / middle)
        lasts = rows * picture / scale
        if widths[first] < 0.4 * middle and _SLIDES[0] < lasts < _SLIDES[1]:
            return scale
    return math.nan


def _in_seconds(recordings: list[Recording], findings: _Findings) -> list[Recording]:
    """Recordings with t converted from frames or milliseconds to seconds."""
    t = np.concatenate([track[:, 0] for shot in recordings for track in shot.tracks])
    if len(t) < 40 or np.abs(t - np.round(t)).max() > 1e-6 or np.ptp(t) < 20.0:
        return recordings
    scale = _time_scale(recordings, 4)
    if math.isnan(scale):
        scale = _time_scale(recordings, 4, with_struck=True)
    units = np.array([*_RATES[:8], 1000.0])
    unit = float(units[np.argmin(np.abs(np.log(units / scale)))])
    if not abs(math.log(unit / scale)) < math.log(_CLOCK):
        raise TrackError(
            "recordings: t has whole numbers alone, which count pictures, and sliding balls do not "
            "tell how many there are in a second: rate is needed"
        )
    what = "milliseconds" if unit == 1000.0 else "pictures"
    findings.say(
        "clock",
        f"t counts {what}, as it has whole numbers alone: taken as {unit:g} a second, the usual "
        f"rate nearest to the {scale:.3g} that sliding balls tell; rate says otherwise",
        rows=len(t),
        is_mended=True,
    )
    return [
        replace(shot, tracks=tuple(track / (unit, 1.0, 1.0) for track in shot.tracks))
        for shot in recordings
    ]


# ---- Frames


@dataclass(frozen=True)
class _Pictures:
    """The times of a shot's frames, and which of them show a moving ball at a new or a repeated
    position.
    """

    times: Doubles
    is_new: NDArray[np.bool_]
    is_held: NDArray[np.bool_]


def _pictures(shot: Recording, least: float = _MOVES) -> _Pictures:
    """The frames of a shot; a ball that moved by more than `least`, m, is new."""
    times = np.unique(np.concatenate([track[:, 0] for track in shot.tracks]))
    is_new, is_repeated = np.zeros(len(times), np.bool_), np.zeros(len(times), np.bool_)
    for track in shot.tracks:
        if len(track) < 8:
            continue
        steps = np.hypot(*np.diff(track[:, 1:], axis=0).T)
        # a ball is under way that moves within three rows before and after
        padded = np.pad(steps, 3)
        windows = np.lib.stride_tricks.sliding_window_view(padded, 3)
        way = np.minimum(windows[: len(steps)].max(axis=1), windows[4:].max(axis=1))
        rows = np.searchsorted(times, track[1:, 0])
        is_new[rows[steps > np.maximum(0.05 * way, least)]] = True
        is_repeated[rows[(way > _FAST) & (steps <= 0.05 * way)]] = True
    return _Pictures(times, is_new, is_repeated & ~is_new)


def _numbered(pictures: _Pictures, rate: float) -> tuple[NDArray[np.int64], float]:
    """The numbers of a shot's frames in a film of this rate, and the time of number 0."""
    seen = pictures.times[pictures.is_new] if pictures.is_new.any() else pictures.times
    fractions = np.sort(seen * rate % 1.0)
    gaps = np.diff(fractions, append=fractions[0] + 1.0)
    k = int(np.argmax(gaps))
    numbers = np.floor(pictures.times * rate - fractions[k] - 0.5 * gaps[k]).astype(np.int64)
    return numbers, float(np.median(pictures.times - numbers / rate))


def _retimed(shot: Recording, pictures: _Pictures, rate: float) -> tuple[Recording, int, int]:
    """A shot on the clock of a film of this rate, without repeated frames.

    Also returns the number of repeated frames, and of frames of moving balls that coincided.
    """
    numbers, begin = _numbered(pictures, rate)
    # of the times with the same number, prefer a new position, then the first
    order = np.lexsort((np.arange(len(numbers)), ~pictures.is_new, numbers))
    chosen = np.zeros(len(numbers), np.bool_)
    chosen[order[np.diff(numbers[order], prepend=numbers.min() - 1) > 0]] = True
    chosen &= ~pictures.is_held
    tracks = []
    for track in shot.tracks:
        rows = np.searchsorted(pictures.times, track[:, 0])
        kept = np.column_stack([begin + numbers[rows] / rate, track[:, 1:]])[chosen[rows]]
        tracks.append(kept if len(kept) else track[:1])
    lost = int((pictures.is_new & ~chosen).sum())
    return replace(shot, tracks=tuple(tracks)), int((~chosen).sum()), lost


def _by_film(recordings: list[Recording], findings: _Findings) -> list[Recording]:
    """Recordings on the clock of their film, if the file's differs."""
    pictures = [_pictures(shot) for shot in recordings]
    new, held = (
        sum(int(getattr(p, name).sum()) for p in pictures) for name in ("is_new", "is_held")
    )
    steps = np.concatenate([np.diff(p.times)[p.is_new[1:] & p.is_new[:-1]] for p in pictures])
    if new < 40:
        return recordings
    repeats = held > max(_HELD * new, 8)
    uneven = len(steps) > 0 and np.mean(np.abs(steps / np.median(steps) - 1.0) > 0.15) > 0.08
    if not repeats and not uneven:
        return recordings
    # exact repetition also identifies repeated frames of slow balls
    exact = [_pictures(shot, 1e-9) for shot in recordings]
    if repeats and sum(int(p.is_held.sum()) for p in exact) > 0.9 * held:
        pictures = exact
    # the rate of the file, and below it that whose ways are the smoothest
    fastest = 1.0 / float(np.quantile(np.concatenate([np.diff(p.times) for p in pictures]), 0.02))
    before, best = moving_scatter(recordings), None
    for rate in [rate for rate in _RATES if rate < 1.02 * fastest]:
        tried = [_retimed(shot, p, rate) for shot, p in zip(recordings, pictures)]
        lost = sum(item[2] for item in tried)
        scatter = moving_scatter([item[0] for item in tried])
        if lost < 0.02 * new and (best is None or scatter < 0.97 * best[0]):
            best = scatter, rate, tried
    if best is None or not best[0] < _SMOOTHER * before:
        if repeats:
            findings.say(
                "clock",
                f"{held} pictures of moving balls repeat the one before, which no usual rate of "
                f"a film explains: leave them out, and give the times of the others",
                rows=held,
            )
        return recordings
    _, rate, tried = best
    shots = tuple(shot.id for shot, (_, repeated, _) in zip(recordings, tried) if repeated)
    rows = sum(repeated for _, repeated, _ in tried)
    dropped = f"{rows} repeated pictures are left out of {_names(shots)}, and " if rows else ""
    findings.say(
        "clock",
        f"the film has {rate:g} pictures a second and the file another clock: {dropped}"
        f"all times are set by the film's, which makes the ways of balls "
        f"{before / best[0]:.2g} times as smooth",
        shots,
        rows,
        is_mended=True,
    )
    return [shot for shot, _, _ in tried]


# ---- Rows


def _on_table(
    recordings: list[Recording], ground: _constants.Ground, findings: _Findings
) -> tuple[list[Recording], list[int]]:
    """Recordings without rows of balls that have fallen and rows off the table, and their indices."""
    table, radius, pockets = ground.size, ground.radius, ground.table.pockets["centre"]
    places = np.concatenate([track[:, 1:] for shot in recordings for track in shot.tracks])
    low, high = radius, np.array(table) - radius
    extents = (
        f"centres of balls of radius {radius:g} m on a table of {table[0]:g} x {table[1]:g} m must "
        f"be {low:g} to {high[0]:g} and {high[1]:g} m"
    )
    is_exchanged = exchanged(places, table, radius, pockets)
    if is_exchanged or is_inside(places, table, radius, pockets).mean() < 0.5:
        raise TrackError(
            f"table: {extents}, and most are not: "
            + (
                f"they fit {table[1]:g} x {table[0]:g} m"
                if is_exchanged
                else "are all lengths in metres, from the corner of the noses?"
            )
        )
    found, indices = [], []
    for index, shot in enumerate(recordings):
        shot = until_pocketed(shot, ground.table)
        inside = [is_inside(track[:, 1:], table, radius, pockets) for track in shot.tracks]
        for ball, track, rows in zip(shot.balls, shot.tracks, inside):
            if not rows.all():
                t, x, y = track[np.argmin(rows)]
                findings.say(
                    "table",
                    f"shot {shot.id}, ball {ball}: {(~rows).sum()} rows are left out, the first "
                    f"at t = {t:g} s in {x:g}, {y:g} m: {extents}",
                    (shot.id,),
                    int((~rows).sum()),
                    is_mended=True,
                )
        kept = [(ball, track[rows]) for ball, track, rows in zip(shot.balls, shot.tracks, inside)]
        balls = [(ball, track) for ball, track in kept if len(track)]
        if balls:
            indices.append(index)
            found.append(
                replace(shot, balls=tuple(b for b, _ in balls), tracks=tuple(t for _, t in balls))
            )
    return found, indices


def _thawed(track: Doubles, noise: float) -> Doubles:
    """A track with only the first and the last row of each run without any motion.

    Compressed films freeze balls; such a run is a single measurement.
    """
    near = np.hypot(*np.diff(track[:, 1:], axis=0).T) < 0.1 * noise
    inner = np.zeros(len(track), np.bool_)
    inner[1:-1] = near[:-1] & near[1:]
    return track[~inner]


def _noise(
    recordings: list[Recording], train: Sequence[int] | None, findings: _Findings
) -> tuple[list[Recording], Noise]:
    """Recordings with their noise, and without the repeated rows of balls at rest."""
    noise = noise_of(recordings if train is None else [recordings[k] for k in train])
    if noise.is_frozen:
        findings.say(
            "noise",
            f"the film freezes balls at rest, which scatter by {1e3 * noise.rest:.2f} mm, those "
            f"that move by {1e3 * noise.value:.2f} mm: the latter counts, and of rows that "
            f"repeat a place the first and the last",
        )
        recordings = [
            replace(shot, tracks=tuple(_thawed(track, noise.value) for track in shot.tracks))
            for shot in recordings
        ]
    low, high = sorted(noise.axes)
    viewed = [replace(shot, noise=noise.value) for shot in recordings if shot.view]
    if viewed and viewed[0].view:
        noises = [shot.noises(track[:, 1:]) for shot in viewed for track in shot.tracks]
        findings.say(
            "noise",
            f"the noise is {1e3 * min(map(min, noises)):.2f} to {1e3 * max(map(max, noises)):.2f} "
            f"mm, as of {noise.value / viewed[0].view.scale:.2g} pixels by the corners: each row "
            f"counts by its own",
        )
    elif high > _UNLIKE * low and high > 3e-4:
        findings.say(
            "noise",
            f"the noise is {1e3 * noise.axes[0]:.2f} mm along x and {1e3 * noise.axes[1]:.2f} mm "
            f"along y, as of a camera that looks along the table: both count as "
            f"{1e3 * noise.value:.2f} mm",
        )
    return recordings, noise


# ---- Findings in a shot


def _gaps(shot: Recording) -> list[tuple[float, float, float]]:
    """The gaps in which no ball was seen although one moved: beginning, end, and the distance, m."""
    times = np.unique(np.concatenate([track[:, 0] for track in shot.tracks]))
    if len(times) < 8:
        return []
    picture, found = float(np.median(np.diff(times))), []
    # rows that are thinned by displacement are so far apart
    displacements = [np.hypot(*np.diff(track[:, 1:], axis=0).T) for track in shot.tracks]
    thin = float(np.quantile(np.concatenate(displacements), 0.05))
    for k in np.flatnonzero(np.diff(times) > _GAP * picture).tolist():
        begin, end = float(times[k]), float(times[k + 1])
        ways, steps = [0.0], [0.0]
        for track in shot.tracks:
            row = int(np.searchsorted(track[:, 0], end))
            if 2 <= row < len(track) and track[row - 1, 0] >= begin - picture:
                ways.append(float(np.hypot(*(track[row, 1:] - track[row - 1, 1:]))))
                steps.append(float(np.hypot(*(track[row - 1, 1:] - track[row - 2, 1:]))))
        if max(ways) > max(_GAP_WAY, 1.5 * max(steps), 4.0 * thin):
            found.append((begin, end, max(ways)))
    return found


def _drifts(shot: Recording) -> list[tuple[int | str, float, int]]:
    """The balls that move before the strike: by what distance, m, and in how many rows."""
    found = []
    for ball, track, still in zip(shot.balls, shot.tracks, shot.still):
        rows = track[: max(still - 3, 0)]
        rows = rows[rows[:, 0] < shot.moves.min() - _BEFORE]
        if len(rows) < 8:
            continue
        t = rows[:, 0] - rows[:, 0].mean()
        drift = float(np.hypot(*(t @ rows[:, 1:] / (t @ t)))) * float(np.ptp(t))
        if drift > max(_DRIFT, 6.0 * shot.noise * math.sqrt(12.0 / len(rows))):
            found.append((ball, drift, len(rows)))
    return found


def _begins_late(shot: Recording) -> bool:
    """Whether the struck ball already moves between its first two rows."""
    if not np.isfinite(shot.moves).any() or len(shot.tracks[shot.cue]) < 4:
        return False
    first = shot.tracks[shot.cue][:4]
    times, steps = np.diff(first[:, 0]), np.hypot(*np.diff(first[:, 1:], axis=0).T)
    is_regular = np.ptp(times) < 0.1 * times.min()
    has_moved = shot.moved(first[1:, 1:], np.diff(first[:, 1:], axis=0)).all()
    return bool(is_regular and has_moved and 0.97 < steps[0] / steps[1] < 1.3)


def _diameters(shot: Recording) -> list[float]:
    """The diameter, m, from each hit of the struck ball on a ball at rest.

    It is the distance of its path from the other's centre, divided by the sine of the angle at
    which the other leaves. Throw makes it some per cent too large.
    """
    found: list[float] = []
    if not np.isfinite(shot.moves).any():
        return found
    track = shot.tracks[shot.cue]
    for ball, time in enumerate(shot.moves.tolist()):
        if ball == shot.cue or not math.isfinite(time):
            continue
        rows = (track[:, 0] < time) & (track[:, 0] > time - 0.3)
        rows &= track[:, 0] >= shot.moves[shot.cue]
        coming = track[rows][:-1][-6:, 1:]
        still = shot.still[ball]
        leaving = shot.tracks[ball][still : still + 5, 1:] - shot.rest[ball]
        if len(coming) < 3 or len(leaving) < 3:
            continue
        ways = np.array([coming[-1] - coming[0], leaving[-1]])
        lengths = np.hypot(*ways.T)
        if lengths.min() < 0.03:
            continue
        # both ways are straight, and the angle is neither small nor near 90 degrees
        ways /= lengths[:, None]
        across = np.column_stack([-ways[:, 1], ways[:, 0]])
        bends = (coming - coming.mean(axis=0)) @ across[0], leaving @ across[1]
        sine, cosine = abs(float(across[0] @ ways[1])), float(ways[0] @ ways[1])
        gap = shot.rest[ball] - coming[-1]
        is_straight = max(float(np.abs(bend).max()) for bend in bends) < 3e-3
        if is_straight and 0.35 < sine < 0.93 and cosine > 0.0 and gap @ ways[0] > 0.0:
            found.append(abs(float(gap @ across[0])) / sine)
    return found


def _say_shots(recordings: list[Recording], radius: float, findings: _Findings) -> None:
    """Report findings in single shots: gaps, drifts, strikes that were not recorded, another
    radius.
    """
    gaps = {shot.id: found for shot in recordings if (found := _gaps(shot))}
    if gaps:
        first, (begin, end, way) = next((shot, found[0]) for shot, found in gaps.items())
        count = sum(map(len, gaps.values()))
        findings.say(
            "gap",
            f"pictures are missing {count} times in {_names(list(gaps))}, first in shot {first} "
            f"from {begin:.2f} to {end:.2f} s, while a ball went {100.0 * way:.0f} cm: what "
            f"happens meanwhile is not fitted",
            tuple(gaps),
            count,
        )
    for shot in recordings:
        drifts = _drifts(shot)
        if drifts:
            ball, drift, rows = max(drifts, key=lambda found: found[1])
            all_alike = len(drifts) == len(shot.tracks) > 1
            findings.say(
                "rest",
                f"shot {shot.id}, ball {ball}: it moves by {1e3 * drift:.1f} mm in the {rows} "
                f"rows before the strike; "
                + (
                    "so do all balls: the camera moves"
                    if all_alike
                    else "a shot begins with all balls at rest"
                ),
                (shot.id,),
                rows,
            )
    late = [shot.id for shot in recordings if _begins_late(shot)]
    if len(late) >= max(3, 0.4 * len(recordings)):
        findings.say(
            "rest",
            f"the struck ball moves from its first row on in {len(late)} of {len(recordings)} "
            f"shots ({_names(late)}): the strike is not in the recording, which must begin "
            f"with the balls at rest",
            tuple(late),
        )
    diameters = np.array([size for shot in recordings for size in _diameters(shot)])
    if len(diameters) >= 6:
        ratio = float(np.median(diameters)) / (2.0 * radius)
        low, high = np.quantile(diameters, (0.25, 0.75)) / (2.0 * radius)
        error = 1.9 * float(high - low) / math.sqrt(len(diameters))
        if not 0.94 - error < ratio < 1.12 + error:
            findings.say(
                "radius",
                f"{len(diameters)} hits say that centres of balls that touch are about "
                f"{2e3 * radius * ratio:.0f} mm apart, while the radius is {radius:g} m: is it "
                f"right, and the scale of the places?",
                rows=len(diameters),
            )


def _say_rails(
    recordings: list[Recording],
    table: tuple[float, float],
    radius: float,
    findings: _Findings,
) -> None:
    """Report turns of balls away from the cushions, for few impacts."""
    found = beyond_rails(recordings, table, radius)
    if not found or max(abs(off) for off, _ in found.values()) < _BEYOND:
        return
    names = ("x = 0", f"x = {table[0]:g}", "y = 0", f"y = {table[1]:g}")
    rails = "; ".join(
        f"{1e3 * abs(off):.0f} mm {'beyond' if off > 0.0 else 'before'} the cushion {names[rail]} "
        f"m ({count} times)"
        for rail, (off, count) in found.items()
    )
    sizes = [off / (table[rail // 2] - radius) for rail, (off, _) in found.items() if rail % 2]
    scale = f", about {1.0 + np.median(sizes):.3f} times too large," if sizes else ""
    findings.say(
        "table",
        f"balls turn {rails}: the places{scale} do not fit the table's extents, its origin or "
        f"the radius",
        rows=sum(count for _, count in found.values()),
    )


def examine(
    recordings: Sequence[Recording],
    table: str | tuple[float, float],
    radius: float | None = None,
    *,
    train: Sequence[int] | None = None,
    calibrate: bool = False,
) -> Examination:
    """Examine recorded shots and correct them where possible, as `carom.fit.fit` does first.

    Repeated frames are removed, and times are set by the film's clock. A t that counts frames is
    converted to seconds. Positions off the table, false detections and frozen rows are removed, and
    swapped names are corrected. Missing frames, balls that move before the strike, strikes that
    were not recorded, a rotated table or one of another size, and balls that come too close are
    reported. A mirrored table cannot be detected, because a mirrored shot is a shot with opposite
    english.

    Parameters
    ----------
    recordings : sequence of Recording
        From `carom.tracks.read`; its notes are the first findings.
    table, radius
        As for `carom.fit.fit`.
    train : sequence of int, optional
        The shots that determine the noise. Default: all.
    calibrate : bool
        Whether to correct positions if the table is rotated in the tracks.

    Returns
    -------
    Examination

    Raises
    ------
    ValueError
        The table's extents or the radius are invalid, or the rows do not determine the unit of
        time.
    """
    ground = _constants.ground(table, radius)
    size, radius = ground.size, ground.radius
    findings = _Findings(Finding("file", note) for note in getattr(recordings, "notes", ()))
    shots, indices = _on_table(list(recordings), ground, findings)
    told_by = None if train is None else [k for k, index in enumerate(indices) if index in {*train}]
    shots = _by_film(_in_seconds(shots, findings), findings)
    scale = _time_scale(shots, 6)
    if not any(finding.kind == "clock" for finding in findings) and (
        abs(math.log(scale)) > math.log(_CLOCK)
    ):
        findings.say(
            "clock",
            f"sliding balls slow down as if a second had {scale:.2g} units of t: is the rate of "
            f"the pictures right?",
        )
    shots, noise = _noise(shots, told_by, findings)
    shots, mended = sound(shots, noise.value)
    lie = lie_of(shots, size, radius)
    if lie.far > max(_CROOKED, 4.0 * lie.error):
        findings.say(
            "table",
            f"the tracks lie {lie}: {'put right' if calibrate else '--calibrate puts them right'}",
            is_mended=calibrate,
        )
    elif not lie.impacts:
        _say_rails(shots, size, radius, findings)
    for _ in range(2 if calibrate else 0):
        # the second time finds impacts that were too far from their cushions
        shots = [
            replace(
                shot,
                tracks=tuple(
                    np.column_stack([track[:, 0], lie.places(track[:, 1:])])
                    for track in shot.tracks
                ),
            )
            for shot in shots
        ]
        lie = lie_of(shots, size, radius)
    _say_shots(shots, radius, findings)
    findings.sort(key=lambda finding: _KINDS.index(finding.kind))
    return Examination(shots, findings, mended, indices, noise)
