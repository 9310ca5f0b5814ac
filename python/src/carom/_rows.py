"""Arrays as C takes them: rows of numbers without gaps, converted only where the layout does not
fit.
"""

from __future__ import annotations

import functools
import importlib
import math
import numbers
import operator
import os
import re
import reprlib
import sys
import time
from collections.abc import Callable, Hashable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar, cast

import numpy as np
import numpy.typing as npt

from carom._carom import ffi, lib
from carom.dtypes import described

Array = npt.NDArray[Any]
FLOAT32 = np.dtype(np.float32)
FLOAT64 = np.dtype(np.float64)
INT8 = np.dtype(np.int8)


class Arrays:
    """A dataclass of arrays, which shows their shapes instead of their numbers."""

    def __repr__(self) -> str:
        parts = (
            f"{name} {value.shape}" if isinstance(value, np.ndarray) else f"{name} {value!r}"
            for name, value in vars(self).items()
        )
        return f"<carom.{type(self).__name__}: {', '.join(parts)}>"


def as_array(values: npt.ArrayLike, name: str, dtype: npt.DTypeLike | None = None) -> Array:
    """np.asarray(), but that what cannot be read is refused by its name, and so are masks and
    imaginary parts, which would be lost.

    Of a dtype that numbers have, text and None are refused too, which NumPy would read as numbers
    and nan.
    """
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError(
            f"{name}: masks are not read; give the rows that count alone (compressed), or the array's filled() values"
        )
    try:
        array = np.asarray(values)
        if dtype is None or array.dtype == dtype:
            return array
        if array.dtype.kind in "biuf" or (
            array.dtype.kind == "O" and not any(_is_text(item) for item in array.flat)
        ):
            with np.errstate(all="ignore"):
                return array.astype(dtype)
    except (TypeError, ValueError, OverflowError) as wrong:
        if dtype is None or isinstance(values, np.ndarray) or "shape" in str(wrong):
            raise (TypeError if isinstance(wrong, TypeError) else ValueError)(
                f"{name}: {wrong}"
            ) from None
    raise TypeError(f"{name}: real numbers are needed, not {reprlib.repr(values)}")


def _is_text(value: object) -> bool:
    return value is None or isinstance(value, (str, bytes))


def number(value: object, name: str, needed: str = "a real number is needed") -> float:
    """A number; anything else is refused by its name."""
    if isinstance(value, (float, int, np.ndarray, numbers.Real)) or hasattr(value, "__float__"):
        array = as_array(value, name, np.float64)  # type: ignore[arg-type]
        if array.size == 1:
            return float(array.reshape(()))
    raise TypeError(f"{name}: {needed}, not {reprlib.repr(value)}")


def several(values: object, name: str, needed: str) -> list[Any]:
    """What an argument lists; a text, or what cannot be listed, is refused by its name."""
    if not isinstance(values, (str, bytes)):
        try:
            return [*values]  # type: ignore[misc]
        except TypeError:
            pass
    raise TypeError(f"{name}: {needed}, not {reprlib.repr(values)}")


def rows(values: npt.ArrayLike, record: np.dtype[Any], name: str, single: bool = False) -> Array:
    """The values as an array in C order: of the record, of shape (..., width) in double, or in
    single precision if allowed.
    """
    array = as_array(values, name)
    width = record.itemsize // 8
    # The usual case is told by identity: comparing with a structured dtype takes longer than all
    # else here.
    if array.dtype is FLOAT64 or array.dtype != record:
        if array.dtype.names is not None:
            raise TypeError(
                f"{name}: a structured array must have the dtype {described(record)}, not {described(array.dtype)}"
            )
        if array.dtype is not FLOAT64 and not (single and array.dtype == FLOAT32):
            array = as_array(array, name, np.float64)
        if array.ndim == 0 or array.shape[-1] != width:
            raise ValueError(f"{name}: the shape must be (..., {width}), not {array.shape}")
    flags = array.flags
    if not (flags.c_contiguous and flags.aligned):
        array = array.copy(order="C")
    return array


