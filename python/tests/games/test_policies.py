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


def test_ppo_is_trained(tmp_path):
    """In each game a round at least, by which the policy changes: the curve, and the table of all
    agents.
    """
    train_games.main([str(tmp_path / "games.svg"), "--minutes", "1e-6", "--games", "3"])
    curve = np.loadtxt(tmp_path / "games.csv", delimiter=",", skiprows=1, usecols=(1, 2))
    assert (
        curve[:, 0].tolist() == [0, 4096] * 5 + [0, 1024] * 2
        and (curve[::2, 1] != curve[1::2, 1]).sum() >= 3
    )
    assert (tmp_path / "games.md").read_text(encoding="utf-8").count("|") == 8 * 9 and (
        tmp_path / "games.svg"
    ).stat().st_size > 10_000
