"""Constants from whole shots: those that single events do not tell, searched one after another.

For given constants each shot's strike descends a few steps from where it was, by `_strikes.descend`. The cost of the constants is the
sum over shots of the shots' costs, each at most a bound, so that shots whose events are missed do not decide. The first seconds come
first: later samples follow from earlier events, and small errors of the constants have grown there beyond what a descent brings back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from carom._strikes import Plays, descend
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

    def of(self, given: Mapping[str, float]) -> tuple[float, Doubles]:
        """The cost of some constants, the others as they are, and the strikes, (rows, 6)."""
        self.plays.set({**self.constants, **given})
        until = np.minimum(self.until, self.plays.ends[self.rows])
        strikes, costs = descend(self.plays, self.rows, self.strikes, until, _ITERATIONS)
        return float(np.minimum(costs, self.most).sum()), strikes


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
        value, (_, strikes) = (left, at_left) if at_left[0] < at_right[0] else (right, at_right)
        objective.constants[name], objective.strikes = value, strikes
    return objective.constants
