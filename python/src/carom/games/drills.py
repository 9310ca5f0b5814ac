"""Games for agents with the interface of `carom.potting.Potting`: scoring in three-cushion, and the
break of nine-ball.
"""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from carom import racks
from carom._rows import Seed, copied, listing
from carom.dtypes import Doubles, Records
from carom.games import plans
from carom.games._draws import Draws, Games
from carom.games.potting import Potting
from carom.games.rules import Game as RulesGame
from carom.layouts import Game

__all__ = ["Break", "ThreeCushion"]
__dir__ = listing(__name__)


class ThreeCushion(Potting):
    """Three-cushion: score as often as possible from a random layout of three balls.

    Actions, observations and options are those for `Potting` with two object balls. A stroke earns
    1 if the cue ball hits three cushions before it hits the second ball; earlier scores do not
    matter. The balls stay where they came to rest. A stroke in which a ball leaves the table earns
    nothing and is undone. `Strokes.potted` is 0. The game ends after the last stroke.
    """

    _game: ClassVar[RulesGame] = "threecushion"

    def __init__(self, strokes: int = 10, *, ball_set: Game = "billiard", **options: Any) -> None:
        super().__init__(2, strokes, ball_set=ball_set, **options)


class Break(Potting):
    """The break of nine-ball, one stroke. Each game draws a rack with mean gaps of 0.1 mm.

    An action has two numbers in addition to those for `Potting`: the position of the cue ball along
    the width and the length of the area behind the head string. A break earns the number of potted
    balls, minus 1 for a foul by the rules of nine-ball: the cue ball falls, a ball leaves the
    table, or no ball falls and fewer than four balls hit cushions. Options are as for `Potting`.
    """

    acts: ClassVar[int] = 6
    _game: ClassVar[RulesGame] = "nineball"
    _state: ClassVar[dict[str, Any] | None] = {"opening": True}

    def __init__(self, *, speeds: tuple[float, float] = (0.5, 10.5), **options: Any) -> None:
        super().__init__(9, 1, speeds=speeds, **options)

    def corners(self) -> tuple[Doubles, Doubles]:
        """The lower and the upper corner, m, of the rectangle in which the cue ball is placed."""
        low = np.full(2, self.radius + 1e-3)
        return low, np.array([self.table.width - low[0], self.table.length / 4.0])

    def deal(self, draws: Draws, games: Games) -> Records:
        layouts = super().deal(draws, games)
        for k, game in enumerate(games.tolist()):
            layouts["state"]["r"][k] = racks.nineball(self.table, seed=draws.key(game))["state"][
                "r"
            ]
        layouts["state"]["r"][..., 2] = self.radius
        return layouts

    def placed(self, balls: Records, actions: ArrayLike) -> Records:
        """The layouts, broadcast against the actions, with the cue balls placed by the actions."""
        values = np.asarray(actions, np.float64)
        low, high = self.corners()
        laid = copied(
            np.broadcast_to(
                balls, (*np.broadcast_shapes(balls.shape[:-1], values.shape[:-1]), balls.shape[-1])
            )
        )
        laid["state"]["r"][..., 0, :2] = (
            low + (high - low) * (np.clip(values[..., 4:], -1.0, 1.0) + 1.0) / 2.0
        )
        return laid

    def best(self, balls: Records, *, shots: int = 500, seed: Seed = 0) -> Doubles:
        """The planner's action, shape (6,), for winning nine-ball against a player with equal
        errors.
        """
        low, high = self.corners()
        found = plans.plan(
            self.table,
            balls,
            rules="nineball",
            opening=True,
            player=self.player(),
            shots=shots,
            seed=seed,
            best=1,
            in_hand=[low, high],
            threads=self.threads,
            level=True,
            cushion_model=self.cushion_model,
        )[0]
        cue, place = (
            found["cue"],
            np.clip(2.0 * (found["place"] - low) / (high - low) - 1.0, -1.0, 1.0),
        )
        return np.concatenate([self.actions(cue["phi"], cue["speed"], cue["a"], cue["b"]), place])
