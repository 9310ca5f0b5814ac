"""Games of pool of an agent against an opponent, for `carom.gymnasium`."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes
from carom._rows import Seed, listing, whole
from carom.dtypes import Doubles, Records
from carom.games._draws import Draws, Games
from carom.games.plans import player, with_errors
from carom.games.pool import Hand, Pool, Position
from carom.games.potting import Strokes, Turned
from carom.games.rules import Made, State
from carom.results import Label, Shot

__all__ = ["Match"]
__dir__ = listing(__name__)


def _words(state: State) -> list[int]:
    """A state as 64-bit integers, which environments keep in an array."""
    words: list[int] = state.reshape(1).view(np.uint64).tolist()
    return words


def _state(words: NDArray[np.uint64]) -> State:
    return words[:-1].copy().view(dtypes.rules_state).reshape(())


class Match:
    """A game of nine-ball or eight-ball: the agent breaks, and the library plays for the opponent.

    **Actions** are six numbers, as for `carom.pool.Pool`. An **observation** is `Pool.observe` and
    the number of strokes left; it describes the game completely. A step is one stroke of the agent
    and all strokes of the opponent until the agent plays again. The **reward** is 1 for a won game,
    -1 for a lost one, and otherwise 0. The game also ends after the agent's last stroke.

    Parameters
    ----------
    game : {"nineball", "eightball"}
    strokes : int
        Largest number of strokes of the agent, at least 1.
    opponent : ndarray of `carom.dtypes.player`, shape (), optional
        The opponent's errors. Default: `carom.player(fargo=500)`.
    opponent_shots : int
        Number of shots that the opponent simulates per stroke. Below 100 it plays the best of this
        many strokes straight at balls, which takes a millisecond. With 100 or more it uses
        `carom.plan`, which takes 10 to 30 milliseconds with 300 shots.
    **rules
        As for `Pool`: the table, and the noise of the agent.
    """

    acts: ClassVar[int] = 6
    words: ClassVar[tuple[int, ...]] = (
        *_words(Made("nineball", None, opening=True).state),
        int(Hand.BEHIND),
    )

    def __init__(
        self,
        game: Literal["nineball", "eightball"] = "nineball",
        strokes: int = 60,
        *,
        opponent: Records | None = None,
        opponent_shots: int = 12,
        **rules: Any,
    ) -> None:
        if "threads" in rules:
            raise TypeError(
                "threads: matches are played sequentially; omit threads, or use "
                'gymnasium.make_vec(id, games, vectorization_mode="async") for processes'
            )
        self.pool = Pool(game, **rules)
        self.strokes = whole(strokes, "strokes", least=1)
        self.opponent = player(fargo=500) if opponent is None else opponent
        self.opponent_shots = whole(opponent_shots, "opponent_shots", least=1, most=1_000_000)
        self.balls, self.table, self.noise = (
            self.pool.base.balls,
            self.pool.table,
            self.pool.base.noise,
        )
        self._agent = self.pool.base.player()

    def bounds(self) -> tuple[Doubles, Doubles]:
        """The lower and upper bounds of an observation."""
        low, high = self.pool.bounds()
        return np.append(low, 0.0), np.append(high, self.strokes)

    def observe(
        self, balls: Records, strokes_left: ArrayLike, words: NDArray[np.uint64]
    ) -> Doubles:
        """The agent's observations of games, of shape (games, ...)."""
        left = np.broadcast_to(np.asarray(strokes_left, np.float64), len(balls))
        none = Draws([0])
        return np.stack(
            [
                np.append(
                    self.pool.observe(
                        Position(
                            layout,
                            0,
                            Hand(int(state_words[-1])),
                            _state(state_words),
                            0,
                            None,
                            none,
                        ),
                        0,
                    ),
                    group_left,
                )
                for layout, state_words, group_left in zip(balls, words, left, strict=True)
            ]
        )

    def deal(self, draws: Draws, games: Games) -> Records:
        """The racks of some games, of shape (len(games), balls + 1)."""
        return np.stack([self.pool.begin(draws.key(game)).balls for game in games.tolist()])

    def layout(self, centres: ArrayLike) -> Records:
        """Raise ValueError: a match begins with the break, not with a layout."""
        raise ValueError("layout: a match begins with the break; omit layout")

    def turn(
        self,
        balls: Records,
        words: NDArray[np.uint64],
        actions: ArrayLike,
        draws: Draws,
        games: Games,
    ) -> Turned:
        """Play a stroke of the agent and the visit of the opponent in each of some games.

        `words` is modified.
        """
        values = np.asarray(actions, np.float64)
        n = len(games)
        struck, outcome, cues = balls.copy(), balls.copy(), np.zeros(n, dtypes.cue)
        strokes = Strokes(
            outcome,
            np.zeros(n),
            np.zeros(n, np.int64),
            np.zeros(n, np.bool_),
            np.zeros(n, np.int32),
            np.zeros(n, np.int8),
            np.zeros(n),
            np.zeros(n, np.bool_),
        )
        ended = np.zeros(n, np.bool_)
        for k, game in enumerate(games.tolist()):
            start = Position(
                balls[k], 0, Hand(int(words[k, -1])), _state(words[k]), 0, None, draws.single(game)
            )
            position, turn = self.pool.play(start, values[k])
            struck[k], cues[k] = turn.shot.balls, turn.shot.cue
            strokes.potted[k], strokes.scratch[k], strokes.foul[k] = (
                len(turn.potted),
                turn.shot.final["label"][0] == Label.POCKETED,
                turn.code,
            )
            strokes.status[k], strokes.time[k] = int(turn.shot.status), turn.shot.time
            position = self._visit(position)
            outcome[k], words[k] = position.balls, [*_words(position.state), int(position.hand)]
            draws.keep(game, position.draws)
            ended[k] = position.winner is not None
            strokes.rewards[k] = {None: 0.0, 0: 1.0}.get(position.winner, -1.0)
        return Turned(struck, cues, strokes, ended)

    def _visit(self, position: Position) -> Position:
        """The position when the agent plays again, or the game has ended."""
        while position.player == 1 and position.winner is None:
            key = position.draws.key(0)
            laid, cue, call = self.pool.stroke_of(
                position, self.opponent, self._agent, self.opponent_shots, key % 2**31
            )
            stroke = with_errors(cue, self.opponent, key)
            position, _ = self.pool.struck(replace(position, balls=laid), stroke, call)
        return position

    def shot(self, balls: Records, cue: Records | None) -> Shot:
        """A stroke of the agent with its events, for drawing; without a cue the balls stay at rest."""
        return self.pool.base.shot(balls, cue)

    def best_seen(self, observation: ArrayLike, *, shots: int = 500, seed: Seed = 0) -> Doubles:
        """The planner's action, shape (6,), for an observation."""
        return self.pool.best(
            self.seen(observation), opponent=self.opponent, shots=shots, seed=seed
        )

    def seen(self, observation: ArrayLike) -> Position:
        """The position of an observation."""
        return self.pool.seen(np.asarray(observation, np.float64)[:-1])

    def tried(self, observation: ArrayLike, actions: ArrayLike) -> Doubles:
        """The values of actions of shape (n, 6), judged by their stroke only, as for `Pool.tried`."""
        return self.pool.tried(self.seen(observation), actions)
