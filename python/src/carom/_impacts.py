"""Impacts of two balls, and of a ball and a cushion.

Resolves batches and single impacts, traces an impact in steps, and makes the exception for an
invalid one.
"""

from __future__ import annotations

import functools
import reprlib
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import (
    FLOAT32,
    FLOAT64,
    INT8,
    Array,
    apart,
    in_chunks,
    output,
    pointer,
    rows,
    whole,
)
from carom.status import CaromError


class Outcome(NamedTuple):
    """The result of impacts: the motion after each, and its status."""

    motion: Array
    status: Array


class Kind(NamedTuple):
    """A kind of impact: its records, their names in C, and the functions of C."""

    source: dtypes.Record
    gives: dtypes.Record
    point: dtypes.Record
    names: tuple[str, str, str]
    batch: Callable[..., int]
    trace: Callable[..., int]
    check: Callable[..., int]
    field_name: Callable[[int], Any]
    single: Callable[..., int] | None = (
        None  # a single call, with the bits of a batch and without filling lanes
    )
    batch_f32: Callable[..., int] | None = None


BALLS = Kind(
    dtypes.impact,
    dtypes.result,
    dtypes.trace_point,
    ("carom_impact", "carom_result", "carom_trace_point"),
    lib.carom_collide_batch,
    lib.carom_trace,
    lib.carom_check,
    lib.carom_field_name,
    lib.carom_collide,
    lib.carom_collide_batch_f32,
)
CUSHION = Kind(
    dtypes.cushion_impact,
    dtypes.motion,
    dtypes.cushion_point,
    ("carom_cushion_impact", "carom_motion", "carom_cushion_point"),
    lib.carom_cushion_batch,
    lib.carom_cushion_trace,
    lib.carom_cushion_check,
    lib.carom_cushion_field_name,
)


def resolve(
    kind: Kind,
    impacts: ArrayLike,
    options: Any,
    seconds: float,
    threads: int,
    out: tuple[Array, Array] | None,
) -> Outcome:
    """Resolve impacts; `seconds` is the time that one takes."""
    array = rows(impacts, kind.source, "impacts", single=kind.batch_f32 is not None)
    record = array.dtype.names is not None
    shape: tuple[int, ...] = array.shape if record else array.shape[:-1]
    if out is not None and not (isinstance(out, tuple) and len(out) == 2):
        raise TypeError(
            f"out: {reprlib.repr(out)} is not a tuple of two arrays, such as an earlier result"
        )
    motion, status = (None, None) if out is None else out
    if record:
        motion = output(motion, shape, kind.gives, "out[0]")
    else:
        motion = output(motion, (*shape, kind.gives.itemsize // 8), array.dtype, "out[0]")
    status = output(status, shape, INT8, "out[1]")
    if out is not None:
        apart((("impacts", array),), (("out[0]", motion), ("out[1]", status)))

    input_type, gives, _ = kind.names
    single = array.dtype is not FLOAT64 and array.dtype == FLOAT32
    if shape == () and not single and kind.single is not None:
        code = kind.single(
            pointer(f"{input_type}[]", array), options, pointer(f"{gives}[]", motion)
        )
        status[...] = code
    else:
        width, batch = ("_f32", kind.batch_f32) if single else ("", kind.batch)
        source, target = (
            pointer(f"{input_type}{width}[]", array),
            pointer(f"{gives}{width}[]", motion),
        )
        flags = pointer("int8_t[]", status)

        def solve(begin: int, count: int) -> int:
            return int(batch(source + begin, count, options, target + begin, flags + begin))  # type: ignore[misc]

        code = in_chunks(status.size, seconds, threads, solve)
    if code < 0 and shape == ():
        raise _error(kind, code, array, options)
    return Outcome(motion, status)


_NUMBERS = ffi.typeof("double[]")


@functools.cache
def _types(input_name: str, gives: str) -> tuple[Any, Any, int]:
    """Pointer types of an impact and its motion, and the length of the motion in doubles."""
    return ffi.typeof(f"{input_name} *"), ffi.typeof(f"{gives} *"), ffi.sizeof(gives) // 8


def resolve_one(kind: Kind, numbers: list[float], options: Any) -> Array:
    """The motion after one impact, whose values are in the order of its record.

    Faster than `resolve`, which inspects arrays. This matters to an engine that resolves impacts
    one at a time.
    """
    input_type, gives, size = _types(kind.names[0], kind.names[1])
    impact = ffi.new(_NUMBERS, numbers)
    motion = np.empty(size)
    source, target = ffi.cast(input_type, impact), ffi.cast(gives, ffi.from_buffer(motion))
    if kind.single is not None:
        code = kind.single(source, options, target)
    else:
        code = kind.batch(source, 1, options, target, ffi.NULL)
    if code < 0:
        raise _error(kind, code, np.array(numbers), options)
    return motion


def trace(kind: Kind, impact: ArrayLike, points: int, options: Any) -> dtypes.Records:
    """Follow one impact."""
    array = rows(impact, kind.source, "impact")
    if (array.shape if array.dtype.names is not None else array.shape[:-1]) != ():
        width = kind.source.itemsize // 8
        raise ValueError(
            f"impact: a trace follows one impact, of shape ({width},), or structured of shape (); loop over several"
        )
    traced = np.zeros(whole(points, "points", least=2), kind.point)
    input_type, _, point = kind.names
    code = kind.trace(
        pointer(f"{input_type}[]", array), options, traced.size, pointer(f"{point}[]", traced)
    )
    if code < 0:
        raise _error(kind, code, array, options)
    return traced


def _error(kind: Kind, code: int, array: Array, options: Any) -> CaromError:
    """The exception for one impact, with the name of the invalid field."""
    numbers = (
        np.ascontiguousarray(array)
        .reshape(-1)
        .view(FLOAT32 if array.dtype == FLOAT32 else FLOAT64)
        .astype(np.float64)
    )
    field = ffi.new("int *", -1)
    if kind.check(pointer(f"{kind.names[0]}[]", numbers), options, field) == code and field[0] >= 0:
        return CaromError(code, ffi.string(kind.field_name(field[0])).decode(), numbers[field[0]])
    return CaromError(code)
