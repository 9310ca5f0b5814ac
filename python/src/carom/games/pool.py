"""Eight-ball and nine-ball for two players: the rules, over whole shots.

`carom.pettingzoo` and `carom.gymnasium` are environments for agents.

    rules = Pool("nineball")
    position = rules.begin(seed=1)
    position, stroke = rules.play(position, [0.5, 0.9, 0, 0.2, 0, 0])

The rules are those of `carom.referee`, the World Pool-Billiard Association's (wpapool.com, 2016,
sections 2, 3 and 6), with the following left out: there is no push out and no lag, and player 0
breaks. In eight-ball the call of a stroke is the ball and the pocket that it would pot without
noise: the first ball that the player may pot.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from carom import racks
from carom._rows import Array, Arrays, Seed, choice, listing, seed_of
from carom._shot_options import ShotCushion
from carom.dtypes import Doubles, Records
from carom.games._draws import Draws
from carom.games._quick import quick_stroke
from carom.games.plans import plan
from carom.games.potting import Potting
from carom.games.rules import Made, State, calls_of, judge, on_of, referee
from carom.layouts import Table
from carom.results import Label, Shot, Shots
from carom.shots import simulate_batch

__all__ = ["Hand", "Pool", "Position", "Stroke"]
__dir__ = listing(__name__)

_ONE = np.zeros(1, np.int64)
PLANNED = 100
"""The least number of shots of a plan."""
_GAMES = {"nineball": 9, "eightball": 15}
_WORTH = np.array(
    [0.5, 0.0, 1.0, -1.0]
)  # of a stroke that keeps the turn, passes it, wins and loses
_LOSE = 3


class Hand(enum.IntEnum):
    """Where the player may put the cue ball."""

    NOWHERE = 0
    BEHIND = 1
    """Behind the head string, for the break, and after a foul on the break of eight-ball."""
    ANYWHERE = 2


@dataclass(frozen=True, repr=False)
class Position(Arrays):
    """A game between two strokes."""

    balls: Records  # (10,) or (16,): The cue ball, then 1 to 9 or 1 to 15
    player: int  # Whose turn it is, 0 or 1
    hand: Hand  # Whether that player has the cue ball in hand
    state: State  # (): Of the rules, as that player has it, for `carom.plan` and `carom.referee`
    strokes: int  # Played until now
    winner: int | None
    # The random numbers of the game: noise, and places that a player chose but that were not free
    draws: Draws

    @property
    def fouls(self) -> tuple[int, int]:
        """Of player 0 and of player 1 in nine-ball, in consecutive strokes of that player; three
        lose the game.
        """
        personal, rival = self.state["fouls"].tolist()
        return (personal, rival) if self.player == 0 else (rival, personal)


@dataclass(frozen=True)
class Stroke:
    """What a stroke was."""

    foul: str  # Why it was a foul; empty for a legal stroke
    code: int  # The same as a `carom.Foul`
    first: int | None  # The ball that the cue ball touched first
    potted: tuple[int, ...]  # Without the cue ball, in their order
    shot: Shot


class Pool:
    """The rules of a game.

    An **action** is six numbers from -1 to 1: direction, speed and place of the tip as in
    `carom.potting.Potting`, then where the cue ball is put, if it is in hand: along the width and
    the length of the table, or of the part behind the head string. A place that is not free becomes
    a random one that is.

    Parameters
    ----------
    game : {"nineball", "eightball"}
    table, noise, parameters, speeds, cushion_model
        As for `Potting`. The balls are those of pool.
    """

    def __init__(
        self,
        game: Literal["nineball", "eightball"] = "nineball",
        *,
        table: Table | None = None,
        noise: tuple[float, float, float] = (0.0, 0.0, 0.0),
        parameters: Mapping[str, tuple[float, float]] | None = None,
        speeds: tuple[float, float] = (0.5, 10.5),
        cushion_model: ShotCushion = "default",
    ) -> None:
        choice(_GAMES, game, "game")
        self.game = game
        self.base = Potting(
            _GAMES[game],
            1,
            table=table,
            noise=noise,
            parameters=parameters,
            speeds=speeds,
            cushion_model=cushion_model,
        )
        self.table = self.base.table

    def begin(self, seed: Seed) -> Position:
        """The position before the break: the rack drawn from a seed, the cue ball in hand behind
        the head string.
        """
        seed = seed_of(seed, 2**64 - 1)
        draws = Draws([seed])
        rack = getattr(racks, self.game)(self.table, seed=seed)
        balls = self.base.deal(draws, _ONE)[0]
        balls["state"]["r"] = rack["state"]["r"]
        balls["state"]["r"][:, 2] = self.base.radius
        return Position(
            balls, 0, Hand.BEHIND, Made(self.game, None, opening=True).state, 0, None, draws
        )

    # ---- The cue ball in hand
    # -------------------------------------------------------------------------------------------

    def area(self, hand: Hand) -> tuple[Doubles, Doubles]:
        """The lower and the upper corner, m, of the rectangle in which a cue ball in hand is put."""
        low = np.full(2, self.base.radius + 1e-3)
        length = self.table.length / 4.0 if hand is Hand.BEHIND else self.table.length - low[1]
        return low, np.array([self.table.width - low[0], length])

    def best(
        self,
        position: Position,
        *,
        opponent: Records | None = None,
        shots: int = 500,
        seed: Seed = 0,
    ) -> Doubles:
        """The action, of shape (6,), of the library's planner: a baseline and an opponent for
        agents. It allows for the noise.

        `opponent` is a `carom.player()`; by default he errs as the noise says. The plan has so many
        `shots`.
        """
        low, high = self.area(position.hand)
        found = self.planned(position, self.base.player(), opponent, shots, seed, level=True)
        cue = found["cue"]
        place = np.clip(2.0 * (found["place"] - low) / (high - low) - 1.0, -1.0, 1.0)
        return np.concatenate(
            [self.base.actions(cue["phi"], cue["speed"], cue["a"], cue["b"]), place]
        )

    def planned(
        self,
        position: Position,
        player: Records,
        opponent: Records | None,
        shots: int,
        seed: Seed,
        level: bool = False,
    ) -> Records:
        """The best choice of `carom.plan`, of shape (), for a player; actions are strokes of a
        level cue.
        """
        found: Array = plan(
            self.table,
            position.balls,
            rules=self.game,
            state=position.state,
            player=player,
            opponent=opponent,
            shots=shots,
            seed=seed,
            in_hand=[*self.area(position.hand)] if position.hand else "no",
            best=1,
            level=level,
            cushion_model=self.base.cushion_model,
        )[0]
        return found

    def stroke_of(
        self,
        position: Position,
        player: Records,
        opponent: Records | None,
        shots: int,
        seed: int,
    ) -> tuple[Records, Records, tuple[int, int]]:
        """The stroke of a player who thinks for so many shots, without errors: the layout, in which
        he has put a cue ball in hand, the cue and the call.

        From PLANNED shots on it is that of `carom.plan`; with fewer it is the best of so many
        strokes straight at balls (`carom.games._quick`).
        """
        if shots < PLANNED:
            return quick_stroke(self, position, shots)
        found = self.planned(position, player, opponent, shots, seed)
        laid: Array = position.balls.copy()
        if position.hand:
            self.lay(laid, found["place"])
        return laid, found["cue"], (int(found["ball"]), int(found["pocket"]))

    def on(self, position: Position) -> tuple[int, ...]:
        """The balls that the player may meet first."""
        return on_of(Made(self.game, position.state), position.balls)

    def put(self, balls: Records, hand: Hand, point: ArrayLike, draws: Draws) -> None:
        """Put the cue ball of a layout where it is wanted, two numbers from -1 to 1, or where that
        is not free, at random.
        """
        low, high = self.area(hand)
        part = (np.clip(point, -1.0, 1.0) + 1.0) / 2.0
        self.lay(balls, low + (high - low) * part)
        while not self.base.free(balls):
            self.lay(balls, low + (high - low) * draws.uniform(_ONE, 2)[0])

    def lay(self, balls: Records, place: ArrayLike) -> None:
        """Lay the cue ball of layouts (..., balls) to places (..., 2), m, at rest."""
        state = balls["state"]
        state["r"][..., 0, :2], state["r"][..., 0, 2] = place, self.base.radius
        state["v"][..., 0, :], state["w"][..., 0, :] = 0.0, 0.0
        state["label"][..., 0] = Label.STATIONARY

    # ---- Strokes
    # --------------------------------------------------------------------------------------------------------

    def play(self, position: Position, action: ArrayLike) -> tuple[Position, Stroke]:
        """Play a stroke: the position after it, and what it was."""
        values = np.asarray(action, dtype=np.float64)
        if values.shape != (6,) or not np.isfinite(values).all():
            raise ValueError(f"action: six finite numbers are needed, not {values}")
        if position.winner is not None:
            raise ValueError("position: the game has ended")
        balls, draws = position.balls.copy(), position.draws.copy()
        if position.hand:
            self.put(balls, position.hand, values[4:], draws)
        call = (-1, -1)
        if self.game == "eightball":
            meant = self.played(balls[np.newaxis], self.base.cues(values[np.newaxis, :4]))
            call = tuple(calls_of(Made(self.game, position.state), balls, meant)[0].tolist())
        done = self.base.cues(values[:4], draws.seeds(_ONE) if any(self.base.noise) else None)
        return self.struck(replace(position, balls=balls, draws=draws), done, call)

    def struck(
        self, position: Position, cue: Records, call: tuple[int, int] = (-1, -1)
    ) -> tuple[Position, Stroke]:
        """The position after a stroke of a cue, without noise, and what it was; the cue ball has
        been put on the table.
        """
        ruled = referee(
            self.table,
            position.balls,
            cue,
            rules=self.game,
            state=position.state,
            call=call,
            cushion_model=self.base.cushion_model,
        )

        # Balls that left the table are out of play as those that were potted; nobody pushes out.
        ruled.balls["state"]["label"][ruled.balls["state"]["label"] == Label.OFF] = Label.POCKETED
        ruled.state["may"] = 0
        keeps = ruled.turn in ("keep", "win")
        player = position.player if keeps else 1 - position.player
        outcome = replace(
            position,
            balls=ruled.balls,
            player=player,
            hand={"no": Hand.NOWHERE, "kitchen": Hand.BEHIND, "anywhere": Hand.ANYWHERE}[
                ruled.hand
            ],
            state=ruled.state,
            strokes=position.strokes + 1,
            winner=player if ruled.turn in ("win", "lose") else None,
        )
        failed = (
            f"the stroke ended in an error: {ruled.shot.status.text}"
            if ruled.shot.status < 0
            else ""
        )
        potted = tuple(ball for ball in ruled.potted if ball != 0)
        return outcome, Stroke(
            failed or ruled.foul.text,
            int(ruled.foul),
            ruled.first if ruled.first >= 0 else None,
            potted,
            ruled.shot,
        )

    def played(self, layouts: Records, cues: Records) -> Shots:
        """Strokes of cues from layouts, with features."""
        return simulate_batch(
            self.table, layouts, cues, features=True, cushion_model=self.base.cushion_model
        )

    def tried(self, position: Position, actions: ArrayLike) -> Doubles:
        """What actions of shape (n, 6) give without noise, of shape (n,): 1 for a win, 0.5 where
        the player goes on, 0 where the other plays, -0.5 for a foul, -1 for a loss.
        """
        values = np.asarray(actions, dtype=np.float64)
        layouts = np.repeat(position.balls[np.newaxis], len(values), axis=0)
        if position.hand:
            draws = position.draws.copy()
            for layout, point in zip(layouts, values[:, 4:]):
                self.put(layout, position.hand, point, draws)
        game = Made(self.game, position.state)
        shots = self.played(layouts, self.base.cues(values[:, :4]))
        turns = judge(
            game,
            layouts,
            shots,
            calls=calls_of(game, position.balls, shots) if self.game == "eightball" else None,
        )
        return self.worth(turns)

    @staticmethod
    def worth(turns: Array) -> Doubles:
        """What strokes are worth to the player, as `tried` has it, by `carom.dtypes.turn`."""
        foul = (turns["foul"] != 0) & (turns["outcome"] != _LOSE)
        return np.where(foul, -0.5, _WORTH[turns["outcome"]])

    # ---- Observations
    # ---------------------------------------------------------------------------------------------------

    def observe(self, position: Position, player: int) -> Doubles:
        """What a player sees: x, y (m) and 1 in play of each ball, the cue ball first, 30 or 48
        numbers; then three more.

        They are the hand, and in nine-ball fouls of his and of the other; in eight-ball 1 before
        the break, and the group: 0 open, 1 he has the solids, 2 the stripes.
        """
        seen = self.base.observe(position.balls, 0.0)[:-1]
        if self.game == "nineball":
            return np.concatenate(
                [
                    seen,
                    np.array(
                        [position.hand, position.fouls[player], position.fouls[1 - player]],
                        np.float64,
                    ),
                ]
            )
        group = int(position.state["group"])
        group_code = group if player == position.player or group == 0 else 3 - group
        return np.concatenate(
            [seen, np.array([position.hand, position.state["opening"], group_code], np.float64)]
        )

    def seen(self, observation: ArrayLike) -> Position:
        """The position, with player 0 at the table, of an observation of the player at the table."""
        values = np.asarray(observation, np.float64)
        hand, second, third = (int(number) for number in values[-3:])
        given_state = (
            {"opening": hand == Hand.BEHIND, "fouls": (second, third)}
            if self.game == "nineball"
            else {"opening": second, "group": third}
        )
        state = Made(self.game, given_state).state
        return Position(
            self.base.layouts(np.append(values[:-3], 0.0)),
            0,
            Hand(hand),
            state,
            0,
            None,
            Draws([0]),
        )

    def bounds(self) -> tuple[Doubles, Doubles]:
        """The least and the most of each number of an observation."""
        low, high = self.base.bounds()
        most = [2.0, 3.0, 3.0] if self.game == "nineball" else [2.0, 1.0, 2.0]
        return np.concatenate([low[:-1], np.zeros(3)]), np.concatenate([high[:-1], np.array(most)])
