"""Profile likelihoods: how well shots determine each constant.

The profile of a constant is the cost of the shots, without the priors, as a function of this
constant, with all others and the strikes refitted. One deviation of a prior costs `prior_cost`, the
unit of evidence: the 95 % interval ends where the profile is 3.84 units above its minimum. If the
interval is as wide as the prior's, the shots do not determine the constant.

If a point of a profile costs less than the end of the search, the search continues from there
(`best`). Profiles extend three deviations to each side. They therefore find solutions that a search
from the prior's mean cannot reach while its misfit, and so the prior's weight, is large.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass

import numpy as np

from carom.dtypes import Doubles
from carom.tracks._joint import Search

LEVEL = 3.84  # of the chi-squared distribution with one degree of freedom, 95 %
NORMAL = 1.96  # deviations of the same
_REACH = 3.0  # deviations of the prior to each side
_TOLD = 0.7  # fraction of the prior's width above which an interval has no information
_BETTER, _HALF = 1.0, 0.5  # another start must be better by this unit, or by this part of the cost
_COUNTED = 0.5  # a shot with less weight is named


@dataclass(frozen=True)
class Profiles:
    """The 95 % interval of each constant, or None; and a better start of the search, if there is
    one.
    """

    intervals: dict[str, tuple[float, float] | None]
    best: tuple[Doubles, Doubles] | None  # constants and strikes


def _cost(search: Search, move: Doubles, follow: dict[int, Doubles]) -> tuple[float, Search]:
    """The cost without priors after a move of the constants, in deviations, and the search there.

    Each strike is refitted or kept, whichever is better.
    """
    trial = copy.copy(search)
    trial.values = np.clip(search.values + search.scale * move, search.low, search.high)
    strikes = search.strikes.copy()
    for index, change in follow.items():
        strikes[index] -= change[:, :-1] @ move
    trial.plays.set(trial.constants(trial.values))
    costs = [
        trial.plays.misfit(trial.rows, candidates, trial.ends, -np.inf)[:, 0]
        for candidates in (strikes, search.strikes)
    ]
    better = (costs[0] < costs[1])[:, None]
    whole, trial.strikes = trial.cost(trial.values, np.where(better, strikes, search.strikes), 6)
    prior = search.prior_cost * (((trial.values - search.first) / search.scale) ** 2).sum()
    return float(whole - prior), trial


def profiles(search: Search) -> Profiles:
    """The profiles of a finished search."""
    whole, _, follow = search.equations()
    count, unit = len(search.names), search.prior_cost
    data = whole - unit * np.eye(count)
    least, _ = _cost(search, np.zeros(count), {})
    best, found = max(least - _BETTER * unit, _HALF * least), None
    intervals: dict[str, tuple[float, float] | None] = {}
    for j, name in enumerate(search.names):
        # how the others follow, and the curvature that is left
        others = np.arange(count) != j
        direction: Doubles = np.zeros(count)
        direction[j] = 1.0
        direction[others] = -np.linalg.solve(whole[np.ix_(others, others)], whole[others, j])
        curvature = float(direction @ data @ direction)
        size = np.sqrt(LEVEL * unit / max(curvature, 1e-12 * unit))

        ends = []
        for side in (-1.0, 1.0):
            inside, outside, end = 0.0, np.inf, _REACH
            for step in (min(size, _REACH), 1.0, _REACH):
                if not inside < step < outside:
                    continue
                cost, trial = _cost(search, side * step * direction, follow)
                if cost < best:
                    best, found = cost, (trial.values, trial.strikes)
                above = (cost - least) / unit
                if above < LEVEL:
                    inside = step
                else:
                    # a parabola through the least and this point
                    outside, end = step, step * np.sqrt(LEVEL / above)
            ends.append(max(end, inside))
        low, high = (
            float(np.clip(search.values[j] + side * end * search.scale[j], *bound))
            for side, end, bound in zip((-1.0, 1.0), ends, 2 * [(search.low[j], search.high[j])])
        )
        told = sum(ends) < _TOLD * 2.0 * NORMAL
        intervals[name] = (low, high) if told else None
    search.plays.set(search.constants(search.values))
    return Profiles(intervals, found)


def light(search: Search) -> list[tuple[int, float]]:
    """The shots with less than half weight because of their misfit, and their weights."""
    sums = search.plays.misfit(search.rows, search.strikes, search.plays.ends[search.rows], -np.inf)
    weights = 1.0 / (1.0 + sums[:, 0] / search.counts / search.middle)
    typical = max(float(np.median(weights)), 1e-9)
    some = np.flatnonzero(weights < _COUNTED * typical)
    return [(int(search.rows[k]), float(weights[k] / typical)) for k in some]
