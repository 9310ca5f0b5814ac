"""Arrays as C takes them: rows of numbers without gaps, converted only where the layout does not fit."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom._carom import ffi

Array = npt.NDArray[Any]
FLOAT32 = np.dtype(np.float32)
FLOAT64 = np.dtype(np.float64)
INT8 = np.dtype(np.int8)


def rows(values: npt.ArrayLike, record: np.dtype[Any], name: str, single: bool = False) -> Array:
    """The values as an array in C order: of the record, of shape (..., width) in double, or in single precision if allowed."""
    array = np.asarray(values)
    width = record.itemsize // 8
    # The usual case is told by identity: comparing with a structured dtype takes longer than all else here.
    if array.dtype is FLOAT64 or array.dtype != record:
        if array.dtype.names is not None:
            raise TypeError(f"{name}: a structured array must have the dtype {record}")
        if array.dtype is not FLOAT64 and not (single and array.dtype == FLOAT32):
            array = array.astype(np.float64)
        if array.ndim == 0 or array.shape[-1] != width:
            raise ValueError(f"{name}: the shape must be (..., {width}), not {array.shape}")
    flags = array.flags
    if not (flags.c_contiguous and flags.aligned):
        array = array.copy(order="C")
    return array


def output(given: Array | None, shape: tuple[int, ...], dtype: np.dtype[Any], name: str) -> Array:
    """The array given to be written to, checked, or a new one."""
    if given is None:
        return np.empty(shape, dtype)
    flags = given.flags
    right = given.shape == shape and (given.dtype is dtype or given.dtype == dtype)
    if not (right and flags.c_contiguous and flags.writeable and flags.aligned):
        raise ValueError(
            f"{name}: a writeable array in C order of shape {shape} and dtype {dtype} is needed, not of shape {given.shape} and "
            f"dtype {given.dtype}"
        )
    return given


pointer: Any = ffi.from_buffer
"""pointer(ctype, array): the array's memory as a C array, which keeps the array alive."""


def choice(names: dict[str, int], value: str, option: str) -> int:
    """The number of a named option."""
    try:
        return names[value]
    except KeyError:
        raise ValueError(f"{option}: must be one of {', '.join(map(repr, names))}, not {value!r}") from None


def fill(record: np.dtype[Any], vectors: dict[str, int], fields: dict[str, npt.ArrayLike]) -> Array:
    """An array of the record from fields that are broadcast against each other. A field "a.v" is v of the part a."""
    arrays: dict[str, npt.NDArray[np.float64]] = {}
    shapes: list[tuple[int, ...]] = []
    for name, value in fields.items():
        array = np.asarray(value, dtype=np.float64)
        length = vectors.get(name.rpartition(".")[2])
        if length is not None:
            if array.ndim == 0:
                array = np.broadcast_to(array, (length,))
            if array.shape[-1] != length:
                raise ValueError(f"{name}: the shape must be (..., {length}), not {array.shape}")
            shapes.append(array.shape[:-1])
        else:
            shapes.append(array.shape)
        arrays[name] = array
    filled: Array = np.zeros(np.broadcast_shapes(*shapes), record)
    for name, array in arrays.items():
        part: Any = filled
        *parts, last = name.split(".")
        for inner in parts:
            part = part[inner]
        part[last] = array
    return filled
