"""A player from film: the errors with which strokes were played are found again."""

import json
from dataclasses import replace

import numpy as np
import pytest

import carom
from carom import fit, tracks
from carom.tracks import _constants

RADIUS, TABLE = 0.03075, (2.84, 1.42)


def filmed(player, kinds, times, seed):
    """Recordings of strokes that a player repeats, each on a layout put up again by hand."""
    random = np.random.default_rng(seed)
    table = _constants.ground(TABLE, RADIUS).table
    shots = []
    for _ in range(kinds):
        places = np.array([[0.5, 0.4], [1.2, 0.7], [2.3, 1.1]]) + random.uniform(
            -0.15, 0.15, (3, 2)
        )
        speed, a, b, turned = random.uniform([1.5, -0.3, -0.1, -1.0], [3.0, 0.3, 0.3, 1.0])
        for _ in range(times):
            rest = places + random.normal(0.0, 3e-3, places.shape)
            line = rest[1] - rest[0]
            aim = np.degrees(np.arctan2(line[1], line[0])) + turned
            meant = carom.cue(speed=speed, phi=aim, a=a, b=b, game="billiard")
            cue = carom.with_errors(meant, player, seed, len(shots))
            shot = carom.simulate(table, carom.balls(rest, game="billiard", radius=RADIUS), cue)
            t = np.arange(0.0, min(shot.time, 4.0) + 0.5, 0.02)
            seen = shot.positions(np.clip(t - 0.5, 0.0, shot.time))[..., :2]
            seen = seen + random.normal(0.0, 5e-4, seen.shape)
            rows = tuple(np.column_stack([t, seen[:, ball]]) for ball in range(3))
            shots.append(tracks.Recording(len(shots), (1, 2, 3), rows))
    return fit.fit(shots, TABLE, RADIUS, free="none")


@pytest.fixture(scope="module")
def found():
    return filmed(carom.player(fargo=500), 4, 6, 3)


def test_errors_and_rating_are_those_of_the_player(found):
    player, true = found.player(), carom.player(fargo=500)
    assert [len(group) for group in player.groups] == [6] * 4
    speed = np.hypot(*found.strikes[:, :2].T).mean()
    grown = np.sqrt(1.0 + (float(true["growth"]) * speed) ** 2)
    for name, factor in (("speed_share", 1.0), ("phi", grown), ("a", grown), ("b", grown)):
        likely = getattr(player, name)
        assert likely.low < factor * float(true[name]) < likely.high, name
        assert likely.low < likely.mean < likely.high < 2.2 * likely.low, name
    assert player.rating.low < 500 < player.rating.high < player.rating.low + 120
    assert player.record["phi"] == pytest.approx(player.phi.mean / grown, rel=0.1)


def test_a_doubtful_strike_is_not_the_players(found):
    """A wrong strike may be like the others, and makes the errors of a player too large."""
    status = ["doubtful: RMSE 8.1 cm, 164 times that of the noise", *found.status[1:]]
    without = replace(found, status=status).player()
    assert without.groups == [group[1:] if 0 in group else group for group in found.player().groups]


def test_a_perfect_player_has_errors_below_the_noise():
    player = filmed(carom.player(0.0), 2, 4, 5).player()
    assert player.phi.high < 0.05 and player.a.high < 0.02 and player.rating.low > 700


def test_the_player_is_that_of_plans(found):
    written = json.loads(json.dumps(found.player().to_dict()))
    assert written["rating"]["mean"] == found.player().rating.mean
    assert written["player"]["phi"] == found.player().record["phi"]
    layout = carom.balls([[0.3, 0.8], [0.9, 1.6]])
    table, record = carom.tables.pool_9ft(), found.player().record
    plans = carom.plan(table, layout, player=record, rules="potting", shots=200)
    assert 0.0 < plans["value"][0] <= 1.0


def test_a_fit_without_a_player_is_written(found, tmp_path, capsys):
    """What cannot be told costs its option, not the fit."""
    rows = [
        f"{shot.id},{ball},{t},{x},{y}\n"
        for shot in found.recordings[::6]
        for ball, track in zip(shot.balls, shot.tracks)
        for t, x, y in track
    ]
    file, out = tmp_path / "tracks.csv", tmp_path / "fit.json"
    file.write_text("shot,ball,t,x,y\n" + "".join(rows), encoding="utf-8")
    asked = f"{file} --table 2.84,1.42 --radius {RADIUS} --free none --player --next 2 -o {out}"
    assert fit.main(asked.split()) == 0
    said = capsys.readouterr().err
    assert "carom.fit: --player: groups: 0 strokes in 0 groups" in said
    assert "carom.fit: --next: design: this fit determined no constants from complete shots" in said
    assert json.loads(out.read_text(encoding="utf-8"))["shots"]


def test_strokes_that_repeat_nothing_tell_no_player(found):
    with pytest.raises(ValueError, match=r"^groups: 2 strokes in 1 groups are too few; at least"):
        found.player([[0, 1]])
