"""Games for agents as environments of gymnasium: one game, and many at once.

    import gymnasium
    import carom.gymnasium

    game = gymnasium.make("carom/RunOutSix-v1", render_mode="svg")
    games = gymnasium.make_vec("carom/Potting-v1", num_envs=64, cushion_model="han", threads=-1)

`GAMES` lists the ids. For an id with a version, results for a given action and seed change only
with `carom.physics_revision()`; other rules have another version.

The classes in `RULES` define actions, observations, rewards and the end of a game. Both
environments accept their arguments, and `rules` is the object. Game k of many games with seed s has
the same bits as a single game with seed s + k. Needs gymnasium 1.1 or later.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes, pictures
from carom._rows import choice, listing, raw, unknown_name, unknown_value
from carom.dtypes import Doubles, Records
from carom.games._draws import Draws, Games
from carom.games.drills import Break, ThreeCushion
from carom.games.matches import Match
from carom.games.potting import Potting, Strokes, in_space
from carom.games.table_games import TableGame

try:
    import gymnasium
    from gymnasium import spaces
    from gymnasium.utils import seeding
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space
except ImportError as missing:
    message = "carom.gymnasium needs gymnasium 1.1 or later, which is not installed: pip install gymnasium"
    raise ImportError(message, name=missing.name) from missing

__all__ = ["GAMES", "RULES", "GameEnv", "GameVectorEnv"]
__dir__ = listing(__name__)

RenderMode = Literal["svg", "rgb_array"]
Rules = Potting | Match | TableGame
RULES: dict[str, Callable[..., Rules]] = {
    "potting": Potting,
    "threecushion": ThreeCushion,
    "break": Break,
    "nineball": functools.partial(Match, "nineball"),
    "eightball": functools.partial(Match, "eightball"),
    "match": TableGame,
}
"""The rules of an environment by the name `game`: classes, and `Match` for both games of pool. The
name "match" stands for any game of two sides: GameEnv("match", rules="snooker").
"""
_OPTIONS = {"layout", "strokes"}
_Bools = NDArray[np.bool_]
_ONE: Games = np.zeros(1, np.int64)


class _Games:
    """The state of games, for both environments. Each game has a separate random stream."""

    def __init__(self, rules: Rules, games: int, render_mode: str | None) -> None:
        pictures.check_render_mode(render_mode)
        self.rules = rules
        self.balls: Records = np.zeros((games, rules.balls + 1), dtypes.shot_ball)
        self.words: NDArray[np.uint64] = np.tile(np.array(rules.words, np.uint64), (games, 1))
        self.left: NDArray[np.int64] = np.zeros(games, np.int64)
        self.ended: _Bools = np.ones(games, np.bool_)
        self.begun = False
        self.draws = Draws(np.random.SeedSequence().generate_state(games, np.uint64))
        # The last stroke, for rendering.
        self.render_mode = render_mode
        self.drawn = render_mode is not None
        self.previous = self.balls.copy()
        self.cues: Records = np.zeros(games, dtypes.cue)
        self.struck: _Bools = np.zeros(games, np.bool_)

    def begin(
        self, games: Games, layouts: Sequence[Any] | None = None, strokes: int | None = None
    ) -> None:
        """Begin some games, at random or with given centres, in their random streams."""
        if strokes is not None and not 1 <= strokes <= self.rules.strokes:
            raise ValueError(
                f"strokes: {strokes} is not 1 to {self.rules.strokes}, the number of the environment"
            )
        chosen_layouts = (
            None if layouts is None else np.stack([self.rules.layout(layout) for layout in layouts])
        )
        dealt = self.rules.deal(self.draws, games)
        if chosen_layouts is not None:
            dealt["state"] = chosen_layouts["state"]
        raw(self.balls)[games] = raw(dealt)
        self.words[games] = self.rules.words
        self.left[games] = self.rules.strokes if strokes is None else strokes
        self.ended[games] = False
        self.begun = True
        if self.drawn:
            raw(self.previous)[games] = raw(dealt)
        self.struck[games] = False

    def play(self, games: Games, actions: Doubles) -> Strokes:
        """Play one stroke in each of some games."""
        # Where all games play, nothing is copied but by the stroke itself.
        everyone = len(games) == len(self.balls)
        rows: Any = slice(None) if everyone else games
        previous = self.balls if everyone else raw(self.balls)[games].view(dtypes.shot_ball)
        words = self.words[rows]
        struck, cues, strokes, ended = self.rules.turn(previous, words, actions, self.draws, games)
        self.left[rows] -= 1
        self.ended[rows] = ended | (self.left[rows] <= 0)
        self.words[rows] = words
        if self.drawn:
            raw(self.previous)[rows] = raw(struck)
            self.cues[rows], self.struck[rows] = cues, True
        if everyone:
            self.balls = strokes.layouts
        else:
            raw(self.balls)[games] = raw(strokes.layouts)
        return strokes

    def observe(self) -> Doubles:
        return self.rules.observe(self.balls, self.left, self.words)

    def render(self, game: int) -> Any:
        """Draw one game: its balls and the paths of its last stroke."""
        if self.render_mode is None:
            return None
        return pictures.rendered(
            self.rules.shot(self.previous[game], self.cues[game] if self.struck[game] else None),
            self.render_mode,
        )


def _spaces(rules: Rules) -> tuple[Any, Any]:
    """The spaces of observations and actions of one game.

    Actions are in single precision, which libraries of policies expect.
    """
    low, high = rules.bounds()
    return spaces.Box(low, high, dtype=np.float64), spaces.Box(
        -1.0, 1.0, (rules.acts,), dtype=np.float32
    )


def _rules(game: str, rules: dict[str, Any]) -> Rules:
    return choice(RULES, game, "game")(**rules)


def _checked(options: dict[str, Any] | None) -> dict[str, Any]:
    """The options of a reset; raises ValueError for an unknown one."""
    settings = {} if options is None else options
    if not settings.keys() <= _OPTIONS:
        raise ValueError(
            unknown_name("options", "option", min(settings.keys() - _OPTIONS), sorted(_OPTIONS))
        )
    return settings


class GameEnv(gymnasium.Env[Doubles, Doubles]):
    """One game.

    `game` is a name in `RULES`, and **rules are the arguments of that class.

    `render` draws the last stroke, from the initial positions (faint) to the final ones. It returns
    SVG with `render_mode="svg"`, and an image of shape (height, width, 3) with "rgb_array", which
    `gymnasium.wrappers.RecordVideo` can record. After a stroke `info` contains potted (int),
    scratch (bool), foul (int, a `carom.Foul`), status (int, a `carom.Status`) and time (s).

    `reset` accepts the options layout, centres (m) of shape (balls + 1, 2), the cue ball first (not
    for matches), and strokes, at most the number of the environment. There is no truncation,
    because the observation contains the number of strokes left.
    """

    metadata: dict[str, Any] = {"render_modes": list(pictures.RENDER_MODES), "render_fps": 1}

    def __init__(
        self, game: str = "potting", *, render_mode: RenderMode | None = None, **rules: Any
    ) -> None:
        self.rules = _rules(game, rules)
        self.render_mode = render_mode
        self.observation_space, self.action_space = _spaces(self.rules)
        self._games = _Games(self.rules, 1, render_mode)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Doubles, dict[str, Any]]:
        """Begin a game with a layout drawn from the seed, or from the current random stream."""
        super().reset(seed=seed)
        settings = _checked(options)
        layout = settings.get("layout")
        if seed is not None:
            self._games.draws.begin(_ONE, int(self.np_random.integers(2**63)))
        self._games.begin(_ONE, None if layout is None else [layout], settings.get("strokes"))
        return self._games.observe()[0], {}

    def step(self, action: ArrayLike) -> tuple[Doubles, float, bool, bool, dict[str, Any]]:
        """Play a stroke; returns observation, reward, terminated, truncated, info."""
        if self._games.ended[0]:
            raise gymnasium.error.ResetNeeded("the game has not begun or has ended; call reset()")
        values = in_space(action, (self.rules.acts,), "action")
        strokes = self._games.play(_ONE, values[np.newaxis])
        info = {
            "potted": int(strokes.potted[0]),
            "scratch": bool(strokes.scratch[0]),
            "foul": int(strokes.foul[0]),
            "status": int(strokes.status[0]),
        }
        info["time"] = float(strokes.time[0])  # type: ignore[assignment]
        return (
            self._games.observe()[0],
            float(strokes.rewards[0]),
            bool(self._games.ended[0]),
            False,
            info,
        )

    def render(self) -> Any:
        """Draw the last stroke in the form of `render_mode`."""
        return self._games.render(0)


class GameVectorEnv(VectorEnv[Doubles, Doubles, NDArray[Any]]):
    """Many games. All strokes of a step are one `carom.simulate_batch`; matches are played
    sequentially.

    The arguments are the number of games and then those for `GameEnv`. `threads` plays the strokes
    of a step in parallel, and `render` returns a tuple of images. Seeds are as for gymnasium's
    SyncVectorEnv: s stands for s, s + 1, ...; a list contains one seed per game. Options of `reset`
    are as for `GameEnv`; layout may have shape (num_envs, balls + 1, 2), and reset_mask, bool of
    shape (num_envs,), selects the games to restart. `infos` contains arrays, and masks of valid
    entries under "_" + name.

    `autoreset_mode` defines how a game that has ended is restarted, as in gymnasium 1.1 and later.
    "NextStep": the next step restarts it and ignores its action. "SameStep": the step that ends it
    restarts it, and `infos` contains "final_obs" and "final_info". "Disabled": the caller restarts
    it with reset(options={"reset_mask": ended}) before the next step.
    """

    metadata: dict[str, Any] = {
        "render_modes": list(pictures.RENDER_MODES),
        "render_fps": 1,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs: int = 1,
        game: str = "potting",
        *,
        render_mode: RenderMode | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        **rules: Any,
    ) -> None:
        if num_envs < 1:
            raise ValueError(f"num_envs: {num_envs} is not at least 1")
        modes = {mode.value: mode for mode in AutoresetMode}
        if autoreset_mode not in (*modes, *modes.values()):
            raise ValueError(unknown_value("autoreset_mode", autoreset_mode, modes))
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {**self.metadata, "autoreset_mode": self.autoreset_mode}
        self.rules = _rules(game, rules)
        self.num_envs = num_envs
        self.render_mode = render_mode
        observed, acted = _spaces(self.rules)
        self.single_observation_space, self.single_action_space = observed, acted
        self.observation_space, self.action_space = (
            batch_space(observed, num_envs),
            batch_space(acted, num_envs),
        )
        self._games = _Games(self.rules, num_envs, render_mode)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Doubles, dict[str, Any]]:
        """Restart all games, or the ones in the mask."""
        seeds = [None] * self.num_envs if seed is None else seed
        if isinstance(seeds, int):
            seeds = [seeds + k for k in range(self.num_envs)]
        if len(seeds) != self.num_envs:
            raise ValueError(
                f"seed: there are {len(seeds)} seeds for {self.num_envs} games; pass one integer, or one per game"
            )
        settings = dict({} if options is None else options)
        chosen = np.flatnonzero(self._mask(settings.pop("reset_mask", None)))
        settings = _checked(settings)
        layouts: list[Any] | None = None
        if settings.get("layout") is not None:
            centres = np.asarray(settings["layout"], dtype=np.float64)
            layouts = list(centres) if centres.ndim == 3 else [centres] * self.num_envs
            if len(layouts) != self.num_envs:
                raise ValueError(
                    f"layout: there are {len(layouts)} layouts for {self.num_envs} games; pass one, or one per game"
                )
            layouts = [layouts[game] for game in chosen]
        for game in chosen:
            if (game_seed := seeds[int(game)]) is not None:
                key = int(seeding.np_random(game_seed)[0].integers(2**63))
                self._games.draws.begin(np.array([game]), key)
        self._games.begin(chosen, layouts, settings.get("strokes"))
        return self._games.observe(), {}

    def _mask(self, mask: Any) -> NDArray[np.bool_]:
        """Which games a reset begins anew."""
        if mask is None:
            return np.ones(self.num_envs, np.bool_)
        flags: NDArray[Any] = np.asarray(mask)
        if flags.dtype != np.bool_ or flags.shape != (self.num_envs,) or not flags.any():
            raise ValueError(
                f"options: reset_mask: the array has dtype {flags.dtype} and shape {flags.shape}, "
                f"but must be bool of shape ({self.num_envs},) with at least one True"
            )
        if not (self._games.begun or flags.all()):
            raise gymnasium.error.ResetNeeded(
                "no game has begun; the first reset() must be without reset_mask"
            )
        return flags

    def step(
        self, actions: ArrayLike
    ) -> tuple[Doubles, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Play a stroke in each game, or restart it.

        Returns observations (num_envs, ...); rewards, terminated, truncated (num_envs,); and infos.
        """
        values = in_space(actions, (self.num_envs, self.rules.acts), "actions")
        if not self._games.begun:
            raise gymnasium.error.ResetNeeded(
                "no game has begun; call reset() before the first step()"
            )
        playing = ~self._games.ended
        if not playing.all():
            over = np.flatnonzero(~playing)
            if self.autoreset_mode is AutoresetMode.DISABLED:
                raise gymnasium.error.ResetNeeded(
                    f"games {over.tolist()} have ended; call reset(options={{'reset_mask': ended}}) to restart them"
                )
            self._games.begin(over)
        rewards = np.zeros(self.num_envs)
        infos: dict[str, Any] = {}
        if playing.any():
            strokes = self._games.play(np.flatnonzero(playing), values[playing])
            rewards[playing] = strokes.rewards
            infos = self._infos(strokes, playing)
        ended = self._games.ended.copy()
        if ended.any() and self.autoreset_mode is AutoresetMode.SAME_STEP:
            infos = self._begun_at_once(infos, ended)
        return self._games.observe(), rewards, ended, np.zeros(self.num_envs, np.bool_), infos

    def _infos(self, strokes: Strokes, playing: NDArray[np.bool_]) -> dict[str, Any]:
        """The infos of the strokes of some games."""
        details: dict[str, NDArray[Any]] = {
            "potted": strokes.potted,
            "scratch": strokes.scratch,
            "foul": strokes.foul.astype(np.int64),
            "status": strokes.status.astype(np.int64),
            "time": strokes.time,
        }
        infos: dict[str, Any] = {}
        for name, values in details.items():
            infos[name] = np.zeros(self.num_envs, values.dtype)
            infos[name][playing] = values
            infos["_" + name] = playing.copy()
        return infos

    def _begun_at_once(self, infos: dict[str, Any], ended: NDArray[np.bool_]) -> dict[str, Any]:
        """Restart the games that have ended, and store their final observations and infos."""
        last, final = self._games.observe(), dict[str, Any]()
        final_obs = np.full(self.num_envs, None, dtype=object)
        for game in np.flatnonzero(ended):
            final_obs[game] = last[game]
        for name in [name for name in infos if name[0] != "_"]:
            values, mask = infos[name], infos["_" + name]
            final[name] = np.where(ended, values, np.zeros_like(values))
            final["_" + name] = mask & ended
            values[ended], mask[ended] = 0, False
        self._games.begin(np.flatnonzero(ended))
        whose = {"_final_obs": ended.copy(), "_final_info": ended.copy()}
        return {**infos, "final_obs": final_obs, "final_info": final, **whose}

    def render(self) -> tuple[Any, ...] | None:
        """Draw all games in the form of `render_mode`."""
        if self.render_mode is None:
            return None
        return tuple(self._games.render(game) for game in range(self.num_envs))


