"""The game of carom.potting by its rules, and its environments of gymnasium by gymnasium's checker
and against each other.
"""

import importlib.util
import warnings
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import by_line, refused, run_python, same_bits
from numpy.testing import assert_allclose, assert_array_equal

import carom
from carom.games._draws import Draws
from carom.games.matches import Match
from carom.games.pool import Hand
from carom.games.potting import Potting

EXAMPLE = Path(__file__).parents[2] / "examples" / "game_agents.py"


@pytest.fixture
def gymnasium():
    gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")
    import carom.gymnasium  # noqa: F401

    return gymnasium


# ---- The rules
# ------------------------------------------------------------------------------------------------------------


def lined_up(rules, distance=0.3):
    """Centres of a cue ball, a ball and a corner pocket in one line, the other balls far away; and
    the direction, degrees.
    """
    pocket = rules.table.pockets["centre"][np.argmin(rules.table.pockets["centre"].sum(axis=1))]
    way = np.array([1.0, 1.0]) / np.sqrt(2.0)
    line = [pocket + (0.2 + distance) * way, pocket + 0.2 * way]
    rest = [(0.3 + 0.1 * k, 2.2) for k in range(rules.balls - 1)]
    return np.array([*line, *rest]), -135.0


def test_draws_are_those_of_splitmix64():
    """The first numbers of the key 1234567, as implementations of SplitMix64 are checked by; a seed
    is where a game stands.
    """
    first = [6457827717110365317, 3203168211198807973, 9817491932198370423, 4593380528125082431]
    u = [(z >> 11) / 2**53 for z in first]
    draws, games = Draws([1234567, 7]), np.array([0])
    assert draws.seeds(games).tolist() == [1234567]
    draws.begin(games, [1234567])
    assert draws.uniform(games, 3).tolist() == [u[:3]] and draws.uniform(games, 1).tolist() == [
        u[3:]
    ]
    draws.begin(games, [1234567])
    assert draws.uniform(np.array([1, 0]), 2)[1].tolist() == u[:2]


def test_a_pot_and_a_scratch_by_hand():
    rules = Potting(balls=1, strokes=3)
    centres, phi = lined_up(rules)
    layout = rules.layout(centres)
    stroke = rules.play(layout, rules.actions(phi, 2.0, b=-0.2))
    assert (stroke.potted, stroke.scratch, stroke.rewards, stroke.status) == (1, False, 1.0, 0)
    assert stroke.cleared
    # Without the other ball in its way the cue ball goes down instead; put back, it lies on the
    # table, clear of the other.
    moved = rules.layout([centres[0], [0.6, 2.0]])
    foul = rules.play(moved, rules.actions(phi, 2.0))
    assert (foul.potted, foul.scratch, foul.rewards, foul.cleared) == (0, True, -1.0, False)
    back = foul.layouts.copy()
    rules.put_back(back[np.newaxis], Draws([2]), np.arange(1))
    assert rules.play(back, rules.actions(0.0, 0.5)).status == 0
    assert_array_equal(back[1], foul.layouts[1])


def test_a_ball_that_leaves_the_table_is_a_foul_and_taken_back():
    """The first stroke jumps over a cushion, which a level cue does not do."""
    rules = Potting(balls=3)
    layout = rules.layout([[0.5, 1.0], [0.9, 0.5], [0.9, 1.0], [0.9, 1.5]])
    cues = carom.cue(phi=180.0, speed=[12.0, 3.0], theta=[20.0, 0.0])
    strokes = rules._played(layout, cues)
    assert carom.simulate_batch(rules.table, layout, cues).final["label"][:, 0].tolist() == [
        carom.Label.OFF,
        carom.Label.STATIONARY,
    ]
    assert (
        strokes.foul[0] != 0
        and strokes.rewards[0] == -1.0
        and strokes.layouts[0].tobytes() == layout.tobytes() != strokes.layouts[1].tobytes()
    )


