"""carom.jax: values are those of shots, derivatives those of carom.tangents and of differences;
batches, compiled code, errors.
"""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import carom
from carom import _functions, derivatives

jax = pytest.importorskip("jax", reason="JAX is not installed")
jax.config.update("jax_enable_x64", True)
import jax.numpy as jnp  # noqa: E402

import carom.jax  # noqa: E402

TABLE = carom.tables.pool_9ft()
CLOSED = {"ball_model": "inelastic", "cushion_model": "smooth"}
BALLS = carom.balls([[0.4, 0.5], [0.6, 1.5], [0.9, 2.0]])
CUE = carom.cue(speed=1.5, phi=79.0, a=0.1, b=0.1)
AIM = jnp.array([1.5, 79.0, 0.1, 0.1])
GOAL = jnp.array([0.6, 1.0])
NAMES = ("cue.speed", "cue.phi", "cue.a", "cue.b")


def ends(aim, **models):
    return carom.jax.final(TABLE, BALLS, CUE, dict(zip(NAMES, aim)), **{**CLOSED, **models})


def miss(aim, **models):
    return ((ends(aim, **models).r[1] - GOAL) ** 2).sum()


def played(aim, **models):
    return carom.simulate(
        TABLE,
        BALLS,
        carom.cue(**dict(zip(("speed", "phi", "a", "b"), map(float, aim)))),
        **{**CLOSED, **models},
    )


def test_a_ball_in_the_air():
    jump, numbers = {"t_final": 0.1, **CLOSED}, {"cue.speed": 4.0, "cue.theta": 35.0}
    cue = carom.cue(phi=80.0, speed=4.0, theta=35.0, tip_time=0.0006)
    shot = carom.simulate(TABLE, BALLS, cue, **jump)
    found = carom.jax.final(TABLE, BALLS, cue, numbers, **jump)
    assert (
        found.z[0] > 0.03
        and np.array_equal(found.z, shot.final["r"][:, 2])
        and np.array_equal(found.v_z, shot.final["v"][:, 2])
    )
    slopes = jax.jacrev(lambda numbers: carom.jax.final(TABLE, BALLS, cue, numbers, **jump).z)(
        numbers
    )
    tangents = carom.tangents(shot, list(numbers)).final["z"]
    assert (tangents[0] != 0.0).all() and np.array_equal(
        np.stack(list(slopes.values()), axis=-1), tangents
    )


@pytest.mark.parametrize("models", [{}, {"ball_model": "exact"}, {"t_final": 0.9}])
def test_values_are_those_of_shots_and_derivatives_those_of_tangents(models):
    shot, found = played(AIM, **models), ends(AIM, **models)
    tangents = carom.tangents(shot, NAMES)
    forward, reverse = (
        jax.jacfwd(lambda aim: ends(aim, **models))(AIM),
        jax.jacrev(lambda aim: ends(aim, **models))(AIM),
    )
    for name, numbers in (("r", 2), ("v", 2), ("w", 3)):
        assert np.array_equal(getattr(found, name), shot.final[name][:, :numbers])
        expected = tangents.final[name]
        scale = 1e-14 * np.abs(expected).max()
        assert np.abs(expected).max() > 0.0 or "t_final" not in models or name != "w"
        np.testing.assert_allclose(getattr(forward, name), expected, rtol=1e-14, atol=scale)
        np.testing.assert_allclose(getattr(reverse, name), expected, rtol=1e-14, atol=scale)
    value, slope = jax.value_and_grad(miss)(AIM, **models)
    off = shot.final["r"][1, :2] - np.asarray(GOAL)
    assert float(value) == pytest.approx((off**2).sum(), rel=1e-14)
    np.testing.assert_allclose(slope, 2.0 * off @ tangents.final["r"][1], rtol=1e-12)


