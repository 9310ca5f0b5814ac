"""What a fit plays is what a shot plays: the numbers of every game, tables with pockets, balls that
leave the table, and shots of different numbers of balls.
"""

import json
import os
import subprocess
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from conftest import RELEASE, same_bits
from test_tracks import csv_of

import carom
from carom import _described, tracks
from carom.layouts import GAMES
from carom.tracks import _constants, _strikes, fit

NOISE = 1e-4  # m, of the synthetic recordings
NOISY = 1.3 * NOISE * np.sqrt(2.0)  # m: an RMSE that is no more than the noise


def seen(shot, names, start=1.0, rate=50.0, noise=NOISE, seed=0):
    """A recording of a played shot by a camera, whose rows end where a ball falls."""
    t = np.arange(0.0, start + min(shot.time, 3.0) + 0.3, 1.0 / rate)
    places = shot.positions(np.clip(t - start, 0.0, shot.time))[..., :2]
    places += np.random.default_rng(seed).normal(0.0, noise, places.shape)
    ends = np.full(len(names), np.inf)
    falls = shot.events[shot.events["type"] == carom.EventType.POCKET]
    ends[falls["a"]] = falls["time"] + start
    return tracks.Recording(
        seed,
        tuple(names),
        tuple(
            np.column_stack([t, places[:, ball]])[t < end] for ball, end in enumerate(ends.tolist())
        ),
    )


def off_of_the_truth(found, k, shot):
    """The RMSE of the true strike of a recording by `seen`, from the places that the camera saw."""
    plays, state = found._plays([k]), shot.states(np.array([1e-7]))[0]
    v, w = state["v"][0, :2], found.radius * state["w"][0]
    return float(plays.rmse(np.array([[*v, *w, 1.0 - plays.origins[0]]]))[0])


# ---- One reading of a game's numbers


@pytest.mark.filterwarnings("ignore:cushion_model", "ignore:balls")
@pytest.mark.parametrize("friction", get_args(_described.BallFriction))
@pytest.mark.parametrize("game", GAMES)
def test_a_fit_plays_the_numbers_of_a_shot(game, friction):
    """For each model of the cushion: the same bits, and a fit of the shot comes down to the noise.

    Before a release each is fitted, otherwise one of each game.
    """
    size, radius = (1.27, 2.54), float(carom.balls([[0, 0]], game=game)["kind"]["radius"][0])
    ground = _constants.ground(size, radius, game)
    models, frictions = get_args(_described.ShotCushion), get_args(_described.BallFriction)
    number = list(GAMES).index(game)
    chosen = models[number % len(models)]
    for model in models:
        balls = carom.balls([[0.4, 0.5], [0.7, 1.3]], game=game, cushion_model=model)
        cue = carom.cue(ball_speed=2.2, phi=68.2, a=0.2, b=0.3, game=game)
        how = {"cushion_model": model, "friction": friction, "game": game}
        shot = carom.simulate(ground.table, balls, cue, cushion_model=model, friction=friction)
        constants, cushion = _constants.complete({}, model, game=game, friction=friction)
        given = {"friction": friction, "table": ground.table}
        assert constants == _constants.complete(balls["kind"][0], model, **given)[0]
        known = balls.copy()
        for name, value in constants.items():
            known["kind"][name] = value
        again = carom.simulate(ground.table, known, cue, cushion_model=cushion)
        assert same_bits(again.final, shot.final), model
        is_chosen = model == chosen and friction == frictions[number % len(frictions)]
        if not (RELEASE or is_chosen):
            continue
        found = fit.fit([seen(shot, ("cue", "red"))], size, radius, free="none", **how)
        # contacts magnify the errors of places of rest, also where the strike is the true one
        most = max(NOISY, off_of_the_truth(found, 0, shot))
        assert found.rmse[0] < most and found.cushion_model == cushion, (model, found.rmse)


# ---- Tables with pockets


def placed(random, ground, count):
    """Places of balls at random, apart from each other."""
    while True:
        places = random.uniform(0.15, np.array(ground.size) - 0.15, (count, 2))
        gaps = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
        if (gaps + np.eye(count) > 0.2).all():
            return places


