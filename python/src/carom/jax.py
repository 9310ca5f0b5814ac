"""Whole shots as functions that JAX differentiates.

    import jax
    jax.config.update("jax_enable_x64", True)
    import carom.jax

    def miss(aim):                              # (speed, phi) of the cue, m/s and degrees
        ends = carom.jax.final(table, balls, cue, {"cue.speed": aim[0], "cue.phi": aim[1]})
        return ((ends.r[1] - goal) ** 2).sum()                 # of ball 1, m^2

    jax.value_and_grad(miss)(aim)
    jax.jit(jax.vmap(jax.grad(miss)))(aims)                    # all shots in one batch

Shots are played and differentiated by C, in callbacks: a batch, or a function under `jax.vmap`, is
one batch of `carom.simulate_batch`, and its derivative one of `carom.tangents`. `grad`, `jacfwd`
and `jacrev` all use the Jacobian of `carom.tangents`, and `hessian` what `carom.hessian` finds, nan
where that is; third derivatives are not known. docs/using/derivatives.md says what a derivative
cannot tell: with `final(..., reach=True)` the result has its reach and its flags.

Needs JAX with 64-bit numbers. Its objects have no types here, so that carom can be checked without
it.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np

from carom import dtypes
from carom._functions import Final, Shots, named, shots_of
from carom._rows import listing, needed
from carom._shot_options import Options, chosen
from carom.derivatives import STATE
from carom.layouts import Table

__all__ = ["Final", "final"]
__dir__ = listing(__name__)

_jax: Any = needed("jax", __name__)
_jnp: Any = needed("jax.numpy", __name__)


def _shapes(shots: Shots, x: Any, *, slopes: bool) -> tuple[Any, ...]:
    """What `Shots.states` gives, or with slopes `Shots.both`."""
    lead, m = x.shape[:-1], x.shape[-1]
    shape: Any = _jax.ShapeDtypeStruct
    states = (*lead, shots.count, STATE)
    first: tuple[Any, ...] = (shape(states, np.float64),)
    if slopes:
        first += (shape((*states, m), np.float64),)
    extras = (shape((*lead, m), np.float64), shape(lead, np.int32))
    return first + extras if shots.has_extras else first


def _constant(values: Any) -> Any:
    """The change of what has no gradient."""
    whole = _jnp.issubdtype(values.dtype, _jnp.integer)
    return np.zeros(values.shape, _jax.dtypes.float0) if whole else _jnp.zeros_like(values)


# Each is differentiated by the next. What a tangent is multiplied by does not depend on the
# tangent, so that JAX can transpose the rules.
@functools.partial(_jax.custom_jvp, nondiff_argnums=(0,))
def _states(shots: Shots, x: Any) -> Any:
    shapes = _shapes(shots, x, slopes=False)
    return _jax.pure_callback(shots.states, shapes, x, vmap_method="expand_dims")


@functools.partial(_jax.custom_jvp, nondiff_argnums=(0,))
def _both(shots: Shots, x: Any) -> Any:
    shapes = _shapes(shots, x, slopes=True)
    return _jax.pure_callback(shots.both, shapes, x, vmap_method="expand_dims")


@functools.partial(_jax.custom_jvp, nondiff_argnums=(0,))
def _second(shots: Shots, x: Any) -> Any:
    shape = _jax.ShapeDtypeStruct(
        (*x.shape[:-1], shots.count, STATE, x.shape[-1], x.shape[-1]), np.float64
    )
    return _jax.pure_callback(shots.second, shape, x, vmap_method="expand_dims")


def _of_states(shots: Shots, primals: Any, changes: Any) -> Any:
    states, derivatives, *extras = _both(shots, primals[0])
    slope = _jnp.einsum("...bsm,...m->...bs", derivatives, changes[0])
    return (states, *extras), (slope, *map(_constant, extras))


def _of_both(shots: Shots, primals: Any, changes: Any) -> Any:
    states, derivatives, *extras = _both(shots, primals[0])
    slope = _jnp.einsum("...bsm,...m->...bs", derivatives, changes[0])
    bend = _jnp.einsum("...bsmk,...k->...bsm", _second(shots, primals[0]), changes[0])
    return (states, derivatives, *extras), (slope, bend, *map(_constant, extras))


def _of_second(shots: Shots, primals: Any, changes: Any) -> Any:
    raise NotImplementedError(
        "carom.jax: third derivatives of shots are not known; jax.hessian gives second ones"
    )


_states.defjvp(_of_states)
_both.defjvp(_of_both)
_second.defjvp(_of_second)


def final(
    table: Table,
    balls: dtypes.Records,
    cue: dtypes.Records | None,
    numbers: Mapping[str, Any],
    *,
    room: int = 512,
    errors: Literal["raise", "nan"] = "raise",
    reach: bool = False,
    threads: int = 0,
    options: Options = Options(),
    **changes: Any,
) -> Final:
    """The final states of shots, as a function of some of their numbers that JAX can differentiate,
    compile and map.

    Parameters
    ----------
    table, balls, cue
        The shots, as for `carom.simulate_batch`, where `numbers` say nothing else. Leading
        dimensions of balls, cue and numbers are broadcast against each other.
    numbers : mapping of str to array_like
        The numbers of the shots that take part in derivatives, by the names of `carom.tangents`:
        "cue.phi", "kind.mu_slide" (of all balls), "balls[1].kind.mass" and "balls[0].r[1]" of shape
        (...); "balls[0].r", "balls[0].v" (..., 2), "balls[0].w" (..., 3). Under `jax.vmap` all
        shots are one batch, too. Those of the table are left out, as a batch has one table: the
        balls' own "kind.nose_height", "kind.mu_cushion" and "kind.restitution_cushion" are used
        instead.
    room : int
        Events of a shot at most, where it is differentiated.
    errors : {"raise", "nan"}
        What a shot in error gives: an exception, or nan, so that the other shots of a batch are not
        lost.
    reach : bool
        Whether the result has `reach` and `flags`, for which shots are differentiated at any rate.
    threads, options, **changes
        As for `carom.simulate_batch`. With t_final the states are those at that time.

    Returns
    -------
    Final

    Raises
    ------
    ValueError
        A name or a shape is wrong.
    TypeError
        JAX has no 64-bit numbers: the error says what to set.
    jax.errors.JaxRuntimeError or ValueError
        A shot is refused, ends in an error or cannot be differentiated: the last line has its
        numbers, and what is wrong with it. JAX makes this exception of what a callback raises.
    """
    if _jax.dtypes.canonicalize_dtype(np.float64) != np.float64:
        raise TypeError(
            'carom.jax needs 64-bit numbers: set jax.config.update("jax_enable_x64", True) first, or JAX_ENABLE_X64=1'
        )
    shots, parts, batch = shots_of(
        table,
        balls,
        cue,
        numbers,
        lambda value: _jnp.asarray(value, np.float64),
        room,
        errors,
        threads,
        chosen(options, changes),
        bool(reach),
    )
    wide = [_jnp.broadcast_to(part, shape).reshape((*batch, -1)) for part, shape in parts]
    return named(shots, *_states(shots, _jnp.concatenate(wide, axis=-1)))
