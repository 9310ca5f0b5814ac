"""What carom.jax and carom.torch wrap: states, derivatives, batches and errors, by NumPy alone.

Their own tests need JAX and PyTorch, which are installed before a release.
"""

import numpy as np
import pytest
from gradient_cases import BALLS, CLOSED, CUE, NAMES, STROKE, TABLE, hessian_of_a_miss, played
from numpy.testing import assert_allclose, assert_array_equal

import carom
from carom._functions import named, shots_of

AIMS = np.add(STROKE, np.linspace(0.0, 0.2, 6)[:, np.newaxis] * [1.0, 1.0, 0.1, 0.1])
SIZES = {"r": 2, "v": 2, "w": 3}


def shots_and_numbers(
    numbers, balls=BALLS, cue=CUE, *, room=512, errors="raise", reach=False, **models
):
    """The shots of `numbers`, a mapping of names, and the values as one array (..., m)."""
    shots, parts, batch = shots_of(
        TABLE,
        balls,
        cue,
        numbers,
        lambda value: np.asarray(value, float),
        room,
        errors,
        0,
        carom.Options(**models),
        reach,
    )
    wide = [np.broadcast_to(part, shape).reshape(*batch, -1) for part, shape in parts]
    return shots, np.concatenate(wide, axis=-1)


def strokes(aims, **how):
    return shots_and_numbers(dict(zip(NAMES, np.moveaxis(aims, -1, 0))), **how)


@pytest.mark.parametrize("models", [{}, CLOSED, {"t_final": 0.9}])
def test_states_are_those_of_shots_and_slopes_those_of_tangents(models):
    """Of one shot, which is played in memory that is kept, and of a batch."""
    shot = played(STROKE, **models)
    tangents = carom.tangents(shot, NAMES)
    for aims in (np.array(STROKE), AIMS):
        shots, x = strokes(aims, **models)
        (states,) = shots.states(x)
        same, slopes = shots.both(x)
        assert_array_equal(same, states)
        found, derivatives = named(shots, states), named(shots, np.moveaxis(slopes, -1, 0))
        for name, count in SIZES.items():
            expected, own = shot.final[name][:, :count], getattr(found, name)
            assert_array_equal(own.reshape(-1, *expected.shape)[0], expected)
            slope = np.moveaxis(getattr(derivatives, name), 0, -1)
            slope = slope.reshape(-1, *tangents.final[name].shape)[0]
            scale = 1e-14 * np.abs(tangents.final[name]).max()
            assert_allclose(slope, tangents.final[name], rtol=1e-14, atol=scale)


def test_second_derivatives_are_those_of_hessian():
    expected, off, first = hessian_of_a_miss(**CLOSED)
    shots, x = strokes(np.array(STROKE), **CLOSED)
    second = named(shots, np.moveaxis(shots.second(x), (-2, -1), (0, 1))).r[:, :, 1]
    found = 2.0 * (first.T @ first + second @ off)
    assert_allclose(found, expected, rtol=1e-9)
    vectors = np.array([[0.1, 0.2, 0.3, 0.4]])
    along = shots.along(x, vectors)
    # both are differences, of other steps: the friction of pool's balls is steep at slow slips
    assert_allclose(along[..., 0], shots.second(x) @ vectors[0], rtol=1e-5, atol=1e-9)


def test_numbers_of_layouts_and_of_all_balls_are_broadcast():
    speeds, places = np.array([[1.4], [1.6]]), np.array([[0.6, 1.5], [0.62, 1.4], [0.58, 1.6]])
    numbers = {"cue.speed": speeds, "balls[1].r": places, "kind.mu_slide": 0.21}
    shots, x = shots_and_numbers(numbers, **CLOSED)
    assert x.shape == (2, 3, 4)
    ends = named(shots, *shots.states(x)).r
    for i, j in np.ndindex(2, 3):
        balls = BALLS.copy()
        balls["state"]["r"][1, :2] = places[j]
        balls["kind"]["mu_slide"] = 0.21
        cue = CUE.copy()
        cue["speed"] = speeds[i, 0]
        final = carom.simulate(TABLE, balls, cue, **CLOSED).final
        assert_array_equal(ends[i, j], final["r"][:, :2])


def test_reach_and_flags_are_those_of_tangents():
    shots, x = strokes(AIMS[:2], reach=True, **CLOSED)
    states, slopes, reach, flags = shots.both(x)
    found = named(shots, states, reach, flags)
    tangents = carom.tangents(played(AIMS[1], **CLOSED), NAMES)
    assert {name: found.reach[name][1] for name in NAMES} == pytest.approx(
        dict(zip(NAMES, tangents.reach))
    )
    assert found.flags.shape == (2,) and slopes.shape == (2, 3, states.shape[-1], 4)


def test_shots_in_error_raise_or_are_nan():
    wrong = AIMS.copy()
    wrong[2, 0] = np.nan
    shots, x = strokes(wrong, errors="nan")
    (states,) = shots.states(x)
    assert np.isnan(states[2]).all() and np.isfinite(np.delete(states, 2, axis=0)).all()
    shots, x = strokes(wrong)
    with pytest.raises(carom.CaromError, match=r"shot \[2\] of the batch, cue.speed = nan"):
        shots.states(x)


@pytest.mark.parametrize(
    ("numbers", "cue", "message"),
    [
        (
            {"table.nose_height": 0.036},
            CUE,
            r"numbers: 'table\.nose_height' cannot differ within a batch, which has one table; use kind\.nose_height, kind\.mu_cushion or",
        ),
        (
            {"cue.phi": 79.0},
            None,
            r"numbers: 'cue\.phi' is given, but there is no cue; pass cue=carom\.cue\(\)",
        ),
        (
            {"balls[1].r": [0.6, 1.5, 0.0]},
            CUE,
            r"numbers: 'balls\[1\]\.r': the shape is \(3,\), but must be \(\.\.\., 2\)",
        ),
    ],
)
def test_arguments_that_are_wrong(numbers, cue, message):
    with pytest.raises(ValueError, match=message):
        shots_and_numbers(numbers, cue=cue)
    with pytest.raises(ValueError, match="errors: unknown value 'no'; use 'raise' or 'nan'"):
        shots_and_numbers({"cue.phi": 79.0}, errors="no")
