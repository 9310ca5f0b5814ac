"""A game for agents: pot as many balls of a random layout as possible with a number of strokes.

`carom.gymnasium` has the environments. `carom.drills` contains other games with this interface, and
`carom.matches` games against an opponent.

This module does not need gymnasium. `Potting` implements the rules as functions of arrays over many
games. An agent that plans can use them to simulate a thousand strokes from its observation before
it chooses one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes, layouts, tables
from carom._carom import ffi, lib
from carom._rows import (
    Arrays,
    broadcast,
    in_chunks,
    listing,
    named,
    number,
    one_or_all,
    pointer,
    Seed,
    as_array,
    raw,
    repeated,
    several,
    unknown_name,
    whole,
)
from carom._shot_options import Options, ShotCushion, shot_options
from carom.dtypes import Doubles, Records
from carom.games import plans
from carom.games._draws import Draws, Games
from carom.games.rules import Game as RulesGame
from carom.games.rules import Made
from carom.layouts import Game, Table, of_record
from carom.results import Label, Shot
from carom.shots import simulate
from carom.status import CaromError

__all__ = ["Potting", "Strokes", "Turned"]
__dir__ = listing(__name__)

_STATIONARY, _POCKETED = (
    int(Label.STATIONARY),
    int(Label.POCKETED),
)  # with which NumPy compares in half the time
_STROKE = dtypes._record("carom_python_stroke")


@dataclass(frozen=True, repr=False)
class Strokes(Arrays):
    """Results of strokes; each is an array over the games."""

    # (..., balls + 1): The balls at rest after the stroke. A cue ball that was potted is still
    # down.
    layouts: Records
    rewards: Doubles  # (...): Number of potted balls, minus 1 for a foul; or the result of `reward` of the rules
    potted: NDArray[np.int64]  # (...): Number of potted balls, without the cue ball
    scratch: NDArray[np.bool_]  # (...): Whether the cue ball was potted
    foul: NDArray[np.int32]  # (...): As `carom.Foul`; 0 for none
    # (...): As `carom.Status`. If the shot failed or a ball left the table, the stroke is a foul, and
    # the balls return to their positions before it.
    status: NDArray[np.int8]
    time: Doubles  # (...): How long the balls moved, s
    cleared: NDArray[np.bool_]  # (...): Whether all balls but the cue ball are down


class Turned(NamedTuple):
    """The results of one stroke in each of some games, for the environments."""

    struck: Records  # (..., balls + 1): The layouts as they were struck
    cues: Records  # (...): The strikes, with the noise
    strokes: Strokes
    ended: NDArray[np.bool_]  # (...): Whether the game is over, even if strokes are left


def in_space(actions: ArrayLike, shape: tuple[int, ...], name: str) -> Doubles:
    """Check the actions of an environment: their shape, and values from -1 to 1."""
    array = as_array(actions, name, np.float64)
    if array.shape != shape:
        raise ValueError(f"{name}: the shape is {array.shape}, but must be {shape}")
    # policies return single precision, in which 1 may be exceeded slightly
    outside = ~(np.abs(array) <= 1.0 + 1e-6)
    if outside.any():
        where = tuple(int(k) for k in np.argwhere(outside)[0])
        raise ValueError(
            f"{name}: {array[where]:g}, at {list(where)}, is not from -1 to 1; "
            "use np.clip or gymnasium.wrappers.ClipAction"
        )
    return array


class Potting:
    """The rules: pot the balls of a random layout on a pool table with a number of strokes.

    An **action** is four numbers, which are clipped to -1 to 1. The first times 180 degrees is the
    direction, counterclockwise from +x. The second is the speed of the cue between its limits. The
    last two times 0.35 radii are the offsets of the tip to the left of and above the centre, which
    rules out a miscue. The cue is level and may pass through cushions and balls.

    An **observation** is 3 (balls + 1) + 1 numbers. For each ball, the cue ball first, it contains
    x (m), y (m) and 1, or three zeros if the ball is not in play; then the number of strokes left.
    It describes the game completely: `layouts()` reconstructs the balls with the same bits.

    The **reward** of a stroke is the number of balls that it pots, minus 1 for a foul. It is a foul
    if the cue ball falls (it is then replaced at random) or hits no ball; or if a ball leaves the
    table or the shot fails (both are undone). The game ends when no object ball is left, or after
    the last stroke.

    Parameters
    ----------
    balls, strokes : int
        Number of object balls, 1 to 15, and of strokes, at least 1.
    table : Table, optional
        A rectangular table with pockets and the bed 0 <= x <= width, 0 <= y <= length. Default:
        `carom.tables.snooker()` for snooker balls, otherwise `pool_9ft()`.
    ball_set : {"pool", "snooker", "billiard", "pooltool_pool", "pooltool_snooker",
        "pooltool_billiard"} The game whose balls are used, as for `carom.balls`.
    noise : tuple of three floats
        Errors of the agent: standard deviations of the direction (degrees), of the speed (m/s) and
        of the tip's position (radii, in each direction). The environments add them to every action;
        `play` does not.
    parameters : mapping of a field of `carom.dtypes.ball_kind` to two floats
        Bounds between which each game draws the field for all its balls, for example `{"mu_slide":
        (0.15, 0.25)}`. Agents do not observe the value.
    reward : callable, optional
        reward(balls, strokes) returns the rewards, of shape (...), for the layouts `balls` before
        the strokes and their results `strokes`.
    speeds : tuple of two floats
        The lowest and the highest speed of the cue, m/s.
    cushion_model, threads
        As for `carom.simulate_batch`.
    """

    acts: ClassVar[int] = 4
    """Number of elements of an action."""
    words: ClassVar[tuple[int, ...]] = ()
    """The initial state of a game in addition to its balls."""
    _game: ClassVar[RulesGame] = "potting"
    _state: ClassVar[dict[str, Any] | None] = None

    def __init__(
        self,
        balls: int = 5,
        strokes: int = 5,
        *,
        table: Table | None = None,
        ball_set: Game = "pool",
        noise: tuple[float, float, float] = (0.0, 0.0, 0.0),
        parameters: Mapping[str, tuple[float, float]] | None = None,
        reward: Callable[[Records, Strokes], ArrayLike] | None = None,
        speeds: tuple[float, float] = (0.5, 7.0),
        cushion_model: ShotCushion = "default",
        threads: int = 0,
    ) -> None:
        whole(balls, "balls", least=1, most=15)
        whole(strokes, "strokes", least=1)
        requirement = "two speeds: the lowest and the highest, m/s"
        speeds_given = [
            number(speed, "speeds", requirement) for speed in several(speeds, "speeds", requirement)
        ]
        if len(speeds_given) != 2 or not 0.0 < speeds_given[0] <= speeds_given[1] < np.inf:
            raise ValueError(
                f"speeds: {speeds} are not two positive and finite speeds, the lower one first"
            )
        requirement = "three standard deviations, in degrees, m/s and radii"
        deviations = [
            number(deviation, "noise", requirement)
            for deviation in several(noise, "noise", requirement)
        ]
        if len(deviations) != 3 or not all(0.0 <= deviation < np.inf for deviation in deviations):
            raise ValueError(
                f"noise: {noise} are not three standard deviations, in degrees, m/s and radii"
            )
        if reward is not None and not callable(reward):
            raise TypeError(
                f"reward: {reward!r} is not callable; pass a function of the layouts and the strokes"
            )
        ball_set = cast(Game, named(layouts.GAMES, ball_set, "ball_set"))
        pockets = self._game != "threecushion"
        usual = (
            tables.snooker
            if "snooker" in ball_set
            else tables.pool_9ft
            if pockets
            else tables.threecushion
        )
        self.table = usual() if table is None else table
        layouts.check_table(self.table)
        if (len(self.table.pockets) > 0) != pockets:
            raise ValueError(
                f"table: it has {'no ' if pockets else ''}pockets; this game needs a table {'with' if pockets else 'without'} them"
            )
        size, p, q = (
            np.array([self.table.width, self.table.length]),
            self.table.rails["p"],
            self.table.rails["q"],
        )
        for place in np.concatenate([p, q, (p + q) / 2.0]):
            if (place > 1e-6).all() and (place < size - 1e-6).all():
                raise ValueError(
                    f"table: there is a rail at x = {place[0]:.6g} m, y = {place[1]:.6g} m, inside the bed; rails must "
                    f"surround 0 <= x <= width = {size[0]:.6g} m, 0 <= y <= length = {size[1]:.6g} m"
                )
        self.balls = balls
        self.strokes = strokes
        self.speeds = speeds
        self.cushion_model: ShotCushion = cushion_model
        self.threads = threads
        self.reward = reward
        self.noise = noise
        ball = layouts.balls(np.zeros((1, 2)), game=ball_set, cushion_model=cushion_model)
        self._ball = ball.tobytes()
        self.radius = float(ball["kind"]["radius"][0])
        self._for_c()
        if not isinstance({} if parameters is None else parameters, Mapping):
            raise TypeError(
                f"parameters: {parameters!r} is not a mapping from fields to bounds, such as {{'mu_slide': (0.15, 0.25)}}"
            )
        self.parameters = dict({} if parameters is None else parameters)
        self._check_parameters()

    def _for_c(self) -> None:
        """The game for C, with the objects it points to."""
        self._rules = Made(self._game, self._state)
        record, of_c, cue, player = self._kept = (
            self.table.record,
            shot_options(Options(cushion_model=self.cushion_model), self.threads),
            layouts.cue(),
            self.player(),
        )
        self._c = ffi.new(
            "carom_python_game *",
            {
                "table": pointer("carom_table[]", record),
                "options": of_c,
                "rules": self._rules.c,
                "cue": pointer("carom_cue[]", cue)[0],
                "player": pointer("carom_player[]", player)[0],
                "balls": self.balls + 1,
            },
        )

    def __getstate__(self) -> dict[str, Any]:
        return {
            name: value
            for name, value in vars(self).items()
            if name not in ("_rules", "_kept", "_c")
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        self._for_c()

    def _check_parameters(self) -> None:
        known = [name for name in dtypes.ball_kind.names or () if name != "radius"]
        ends = repeated(self._ball, dtypes.shot_ball, (2,))
        ends["state"]["r"][:, :2] = 0.3 * self.table.width, 0.3 * self.table.length
        for name, bounds in self.parameters.items():
            if name not in known:
                raise ValueError(
                    unknown_name("parameters", "field", name, known, "help(carom.balls)")
                )
            if len(bounds) != 2 or not bounds[0] <= bounds[1]:
                raise ValueError(
                    f"parameters: {name}: {bounds} are not two bounds, the lower one first"
                )
            ends["kind"][name] = bounds
        for k in range(2):
            simulate(
                self.table, ends[k : k + 1]
            )  # raises CaromError if a bound is out of the field's range

    # ---- Actions and observations
    # ---------------------------------------------------------------------------------------

    def bounds(self) -> tuple[Doubles, Doubles]:
        """The lower and upper bounds of an observation.

        They extend beyond the cushions, because balls may rest in the mouth of a pocket.
        """
        beyond = 0.2
        low = np.append(np.tile([-beyond, -beyond, 0.0], self.balls + 1), 0.0)
        high = np.append(
            np.tile([self.table.width + beyond, self.table.length + beyond, 1.0], self.balls + 1),
            self.strokes,
        )
        return low, high

    def cues(self, actions: ArrayLike, seeds: NDArray[np.uint64] | None = None) -> Records:
        """Return the strikes of actions of shape (..., acts): `carom.dtypes.cue` of shape (...).

        With seeds, of shape (...), the noise is added, as in `carom.with_errors`.
        """
        values = np.ascontiguousarray(actions, dtype=np.float64)
        if values.shape[-1] == self.acts:
            cues: Records = np.empty(values.shape[:-1], dtypes.cue)
            drawn = ffi.NULL if seeds is None else pointer("uint64_t[]", seeds)
            if lib.carom_python_cues(
                self._c,
                cues.size,
                pointer("double[]", values),
                self.acts,
                drawn,
                pointer("carom_cue[]", cues),
            ):
                return cues
        raise ValueError(
            f"actions: {values}, of shape {values.shape}, are not finite numbers of shape (..., {self.acts})"
        )

    def actions(
        self,
        phi: ArrayLike,
        speed: ArrayLike,
        a: ArrayLike = 0.0,
        b: ArrayLike = 0.0,
    ) -> Doubles:
        """Return actions of shape (..., 4) for directions (degrees), speeds (m/s) and tip offsets
        (radii) of shape (...).
        """
        least, most = self.speeds
        if not all(np.isfinite(part).all() for part in (phi, speed, a, b)):
            raise ValueError(
                f"phi, speed, a, b: {phi!r}, {speed!r}, {a!r}, {b!r} are not all finite"
            )
        turn = (np.asarray(phi, dtype=np.float64) + 180.0) % 360.0 / 180.0 - 1.0
        hard = 2.0 * (np.asarray(speed, dtype=np.float64) - least) / max(most - least, 1e-12) - 1.0
        parts = np.broadcast_arrays(
            turn,
            hard,
            np.asarray(a, dtype=np.float64) / 0.35,
            np.asarray(b, dtype=np.float64) / 0.35,
        )
        return np.stack(parts, axis=-1)

    def observe(self, balls: Records, strokes_left: ArrayLike, words: object = None) -> Doubles:
        """Return the observations, shape (..., 3 (balls + 1) + 1), of layouts of shape (..., balls
        + 1).
        """
        layouts = np.ascontiguousarray(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
        count = layouts.shape[-1]
        seen = np.empty((*layouts.shape[:-1], 3 * count + 1))
        lib.carom_python_seen(
            pointer("carom_shot_ball[]", layouts),
            layouts.size // count,
            count,
            pointer("double[]", seen),
        )
        seen[..., -1] = strokes_left
        return seen

    def layouts(self, observations: ArrayLike) -> Records:
        """Return the balls of observations: `carom.dtypes.shot_ball` of shape (..., balls + 1)."""
        values = np.asarray(observations, dtype=np.float64)
        seen = values[..., :-1].reshape((*values.shape[:-1], self.balls + 1, 3))
        return self._balls(seen[..., :2], seen[..., 2] != 0.0)

    def _balls(self, centres: Doubles, in_play: NDArray[np.bool_]) -> Records:
        """Balls at rest; balls that are not in play are in a pocket."""
        records = repeated(self._ball, dtypes.shot_ball, centres.shape[:-1])
        records["state"]["r"][..., :2] = centres
        records["state"]["label"] = np.where(in_play, _STATIONARY, _POCKETED)
        return records

    def player(self) -> Records:
        """Return a player with the noise, speeds and tip limits of this game, for `carom.plan`."""
        record = plans.player(0.0)
        record["phi"], record["a"], record["b"] = self.noise[0], self.noise[2], self.noise[2]
        record["growth"] = 0.0
        # of a cue whose tip loses nothing
        record["speed"] = self.noise[1] * (1.0 + float(layouts.cue()["tip_restitution"])) / 2.0
        record["speed_least"], record["speed_most"], record["tip_most"] = *self.speeds, 0.35
        return record

    def best(self, balls: Records, *, shots: int = 500, seed: Seed = 0) -> Doubles:
        """Return the planner's action, shape (4,), for a layout of shape (balls + 1,), as a
        baseline.

        The plan simulates `shots` shots and maximises the fraction of balls potted in one visit.
        """
        found = plans.plan(
            self.table,
            balls,
            rules=self._game,
            player=self.player(),
            shots=shots,
            seed=seed,
            best=1,
            threads=self.threads,
            level=True,
            cushion_model=self.cushion_model,
        )["cue"][0]
        return self.actions(found["phi"], found["speed"], found["a"], found["b"])

    def best_seen(self, observation: ArrayLike, *, shots: int = 500, seed: Seed = 0) -> Doubles:
        """Return the planner's action, shape (acts,), for an observation."""
        return self.best(self.layouts(observation), shots=shots, seed=seed)

    def tried(self, observation: ArrayLike, actions: ArrayLike) -> Doubles:
        """Evaluate actions of shape (..., acts) by their next stroke, without noise.

        Returns shape (...); for this game, the rewards.
        """
        return self.play(self.layouts(observation), actions).rewards

    # ---- The game
    # -------------------------------------------------------------------------------------------------------

    def deal(self, draws: Draws, games: Games) -> Records:
        """Draw layouts for some games, of shape (len(games), balls + 1), with random parameters."""
        layouts = repeated(self._ball, dtypes.shot_ball, (len(games), self.balls + 1))
        self._place(layouts, draws, games, self.balls + 1)
        for name, (low, high) in self.parameters.items():
            layouts["kind"][name] = low + (high - low) * draws.uniform(games, 1)
        return layouts

    def layout(self, centres: ArrayLike) -> Records:
        """Make a layout of shape (balls + 1,) from centres (m) of shape (balls + 1, 2), and check
        it.
        """
        places = np.asarray(centres, dtype=np.float64)
        if places.shape != (self.balls + 1, 2):
            raise ValueError(
                f"layout: the shape is {places.shape}, but must be ({self.balls + 1}, 2), the cue ball first"
            )
        layout = self._balls(places, np.ones(self.balls + 1, np.bool_))
        simulate(
            self.table, layout
        )  # without a strike: raises CaromError where balls overlap or are not on the table
        return layout

    def put_back(self, balls: Records, draws: Draws, games: Games) -> None:
        """Replace the cue balls of some games at random, in layouts of shape (len(games), balls +
        1).
        """
        self._place(balls, draws, games, 1)

    def _place(self, balls: Records, draws: Draws, games: Games, many: int) -> None:
        """Draw positions for the first balls of layouts until they are clear of each other, of the
        table and of the other balls in play.
        """
        keys = draws.keys[games]
        if not lib.carom_python_place(
            self._c,
            len(games),
            pointer("uint64_t[]", keys),
            many,
            pointer("carom_shot_ball[]", balls),
        ):
            raise ValueError(
                f"table: no free positions for {many} balls in 10,000 draws; it is too small for {self.balls} balls"
            )
        draws.keys[games] = keys

    def free(self, balls: Records) -> bool:
        """Whether the cue ball is clear of the other balls in play, of pockets and of jaws."""
        return bool(lib.carom_python_free(self._c, pointer("carom_shot_ball[]", balls), 1))

    def placed(self, balls: Records, actions: ArrayLike) -> Records:
        """The layouts after placing balls by the actions; this game places none."""
        return balls

    def play(self, balls: Records, actions: ArrayLike) -> Strokes:
        """Play strokes.

        Parameters
        ----------
        balls : ndarray of `carom.dtypes.shot_ball`, shape (..., balls + 1)
        actions : array_like, shape (..., 4)
            Broadcast against the leading dimensions of the balls: many actions for one layout, or
            one action for each layout.

        Returns
        -------
        Strokes
            Arrays of the broadcast shape. Each stroke has the same bits as in a single call.
        """
        laid = of_record(balls, dtypes.shot_ball, "balls", "balls()")
        return self._played(self.placed(laid, actions), self.cues(actions))

    def _played(self, balls: Records, cues: Records) -> Strokes:
        """Play strikes from layouts, which are broadcast against each other."""
        shape = (
            cues.shape
            if balls.shape[:-1] == cues.shape
            else broadcast({"balls": balls.shape[:-1], "actions": cues.shape})
        )
        lead, count = len(shape), balls.shape[-1]
        if count != self.balls + 1:
            raise ValueError(
                f"balls: the shape is {balls.shape}, but must be (..., {self.balls + 1})"
            )
        previous, is_single = one_or_all(balls, (*shape, count), lead)
        strikes, one_cue = one_or_all(cues, shape, lead)
        outcomes, records = np.empty((*shape, count), dtypes.shot_ball), np.empty(shape, _STROKE)
        pointers = (
            pointer("carom_shot_ball[]", previous),
            0 if is_single else count,
            pointer("carom_cue[]", strikes),
            0 if one_cue else 1,
        )
        written = (
            pointer("carom_shot_ball[]", outcomes),
            pointer("carom_python_stroke[]", records),
        )
        code = in_chunks(
            records.size,
            5e-5,
            self.threads,
            lambda begin, many: int(
                lib.carom_python_strokes(self._c, begin, many, *pointers, *written)
            ),
        )
        if code < 0 and not (records["status"] < 0).any():
            raise CaromError(code, "table")
        strokes = Strokes(
            outcomes,
            records["reward"],
            records["potted"],
            records["scratch"],
            records["foul"],
            records["status"],
            records["time"],
            records["cleared"],
        )
        if self.reward is not None:
            seat_numbers = np.asarray(
                self.reward(np.broadcast_to(balls, outcomes.shape), strokes), dtype=np.float64
            )
            strokes = replace(strokes, rewards=np.broadcast_to(seat_numbers, shape).copy())
        return strokes

    def turn(
        self,
        balls: Records,
        words: NDArray[np.uint64],
        actions: ArrayLike,
        draws: Draws,
        games: Games,
    ) -> Turned:
        """Play one stroke with noise in each of some games, and replace cue balls that fell.

        `words` is modified.
        """
        struck, cues = (
            self.placed(balls, actions),
            self.cues(actions, draws.seeds(games) if any(self.noise) else None),
        )
        strokes = self._played(struck, cues)
        if np.count_nonzero(strokes.scratch):
            back = np.flatnonzero(strokes.scratch)
            layouts = raw(strokes.layouts)[back].view(dtypes.shot_ball)
            self.put_back(layouts, draws, games[back])
            raw(strokes.layouts)[back] = raw(layouts)
        return Turned(struck, cues, strokes, strokes.cleared)

    def shot(self, balls: Records, cue: Records | None) -> Shot:
        """One stroke with its events, for drawing; without a cue the balls stay at rest."""
        return simulate(self.table, balls, cue, cushion_model=self.cushion_model)
