"""Shots as functions that JAX differentiates.

    import jax
    jax.config.update("jax_enable_x64", True)
    import carom.jax

    def miss(aim):                              # cue speed, m/s, and phi, degrees
        ends = carom.jax.final(table, balls, cue, {"cue.speed": aim[0], "cue.phi": aim[1]})
        return ((ends.r[1] - goal) ** 2).sum()                 # of ball 1, m^2

    jax.value_and_grad(miss)(aim)
    jax.jit(jax.vmap(jax.grad(miss)))(aims)                    # all shots in one batch

C plays and differentiates the shots in callbacks. A batch, or a function under `jax.vmap`, is one
batch of `carom.simulate_batch`, and its derivative one batch of `carom.tangents`. `grad`, `jacfwd`
and `jacrev` use the Jacobian of `carom.tangents`; `hessian` uses `carom.hessian`, including its
nan. There are no third derivatives. With `final(..., reach=True)` the result includes reach and
flags, which limit a derivative (docs/using/derivatives.md).

Needs JAX with 64-bit numbers. Objects of JAX have no types here, so that carom can be type-checked
without it.
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
    """The shapes of `Shots.states`, or with slopes of `Shots.both`."""
    lead, m = x.shape[:-1], x.shape[-1]
    shape: Any = _jax.ShapeDtypeStruct
    states = (*lead, shots.count, STATE)
    first: tuple[Any, ...] = (shape(states, np.float64),)
    if slopes:
        first += (shape((*states, m), np.float64),)
    extras = (shape((*lead, m), np.float64), shape(lead, np.int32))
    return first + extras if shots.has_extras else first


def _constant(values: Any) -> Any:
    """The tangent of a value without a gradient."""
    whole = _jnp.issubdtype(values.dtype, _jnp.integer)
    return np.zeros(values.shape, _jax.dtypes.float0) if whole else _jnp.zeros_like(values)


# Each function is the derivative of the one before. The factor of a tangent does not depend on the
# tangent, so JAX can transpose the rules.
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
        "carom.jax: shots have no third derivatives; jax.hessian computes second derivatives"
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
    """Compute the final states of shots as a function that JAX can differentiate, compile and map.

    Parameters
    ----------
    table, balls, cue
        The shots, as for `carom.simulate_batch`; `numbers` overrides their fields. Leading
        dimensions of balls, cue and numbers are broadcast against each other.
    numbers : mapping of str to array_like
        The parameters to differentiate by, with the names of `carom.tangents`: "cue.phi",
        "kind.mu_slide" (all balls), "balls[1].kind.mass" and "balls[0].r[1]" of shape (...);
        "balls[0].r", "balls[0].v" (..., 2), "balls[0].w" (..., 3). Parameters of the table are not
        available, because a batch has one table; use "kind.nose_height", "kind.mu_cushion" and
        "kind.restitution_cushion" instead.
    room : int
        Largest number of events of a differentiated shot.
    errors : {"raise", "nan"}
        Whether a failed shot raises an exception or returns nan, so that the rest of the batch is
        kept.
    reach : bool
        Whether to compute `reach` and `flags`, for which shots are always differentiated.
    threads, options, **changes
        As for `carom.simulate_batch`. With t_final the states are the ones at that time.

    Returns
    -------
    Final

    Raises
    ------
    ValueError
        A name or a shape is invalid.
    TypeError
        64-bit numbers are disabled in JAX; the message shows how to enable them.
    jax.errors.JaxRuntimeError or ValueError
        A shot is invalid, fails, or cannot be differentiated; the last line contains its parameters
        and the reason. JAX converts exceptions of a callback to this one.
    """
    if _jax.dtypes.canonicalize_dtype(np.float64) != np.float64:
        raise TypeError(
            'carom.jax: 64-bit numbers are disabled; call jax.config.update("jax_enable_x64", True) first, or set JAX_ENABLE_X64=1'
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
