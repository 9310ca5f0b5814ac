"""Nine-ball for two players: the rules, over whole shots. `carom.pettingzoo` is the environment for agents.

    rules = NineBall()
    position = rules.begin(seed=1)
    position, stroke = rules.play(position, [0.5, 0.9, 0, 0.2, 0, 0])

The rules are those of `carom.referee`, the World Pool-Billiard Association's (wpapool.com, 2016, sections 2 and 6), with the following left
out: there is no push out and no lag, player 0 breaks; and a ball that is frozen to a cushion at first counts as driven to it.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from carom import dtypes, racks
from carom._draws import Draws
from carom._rows import Arrays, listing
from carom._shot_options import ShotCushion
from carom.layouts import Table
from carom.plans import plan
from carom.potting import Potting
from carom.results import Label, Shot
from carom.rules import State, referee

__dir__ = listing(__name__)

_ONE = np.zeros(1, np.int64)
_FOULS_MOST = 3


class Hand(enum.IntEnum):
    """Where the player may put the cue ball."""

    NOWHERE = 0
    BEHIND = 1
    """Behind the head string, for the break."""
    ANYWHERE = 2


@dataclass(frozen=True, repr=False)
class Position(Arrays):
    """A game between two strokes."""

    balls: dtypes.Records  # (10,): The cue ball, then 1 to 9
    player: int  # Whose turn it is, 0 or 1
    hand: Hand  # Whether that player has the cue ball in hand
    fouls: tuple[int, int]  # Of each player, in consecutive strokes of that player; three lose the game
    strokes: int  # Played until now
    winner: int | None
    draws: Draws  # The random numbers of the game: noise, and places that a player chose but that were not free


@dataclass(frozen=True)
class Turn:
    """What a stroke was."""

    foul: str  # Why it was a foul; empty for a legal stroke
    first: int | None  # The ball that the cue ball touched first
    potted: tuple[int, ...]  # Without the cue ball, in their order
    shot: Shot


class NineBall:
    """The rules.

    An **action** is six numbers from -1 to 1: direction, speed and place of the tip as in `carom.potting.Potting`, then where the cue ball
    is put, if it is in hand: along the width and the length of the table, or of the part behind the head string. A place that is
    not free becomes a random one that is.

    Parameters
    ----------
    table, noise, parameters, speeds, cushion_model
        As for `Potting`. The balls are those of pool.
    """

    def __init__(
        self, *, table: Table | None = None, noise: tuple[float, float, float] = (0.0, 0.0, 0.0),
        parameters: Mapping[str, tuple[float, float]] | None = None, speeds: tuple[float, float] = (0.5, 10.5),
        cushion_model: ShotCushion = "default"
    ) -> None:  # fmt: skip
        self.base = Potting(9, 1, table=table, noise=noise, parameters=parameters, speeds=speeds, cushion_model=cushion_model)
        self.table = self.base.table

    def begin(self, seed: int) -> Position:
        """The position before the break: the rack drawn from a seed, the cue ball in hand behind the head string."""
        draws = Draws([seed])
        rack = racks.nineball(self.table, seed=seed)
        balls = self.base.deal(draws, _ONE)[0]
        balls["state"]["r"] = rack["state"]["r"]
        balls["state"]["r"][:, 2] = self.base.radius
        return Position(balls, 0, Hand.BEHIND, (0, 0), 0, None, draws)

    # ---- The cue ball in hand -------------------------------------------------------------------------------------------

    def _area(self, hand: Hand) -> tuple[dtypes.Doubles, dtypes.Doubles]:
        low = np.full(2, self.base.radius + 1e-3)
        length = self.table.length / 4.0 if hand is Hand.BEHIND else self.table.length - low[1]
        return low, np.array([self.table.width - low[0], length])

    def best(self, position: Position, *, opponent: dtypes.Records | None = None, shots: int = 500, seed: int = 0) -> dtypes.Doubles:
        """The action, of shape (6,), of the library's planner: a baseline and an opponent for agents. It allows for the noise.

        `opponent` is a `carom.player()`; by default he errs as the noise says. The plan has so many `shots`.
        """
        low, high = self._area(position.hand)
        found = plan(
            self.table, position.balls, rules="nineball", state=self.state(position), player=self.base.player(),
            opponent=opponent, shots=shots, seed=seed, in_hand=[low, high] if position.hand else False, best=1,
            cushion_model=self.base.cushion_model,
        )[0]  # fmt: skip
        cue = found["cue"]
        place = np.clip(2.0 * (found["place"] - low) / (high - low) - 1.0, -1.0, 1.0)
        return np.concatenate([self.base.actions(cue["phi"], cue["speed"], cue["a"], cue["b"]), place])

    def _put(self, balls: dtypes.Records, hand: Hand, wanted: dtypes.Doubles, draws: Draws) -> None:
        """Puts the cue ball where it is wanted, numbers from -1 to 1, or where that is not free, at random."""
        others = balls["state"][1:]
        taken = others["r"][others["label"] != Label.POCKETED, :2]
        low, high = self._area(hand)
        part = (np.clip(wanted, -1.0, 1.0) + 1.0) / 2.0
        while not self.base.free((low + (high - low) * part)[np.newaxis], taken):
            part = draws.uniform(_ONE, 2)[0]
        state = balls["state"][0]
        state["r"][:2], state["r"][2], state["v"], state["w"] = low + (high - low) * part, self.base.radius, 0.0, 0.0
        balls["state"]["label"][0] = Label.STATIONARY

    # ---- Strokes --------------------------------------------------------------------------------------------------------

    def state(self, position: Position) -> State:
        """The state of the rules, for `carom.plan` and `carom.referee`."""
        own, other = position.fouls[position.player], position.fouls[1 - position.player]
        return np.array([0, position.hand is Hand.BEHIND, own, other, 0, 0, 0, 0], np.uint64)

    def play(self, position: Position, action: npt.ArrayLike) -> tuple[Position, Turn]:
        """Play a stroke: the position after it, and what it was."""
        given = np.asarray(action, dtype=np.float64)
        if given.shape != (6,) or not np.isfinite(given).all():
            raise ValueError(f"action: six finite numbers are needed, not {given}")
        if position.winner is not None:
            raise ValueError("position: the game has ended")
        balls, draws = position.balls.copy(), position.draws.copy()
        if position.hand:
            self._put(balls, position.hand, given[4:], draws)
        done = self.base.cues(self.base.disturbed(given[np.newaxis, :4], draws, _ONE)[0])
        ruled = referee(self.table, balls, done, rules="nineball", state=self.state(position), cushion_model=self.base.cushion_model)

        # Balls that left the table are out of play as those that were potted.
        ruled.balls["state"]["label"][ruled.balls["state"]["label"] == Label.OFF] = Label.POCKETED
        keeps = ruled.turn in ("keep", "win")
        player = position.player if keeps else 1 - position.player
        fouls = (int(ruled.state[2]), int(ruled.state[3]))
        after = replace(
            position, balls=ruled.balls, player=player, hand=Hand.ANYWHERE if ruled.hand != "no" else Hand.NOWHERE,
            fouls=fouls if player == 0 else fouls[::-1], strokes=position.strokes + 1,
            winner=player if ruled.turn in ("win", "lose") else None, draws=draws,
        )  # fmt: skip
        failed = f"the stroke ended in an error: {ruled.shot.status.text}" if ruled.shot.status < 0 else ""
        potted = tuple(ball for ball in ruled.potted if ball != 0)
        return after, Turn(failed or ruled.foul.text, ruled.first if ruled.first >= 0 else None, potted, ruled.shot)

    # ---- Observations ---------------------------------------------------------------------------------------------------

    def observe(self, position: Position, player: int) -> dtypes.Doubles:
        """What a player sees, 33 numbers: x, y (m) and 1 in play of each ball, the cue ball first; the hand; own fouls, the other's."""
        fouls = (position.fouls[player], position.fouls[1 - player])
        seen = self.base.observe(position.balls, 0.0)[:-1]
        return np.concatenate([seen, np.array([position.hand, *fouls], dtype=np.float64)])

    def bounds(self) -> tuple[dtypes.Doubles, dtypes.Doubles]:
        """The least and the most of each number of an observation."""
        low, high = self.base.bounds()
        most = [float(Hand.ANYWHERE), float(_FOULS_MOST), float(_FOULS_MOST)]
        return np.concatenate([low[:-1], np.zeros(3)]), np.concatenate([high[:-1], np.array(most)])
