"""Policies of Stable Baselines3, which needs PyTorch: its checker, of all games, and PPO of the example."""

import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import carom

pytest.importorskip("stable_baselines3", reason="stable_baselines3, which needs PyTorch, is not installed")
gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")
from stable_baselines3.common.env_checker import check_env  # noqa: E402

import carom.gymnasium  # noqa: E402

sys.path.insert(0, str(Path(__file__).parents[2] / "examples"))
import train_pot_one  # noqa: E402


def test_the_checker_does_not_warn():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in carom.gymnasium.GAMES:
            check_env(gymnasium.make(name).unwrapped)


def test_ppo_is_trained(tmp_path, capsys):
    """Two rounds, by which the policy changes; the curve, its table, and the agents at the end."""
    train_pot_one.main([str(tmp_path / "pot.svg"), "8192", "--games", "3"])
    curve = np.loadtxt(tmp_path / "pot.csv", delimiter=",", skiprows=1)
    assert curve[:, 0].tolist() == [4096, 8192] and curve[0, 2] != curve[1, 2]
    assert "plan of 2000 shots: " in capsys.readouterr().out and (tmp_path / "pot.svg").stat().st_size > 10_000