def test_gradients_are_differences_of_shots():
    slope, h = jax.jit(jax.grad(miss))(AIM), 1e-6
    for k in range(4):
        more, less = (miss(AIM.at[k].add(sign * h)) for sign in (1, -1))
        assert float(slope[k]) == pytest.approx(float(more - less) / (2 * h), rel=1e-5)
    # places, constants of all balls and of one, the radius with the heights of the balls, spin:
    # each against a layout of its own
    start = carom.balls([[0.4, 0.5], [0.6, 1.5]], v=[[0.3, 1.4, 0.0], [0.0, 0.0, 0.0]])
    numbers = {
        "balls[1].r": jnp.array([0.6, 1.5]),
        "balls[0].r[1]": 0.5,
        "balls[0].v": jnp.array([0.3, 1.4]),
        "balls[0].w": jnp.array([2.0, 1.0, 9.0]),
        "kind.mu_slide": 0.2,
        "balls[1].kind.restitution": 0.94,
        "kind.radius": 0.0286,
        "kind.restitution_cushion": 0.85,
    }

    def layout(numbers):
        layout = carom.balls(
            [[0.4, numbers["balls[0].r[1]"]], numbers["balls[1].r"]],
            radius=numbers["kind.radius"],
            mu_slide=numbers["kind.mu_slide"],
            restitution_cushion=numbers["kind.restitution_cushion"],
            restitution=[0.95, numbers["balls[1].kind.restitution"]],
        )
        layout["state"]["v"][0, :2], layout["state"]["w"][0] = (
            numbers["balls[0].v"],
            numbers["balls[0].w"],
        )
        return carom.simulate(TABLE, layout, **CLOSED)

    found = carom.jax.final(TABLE, start, None, numbers, **CLOSED)
    expected = layout(numbers)
    assert expected.count > 5 and (expected.events["type"] == carom.EventType.BALL_BALL).any()
    assert np.array_equal(found.r, expected.final["r"][:, :2])
    slopes = jax.jacrev(lambda numbers: carom.jax.final(TABLE, start, None, numbers, **CLOSED).r)(
        numbers
    )
    tangents = carom.tangents(expected, list(numbers)).final["r"]
    flat = np.concatenate([np.asarray(slopes[name]).reshape(2, 2, -1) for name in numbers], axis=-1)
    np.testing.assert_allclose(flat, tangents, rtol=1e-13, atol=1e-13 * np.abs(tangents).max())


def test_second_derivatives_are_those_of_hessian():
    """Through both modes in any order, compiled and mapped, and as a product with a vector."""
    shot = played(AIM)
    found, off = carom.hessian(shot, NAMES), shot.final["r"][1, :2] - np.asarray(GOAL)
    first = found.first.final["r"][1]
    expected = 2.0 * (first.T @ first + np.einsum("i,ijk->jk", off, found.final["r"][1]))
    rev, fwd = jax.jacrev, jax.jacfwd
    for second in (
        jax.hessian(miss),
        jax.jit(jax.hessian(miss)),
        rev(rev(miss)),
        fwd(fwd(miss)),
        rev(fwd(miss)),
    ):
        np.testing.assert_allclose(second(AIM), expected, rtol=1e-9)
    along = jnp.array([0.1, 0.2, 0.3, 0.4])
    np.testing.assert_allclose(
        jax.jvp(jax.grad(miss), (AIM,), (along,))[1], expected @ along, rtol=1e-9
    )
    many = jax.vmap(jax.hessian(miss))(jnp.stack([AIM + 0.01, AIM]))
    np.testing.assert_allclose(many[1], expected, rtol=1e-9)
    assert np.abs(many[0] - many[1]).max() > 1e-3


def test_clusters_banks_and_raised_strikes():
    """300 shots in one batch have the derivatives of tangents: strikes into three balls that touch,
    off a rail, and with a raised cue.
    """
    rack, random = (
        [[0.635, 1.5], [0.635 + 0.05715, 1.5], [0.635 + 0.028575, 1.5 + 0.0494934]],
        np.random.default_rng(1),
    )
    cues = carom.cue(
        speed=random.uniform(2.0, 3.0, 300),
        phi=[88.0, 20.0, 85.0] * 100 + random.normal(0.0, 1.0, 300),
        theta=[0.0, 0.0, 30.0] * 100,
        b=0.1,
    )
    names, balls = ["cue.speed", "cue.phi", "cue.theta", "cue.b"], carom.balls([[0.6, 0.5], *rack])
    found = jax.jacfwd(lambda numbers: carom.jax.final(TABLE, balls, cues, numbers).r.sum(axis=0))(
        {name: jnp.asarray(cues[name[4:]]) for name in names}
    )
    for k, cue in enumerate(cues):
        expected = carom.tangents(carom.simulate(TABLE, balls, cue), names)
        assert [
            (expected.flags & carom.Flag.CLUSTER).any(),
            True,
            np.abs(expected.final["r"][..., 2]).max() > 0.0,
        ][k % 3]
        slopes = np.stack([found[name][..., k] for name in names], axis=-1)
        np.testing.assert_allclose(
            slopes, expected.final["r"], rtol=0.0, atol=1e-9 * np.abs(expected.final["r"]).max()
        )


