"""What carom.jax and carom.torch have in common, as tests of the fixture `library`: values are those
of shots, derivatives those of carom.tangents and of differences; batches, errors.

A library has `final`, `array` for an array of its own, `jacobians`: functions that give the
derivatives of a function by a dictionary of numbers, and `compiled`.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import carom

TABLE = carom.tables.pool_9ft()
CLOSED = {"ball_model": "inelastic", "cushion_model": "smooth"}
BALLS = carom.balls([[0.4, 0.5], [0.6, 1.5], [0.9, 2.0]])
CUE = carom.cue(speed=1.5, phi=79.0, a=0.1, b=0.1)
NAMES = ("cue.speed", "cue.phi", "cue.a", "cue.b")
STROKE = (1.5, 79.0, 0.1, 0.1)
GOAL = (0.6, 1.0)


def numbers_of(library, aim):
    return {name: library.array(value) for name, value in zip(NAMES, aim)}


def played(aim, **models):
    fields = dict(zip(("speed", "phi", "a", "b"), map(float, aim)))
    return carom.simulate(TABLE, BALLS, carom.cue(**fields), **models)


def hessian_of_a_miss(**models):
    """Of the square of the distance between ball 1 and GOAL, by carom.hessian; the miss and the
    slopes of ball 1.
    """
    shot = played(STROKE, **models)
    found, off = carom.hessian(shot, NAMES), shot.final["r"][1, :2] - np.array(GOAL)
    first = found.first.final["r"][1]
    second = 2.0 * (first.T @ first + np.einsum("i,ijk->jk", off, found.final["r"][1]))
    return second, off, first


@pytest.mark.parametrize(
    "models",
    [{}, CLOSED, CLOSED | {"ball_model": "exact"}, {"t_final": 0.9}, CLOSED | {"t_final": 0.9}],
)
def test_values_are_those_of_shots_and_derivatives_those_of_tangents(library, models):
    shot, numbers = played(STROKE, **models), numbers_of(library, STROKE)
    tangents = carom.tangents(shot, NAMES)
    found = library.final(TABLE, BALLS, CUE, numbers, **models)
    for name, count in (("r", 2), ("v", 2), ("w", 3)):
        assert np.array_equal(getattr(found, name), shot.final[name][:, :count])
        expected = tangents.final[name]
        scale = 1e-14 * np.abs(expected).max()
        assert np.abs(expected).max() > 0.0 or "t_final" not in models or name != "w"

        def values(numbers, name=name):
            return getattr(library.final(TABLE, BALLS, CUE, numbers, **models), name)

        for jacobian in library.jacobians:
            joined = np.stack(list(jacobian(values, numbers).values()), axis=-1)
            assert_allclose(joined, expected, rtol=1e-14, atol=scale)


def test_a_ball_in_the_air(library):
    jump, stroke = {"t_final": 0.1, **CLOSED}, {"speed": 4.0, "theta": 35.0}
    numbers = {f"cue.{name}": library.array(value) for name, value in stroke.items()}
    cue = carom.cue(phi=80.0, tip_time=0.0006, **stroke)
    shot = carom.simulate(TABLE, BALLS, cue, **jump)
    found = library.final(TABLE, BALLS, cue, numbers, **jump)
    assert found.z[0] > 0.03
    assert np.array_equal(found.z, shot.final["r"][:, 2])
    assert np.array_equal(found.v_z, shot.final["v"][:, 2])
    slopes = library.jacobians[-1](
        lambda numbers: library.final(TABLE, BALLS, cue, numbers, **jump).z, numbers
    )
    tangents = carom.tangents(shot, list(numbers)).final["z"]
    assert (tangents[0] != 0.0).all()
    assert np.array_equal(np.stack(list(slopes.values()), axis=-1), tangents)


def test_gradients_are_differences_of_shots(library):
    def miss(numbers):
        found = library.final(TABLE, BALLS, CUE, numbers, **CLOSED).r[1]
        return ((found - library.array(GOAL)) ** 2).sum()

    slopes, h = library.jacobians[-1](library.compiled(miss), numbers_of(library, STROKE)), 1e-6
    for k, name in enumerate(NAMES):
        more, less = (
            float(miss(numbers_of(library, STROKE + sign * h * np.eye(4)[k]))) for sign in (1, -1)
        )
        assert float(slopes[name]) == pytest.approx((more - less) / (2 * h), rel=1e-5)
    # places, constants of all balls and of one, the radius with the heights of the balls, spin:
    # each against a layout of its own
    start = carom.balls([[0.4, 0.5], [0.6, 1.5]], v=[[0.3, 1.4, 0.0], [0.0, 0.0, 0.0]])
    numbers = {
        "balls[1].r": [0.6, 1.5],
        "balls[0].r[1]": 0.5,
        "balls[0].v": [0.3, 1.4],
        "balls[0].w": [2.0, 1.0, 9.0],
        "kind.mu_slide": 0.2,
        "balls[1].kind.restitution": 0.94,
        "kind.radius": 0.0286,
        "kind.restitution_cushion": 0.85,
    }
    layout = carom.balls(
        [[0.4, numbers["balls[0].r[1]"]], numbers["balls[1].r"]],
        radius=numbers["kind.radius"],
        mu_slide=numbers["kind.mu_slide"],
        restitution_cushion=numbers["kind.restitution_cushion"],
        restitution=[0.95, numbers["balls[1].kind.restitution"]],
    )
    layout["state"]["v"][0, :2] = numbers["balls[0].v"]
    layout["state"]["w"][0] = numbers["balls[0].w"]
    expected = carom.simulate(TABLE, layout, **CLOSED)
    assert expected.count > 5 and (expected.events["type"] == carom.EventType.BALL_BALL).any()

    def places(numbers):
        return library.final(TABLE, start, None, numbers, **CLOSED).r

    numbers = {name: library.array(value) for name, value in numbers.items()}
    assert np.array_equal(places(numbers), expected.final["r"][:, :2])
    slopes = library.jacobians[-1](places, numbers)
    tangents = carom.tangents(expected, list(numbers)).final["r"]
    joined = np.concatenate([slope.reshape(2, 2, -1) for slope in slopes.values()], axis=-1)
    assert_allclose(joined, tangents, rtol=1e-13, atol=1e-13 * np.abs(tangents).max())


def test_clusters_banks_and_raised_strikes(library):
    """300 shots in one batch have the derivatives of tangents: strikes into three balls that touch,
    off a rail, and with a raised cue.
    """
    rack = [[0.635, 1.5], [0.635 + 0.05715, 1.5], [0.635 + 0.028575, 1.5 + 0.0494934]]
    random = np.random.default_rng(1)
    cues = carom.cue(
        speed=random.uniform(2.0, 3.0, 300),
        phi=[88.0, 20.0, 85.0] * 100 + random.normal(0.0, 1.0, 300),
        theta=[0.0, 0.0, 30.0] * 100,
        b=0.1,
    )
    names, balls = ["cue.speed", "cue.phi", "cue.theta", "cue.b"], carom.balls([[0.6, 0.5], *rack])
    found = library.jacobians[0](
        lambda numbers: library.final(TABLE, balls, cues, numbers).r.sum(axis=0),
        {name: library.array(cues[name[4:]]) for name in names},
    )
    for k, cue in enumerate(cues):
        expected = carom.tangents(carom.simulate(TABLE, balls, cue), names)
        places = expected.final["r"]
        has_cluster = (expected.flags & carom.Flag.CLUSTER).any()
        assert [has_cluster, True, np.abs(places[..., 2]).max() > 0.0][k % 3]
        slopes = np.stack([found[name][..., k] for name in names], axis=-1)
        assert_allclose(slopes, places, rtol=0.0, atol=1e-9 * np.abs(places).max())


def test_batches_of_layouts_cues_and_numbers(library):
    """Broadcast against each other, and compiled, with the bits of single shots and the derivatives
    of tangents.
    """
    layouts = carom.balls(
        [[[0.4, 0.5], [0.6, 1.5]], [[0.4, 0.6], [0.62, 1.4]], [[0.45, 0.5], [0.63, 1.45]]]
    )
    cues = carom.cue(speed=[[1.5], [1.9]], phi=79.0, b=0.1)
    phi = np.linspace(78.5, 79.5, 6).reshape(2, 3)
    numbers = {
        "cue.phi": library.array(phi),
        "balls[1].r": library.array(layouts["state"]["r"][:, 1, :2]),
        "kind.mu_slide": library.array(0.21),
    }
    layouts["kind"]["mu_slide"] = 0.21

    def play(numbers):
        return library.final(TABLE, layouts, cues, numbers, **CLOSED).r

    found, compiled = play(numbers), library.compiled(play)(numbers)
    slopes = library.jacobians[-1](lambda numbers: play(numbers).sum(axis=(0, 1)), numbers)
    assert found.shape == (2, 3, 2, 2) and np.array_equal(found, compiled)
    expected = {name: [] for name in numbers}
    for i, j in np.ndindex(2, 3):
        cue = cues[i, 0].copy()
        cue["phi"] = phi[i, j]
        shot = carom.simulate(TABLE, layouts[j], cue, **CLOSED)
        assert np.array_equal(found[i, j], shot.final["r"][:, :2])
        tangents = carom.tangents(shot, list(numbers)).final["r"]
        for name, part in zip(numbers, (tangents[..., 0], tangents[..., 1:3], tangents[..., 3])):
            expected[name].append(part)
    # of a sum over the batch, each shot has its own slope by its own number, and all of them one by
    # a number for all
    by_phi = np.reshape(expected["cue.phi"], (2, 3, 2, 2))
    by_place = np.reshape(expected["balls[1].r"], (2, 3, 2, 2, 2))
    sums = {
        "cue.phi": np.moveaxis(by_phi, (0, 1), (2, 3)),
        "balls[1].r": np.moveaxis(by_place.sum(axis=0), 0, 2),
        "kind.mu_slide": np.sum(expected["kind.mu_slide"], axis=0),
    }
    for name, slope in slopes.items():
        assert np.abs(slope).max() > 0.0
        assert_allclose(
            slope, sums[name], rtol=1e-12, atol=1e-12 * np.abs(sums[name]).max(), err_msg=name
        )
    wrong = np.zeros((2, 3))
    wrong[1, 2] = 2.0
    with pytest.raises(
        (ValueError, RuntimeError), match=r"shot \[1, 2\] of the batch, cue\.b = 2: .*cue"
    ):
        library.final(TABLE, layouts, cues, {"cue.b": library.array(wrong)}, **CLOSED)


def test_reach_and_flags_are_those_of_tangents(library):
    expected = carom.tangents(played(STROKE, **CLOSED), NAMES)
    many = np.stack([STROKE, np.add(STROKE, 0.01), STROKE])
    for numbers, place in ((STROKE, ()), (many.T, 2)):
        arrays = numbers_of(library, numbers)
        found = library.compiled(
            lambda arrays: library.final(TABLE, BALLS, CUE, arrays, reach=True, **CLOSED)
        )(arrays)
        plain = library.final(TABLE, BALLS, CUE, arrays, **CLOSED)
        reach = [float(np.asarray(found.reach[name])[place]) for name in NAMES]
        assert reach == expected.reach.tolist() and np.array_equal(found.r, plain.r)
        assert int(np.asarray(found.flags)[place]) == np.bitwise_or.reduce(expected.flags)
        assert plain.reach is None and plain.flags is None
    assert found.reach["cue.phi"].shape == found.flags.shape == (3,)


def test_a_shot_in_error_says_why(library):
    """Compiled too, which can sort the numbers, and where its derivatives are asked for; in a batch
    it can cost itself.
    """

    def places(numbers, **errors):
        return library.final(TABLE, BALLS, CUE, numbers, **CLOSED, **errors).r

    for call in (
        places,
        library.compiled(places),
        *(lambda numbers, j=jacobian: j(places, numbers) for jacobian in library.jacobians),
    ):
        with pytest.raises(
            (ValueError, RuntimeError),
            match=r"cue\.a = 0\.1, cue\.b = 2[:,].*must be -1 to 1",
        ):
            call(numbers_of(library, (1.5, 79.0, 0.1, 2.0)))
    both = {name: library.array([x, x]) for name, x in zip(NAMES, STROKE)}
    both["cue.b"] = library.array([0.1, 2.0])
    slopes = [
        slope[..., k, 1, :, k]
        for k in range(2)
        for slope in library.jacobians[-1](lambda x: places(x, errors="nan"), both).values()
    ]
    assert np.isfinite(slopes[:4]).all() and np.isnan(slopes[4:]).all()
    found = np.asarray(places(both, errors="nan"))
    assert np.isfinite(found[0]).all() and np.isnan(found[1]).all()


@pytest.mark.parametrize(
    ("message", "balls", "cue", "numbers"),
    [
        ("numbers: the list is empty; name at least one", BALLS, CUE, {}),
        ("numbers: unknown parameter 'cue.mu'", BALLS, CUE, {"cue.mu": 1.0}),
        (
            r".*the leading dimensions cannot be broadcast: cue\.phi \(3,\), cue\.a \(2,\)",
            BALLS,
            CUE,
            {"cue.phi": [1.0] * 3, "cue.a": [1.0] * 2},
        ),
        (
            r"numbers: 'balls\[1\]\.r': the shape is \(3,\), but must be \(\.\.\., 2\)",
            BALLS,
            CUE,
            {"balls[1].r": [1.0] * 3},
        ),
        (
            r"numbers: 'table\.nose_height' cannot differ within a batch",
            BALLS,
            CUE,
            {"table.nose_height": 0.036},
        ),
        (r"numbers: 'cue\.phi' is given, but there is no cue", BALLS, None, {"cue.phi": 1.0}),
        ("balls: the dtype is carom", CUE, CUE, {"cue.phi": 1.0}),
        ("cue: the dtype is carom", BALLS, BALLS, {"cue.phi": 1.0}),
    ],
)
def test_arguments_that_are_wrong(library, message, balls, cue, numbers):
    kind = TypeError if "dtype" in message else ValueError
    with pytest.raises(kind, match=f"^{message}"):
        library.final(
            TABLE, balls, cue, {name: library.array(value) for name, value in numbers.items()}
        )
    with pytest.raises(ValueError, match="errors: unknown value 'ignore'"):
        library.final(TABLE, BALLS, CUE, {"cue.phi": 1.0}, errors="ignore")
