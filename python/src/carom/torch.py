"""Whole shots as functions that PyTorch differentiates.

    import torch
    import carom.torch

    aim = torch.tensor([1.5, 79.0], dtype=torch.float64, requires_grad=True)     # (speed, phi) of the cue, m/s and degrees
    ends = carom.torch.final(table, balls, cue, {"cue.speed": aim[0], "cue.phi": aim[1]})
    miss = ((ends.r[1] - goal) ** 2).sum()                                       # of ball 1, m^2
    miss.backward()
    aim.grad

Shots are played and differentiated by C on the CPU: a call is one batch of `carom.simulate_batch`, or, where a number needs a gradient, one
of `carom.jacobian`. `backward` and `torch.autograd.functional.jacobian` use the Jacobian of `carom.tangents`;
second derivatives are not known. docs/using/derivatives.md says what a derivative cannot tell: `carom.jacobian(..., of="reach")` has its reach.

Its objects have no types here, so that carom can be checked without PyTorch.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import Any, Literal

from carom import dtypes
from carom._functions import Final, named, shots_of
from carom._rows import listing
from carom._shot_options import Options, chosen
from carom.layouts import Table

__all__ = ["Final", "final"]
__dir__ = listing(__name__)

try:
    _torch: Any = importlib.import_module("torch")
except ImportError as missing:
    raise ImportError("carom.torch needs PyTorch, which is not installed here: pip install torch", name=missing.name) from missing


class _States(_torch.autograd.Function):
    """The final states (..., balls, STATE) of shots with numbers (..., m), played together with the Jacobian where one is needed."""

    @staticmethod
    def forward(ctx: Any, shots: Any, x: Any, differentiated: bool) -> Any:
        numbers = x.detach().numpy()
        if not differentiated:
            return _torch.from_numpy(shots.states(numbers))
        states, derivatives = shots.both(numbers)
        ctx.jacobian = _torch.from_numpy(derivatives)  # (..., balls, STATE, m)
        return _torch.from_numpy(states)

    @staticmethod
    def backward(ctx: Any, cotangent: Any) -> Any:
        if _torch.is_grad_enabled():
            raise NotImplementedError("carom.torch: second derivatives of shots are not known; first ones need no create_graph=True")
        return None, _torch.einsum("...bsm,...bs->...m", ctx.jacobian, cotangent), None


def final(
    table: Table, balls: dtypes.Records, cue: dtypes.Records | None, numbers: Mapping[str, Any], *, room: int = 512,
    errors: Literal["raise", "nan"] = "raise", threads: int = 0, options: Options = Options(), **changes: Any
) -> Final:  # fmt: skip
    """The final states of shots, as a function of some of their numbers that PyTorch can differentiate.

    Parameters
    ----------
    table, balls, cue
        The shots, as for `carom.simulate_batch`, where `numbers` say nothing else. Leading dimensions of balls, cue and numbers are broadcast against each other.
    numbers : mapping of str to tensor or array_like
        The numbers of the shots that take part in derivatives, by the names of `carom.tangents`: "cue.phi", "kind.mu_slide" (of all
        balls), "balls[1].kind.mass" and "balls[0].r[1]" of shape (...); "balls[0].r", "balls[0].v" (..., 2), "balls[0].w" (..., 3).
        Tensors of other types and devices are converted to float64 on the CPU. Numbers of the table are left out, as a batch has one
        table: the balls' own "kind.nose_height", "kind.mu_cushion" and "kind.restitution_cushion" are used instead.
    room : int
        Events of a shot at most, where it is differentiated.
    errors : {"raise", "nan"}
        What a shot in error gives: an exception, or nan, so that the other shots of a batch are not lost.
    threads, options, **changes
        As for `carom.simulate_batch`. With t_final the states are those at that time.

    Returns Final: Tensors of float64 on the CPU.
    Raises ValueError: A name or a shape is wrong.
    Raises CaromError: A shot is refused, ends in an error or cannot be differentiated: its numbers, and what is wrong with it.
    """
    shots, parts = shots_of(
        table, balls, cue, numbers, lambda value: _torch.as_tensor(value, dtype=_torch.float64, device="cpu"), room, errors, threads,
        chosen(options, changes),
    )  # fmt: skip
    x = _torch.cat([_torch.broadcast_to(part, shape) for part, shape in parts], dim=-1)
    return named(_States.apply(shots, x, x.requires_grad and _torch.is_grad_enabled()))
