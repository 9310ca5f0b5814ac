"""The search for the strike of a recorded shot among the many minima of its cost.

A small change makes a ball miss another, so the cost of `_strikes` has many minima, and the models
have errors of centimetres. The strike that fits the first second best is therefore not always near
the one that fits the complete shot best, and a search that narrows its choice as samples are added
can lose the latter. Candidates of three kinds therefore compete over the complete shot:

1. starts of many spins, after a short descent by the samples of the first second;
2. the survivors of each horizon, the samples of the first 0.9, 2, 4 and 8 s: offspring of the
   survivors of one horizon are candidates of the next;
3. offspring of the best strikes so far, in rounds, until the rounds no longer improve the shot or the
   shot is fitted to its noise.

In a contest all candidates are played, the best of them descend a few iterations, and the best of
these descend further. Offspring are drawn from the normal distribution of a parent's normal
equations, for the complete shot or only its first second, at many widths.

A *basin* is the set of strikes whose plays have the same contacts in the same order. A descent
rarely leaves its basin, because the cost has a cliff where a contact appears or vanishes, and many
strikes of one basin can be better than the best of another one, until this one has descended.
Survivors and parents are therefore chosen from different basins, and a shot is searched until eight
rounds in sequence have not improved it.

All shots use the same draws. A strike therefore does not depend on the other shots, nor on the seed
of a fit, which only the search for constants uses.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.dtypes import Doubles
from carom.tracks import _strikes
from carom.tracks._strikes import FIRST, HUBER, Integers, Plays, allowed, descend, first_end

Stages = tuple[tuple[int, int], ...]  # how many candidates of a shot descend, and iterations


@dataclass(frozen=True)
class _Effort:
    """The number of candidates of a search per shot."""

    starts: int  # whose spins lie between those of the grid
    horizons: tuple[tuple[float, int, int], ...]  # s, how many descend, and how many survive
    contest: Stages
    rounds: int  # at most
    finalists: int  # that descend at last
    iterations: int  # of this descent


# Found by trial on the shots of docs/understanding/reality.md: of 91, five draws lose 4 to 7 by 10 %
# against the best known strikes. They lose 12 to 15 with survivors and parents from any basin and one
# round without an improvement.
_QUICK = _Effort(
    starts=6,
    horizons=((0.9, 8, 8), (2.0, 3, 3), (4.0, 3, 3), (8.0, 3, 3)),
    contest=((8, 2), (3, 4)),
    rounds=0,
    finalists=1,
    iterations=10,
)
_THOROUGH = _Effort(
    starts=30,
    horizons=((0.9, 14, 14), (2.0, 8, 8), (4.0, 7, 6), (8.0, 6, 4)),
    contest=((30, 3), (10, 4), (6, 6)),
    rounds=40,
    finalists=4,
    iterations=20,
)
_START_STEPS, _HORIZON_STEPS, _SQUARES_STEPS = 2, 4, 10  # iterations of one descent
_TURNED = 0.15  # of the speed: how far the spins of starts are moved off their grid
# Parents of a shot in a round, offspring of each, and the contest of these; and offspring of each
# survivor of a horizon
_PARENTS, _OFFSPRING, _ROUND, _HORIZON_OFFSPRING = 4, 60, ((24, 1), (12, 2), (4, 6)), 30
# Deviations of offspring are 10^x of those by the normal equations, x uniform in a range
_BY_HORIZON, _BY_ALL, _BY_FIRST = (0.0, 1.0), (-0.4, 1.5), (-1.0, 1.6)
_RANKS = max(kept for _, _, kept in _THOROUGH.horizons)  # most parents of a shot
_BASINS = 12  # of a shot that are kept from round to round
# A shot is finished after so many rounds in sequence that leave more than so much of the least cost
_QUIET, _BETTER = 8, 0.99
_NOISE = 1.2  # times its noise: a shot that is fitted so well needs no round


@dataclass
class _Candidates:
    """Strikes of several shots, in the order of the shots, and the sums of `Plays.misfit` there."""

    shots: Integers  # (n,)
    strikes: Doubles  # (n, 6)
    sums: Doubles  # (n, ...)

    def __getitem__(self, rows: NDArray[np.generic]) -> _Candidates:
        return _Candidates(self.shots[rows], self.strikes[rows], self.sums[rows])

    def best(self, keep: int) -> _Candidates:
        """The best strikes of the best basins of each shot."""
        return self[_best(self.shots, self.sums[:, 3], self.sums[:, 0], keep, leaders=True)]

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


def _best(
    shots: Integers, basins: Doubles, costs: Doubles, keep: int, leaders: bool = False
) -> NDArray[np.intp]:
    """The rows of `keep` strikes of each shot, in the order of the shots and their costs.

    Alternately they are the best strikes, and the best strikes of basins (leaders), so that neither
    one basin nor many poor ones take all. With `leaders` they are only the latter.
    """
    rows = np.lexsort((costs, basins, shots))
    rows = rows[np.isfinite(costs[rows])]
    leads = _begins(shots[rows], basins[rows])
    order = np.lexsort((costs[rows], shots[rows]))
    rows, leads = rows[order], leads[order]

    # the rank of each among the strikes of its shot, and that of a leader among the leaders
    rank = _ranks(_begins(shots[rows]))
    of_leaders = np.full(len(rows), len(rows))
    of_leaders[leads] = _ranks(_begins(shots[rows][leads]))
    turn = of_leaders if leaders else np.minimum(2 * rank, 2 * of_leaders + 1)
    taken = np.lexsort((turn, shots[rows]))
    taken = taken[_ranks(_begins(shots[rows])) < keep]
    if leaders:
        taken = taken[leads[taken]]
    return rows[np.sort(taken)]


def _begins(*keys: NDArray[Any]) -> NDArray[np.bool_]:
    """Where groups of equal keys begin, in sorted rows."""
    begins = np.ones(len(keys[0]), bool)
    begins[1:] = np.any([key[1:] != key[:-1] for key in keys], axis=0)
    return begins


def _ranks(begins: NDArray[np.bool_]) -> NDArray[np.intp]:
    """The rank of each row in its group, from where the groups begin."""
    rows = np.arange(len(begins))
    return np.asarray(rows - np.maximum.accumulate(np.where(begins, rows, 0)))


def _survivors(
    plays: Plays,
    shots: Integers,
    strikes: Doubles,
    end: Doubles,
    stages: Stages,
    huber: float = HUBER,
) -> _Candidates:
    """The survivors of strikes in any order, judged by the samples up to end[shot].

    In each stage a number of the best strikes of a shot descend a number of iterations.
    """
    sums = screened = plays.misfit(shots, strikes, end[shots], -np.inf, huber=huber)
    for descending, iterations in stages:
        rows = _best(shots, sums[:, 3], sums[:, 0], descending)
        known = None if sums is screened else sums[rows]  # a screening has no derivatives
        shots = shots[rows]
        strikes, sums = descend(
            plays, shots, strikes[rows], end[shots], iterations, huber=huber, sums=known
        )
    return _Candidates(shots, strikes, sums)


def _offspring(
    parents: _Candidates, each: int, widths: tuple[float, float], random: np.random.Generator
) -> tuple[Integers, Doubles]:
    """Strikes drawn around their parents; parents of equal rank in their shots use the same draws."""
    square, _ = _strikes.normal(parents.sums)
    values, axes = np.linalg.eigh(square)
    speed = np.hypot(parents.strikes[:, :1], parents.strikes[:, 1:2])
    most = 0.5 * np.maximum(speed, 0.3)
    variance = parents.sums[:, :1] / np.maximum(parents.sums[:, 2:3], 1.0)
    deviation = np.minimum(np.sqrt(variance / np.maximum(values, 1e-12)), most)

    ranks = np.arange(len(speed)) - np.searchsorted(parents.shots, parents.shots)
    shape = _RANKS, each
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


def _first_ends(plays: Plays) -> Doubles:
    """The end of the first samples of each shot, s."""
    return np.asarray(np.minimum([first_end(shot) for shot in plays.recordings], plays.ends))


def _by_horizons(
    plays: Plays, effort: _Effort, random: np.random.Generator
) -> tuple[Integers, Doubles]:
    """The candidates of kinds 1 and 2."""
    shots, strikes, moved = _starts(plays)
    first = _first_ends(plays)
    front = _survivors(plays, shots, moved, first, ((effort.starts, _START_STEPS),))
    pool = [front]
    for horizon, descending, kept in effort.horizons:
        if horizon > FIRST:
            drawn_of, drawn = _offspring(front, _HORIZON_OFFSPRING, _BY_HORIZON, random)
            shots = np.concatenate([front.shots, drawn_of])
            strikes = np.concatenate([front.strikes, drawn])
        end = np.minimum(horizon, plays.ends) if horizon > FIRST else first
        front = _survivors(plays, shots, strikes, end, ((descending, _HORIZON_STEPS),)).best(kept)
        pool.append(front)
    candidates = _join(pool)
    return candidates.shots, candidates.strikes


def _parents(known: _Candidates, random: np.random.Generator) -> _Candidates:
    """Some basins of each shot, a better one more often: of weight 1 over the rank."""
    rank = _ranks(_begins(known.shots))
    # the first of exponential times with these rates are draws without replacement; all shots have
    # the same times
    times = (random.exponential(size=_BASINS) * np.arange(1, _BASINS + 1))[rank]
    rows = np.lexsort((times, known.shots))
    return known[np.sort(rows[rank < _PARENTS])]


def _next_round(
    plays: Plays, parents: _Candidates, huber: float, random: np.random.Generator
) -> _Candidates:
    """The best offspring of parents."""
    end = _first_ends(plays)[parents.shots]
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
    """The strikes of all shots, (shots, 6), and their costs, (shots,), infinite without a playable
    start.

    With `squares` a thorough search minimises plain squares, which define the RMSE; otherwise a
    quick search minimises the cost. `seed` selects other draws.
    """
    random = np.random.default_rng(seed)
    count, huber, effort = len(plays.recordings), HUBER, _THOROUGH if squares else _QUICK
    candidates = _by_horizons(plays, effort, random)
    known = _survivors(plays, *candidates, plays.ends, effort.contest).best(_BASINS)
    noise = np.array([2.0 * (_NOISE * shot.noise) ** 2 for shot in plays.recordings])
    active, quiet = np.ones(count, bool), np.zeros(count, int)
    for number in range(effort.rounds):
        if progress:
            progress("strikes", (number + 1) / (effort.rounds + 1))
        if number == 1:  # from here on by squares
            active[:], huber = True, 0.0
            end = plays.ends[known.shots]
            strikes, sums = descend(
                plays, known.shots, known.strikes, end, _SQUARES_STEPS, huber=huber
            )
            known = _Candidates(known.shots, strikes, sums).best(_BASINS)
        active[known.shots[known.sums[:, 0] < known.sums[:, 2] * noise[known.shots]]] = False
        # each round has its own draws, whatever rounds other shots need
        random = np.random.default_rng([seed, number])
        parents = _parents(known[active[known.shots]], random)
        if not len(parents.shots):
            continue
        before = known.least(count)
        known = _join([known, _next_round(plays, parents, huber, random)]).best(_BASINS)
        quiet = np.where(known.least(count) < _BETTER * before, 0, quiet + 1)
        active &= quiet < _QUIET

    # the last descent
    known = known.best(effort.finalists)
    shots, end = known.shots, plays.ends[known.shots]
    strikes, sums = descend(
        plays, shots, known.strikes, end, effort.iterations, huber=huber, sums=known.sums
    )
    known = _Candidates(shots, strikes, sums).best(1)
    found, cost = np.full((count, strikes.shape[1]), np.nan), np.full(count, np.inf)
    found[known.shots], cost[known.shots] = known.strikes, known.sums[:, 0]
    return found, cost
