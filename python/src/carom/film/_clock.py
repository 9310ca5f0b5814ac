"""The frames of a film, and their times.

A file with 30 frames per second may contain only 25 new ones; the others repeat the frame before.
While balls move, a repeated frame differs from the one before only by compression. If the repeats
match a common rate, the time of frame number n is n divided by this rate; otherwise the file's
times are used, without the repeats.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from carom.dtypes import Doubles
from carom.film._cloth import FilmError, Picture

_RATES = np.array([12.0, 12.5, 15.0, 24.0, 25.0, 30.0, 48.0, 50.0, 60.0])
_SLOWER = 1.001  # by which 30 frames per second of television are slower
_NEAR = 5  # frames to each side among which the largest change is sought
_SAME, _NEW = (
    0.3,
    0.5,
)  # fractions of that change: a frame below repeats the one before, one above is new
_PHASES = 60
_TIES = 4.0  # frames, as at the ends of a motion
_AGREE = 0.93  # smallest fraction of the clear frames that a rate must explain
_CHANGED = 400  # pixels: about as many as a moving ball changes


def pictures(path: Path, start: float, end: float) -> Iterator[tuple[float, float, Picture]]:
    """Yield time (s), fraction of the file, and image of the frames from start to end, s."""
    path.open("rb").close()  # open() raises the error with its reason
    film = cv2.VideoCapture(str(path))
    rate, count = film.get(cv2.CAP_PROP_FPS), film.get(cv2.CAP_PROP_FRAME_COUNT)
    number, last = 0, -1.0
    while True:
        done, picture = film.read()
        if not done:
            break
        t = film.get(cv2.CAP_PROP_POS_MSEC) / 1e3
        # files without times have a rate
        if t <= last:
            t = last + 1.0 / rate if rate > 0.0 else last + 0.04
        last, number = t, number + 1
        if t > end:
            break
        if t >= start:
            yield t, min(number / max(count, 1.0), 1.0), np.asarray(picture, np.uint8)
    film.release()
    if not number:
        raise FilmError(f"{path}: no frame can be read; use a film, such as an .mp4 or .avi file")


def change(before: Picture, after: Picture) -> float:
    """The difference of two frames of a table, levels: the mean over the pixels that differ most."""
    away = cv2.absdiff(before[::2, ::2, 1], after[::2, ::2, 1]).ravel()
    most = min(_CHANGED // 4, len(away))
    return float(np.partition(away, -most)[-most:].mean())


@dataclass(frozen=True)
class Clock:
    """The new frames of a film, and their times."""

    new: NDArray[np.bool_]  # (pictures,)
    times: Doubles  # s, of the new ones
    notes: list[str]


def clock_of(times: Doubles, changes: Doubles) -> Clock:
    """The clock of frames with given times in the file, s, and differences from the frame before."""
    n, steps = len(times), np.diff(times)
    usual = float(np.median(steps)) if n > 1 else 0.04
    file_rate = (n - 1) / max(times[-1] - times[0], 1e-9)
    notes = []
    gaps = steps[steps > 1.6 * usual]
    if len(gaps):
        lost = round(float((gaps / usual - 1.0).sum()))
        notes.append(
            f"the file left out {lost} pictures, at {len(gaps)} places: its own times stand"
        )
    wide = np.pad(changes, _NEAR, mode="edge")
    largest = np.lib.stride_tricks.sliding_window_view(wide, 2 * _NEAR + 1).max(axis=1)
    still = float(np.quantile(changes, 0.05)) if n else 0.0
    moving = (largest > 3.0 * still + 6.0) & (np.arange(n) > 0)
    same, new = moving & (changes < _SAME * largest), moving & (changes > _NEW * largest)
    clear = same | new
    if same.sum() < 3 or same.sum() < 0.02 * clear.sum():
        return Clock(np.ones(n, bool), times, notes)

    # all common rates below the file's, at all phases; of rates that explain about as many frames,
    # the first, which is slower if the file's is
    rates = [*_RATES, *_RATES / _SLOWER]
    if abs(file_rate * _SLOWER - round(file_rate * _SLOWER)) < abs(file_rate - round(file_rate)):
        rates = [*_RATES / _SLOWER, *_RATES]
    tries = []
    for rate in (rate for rate in rates if rate < 0.99 * file_rate):
        # the pattern changes at these phases; of rates with no common period there are too many
        phases = np.unique(np.round(-(times - times[0]) * rate % 1.0, 4))
        if len(phases) > _PHASES:
            phases = np.arange(_PHASES) / _PHASES
        best = 0.0, rate, new
        for phase in phases + 0.5 * np.diff(phases, append=phases[0] + 1.0):
            count = np.floor((times - times[0]) * rate + phase + 1e-9)
            expected = np.diff(count, prepend=count[0] - 1.0) > 0.0
            agreed = float((expected[clear] == new[clear]).mean())
            if agreed > best[0] + 1e-9:
                best = agreed, rate, expected
        tries.append(best)
    least = max((best[0] for best in tries), default=1.0) - _TIES / clear.sum()
    agreed, rate, expected = next((best for best in tries if best[0] >= least), (0.0, 0.0, new))
    if agreed >= _AGREE:
        expected[0] = True
        notes.append(
            f"{rate:.5g} new pictures a second in a file of {file_rate:.4g}: repeated ones are left out"
        )
        return Clock(expected, times[0] + np.arange(expected.sum()) / rate, notes)
    notes.append(
        f"{same.sum()} pictures repeat the one before at no regular pace, as where a camera dropped "
        "some: they are left out, and the file's times stand"
    )
    return Clock(~same, times[~same], notes)
