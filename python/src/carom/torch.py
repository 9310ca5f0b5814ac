"""Shots as functions that PyTorch differentiates.

    import torch
    import carom.torch

    # cue speed, m/s, and phi, degrees
    aim = torch.tensor([1.5, 79.0], dtype=torch.float64, requires_grad=True)
    ends = carom.torch.final(table, balls, cue, {"cue.speed": aim[0], "cue.phi": aim[1]})
    miss = ((ends.r[1] - goal) ** 2).sum()                                       # of ball 1, m^2
    miss.backward()
    aim.grad

C plays and differentiates the shots on the CPU. A call, or a function under `torch.func.vmap`, is
one batch of `carom.simulate_batch`, or of `carom.jacobian` if a parameter requires a gradient.
`backward`, forward mode and `torch.func` use the Jacobian of `carom.tangents`; second derivatives
use `carom.hessian`, including its nan. There are no third derivatives. `torch.compile` does not
compile shots. With `final(..., reach=True)` the result includes reach and flags, which limit a
derivative (docs/using/derivatives.md).

Objects of PyTorch have no types here, so that carom can be type-checked without it.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np

from carom import dtypes
from carom._functions import Final, named, shots_of
from carom._rows import listing, needed
from carom._shot_options import Options, chosen
from carom.layouts import Table

__all__ = ["Final", "final"]
__dir__ = listing(__name__)

_torch: Any = needed("torch", __name__)


def _front(x: Any, dim: int | None, size: int) -> Any:
    """An argument under vmap, with the dimension of the batch in front."""
    return x.expand(size, *x.shape) if dim is None else x.movedim(dim, 0)


def _forward_modes() -> int:
    """The number of enclosing forward modes of torch.func."""
    around = _torch._C._functorch
    return sum(
        level.key() == around.TransformType.Jvp for level in around.get_interpreter_stack() or ()
    )


def _refuse(*_: Any) -> Any:
    raise NotImplementedError(
        "carom.torch: shots have no third derivatives; torch.func.hessian and create_graph=True compute second derivatives"
    )


class _Known(_torch.autograd.Function):
    """A function of shots and their parameters (..., m).

    Its derivative is another such function, so that it can be differentiated again.
    """

    plain: Any = None

    @classmethod
    def evaluate(cls, *inputs: Any) -> Any:
        return (cls if cls.plain is None or _transformed() else cls.plain).apply(*inputs)

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        ctx.shots, saved = (
            inputs[0],
            (inputs[1], *(output[1:] if isinstance(output, tuple) else ())),
        )
        ctx.save_for_backward(*saved)
        ctx.save_for_forward(*saved)
        ctx.mark_non_differentiable(*saved[1:])

    backward = jvp = staticmethod(_refuse)


class _States(_Known):
    """The final states (..., balls, STATE), with their derivatives (..., balls, STATE, m) if
    requested, and with reach and flags if requested.
    """

    @staticmethod
    def forward(shots: Any, x: Any, differentiated: bool) -> Any:
        numbers = x.detach().numpy()
        if differentiated:
            states, slopes, *extras = shots.both(numbers)
        else:
            (states, *extras), slopes = shots.states(numbers), numbers[..., 0].copy()
        return tuple(map(_torch.from_numpy, map(np.asarray, (states, slopes, *extras))))

    @staticmethod
    def backward(ctx: Any, cotangent: Any, *_: Any) -> Any:
        x, slopes = ctx.saved_tensors[:2]
        if _torch.is_grad_enabled() or slopes.ndim < x.ndim:
            slopes = _Slopes.evaluate(ctx.shots, x, slopes)
        return (
            None,
            (cotangent.flatten(-2).unsqueeze(-2) @ slopes.flatten(-3, -2)).squeeze(-2),
            None,
        )

    @staticmethod
    def jvp(ctx: Any, _: Any, change: Any, __: Any) -> Any:
        if hasattr(_torch, "func") and _forward_modes() > 1:
            raise NotImplementedError(
                "carom.torch: PyTorch loses derivatives in nested forward modes; use torch.func.hessian, or jacrev twice"
            )
        slopes = _Slopes.evaluate(ctx.shots, *ctx.saved_tensors[:2])
        change_of_states = _torch.einsum("...bsm,...m->...bs", slopes, change)
        return (change_of_states, None, *(None for _ in ctx.saved_tensors[2:]))

    @staticmethod
    def vmap(info: Any, dims: Any, shots: Any, x: Any, differentiated: bool) -> Any:
        found = _States.evaluate(shots, _front(x, dims[1], info.batch_size), differentiated)
        return found, (0,) * len(found)


class _Slopes(_Known):
    """The derivatives of the final states, computed unless they are given."""

    @staticmethod
    def forward(shots: Any, x: Any, slopes: Any) -> Any:
        return (
            slopes.detach()
            if slopes.ndim > x.ndim
            else _torch.from_numpy(shots.both(x.detach().numpy())[1])
        )

    @staticmethod
    def backward(ctx: Any, cotangent: Any) -> Any:
        return (
            None,
            _torch.einsum(
                "...bsmk,...bsm->...k", _Second.evaluate(ctx.shots, *ctx.saved_tensors), cotangent
            ),
            None,
        )

    @staticmethod
    def jvp(ctx: Any, _: Any, change: Any, __: Any) -> Any:
        return _Along.evaluate(ctx.shots, *ctx.saved_tensors, change)

    @staticmethod
    def vmap(info: Any, dims: Any, shots: Any, x: Any, slopes: Any) -> Any:
        return _Slopes.evaluate(
            shots, _front(x, dims[1], info.batch_size), _front(slopes, dims[2], info.batch_size)
        ), 0


class _Second(_Known):
    """The second derivatives (..., balls, STATE, m, m)."""

    @staticmethod
    def forward(shots: Any, x: Any) -> Any:
        return _torch.from_numpy(shots.second(x.detach().numpy()))

    @staticmethod
    def vmap(info: Any, dims: Any, shots: Any, x: Any) -> Any:
        return _Second.evaluate(shots, _front(x, dims[1], info.batch_size)), 0


class _Along(_Known):
    """The change (several..., ..., balls, STATE, m) of the derivatives along vectors (several...,
    ..., m).
    """

    @staticmethod
    def forward(shots: Any, x: Any, change: Any) -> Any:
        vectors = np.moveaxis(change.detach().numpy().reshape(-1, *x.shape), 0, -2)
        slopes = np.moveaxis(shots.along(x.detach().numpy(), vectors), -1, 0)
        return _torch.from_numpy(
            slopes.reshape(*change.shape[: change.ndim - x.ndim], *slopes.shape[1:])
        )

    @staticmethod
    def vmap(info: Any, dims: Any, shots: Any, x: Any, change: Any) -> Any:
        if dims[1] is None:
            return _Along.evaluate(shots, x, change.movedim(dims[2], 0)), 0
        x, change = x.movedim(dims[1], 0), _front(change, dims[2], info.batch_size)
        return _Along.evaluate(shots, x, change.movedim(0, -x.ndim)), change.ndim - x.ndim


def _plain(kind: Any) -> Any:
    """The same class without setup_context.

    PyTorch 1.13 lacks it, and newer versions with it bind arguments by name at each call.
    """

    def forward(ctx: Any, *inputs: Any) -> Any:
        output = kind.forward(*inputs)
        kind.setup_context(ctx, inputs, output)
        return output

    older = (
        {"setup_context": staticmethod(base)}
        if (base := getattr(_torch.autograd.Function, "setup_context", None))
        else {}
    )
    return type(kind.__name__, (kind,), {"forward": staticmethod(forward), **older})


_transformed = getattr(_torch._C, "_are_functorch_transforms_active", bool)
for _kind in (_States, _Slopes, _Second, _Along):
    _kind.plain = _plain(_kind)


def _play(
    table: Any,
    balls: Any,
    cue: Any,
    numbers: Any,
    room: int,
    errors: str,
    threads: int,
    options: Any,
    changes: Any,
    reach: bool,
) -> Final:
    shots, parts, batch = shots_of(
        table,
        balls,
        cue,
        numbers,
        lambda value: _torch.as_tensor(value, dtype=_torch.float64, device="cpu"),
        room,
        errors,
        threads,
        chosen(options, changes),
        reach,
    )
    wide = [
        part if part.shape == shape else _torch.broadcast_to(part, shape) for part, shape in parts
    ]
    is_single = all(shape == batch for _, shape in parts)
    x = (
        _torch.stack(wide, -1)
        if is_single
        else _torch.cat([part[..., None] if part.ndim == len(batch) else part for part in wide], -1)
    )
    differentiated = (
        x.requires_grad and _torch.is_grad_enabled()
    ) or _torch.autograd.forward_ad.unpack_dual(x).tangent is not None
    states, _, *extras = _States.evaluate(shots, x, differentiated)
    if extras:
        return named(shots, states, *extras)
    # one call of PyTorch takes the time of some of the shot
    r, v, w, z, v_z = states.split((2, 2, 3, 1, 1), -1)
    return Final(r, v, w, z[..., 0], v_z[..., 0])


# torch.compile leaves the first out of its graphs; the second is true where it traces. It is a
# module that takes seconds to import.
_left_out = (
    _play
    if (_ways := getattr(_torch, "compiler", None)) is None
    else _torch._compile._disable_dynamo(_play)
)
_compiling = getattr(_ways, "is_compiling", bool)


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
    """Compute the final states of shots as a function that PyTorch can differentiate.

    Parameters
    ----------
    table, balls, cue
        The shots, as for `carom.simulate_batch`; `numbers` overrides their fields. Leading
        dimensions of balls, cue and numbers are broadcast against each other.
    numbers : mapping of str to tensor or array_like
        The parameters to differentiate by, with the names of `carom.tangents`: "cue.phi",
        "kind.mu_slide" (all balls), "balls[1].kind.mass" and "balls[0].r[1]" of shape (...);
        "balls[0].r", "balls[0].v" (..., 2), "balls[0].w" (..., 3). Tensors of other types and
        devices are converted to float64 on the CPU. Parameters of the table are not available,
        because a batch has one table; use "kind.nose_height", "kind.mu_cushion" and
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
        Tensors of float64 on the CPU.

    Raises
    ------
    ValueError
        A name or a shape is invalid.
    CaromError
        A shot is invalid, fails, or cannot be differentiated; the message contains its parameters
        and the reason.
    """
    play = _left_out if _compiling() or "torch._dynamo" in sys.modules else _play
    return play(table, balls, cue, numbers, room, errors, threads, options, changes, bool(reach))
