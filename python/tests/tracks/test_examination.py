"""Examinations of recordings: what is wrong is said and put right, case by case in the text beside
this module, and of clean recordings nothing is said.
"""

import os
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from spoil import spoiled
from test_tracks import RADIUS, TABLE, fitted

from carom import tracks

SEED = int(os.environ.get("CAROM_TEST_SEED", "3"))
LINES = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8")
CASES = re.findall(r"^([^#\s].*)\n +(\w+) (right|open): (.*)$", LINES, re.M)


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


@pytest.mark.parametrize("case", CASES, ids=[case[0] for case in CASES])
def test_what_is_wrong_is_said_and_put_right(case):
    call, kind, state, pattern = case
    found = examined(eval(call))
    said = [finding for finding in found.findings if re.match(pattern, finding.text)]
    assert len(said) == 1, found.sentences
    assert said[0].kind == kind and said[0].is_mended == (state == "right")
    assert (kind in found.causes) == (state == "open" and kind not in ("gap", "file", "noise"))
    # nothing else is wrong, except in what a kind has with it
    others = {finding.kind for finding in found.findings} - {kind}
    assert others <= {"noise"}, found.sentences


def test_every_line_of_the_text_is_a_case():
    assert 2 * len(CASES) == len(re.findall(r"^[^#\n].*$", LINES, re.M)) >= 30


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