def test_vmap_is_one_batch_and_jit_changes_no_bit(monkeypatch):
    aims = AIM + jnp.linspace(0.0, 0.2, 6)[:, None] * jnp.array([1.0, 1.0, 0.1, 0.1])
    singly = np.array([jax.grad(miss)(aim) for aim in aims])
    assert np.isfinite(singly).all() and (np.ptp(singly, axis=0) > 0).all()
    batches = []

    def counted(*arguments, **more):
        shots = derivatives_simulate(*arguments, **more)
        batches.append(shots.shape)
        return shots

    derivatives_simulate = derivatives.simulate_batch
    monkeypatch.setattr(derivatives, "simulate_batch", counted)
    monkeypatch.setattr(_functions, "simulate_batch", counted)
    many = jax.jit(jax.vmap(jax.grad(miss)))
    np.testing.assert_allclose(many(aims), singly, rtol=1e-13)
    assert batches == [(6,)]
    # of a function of two batches: all pairs of speeds and directions; and without derivatives
    speeds, directions = aims[:, 0], aims[:4, 1]
    grid = jax.vmap(
        jax.vmap(lambda speed, phi: ends(jnp.stack([speed, phi, 0.1, 0.1])).r, (None, 0)), (0, None)
    )(speeds, directions)
    assert batches[1:] == [(6, 4)]
    for i, j in np.ndindex(6, 4):
        assert np.array_equal(
            grid[i, j], played([speeds[i], directions[j], 0.1, 0.1]).final["r"][:, :2]
        )
    # a batch of derivatives in many directions plays once
    jax.block_until_ready(jax.vmap(jax.jacfwd(lambda aim: ends(aim).r))(aims))
    assert batches[2:] == [(6,)]


def test_batches_of_layouts_cues_and_numbers():
    """Broadcast against each other, compiled and mapped, with the bits of single shots and the
    derivatives of tangents.
    """
    layouts = carom.balls(
        [[[0.4, 0.5], [0.6, 1.5]], [[0.4, 0.6], [0.62, 1.4]], [[0.45, 0.5], [0.63, 1.45]]]
    )
    cues = carom.cue(speed=[[1.5], [1.9]], phi=79.0, b=0.1)
    places = layouts["state"]["r"][:, 1, :2]
    numbers = {
        "cue.phi": jnp.linspace(78.5, 79.5, 6).reshape(2, 3),
        "balls[1].r": jnp.asarray(places),
        "kind.mu_slide": 0.21,
    }
    layouts["kind"]["mu_slide"] = 0.21

    def play(numbers):
        return carom.jax.final(TABLE, layouts, cues, numbers, **CLOSED).r

    found, compiled, slopes = (
        play(numbers),
        jax.jit(play)(numbers),
        jax.jacrev(lambda numbers: play(numbers).sum(axis=(0, 1)))(numbers),
    )
    assert found.shape == (2, 3, 2, 2) and np.array_equal(found, compiled)
    expected = {name: [] for name in numbers}
    for i, j in np.ndindex(2, 3):
        cue = cues[i, 0].copy()
        cue["phi"] = numbers["cue.phi"][i, j]
        shot = carom.simulate(TABLE, layouts[j], cue, **CLOSED)
        assert np.array_equal(found[i, j], shot.final["r"][:, :2])
        tangents = carom.tangents(shot, list(numbers)).final["r"]
        for name, part in zip(numbers, (tangents[..., 0], tangents[..., 1:3], tangents[..., 3])):
            expected[name].append(part)
    # of a sum over the batch, each shot has its own slope by its own number, and all of them one by
    # a number for all
    sums = {"kind.mu_slide": np.sum(expected["kind.mu_slide"], axis=0)}
    sums["cue.phi"] = np.moveaxis(np.reshape(expected["cue.phi"], (2, 3, 2, 2)), (0, 1), (2, 3))
    sums["balls[1].r"] = np.moveaxis(
        np.reshape(expected["balls[1].r"], (2, 3, 2, 2, 2)).sum(axis=0), 0, 2
    )
    for name, slope in slopes.items():
        assert np.abs(slope).max() > 0.0
        np.testing.assert_allclose(
            slope, sums[name], rtol=1e-12, atol=1e-12 * np.abs(sums[name]).max(), err_msg=name
        )
    # a batch that is mapped is a batch of batches
    more = jax.vmap(lambda phi: play({**numbers, "cue.phi": phi}))(
        jnp.stack([numbers["cue.phi"], numbers["cue.phi"] + 0.1])
    )
    assert np.array_equal(more[0], found) and not np.array_equal(more[1], found)
    with pytest.raises(
        (ValueError, RuntimeError), match=r"shot \[1, 2\] of the batch, cue\.b = 2: .*cue"
    ):
        carom.jax.final(
            TABLE, layouts, cues, {"cue.b": jnp.zeros((2, 3)).at[1, 2].set(2.0)}, **CLOSED
        )


