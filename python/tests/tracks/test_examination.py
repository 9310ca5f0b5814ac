"""Examinations of recordings: what is wrong is said and put right, case by case, and of clean recordings nothing is said."""

import os
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from conftest import by_line
from spoil import spoiled
from test_tracks import RADIUS, TABLE, fitted

from carom import tracks

SEED = int(os.environ.get("CAROM_TEST_SEED", "3"))


@cache
def film(rate, noise=0.3e-3, count=20):
    """Recordings of a fixed camera, with half a second of rest in front: a row of each ball in each
    picture.
    """
    made = tracks.synthetic(count, noise=noise, rate=rate, thin=0.0, seed=SEED).recordings
    return spoiled(made, SEED, lead_in=0.5, rate=rate, noise=noise)


def changed(recordings, change):
    """Recordings whose tracks are changed one by one."""
    return [
        replace(
            shot, tracks=tuple(change(shot, k, track.copy()) for k, track in enumerate(shot.tracks))
        )
        for shot in recordings
    ]


def retimed(recordings, rate):
    def change(_, k, track):
        track[:, 0] *= rate
        return (
            np.round(track, 9)
            if rate == 4.0
            else np.column_stack([np.round(track[:, 0]), track[:, 1:]])
        )

    return changed(recordings, change)


def rounded(recordings, rate):
    """The times of a container: rounded up to its own pictures."""

    def change(_, k, track):
        track[:, 0] = np.ceil(track[:, 0] * rate - 1e-6) / rate
        return track

    return changed(recordings, change)


def held(recordings, rate):
    """Each picture of a container repeats the one before until a new one comes."""

    def change(_, k, track):
        times = np.arange(0, int(track[-1, 0] * rate) + 1) / rate
        rows = np.searchsorted(np.ceil(track[:, 0] * rate - 1e-6) / rate, times + 1e-9) - 1
        return np.column_stack([times, track[rows, 1:]])

    return changed(recordings, change)


def placed(recordings, place):
    return changed(
        recordings, lambda _, k, track: np.column_stack([track[:, 0], place(track[:, 1:])])
    )


def askew(r):
    """A camera that is tilted, whose corners were put right."""
    q = r - np.array(TABLE) / 2
    return r + q * (q @ (0.004, 0.006))[:, None]


def moved(recordings, index, way, row):
    """One row of a ball off the table."""
    shots = list(recordings)
    track = shots[index].tracks[0].copy()
    track[row, 2] = TABLE[1] + way
    shots[index] = replace(shots[index], tracks=(track, *shots[index].tracks[1:]))
    return shots


def frozen(recordings):
    """A compressed film: a ball that has moved less than its noise stays where it is."""

    def change(shot, k, track):
        for row in range(1, len(track)):
            if np.hypot(*(track[row, 1:] - track[row - 1, 1:])) < 5e-3:
                track[row, 1:] = track[row - 1, 1:]
        return track

    return changed(recordings, change)


def noisy(recordings):
    random = np.random.default_rng(SEED)

    def change(_, k, track):
        track[:, 2] += random.normal(0.0, 1.5e-3, len(track))
        return track

    return changed(recordings, change)


def lost(recordings):
    """Pictures are missing for 0.3 s in each second."""
    return changed(recordings, lambda _, k, track: track[(track[:, 0] - 0.3) % 1.0 > 0.3])


def drifting(recordings):
    """A ball of the first shot rolls before it is hit."""

    def change(shot, k, track):
        still = min(shot.still[k], 25)
        if shot.id == 1 and k == 2:
            track[:still, 1] += 0.006 * (track[:still, 0] - track[still - 1, 0])
        return track

    return changed(recordings, change)


def begun_late(recordings):
    """Clips begin after the strike."""
    return changed(
        recordings, lambda shot, _, track: track[track[:, 0] > shot.moves[shot.cue] + 0.03]
    )


def of_radius(recordings, radius):
    return recordings, radius


def examined(recordings):
    radius = RADIUS
    if isinstance(recordings, tuple):
        recordings, radius = recordings
    return tracks.examine(recordings, TABLE, radius)


