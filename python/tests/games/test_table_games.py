"""Snooker, four-ball, one-pocket and other games of two sides as environments of gymnasium."""

import warnings

import numpy as np
import pytest

import carom

pytest.importorskip("gymnasium", reason="gymnasium is not installed")
import gymnasium  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402

import carom.gymnasium  # noqa: E402
from carom.games.table_games import TableGame  # noqa: E402

IDS = ["carom/Snooker-v1", "carom/FourBall-v1", "carom/OnePocket-v1"]


@pytest.mark.parametrize("name", IDS)
def test_gymnasium_accepts_it(name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(name).unwrapped, skip_render_check=True)


def played(env, steps, seed):
    rng = np.random.default_rng(seed)
    observation, _ = env.reset(seed=seed)
    found = [observation]
    for _ in range(steps):
        action = rng.uniform(-1.0, 1.0, 6)
        observation, reward, ended, _, info = env.step(action)
        found.append(np.append(observation, [reward, info["foul"], info["time"]]))
        if ended:
            break
    return found


@pytest.mark.parametrize("name", IDS)
def test_games_are_alike_and_within_their_space(name):
    env = gymnasium.make(name)
    first, second = (played(env, 12, 3) for _ in range(2))
    assert len(first) == len(second) > 2
    for one, other in zip(first, second):
        np.testing.assert_array_equal(one, other)
    for observation in first[1:]:
        assert env.observation_space.contains(observation[:-3])


def test_a_game_of_many_is_the_game_alone():
    many = gymnasium.make_vec(
        "carom/OnePocket-v1", num_envs=2, vectorization_mode="vector_entry_point"
    )
    alone = gymnasium.make("carom/OnePocket-v1")
    observations, _ = many.reset(seed=4)
    observation, _ = alone.reset(seed=5)
    rng = np.random.default_rng(1)
    for _ in range(4):
        np.testing.assert_array_equal(observations[1], observation)
        actions = rng.uniform(-1.0, 1.0, (2, 6))
        observations, _, ended, _, _ = many.step(actions)
        observation, _, over, _, _ = alone.step(actions[1])
        assert ended[1] == over
        if ended.any():
            break


def test_the_rules_are_those_of_a_match():
    """In snooker only reds may be met first; a foul gives the opponent points."""
    game = carom.gymnasium.GameEnv("match", rules="snooker", reward="points", strokes=3)
    observation, _ = game.reset(seed=1)
    rows = observation[:-5].reshape(22, 4)
    assert rows[1:16, 3].all() and not rows[16:, 3].any() and rows[1:, 2].all()
    assert tuple(observation[-5:]) == (1.0, 0.0, 0.0, 0.0, 3.0)
    observation, reward, ended, _, info = game.step([-0.5, -1.0, 0.0, 0.0, 0.0, 0.0])
    assert info["foul"] != 0 and reward <= -4.0 and observation[-2] >= 4.0 and not ended
    game.step(np.zeros(6))
    assert game.step(np.zeros(6))[2]


def test_points_and_targets():
    game = TableGame("fourball", target=1, opponent=carom.player(0.0), strokes=30)
    assert game.balls == 3 and game.table == carom.tables.fourball()
    env = carom.gymnasium.GameEnv("match", rules="fourball", target=1, strokes=30)
    rewards = [played(env, 30, seed)[-1][-3] for seed in range(3)]
    assert set(rewards) <= {-1.0, 0.0, 1.0} and any(rewards)


@pytest.mark.parametrize("rules", ["blackball", "straight", "rotation", "threecushion", "nineball"])
def test_other_games_are_a_parameter(rules):
    env = carom.gymnasium.GameEnv("match", rules=rules)
    assert len(played(env, 3, 1)) > 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rules": "chess"}, "rules: unknown value 'chess'"),
        ({"rules": "cutthroat"}, "rules: 'cutthroat' is not a game of two sides"),
        ({"reward": "fun"}, "reward: unknown value 'fun'.*'win'"),
        ({"opponent_shots": 99}, "opponent_shots: "),
        ({"target": 0}, "target: "),
        ({"strokes": 0}, "strokes: "),
    ],
)
def test_refused(options, message):
    with pytest.raises(ValueError, match=message):
        TableGame(**options)
    with pytest.raises(ValueError, match="layout: a game begins"):
        carom.gymnasium.GameEnv("match").reset(options={"layout": np.zeros((22, 2))})