def test_reach_and_flags_are_outputs_without_gradient():
    """Those of carom.tangents, in a batch and compiled; what needs them can be differentiated."""
    shot = played(AIM)
    expected = carom.tangents(shot, NAMES)
    flags = np.bitwise_or.reduce(expected.flags)

    def slopes_with_reach(aim):
        return ends(aim, reach=True)

    for found in (slopes_with_reach(AIM), jax.jit(slopes_with_reach)(AIM)):
        assert np.array_equal(np.stack([found.reach[name] for name in NAMES]), expected.reach)
        assert int(found.flags) == flags and np.array_equal(found.r, ends(AIM).r)
    many = jax.vmap(slopes_with_reach)(jnp.stack([AIM, AIM + 0.01, AIM]))
    assert many.reach["cue.phi"].shape == many.flags.shape == (3,)
    assert float(many.reach["cue.phi"][2]) == expected.reach[1]
    assert ends(AIM).reach is None and ends(AIM).flags is None

    def guarded(aim):
        found = slopes_with_reach(aim)
        in_reach = found.reach["cue.phi"] < 12.0 * 1e-3
        return jnp.where(in_reach, 0.0, ((found.r[1] - GOAL) ** 2).sum()) + found.reach["cue.phi"]

    value, slope = jax.value_and_grad(guarded)(AIM)
    assert np.isfinite(value) and np.array_equal(slope, jax.grad(miss)(AIM))
    assert jax.jacfwd(lambda aim: slopes_with_reach(aim).reach["cue.a"])(AIM).tolist() == [0.0] * 4
    np.testing.assert_array_equal(
        jax.hessian(lambda aim: slopes_with_reach(aim).r[1, 0])(AIM),
        jax.hessian(lambda aim: ends(aim).r[1, 0])(AIM),
    )
    # numbers of several elements, and a shot in error
    place = {"balls[0].r": jnp.array([[0.4, 0.5], [-0.4, 0.5]]), "cue.phi": 79.0}
    found = carom.jax.final(TABLE, BALLS, CUE, place, errors="nan", reach=True, **CLOSED)
    assert found.reach["balls[0].r"].shape == (2, 2) and np.isnan(found.reach["cue.phi"][1])


def test_a_search_in_compiled_code_improves_an_aim():
    goal = jnp.asarray(played(AIM).final["r"][1, :2])

    def off(x):
        return ends([x[0], x[1], 0.1, 0.1]).r[1] - goal

    @jax.jit
    def search(aim):
        return jax.lax.fori_loop(
            0, 6, lambda _, x: x - jnp.linalg.solve(jax.jacfwd(off)(x), off(x)), aim
        )

    start = AIM[:2] + jnp.array([2e-3, 1e-2])
    found = search(start)
    assert jnp.abs(off(start)).max() > 1e-3 and jnp.abs(off(found)).max() < 1e-12
    np.testing.assert_allclose(found, AIM[:2], atol=1e-9)


