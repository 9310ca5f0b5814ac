"""Recorded tracks: files read, with their errors; synthetic recordings with the traps of real ones."""

import functools
import gzip
import json
import lzma

import numpy as np
import pytest
from conftest import refused_by_name
from spoil import spoiled

from carom import simulate, tracks
from carom.tracks import _constants, fit

TABLE, RADIUS = (2.84, 1.42), 0.03075
# most tests play the cushion of Han, with cloth and balls unlike those of the game
CLOTH = {"mu_slide": 2.02 / 9.81, "mu_roll": 0.0418 / 9.81, "drag": 0.0129, "mu_spin": 0.004}
BALLS = {"restitution": 0.951, "law_a": 0.0448, "law_b": 0.486, "law_c": 1.088}


def _on_a_cloth(call, **usual):
    """A call whose constants are these where none are given; those of Han's cushion alone."""

    @functools.wraps(call)
    def played(first, *, constants=None, cushion_model="han", **how):
        if cushion_model == "han" and (constants is None or isinstance(constants, dict)):
            constants = {**CLOTH, **BALLS, **(constants or {})}
        return call(first, constants=constants, cushion_model=cushion_model, **{**usual, **how})

    return played


synthetic = _on_a_cloth(tracks.synthetic)
fitted = _on_a_cloth(fit.fit, table=TABLE, radius=RADIUS)


def struck(sample, recordings=None, **how):
    """A fit of the strikes alone, with the true constants."""
    known = {"constants": sample.constants, "free": "none", **how}
    return fitted(sample.recordings if recordings is None else recordings, **known)


def csv_of(recordings):
    rows = [
        f"{shot.id},{ball},{t!r},{x!r},{y!r}\n"
        for shot in recordings
        for ball, track in zip(shot.balls, shot.tracks)
        for t, x, y in track.tolist()
    ]
    return "shot,ball,t,x,y\n" + "".join(rows)


def jsonl_of(recordings):
    lines = [
        {"id": s.id, "tracks": {str(b): t.tolist() for b, t in zip(s.balls, s.tracks)}}
        for s in recordings
    ]
    return "".join(json.dumps(line) + "\n" for line in lines)


@pytest.fixture(scope="module")
def sample():
    return synthetic(20, seed=5)


@pytest.mark.parametrize("name", ["a.csv", "a.csv.xz", "a.csv.gz", "a.jsonl", "a.jsonl.xz"])
def test_every_format_gives_the_recordings_back(sample, tmp_path, name):
    text = jsonl_of(sample.recordings) if "jsonl" in name else csv_of(sample.recordings)
    opened = {"xz": lzma.open, "gz": gzip.open}.get(name.rpartition(".")[2], open)
    with opened(tmp_path / name, "wt", encoding="utf-8") as file:
        file.write(text)
    read = tracks.read(tmp_path / name, table=TABLE, radius=RADIUS)
    assert [(shot.id, shot.balls) for shot in read] == [
        (shot.id, shot.balls) for shot in sample.recordings
    ]
    for first, second in zip(read, sample.recordings):
        assert all(np.array_equal(a, b) for a, b in zip(first.tracks, second.tracks))


@pytest.mark.parametrize("rate", [30.0, 120.0])
def test_a_film_in_inches_from_an_origin_of_its_own_is_read_in_metres(sample, tmp_path, rate):
    lines = ["y,note,frame,ball,x,t,shot"]
    for shot in sample.recordings:
        for ball, rows in zip(shot.balls, shot.tracks):
            lines += [
                f"{y / 0.0254 + 3.0},a,0,{ball},{x / 0.0254 + 4.5},{t * rate},{shot.id}"
                for t, x, y in rows
            ]
    path = tmp_path / "film.csv"
    path.write_text("\n".join(lines) + "\n")
    film = {"unit": 0.0254, "origin": (4.5, 3.0), "rate": rate}
    read = tracks.read(path, table=TABLE, radius=RADIUS, **film)
    for first, second in zip(read, sample.recordings):
        assert all(np.allclose(a, b, atol=1e-12) for a, b in zip(first.tracks, second.tracks))
    # without an origin the places do not fit the table in any unit
    with pytest.raises(tracks.TrackError, match="all in metres"):
        tracks.read(path, table=TABLE, radius=RADIUS, unit="m", rate=rate)
    for wrong, argument in (
        ({"unit": 0.0}, "unit"),
        ({"unit": "ells"}, "unit"),
        ({"unit": "px"}, "unit"),
        ({"rate": -1.0}, "rate"),
        ({"origin": (np.nan, 0.0)}, "origin"),
        ({"corners": [(0, 0), (1, 0), (1, 1)], "table": TABLE}, "corners"),
        ({"corners": [(0, 0), (1, 0), (2, 0), (0, 1)], "table": TABLE}, "corners"),
    ):
        with pytest.raises(ValueError, match=f"^{argument}: "):
            tracks.read(path, **wrong)