_ERRORS = (0.2, 0.2, 0.006)  # degrees, m/s and radii: the errors of carom.player(2) at 2 m/s
GAMES: dict[str, dict[str, Any]] = {
    "carom/Potting-v1": {},
    "carom/PotOne-v1": {"balls": 1, "strokes": 1, "noise": _ERRORS},
    "carom/RunOutSix-v1": {"balls": 6, "strokes": 6, "noise": _ERRORS},
    "carom/ThreeCushion-v1": {"game": "threecushion", "strokes": 10, "noise": _ERRORS},
    "carom/Break-v1": {"game": "break", "noise": _ERRORS},
    "carom/NineBall-v1": {"game": "nineball", "strokes": 60, "noise": _ERRORS},
    "carom/EightBall-v1": {"game": "eightball", "strokes": 60, "noise": _ERRORS},
    "carom/Snooker-v1": {"game": "match", "rules": "snooker", "strokes": 200, "noise": _ERRORS},
    "carom/FourBall-v1": {"game": "match", "rules": "fourball", "strokes": 200, "noise": _ERRORS},
    "carom/OnePocket-v1": {"game": "match", "rules": "onepocket", "strokes": 200, "noise": _ERRORS},
}
"""The ids, and the arguments of `GameEnv` that they have.

Except in the first, strokes err as those of `carom.player(2)` at 2 m/s. The opponent of matches
has the errors of a Fargo rating of 500 and plays the best of 12 strokes straight at balls, so that a step
takes some milliseconds; in snooker, four-ball and one-pocket he plans by 100 shots; `opponent=` and `opponent_shots=` make him weaker or stronger.
"""
_registry = cast("Any", gymnasium)
for _id, _arguments in GAMES.items():
    if _id not in _registry.registry:
        entry = {
            "entry_point": "carom.gymnasium:GameEnv",
            "vector_entry_point": "carom.gymnasium:GameVectorEnv",
        }
        _registry.register(_id, kwargs=_arguments, **entry)