def test_shots_that_are_refused_say_why():
    invalid = AIM.at[3].set(2.0)
    for call in (ends, jax.jit(ends), jax.grad(miss), jax.jit(jax.grad(miss))):
        with pytest.raises(
            (ValueError, RuntimeError),
            match=r"cue\.speed = 1\.5, cue\.phi = 79, cue\.a = 0\.1, cue\.b = 2: .*must be -1 to 1",
        ):
            jax.block_until_ready(call(invalid))
    both = jnp.stack([AIM, AIM, invalid])
    with pytest.raises(
        (ValueError, RuntimeError), match=r"shot \[2\] of the batch, cue\.speed = 1\.5"
    ):
        jax.block_until_ready(jax.vmap(ends)(both))
    found = jax.vmap(lambda aim: ends(aim, errors="nan").r)(both)
    slopes = jax.vmap(jax.grad(lambda aim: miss(aim, errors="nan")))(both)
    for numbers in (found, slopes):
        assert np.isfinite(numbers[:2]).all() and np.isnan(numbers[2]).all()
    # what can be played, but not differentiated
    with pytest.raises((ValueError, RuntimeError), match="derivative"):
        jax.block_until_ready(
            jax.grad(
                lambda aim: miss(
                    aim, world="pooltool", ball_model="default", cushion_model="default"
                )
            )(AIM)
        )
    pooltool = {
        "world": "pooltool",
        "ball_model": "default",
        "cushion_model": "default",
        "errors": "nan",
    }
    value, slope = jax.value_and_grad(lambda aim: miss(aim, **pooltool))(AIM)
    assert np.isfinite(value) and np.isnan(slope).all()
    with pytest.raises((ValueError, RuntimeError), match="too little room"):
        jax.block_until_ready(jax.grad(lambda aim: miss(aim, room=2))(AIM))
    with pytest.raises(NotImplementedError, match="third derivatives of shots are not known"):
        jax.jacfwd(jax.hessian(miss))(AIM)


def test_arguments_that_are_wrong():
    phi, shape = {"cue.phi": 1.0}, "the shape must be"
    for error, match, balls, cue, numbers in (
        (ValueError, "numbers: name at least one", BALLS, CUE, {}),
        (ValueError, "numbers: 'cue.mu' is no number of a shot", BALLS, CUE, {"cue.mu": 1.0}),
        (
            ValueError,
            r"leading dimensions .* but are cue\.phi \(3,\), cue\.a \(2,\)",
            BALLS,
            CUE,
            {"cue.phi": jnp.ones(3), "cue.a": jnp.ones(2)},
        ),
        (
            ValueError,
            rf"numbers: balls\[1\]\.r: {shape} \(\.\.\., 2\), not \(3,\)",
            BALLS,
            CUE,
            {"balls[1].r": jnp.ones(3)},
        ),
        (
            ValueError,
            r"numbers: table\.nose_height: a batch has one table",
            BALLS,
            CUE,
            {"table.nose_height": 0.036},
        ),
        (ValueError, r"numbers: cue\.phi: there is no cue", BALLS, None, phi),
        (TypeError, "^balls: an array of the dtype of carom", CUE, CUE, phi),
        (TypeError, "^cue: an array of the dtype of carom", BALLS, BALLS, phi),
    ):
        with pytest.raises(error, match=match):
            carom.jax.final(TABLE, balls, cue, numbers)
    with pytest.raises(ValueError, match="errors: must be"):
        carom.jax.final(TABLE, BALLS, CUE, phi, errors="ignore")


def test_without_64_bits_the_error_says_what_to_do():
    jax.config.update("jax_enable_x64", False)
    try:
        with pytest.raises(TypeError, match='jax.config.update\\("jax_enable_x64", True\\)'):
            ends(AIM)
    finally:
        jax.config.update("jax_enable_x64", True)


def test_what_a_gradient_costs():
    """The example finds the gradients of tangents, and prints its rows."""
    script = Path(__file__).parents[2] / "examples" / "gradient_speed.py"
    ran = subprocess.run([sys.executable, str(script), "jax", "1"], capture_output=True, text=True)
    assert ran.returncode == 0 and ran.stdout.count(" us, ratio ") == 3, ran.stderr + ran.stdout
