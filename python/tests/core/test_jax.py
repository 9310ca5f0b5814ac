"""carom.jax: values are those of shots, derivatives those of carom.tangents and of differences;
batches, compiled code, errors.
"""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import run_python
from numpy.testing import assert_allclose, assert_array_equal

import carom
from carom import _functions, derivatives

jax = pytest.importorskip("jax", reason="JAX is not installed")
jax.config.update("jax_enable_x64", True)
import jax.numpy as jnp  # noqa: E402

import carom.jax  # noqa: E402

from gradient_cases import *  # noqa: E402, F403
from gradient_cases import BALLS, CLOSED, CUE, GOAL, NAMES, STROKE, TABLE, hessian_of_a_miss  # noqa: E402
from gradient_cases import played as shot_of  # noqa: E402

AIM, GOAL = jnp.array(STROKE), jnp.array(GOAL)


@pytest.fixture(scope="module")
def library():
    def slopes(jacobian):
        def by_name(function, numbers):
            found = jacobian(function)(numbers)  # in another order
            return {name: np.asarray(found[name]) for name in numbers}

        return by_name

    return SimpleNamespace(
        final=carom.jax.final,
        array=jnp.asarray,
        jacobians=[slopes(jax.jacfwd), slopes(jax.jacrev)],
        compiled=jax.jit,
    )


def played(aim, **models):
    return shot_of(aim, **{**CLOSED, **models})


def ends(aim, **models):
    return carom.jax.final(TABLE, BALLS, CUE, dict(zip(NAMES, aim)), **{**CLOSED, **models})


def miss(aim, **models):
    return ((ends(aim, **models).r[1] - GOAL) ** 2).sum()


def test_second_derivatives_are_those_of_hessian():
    """Through both modes in any order, compiled and mapped, and as a product with a vector."""
    expected, *_ = hessian_of_a_miss(**CLOSED)
    rev, fwd, jit = jax.jacrev, jax.jacfwd, jax.jit  # compiled, they take a fifth of the time
    modes = (jax.hessian(miss), jit(rev(rev(miss))), jit(fwd(fwd(miss))), jit(rev(fwd(miss))))
    for second in (jit(jax.hessian(miss)), *modes):
        assert_allclose(second(AIM), expected, rtol=1e-9)
    along = jnp.array([0.1, 0.2, 0.3, 0.4])
    assert_allclose(jax.jvp(jax.grad(miss), (AIM,), (along,))[1], expected @ along, rtol=1e-9)
    many = jit(jax.vmap(jax.hessian(miss)))(jnp.stack([AIM + 0.01, AIM]))
    assert_allclose(many[1], expected, rtol=1e-9)
    assert np.abs(many[0] - many[1]).max() > 1e-3


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
    assert_allclose(many(aims), singly, rtol=1e-13)
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


def test_a_batch_that_is_mapped_is_a_batch_of_batches():
    layouts = carom.balls([[[0.4, 0.5], [0.6, 1.5]], [[0.4, 0.6], [0.62, 1.4]]])
    cues, phi = carom.cue(speed=[[1.5], [1.9]], phi=79.0, b=0.1), jnp.array([[78.5, 79.5]] * 2)

    def play(phi):
        return carom.jax.final(TABLE, layouts, cues, {"cue.phi": phi}, **CLOSED).r

    more = jax.vmap(play)(jnp.stack([phi, phi + 0.1]))
    assert np.array_equal(more[0], play(phi)) and not np.array_equal(more[1], more[0])


def test_reach_and_flags_are_outputs_without_gradient():
    """In a batch too; what needs them can be differentiated."""

    def slopes_with_reach(aim):
        return ends(aim, reach=True)

    many = jax.vmap(slopes_with_reach)(jnp.stack([AIM, AIM + 0.01, AIM]))
    assert many.reach["cue.phi"].shape == many.flags.shape == (3,)
    assert many.reach["cue.phi"][2] == slopes_with_reach(AIM).reach["cue.phi"]

    def guarded(aim):
        found = slopes_with_reach(aim)
        in_reach = found.reach["cue.phi"] < 12.0 * 1e-3
        return jnp.where(in_reach, 0.0, ((found.r[1] - GOAL) ** 2).sum()) + found.reach["cue.phi"]

    value, slope = jax.value_and_grad(guarded)(AIM)
    assert np.isfinite(value) and np.array_equal(slope, jax.grad(miss)(AIM))
    assert jax.jacfwd(lambda aim: slopes_with_reach(aim).reach["cue.a"])(AIM).tolist() == [0.0] * 4
    assert_array_equal(
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
    assert_allclose(found, AIM[:2], atol=1e-9)


def test_shots_that_are_refused_say_why():
    both = jnp.stack([AIM, AIM, AIM.at[3].set(2.0)])
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
    with pytest.raises(NotImplementedError, match="shots have no third derivatives"):
        jax.jacfwd(jax.hessian(miss))(AIM)


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
    ran = run_python(script, "jax", 1)
    assert ran.stdout.count(" us, ratio ") == 3, ran.stdout