def output(array: Array | None, shape: tuple[int, ...], dtype: np.dtype[Any], name: str) -> Array:
    """The array given to be written to, checked, or a new one."""
    if array is None:
        return np.empty(shape, dtype)
    as_array(array, name)
    if not isinstance(array, np.ndarray):
        raise TypeError(
            f"{name}: an array of shape {shape} and dtype {described(dtype)} is needed, not {type(array).__name__}"
        )
    flags = array.flags
    right = array.shape == shape and (array.dtype is dtype or array.dtype == dtype)
    if not (right and flags.c_contiguous and flags.writeable and flags.aligned):
        raise ValueError(
            f"{name}: a writeable array in C order of shape {shape} and dtype {described(dtype)} is needed, not of shape {array.shape} "
            f"and dtype {described(array.dtype)}"
        )
    return array


def apart(inputs: tuple[tuple[str, Array], ...], outputs: tuple[tuple[str, Array], ...]) -> None:
    """Refuses arrays to be written to that overlap what is read, or each other.

    All are in C order, so their bounds tell.
    """
    accepted = inputs
    for output in outputs:
        for second in accepted:
            if np.may_share_memory(output[1], second[1]):
                raise ValueError(
                    f"{output[0]}: its memory overlaps that of {second[0]}; give an array of its own"
                )
        accepted += (output,)


def workers(threads: int) -> int:
    """How many threads can be busy at once for an option `threads`."""
    processors = (
        len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    )
    return processors if threads < 0 else max(min(threads, processors), 1)


def in_chunks(n: int, seconds: float, threads: int, call: Callable[[int, int], int]) -> int:
    """Calls call(first row, number of rows) for chunks of n rows, one after another, in each of
    which C computes without Python.

    Between two chunks Python handles signals, so that Ctrl-C ends a long batch. The first chunk has
    as many rows as take 1 ms on each thread by `seconds`, what a row usually takes; a batch of
    fewer is one call. By the time that a chunk took, the next is to last 20 ms, or 100 ms where
    threads have to be started for each. Gives the status of the first chunk in error, or 0.
    """
    count = max(64, int(0.001 / seconds))
    if n <= count:
        return call(0, n)
    hands = workers(threads) if threads else 1
    count *= hands
    duration, least, begin, status = (
        0.02 if hands == 1 else 0.1,
        64 * hands if hands > 1 else 1,
        0,
        0,
    )
    while begin < n:
        count = min(count, n - begin)
        start = time.perf_counter()
        code = call(begin, count)
        spent = time.perf_counter() - start
        status = code if status >= 0 > code else status
        begin += count
        count = max(least, min(8 * count, int(count * duration / max(spent, 1e-9))))
    return status


