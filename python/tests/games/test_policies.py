"""Policies of Stable Baselines3, which needs PyTorch: its checker, of all games, and PPO of the
example.
"""

import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import carom

pytest.importorskip(
    "stable_baselines3", reason="stable_baselines3, which needs PyTorch, is not installed"
)
gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")
from stable_baselines3.common.env_checker import check_env  # noqa: E402

import carom.gymnasium  # noqa: E402

sys.path.insert(0, str(Path(__file__).parents[2] / "examples"))
import train_games  # noqa: E402


def test_the_checker_does_not_warn():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in carom.gymnasium.GAMES:
            check_env(gymnasium.make(name).unwrapped)


def test_games_of_the_adapter_are_those_of_single_environments():
    """Stable Baselines3's own vector of single games gives the same."""
    from stable_baselines3.common.vec_env import DummyVecEnv

    from carom.sb3 import VecGames

    rules = {"balls": 2, "strokes": 2}
    many = VecGames("carom/Potting-v1", 4, **rules)
    singles = DummyVecEnv([lambda: gymnasium.make("carom/Potting-v1", **rules)] * 4)
    for games in (many, singles):
        games.seed(5)
    assert np.array_equal(many.reset(), singles.reset())
    rng, ends = np.random.default_rng(1), 0
    for _ in range(7):
        actions = rng.uniform(-1.0, 1.0, (4, 4))
        (seen, rewards, ended, infos), expected = many.step(actions), singles.step(actions)
        for found, second in zip((seen, rewards, ended), expected):
            assert np.array_equal(found, second) and found.dtype == second.dtype
        for info, second in zip(infos, expected[3]):
            assert np.array_equal(
                info.pop("terminal_observation", 0), second.pop("terminal_observation", 0)
            )
            assert info | {"TimeLimit.truncated": False} == second
        ends += int(ended.sum())
    assert ends == 12
    with pytest.raises(AttributeError, match="games share their attributes"):
        many.set_attr("strokes", 3)
    with pytest.raises(ValueError, match="^id: unknown value .* 'carom/Potting-v1'"):
        VecGames("carom/Potting-v9")


def test_ppo_learns_on_the_adapter():
    from stable_baselines3 import PPO
    from stable_baselines3.common.evaluation import evaluate_policy

    from carom.sb3 import VecGames

    model = PPO("MlpPolicy", VecGames("carom/PotOne-v1", 16), n_steps=8, batch_size=64, seed=1)
    model.learn(256)
    returns, lengths = evaluate_policy(
        model, VecGames("carom/PotOne-v1", 4), 8, warn=False, return_episode_rewards=True
    )
    assert len(returns) == 8 and lengths == [1] * 8


def test_ppo_is_trained(tmp_path):
    """In each game a round at least, by which the policy changes: the curve, and the table of all
    agents.
    """
    train_games.main([str(tmp_path / "games.svg"), "--minutes", "1e-6", "--games", "3"])
    curve = np.loadtxt(tmp_path / "games.csv", delimiter=",", skiprows=1, usecols=(1, 2))
    assert (
        curve[:, 0].tolist() == [0, 4096] * 5 + [0, 1024] * 2
        and (curve[::2, 1] != curve[1::2, 1]).sum() >= 2
    )
    assert (tmp_path / "games.md").read_text(encoding="utf-8").count("|") == 8 * 9 and (
        tmp_path / "games.svg"
    ).stat().st_size > 10_000
