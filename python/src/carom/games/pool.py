"""Eight-ball and nine-ball for two players: the rules as functions of positions and strokes.

`carom.pettingzoo` and `carom.gymnasium` are the environments for agents.

    rules = Pool("nineball")
    position = rules.begin(seed=1)
    position, stroke = rules.play(position, [0.5, 0.9, 0, 0.2, 0, 0])

`carom.referee` judges by the rules of the World Pool-Billiard Association (wpapool.com, 2016,
sections 2, 3 and 6), except that there is no push out and no lag, and player 0 breaks. In
eight-ball the call of a stroke is the first legal ball that it would pot without noise, and the
pocket.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, cast

import numpy as np
from numpy.typing import ArrayLike

from carom import racks
from carom._rows import Array, Arrays, Seed, listing, named, seed_of
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
"""Smallest number of shots of a plan."""
_GAMES = {"nineball": 9, "eightball": 15}
_WORTH = np.array(
    [0.5, 0.0, 1.0, -1.0]
)  # value of a stroke that keeps the turn, passes it, wins, loses
_LOSE = 3


class Hand(enum.IntEnum):
    """Where the player may place the cue ball."""

    NOWHERE = 0
    BEHIND = 1
    """Behind the head string, for the break, and after a foul on the break of eight-ball."""
    ANYWHERE = 2


@dataclass(frozen=True, repr=False)
class Position(Arrays):
    """A game between two strokes."""

    balls: Records  # (10,) or (16,): The cue ball, then 1 to 9 or 1 to 15
    player: int  # The player at the table, 0 or 1
    hand: Hand  # Whether that player has the cue ball in hand
    state: State  # (): State of the rules for this player, for `carom.plan` and `carom.referee`
    strokes: int  # Number of strokes played
    winner: int | None
    # The random stream of the game, for noise and for replacing occupied positions of the cue ball
    draws: Draws

    @property
    def fouls(self) -> tuple[int, int]:
        """Consecutive fouls of player 0 and player 1 in nine-ball; three lose the game."""
        personal, rival = self.state["fouls"].tolist()
        return (personal, rival) if self.player == 0 else (rival, personal)


@dataclass(frozen=True)
class Stroke:
    """The result of a stroke."""

    foul: str  # Reason of the foul; "" for a legal stroke
    code: int  # The foul as a `carom.Foul`
    first: int | None  # First ball that the cue ball hit
    potted: tuple[int, ...]  # In order, without the cue ball
    shot: Shot


class Pool:
    """The rules of a game.

    An **action** is six numbers from -1 to 1: direction, speed and tip (two numbers) as in
    `carom.potting.Potting`, then the position of a cue ball in hand along the width and the length
    of the table, or of the area behind the head string. An occupied position is replaced by a
    random free one.

    Parameters
    ----------
    game : {"nineball", "eightball"}
    table, noise, parameters, speeds, cushion_model
        As for `Potting`. The balls are pool balls.
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
        self.game = cast(Literal["nineball", "eightball"], named(_GAMES, game, "game"))
        self.base = Potting(
            _GAMES[self.game],
            1,
            table=table,
            noise=noise,
            parameters=parameters,
            speeds=speeds,
            cushion_model=cushion_model,
        )
        self.table = self.base.table

    def begin(self, seed: Seed) -> Position:
        """Return the position before the break: a random rack, the cue ball in hand behind the head
        string.
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
        """The lower and the upper corner, m, of the rectangle in which a cue ball in hand is
        placed.
        """
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
        """Return the planner's action, shape (6,): a baseline and an opponent for agents.

        The plan allows for the noise and simulates `shots` shots. `opponent` is a `carom.player()`;
        by default a player with the same noise.
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
        """The best choice of `carom.plan` with a level cue, shape ()."""
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
        """Choose a stroke by simulating `shots` shots, without errors.

        Returns the layout with the placed cue ball, the cue and the call. With PLANNED or more
        shots `carom.plan` chooses; with fewer it is the best of as many strokes straight at balls
        (`carom.games._quick`).
        """
        if shots < PLANNED:
            return quick_stroke(self, position, shots)
        found = self.planned(position, player, opponent, shots, seed)
        laid: Array = position.balls.copy()
        if position.hand:
            self.lay(laid, found["place"])
        return laid, found["cue"], (int(found["ball"]), int(found["pocket"]))

    def on(self, position: Position) -> tuple[int, ...]:
        """The balls that the cue ball may hit first."""
        return on_of(Made(self.game, position.state), position.balls)

    def put(self, balls: Records, hand: Hand, point: ArrayLike, draws: Draws) -> None:
        """Place the cue ball at two coordinates from -1 to 1, or at random if that position is
        occupied.
        """
        low, high = self.area(hand)
        part = (np.clip(point, -1.0, 1.0) + 1.0) / 2.0
        self.lay(balls, low + (high - low) * part)
        while not self.base.free(balls):
            self.lay(balls, low + (high - low) * draws.uniform(_ONE, 2)[0])

    def lay(self, balls: Records, place: ArrayLike) -> None:
        """Place the cue balls of layouts (..., balls) at rest at positions (..., 2), m."""
        state = balls["state"]
        state["r"][..., 0, :2], state["r"][..., 0, 2] = place, self.base.radius
        state["v"][..., 0, :], state["w"][..., 0, :] = 0.0, 0.0
        state["label"][..., 0] = Label.STATIONARY

    # ---- Strokes
    # --------------------------------------------------------------------------------------------------------

    def play(self, position: Position, action: ArrayLike) -> tuple[Position, Stroke]:
        """Play a stroke; returns the position after it and its result."""
        values = np.asarray(action, dtype=np.float64)
        if values.shape != (6,) or not np.isfinite(values).all():
            raise ValueError(f"action: {values} are not six finite numbers")
        if position.winner is not None:
            raise ValueError("position: the game has ended; call begin() for a new one")
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
        """Play a cue without noise; returns the position after it and its result.

        The cue ball must have been placed on the table.
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
        """The shots of cues from layouts, with features."""
        return simulate_batch(
            self.table, layouts, cues, features=True, cushion_model=self.base.cushion_model
        )

    def tried(self, position: Position, actions: ArrayLike) -> Doubles:
        """Evaluate actions of shape (n, 6) without noise.

        Returns shape (n,): 1 for a win, 0.5 for keeping the turn, 0 for passing it, -0.5 for a
        foul, -1 for a loss.
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
        """The values of strokes, as in `tried`, from their `carom.dtypes.turn`."""
        foul = (turns["foul"] != 0) & (turns["outcome"] != _LOSE)
        return np.where(foul, -0.5, _WORTH[turns["outcome"]])

    # ---- Observations
    # ---------------------------------------------------------------------------------------------------

    def observe(self, position: Position, player: int) -> Doubles:
        """Return a player's observation: 33 numbers in nine-ball, 51 in eight-ball.

        For each ball, the cue ball first: x, y (m), and 1 if it is in play. Then the hand; in
        nine-ball the player's and the other's fouls; in eight-ball 1 before the break, and the
        player's group: 0 open, 1 solids, 2 stripes.
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
        """The position of an observation of the player at the table, who becomes player 0."""
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
        """The lower and upper bounds of an observation."""
        low, high = self.base.bounds()
        most = [2.0, 3.0, 3.0] if self.game == "nineball" else [2.0, 1.0, 2.0]
        return np.concatenate([low[:-1], np.zeros(3)]), np.concatenate([high[:-1], np.array(most)])
