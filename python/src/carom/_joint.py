"""Constants from whole shots: those that single events do not tell, searched one after another; or all of them together.

For given constants each shot's strike descends a few steps from where it was, by `_strikes.descend`. The cost of the constants is the
sum over shots of the shots' costs, each at most a bound, so that shots whose events are missed do not decide. The first seconds come
first: later samples follow from earlier events, and small errors of the constants have grown there beyond what a descent brings back.

Together, the constants are found by the covariance matrix adaptation evolution strategy of the package `cma` (N. Hansen), in units of the
deviations of their priors: the cost jumps where events appear and vanish, so slopes mislead. Constants then also absorb what the
engine's models leave out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from carom._strikes import Plays, descend, find
from carom.dtypes import Doubles

_MOST = 1.4e-3  # m^2: where a shot's cost a sample stops counting; that of samples that are 8 cm off
_ITERATIONS = 10  # of each strike, for each set of constants: with 4 the search ends where it began, as strikes lag behind
_GOLDEN = 0.5 * (5.0**0.5 - 1.0)
# Samples up to a time (s), and how far each constant is searched from where it is. On synthetic recordings with all samples from the
# beginning, mu_ball stays a tenth off.
STAGES: tuple[tuple[float, dict[str, float]], ...] = (
    (3.0, {"mu_ball": 0.05, "mu_spin": 0.003}),
    (3.0, {"mu_ball": 0.02, "mu_spin": 0.002}),
    (6.0, {"mu_spin": 0.002, "mu_ball": 0.01}),
)
# Deviations of the priors about the constants that single events gave; a constant that is not known to the library is passed over.
DEVIATIONS = {
    "mu_slide": 0.02, "mu_roll": 5e-4, "mu_spin": 3e-3, "mu_ball": 0.03, "restitution": 0.03, "restitution_cushion": 0.03,
    "mu_cushion": 0.06, "nose_height": 1.8e-3,
}  # fmt: skip
_PRIOR = 0.1  # m^2: what one deviation costs
_MOST_OF = {"mu_ball": 1.0, "restitution": 1.0, "restitution_cushion": 1.0, "mu_cushion": 1.0}
_ANEW = 12  # generations after which shots that are far off are searched anew
_STEPS = 8  # of a golden-section search: the last interval is 0.618^8, a fiftieth, of the first


class Objective:
    """The cost of constants, with the strikes that were best so far.

    Parameters
    ----------
    plays : Plays
        Its constants are changed.
    strikes : (shots, 6)
        To start from.
    constants : mapping
        All of them.
    rows : sequence of int
        The shots that count.
    """

    def __init__(self, plays: Plays, strikes: Doubles, constants: Mapping[str, float], rows: Sequence[int]) -> None:
        self.plays, self.constants = plays, dict(constants)
        self.rows = np.array([row for row in rows if np.isfinite(strikes[row]).all()], np.int32)
        self.strikes, self.until = strikes[self.rows], np.inf
        self.most = _MOST * np.array([sum(map(len, plays.recordings[row].tracks)) for row in self.rows])

    def of(self, given: Mapping[str, float], iterations: int = _ITERATIONS) -> tuple[float, Doubles, Doubles]:
        """The cost of some constants, the others as they are; the strikes, (rows, 6), and the shots' costs, (rows,)."""
        self.plays.set({**self.constants, **given})
        until = np.minimum(self.until, self.plays.ends[self.rows])
        strikes, costs = descend(self.plays, self.rows, self.strikes, until, iterations)
        costs = np.minimum(costs, self.most)
        return float(costs.sum()), strikes, costs

    def anew(self, constants: Mapping[str, float]) -> float:
        """The cost of all constants, with strikes that are searched from the beginning."""
        plays = self.plays.some(self.rows)
        plays.set(constants)
        return float(np.minimum(find(plays)[1], self.most).sum())


def one_by_one(objective: Objective, progress: Callable[[str, float], None] | None = None) -> dict[str, float]:
    """Golden-section search of one constant after another, by STAGES. Returns all constants."""
    searches = [(until, name, reach) for until, reaches in STAGES for name, reach in reaches.items()]
    for number, (until, name, reach) in enumerate(searches):
        if progress:
            progress("constants", number / len(searches))
        objective.until = until
        middle = objective.constants[name]
        low, high = max(middle - reach, 0.1 * middle), middle + reach
        # the two inner points divide the interval, and each step keeps one of them
        left, right = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        at_left, at_right = objective.of({name: left}), objective.of({name: right})
        for _ in range(_STEPS):
            if at_left[0] < at_right[0]:
                high, right, at_right = right, left, at_left
                left = high - _GOLDEN * (high - low)
                at_left = objective.of({name: left})
            else:
                low, left, at_left = left, right, at_right
                right = low + _GOLDEN * (high - low)
                at_right = objective.of({name: right})
        value, (_, strikes, _) = (left, at_left) if at_left[0] < at_right[0] else (right, at_right)
        objective.constants[name], objective.strikes = value, strikes
    return objective.constants


def together(
    objective: Objective, generations: int, seed: int, progress: Callable[[str, float], None] | None = None
) -> dict[str, float]:
    """All constants that DEVIATIONS has, found together. Returns all constants."""
    try:
        import cma  # pyright: ignore[reportMissingTypeStubs]
    except ImportError as error:
        raise ValueError("free: 'joint' needs the package cma: pip install cma") from error
    first = dict(objective.constants)
    names = [name for name in DEVIATIONS if name in first]

    def constants(x: Doubles) -> dict[str, float]:
        values = {name: first[name] + DEVIATIONS[name] * float(z) for name, z in zip(names, x)}
        return {name: min(max(value, 0.1 * first[name]), _MOST_OF.get(name, np.inf)) for name, value in values.items()}

    search: Any = cma.CMAEvolutionStrategy([0.0] * len(names), 0.3, {"seed": seed + 1, "verbose": -9, "maxiter": generations})
    for generation in range(generations):
        if progress:
            progress("all constants", generation / generations)
        tried: list[Doubles] = search.ask()
        found = [objective.of(constants(x), 3) for x in tried]
        costs = [cost + _PRIOR * float(np.sum(np.square(x))) for (cost, _, _), x in zip(found, tried)]
        search.tell(tried, costs)
        # each shot goes on from its best strike among the better half of the sets
        half = np.argsort(costs)[: len(costs) // 2]
        best = np.argmin([found[k][2] for k in half], axis=0)
        objective.strikes = np.array([found[half[k]][1][row] for row, k in enumerate(best)])
        # shots that are far off are searched anew
        if generation % _ANEW == _ANEW - 1:
            objective.constants.update(constants(search.mean))
            _, objective.strikes, now = objective.of({})
            far = np.flatnonzero(now > 0.3 * objective.most)
            if len(far):
                plays = objective.plays.some(objective.rows[far])
                plays.set(objective.constants)
                strikes, new = find(plays)
                better = new < now[far]
                objective.strikes[far[better]] = strikes[better]
    # the search may end where it is worse than where it began, with few generations or many missed events
    ends = ({**objective.constants, **first}, {**objective.constants, **constants(search.mean)})
    costs = [objective.anew(end) for end in ends]
    return ends[int(np.argmin(costs))]
