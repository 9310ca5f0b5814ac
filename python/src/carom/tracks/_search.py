"""Which of its many minima is the strike of a recorded shot: a search over all of them.

A small change makes a ball miss another, so the cost of `_strikes` has many minima. The models are
off by centimetres besides, so a strike that follows the first second best need not lead to the one
that follows the whole shot best, and a search that narrows its choice with the time of the samples
loses it. Therefore three kinds of candidates meet in one contest over the whole shot:

1. starts of many spins, the samples of the first second descended into;
2. the survivors of each horizon: the samples of the first 0.9, 2, 4 and 8 s, where the offspring of
   the survivors of one horizon are candidates of the next;
3. offspring of the best strikes that are known, in rounds, until a shot is settled: rounds no longer
   improve it, or it is at the noise.

In a contest all candidates are played, the best descend a few steps, and the best of these go on to
more steps. Offspring are drawn from the normal distribution that the normal equations of a parent
give, by the whole shot or by its first second alone, narrower and wider.

The draws are the same for every shot and every call, so the strike of a shot depends neither on a
seed nor on the shots beside it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.dtypes import Doubles
from carom.tracks import _strikes
from carom.tracks._strikes import HUBER, Integers, Plays, allowed, descend

_FIRST = 0.9  # s: samples of the starts' descent
_TURNED = 0.15  # of the speed: the starts' spins are moved by so much, which leaves their grid
# starts of moved spins that are candidates, after so many iterations
_STARTS, _START_STEPS = {False: 6, True: 30}, 2
# Horizons (s), how many candidates descend by its samples, and how many survive; iterations, and
# offspring of each survivor of the horizon before.
_HORIZONS = {
    False: ((_FIRST, 8, 8), (2.0, 3, 3), (4.0, 3, 3), (8.0, 3, 3)),
    True: ((_FIRST, 14, 14), (2.0, 8, 8), (4.0, 7, 6), (8.0, 6, 4)),
}
_HORIZON_STEPS, _HORIZON_OFFSPRING = 4, 30
# How many descend by the whole shot, and iterations
_CONTEST = {False: ((8, 2), (3, 4)), True: ((30, 3), (10, 4), (6, 6))}
# Rounds, at most; parents of a shot, offspring of each, and how many of all descend, with iterations
_ROUNDS, _PARENTS, _OFFSPRING = {False: 0, True: 12}, 6, 60
_ROUND = ((24, 1), (12, 2), (4, 6))
# Deviations of offspring are 10^x of those by the normal equations, x uniform in a range
_BY_HORIZON, _BY_ALL, _BY_FIRST = (0.0, 1.0), (-0.4, 1.5), (-1.0, 0.7)
_BETTER = 0.99  # a shot is settled after a round whose least cost is not so many times that before
_NOISE = 1.2  # times its noise: a shot that is fitted so well is settled
_ALIKE = 4  # of so many times the chosen, the best of a shot, each is asked whether it is another
# Strikes of a shot that descend at last, and iterations; iterations at the change to squares
_FINALISTS, _LAST, _SQUARES = {False: 1, True: 4}, {False: 10, True: 20}, 10


@dataclass
class _Candidates:
    """Strikes of several shots, in the order of the shots, and the sums of `Plays.misfit` there."""

    shots: Integers  # (n,)
    strikes: Doubles  # (n, 6)
    sums: Doubles  # (n, ...)

    def __getitem__(self, rows: NDArray[np.generic]) -> _Candidates:
        return _Candidates(self.shots[rows], self.strikes[rows], self.sums[rows])

    def best(self, keep: int) -> _Candidates:
        return self[_best(self.shots, self.strikes, self.sums[:, 0], keep)]

    def least(self, count: int) -> Doubles:
        """The least cost of each of `count` shots; infinite without a candidate."""
        least = np.full(count, np.inf)
        np.minimum.at(least, self.shots, self.sums[:, 0])
        return least


def _join(parts: list[_Candidates]) -> _Candidates:
    return _Candidates(
        np.concatenate([part.shots for part in parts]),
        np.concatenate([part.strikes for part in parts]),
        np.concatenate([part.sums for part in parts]),
    )


def _best(shots: Integers, strikes: Doubles, costs: Doubles, keep: int) -> NDArray[np.intp]:
    """The rows of the `keep` best strikes of each shot, without those that are near a better one;
    in the order of the shots.
    """
    rows = np.lexsort((costs, shots))
    ranks = np.arange(len(rows)) - np.searchsorted(shots[rows], shots[rows])
    rows = rows[(ranks < _ALIKE * keep) & np.isfinite(costs[rows])]
    chosen = [np.zeros(0, np.intp)]
    while len(rows) and len(chosen) <= keep:
        # the first of each shot is its best; what is near it goes, and it too
        begins = np.append(True, np.diff(shots[rows]) > 0)
        leaders = rows[begins]
        gaps = strikes[rows] - strikes[leaders[np.cumsum(begins) - 1]]
        rows = rows[np.abs(gaps[:, :5]).max(axis=1) > 1e-2]
        chosen.append(leaders)
    rows = np.concatenate(chosen)
    return rows[np.lexsort((rows, shots[rows]))]


def _survivors(
    plays: Plays,
    shots: Integers,
    strikes: Doubles,
    end: Doubles,
    stages: tuple[tuple[int, int], ...],
    huber: float = HUBER,
) -> _Candidates:
    """Of strikes in any order, by the samples up to end[shot]: in each stage so many of the best of
    a shot descend so many iterations.
    """
    costs = plays.misfit(shots, strikes, end[shots], -np.inf, huber=huber)[:, 0]
    sums = None
    for descending, iterations in stages:
        rows = _best(shots, strikes, costs, descending)
        shots, known = shots[rows], None if sums is None else sums[rows]
        strikes, sums = descend(
            plays, shots, strikes[rows], end[shots], iterations, huber=huber, sums=known
        )
        costs = sums[:, 0]
    return _Candidates(shots, strikes, sums)


def _offspring(
    parents: _Candidates, each: int, widths: tuple[float, float], random: np.random.Generator
) -> tuple[Integers, Doubles]:
    """Strikes drawn about those of parents; parents of the same rank in their shots have the same
    draws.
    """
    square, _ = _strikes.normal(parents.sums)
    values, axes = np.linalg.eigh(square)
    speed = np.hypot(parents.strikes[:, :1], parents.strikes[:, 1:2])
    most = 0.5 * np.maximum(speed, 0.3)
    variance = parents.sums[:, :1] / np.maximum(parents.sums[:, 2:3], 1.0)
    deviation = np.minimum(np.sqrt(variance / np.maximum(values, 1e-12)), most)

    ranks = np.arange(len(speed)) - np.searchsorted(parents.shots, parents.shots)
    shape = _HORIZONS[True][0][2], each
    wide = 10.0 ** random.uniform(*widths, size=(*shape, 1))
    drawn = (wide * random.normal(size=(*shape, axes.shape[1])))[ranks]
    moved = np.einsum("nij,nmj->nmi", axes * deviation[:, None, :], drawn)
    tried = parents.strikes[:, None] + np.clip(moved, -most[..., None], most[..., None])
    return np.repeat(parents.shots, each), allowed(tried.reshape(-1, axes.shape[1]))


def _starts(plays: Plays) -> tuple[Integers, Doubles, Doubles]:
    """Strikes to start from, and the same with other spins."""
    found, moved = [], []
    for shot, begin in zip(plays.recordings, plays.origins):
        rows = _strikes.starts(shot, plays.table_size, plays.radius)
        rows[:, 5] -= begin
        found.append(rows)
        speed = np.hypot(rows[:, :1], rows[:, 1:2])
        turned = np.random.default_rng(0).uniform(-_TURNED, _TURNED, (len(rows), 3))
        moved.append(rows + np.pad(speed * turned, ((0, 0), (2, 1))))
    shots = np.repeat(np.arange(len(found), dtype=np.int32), [len(rows) for rows in found])
    return shots, allowed(np.concatenate(found)), allowed(np.concatenate(moved))


def _by_horizons(
    plays: Plays, squares: bool, random: np.random.Generator
) -> tuple[Integers, Doubles]:
    """The candidates of kinds 1 and 2."""
    shots, strikes, moved = _starts(plays)
    end = np.minimum(_FIRST, plays.ends)
    front = _survivors(plays, shots, moved, end, ((_STARTS[squares], _START_STEPS),))
    pool = [front]
    for horizon, descending, kept in _HORIZONS[squares]:
        if horizon > _FIRST:
            drawn_of, drawn = _offspring(front, _HORIZON_OFFSPRING, _BY_HORIZON, random)
            shots = np.concatenate([front.shots, drawn_of])
            strikes = np.concatenate([front.strikes, drawn])
        end = np.minimum(horizon, plays.ends)
        front = _survivors(plays, shots, strikes, end, ((descending, _HORIZON_STEPS),)).best(kept)
        pool.append(front)
    candidates = _join(pool)
    return candidates.shots, candidates.strikes


def _next_round(
    plays: Plays, parents: _Candidates, huber: float, random: np.random.Generator
) -> _Candidates:
    """The best offspring of parents."""
    end = np.minimum(_FIRST, plays.ends)[parents.shots]
    first = plays.misfit(parents.shots, parents.strikes, end, np.inf)
    by_first = _Candidates(parents.shots, parents.strikes, first)
    drawn = [
        _offspring(parents, _OFFSPRING // 2, _BY_ALL, random),
        _offspring(by_first, _OFFSPRING // 2, _BY_FIRST, random),
    ]
    shots, strikes = (np.concatenate(part) for part in zip(*drawn))
    return _survivors(plays, shots, strikes, plays.ends, _ROUND, huber)


def find(
    plays: Plays,
    seed: int = 0,
    progress: Callable[[str, float], None] | None = None,
    *,
    squares: bool = False,
) -> tuple[Doubles, Doubles]:
    """The strikes of all shots, (shots, 6), and their costs, (shots,): infinite where no start
    could be played.

    With `squares`, those of the least plain squares, which the RMSE is made of, where it counts
    that none of the worst stays bad: the rounds are for these. Without, those of the least cost.
    """
    random = np.random.default_rng(seed)
    count, huber, rounds = len(plays.recordings), HUBER, _ROUNDS[squares]
    candidates = _by_horizons(plays, squares, random)
    known = _survivors(plays, *candidates, plays.ends, _CONTEST[squares]).best(_PARENTS)
    noise = np.array([2.0 * (_NOISE * shot.noise) ** 2 for shot in plays.recordings])
    active = np.ones(count, bool)
    for number in range(rounds):
        if progress:
            progress("strikes", (number + 1) / (rounds + 1))
        if number == 1:  # from here on by squares
            active[:], huber = True, 0.0
            end = plays.ends[known.shots]
            strikes, sums = descend(plays, known.shots, known.strikes, end, _SQUARES, huber=huber)
            known = _Candidates(known.shots, strikes, sums)
        active[known.shots[known.sums[:, 0] < known.sums[:, 2] * noise[known.shots]]] = False
        parents = known[active[known.shots]]
        if len(parents.shots):
            before = known.least(count)
            known = _join([known, _next_round(plays, parents, huber, random)]).best(_PARENTS)
            active &= known.least(count) < _BETTER * before

    # the last descent
    known = known.best(_FINALISTS[squares])
    shots, end = known.shots, plays.ends[known.shots]
    strikes, sums = descend(
        plays, shots, known.strikes, end, _LAST[squares], huber=huber, sums=known.sums
    )
    known = _Candidates(shots, strikes, sums).best(1)
    found, cost = np.full((count, strikes.shape[1]), np.nan), np.full(count, np.inf)
    found[known.shots], cost[known.shots] = known.strikes, known.sums[:, 0]
    return found, cost
