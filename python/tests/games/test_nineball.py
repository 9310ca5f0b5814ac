"""Pool for two players: the rules on positions made by hand, and the environment by PettingZoo's
own tests.
"""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from conftest import same_bits

import carom
from carom.games.pool import Hand, Pool

RULES = Pool(cushion_model="han")
POCKET = RULES.table.pockets["centre"][np.argmin(RULES.table.pockets["centre"].sum(axis=1))]
WAY = np.array([1.0, 1.0]) / np.sqrt(2.0)
# One after another towards a corner pocket: the cue ball, and what it is to drive in.
CUE, NEAR, NEARER = (POCKET + distance * WAY for distance in (0.5, 0.2, 0.2 - 2.001 * 0.028575))
AT_POCKET = RULES.base.actions(-135.0, 2.0, b=-0.3)


def position_of(places, rules=RULES, fouls=(0, 0), group=0, player=0, **changes):
    """A position in play: where balls lie, the others are pocketed; fouls of the players, and the
    group of the one at the table.
    """
    begun = rules.begin(1)
    state = begun.state.copy()
    state["opening"], state["group"], state["fouls"] = 0, group, (fouls[player], fouls[1 - player])
    balls = begun.balls.copy()
    balls["state"]["label"] = carom.Label.POCKETED
    for ball, place in places.items():
        balls["state"]["r"][ball, :2], balls["state"]["label"][ball] = place, carom.Label.STATIONARY
    return replace(
        begun, **{"balls": balls, "hand": Hand.NOWHERE, "player": player, "state": state, **changes}
    )


def action(stroke, place=(0.0, 0.0)):
    return np.concatenate([stroke, place])


def test_a_nine_comes_back_behind_a_ball_on_its_spot():
    outcome, _ = RULES.play(position_of({0: CUE, 4: (0.635, 1.905), 9: NEAR}), action(AT_POCKET))
    x, y, _ = outcome.balls["state"]["r"][9]
    assert x == 0.635 and 0.0571 < y - 1.905 < 0.06


def test_a_game_that_has_ended_takes_no_stroke():
    outcome, _ = RULES.play(position_of({0: CUE, 9: NEAR}), action(AT_POCKET))
    with pytest.raises(ValueError, match="the game has ended"):
        RULES.play(outcome, action(AT_POCKET))


def test_a_ball_that_leaves_the_table_is_a_foul_and_stays_down(monkeypatch):
    def off(*arguments, **options):
        shots = carom.simulate_batch(*arguments, **options)
        shots.final["label"][0, 3], shots._facts["off"][0] = carom.Label.OFF, 1 << 3
        return shots

    monkeypatch.setattr("carom.games.rules.simulate_batch", off)
    start = position_of({0: CUE, 3: NEAR, 9: (0.6, 2.0)})
    outcome, turn = RULES.play(start, action(AT_POCKET))
    assert turn.foul == "a ball left the table" and (outcome.player, outcome.hand) == (
        1,
        Hand.ANYWHERE,
    )
    assert (
        outcome.balls["state"]["label"][3] == carom.Label.POCKETED
        and start.balls["state"]["label"][3] == carom.Label.STATIONARY
    )


def test_the_break():
    begun = RULES.begin(5)
    assert begun.hand is Hand.BEHIND and begun.player == 0 and len(begun.balls) == 10
    assert (begun.balls["state"]["r"][1:] == RULES.begin(5).balls["state"]["r"][1:]).all()
    assert (begun.balls["state"]["r"][1:] != RULES.begin(6).balls["state"]["r"][1:]).any()
    # The cue ball lies behind the head string, a quarter of the table, wherever it is wanted.
    for place in ((-1.0, -1.0), (1.0, 1.0), (0.0, 5.0)):
        _, turn = RULES.play(begun, action(RULES.base.actions(90.0, 9.0), place))
        assert 0.02 < turn.shot.balls["state"]["r"][0, 1] <= RULES.table.length / 4.0
    soft, turn = RULES.play(begun, action(RULES.base.actions(90.0, 1.2)))
    assert (
        turn.first == 1
        and turn.foul == "the break potted nothing, and drove too few balls to cushions"
        and soft.player == 1
    )
    hard, turn = RULES.play(begun, action(RULES.base.actions(90.0, 9.0)))
    assert not turn.foul.startswith("the break") and turn.shot.count > 40