def test_strokes_are_those_of_simulate():
    rules = Potting(balls=5)
    layout = rules.deal(Draws([3]), np.arange(1))[0]
    actions = rules.actions([10.0, 170.0, -60.0], [1.0, 3.0, 6.0], a=[0.3, 0.0, -0.1], b=0.2)
    strokes = rules.play(layout, actions)
    for k, action in enumerate(actions):
        shot = rules.shot(layout, rules.cues(action))
        assert same_bits(strokes.layouts["state"][k], shot.final)
        alone = carom.simulate(
            rules.table,
            layout,
            carom.cue(
                phi=180 * action[0], speed=3.75 + 3.25 * action[1], a=[0.3, 0, -0.1][k], b=0.2
            ),
        )
        assert_allclose(shot.final["r"], alone.final["r"], atol=1e-9)


def test_a_stroke_in_error_is_taken_back():
    table = carom.tables.pool_9ft()
    # Without the cushions of one long side a ball can leave the table.
    behind_rail = (table.rails["p"][:, 0] > 0.1) | (table.rails["q"][:, 0] > 0.1)
    opened = carom.Table(
        table.width,
        table.length,
        rails=table.rails[behind_rail],
        jaws=table.jaws,
        pockets=table.pockets,
    )
    rules = Potting(balls=1, table=opened)
    layout = rules.layout([[0.4, 0.9], [1.0, 2.0]])
    stroke = rules.play(layout, rules.actions(180.0, 4.0))
    assert stroke.status < 0 and stroke.rewards == -1.0 and not stroke.scratch
    assert same_bits(stroke.layouts, layout)


def test_any_game_keeps_the_rules():
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print(f"seed {seed}")
    generator = np.random.default_rng(seed)
    rules = Potting(balls=4, strokes=30, cushion_model="han")
    low, high = rules.bounds()
    draws = Draws(generator.integers(2**63, size=300))
    layouts = rules.deal(draws, np.arange(300))
    assert np.unique(layouts["state"]["r"], axis=0).shape[0] == 300
    down = np.zeros((300, 4), bool)
    for left in range(29, 9, -1):
        actions = generator.uniform(-1.2, 1.2, (300, 4))
        stroke = rules.play(layouts, actions)
        assert (stroke.status == 0).all()
        pocketed = stroke.layouts["state"]["label"][:, 1:] == carom.Label.POCKETED
        assert (pocketed >= down).all(), "a ball came back"
        assert_array_equal(stroke.potted, (pocketed & ~down).sum(axis=1))
        assert_array_equal(stroke.rewards, stroke.potted - (stroke.foul != 0))
        assert (stroke.foul[stroke.scratch] == carom.Foul.CUE_BALL).all()
        down, layouts = pocketed, stroke.layouts
        back = np.flatnonzero(stroke.scratch)
        repeat = layouts[back]
        rules.put_back(repeat, draws, back)
        layouts[back] = repeat
        seen = rules.observe(layouts, left)
        assert ((seen >= low) & (seen <= high)).all()
        repeat = rules.layouts(seen)
        in_play = repeat["state"]["label"] != carom.Label.POCKETED
        assert same_bits(repeat[in_play], layouts[in_play])
        assert_array_equal(in_play[:, 1:], ~down)
    assert down.any() and not down.all()


def test_noise_of_execution():
    """Its standard deviations, in degrees, m/s and radii; and `play` has none."""
    rules = Potting(noise=(2.0, 0.3, 0.05))
    actions = np.tile(rules.actions(179.0, 2.0, a=0.1), (4000, 1))
    games = np.arange(4000)
    done = rules.cues(actions, Draws(games).seeds(games))
    turn = (done["phi"] - 179.0 + 180.0) % 360.0 - 180.0
    for deviation, values in (
        (2.0, turn),
        (0.3, done["speed"] - 2.0),
        (0.05, done["a"] - 0.1),
        (0.05, done["b"]),
    ):
        assert abs(values.mean()) < 4 * deviation / 63 and abs(values.std() / deviation - 1) < 0.05
    layout = rules.deal(Draws([1]), np.arange(1))[0]
    exact, game = Potting(), Draws([5])
    strokes = exact.turn(
        layout[np.newaxis], np.zeros((1, 0), np.uint64), actions[:1], game, games[:1]
    )
    assert same_bits(strokes.cues, exact.cues(actions[:1])) and same_bits(
        strokes.strokes.layouts, rules.play(layout, actions[:1]).layouts
    )
    # One of a seed is that of carom.with_errors.
    assert same_bits(done[7], carom.with_errors(exact.cues(actions[7]), rules.player(), 7))