def test_synthetic_tracks_have_the_traps_of_real_ones(sample):
    for shot, strike in zip(sample.recordings, sample.strikes):
        assert shot.cue == 0
        # the struck ball is first seen under way, no more than a picture after the start
        assert strike[5] < shot.moves[0] < strike[5] + 0.05
        for track in shot.tracks:
            # thinned by displacement, but for the last row, and clamped to the cushions
            assert (np.hypot(*np.diff(track[:-1, 1:], axis=0).T) >= 0.016).all()
            assert (track[:, 1:] >= RADIUS).all() and (
                track[:, 1:] <= np.array(TABLE) - RADIUS
            ).all()
    places = np.concatenate([track[:, 1:] for shot in sample.recordings for track in shot.tracks])
    assert ((places == RADIUS) | (places == np.array(TABLE) - RADIUS)).any()
    repeat, second = synthetic(20, seed=5), synthetic(20, seed=6)
    assert np.array_equal(repeat.recordings[0].tracks[0], sample.recordings[0].tracks[0])
    assert not np.array_equal(second.strikes, sample.strikes)


def test_a_recording_without_motion_has_no_strike():
    still = np.array([[0.0, 1.0, 0.5], [2.0, 1.001, 0.5]])
    with pytest.raises(tracks.TrackError, match="shot 7: no ball moves by more than 3 mm"):
        _ = tracks.Recording(7, (1,), (still,)).cue
    with pytest.raises(ValueError, match="unknown constant 'mu'; did you mean 'mu_slide'"):
        synthetic(1, constants={"mu": 0.2})


def test_one_row_away_from_the_rest_is_no_motion():
    """The far end of a camera's view has more noise than the table has on average."""
    t = np.arange(0.0, 2.0, 0.02)
    track = np.column_stack([t, 1.0 + np.maximum(t - 1.0, 0.0), np.full(len(t), 0.5)])
    track[20, 2] += 4e-3
    shot = tracks.Recording(1, (1,), (track,))
    assert shot.still == [51] and shot.moves[0] == pytest.approx(1.02)
    last = np.array([[0.0, 1.0, 0.5], [2.0, 1.01, 0.5]])  # only the end of a thinned track
    assert tracks.Recording(1, (1,), (last,)).still == [1]


def test_the_struck_ball_is_told_from_one_that_it_touches_at_once():
    """Whatever the noise, and however near the other ball lies: it goes on farther, but away from
    the struck one.
    """
    random, wrong = np.random.default_rng(5), 0
    values = _constants.usual("han")
    world = _constants.rectangle(TABLE, values["nose_height"])
    for gap, rate, noise in (
        (0.002, 50.0, 0.35e-3),
        (0.01, 50.0, 1e-3),
        (0.03, 25.0, 1e-3),
        (0.1, 240.0, 3e-3),
    ):
        shots = []
        for _ in range(20):
            angle, speed = random.uniform(0.0, 6.28), random.uniform(0.7, 4.0)
            centres = np.array([[1.4, 0.7], [1.4, 0.7], [0.3, 0.3]])
            centres[1] += (2 * RADIUS + gap) * np.array([np.cos(angle), np.sin(angle)])
            balls = _constants.layout(centres, RADIUS, values)
            angle += random.normal(0.0, 0.4)
            balls["state"]["v"][0, :2] = speed * np.cos(angle), speed * np.sin(angle)
            shot = simulate(world, balls, cushion_model="han")
            start = random.uniform(0.0, 1.0 / rate)
            seen = tracks._record(
                lambda t: shot.positions(np.maximum(t - start, 0.0))[..., :2],
                2.0,
                rate,
                0.0,
                RADIUS,
                np.array(TABLE) - RADIUS,
                noise,
                random,
            )
            shots.append(tracks.Recording(1, (1, 2, 3), seen, noise))
        wrong += sum(shot.cue != 0 for shot in spoiled(shots, lead_in=0.5, rate=rate, noise=noise))
    assert wrong <= 6


@pytest.fixture(scope="module")
def seen(sample):
    return tracks.events(sample.recordings, TABLE, RADIUS)