def test_ball_in_hand():
    start = position_of({0: CUE, 1: (0.6, 1.8), 9: (0.6, 2.0)}, hand=Hand.ANYWHERE)
    _, turn = RULES.play(start, action(RULES.base.actions(90.0, 2.0), (-0.5, 0.0)))
    np.testing.assert_allclose(
        turn.shot.balls["state"]["r"][0, :2], [0.635 - 0.5 * (0.635 - 0.029575), 1.27], atol=1e-9
    )
    # A place that another ball takes becomes one that is free, always the same.
    placed = [
        2.0 * (0.6 - 0.029575) / (1.27 - 0.05915) - 1.0,
        2.0 * (1.8 - 0.029575) / (2.54 - 0.05915) - 1.0,
    ]
    places = [
        RULES.play(start, action(RULES.base.actions(90.0, 2.0), placed))[1]
        .shot.balls["state"]["r"][0]
        .tolist()
        for _ in range(2)
    ]
    assert places[0] == places[1] and np.hypot(*(np.array(places[0][:2]) - [0.6, 1.8])) > 0.05715
    for invalid in (np.zeros(5), np.full(6, np.nan)):
        with pytest.raises(ValueError, match=r"action: .* are not six finite numbers"):
            RULES.play(start, invalid)


def test_observations_are_within_bounds():
    rules, generator = Pool(cushion_model="han", noise=(0.5, 0.1, 0.02)), np.random.default_rng(4)
    low, high = rules.bounds()
    for seed in range(4):
        position = rules.begin(seed)
        while position.winner is None and position.strokes < 60:
            seen = rules.observe(position, position.player)
            assert seen.shape == low.shape == (33,) and (low <= seen).all() and (seen <= high).all()
            position, turn = rules.play(position, generator.uniform(-1.0, 1.0, 6))
            assert (turn.shot.events["time"] >= 0).all()
    assert (
        rules.observe(position, 0)[31:].tolist() == rules.observe(position, 1)[31:].tolist()[::-1]
    )


# ---- Eight-ball
# -----------------------------------------------------------------------------------------------------------


EIGHT = Pool("eightball", cushion_model="han")
PLACES = {"cue": CUE, "near": NEAR, "nearer": NEARER, "beside the line": CUE + [0.03, 0.0]}
STROKES = {
    "pot": AT_POCKET,
    "away": RULES.base.actions(90.0, 2.0),
    "soft": RULES.base.actions(90.0, 0.5),
}
POSITIONS = (Path(__file__).parent / "positions.jsonl").read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize("row", [json.loads(line) for line in POSITIONS], ids=str)
def test_a_stroke_at_a_position(row):
    """A pot, a miss, fouls, the ball that wins, and of eight-ball groups: what becomes of each."""
    rules = EIGHT if row["game"] == "eightball" else RULES
    places = {
        int(ball): place if isinstance(place, list) else PLACES[place]
        for ball, place in row["balls"].items()
    }
    start = position_of(places, rules, **row.get("start", {}))
    layout = start.balls.tobytes()
    outcome, turn = rules.play(start, action(STROKES[row["stroke"]]))
    assert start.balls.tobytes() == layout and start.strokes == 0
    nine = outcome.balls["state"][9]
    found = {
        "foul": turn.foul,
        "code": carom.Foul(turn.code).name,
        "first": turn.first,
        "potted": [*turn.potted],
        "player": outcome.player,
        "hand": outcome.hand.name,
        "fouls": [*outcome.fouls],
        "strokes": outcome.strokes,
        "winner": outcome.winner,
        "group": outcome.state["group"],
        "nine": "down" if nine["label"] == carom.Label.POCKETED else nine["r"].tolist(),
    }
    assert {name: found[name] for name in row["expected"]} == row["expected"]


def test_an_observation_tells_the_position():
    far = {5: (0.6, 2.0), 12: (0.7, 2.2), 8: (0.3, 2.3)}
    assert EIGHT.on(position_of({0: CUE, 3: NEAR, **far}, EIGHT, group=2)) == (12,)
    # What an observation tells is the position again, for whoever is at the table.
    position = position_of({0: CUE, 3: NEAR, **far}, EIGHT, group=2, player=1)
    restored = EIGHT.seen(EIGHT.observe(position, 1))
    assert (
        same_bits(restored.balls[[0, 3, 5, 12, 8]], position.balls[[0, 3, 5, 12, 8]])
        and (restored.state == position.state).all()
    )
    assert EIGHT.observe(position, 0)[-1] == 1.0 and EIGHT.observe(position, 1)[-1] == 2.0
    assert EIGHT.observe(EIGHT.begin(1), 0)[-3:].tolist() == [1.0, 1.0, 0.0]