def test_random_parameters_ball_sets_and_rewards():
    rules = Potting(balls=2, parameters={"mu_slide": (0.1, 0.3), "restitution_cushion": (0.7, 0.9)})
    layouts = rules.deal(Draws(np.arange(500)), np.arange(500))
    for name, low, high in (("mu_slide", 0.1, 0.3), ("restitution_cushion", 0.7, 0.9)):
        drawn = layouts["kind"][name]
        assert (
            (drawn == drawn[:, :1]).all()
            and low <= drawn.min() < low + 0.02
            and high - 0.02 < drawn.max() < high
        )
    strokes = rules.play(layouts[:, :], rules.actions(30.0, 3.0))
    assert len(np.unique(strokes.time)) == 500 and same_bits(
        strokes.layouts["kind"], layouts["kind"]
    )
    snooker = Potting(ball_set="snooker")
    assert (
        snooker.radius == carom.racks.snooker(carom.tables.snooker())["kind"]["radius"][0]
        and snooker.table == carom.tables.snooker()
    )
    close = Potting(
        balls=1,
        reward=lambda balls, strokes: -np.linalg.norm(
            strokes.layouts["state"]["r"][..., 0, :2], axis=-1
        ),
    )
    played = close.play(close.layout([[0.5, 0.5], [0.9, 1.5]]), close.actions([0.0, 90.0], 1.0))
    assert_allclose(played.rewards, -np.hypot(*played.layouts["state"]["r"][:, 0, :2].T))


# ---- The environments
# -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("action", "message"),
    [
        ("hit", "'hit' does not consist of real numbers"),
        (np.zeros((2, 4)), r"the shape is \(2, 4\), but must be \(4,\)"),
        ([0, 0, 0], r"the shape is \(3,\), but must be \(4,\)"),
        ([5, 0, 0, 0], r"5, at \[0\], is not from -1 to 1"),
        ([0, 0, 0, np.nan], r"nan, at \[3\], is not from -1 to 1"),
        (None, "None does not consist of real numbers"),
    ],
)
def test_an_action_outside_of_its_space_says_what_is_right(gymnasium, action, message):
    game = gymnasium.make("carom/Potting-v1").unwrapped
    game.reset(seed=1)
    with pytest.raises((TypeError, ValueError), match=f"^action: {message}"):
        game.step(action)
    games = gymnasium.make_vec("carom/Potting-v1", num_envs=3)
    games.reset(seed=1)
    with pytest.raises((TypeError, ValueError), match="^actions: "):
        games.step([[0, 0, 0, 0], [0, 0, -1.5, 0]] if action is None else action)
    # single precision rounds 1
    game.step(np.full(4, 1.0 + 1e-7))


@pytest.mark.parametrize("render_mode", [None, "svg", "rgb_array"])
def test_gymnasiums_checkers(gymnasium, render_mode):
    """That of an environment, and the passive one of what make() gives; neither warns."""
    from gymnasium.utils.env_checker import check_env

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gymnasium.make(
            "carom/Potting-v1",
            render_mode=render_mode,
            cushion_model="han",
            disable_env_checker=False,
        )
        check_env(env.unwrapped)
        env.reset(seed=1)
        env.step(env.action_space.sample())
        env.render()
        env.close()


