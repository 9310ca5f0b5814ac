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


@pytest.mark.parametrize("seed", [0, 4, 6])
def test_a_strike_is_found_among_basins_that_look_better_at_first(seed):
    """The second ball moves 80 ms after the first, and the best strikes of the first second all
    belong to wrong basins, where the shot misses by 16 or 25 cm.
    """
    sample = synthetic(35, seed=1)
    plays = plays_of(sample, sample.recordings[34:])
    found, _ = _search.find(plays, seed, squares=True)
    assert plays.rmse(found)[0] < 0.01
    assert np.abs(found[0, :2] - sample.strikes[34, :2]).max() < 0.1


def test_strikes_are_chosen_from_different_basins():
    shots = np.array([0, 0, 0, 0, 0, 1, 1], np.int32)
    basins = np.array([7.0, 7.0, 7.0, 8.0, 9.0, 7.0, 7.0])
    costs = np.array([1.0, 2.0, 3.0, 4.0, np.inf, 6.0, 5.0])
    # the best, the best of another basin, and the second best
    assert _search._best(shots, basins, costs, 3).tolist() == [0, 1, 3, 6, 5]
    assert _search._best(shots, basins, costs, 3, leaders=True).tolist() == [0, 3, 6]
    assert _search._best(shots, basins, costs, 1).tolist() == [0, 6]


def test_plays_with_the_same_contacts_are_of_one_basin():
    sample = synthetic(1, seed=3)
    plays = plays_of(sample, sample.recordings)
    strike = sample.strikes[0] - [0.0, 0.0, 0.0, 0.0, 0.0, plays.origins[0]]
    strikes = np.array([strike, strike * 1.0001, strike * [-1.0, -1.0, 1.0, 1.0, 1.0, 1.0]])
    rows, ends = np.zeros(3, np.int32), np.repeat(plays.ends, 3)
    basins = plays.misfit(rows, strikes, ends, -np.inf)[:, 3]
    assert basins[0] == basins[1] != basins[2] and (basins == basins.round()).all()
    assert (plays.misfit(rows, strikes, ends, np.inf)[:, 3] == basins).all()
    # without a contact there is one basin
    assert len({*plays.misfit(rows, strikes, np.full(3, 0.0), -np.inf)[:, 3]}) == 1


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