def test_what_strokes_are_worth():
    """`tried` is what `play` gives without noise, of both games, also of a cue ball in hand."""
    generator = np.random.default_rng(5)
    for rules in (RULES, EIGHT):
        seen = set()
        for start in (
            position_of({0: CUE, 3: NEAR, 5: (0.6, 2.0), 8: (0.3, 2.3), 9: (0.9, 1.2)}, rules),
            rules.begin(2),
        ):
            actions = generator.uniform(-1.0, 1.0, (60, 6))
            actions[:5, :4] = AT_POCKET
            for worth, stroke in zip(rules.tried(start, actions), actions):
                outcome, turn = rules.play(start, stroke)
                expected = (
                    1.0
                    if outcome.winner == 0
                    else -1.0
                    if outcome.winner == 1
                    else -0.5
                    if turn.foul
                    else 0.5
                    if outcome.player == 0
                    else 0.0
                )
                assert worth == expected
                seen.add(expected)
        assert seen >= {-0.5, 0.0, 0.5}


# ---- PettingZoo
# -----------------------------------------------------------------------------------------------------------


@pytest.fixture
def environment():
    pytest.importorskip("pettingzoo", reason="PettingZoo is not installed")
    from carom.games.pettingzoo import PoolEnv

    return PoolEnv


def test_pettingzoo_finds_nothing_wrong(environment):
    from pettingzoo.test import api_test, seed_test

    api_test(environment(strokes=40, cushion_model="han"), num_cycles=100)
    seed_test(lambda: environment(strokes=20, cushion_model="han"), num_cycles=30)


def test_a_parallel_environment(environment):
    """Of the actions of both, that of the player at the table is played."""
    from pettingzoo.test import parallel_api_test

    from carom.pettingzoo import PoolEnv, parallel

    parallel_api_test(parallel(strokes=8), num_cycles=60)
    game, turns = parallel(strokes=8), PoolEnv(strokes=8)
    game.reset(seed=4)
    turns.reset(seed=4)
    rng = np.random.default_rng(4)
    while game.agents:
        actions = {agent: rng.uniform(-1.0, 1.0, 6) for agent in game.agents}
        turns.step(actions[turns.agent_selection])
        seen, rewards, terminated, truncated, _ = game.step(actions)
        for agent, expected in turns.rewards.items():
            assert rewards[agent] == expected and truncated[agent] == turns.truncations[agent]
            assert np.array_equal(seen[agent], turns.observe(agent))
    assert turns.position.winner is not None or turns.position.strokes == 8


def test_a_game_of_the_environment(environment):
    game = environment(cushion_model="han", render_mode="svg")
    game.reset(seed=3, options={"position": position_of({0: CUE, 9: NEAR}, player=1)})
    assert game.agent_selection == "player_1"
    game.step(action(AT_POCKET))
    assert game.terminations == {"player_0": True, "player_1": True} and game.rewards == {
        "player_0": -1.0,
        "player_1": 1.0,
    }
    assert game.infos["player_0"] == {"foul": "", "first": 9, "potted": [9], "hand": 0}
    assert game.render().startswith("<svg")
    for agent in game.agent_iter():
        assert game.last()[1] == (1.0 if agent == "player_1" else -1.0)
        game.step(None)
    game = environment(strokes=3, cushion_model="han", render_mode="svg")
    game.reset(seed=3)
    strokes = 0
    for agent in game.agent_iter():
        _, _, terminated, truncated, _ = game.last()
        strokes += not (terminated or truncated)
        game.step(None if terminated or truncated else game.action_space(agent).sample())
    assert strokes == 3 and game.render().startswith("<svg")
    with pytest.raises(ValueError, match="render_mode"):
        environment(render_mode="3d")


def test_the_planner_is_an_opponent():
    """It wins against strokes at random, also in hand and at the break, and its actions are those
    of the space.
    """
    pytest.importorskip("pettingzoo", reason="PettingZoo is not installed")
    from carom.games.pettingzoo import PoolEnv

    game = PoolEnv(strokes=60, noise=(0.1, 0.1, 0.003))
    won = 0
    for seed in range(3):
        game.reset(seed=seed)
        game.action_space("player_1").seed(seed)
        for agent in game.agent_iter():
            ended = game.terminations[agent] or game.truncations[agent]
            if agent == "player_0" and not ended:
                chosen = game.rules.best(game.position, shots=200, seed=game.position.strokes)
                assert chosen.shape == (6,) and game.action_space(agent).contains(
                    chosen.astype(np.float32)
                )
            else:
                chosen = game.action_space(agent).sample()
            game.step(None if ended else chosen)
        won += game.position.winner == 0
    assert won == 3