@pytest.mark.parametrize("mode", ["NextStep", "SameStep", "Disabled"])
def test_games_that_have_ended(gymnasium, mode):
    """Each mode gives what gymnasium's own vector of single games gives."""
    from gymnasium.vector import AutoresetMode, SyncVectorEnv

    import carom.gymnasium

    rules = {"balls": 2, "strokes": 2, "noise": (0.3, 0.1, 0.01)}
    many = carom.gymnasium.GameVectorEnv(5, autoreset_mode=mode, **rules)
    singles = SyncVectorEnv(
        [lambda: carom.gymnasium.GameEnv(**rules)] * 5, autoreset_mode=AutoresetMode(mode)
    )
    assert many.metadata["autoreset_mode"] is AutoresetMode(mode)
    assert np.array_equal(many.reset(seed=3)[0], singles.reset(seed=3)[0])
    rng, ends = np.random.default_rng(1), 0
    for turn in range(9):
        if turn == 4:  # some begin anew before they have ended
            mask = np.array([True, False, False, True, False])
            seeds = [7, None, None, 8, 9]
            begun = many.reset(seed=seeds, options={"reset_mask": mask, "strokes": 1})[0]
            expected = singles.reset(seed=seeds, options={"reset_mask": mask, "strokes": 1})[0]
            assert np.array_equal(begun, expected)
        actions = rng.uniform(-1.0, 1.0, (5, 4))
        found, expected = many.step(actions), singles.step(actions)
        for k in range(4):
            assert np.array_equal(found[k], expected[k]), (turn, k)
        same_infos(found[4], expected[4])
        ends += int(found[2].sum())
        if mode == "Disabled" and found[2].any():
            with pytest.raises(
                gymnasium.error.ResetNeeded,
                match=r"games \[.*\] have ended; call reset\(options=\{'reset_mask': ended\}\) to restart them",
            ):
                many.step(actions)
            options = {"reset_mask": found[2]}
            begun = many.reset(options=dict(options))[0]
            assert np.array_equal(begun, singles.reset(options=dict(options))[0])
    assert ends > 10


def same_infos(found, expected):
    """Where a value is not set, it does not count."""
    assert found.keys() >= expected.keys()
    assert not any(np.any(found[name]) for name in found if name not in expected and name[0] == "_")
    for name in (name for name in expected if name[0] != "_"):
        mask = expected["_" + name]
        assert np.array_equal(found["_" + name], mask), name
        if name == "final_info":
            same_infos(found[name], expected[name])
        else:
            assert all(
                np.array_equal(found[name][k], expected[name][k]) for k in np.flatnonzero(mask)
            )


# A call, the class of its error, and a pattern with which its message begins.
REFUSALS = [
    (
        lambda: carom.gymnasium.GameVectorEnv(2, autoreset_mode="later"),
        ValueError,
        "autoreset_mode: unknown value 'later'; use 'NextStep', 'SameStep' or 'Disabled'",
    ),
    (
        lambda: carom.gymnasium.GameEnv(render_mode="human"),
        ValueError,
        "render_mode: must be None, 'svg' or 'rgb_array', not 'human'",
    ),
    (
        lambda: carom.gymnasium.GameEnv("threecushion", table=carom.tables.pool_9ft()),
        ValueError,
        "table: it has pockets; this game needs a table without them",
    ),
    (
        lambda: carom.gymnasium.GameEnv("nineball", strokes=30).reset(
            options={"layout": np.zeros((10, 2))}
        ),
        ValueError,
        "layout: a match begins|strokes: 31 is not 1 to 30, the number of the environment",
    ),
    (
        lambda: carom.gymnasium.GameEnv("nineball", strokes=30).reset(options={"strokes": 31}),
        ValueError,
        "layout: a match begins|strokes: 31 is not 1 to 30, the number of the environment",
    ),
    (
        lambda: carom.gymnasium.GameEnv("snooker"),
        ValueError,
        "game: unknown value 'snooker'; use 'potting', 'threecushion', 'break', 'nineball', 'eightball' or 'match'",
    ),
    (lambda: Match(opponent_shots=0), ValueError, "opponent_shots"),
    *(
        (
            lambda game=game: carom.gymnasium.GameVectorEnv(2, game, threads=2),
            TypeError,
            r'threads: matches are played sequentially; omit threads, or use gymnasium\.make_vec\(id, games, vectorization_mode="async"\) for',
        )
        for game in ("nineball", "eightball")
    ),
    *(
        (
            lambda mask=mask: carom.gymnasium.GameVectorEnv(2).reset(options={"reset_mask": mask}),
            ValueError,
            r".*reset_mask: .*, but must be bool of shape \(2,\)",
        )
        for mask in ([True], np.zeros(2, bool), np.ones(2), np.ones((2, 1), bool))
    ),
]


@pytest.mark.parametrize(("call", "error", "message"), by_line(REFUSALS))
def test_refusals(gymnasium, call, error, message):
    refused(call, error, message)


def test_the_first_reset_is_of_all_games(gymnasium):
    options = {"reset_mask": np.array([True, False])}
    environments = carom.gymnasium.GameVectorEnv(2)
    refused(
        lambda: environments.reset(options=options),
        gymnasium.error.ResetNeeded,
        ".*the first reset",
    )