# What is done to clean recordings, and what an examination then says of them: the kind of the
# finding, whether it is put right, and a pattern of its sentence.
CASES = [
    (
        lambda: held(film(25.0), 60.0),
        "clock",
        True,
        r"the film has 25 pictures a second and the file another clock: \d+ repeated pictures",
    ),
    (
        lambda: held(film(25.0), 30.0),
        "clock",
        True,
        r"the film has 25 pictures a second and the file another clock: \d+ repeated pictures",
    ),
    (
        lambda: held(film(24.0), 60.0),
        "clock",
        True,
        r"the film has 24 pictures a second and the file another clock: \d+ repeated pictures",
    ),
    (
        lambda: rounded(film(25.0), 60.0),
        "clock",
        True,
        "the film has 25 pictures a second and the file another clock: all times are set",
    ),
    (
        lambda: rounded(film(25.0), 30.0),
        "clock",
        True,
        "the film has 25 pictures a second and the file another clock: all times are set",
    ),
    (
        lambda: retimed(film(25.0), 25.0),
        "clock",
        True,
        "t counts pictures, as it has whole numbers alone: taken as 25 a second",
    ),
    (
        lambda: retimed(film(60.0), 60.0),
        "clock",
        True,
        "t counts pictures, as it has whole numbers alone: taken as 60 a second",
    ),
    (
        lambda: retimed(film(25.0), 1000.0),
        "clock",
        True,
        "t counts milliseconds, as it has whole numbers alone: taken as 1000 a second",
    ),
    (
        lambda: retimed(film(60.0, count=40), 4.0),
        "clock",
        False,
        r"sliding balls slow down as if a second had (3\.9|4|4\.1) units of t: is the rate of the pictures",
    ),
    (
        lambda: placed(film(50.0), lambda r: 1.01 * r),
        "table",
        False,
        r"the tracks lie turned by .* degrees, 1\.0(09|10)\d times as large .*--calibrate puts",
    ),
    (
        lambda: placed(film(50.0)[:3], lambda r: 1.01 * r),
        "table",
        False,
        r"balls turn .* \d\d mm beyond the cushion .* about 1\.0(0[6-9]|1\d) times too large",
    ),
    (
        lambda: placed(film(50.0), askew),
        "table",
        False,
        r"the tracks lie turned by .* bent by up to \d+\.\d mm as by a camera that looks askew",
    ),
    (
        lambda: moved(film(50.0), 2, 0.5, 40),
        "table",
        True,
        "shot 3, ball 1: 1 rows are left out, the first at t = .*: centres of balls of radius",
    ),
    (
        lambda: frozen(film(25.0, noise=1e-3)),
        "noise",
        False,
        r"the film freezes balls at rest, which scatter by 0\.\d\d mm, those that move by (1\.\d|0\.9)",
    ),
    (
        lambda: noisy(film(50.0)),
        "noise",
        False,
        r"the noise is 0\.\d\d mm along x and 1\.\d\d mm along y",
    ),
    (
        lambda: lost(film(50.0)),
        "gap",
        False,
        r"pictures are missing \d+ times in shots 1, 2, 3, 4 and others, first in shot 1 from",
    ),
    (
        lambda: drifting(film(50.0)),
        "rest",
        False,
        r"shot 1, ball 3: it moves by [2-4]\.\d mm in the \d+ rows before .*; a shot begins with",
    ),
    (
        lambda: begun_late(film(50.0)),
        "rest",
        False,
        r"the struck ball moves from its first row on in \d+ of 20 shots .* begin with the balls",
    ),
    (
        lambda: of_radius(film(50.0, count=60), 0.026),
        "radius",
        False,
        r"\d+ hits say that centres of balls that touch are about 6\d mm apart, while the radius",
    ),
]


@pytest.mark.parametrize(("spoil", "kind", "is_mended", "pattern"), by_line(CASES))
def test_what_is_wrong_is_said_and_put_right(spoil, kind, is_mended, pattern):
    found = examined(spoil())
    said = [finding for finding in found.findings if re.match(pattern, finding.text)]
    assert len(said) == 1, found.sentences
    assert said[0].kind == kind and said[0].is_mended == is_mended
    assert (kind in found.causes) == (not is_mended and kind not in ("gap", "file", "noise"))
    # nothing else is wrong, except in what a kind has with it
    others = {finding.kind for finding in found.findings} - {kind}
    assert others <= {"noise"}, found.sentences


