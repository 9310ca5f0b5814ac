"""Nine-ball for two players: the rules, over whole shots. `carom.pettingzoo` is the environment for agents.

    rules = NineBall()
    position = rules.begin(seed=1)
    position, stroke = rules.play(position, [0.5, 0.9, 0, 0.2, 0, 0])

The rules are those of the World Pool-Billiard Association (wpapool.com, 2016, sections 2 and 6), with the following left out: there is no
push out and no lag, player 0 breaks; a ball that is frozen to a cushion at first counts as driven to it; and a stroke that drives a ball
off the table is a foul that is taken back, where the rules would take the ball down.
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
from carom.results import EventType, Label, Shot
from carom.shots import simulate
from carom.status import CaromError

__dir__ = listing(__name__)

_ONE = np.zeros(1, np.int64)
_FOULS_MOST = 3
_DRIVEN_LEAST = 4  # balls to a cushion, by a break that pots none


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
        parameters: Mapping[str, tuple[float, float]] | None = None, speeds: tuple[float, float] = (0.5, 9.0),
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
            self.table, position.balls, rules="nineball", opening=position.hand is Hand.BEHIND, player=self.base.player(),
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
        self._lay(balls, 0, low + (high - low) * part)

    def _lay(self, balls: dtypes.Records, ball: int, place: dtypes.Doubles) -> None:
        state = balls["state"][ball]
        state["r"][:2], state["r"][2], state["v"], state["w"] = place, self.base.radius, 0.0, 0.0
        balls["state"]["label"][ball] = Label.STATIONARY

    def _spot_nine(self, balls: dtypes.Records) -> None:
        """Puts the nine on the foot spot, or as near to it as is free on the line behind it, otherwise before it."""
        others = balls["state"][:9]
        taken = others["r"][others["label"] != Label.POCKETED, :2]
        foot, end = 0.75 * self.table.length, self.table.length - self.base.radius - 1e-3
        for y in (*np.arange(foot, end, 1e-3), *np.arange(foot, 0.0, -1e-3)):
            place = np.array([self.table.width / 2.0, y])
            if self.base.free(place[np.newaxis], taken):
                return self._lay(balls, 9, place)
        raise ValueError("table: no free place for the nine on the long string")

    # ---- Strokes --------------------------------------------------------------------------------------------------------

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
        done = self.base.disturbed(given[np.newaxis, :4], draws, _ONE)[0]
        failed = ""
        try:
            shot = simulate(self.table, balls, self.base.cues(done), cushion_model=self.base.cushion_model)
        except CaromError as error:
            if error.shot is None:
                raise
            shot, failed = error.shot, f"the stroke ended in an error: {error.shot.status.text}"
        if not failed and (shot.final["label"] == Label.OFF).any():
            failed = "a ball left the table"
        turn = self._judge(position, balls, shot, failed)
        return self._after(position, balls, turn, failed, draws), turn

    def _judge(self, position: Position, balls: dtypes.Records, shot: Shot, failed: str) -> Turn:
        events = shot.events
        types, a, b = events["type"], events["a"], events["b"]
        lowest = 1 + int(np.argmax(balls["state"]["label"][1:] != Label.POCKETED))
        touches = np.flatnonzero((types == EventType.BALL_BALL) & ((a == 0) | (b == 0)))
        first = int(a[touches[0]] + b[touches[0]]) if len(touches) else None
        down = a[types == EventType.POCKET].tolist()
        potted = tuple(ball for ball in down if ball != 0)
        driven = (types == EventType.RAIL) | (types == EventType.JAW)
        foul = ""
        if failed:
            foul = failed
        elif 0 in down:
            foul = "the cue ball was potted"
        elif first is None:
            foul = "the cue ball touched no ball"
        elif first != lowest:
            foul = f"ball {first} was touched first, not {lowest}"
        elif not potted and not driven[touches[0] :].any():
            foul = "no ball was potted, and none was driven to a cushion after the contact"
        elif position.hand is Hand.BEHIND and not potted and len(set(a[driven].tolist()) - {0}) < _DRIVEN_LEAST:
            foul = f"the break potted no ball, and drove fewer than {_DRIVEN_LEAST} to a cushion"
        return Turn(foul, first, potted, shot)

    def _after(self, position: Position, before: dtypes.Records, turn: Turn, failed: str, draws: Draws) -> Position:
        balls, player, other = before.copy(), position.player, 1 - position.player
        if not failed:
            balls["state"] = turn.shot.final
        count = position.fouls[player] + 1 if turn.foul else 0
        fouls = (count, position.fouls[1]) if player == 0 else (position.fouls[0], count)
        after = replace(position, balls=balls, fouls=fouls, strokes=position.strokes + 1, hand=Hand.NOWHERE, draws=draws)
        if turn.foul:
            if 9 in turn.potted and not failed:
                self._spot_nine(balls)
            lost = count >= _FOULS_MOST
            return replace(after, player=other, hand=Hand.ANYWHERE, winner=other if lost else None)
        if 9 in turn.potted:
            return replace(after, winner=player)
        return after if turn.potted else replace(after, player=other)

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
