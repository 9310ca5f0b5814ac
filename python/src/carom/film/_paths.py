"""Balls over time: which blob of a frame is which ball.

A ball continues its motion or stays at rest. A struck ball leaves at up to 9 m/s, and is then
identified by its colour. A hidden ball has no rows until it is visible again.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carom.dtypes import Doubles
from carom.tracks._spans import FASTEST

_RESTING = 0.03  # m/s: below, a ball is at rest, however long it is hidden
_HIDDEN = 0.5  # s: longest time for which a moving ball may be hidden
_LOST = 3.0  # s: longest gap between two paths of one ball
_ALIKE = 60.0  # largest difference of colours of the same ball, levels
_MOMENT = 0.25  # s: shortest path of a ball
_WHOLE = 0.72  # fraction of a ball's area below which a path belongs to a shadow or a mark
_SOONER = 1.5  # a ball that was just hit was so many times as fast as it is seen to be, at most
_STRAIGHT = 0.006  # m: largest second difference of rows without an event


@dataclass
class Path:
    """A ball's rows: the index of the frame, and the blob in it."""

    numbers: list[int] = field(default_factory=list[int])
    blobs: list[np.void] = field(default_factory=list[np.void])
    name: str = ""

    @property
    def places(self) -> Doubles:
        return np.array([blob["place"] for blob in self.blobs])

    def velocity(self, times: Doubles) -> Doubles:
        """The velocity from the last two rows, m/s; 0 for a ball at rest."""
        if len(self.numbers) < 2:
            return np.zeros(2)
        first = -2 if len(self.numbers) < 5 else -5
        away = self.blobs[-1]["place"] - self.blobs[first]["place"]
        gap = times[self.numbers[-1]] - times[self.numbers[first]]
        if np.hypot(*away) < _RESTING * gap + 0.002:
            return np.zeros(2)
        last = times[self.numbers[-1]] - times[self.numbers[-2]]
        velocity: Doubles = (self.blobs[-1]["place"] - self.blobs[-2]["place"]) / last
        return velocity

    def first_velocity(self, times: Doubles) -> Doubles:
        """The velocity by the first rows, m/s; 0 for a ball at rest."""
        last = min(4, len(self.numbers) - 1)
        gap = float(times[self.numbers[last]] - times[self.numbers[0]])
        away = self.blobs[last]["place"] - self.blobs[0]["place"]
        if last == 0 or np.hypot(*away) < _RESTING * gap + 0.002:
            return np.zeros(2)
        velocity: Doubles = (self.blobs[1]["place"] - self.blobs[0]["place"]) / (
            times[self.numbers[1]] - times[self.numbers[0]]
        )
        return velocity


def linked(
    found: list[NDArray[np.void]], parts: list[NDArray[np.void]], times: Doubles, radius: float
) -> list[Path]:
    """The paths of the blobs of all frames, except very short ones.

    `parts` are round parts of hands and cues: a ball that is first seen moving may have been one.
    """
    live: list[Path] = []
    done: list[Path] = []
    for k, blobs in enumerate(found):
        pairs = _pairs(live, blobs, times, k, radius)
        free, used = set(range(len(live))), set[int]()
        # the nearest pair first; each path and each blob once
        for _, i, j in sorted(pairs):
            if i in free and j not in used:
                free.discard(i)
                used.add(j)
                live[i].numbers.append(k)
                live[i].blobs.append(blobs[j])
        new = [Path([k], [blobs[j]]) for j in range(len(blobs)) if j not in used]
        alive: list[Path] = []
        for path in live:
            hidden = times[k] - times[path.numbers[-1]]
            rests = not path.velocity(times).any() and len(path.numbers) > 5
            (alive if hidden < _HIDDEN or rests else done).append(path)
        live = alive + new
    every = done + live
    paths = _joined(every, times)
    kept = {(k, id(row)) for path in paths for k, row in zip(path.numbers, path.blobs)}
    spare: list[list[np.void]] = [list(rows) for rows in parts]
    for path in every:
        for k, row in zip(path.numbers, path.blobs):
            if (k, id(row)) not in kept:
                spare[k].append(row)
    for path in paths:
        _begin_at_rest(path, spare, times, radius)
    return paths


def _begin_at_rest(path: Path, spare: list[list[np.void]], times: Doubles, radius: float) -> None:
    """Extend a path that begins with motion back to where its ball lay, by spare blobs: of short
    paths, and round parts of hands and cues.
    """
    velocity = path.first_velocity(times)
    if not velocity.any():
        return
    first, found = path.blobs[0], list[tuple[int, np.void]]()
    for k in range(path.numbers[0] - 1, -1, -1):
        last = path.numbers[0] if not found else found[-1][0]
        if times[last] - times[k] > _HIDDEN:
            break
        best: tuple[float, np.void] | None = None
        for part in spare[k]:
            if found:
                miss = float(np.hypot(*(part["place"] - found[-1][1]["place"])))
            else:
                # on the way back from the first row, not farther than the ball came
                step, gap = first["place"] - part["place"], float(times[last] - times[k])
                share = float(np.clip(step @ velocity / (velocity @ velocity), 0.0, _SOONER * gap))
                miss = float(np.hypot(*(step - share * velocity)))
            alike = _difference(part, first) < _ALIKE
            if alike and miss < radius and (best is None or miss < best[0]):
                best = miss, part
        if best is not None:
            found.append((k, best[1]))
    path.numbers[:0] = [k for k, _ in reversed(found)]
    path.blobs[:0] = [part for _, part in reversed(found)]