@pytest.mark.parametrize("threads", [0, 2])
def test_many_games_are_single_games(gymnasium, threads):
    """Against gymnasium's own vector of single environments: observations, rewards, ends and infos
    to the bit, over many games.
    """
    seed = int(np.random.SeedSequence().generate_state(1)[0] // 2)
    print(f"seed {seed}")
    arguments = {
        "balls": 3,
        "strokes": 4,
        "cushion_model": "han",
        "noise": (0.5, 0.1, 0.02),
        "parameters": {"mu_roll": (0.005, 0.015)},
    }
    envs = gymnasium.make_vec("carom/Potting-v1", num_envs=7, threads=threads, **arguments)
    singles = gymnasium.make_vec(
        "carom/Potting-v1", num_envs=7, vectorization_mode="sync", **arguments
    )
    assert (
        type(envs.unwrapped).__name__ == "GameVectorEnv"
        and type(singles).__name__ == "SyncVectorEnv"
    )
    assert (
        envs.observation_space == singles.observation_space
        and envs.action_space == singles.action_space
    )
    assert envs.metadata["autoreset_mode"] == singles.metadata["autoreset_mode"]
    generator = np.random.default_rng(seed)
    ended = 0
    for got, expected in (
        (envs.reset(seed=seed), singles.reset(seed=seed)),
        (envs.reset(), singles.reset()),
    ):
        assert same_bits(got[0], expected[0]) and got[1] == expected[1] == {}
    for _ in range(40):
        actions = generator.uniform(-1.0, 1.0, (7, 4))
        got, expected = envs.step(actions), singles.step(actions)
        for ours, theirs in zip(got[:4], expected[:4], strict=True):
            assert ours.dtype == theirs.dtype and same_bits(ours, theirs)
        assert got[0] in envs.observation_space
        assert got[4].keys() == expected[4].keys()
        for name, values in got[4].items():
            assert values.dtype == expected[4][name].dtype
            assert_array_equal(values, expected[4][name], err_msg=name)
        ended += got[2].sum()
    assert ended > 40
    seeds = [5, None, 7, None, None, 5, 1]
    assert same_bits(envs.reset(seed=seeds)[0], singles.reset(seed=seeds)[0])


def test_a_step_before_a_reset_says_what_is_needed(gymnasium):
    for env, action in (
        (carom.gymnasium.GameEnv(), np.zeros(4)),
        (carom.gymnasium.GameVectorEnv(3), np.zeros((3, 4))),
    ):
        with pytest.raises(gymnasium.error.ResetNeeded, match=r"call reset\(\)"):
            env.step(action)
        env.reset(seed=1)
        env.step(action)


def test_a_step_of_one_game_makes_few_calls(gymnasium, calls):
    """Those of C included.

    A shot takes some microseconds, and so does every few calls of Python.
    """
    env = gymnasium.make("carom/Potting-v1").unwrapped
    env.reset(seed=1)
    action = env.rules.actions(10.0, 1.0)
    env.step(action)
    assert calls(lambda: env.step(action)) <= 170


def test_what_a_step_costs(gymnasium):
    """The example prints a row for each environment, and for threads where they are taken."""
    script = EXAMPLE.with_name("games_speed.py")
    ran = run_python(script, 1)
    assert ran.stdout.count(" steps/s ") == 15, ran.stdout


def test_many_games_are_one_batch(gymnasium, calls):
    """A step of many games, resets included, makes hardly more calls than one of few: no game has a
    loop of its own in Python.
    """
    most = []
    for count in (8, 256):
        envs = gymnasium.make_vec(
            "carom/Potting-v1", num_envs=count, strokes=5, cushion_model="han"
        )
        envs.reset(seed=1)
        actions = np.random.default_rng(1).uniform(-1.0, 1.0, (6, count, 4))
        most.append(max(calls(lambda: envs.step(action)) for action in actions))  # noqa: B023
    assert most[1] < most[0] + 120, most  # chunks of a batch, and places that are drawn again


def test_reset_options(gymnasium):
    env = gymnasium.make("carom/Potting-v1", balls=2, strokes=6)
    centres, phi = lined_up(env.unwrapped.rules)
    seen, _ = env.reset(seed=1, options={"layout": centres, "strokes": 2})
    assert_array_equal(seen[:-1].reshape(3, 3), np.column_stack([centres, np.ones(3)]))
    action = env.unwrapped.rules.actions(phi, 2.0, b=-0.2)
    seen, reward, terminated, truncated, info = env.step(action)
    assert (reward, terminated, truncated, info["potted"], seen[-1]) == (1.0, False, False, 1, 1.0)
    assert seen[3:6].tolist() == [0.0, 0.0, 0.0]
    assert env.step(action)[2]  # the last stroke
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(action)
    for options, words in (
        ({"strokes": 7}, "strokes: 7 is not 1 to 6, the number of the environment"),
        ({"ball": 3}, "unknown option 'ball'; use layout or strokes"),
        ({"layout": centres[:2]}, r"layout: the shape is \(2, 2\), but must be \(3, 2\)"),
    ):
        with pytest.raises(ValueError, match=words):
            env.reset(options=options)
    envs = gymnasium.make_vec("carom/Potting-v1", num_envs=2, balls=2, strokes=6)
    seen, _ = envs.reset(seed=1, options={"layout": np.stack([centres, centres + 0.01])})
    assert_array_equal(seen[1, :2], centres[0] + 0.01)
    with pytest.raises(ValueError, match="layout: there are 3 layouts for 2 games"):
        envs.reset(options={"layout": np.stack([centres] * 3)})
    with pytest.raises(ValueError, match=r"actions: the shape is .*, but must be \(2, 4\)"):
        envs.step(np.zeros((3, 4)))


@pytest.mark.release  # which installs MoviePy, for one film
def test_a_film_is_recorded(gymnasium, tmp_path):
    pytest.importorskip("moviepy")
    from gymnasium.wrappers import RecordVideo

    env = RecordVideo(
        gymnasium.make("carom/Potting-v1", render_mode="rgb_array", balls=2, strokes=3),
        str(tmp_path / "films"),
        episode_trigger=lambda k: True,
    )
    env.reset(seed=1)
    for _ in range(3):
        env.step(env.action_space.sample())
    env.close()
    assert [
        path.suffix for path in (tmp_path / "films").iterdir() if path.stat().st_size > 1000
    ] == [".mp4"]


def test_pictures(gymnasium):
    envs = gymnasium.make_vec("carom/Potting-v1", num_envs=2, balls=2, strokes=5, render_mode="svg")
    envs.reset(seed=4)
    still = envs.render()
    envs.step(np.full((2, 4), 0.3))
    for still_picture, picture in zip(still, envs.render()):
        assert (
            ElementTree.fromstring(still_picture).tag
            == ElementTree.fromstring(picture).tag
            == "{http://www.w3.org/2000/svg}svg"
        )
        assert picture.count("polyline") > still_picture.count("polyline")
    images = gymnasium.make_vec(
        "carom/Potting-v1", num_envs=2, balls=2, strokes=5, render_mode="rgb_array"
    )
    images.reset(seed=4)
    still = images.render()
    images.step(np.full((2, 4), 0.3))
    for still_picture, picture in zip(still, images.render()):
        assert still_picture.dtype == np.uint8 and still_picture.shape == picture.shape == (
            490,
            872,
            3,
        )
        # the cue ball is white where it lay, and elsewhere afterwards
        assert (still_picture == 255).all(axis=-1).any() and (still_picture != picture).any(
            axis=-1
        ).sum() > 200


def test_the_greedy_agent_does_better_than_chance(gymnasium, tmp_path):
    """Paired over 40 games with the same layouts: the mean difference is above 0 by ten of its
    standard errors.
    """
    spec = importlib.util.spec_from_file_location("game_agents", EXAMPLE)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    picture = tmp_path / "potting.svg"
    line = [
        "--game",
        "carom/Potting-v1",
        "--strokes",
        "3",
        "--games",
        "40",
        "--seed",
        "7",
        "--out",
        str(picture),
    ]
    played = example.main([*line, "--plans", "100"])
    by_chance, by_greed, planned = played.values()
    more = by_greed - by_chance
    assert more.mean() > 10.0 * more.std(ddof=1) / np.sqrt(len(more))
    assert by_greed.mean() > 3.0 and by_greed.max() <= 5.0
    assert ElementTree.parse(picture).getroot().tag.endswith("svg")
    assert (
        list(played) == ["random", "greedy", "plan of 100 shots"]
        and planned.mean() > 1.0 + by_chance.mean()
    )
    assert_array_equal(example.main([*line, "--plans", ""])["random"], by_chance)


@pytest.mark.parametrize(
    "name", ["PotOne", "RunOutSix", "ThreeCushion", "Break", "NineBall", "EightBall"]
)
def test_games_with_fixed_rules(gymnasium, name):
    """Each id is a game that both makers know, with the errors of `carom.player(2)` at 2 m/s; one that is
    the vector's first is its own, to its end.
    """
    from gymnasium.utils.env_checker import check_env

    name = f"carom/{name}-v1"
    rules = carom.gymnasium.GAMES[name]
    player = carom.player(2)
    grown = np.hypot(1.0, 2.0 * player["growth"])
    noise = grown * player["phi"], 2.0 * player["speed_share"], grown * player["a"]
    assert_allclose(rules["noise"], noise, rtol=1e-12)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(
            gymnasium.make(name, render_mode="rgb_array", disable_env_checker=False).unwrapped
        )
        alone = gymnasium.make(name, render_mode="svg", disable_env_checker=False)
    many = gymnasium.make_vec(name, num_envs=3)
    seen, _ = alone.reset(seed=5)
    assert_array_equal(seen, many.reset(seed=5)[0][0])
    fixed_rules, generator, ended = alone.unwrapped.rules, np.random.default_rng(3), False
    assert alone.observation_space.shape == seen.shape and fixed_rules.noise == rules["noise"]
    for k in range(4):
        # A planner's stroke of few shots, and strokes at random.
        action = (
            fixed_rules.best_seen(seen, shots=100)
            if k == 0
            else generator.uniform(-1.0, 1.0, fixed_rules.acts)
        )
        assert alone.action_space.contains(action.astype(np.float32)) and fixed_rules.tried(
            seen, action[np.newaxis]
        ).shape == (1,)
        seen, reward, ended, truncated, info = alone.step(action)
        of_many = many.step(np.tile(action, (3, 1)))
        assert_array_equal(seen, of_many[0][0])
        assert (reward, ended, truncated) == (
            of_many[1][0],
            of_many[2][0],
            False,
        ) and seen in alone.observation_space
        assert {key: values[0] for key, values in of_many[4].items() if key[0] != "_"} == info
        assert alone.render().startswith("<svg")
        if ended:
            break


def test_points_of_three_cushion(gymnasium):
    """Those of the rules, stroke by stroke; the balls stay."""
    rules = carom.gymnasium.RULES["threecushion"](strokes=3)
    layouts = rules.deal(Draws(range(200)), np.arange(200))
    actions = np.random.default_rng(2).uniform(-1.0, 1.0, (200, 4))
    strokes = rules.play(layouts, actions)
    cues = rules.cues(actions)
    for k in range(200):
        ruling = carom.referee(rules.table, layouts[k], cues[k], rules="threecushion")
        assert strokes.rewards[k] == ruling.points and (strokes.potted[k], strokes.scratch[k]) == (
            0,
            False,
        )
        assert same_bits(strokes.layouts["state"]["r"][k], ruling.balls["state"]["r"])
    best = np.stack([rules.best(layout, shots=300) for layout in layouts[:20]])
    assert rules.play(layouts[:20], best).rewards.sum() >= 10 > strokes.rewards[:20].sum()


def test_the_break(gymnasium):
    """The cue ball lies where the action says, behind the head string; rewards are those of the
    rules of nine-ball.
    """
    rules = carom.gymnasium.RULES["break"]()
    layouts = rules.deal(Draws(range(40)), np.arange(40))
    assert np.unique(layouts["state"]["r"], axis=0).shape[0] == 40
    actions = np.concatenate(
        [np.tile(rules.actions(90.0, 9.0), (40, 1)), np.zeros((40, 2))], axis=1
    )
    actions[:, 4] = np.linspace(-1.0, 1.0, 40)
    actions[20:, 1] = -0.9
    strokes = rules.play(layouts, actions)
    laid = rules.placed(layouts, actions)
    low, high = rules.corners()
    assert_allclose(laid["state"]["r"][[0, 39], 0, 0], [low[0], high[0]], rtol=1e-15)
    assert (strokes.rewards[20:] == -1.0).all()
    for k in range(40):
        ruling = carom.referee(
            rules.table, laid[k], rules.cues(actions[k]), rules="nineball", opening=True
        )
        assert strokes.rewards[k] == len([ball for ball in ruling.potted if ball]) - bool(
            ruling.foul
        )
    assert rules.tried(rules.observe(layouts, 1)[0], rules.best(layouts[0], shots=100)) in range(
        -1, 10
    )


def test_a_match(gymnasium):
    """The agent plays until a foul or a miss; then the opponent does until the agent plays again,
    by the rules of pool, or has won.
    """
    env = carom.gymnasium.GameEnv("nineball", strokes=30)
    observation, _ = env.reset(seed=4)
    ended = False
    for _ in range(30):
        position = env.rules.seen(observation)
        assert position.player == 0 and position.winner is None
        # a soft stroke away from the rack is always a foul: three of them lose, and the opponent
        # plays between
        observation, reward, ended, _, info = env.step([-0.5, -1.0, 0.0, 0.0, 0.0, 0.0])
        assert info["foul"] != 0
        if ended:
            break
        assert observation[30] == 2.0 or env.rules.seen(observation).fouls[0] > 0
    assert ended and reward == -1.0 and observation[-1] >= 27


@pytest.mark.parametrize("game", ["nineball", "eightball"])
def test_the_opponent_is_stopped_by_shots(monkeypatch, game):
    """With few shots he does not plan, tries at most so many strokes, and still runs balls out."""
    import carom.games.pool as pool

    tried = []
    played = pool.Pool.played
    monkeypatch.setattr(
        pool.Pool,
        "played",
        lambda *arguments: (tried.append(arguments[2].size), played(*arguments))[1],
    )
    monkeypatch.setattr(pool, "plan", lambda *arguments, **named: pytest.fail("a plan was made"))
    rules = Match(game, opponent=carom.player(0.0), opponent_shots=12)
    potted, visits = 0, 20
    for seed in range(visits):
        position = rules.pool.begin(seed)
        position, _ = rules.pool.play(position, [0.5, 0.9, 0.0, 0.2, 0.0, 0.0])
        position = replace(position, player=1, hand=Hand.ANYWHERE, winner=None)
        count_down = (position.balls["state"]["label"] == carom.Label.POCKETED).sum()
        tried.clear()
        position_after = rules._visit(position)
        assert 0 < max(tried) <= 12
        potted += (
            position_after.balls["state"]["label"] == carom.Label.POCKETED
        ).sum() - count_down
    assert potted > 1.5 * visits
    monkeypatch.setattr(pool, "plan", lambda *arguments, **named: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        Match(game, opponent_shots=100)._visit(position)


def test_the_planner_plays_the_level_cue_of_the_game():
    """The stroke is that of the plan, whose cue would be raised over the cushion behind the ball."""
    rules = Potting(1, 1)
    layout = rules.layout([[0.04, 1.0], [0.5, 0.7]])
    raised, level = (
        carom.plan(
            rules.table, layout, rules="potting", player=rules.player(), shots=200, best=1, level=k
        )[0]["cue"]
        for k in (False, True)
    )
    assert raised["theta"] > 5.0 and level["theta"] == 0.0
    assert_array_equal(
        rules.best(layout, shots=200),
        rules.actions(level["phi"], level["speed"], level["a"], level["b"]),
    )


def test_the_planner_pots_more_than_chance():
    rules = Potting(3, 3, cushion_model="han", noise=(0.1, 0.1, 0.003))
    draws = Draws(range(6))
    games = np.arange(6)
    layouts = rules.deal(draws, games)
    by_plan = np.stack([rules.best(layout, shots=200) for layout in layouts])
    assert (np.abs(by_plan) <= 1.0).all()
    assert rules.play(layouts, by_plan).potted.sum() >= 4
    rest = rules.play(layouts, np.random.default_rng(1).uniform(-1.0, 1.0, (6, 4))).potted.sum()
    assert rest < 4
