"""Any game of two sides that `carom.Match` plays, in the form that `carom.gymnasium` plays: snooker,
four-ball, one-pocket and others, of an agent against an opponent.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes, layouts, tables
from carom._rows import choice, listing, named, whole
from carom._shot_options import Options
from carom.dtypes import Doubles, Records
from carom.games import match as matches
from carom.games._draws import Draws, Games
from carom.games.drills import ThreeCushion
from carom.games.plans import player, with_errors
from carom.games.potting import Potting, Strokes, Turned
from carom.games.rules import GAMES, Game
from carom.layouts import Table
from carom.results import EventType, Label, Shot
from carom.shots import simulate
from carom.status import CaromError

__all__ = ["TableGame"]
__dir__ = listing(__name__)

_ONE = np.zeros(1, np.int64)
_SIDES = 2
_TRIES = 10_000  # places of a cue ball in hand, before the search for a free one ends
_EXTRAS = 4  # numbers of an observation besides those of the balls and the strokes left
# The table and the balls of a game; those of other games are of pool.
_TABLES: dict[str, Callable[[], Table]] = {
    "snooker": tables.snooker,
    "fourball": tables.fourball,
    "threecushion": tables.threecushion,
    "straightrail": tables.threecushion,
    "blackball": tables.blackball,
    "heyball": tables.heyball,
    "pyramid": tables.pyramid,
    "billiards": tables.snooker,
}
_BALLS: dict[str, layouts.Game] = {
    "blackball": "blackball",
    "fourball": "fourball",
    "pyramid": "pyramid",
    "snooker": "snooker",
    "billiards": "snooker",
    "threecushion": "billiard",
    "straightrail": "billiard",
}


class TableGame:
    """A game of two sides by its rules, of which the agent is side 0 and begins; the library plays
    whenever it is the opponent's turn.

    An **action** is six numbers from -1 to 1: direction, speed and place of the tip, as in
    `carom.potting.Potting`, then where the cue ball is put, if it is in hand: along the width and
    the length of the rectangle around the permitted area. A place that is not free becomes a random
    one that is. The call of a stroke, where the game has one, is the ball and the pocket that the
    stroke would pot without noise, or else the ball that it would meet first. Of choices beside
    strokes, such as to pass after a foul, the agent takes none unless nothing else is left.

    An **observation** has, for each ball, x, y (m), whether it is in play, and whether it may be met
    first in the next stroke; then whether the cue ball is in hand, the index of the agent's cue
    ball, the agent's points, the opponent's points, and the number of strokes left.

    A step is one stroke of the agent and all strokes of the opponent until the agent plays again.
    The **reward** is 1 for a won game and -1 for a lost one, and otherwise 0; with reward="points"
    it is how many points more the agent has gained than the opponent in this step. The game also
    ends with the agent's last stroke.

    Parameters
    ----------
    rules : str
        The game, by its name in `carom.plan`: "snooker", "fourball", "onepocket", ...
    strokes : int
        Of the agent, at least 1.
    target : int, optional
        The points that win, where the game has them. Default: those of the game.
    reward : {"win", "points"}
    opponent : ndarray of `carom.dtypes.player`, shape (), optional
        Default: `carom.player(fargo=500)`.
    opponent_shots : int
        By how many shots the opponent plans, at least 100.
    table, noise, speeds, cushion_model
        As for `carom.potting.Potting`. Default: the table of the game.
    """

    acts: ClassVar[int] = 6

    def __init__(
        self,
        rules: Game = "snooker",
        strokes: int = 60,
        *,
        target: int | None = None,
        reward: Literal["win", "points"] = "win",
        opponent: Records | None = None,
        opponent_shots: int = 100,
        table: Table | None = None,
        speeds: tuple[float, float] = (0.5, 8.0),
        **base: Any,
    ) -> None:
        rules = cast("Game", named(GAMES, rules, "rules"))
        choice({"win": 0, "points": 1}, reward, "reward")
        self.game: Game = rules
        self.table = _TABLES.get(rules, tables.pool_9ft)() if table is None else table
        kind = Potting if len(self.table.pockets) else ThreeCushion
        balls = _BALLS.get(rules, "pool")
        self.base = kind(strokes=strokes, table=self.table, ball_set=balls, speeds=speeds, **base)
        self.strokes, self.noise, self.reward = self.base.strokes, self.base.noise, reward
        self.target = None if target is None else whole(target, "target", least=1)
        self.opponent = player(fargo=500) if opponent is None else opponent
        self.opponent_shots = whole(opponent_shots, "opponent_shots", least=100, most=1_000_000)
        self._options = Options(cushion_model=self.base.cushion_model)
        self._matches: dict[int, matches.Match] = {}
        first = self._begun(0)
        if len(first.standing.points) != _SIDES:
            raise ValueError(f"rules: {rules!r} is not a game of two sides")
        self.balls = len(first.balls) - 1
        self.words = tuple(self._words(first))

    def _begun(self, seed: int) -> matches.Match:
        state = None if self.target is None else {"target": self.target}
        return matches.Match(self.game, self.table, seed=seed, state=state, options=self._options)

    def _words(self, match: matches.Match) -> list[int]:
        """What an observation has besides places, as words of 64 bits, which environments keep."""
        own_points, rival_points = match.standing.points
        extras = [float(match.bounds is not None), match.cue_ball, own_points, rival_points]
        targets = [float(ball in match.on) for ball in range(len(match.balls))]
        words: list[int] = np.array([*extras, *targets], np.float64).view(np.uint64).tolist()
        return words

    # ---- What environments ask for

    def bounds(self) -> tuple[Doubles, Doubles]:
        """The least and the most of each number of an observation."""
        size = np.array([self.table.width, self.table.length, 1.0, 1.0])
        least = np.array([0.0, 0.0, 0.0, 0.0])
        points = np.array([1.0, float(self.balls), 1e6, 1e6])
        low = np.concatenate([np.tile(least, self.balls + 1), [0.0, 0.0, -1e6, -1e6], [0.0]])
        high = np.concatenate([np.tile(size, self.balls + 1), points, [float(self.strokes)]])
        return low, high

    def observe(
        self, balls: Records, strokes_left: ArrayLike, words: NDArray[np.uint64]
    ) -> Doubles:
        """What the agent sees of games, of shape (games, ...)."""
        count = len(balls)
        extras = words.copy().view(np.float64)
        state = balls["state"]
        seen = np.zeros((count, self.balls + 1, 4))
        in_play = ~np.isin(state["label"], (int(Label.POCKETED), int(Label.OFF)))
        places = state["r"][..., :2]
        inside = np.clip(places, 0.0, [self.table.width, self.table.length])
        seen[..., :2] = np.where(in_play[..., np.newaxis], inside, 0.0)
        seen[..., 2], seen[..., 3] = in_play, extras[:, _EXTRAS:]
        left = np.broadcast_to(np.asarray(strokes_left, np.float64), count)[:, np.newaxis]
        return np.concatenate([seen.reshape(count, -1), extras[:, :_EXTRAS], left], axis=1)

    def deal(self, draws: Draws, games: Games) -> Records:
        """The racks of some games, of shape (len(games), balls + 1)."""
        racks = []
        for game in games.tolist():
            self._matches[game] = self._begun(draws.key(game) % 2**31)
            racks.append(self._matches[game].balls)
        return np.stack(racks)

    def layout(self, centres: ArrayLike) -> Records:
        """Refuses layouts: a match begins with its first stroke."""
        raise ValueError("layout: a game begins with its first stroke, and takes no layout")

    def shot(self, balls: Records, cue: Records | None) -> Shot:
        """A stroke of the agent with its events, for looking at; without a cue the balls lie still."""
        return simulate(self.table, balls, cue, options=self._options)

    def turn(
        self,
        balls: Records,
        words: NDArray[np.uint64],
        actions: ArrayLike,
        draws: Draws,
        games: Games,
    ) -> Turned:
        """A stroke of the agent and the visit of the opponent, in each of some games.

        `words` is written to.
        """
        values = np.asarray(actions, np.float64)
        n = len(games)
        struck, outcome, cues = balls.copy(), balls.copy(), np.zeros(n, dtypes.cue)
        counts = {name: np.zeros(n, np.int64) for name in ("potted", "foul", "status")}
        rewards, time = np.zeros(n), np.zeros(n)
        scratch, ended = np.zeros(n, np.bool_), np.zeros(n, np.bool_)
        for k, game in enumerate(games.tolist()):
            match, drawn = self._matches[game], draws.single(game)
            points_before = match.standing.points
            self._stroke(match, values[k], drawn)
            ruling, last = match.ruling, match.shot
            assert ruling is not None and last is not None
            struck[k], cues[k] = last.balls, last.cue
            cue_ball = int(last.cue["ball"]) if last.cue is not None else 0
            counts["potted"][k] = sum(ball != cue_ball for ball in ruling.potted)
            counts["foul"][k], counts["status"][k] = int(ruling.foul), int(last.status)
            scratch[k] = last.final["label"][cue_ball] == Label.POCKETED
            time[k] = last.time
            self._visit(match, drawn)
            outcome[k], words[k] = match.balls, self._words(match)
            draws.keep(game, drawn)
            ended[k] = match.phase == "over"
            rewards[k] = self._reward(match, points_before)
        strokes = Strokes(
            outcome,
            rewards,
            counts["potted"],
            scratch,
            counts["foul"].astype(np.int32),
            counts["status"].astype(np.int8),
            time,
            np.zeros(n, np.bool_),
        )
        return Turned(struck, cues, strokes, ended)

    @staticmethod
    def _is_over(match: matches.Match) -> bool:
        return match.phase == "over"

    def _reward(self, match: matches.Match, points_before: tuple[int, ...]) -> float:
        if self.reward == "points":
            own_points, rival_points = match.standing.points
            return float((own_points - points_before[0]) - (rival_points - points_before[1]))
        if match.winner is None:
            return 0.0
        return 1.0 if match.winner == 0 else -1.0

    # ---- Strokes

    def _place(self, match: matches.Match, point: Doubles, draws: Draws) -> None:
        """Puts a cue ball in hand where it is wanted, two numbers from -1 to 1, or where that is not
        free, at random.
        """
        bounds = match.bounds
        if bounds is None:
            return
        low, high = np.array(bounds.low), np.array(bounds.high)
        part = (np.clip(point, -1.0, 1.0) + 1.0) / 2.0
        for _ in range(_TRIES):
            try:
                match.place(*(low + (high - low) * part).tolist())
            except CaromError:
                part = draws.uniform(_ONE, 2)[0]
            else:
                return
        raise RuntimeError("no free place was found for the cue ball in hand")

    def _stroke(self, match: matches.Match, action: Doubles, draws: Draws) -> None:
        """The agent's stroke: the place of the cue ball, the call, and the strike."""
        if match.phase == "place":
            self._place(match, action[4:], draws)
        if match.bounds is None and match.phase == "place":  # a choice is due
            match.choose(match.may[0])
            if match.side != 0 or self._is_over(match):
                return
            self._place(match, action[4:], draws)
        meant = self._cue(match, self.base.cues(action[:4]))
        self._call(match, meant)
        noisy = self.base.cues(action[:4], draws.seeds(_ONE) if any(self.noise) else None)
        match.stroke(self._cue(match, noisy))

    def _cue(self, match: matches.Match, strike: Records) -> Records:
        """The cue of the seat with a strike."""
        cue = match.cue
        for name in ("speed", "phi", "a", "b", "theta"):
            cue[name] = strike[name]
        return cue

    def _call(self, match: matches.Match, meant: Records) -> None:
        """Calls what the stroke would pot without noise, or the ball that it would meet first."""
        targets = match.on
        try:
            shot = simulate(self.table, match.balls, meant, options=self._options)
        except CaromError as failed:
            if failed.shot is None:
                return
            shot = failed.shot
        cue_ball = match.cue_ball
        pots = shot.events[shot.events["type"] == int(EventType.POCKET)]
        hits = shot.first("ball_ball", ball=cue_ball)
        calls = [(int(pot["a"]), int(pot["b"])) for pot in pots if int(pot["a"]) in targets]
        if hits.index >= 0:
            calls.append((int(hits.other), -1))
        for ball, pocket in calls:
            try:
                match.call(ball, pocket)
            except CaromError:  # this game, or this stroke, has no such call
                continue
            return

    def _visit(self, match: matches.Match, draws: Draws) -> None:
        """The opponent's strokes, until the agent plays again or the game has ended."""
        while match.phase != "over" and match.side == 1:
            key = draws.key(0)
            best = match.plan(
                player=self.opponent, shots=self.opponent_shots, seed=key % 2**31, best=1
            )[0]
            match.take(best, with_errors(best["cue"], self.opponent, key))
