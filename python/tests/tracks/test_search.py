"""The search of a strike: long shots of many cushions, by the law that played them and by another."""

import numpy as np
import pytest
from test_tracks import RADIUS, TABLE

from carom.tracks import _search, _strikes, fit, synthetic

WRONG = 0.97  # times the restitution of the cushions


def long_shots(shots, seed):
    """Shots of ten contacts and more, whose cue ball is seen under way before it meets a ball."""
    sample = synthetic(shots, speeds=(4.0, 7.0), seed=seed)
    seen = [k for k, shot in enumerate(sample.recordings) if np.sort(shot.moves)[1] > 0.07]
    return sample, [sample.recordings[k] for k in seen], sample.strikes[seen]


def plays_of(sample, recordings, restitution=1.0):
    values = {**sample.constants}
    values["restitution_cushion"] *= restitution
    return _strikes.Plays(recordings, TABLE, RADIUS, values, "smooth")


def from_true(plays, strikes, tries, spread, random):
    """Strikes that descend from places near the true ones, and their mean squares, (shots, tries)."""
    rows = np.repeat(np.arange(len(strikes), dtype=np.int32), tries)
    near = strikes[rows]
    near[:, 5] -= plays.origins[rows]
    wide = spread * 10.0 ** random.uniform(-2.0, 0.0, (len(rows), 1))
    near[:, :5] += wide * random.normal(size=(len(rows), 5))
    near, _ = _strikes.descend(plays, rows, near, plays.ends[rows], 20)
    near, sums = _strikes.descend(plays, rows, near, plays.ends[rows], 20, huber=0.0)
    return near, (sums[:, 0] / sums[:, 2]).reshape(-1, tries)


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(seed, marks=pytest.mark.release) for seed in (1, 2))]
)
def test_strikes_of_long_shots_are_those_that_were_played(seed):
    """Noise of the places of rest grows along a shot, so the true strike is not quite the best."""
    sample, recordings, strikes = long_shots(12, seed)
    plays = plays_of(sample, recordings)
    found, cost = _search.find(plays, squares=True)
    best, least = from_true(plays, strikes, 1, 0.0, np.random.default_rng(seed))
    ratio = np.sqrt(cost / plays.counts / least[:, 0])
    assert (ratio < 1.02).all(), f"seed {seed}: RMSE over that of the true strikes {ratio.round(3)}"
    same = ratio > 0.98
    off = np.abs(found - best)[same].max(axis=0)
    assert same.sum() >= 8 and (off < [0.02, 0.02, 0.1, 0.1, 0.1, 5e-3]).all(), (
        f"seed {seed}: {off}"
    )


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.release)])
def test_by_a_wrong_law_no_strike_near_the_true_one_is_better(seed):
    """Where the best strike of the first second is not that of the whole shot."""
    sample, recordings, strikes = long_shots(12, seed)
    plays = plays_of(sample, recordings, WRONG)
    _, cost = _search.find(plays, squares=True)
    _, least = from_true(plays, strikes, 40, 0.3, np.random.default_rng(seed))
    ratio = np.sqrt(cost / plays.counts / least.min(axis=1))
    assert (ratio < 1.05).all(), f"seed {seed}: {ratio.round(3)}"
    assert np.sqrt(np.median(cost / plays.counts)) > 10.0 * recordings[0].noise


def test_a_strike_depends_neither_on_the_seed_nor_on_threads_nor_on_other_shots():
    sample, recordings, _ = long_shots(4, 5)
    values = plays_of(sample, recordings, WRONG).constants

    def fitted(shots, **more):
        return fit.fit(shots, TABLE, RADIUS, constants=values, free="none", **more)

    one = fitted(recordings, seed=1)
    assert np.array_equal(fitted(recordings, seed=2, threads=3).strikes, one.strikes)
    for k in (0, len(recordings) - 1):
        alone = fitted(recordings[k : k + 1], seed=1)
        assert np.allclose(alone.rmse, one.rmse[k], rtol=1e-3)