def potting(random, ground, pots=True):
    """A played shot, which pots the second of three balls within 2.5 s if it is to, and otherwise
    goes to it or thereabouts.
    """
    while True:
        balls = carom.balls(placed(random, ground, 3), game=ground.game)
        r = balls["state"]["r"][:, :2]
        hole = ground.table.pockets["centre"][random.integers(len(ground.table.pockets))]
        away = (r[1] - hole) / np.hypot(*(r[1] - hole))
        way = r[1] + pots * 2.0 * ground.radius * away - r[0]
        if pots and way @ -away < 0.7 * np.hypot(*way):
            continue
        aim = np.degrees(np.arctan2(way[1], way[0])) + (0.0 if pots else random.uniform(-1.0, 1.0))
        speed, side, follow = random.uniform([1.5, -0.2, -0.2], [3.0, 0.2, 0.4])
        cue = carom.cue(ball_speed=speed, phi=aim, a=side, b=follow, game=ground.game)
        shot = carom.simulate(ground.table, balls, cue)
        falls = shot.events[shot.events["type"] == carom.EventType.POCKET]
        if not pots or (len(falls) and falls["a"][0] == 1 and falls["time"][0] < 2.5):
            return shot


@pytest.mark.parametrize(
    "table",
    ["9ft", *(pytest.param(name, marks=pytest.mark.release) for name in ("snooker", "heyball"))],
)
def test_shots_that_pot_balls_are_fitted_to_their_noise(table):
    random, ground = np.random.default_rng(3), _constants.ground(table)
    played = [potting(random, ground, k < 6) for k in range(8)]
    shots = [seen(shot, ("white", "red", "black"), seed=k) for k, shot in enumerate(played)]
    assert sum(len(shot.tracks[1]) < len(shot.tracks[2]) for shot in shots) >= 5
    found = fit.fit(shots, table, free="none")
    # one search may end at the side spin of the other sign, which throws the red alike
    assert (found.rmse < NOISY).sum() >= 7 and found.rmse.max() < 5e-4, found.rmse
    assert found.game == ground.game and found.radius == ground.radius
    assert np.isfinite(found.strike_covariance(0)).all()


def later(track, r, end=np.inf):
    """Rows after those of a track until an end, at a place."""
    t = np.arange(track[-1, 0] + 0.02, min(track[-1, 0] + 1.5, end), 0.02)
    return np.concatenate([track, np.column_stack([t, np.tile(r, (len(t), 1))])])


def test_tracks_end_where_balls_fall_or_are_taken():
    """However the rest of a track looks; and shots of unlike numbers of balls make one file."""
    random, ground = np.random.default_rng(8), _constants.ground("9ft")
    shot = potting(random, ground)
    whole = seen(shot, ("white", "red", "black"))
    white, red, black = whole.tracks
    hole = ground.table.pockets[shot.events["b"][shot.events["type"] == carom.EventType.POCKET][0]]
    held = later(red, hole["centre"])
    tracks_of = {
        "as it is": whole.tracks,
        "held in the pocket": (white, held, black),
        "drawn behind it": (white, later(red, 2.0 * hole["centre"] - red[-1, 1:]), black),
        "potted out of view": (white, red[red[:, 0] < red[-1, 0] - 0.2], black),
        "laid on its spot": (white, later(later(red, hole["centre"]), [0.635, 1.9]), black),
        "taken by a hand": (white[white[:, 0] < white[-1, 0] - 0.8], red, black),
        "one ball less": (white, red),
        "in a pocket from the first": (white, red, black, held[-20:]),
    }
    shots = [
        tracks.Recording(name, tuple(range(len(rows))), rows) for name, rows in tracks_of.items()
    ]
    found = fit.fit(shots, "9ft", free="none")
    assert (found.rmse < NOISY).all(), dict(zip(tracks_of, found.rmse))
    ends = [len(shot.tracks[1]) for shot in found.recordings]
    assert max(ends) <= len(red) < len(held) and len(found.recordings[-1].balls) == 3

    # a play in which the ball falls costs where its track goes on
    for rows, low, high in ((red, 0.0, NOISY), (later(red, red[-1, 1:]), 0.02, 0.2)):
        shot = tracks.Recording(1, (1, 2, 3), (white, rows, black))
        plays = _strikes.Plays([shot], "9ft", ground.radius, found.constants, "smooth")
        strike = found.strikes[:1] - [0.0, 0.0, 0.0, 0.0, 0.0, plays.origins[0]]
        sums = plays.misfit(np.zeros(1, np.int32), strike, plays.ends, -np.inf)[0]
        assert low <= np.sqrt(sums[1] / sums[2]) < high


