"""PPO of stable_baselines3 learns carom/PotOne-v1: to pot one ball with one stroke, which errs.

It sees the pot that is easiest by geometry. Its action corrects the aim at the ghost ball, by up to 10 degrees of the object ball's
direction, and sets speed and tip: it learns throw, speed, and not to scratch. The curve is the mean return of 2,000 layouts that are not
trained on, played without exploring. At the end it plays the games of `game_agents.py`. Needs stable_baselines3 2.5.

    python train_pot_one.py pot_one.svg 2000000
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import game_agents
import gymnasium
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

import carom.games.gymnasium

Doubles = npt.NDArray[np.float64]
Policy = Callable[[Doubles], Doubles]
GAME, SEED, MOST = "carom/PotOne-v1", 1, np.radians(10.0)
RULES: Any = carom.games.gymnasium.GameEnv(**carom.games.gymnasium.GAMES[GAME]).rules
POCKETS = RULES.table.pockets["centre"]
SIDE = np.abs(POCKETS[:, 1] - RULES.table.length / 2.0) < 0.1


def direction(way: Doubles) -> Doubles:
    return np.asarray(np.arctan2(way[..., 1], way[..., 0]))


def ghost(ball: Doubles, to: Doubles) -> Doubles:
    return np.asarray(ball - 2.0 * RULES.radius * np.stack([np.cos(to), np.sin(to)], axis=-1))


def seen(observed: Doubles) -> Doubles:
    """The easiest pot of observations (games, 7): cut, both distances, the ball's direction, whether to a side pocket, and both places."""
    cue, ball = observed[:, np.newaxis, 0:2], observed[:, np.newaxis, 3:5]
    to, far = direction(POCKETS - ball), np.linalg.norm(POCKETS - ball, axis=-1)
    line = ghost(ball, to) - cue
    near, cut = np.linalg.norm(line, axis=-1), (direction(line) - to + np.pi) % (2.0 * np.pi) - np.pi
    # An error of the cue grows by near/cos(cut) and by far; a side pocket is narrow from aside.
    wide = np.maximum(np.cos(cut), 1e-3) * np.where(SIDE, np.cos(to) ** 2, 1.0)
    k = np.argmin(near * far / np.maximum(wide, 1e-9), axis=-1)[:, np.newaxis]
    parts = [np.take_along_axis(part, k, -1) for part in (cut, near, far, to, np.broadcast_to(1.0 * SIDE, to.shape))]
    return np.concatenate([*parts, cue[:, 0], ball[:, 0]], axis=-1)


def strokes(sight: Doubles, given: Doubles) -> Doubles:
    """The actions of the game for those of the policy, (games, 4)."""
    aim = ghost(sight[:, 7:9], sight[:, 3] + MOST * given[:, 0]) - sight[:, 5:7]
    return np.column_stack([direction(aim) / np.pi, given[:, 1:]])


def play(policy: Policy, observed: Doubles) -> Doubles:
    """The actions of the game by a policy, from observations (games, 7)."""
    sight = seen(observed)
    return strokes(sight, policy(sight))


def mean_return(policy: Policy, games: int = 2000) -> float:
    """Of layouts that are not trained on."""
    unseen: Any = gymnasium.make_vec(GAME, num_envs=games)
    return float(unseen.step(play(policy, unseen.reset(seed=10**6)[0]))[1].mean())


def train(total: int, count: int = 256) -> tuple[Policy, Doubles]:
    """The policy after so many strokes, in `count` games at once; and the curve: strokes, seconds, mean return."""
    from stable_baselines3 import PPO
    from stable_baselines3.common.vec_env import VecEnv

    class Games(VecEnv):
        """Many games as stable_baselines3 has them; a stroke ends each, and the next begins at once."""

        def __init__(self) -> None:
            self.games: Any = gymnasium.make_vec(GAME, num_envs=count)
            super().__init__(count, gymnasium.spaces.Box(-4.0, 4.0, (9,), np.float64), self.games.single_action_space)
            self.games.reset(seed=SEED)

        def reset(self) -> Doubles:
            self.sight = seen(self.games.reset()[0])
            return self.sight

        def step_async(self, actions: Doubles) -> None:
            self.rewards = self.games.step(strokes(self.sight, actions))[1]

        def step_wait(self) -> tuple[Any, ...]:
            return self.reset(), self.rewards, np.ones(self.num_envs, bool), [{} for _ in range(self.num_envs)]

        def get_attr(self, *arguments: Any) -> list[None]:
            return [None] * self.num_envs

        close = set_attr = env_method = env_is_wrapped = get_attr

    how: dict[str, Any] = {"n_steps": 16, "batch_size": 1024, "n_epochs": 4, "learning_rate": lambda left: 1e-3 * left}
    model: Any = PPO("MlpPolicy", Games(), seed=SEED, policy_kwargs={"log_std_init": -1.0}, **how)
    curve: list[tuple[float, ...]] = []
    begun, every = time.perf_counter(), max(total // 60 // (16 * count), 1) * 16 * count

    def policy(sight: Doubles) -> Doubles:
        return np.asarray(model.predict(sight, deterministic=True)[0])

    def look(*_: Any) -> bool:
        if model.num_timesteps % every == 0:
            curve.append((model.num_timesteps, time.perf_counter() - begun, mean_return(policy)))
            print(f"{model.num_timesteps} strokes, {curve[-1][1]:.0f} s: {curve[-1][2]:.3f}", flush=True)
        return True

    model.learn(total, callback=look)
    return policy, np.array(curve)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path, help="the picture of the curve; beside it a table, .csv")
    parser.add_argument("strokes", type=int, help="to train with")
    parser.add_argument("--games", type=int, default=400, help="that all agents play at the end")
    given = parser.parse_args(arguments)
    policy, curve = train(given.strokes)
    np.savetxt(given.out.with_suffix(".csv"), curve, "%.6g", ",", header="strokes,s,return", comments="")
    agents: dict[str, game_agents.Agent] = {"PPO": lambda rules, observed: play(policy, observed[np.newaxis])[0], "greedy": game_agents.greedy_agent}
    for name, agent in (agents | {"plan of 2000 shots": game_agents.planner(2000)}).items():
        returns, _ = game_agents.play(agent, GAME, given.games, 1)
        print(f"{name}: {game_agents.score(returns, 1)}", flush=True)
        if name != "PPO":
            plt.axhline(float(returns.mean()), linestyle="--", color="gray")
            plt.text(0.0, float(returns.mean()), name, verticalalignment="bottom")
    plt.plot(curve[:, 0] / 1e6, curve[:, 2])
    plt.xlabel("strokes of training, millions")
    plt.ylabel(f"mean return of {GAME}")
    plt.savefig(given.out)


if __name__ == "__main__":
    main()
