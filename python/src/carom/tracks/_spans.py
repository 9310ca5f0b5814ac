"""When shots are played in a film: the times of motion between times at which all balls rest.

A film of several shots also shows how balls are put elsewhere by hand, which is not a shot.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from carom.dtypes import Doubles

FASTEST = 9.0  # m/s: no ball is faster
_PAUSE = 0.7  # s: rest that separates two shots
_LEAST = 0.03  # m: length that the longest path of a shot has at least
_PUT = 0.05  # m: excess distance above which a ball was placed by hand
_LIES = 5  # rows of a ball at rest
_CARRIED = 1.0  # s within which no stroke brings a ball to rest 5 cm away
_BEFORE, _AFTER = 0.4, 0.2  # s of a shot before the first and after the last motion
_WINDOW = 0.2  # s: a ball moves that is farther from its position after this time
_SMOOTH = 5  # rows whose median is a position, so that noise is no motion


def _layouts(tracks: Sequence[Doubles]) -> Doubles:
    """The times at which balls were set up again, s.

    A ball is then farther from its last position than it could move, or at rest elsewhere sooner
    than after a stroke.
    """
    found = set[float]()
    for track in tracks:
        t, places = track[:, 0], track[:, 1:]
        ways, gaps = np.hypot(*np.diff(places, axis=0).T), np.diff(t)
        for k in np.flatnonzero(ways > _PUT).tolist():
            sides = places[max(k - _LIES, 0) : k + 1], places[k + 1 : k + 2 + _LIES]
            lies = all(np.hypot(*np.ptp(side, axis=0)) < 0.2 * _PUT for side in sides)
            if ways[k] > FASTEST * gaps[k] + _PUT or (lies and gaps[k] < _CARRIED):
                found.add(float(t[k + 1]))
    return np.array(sorted(found))


def _smoothed(places: Doubles) -> Doubles:
    """Medians over rows, of a few rows at the ends."""
    wide = np.pad(places, ((_SMOOTH // 2, _SMOOTH // 2), (0, 0)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(wide, _SMOOTH, axis=0)
    return np.asarray(np.median(windows, axis=2))


def _extent(track: Doubles, begin: float, end: float) -> float:
    """The extent of a track between two times, m."""
    places = track[(track[:, 0] >= begin) & (track[:, 0] <= end), 1:]
    return float(np.hypot(*np.ptp(places, axis=0))) if len(places) else 0.0


def spans(
    tracks: Sequence[Doubles], times: Doubles, noises: Sequence[Doubles]
) -> list[tuple[float, float]]:
    """Beginning and end of each shot, s: the times of motion between new layouts.

    `tracks` are rows (t, x, y) of each ball, `times` those of the frames, and `noises` are
    the deviations of a coordinate in the rows, m.
    """
    moving = np.zeros(len(times), bool)
    layouts = _layouts(tracks)
    for track, deviations in zip(tracks, noises):
        t, places = track[:, 0], _smoothed(track[:, 1:])
        least = 0.004 + 4.0 * np.interp(times, t, deviations)
        away = [
            np.interp(times + _WINDOW, t, places[:, axis]) - np.interp(times, t, places[:, axis])
            for axis in (0, 1)
        ]
        moving |= (np.hypot(*away) > least) & (times >= t[0]) & (times <= t[-1])
    # how balls are put up is no motion
    number = np.searchsorted(layouts, times, side="right")
    moving &= number == np.searchsorted(layouts, times + _WINDOW, side="right")
    runs: list[list[float]] = []
    for t in times[moving].tolist():
        laid = runs and not ((layouts > runs[-1][1]) & (layouts <= t)).any()
        if laid and t - runs[-1][1] < _PAUSE:
            runs[-1][1] = t
        else:
            runs.append([t, t])
    shots = []
    for begin, end in runs:
        ways = [_extent(track, begin - 0.05, end + _WINDOW) for track in tracks]
        if max(ways, default=0.0) >= _LEAST and end > begin:
            shots.append((begin, end + _WINDOW))
    # a shot has no row of its neighbours'
    ends = [float(times[0]), *(end for _, end in shots)]
    begins = [*(begin for begin, _ in shots), np.inf]
    found = []
    for (begin, end), preceding, following in zip(shots, ends, begins[1:]):
        low = max([preceding, *layouts[layouts <= begin]])
        high = min([following, *(layouts[layouts > begin] - 1e-6)])
        found.append((max(begin - _BEFORE, low), min(end + _AFTER, high)))
    return found
