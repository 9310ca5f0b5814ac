"""Nine-ball and eight-ball (`carom.pool`) for two agents, as an environment of PettingZoo.

    from carom.pettingzoo import PoolEnv

    game = PoolEnv("nineball", cushion_model="han")
    game.reset(seed=1)
    for agent in game.agent_iter():
        observation, reward, terminated, truncated, info = game.last()
        game.step(None if terminated or truncated else game.action_space(agent).sample())

`parallel` is the same game as a parallel environment. Actions, observations and rules are defined
by `carom.pool.Pool`. The winner's reward is 1, the loser's -1. Needs PettingZoo.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes, pictures
from carom._rows import listing, needed
from carom.games.pool import Pool, Stroke
from carom.games.potting import in_space

needed("pettingzoo", "carom.pettingzoo")
from gymnasium import spaces  # noqa: E402
from gymnasium.utils import seeding  # noqa: E402
from pettingzoo import AECEnv  # noqa: E402
from pettingzoo.utils.conversions import turn_based_aec_to_parallel  # noqa: E402

__all__ = ["PoolEnv", "parallel"]
__dir__ = listing(__name__)

_PLAYERS = ("player_0", "player_1")


class PoolEnv(AECEnv):
    """One game of pool with the rules `Pool(game, **options)`.

    It is truncated after `strokes` strokes of both players together. `render_mode` is as for
    `carom.gymnasium.GameEnv`. After a stroke the `infos` of both players contain foul (the reason,
    or ""), first (the ball hit first, 0 if there is none), potted (a list) and hand.
    """

    metadata: dict[str, Any] = {
        "name": "carom_pool_v2",
        "render_modes": list(pictures.RENDER_MODES),
        "render_fps": 1,
        "is_parallelizable": False,
    }

    def __init__(
        self,
        game: Literal["nineball", "eightball"] = "nineball",
        strokes: int = 200,
        *,
        render_mode: Literal["svg", "rgb_array"] | None = None,
        **options: Any,
    ) -> None:
        super().__init__()
        pictures.check_render_mode(render_mode)
        self.rules = Pool(game, **options)
        self.strokes = strokes
        self.render_mode = render_mode
        self.possible_agents = list(_PLAYERS)
        low, high = self.rules.bounds()
        self._observed = {agent: spaces.Box(low, high, dtype=np.float64) for agent in _PLAYERS}
        self._acted = {agent: spaces.Box(-1.0, 1.0, (6,), dtype=np.float32) for agent in _PLAYERS}
        self._generator = seeding.np_random()[0]

    def observation_space(self, agent: str) -> Any:
        """The space of observations."""
        return self._observed[agent]

    def action_space(self, agent: str) -> Any:
        """The space of actions."""
        return self._acted[agent]

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        """Begin a game with the break of player_0.

        The option "position" is a `carom.pool.Position` to begin with instead.
        """
        if seed is not None:
            self._generator = seeding.np_random(seed)[0]
        settings = {} if options is None else options
        self.position = settings.get("position") or self.rules.begin(
            int(self._generator.integers(2**63))
        )
        self.stroke: Stroke | None = None
        self.agents = list(_PLAYERS)
        self.agent_selection = _PLAYERS[self.position.player]
        self.rewards = dict.fromkeys(_PLAYERS, 0.0)
        self._cumulative_rewards = dict.fromkeys(_PLAYERS, 0.0)
        self.terminations = dict.fromkeys(_PLAYERS, False)
        self.truncations = dict.fromkeys(_PLAYERS, False)
        self.infos: dict[str, dict[str, Any]] = {agent: {} for agent in _PLAYERS}

    def observe(self, agent: str) -> dtypes.Doubles:
        """The observation of a player."""
        return self.rules.observe(self.position, _PLAYERS.index(agent))

    def step(self, action: ArrayLike | None) -> None:
        """Play the stroke of the player at the table."""
        agent = self.agent_selection
        if self.terminations[agent] or self.truncations[agent]:
            self._was_dead_step(action)
            return
        self._cumulative_rewards[agent] = 0.0
        if action is None:
            raise ValueError(
                "action: None is only allowed after the end of the game; pass six numbers"
            )
        values = in_space(action, (6,), "action")
        self.position, self.stroke = self.rules.play(self.position, values)
        winner = self.position.winner
        info = {
            "foul": self.stroke.foul,
            "first": self.stroke.first or 0,
            "potted": list(self.stroke.potted),
            "hand": int(self.position.hand),
        }
        for k, name in enumerate(_PLAYERS):
            self.rewards[name] = 0.0 if winner is None else 1.0 if k == winner else -1.0
            self.terminations[name] = winner is not None
            self.truncations[name] = winner is None and self.position.strokes >= self.strokes
            self.infos[name] = dict(info)
        self.agent_selection = _PLAYERS[self.position.player]
        self._accumulate_rewards()

    def render(self) -> Any:
        """Draw the balls and the paths of the last stroke, as SVG."""
        if self.render_mode is None:
            return None
        return pictures.rendered(
            self.rules.base.shot(self.position.balls, None)
            if self.stroke is None
            else self.stroke.shot,
            self.render_mode,
        )

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


def parallel(
    game: Literal["nineball", "eightball"] = "nineball", strokes: int = 200, **options: Any
) -> Any:
    """A `PoolEnv` with these arguments as a parallel environment of PettingZoo.

    A step accepts an action of each player, and plays the one of the player at the table.
    """
    return turn_based_aec_to_parallel(PoolEnv(game, strokes, **options))