def spread(threads: int, call: Callable[[int, int], int]) -> Callable[[int, int], int]:
    """The same call, its rows shared among threads, for C that has none of its own: a call of C
    lets other threads run.
    """
    hands = workers(threads) if threads else 1
    if hands == 1:
        return call

    def shared(begin: int, many: int) -> int:
        ends = [begin + many * hand // hands for hand in range(hands + 1)]
        sizes = [end - start for start, end in zip(ends, ends[1:])]
        with ThreadPoolExecutor(hands) as pool:
            return min(pool.map(call, ends[:-1], sizes))

    return shared


_bytes_of = functools.cache(lambda size: np.dtype((np.void, size)))


def raw(records: Array) -> Array:
    """The same memory without fields, which NumPy copies several times as fast."""
    return records.view(_bytes_of(records.itemsize))


def copied(records: Array) -> Array:
    """A copy of structured records, in C order: by way of bytes, which takes a third of the time of
    copying every field.
    """
    return np.frombuffer(bytearray(records.tobytes()), records.dtype).reshape(records.shape)


def frozen(records: Array) -> Array:
    """A copy of structured records, in C order, that cannot be written to."""
    return np.frombuffer(records.tobytes(), records.dtype).reshape(records.shape)


def sealed(array: Array) -> Array:
    """A view that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


def repeated(record: bytes, dtype: np.dtype[Any], shape: tuple[int, ...]) -> Array:
    """An array of equal records, which may be written to."""
    return np.frombuffer(bytearray(record * math.prod(shape)), dtype).reshape(shape)


def addresses(array: Array, leading: int) -> Array:
    """Where each row of an array begins, of shape (rows,): what its first `leading` indices choose,
    in C order.
    """
    if array.flags.c_contiguous and array.size > 0:
        begin, rows = (
            int(ffi.cast("uintptr_t", ffi.from_buffer(array))),
            math.prod(array.shape[:leading]),
        )
        return np.arange(begin, begin + array.nbytes, array.nbytes // rows)
    offsets: Array = np.zeros((), np.intp)
    for size, stride in zip(array.shape[:leading], array.strides[:leading], strict=True):
        offsets = offsets[..., np.newaxis] + np.arange(size) * stride
    return (array.ctypes.data + offsets.reshape(-1)).astype(np.uintp)


def one_or_all(array: Array, shape: tuple[int, ...], leading: int) -> tuple[Array, bool]:
    """The rows of an array that is broadcast to a shape: the one row that all are, and True; or all
    of them, in C order.
    """
    if array.flags.c_contiguous and (
        array.shape == shape or array.size == math.prod(shape[leading:])
    ):
        return array, array.shape != shape
    wide = np.broadcast_to(array, shape)
    if all(
        stride == 0 or size == 1
        for size, stride in zip(wide.shape[:leading], wide.strides[:leading], strict=True)
    ):
        return np.ascontiguousarray(wide[(slice(0, 1),) * leading]), True
    return np.ascontiguousarray(wide), False


pointer: Any = ffi.from_buffer
"""pointer(ctype, array): the array's memory as a C array, which keeps the array alive."""


def whole(value: object, name: str, least: int = 0, most: int = 2**31 - 1) -> int:
    """A whole number between bounds; anything else is refused by its name."""
    try:
        integer = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        integer = least - 1
    if least <= integer <= most:
        return int(integer)
    raise ValueError(
        f"{name}: it must be a whole number from {least} to {most}, not {reprlib.repr(value)}"
    )


Seed = int | np.random.Generator
"""What begins random numbers: a whole number, or a generator that draws one."""


def seed_of(seed: Seed, most: int = 2**31 - 1) -> int:
    """The whole number of a seed; a generator draws it, and stands elsewhere afterwards."""
    if isinstance(seed, np.random.Generator):
        return int(seed.integers(min(most, 2**63 - 1), endpoint=True))
    try:
        return whole(seed, "seed", most=most)
    except ValueError as error:
        raise ValueError(f"{error}; a numpy.random.Generator will do too") from None


_Made = TypeVar("_Made", bound=Callable[..., Any])


def cached(function: _Made) -> _Made:
    """functools.lru_cache of a function, which names an argument that has no hash."""
    function_cache = functools.lru_cache(maxsize=256)(function)

    @functools.wraps(function)
    def call(*arguments: Any) -> Any:
        try:
            return function_cache(*arguments)
        except TypeError:
            for name, value in zip(function.__code__.co_varnames, arguments):
                fields = zip(value._fields, value) if hasattr(value, "_fields") else [(name, value)]
                for field, part in fields:
                    if not all(
                        isinstance(item, Hashable)
                        for item in (part if isinstance(part, tuple) else [part])
                    ):
                        raise TypeError(
                            f"{field}: {reprlib.repr(part)} is none of its values"
                        ) from None
            raise

    return cast(_Made, call)


def called(function: _Made, name: str, text: str) -> _Made:
    """A function that was made in another one, with a name and a text of its own."""
    function.__name__ = function.__qualname__ = name
    function.__doc__ = text
    return function


def needed(module: str, user: str, package: str = "") -> Any:
    """A module of another package, or the error that says how to get it. `package` is its name
    where that differs from the module's.
    """
    try:
        return importlib.import_module(module)
    except ImportError as missing:
        package = package or module.partition(".")[0]
        raise ImportError(
            f"{user} needs {package}, which is not installed here: pip install {package}",
            name=missing.name,
        ) from missing


def listing(module: str) -> Callable[[], list[str]]:
    """A module's __dir__, for tab completion: what it offers, without the names that it imports."""

    def names() -> list[str]:
        contents = sys.modules[module]
        members = [
            name
            for name, value in vars(contents).items()
            if name[0] != "_" and getattr(value, "__module__", None) == module
        ]
        return sorted(getattr(contents, "__all__", members))

    return names


def text_of(words: Any) -> str:
    """A text of C."""
    return bytes(ffi.string(words)).decode()


def numbers_of(part: int) -> Iterator[Any]:
    """The rows of a part's numbers, each a `carom_number`."""
    k = 0
    while (row := lib.carom_number_of(part, k)) != ffi.NULL:
        yield row
        k += 1


def with_numbers(part: int) -> Callable[[_Made], _Made]:
    """Writes the numbers of a part into a docstring, in place of its parameter **kind."""
    text = ffi.new("char[]", 100)

    def describe(row: Any, indent: str) -> str:
        lib.carom_number_range(row, text, 100)
        name, about = text_of(row.name), text_of(row.text)
        allowed = text_of(text)
        return (
            f"{indent}{name} : array_like, shape (...)\n"
            f"{indent}    {about[0].upper()}{about[1:]}; {allowed}."
        )

    def every_one(place: re.Match[str]) -> str:
        return "\n".join(describe(row, place[1]) for row in numbers_of(part))

    def written(function: _Made) -> _Made:
        if function.__doc__:
            function.__doc__ = re.sub(
                r"^( *)\*\*kind : .*\n.*$", every_one, function.__doc__, flags=re.MULTILINE
            )
        return function

    return written


def numbered(enum: str) -> dict[str, int]:
    """The values of an enumeration of C by their names as options have them: carom_world has carom
    and pooltool.
    """
    values: dict[str, int] = ffi.typeof(enum).relements
    common = os.path.commonprefix(list(values)).rindex("_") + 1
    return {
        name[common:].lower(): value
        for name, value in sorted(values.items(), key=operator.itemgetter(1))
    }


def worded(kind: str) -> dict[str, int]:
    """The values of an enumeration of C by their words, from 0 on: WORLD has carom and pooltool."""
    found: dict[str, int] = {}
    while (word := lib.carom_word(getattr(lib, f"CAROM_WORDS_{kind}"), len(found))) != ffi.NULL:
        found[text_of(word)] = len(found)
    return found


def choice(names: dict[str, int], value: str, option: str) -> int:
    """The number of a named option."""
    try:
        return names[value]
    except (KeyError, TypeError):  # the second of what has no hash
        raise ValueError(
            f"{option}: must be one of {', '.join(map(repr, names))}, not {value!r}"
        ) from None


def broadcast(shapes: dict[str, tuple[int, ...]]) -> tuple[int, ...]:
    """The shape to which leading dimensions of arguments are broadcast."""
    unlike = set(shapes.values()) - {()}
    if len(unlike) <= 1:
        return unlike.pop() if unlike else ()
    try:
        return np.broadcast_shapes(*unlike)
    except ValueError:
        described = ", ".join(f"{name} {shape}" for name, shape in shapes.items() if shape)
        raise ValueError(
            f"leading dimensions must be equal or 1, to be broadcast against each other, but are {described}"
        ) from None


def fill(
    record: np.dtype[Any],
    vectors: dict[str, int],
    fields: Mapping[str, npt.ArrayLike | None],
    usual: bytes | None = None,
) -> Array:
    """An array of the record from fields that are broadcast against each other; others are those of
    a usual record, or 0.

    A field "a.v" is v of the part a; one that is None is not given.
    """
    arrays: dict[str, Any] = {}
    shapes: dict[str, tuple[int, ...]] = {}
    for name, value in fields.items():
        if value is None:
            continue
        if isinstance(value, float):
            arrays[name] = value
            continue
        part, _, last = name.rpartition(".")
        length = vectors.get(last)
        # as the caller calls it
        shown = (
            f"{last}_{part}"
            if part in ("a", "b") and (length is not None or (part == "b" and last != "radius"))
            else last
        )
        array = as_array(value, shown, np.float64)
        if length is not None and array.ndim > 0:
            if array.shape[-1] != length:
                raise ValueError(f"{shown}: the shape must be (..., {length}), not {array.shape}")
            shapes[shown] = array.shape[:-1]
        else:
            shapes[shown] = array.shape
        arrays[name] = array
    shape = broadcast(shapes)
    filled = repeated(usual or bytes(record.itemsize), record, shape)
    for name, array in arrays.items():
        within: Any = filled
        *parts, last = name.split(".")
        for inner in parts:
            within = within[inner]
        within[last] = array
    return filled