@pytest.mark.parametrize(
    ("noise", "rate", "thin"),
    [
        (0.3e-3, 50.0, 0.016),
        (0.3e-3, 25.0, 0.0),
        (1e-3, 30.0, 0.0),
        (1e-3, 120.0, 0.0),
        (3e-3, 60.0, 0.0),
        (2e-3, 25.0, 0.016),
    ],
)
def test_nothing_is_said_of_clean_shots(noise, rate, thin):
    print("seed", SEED)
    made = tracks.synthetic(20, noise=noise, rate=rate, thin=thin, seed=SEED)
    found = tracks.examine(made.recordings, TABLE, RADIUS)
    assert found.sentences == [] and found.causes == []
    assert found.noise.value == pytest.approx(noise, rel=0.15) and not found.noise.is_frozen
    for shot, clean in zip(found.recordings, made.recordings, strict=True):
        assert sum(map(len, shot.tracks)) > 0.99 * sum(map(len, clean.tracks))


@pytest.mark.parametrize("spoil", [held, rounded])
def test_a_clock_is_restored_to_the_times_of_the_pictures(spoil):
    clean = film(25.0)
    found = examined(spoil(clean, 60.0))
    for shot, right in zip(found.recordings, clean, strict=True):
        for track, truth in zip(shot.tracks, right.tracks, strict=True):
            # the clock begins up to one picture of the container later
            later = track[0, 0] - truth[0, 0]
            rows = np.round((track[:, 0] - later) * 25.0).astype(int)
            assert 0.0 <= later < 0.041 and len(track) > 0.98 * len(truth)
            assert np.allclose(rows / 25.0, track[:, 0] - later, atol=1e-9)
            same = np.isin(track[:, 1], truth[:, 1])
            assert same.all()
            assert (track[:, 1:] == truth[np.minimum(rows, len(truth) - 1), 1:]).mean() > 0.95


def test_a_fit_refuses_what_the_command_refuses():
    made = tracks.synthetic(2, seed=1).recordings
    with pytest.raises(
        tracks.TrackError, match="^table: .* and most are not: they fit 2.84 x 1.42"
    ):
        fitted(made, table=TABLE[::-1])
    with pytest.raises(ValueError, match="^table, radius: the extents"):
        fitted(made, radius=0.5)
    far = [replace(made[0], tracks=tuple(track + [0.0, 9.0, 0.0] for track in made[0].tracks))]
    with pytest.raises(
        tracks.TrackError, match="^table: .* most are not: are all lengths in metres"
    ):
        fitted(far)
    still = [
        replace(shot, tracks=tuple(np.round(t * [9, 1, 1]) for t in shot.tracks)) for shot in made
    ]
    slow = changed(
        still, lambda _, k, t: np.column_stack([np.arange(40), np.tile(t[0, 1:], (40, 1))])
    )
    with pytest.raises(
        tracks.TrackError, match="^recordings: t has whole numbers .* rate is needed"
    ):
        fitted(placed(slow, lambda r: 0.5 + 0.0 * r))


def test_a_shot_without_a_row_on_the_table_costs_itself():
    made = tracks.synthetic(4, seed=1).recordings
    made[1] = replace(made[1], tracks=tuple(t + [0.0, 9.0, 0.0] for t in made[1].tracks))
    found = fitted(made, free="none", train=[1, 2])
    assert [shot.id for shot in found.recordings] == [1, 3, 4] and found.train == [
        False,
        True,
        False,
    ]
    assert sum("shot 2, ball" in text for text in found.warnings) == 3


def test_a_fit_never_returns_what_is_worse_than_its_start(monkeypatch):
    made = tracks.synthetic(6, noise=0.3e-3, seed=4)
    wrong = {"mu_slide": 0.16, "mu_roll": 0.011, "restitution": 0.8}
    monkeypatch.setattr(
        "carom.tracks.fit._from_events.measured", lambda *_: (wrong, dict.fromkeys(wrong, 1e-3))
    )
    found = fitted(made.recordings, cushion_model="smooth", free="events")
    assert found.constants == tracks._constants.usual("smooth") and found.spread == {}
    assert found.median_rmse < 0.8e-3
    assert re.search(
        r"the constants that were found play the shots worse, to .* mm: these are kept",
        found.warnings[-1],
    )


def test_the_constants_are_not_blamed_for_what_the_tracks_explain():
    scaled = placed(film(50.0), lambda r: 1.01 * r)
    found = fitted(scaled[:6], cushion_model="smooth", free="none")
    assert re.search(
        "times that of the noise: what is said of the table comes first", found.warnings[-1]
    )
    wrong = fitted(
        film(50.0)[:6], cushion_model="smooth", free="none", constants={"mu_roll": 0.009}
    )
    assert wrong.warnings[-1].endswith(
        "the constants or the models are off by more than the camera"
    )