def test_pieces_tell_the_friction_of_the_cloth(sample, seen):
    gravity = 9.81
    slide, error = seen.slide
    assert abs(slide - sample.constants["mu_slide"] * gravity) < 0.03 and error < 0.03
    (a, a_error), (b, b_error) = seen.roll
    assert (
        abs(a - sample.constants["mu_roll"] * gravity) < max(3 * a_error, 1e-3) and a_error < 2e-3
    )
    assert abs(b - sample.constants["drag"]) < max(3 * b_error, 2e-3) and b_error < 3e-3
    pieces = seen.pieces
    assert (
        not (pieces["sliding"] & pieces["rolling"]).any()
        and pieces["sliding"].sum() > 20
        and pieces["rolling"].sum() > 60
    )
    # the misfit is the noise of both coordinates, where a piece is long
    long = pieces["samples"] >= 20
    assert np.median(pieces["rms"][long]) == pytest.approx(tracks.NOISE * np.sqrt(2), rel=0.1)
    # velocities are those of the play, at the middle of the pieces
    for piece in pieces[long][::7]:
        elapsed = piece["time"] - sample.strikes[piece["shot"], 5]
        state = sample.shots[piece["shot"]].states(elapsed)[piece["ball"]]
        assert np.hypot(*(state["v"][:2] - piece["v"])) < 0.05


def test_impacts_have_the_numbers_of_the_play(sample, seen):
    truth, errors, missed = [], [], 0
    for k, shot in enumerate(sample.shots):
        rails = shot.events[
            (shot.events["type"] == 3)
            & (np.hypot(*shot.events["before"][:, 0]["v"][:, :2].T) > 0.5)
        ]
        truth.append(len(rails))
        for event in rails:
            # rails of the play: y = 0, x = W, y = L, x = 0
            impacts = seen.impacts
            impacts = impacts[
                (impacts["shot"] == k)
                & (impacts["ball"] == event["a"])
                & (impacts["rail"] == (2, 1, 3, 0)[event["b"]])
            ]
            late = np.abs(impacts["time"] - event["time"] - sample.strikes[k, 5])
            impacts = impacts[np.argsort(late)][: (late < 0.03).sum()]
            if (
                len(impacts) == 0
                or impacts["chi2"][0] > 2.5
                or impacts["w_error"][0] > 0.05
                or impacts["v_error"][0] > 0.05
            ):
                missed += 1
                continue
            found = impacts[0]
            n = np.array([[-1, 0], [1, 0], [0, -1], [0, 1]])[found["rail"]]
            t = np.array([n[1], -n[0]])
            incoming, outgoing = event["before"][0]["v"][:2], event["after"][0]["v"][:2]
            size = np.hypot(*incoming)
            parts = [
                incoming @ n - found["v_n"],
                incoming @ t - found["v_t"],
                outgoing @ n - found["w_n"],
                outgoing @ t - found["w_t"],
            ]
            errors.append(np.abs(parts) / size)
    # half of the fast impacts are well known, and their velocities right to a per cent
    assert missed < 0.5 * sum(truth)
    assert np.median(errors, axis=0).max() < 0.01


def test_hits_have_the_restitution_of_the_play(sample, seen):
    good = seen.hits[
        (seen.hits["chi2"] < 3) & (seen.hits["v_n"] > 0.5) & (seen.hits["w_error"] < 0.1)
    ]
    assert len(good) >= 5
    e = (good["z_n"] - good["w_n"]) / good["v_n"]
    assert np.median(e) == pytest.approx(sample.constants["restitution"], abs=0.02)
    # with equal masses and the other ball at rest, the velocities along the line of centres add up
    assert np.median(np.abs(good["w_n"] + good["z_n"] - good["v_n"]) / good["v_n"]) < 0.02


def test_no_motion_has_no_events():
    still = np.array([[0.0, 1.0, 0.5], [2.0, 1.001, 0.5]])
    none = tracks.events([tracks.Recording(7, (1,), (still,))], TABLE, RADIUS)
    assert (
        len(none.pieces) == len(none.impacts) == len(none.hits) == 0
        and np.isnan(none.slide[0])
        and np.isnan(none.roll[1][0])
    )
    assert len(tracks.events([], TABLE, RADIUS).pieces) == 0


def test_a_value_of_another_kind_is_refused_by_the_name_of_its_argument():
    names = [
        "shots",
        "table",
        "radius",
        "cushion_model",
        "constants",
        "speeds",
        "noise",
        "rate",
        "thin",
        "seed",
    ]
    refused_by_name(tracks.synthetic, {"shots": 1}, names)
