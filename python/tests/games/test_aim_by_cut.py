"""Aims at a ball by its cut, without a pocket."""

import numpy as np
import pytest

import carom

TABLE, TWO = carom.tables.pool_9ft(), carom.balls([[0.6, 0.5], [0.6, 1.7]])
ELSEWHERE = [TABLE, carom.tables.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])]


def cut_of(shot):
    """Degrees, above 0 to the left, by the first contact of two balls."""
    hits = np.flatnonzero(shot.events["type"] == carom.EventType.BALL_BALL)
    hit = shot.events[hits[0]]
    striker = 0 if hit["a"] == 0 else 1
    v = hit["before"]["v"][striker, :2]
    n = hit["before"]["r"][1 - striker, :2] - hit["before"]["r"][striker, :2]
    return np.degrees(np.arctan2(v[0] * n[1] - v[1] * n[0], v @ n))


@pytest.mark.parametrize("table", ELSEWHERE)
@pytest.mark.parametrize("a", [-0.3, 0.0, 0.15, 0.3])
def test_the_cut_is_exact(table, a):
    """Also with side spin, where geometry has cuts of 44 and 62 degrees instead of 30."""
    cue = carom.cue(speed=3.0, a=a)
    hit = carom.aim(table, TWO, cue, ball=1, cut=30)
    assert abs(cut_of(carom.simulate(table, TWO, hit.cue)) - 30.0) < 1e-6
    radius = TWO["kind"]["radius"][0]
    straight = cue.copy()
    straight["phi"] = 90.0 - np.degrees(np.arcsin(2.0 * radius * 0.5 / 1.2))
    off = abs(cut_of(carom.simulate(table, TWO, straight)) - 30.0)
    assert off < 1e-6 if a == 0.0 else off > 10.0
    assert (hit.cue["speed"], hit.cue["a"], hit.cut) == (3.0, a, 30.0)


def test_arrays_of_cuts_and_cues():
    cuts, cues = np.linspace(-80.0, 80.0, 5), carom.cue(speed=[[2.0], [4.0]], a=0.2)
    hit = carom.aim(TABLE, TWO, cues, ball=1, cut=cuts)
    assert hit.cue.shape == hit.cut.shape == hit.elevation.shape == (2, 5)
    shots = carom.simulate_batch(TABLE, TWO, hit.cue, room=20)
    np.testing.assert_allclose([[cut_of(s) for s in row] for row in shots], hit.cut, atol=1e-6)
    full = carom.aim(TABLE, TWO, carom.cue(), ball=1)
    assert full.cut == 0.0 and abs(cut_of(carom.simulate(TABLE, TWO, full.cue))) < 1e-6
    assert carom.aim(TABLE, TWO, carom.cue(), ball=1, cut=[]).cue.shape == (0,)


def test_the_stick_is_raised():
    at_rail = carom.balls([[0.6, 0.03], [0.6, 1.2]])
    level = carom.aim(TABLE, at_rail, carom.cue(a=0.3), ball=1, cut=-20)
    raised = carom.aim(TABLE, at_rail, carom.cue(a=0.3, theta=np.nan), ball=1, cut=-20)
    assert 1.0 < level.elevation and raised.elevation <= raised.cue["theta"] < 60.0
    assert abs(cut_of(carom.simulate(TABLE, at_rail, raised.cue)) + 20.0) < 1e-6


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"cut": 90}, "cut: it must be above -90 and below 90 degrees, not 90"),
        ({"cut": np.nan}, "cut: .* not nan"),
        ({"ball": 0}, "ball: 0 is the cue ball"),
        ({"ball": 3}, "ball: 3 is not an integer from 0 to 2"),
        ({"ball": 2}, "no aim at ball 2 with a cut of 0 degrees: ball 1 is in the way"),
        ({"cue": carom.cue(speed=[2, 0.1]), "cut": [[5], [0]]}, r"cut\[0, 1\]: no aim at ball 1"),
        ({"via": ["head"]}, "via: it needs a pocket"),
        ({"pocket": 0, "cut": 3}, "pocket, cut: .* only one"),
        ({"cue": carom.cue(speed=0.1)}, "comes to rest before it; raise"),
        ({"balls": carom.balls([[0.6, 0.5], [0.6, 0.51]])}, "balls.*overlap"),
    ],
)
def test_refused(changes, message):
    three = carom.balls([[0.6, 0.5], [0.6, 1.7], [0.6, 2.0]])
    wanted = {"balls": three, "cue": carom.cue(), "ball": 1, **changes}
    with pytest.raises(ValueError, match=message):
        carom.aim(TABLE, **wanted)
