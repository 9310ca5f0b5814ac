"""Games for agents as a vector environment of Stable Baselines3: all games of a step in one batch.

    from stable_baselines3 import PPO
    from carom.sb3 import VecGames

    PPO("MlpPolicy", VecGames("carom/PotOne-v1", 64)).learn(100_000)

Games, actions and observations are those of `carom.gymnasium.GameVectorEnv`, whose step takes a
small part of the time that Stable Baselines3 takes for as many environments of their own. Needs
Stable Baselines3.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from carom._rows import listing, needed
from carom.games.gymnasium import GAMES, GameVectorEnv

_vec_env: Any = needed("stable_baselines3.common.vec_env", "carom.sb3")

__all__ = ["VecGames"]
__dir__ = listing(__name__)


class VecGames(_vec_env.VecEnv):
    """Many games of an id of `carom.gymnasium.GAMES`; **rules are the arguments of
    `carom.gymnasium.GameEnv`, and may replace those of the id.
    """

    def __init__(self, id: str, num_envs: int = 64, **rules: Any) -> None:
        if id not in GAMES:
            raise ValueError(f"id: must be one of {', '.join(map(repr, GAMES))}, not {id!r}")
        mode = gymnasium.vector.AutoresetMode.SAME_STEP
        self.games = GameVectorEnv(num_envs, autoreset_mode=mode, **{**GAMES[id], **rules})
        self.render_mode, self.metadata = self.games.render_mode, self.games.metadata
        spaces = self.games.single_observation_space, self.games.single_action_space
        super().__init__(num_envs, *spaces)

    def reset(self) -> NDArray[Any]:
        """Begin all games, by the seeds that `seed` gave them."""
        seeds: list[int | None] = list(self._seeds)
        self._reset_seeds()
        self._reset_options()
        return self.games.reset(seed=seeds)[0]

    def step_async(self, actions: NDArray[Any]) -> None:
        """Take the actions of the next step."""
        self.actions = actions

    def step_wait(self) -> tuple[Any, NDArray[np.float32], NDArray[Any], list[Any]]:
        """Play the step: a game that ends begins anew, and its info has "terminal_observation"."""
        seen, rewards, ended, _, infos = self.games.step(self.actions)
        names = [name for name in infos if name[0] != "_" and not name.startswith("final_")]
        whole = {name: infos[name] for name in names}
        if ended.any():
            final = infos["final_info"]
            whole = {name: np.where(ended, final[name], infos[name]) for name in names}
        columns = (values.tolist() for values in whole.values())
        details: list[dict[str, Any]] = [dict(zip(names, row)) for row in zip(*columns)]
        for game in np.flatnonzero(ended):
            details[game]["terminal_observation"] = infos["final_obs"][game]
            details[game]["TimeLimit.truncated"] = False
        return seen, rewards.astype(np.float32), ended, details

    def close(self) -> None:
        """Nothing is held open."""

    def get_images(self) -> Sequence[Any]:
        """The pictures of all games, with render_mode="rgb_array"."""
        return self.games.render() or [None] * self.num_envs

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute, which all games share."""
        return [getattr(self.games, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Refused: games share their attributes."""
        raise AttributeError(
            f"VecGames: games share their attributes, so {attr_name!r} cannot be set; give it to VecGames()"
        )

    def env_method(
        self, method_name: str, *arguments: Any, indices: Any = None, **named: Any
    ) -> list[Any]:
        """Refused: there are no environments of single games."""
        raise AttributeError(
            f"VecGames: there are no environments of single games with a method {method_name!r}; games has many games"
        )

    def env_is_wrapped(
        self, wrapper_class: Any, indices: Iterable[int] | int | None = None
    ) -> list[bool]:
        """Nowhere: wrappers of single environments have none here."""
        return [False for _ in self._get_indices(indices)]
