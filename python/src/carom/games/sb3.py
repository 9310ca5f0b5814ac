"""Games for agents as a vector environment of Stable Baselines3; each step is one batch.

    from stable_baselines3 import PPO
    from carom.sb3 import VecGames

    PPO("MlpPolicy", VecGames("carom/PotOne-v1", 64)).learn(100_000)

Games, actions and observations are the same as in `carom.gymnasium.GameVectorEnv`. A step takes a
small fraction of the time that Stable Baselines3 needs for as many separate environments. Needs
Stable Baselines3.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from carom._rows import listing, named, needed
from carom.games.gymnasium import GAMES, GameVectorEnv

_vec_env: Any = needed("stable_baselines3.common.vec_env", "carom.sb3")

__all__ = ["VecGames"]
__dir__ = listing(__name__)


class VecGames(_vec_env.VecEnv):
    """Many games of an id of `carom.gymnasium.GAMES`.

    **rules are arguments of `carom.gymnasium.GameEnv`, which override the arguments of the id.
    """

    def __init__(self, id: str, num_envs: int = 64, **rules: Any) -> None:
        id = named(GAMES, id, "id")
        mode = gymnasium.vector.AutoresetMode.SAME_STEP
        self.games = GameVectorEnv(num_envs, autoreset_mode=mode, **{**GAMES[id], **rules})
        self.render_mode, self.metadata = self.games.render_mode, self.games.metadata
        spaces = self.games.single_observation_space, self.games.single_action_space
        super().__init__(num_envs, *spaces)

    def reset(self) -> NDArray[Any]:
        """Begin all games with the seeds set by `seed`."""
        seeds: list[int | None] = list(self._seeds)
        self._reset_seeds()
        self._reset_options()
        return self.games.reset(seed=seeds)[0]

    def step_async(self, actions: NDArray[Any]) -> None:
        """Store the actions of the next step."""
        self.actions = actions

    def step_wait(self) -> tuple[Any, NDArray[np.float32], NDArray[Any], list[Any]]:
        """Play the step. A game that ends restarts, and its info contains "terminal_observation"."""
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
        """Do nothing: there is nothing to close."""

    def get_images(self) -> Sequence[Any]:
        """Draw all games, with render_mode="rgb_array"."""
        return self.games.render() or [None] * self.num_envs

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return an attribute, which all games share."""
        return [getattr(self.games, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Raise AttributeError: games share their attributes."""
        raise AttributeError(
            f"VecGames: {attr_name!r} cannot be set, because games share their attributes; pass it to VecGames()"
        )

    def env_method(
        self, method_name: str, *arguments: Any, indices: Any = None, **named: Any
    ) -> list[Any]:
        """Raise AttributeError: there are no environments of single games."""
        raise AttributeError(
            f"VecGames: there are no single environments, so no method {method_name!r}; use the attribute games"
        )

    def env_is_wrapped(
        self, wrapper_class: Any, indices: Iterable[int] | int | None = None
    ) -> list[bool]:
        """Return False: there are no single environments that could be wrapped."""
        return [False for _ in self._get_indices(indices)]