def _joined(paths: list[Path], times: Doubles) -> list[Path]:
    """The paths, except very short ones.

    A path that begins where a hidden ball of the same colour may have moved to continues that
    ball's path.
    """
    paths = [
        path
        for path in paths
        if times[path.numbers[-1]] - times[path.numbers[0]] >= _MOMENT
        and len(path.numbers) >= 5
        and np.median([blob["share"] for blob in path.blobs]) > _WHOLE
    ]
    pairs = []
    for i, path in enumerate(paths):
        for j, second in enumerate(paths):
            gap = float(times[second.numbers[0]] - times[path.numbers[-1]])
            way = float(np.hypot(*(second.blobs[0]["place"] - path.blobs[-1]["place"])))
            alike = _difference(second.blobs[0], path.blobs[-1]) < _ALIKE
            if 0.0 < gap < _LOST and way < FASTEST * gap and alike:
                pairs.append((gap + way, i, j))
    following: dict[int, int] = {}
    for _, i, j in sorted(pairs):
        if i not in following and j not in following.values():
            following[i] = j
    # later parts are added to the first of each chain
    for i in sorted(set(range(len(paths))) - set(following.values())):
        part = i
        while part in following:
            part = following[part]
            paths[i].numbers += paths[part].numbers
            paths[i].blobs += paths[part].blobs
    later = set(following.values())
    return [path for i, path in enumerate(paths) if i not in later]


def _pairs(
    live: list[Path], blobs: NDArray[np.void], times: Doubles, k: int, radius: float
) -> list[tuple[float, int, int]]:
    """(cost, path, blob) of each blob that may continue a path."""
    pairs = []
    for i, path in enumerate(live):
        gap = float(times[k] - times[path.numbers[-1]])
        last, velocity = path.blobs[-1], path.velocity(times)
        reach = 0.8 * radius + 0.5 * float(np.hypot(*velocity)) * gap
        for j, blob in enumerate(blobs):
            step = blob["place"] - last["place"]
            way = float(np.hypot(*step))
            if way > FASTEST * gap + radius:
                continue
            colour = _difference(blob, last)
            if colour > _ALIKE:
                continue
            miss = min(float(np.hypot(*(step - velocity * gap))), 0.6 * way + 0.1 * radius)
            if miss < reach:
                pairs.append((miss + 2e-4 * colour, i, j))
            elif gap < 0.3:
                # a ball that was hit or turned, after all balls that continue their motion
                pairs.append((10.0 + way + 0.004 * colour, i, j))
    return pairs


def _difference(blob: np.void, second: np.void) -> float:
    """The difference of two colours, levels. The visible white of a rolling ball varies."""
    levels = float(np.abs(blob["colour"] - second["colour"]).max())
    plain = 1.0 - max(float(blob["white"]), float(second["white"]))
    turned = abs(float(blob["white"] - second["white"]))
    return 1.3 * plain * levels + 150.0 * max(turned - 0.4, 0.0)


def turns(
    paths: list[Path], times: Doubles, size: tuple[float, float]
) -> list[tuple[int, Doubles]]:
    """(side, position) of each turn at a cushion, m.

    The position is the intersection of the lines through the rows before and after it, of which
    three must be straight on each side.
    """
    found = []
    step = float(np.median(np.diff(times)))
    for path in paths:
        places, t = path.places, times[path.numbers]
        whole = np.array([blob["whole"] for blob in path.blobs])
        for axis in (0, 1):
            x = places[:, axis]
            for k in range(3, len(x) - 3):
                if t[k + 3] - t[k - 3] > 6.5 * step or not whole[k - 3 : k + 4].all():
                    continue
                # the row before the turn, and that after
                v, w = (x[k - 1] - x[k - 2]) / step, (x[k + 2] - x[k + 1]) / step
                side = axis if v < 0.0 else axis + 2
                edge = x[k] if v < 0.0 else size[axis] - x[k]
                if v * w > 0.0 or min(abs(v), abs(w)) < 0.25 or edge > 0.08:
                    continue
                later = (x[k + 1] - x[k - 1] - 2.0 * step * w) / (step * (v - w))
                if not 0.4 < later < 1.6:
                    continue
                preceding = places[k - 1] + later * (places[k - 1] - places[k - 2])
                following = places[k + 1] + (later - 2.0) * (places[k + 2] - places[k + 1])
                bends = np.diff(places[[k - 3, k - 2, k - 1, k + 1, k + 2, k + 3]], 2, axis=0)
                if np.abs(bends[[0, 3]]).max() > _STRAIGHT:
                    continue
                found.append((side, 0.5 * (preceding + following)))
    return found
