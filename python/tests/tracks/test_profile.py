"""What few shots tell of constants, and what they do not; and which shots would tell it."""

import re
from dataclasses import replace

import numpy as np
import pytest

import carom
from carom import fit, tracks

RADIUS, EXTENTS = 0.02615, (1.27, 2.54)
TRUE, FREE = 0.98, ("restitution", "mu_spin")


def recorded(number, places, cue, random, longest=4.0):
    """A shot of balls with the true restitution, as a camera with 0.1 mm of noise sees it."""
    layout = carom.balls(places, game="snooker", radius=RADIUS, restitution=TRUE)
    table = carom.tables.polygon([(0, 0), (1.27, 0), (1.27, 2.54), (0, 2.54)], ball_radius=RADIUS)
    shot = carom.simulate(table, layout, cue)
    t = np.arange(0.0, 0.8 + min(shot.time, longest), 1.0 / 30.0)
    seen = shot.positions(np.clip(t - 0.8, 0.0, shot.time))[..., :2]
    seen = seen + random.normal(0.0, 1e-4, seen.shape)
    rows = tuple(np.column_stack([t, seen[:, ball]]) for ball in range(len(layout)))
    return tracks.Recording(number, tuple(range(len(layout))), rows)


def soft_hits(count, seed):
    """Soft strokes at a ball that lies straight ahead, which tell nothing of spin."""
    random, shots = np.random.default_rng(seed), []
    for number in range(count):
        places = np.array([[0.6, 0.5], [0.6, 0.5]]) + [
            [0.0, 0.0],
            random.uniform([-0.01, 0.2], [0.01, 0.4]),
        ]
        line = places[1] - places[0]
        aim = np.degrees(np.arctan2(line[1], line[0])) + random.uniform(-1.5, 1.5)
        speed, b = random.uniform([0.5, -0.2], [0.9, 0.4])
        cue = carom.cue(ball_speed=speed, phi=aim, a=0.0, b=b, game="snooker")
        shots.append(recorded(number, places, cue, random))
    return shots


def of(shots, free=FREE, **known):
    return fit.fit(shots, EXTENTS, RADIUS, game="snooker", free=free, **known)


@pytest.fixture(scope="module")
def few():
    return of(soft_hits(3, 2))


def test_another_start_finds_what_the_prior_keeps_away(few):
    low, high = few.intervals["restitution"]
    assert few.constants["restitution"] == pytest.approx(TRUE, abs=2e-3)
    assert low - 1e-3 < TRUE < high + 1e-3 and high - low < 0.02


def test_what_shots_do_not_tell_is_said(few):
    assert few.intervals["mu_spin"] is None
    assert any(re.match(r"not told by these shots: mu_spin, which", text) for text in few.warnings)
    assert few.to_dict()["intervals"]["mu_spin"] is None


def test_designed_shots_tell_it(few):
    designed, random = few.design(2, seed=1), np.random.default_rng(7)
    for shot in designed:
        assert all(shot.new_errors[name] <= shot.old_errors[name] * 1.0001 for name in FREE)
        assert re.match(r"cue ball at \d\.\d\d, \d\.\d\d m, a ball at .* errors fall: ", str(shot))
    assert designed[0].new_errors["mu_spin"] < 0.1 * designed[0].old_errors["mu_spin"]
    further = [recorded(10 + k, shot.places, shot.cue, random) for k, shot in enumerate(designed)]
    whole = of([*few.recordings, *further], constants=few.constants)
    low, high = whole.intervals["mu_spin"]
    true = float(carom.balls([[0.3, 0.3]], game="snooker")["kind"]["mu_spin"][0])
    assert low - 2e-4 < true < high + 2e-4
    with pytest.raises(
        ValueError, match="^design: this fit determined no constants from complete shots"
    ):
        of(few.recordings, "none").design()


def test_a_shot_that_misfits_is_named():
    shots = soft_hits(5, 4)
    track = shots[2].tracks[1].copy()
    moving = track[:, 0] > 1.6
    track[moving, 1] += 0.03 * (track[moving, 0] - 1.6)  # no ball goes this way
    shots[2] = replace(shots[2], tracks=(shots[2].tracks[0], track))
    found = of(shots, "restitution")
    said = [text for text in found.warnings if "misfit and count less" in text]
    assert len(said) == 1 and re.search(r"^[12] of 5 shots .* shot 2 \d %", said[0])
    assert found.constants["restitution"] == pytest.approx(TRUE, abs=5e-3)