def test_places_of_rest_leave_cushions_jaws_pockets_and_other_balls():
    """Of places at pockets that a camera sees 2 mm off; and of racks."""
    for table in ("9ft", "snooker", "heyball", "pyramid"):
        random, ground = np.random.default_rng(1), _constants.ground(table)
        holes, count = ground.table.pockets["centre"], 0
        while count < 60:
            true = holes[random.integers(len(holes))] + random.uniform(-0.14, 0.14, 2)
            balls = carom.balls(true[None], game=ground.game)
            try:
                carom.simulate(ground.table, balls)
            except carom.CaromError:
                continue  # no place of a ball
            count += 1
            r = true + random.normal(0.0, 2e-3, 2)
            r = _strikes.apart(r[None], ground.table, ground.radius)
            assert np.hypot(*(r - true)[0]) < 0.012
            carom.simulate(ground.table, carom.balls(r, game=ground.game))
    for rack, table in (("eightball", "9ft"), ("snooker", "snooker")):
        ground = _constants.ground(table)
        laid = getattr(carom.racks, rack)(ground.table)["state"]["r"][:, :2]
        r = laid + np.random.default_rng(2).normal(0.0, 5e-4, laid.shape)
        r = _strikes.apart(r, ground.table, ground.radius)
        assert np.hypot(*(r - laid).T).max() < 3e-3
        carom.simulate(ground.table, carom.balls(r, game=ground.game))


def test_the_strike_of_a_break_is_that_of_its_first_second():
    """No strike can come nearer than the true one does at the places that the camera sees."""
    random, ground = np.random.default_rng(2), _constants.ground("9ft")
    balls = carom.racks.nineball(ground.table, seed=1)
    way = balls["state"]["r"][1, :2] - balls["state"]["r"][0, :2]
    aim = np.degrees(np.arctan2(way[1], way[0])) + random.uniform(-0.5, 0.5)
    shot = carom.simulate(ground.table, balls, carom.cue(ball_speed=6.0, phi=aim, b=0.1))
    found = fit.fit([seen(shot, range(10), noise=5e-4)], "9ft", free="none")
    assert "a break, of which the first 1 s count" in found.status[0]
    assert found.rmse[0] < off_of_the_truth(found, 0, shot)
    assert np.hypot(*found.strikes[0, :2]) == pytest.approx(6.0, rel=0.05)


def test_the_cushions_of_a_pool_table_are_found_by_shots_on_it():
    random, ground = np.random.default_rng(5), _constants.ground("9ft")
    true = {"restitution_cushion": 0.77, "mu_cushion": 0.24, "mu_slide": 0.22}
    shots = []
    for k in range(8):
        shot = potting(random, ground, pots=k < 3)
        balls = shot.balls.copy()
        for name, value in true.items():
            balls["kind"][name] = value
        shots.append(
            seen(carom.simulate(ground.table, balls, shot.cue), (1, 2, 3), seed=k, noise=5e-4)
        )
    found = fit.fit(shots, "9ft", free=list(true))
    assert {name: found.constants[name] for name in true} == pytest.approx(true, rel=0.02)


@pytest.mark.parametrize("table", ["snooker", "1.27,2.54"])
def test_the_command_takes_the_word_of_a_table(table, tmp_path, capsys):
    ground = (
        _constants.ground("snooker")
        if table == "snooker"
        else _constants.ground((1.27, 2.54), game="pool")
    )
    shot = potting(np.random.default_rng(4), _constants.ground("snooker"), pots=False)
    if table != "snooker":
        balls, cue = carom.balls([[0.4, 0.5], [0.7, 1.3]]), carom.cue(ball_speed=2.0, phi=68.0)
        shot = carom.simulate(ground.table, balls, cue)
    film, out = tmp_path / "t.csv", tmp_path / "fit.json"
    rows = seen(shot, range(len(shot.balls))).tracks
    film.write_text(csv_of([tracks.Recording(1, tuple(range(len(rows))), rows)]))
    more = [] if table == "snooker" else ["--game", "pool"]
    arguments = [str(film), "--table", table, *more, "--free", "none", "-o", str(out)]
    assert fit.main(arguments) == 0
    written, said = json.loads(out.read_text()), capsys.readouterr().out
    assert written["table"] == ("snooker" if table == "snooker" else [1.27, 2.54])
    assert written["game"] == ground.game and written["radius"] == ground.radius
    taken = f"balls of radius {1e3 * ground.radius:.5g} mm, constants of {ground.game} unless given"
    assert taken in said
    assert written["median_rmse"] < NOISY

    # the command plays the same balls
    command = Path(os.environ["CAROM_BUILD"]) / "carom"
    line = {"balls": {"cue": [0.4, 0.5]}, "cue": {"V0": 1.0, "phi": 40.0}}
    shoot = [command, "shoot", "--with", str(out), "--table", "9ft"]
    played = subprocess.run(
        shoot, input=json.dumps(line), capture_output=True, text=True, check=False
    )
    assert played.returncode == 0, played.stderr
