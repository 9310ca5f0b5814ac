"""Noise that varies over the table, as of a camera that looks along it."""

from dataclasses import replace

import numpy as np

import carom.fit
from carom import tracks
from carom.tracks import _constants, _reading, _recordings, _strikes
from carom.tracks._recordings import View

TABLE, RADIUS = (2.84, 1.42), 0.03075
# the corners (0, 0), (W, 0), (W, L), (0, L) in the picture of a camera behind x = 0
CORNERS = np.array([[1630.0, 960.0], [1310.0, 140.0], [640.0, 150.0], [310.0, 980.0]])
MATRIX = _reading._homography(CORNERS, TABLE)
PIXELS = 0.6  # standard deviation of a pixel's coordinate


def placed(pixels):
    """The places of pixels, m."""
    q = pixels @ MATRIX[:, :2].T + MATRIX[:, 2]
    return q[..., :2] / q[..., 2:]


def seen(places):
    """The pixels of places."""
    back = np.linalg.inv(MATRIX)
    q = places @ back[:, :2].T + back[:, 2]
    return q[..., :2] / q[..., 2:]


def filmed(shots, seed):
    """Synthetic shots after a second of rest, as this camera records them."""
    made = tracks.synthetic(shots, noise=0.0, seed=seed)
    random = np.random.default_rng(seed)
    view = View.over(MATRIX, np.concatenate([t[:, 1:] for r in made.recordings for t in r.tracks]))
    found = []
    for shot in made.recordings:
        rows = []
        for track in shot.tracks:
            lies = np.column_stack([np.arange(50) / 50.0, np.tile(track[0, 1:], (50, 1))])
            whole = np.vstack([lies, track + [1.0, 0.0, 0.0]])
            noise = random.normal(0.0, PIXELS, (len(whole), 2))
            whole[:, 1:] = placed(seen(whole[:, 1:]) + noise)
            rows.append(whole)
        found.append(replace(shot, tracks=tuple(rows), noise=PIXELS * view.scale, view=view))
    strikes = made.strikes + [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    return replace(made, strikes=strikes), found


def test_deviations_are_those_of_pixels():
    random = np.random.default_rng(1)
    places = np.array([[0.1, 0.1], [1.4, 0.7], [2.7, 1.3]])
    view = View.over(MATRIX, places)
    shot = tracks.Recording(1, (1,), (np.zeros((1, 3)),), PIXELS * view.scale, view)
    off = (
        placed(seen(places)[:, None] + random.normal(0.0, PIXELS, (3, 20000, 2))) - places[:, None]
    )
    assert np.allclose(shot.deviations(places), off.std(axis=1), rtol=0.03)
    assert shot.deviations(places).max() > 3.0 * shot.deviations(places).min()
    assert np.isclose(np.sqrt((shot.noises(places) ** 2).mean()), shot.noise)
    # evened, they have one deviation in all directions
    evened = shot.evened(places[:, None], off)
    for part in evened:
        assert np.allclose(np.cov(part.T), shot.noise**2 * np.eye(2), atol=0.04 * shot.noise**2)


def test_files_with_corners_have_the_view_of_the_camera(tmp_path):
    places = np.array([[0.5, 0.4], [1.0, 0.6], [2.0, 1.2]])
    rows = [f"1,1,{k / 30:.5f},{x:.6f},{y:.6f}" for k, (x, y) in enumerate(seen(places))]
    (tmp_path / "pixels.csv").write_text("\n".join(["shot,ball,t,x,y", *rows]))
    (shot,) = tracks.read(
        tmp_path / "pixels.csv", table=TABLE, radius=RADIUS, corners=CORNERS.tolist()
    )
    assert np.allclose(shot.view.evening(places), View.over(MATRIX, places).evening(places))
    # without corners, rows have one noise
    text = [f"1,1,{k / 30:.5f},{x:.6f},{y:.6f}" for k, (x, y) in enumerate(places)]
    (tmp_path / "places.csv").write_text("\n".join(["shot,ball,t,x,y", *text]))
    (plain,) = tracks.read(tmp_path / "places.csv", table=TABLE, radius=RADIUS)
    assert plain.view is None and (plain.deviations(places) == plain.noise).all()


def test_a_ball_moves_by_more_than_the_noise_there():
    """By 8.5 mm along x, which is motion near the camera and noise at its far end."""
    _, (shot, *_) = filmed(2, seed=4)
    for place, moves in (((0.3, 0.7), True), ((2.7, 0.7), False)):
        rows = np.tile([0.0, *place], (40, 1))
        rows[:, 0] = np.arange(40) / 30.0
        rows[20:, 1] += 8.5e-3
        ball = replace(shot, balls=(1,), tracks=(rows,))
        assert (ball.still[0] == 20) == moves and bool(len(ball.moving[0])) == moves
        # as if all rows had the same noise, neither moves
        assert replace(ball, view=None).still == [40]


def test_the_noise_is_found():
    _, recordings = filmed(12, seed=2)
    blind = [replace(shot, noise=tracks._recordings.NOISE) for shot in recordings]
    assert np.isclose(_recordings.noise_of(blind).value, recordings[0].noise, rtol=0.1)
    examined = tracks.examine(blind, TABLE, RADIUS)
    (finding,) = [finding for finding in examined.findings if finding.kind == "noise"]
    assert finding.text.startswith("the noise is ")
    assert finding.text.endswith(" pixels by the corners: each row counts by its own")


def test_derivatives_are_evened():
    """Those in double precision are those of C, and the cost is that of evened distances."""
    made, recordings = filmed(2, seed=5)
    plays = _strikes.Plays(recordings, TABLE, RADIUS, made.constants, "smooth")
    strikes = made.strikes - np.eye(6)[5] * plays.origins[:, None]
    sums = plays.misfit(np.arange(2, dtype=np.int32), strikes, plays.ends, np.inf, huber=0.0)
    square, gradient = _strikes.normal(sums)
    for k, shot in enumerate(recordings):
        d, J, _, _ = _strikes.derivatives(plays, k, strikes[k], [], rest=False)
        assert np.isclose(d @ d, sums[k, 0], rtol=1e-2)
        assert np.allclose(J.T @ d, gradient[k], rtol=0.01, atol=0.01 * np.abs(gradient[k]).max())
        assert np.isclose(np.trace(J.T @ J), np.trace(square[k]), rtol=0.01)
        # distances of places are as they are
        where = np.linalg.inv(
            np.concatenate([shot.view.evening(track[:, 1:]) for track in plays.tracks[k]])
        )
        plain = (where @ d.reshape(-1, 2)[..., None])[..., 0]
        assert np.isclose((plain**2).sum(), sums[k, 1], rtol=1e-2)


def rolled(count):
    """Recordings of one ball that goes over the whole table, and its strikes."""
    random = np.random.default_rng(7)
    values, model = _constants.complete({}, "smooth")
    world = _constants.rectangle(TABLE, values["nose_height"])
    view = View.over(MATRIX, random.uniform(RADIUS, np.array(TABLE) - RADIUS, (200, 2)))
    recordings, strikes = [], np.zeros((count, 6))
    strikes[:, 5] = 1.0
    for number in range(count):
        strikes[number, :2] = random.uniform(2.0, 3.0) * np.array(
            [0.9, random.choice([-0.43, 0.43])]
        )
        balls = _constants.layout(np.array([[0.3, random.uniform(0.3, 1.1)]]), RADIUS, values)
        balls["state"]["v"][0] = [*strikes[number, :2], 0.0]
        shot = carom.simulate(world, balls, cushion_model=model)
        times = np.arange(0.0, 1.0 + shot.time, 1.0 / 30.0)
        places = shot.positions(np.maximum(times - 1.0, 0.0))[:, 0, :2]
        places = placed(seen(places) + random.normal(0.0, PIXELS, places.shape))
        track = np.column_stack([times, places])
        recordings.append(tracks.Recording(number, (1,), (track,), PIXELS * view.scale, view))
    return recordings, strikes, values


def test_strikes_are_nearer_by_the_noise_of_each_row():
    """And they are off by what their covariances say."""
    recordings, strikes, values = rolled(40)
    blind = [replace(shot, view=None) for shot in recordings]
    fits = [
        carom.fit.fit(shots, TABLE, RADIUS, constants=values, free="none", cushion_model="smooth")
        for shots in (recordings, blind)
    ]
    # side spin is lost before it meets a cushion, so no row tells it
    told = [0, 1, 2, 3, 5]
    errors = [np.sqrt(((found.strikes - strikes) ** 2).mean(axis=0))[told] for found in fits]
    print("errors over those with one noise:", errors[0] / errors[1])
    assert np.exp(np.log(errors[0] / errors[1]).mean()) < 0.95
    offsets, chi2 = fits[0].strikes[:, :2] - strikes[:, :2], []
    for k, away in enumerate(offsets):
        chi2.append(away @ np.linalg.solve(fits[0].strike_covariance(k)[:2, :2], away))
    print("chi^2 of velocities, of 2:", np.mean(chi2))
    assert 1.3 < np.mean(chi2) < 3.0
