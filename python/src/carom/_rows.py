"""Arrays as C reads them: contiguous rows of numbers, converted only if their layout differs."""

from __future__ import annotations

import difflib
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
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping
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
    """A dataclass of arrays whose repr shows their shapes instead of their values."""

    def __repr__(self) -> str:
        parts = (
            f"{name} {value.shape}" if isinstance(value, np.ndarray) else f"{name} {value!r}"
            for name, value in vars(self).items()
        )
        return f"<carom.{type(self).__name__}: {', '.join(parts)}>"


def as_array(values: npt.ArrayLike, name: str, dtype: npt.DTypeLike | None = None) -> Array:
    """np.asarray() with errors that name the argument.

    Masks and imaginary parts are rejected, because the conversion would lose them. With a numeric
    dtype, text and None are rejected too, which NumPy would read as numbers and nan.
    """
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError(
            f"{name}: a masked array would lose its mask; pass its compressed() or filled() values"
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
    raise TypeError(f"{name}: {reprlib.repr(values)} does not consist of real numbers")


def _is_text(value: object) -> bool:
    return value is None or isinstance(value, (str, bytes))


def number(value: object, name: str, needed: str = "a real number") -> float:
    """Return a number; otherwise raise an error that names the argument."""
    if isinstance(value, (float, int, np.ndarray, numbers.Real)) or hasattr(value, "__float__"):
        array = as_array(value, name, np.float64)  # type: ignore[arg-type]
        if array.size == 1:
            return float(array.reshape(()))
    raise TypeError(f"{name}: {reprlib.repr(value)} is not {needed}")


def several(values: object, name: str, needed: str) -> list[Any]:
    """Return the items of an argument; for a string or a scalar raise an error that names it."""
    if not isinstance(values, (str, bytes)):
        try:
            return [*values]  # type: ignore[misc]
        except TypeError:
            pass
    raise TypeError(f"{name}: {reprlib.repr(values)} is not {needed}")


def rows(values: npt.ArrayLike, record: np.dtype[Any], name: str, single: bool = False) -> Array:
    """The values as an array in C order: structured, or of shape (..., width) in double precision,
    or in single precision if `single` allows it.
    """
    array = as_array(values, name)
    width = record.itemsize // 8
    # Identity detects the usual case: comparing with a structured dtype takes longer than the rest.
    if array.dtype is FLOAT64 or array.dtype != record:
        if array.dtype.names is not None:
            raise TypeError(
                f"{name}: the dtype is {described(array.dtype)}, but must be {described(record)}"
            )
        if array.dtype is not FLOAT64 and not (single and array.dtype == FLOAT32):
            array = as_array(array, name, np.float64)
        if array.ndim == 0 or array.shape[-1] != width:
            raise ValueError(f"{name}: the shape is {array.shape}, but must be (..., {width})")
    flags = array.flags
    if not (flags.c_contiguous and flags.aligned):
        array = array.copy(order="C")
    return array


def output(array: Array | None, shape: tuple[int, ...], dtype: np.dtype[Any], name: str) -> Array:
    """The output array passed by the caller, checked, or a new one."""
    if array is None:
        return np.empty(shape, dtype)
    as_array(array, name)
    if not isinstance(array, np.ndarray):
        raise TypeError(
            f"{name}: {type(array).__name__} is not an array; it must have shape {shape} and dtype {described(dtype)}"
        )
    flags = array.flags
    right = array.shape == shape and (array.dtype is dtype or array.dtype == dtype)
    if not (right and flags.c_contiguous and flags.writeable and flags.aligned):
        raise ValueError(
            f"{name}: the array has shape {array.shape} and dtype {described(array.dtype)}, "
            f"but must be writeable, in C order, of shape {shape} and dtype {described(dtype)}"
        )
    return array


def apart(inputs: tuple[tuple[str, Array], ...], outputs: tuple[tuple[str, Array], ...]) -> None:
    """Raise an error if an output array overlaps an input or another output.

    All are in C order, so comparing their bounds is enough.
    """
    accepted = inputs
    for output in outputs:
        for second in accepted:
            if np.may_share_memory(output[1], second[1]):
                raise ValueError(
                    f"{output[0]}: its memory overlaps {second[0]}; pass a separate array"
                )
        accepted += (output,)


def workers(threads: int) -> int:
    """The number of threads that can run at once for an option `threads`."""
    processors = (
        len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    )
    return processors if threads < 0 else max(min(threads, processors), 1)


def in_chunks(n: int, seconds: float, threads: int, call: Callable[[int, int], int]) -> int:
    """Call call(first row, number of rows) for consecutive chunks of n rows.

    C computes a chunk without Python. Between chunks Python handles signals, so Ctrl-C ends a long
    batch. The first chunk is sized for 1 ms on each thread by `seconds`, the usual time of a row; a
    smaller batch is one call. Later chunks are sized from the measured time to last 20 ms, or 100
    ms if each starts threads. Returns the status of the first chunk that failed, or 0.
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
    """The same call with its rows divided among threads, for functions of C without threads.

    A call of C releases the GIL.
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
    """The same memory without fields, which NumPy copies several times faster."""
    return records.view(_bytes_of(records.itemsize))


def copied(records: Array) -> Array:
    """A copy of structured records, in C order.

    Copying bytes takes a third of the time of copying each field.
    """
    return np.frombuffer(bytearray(records.tobytes()), records.dtype).reshape(records.shape)


def frozen(records: Array) -> Array:
    """A read-only copy of structured records, in C order."""
    return np.frombuffer(records.tobytes(), records.dtype).reshape(records.shape)


def sealed(array: Array) -> Array:
    """A read-only view."""
    view = array.view()
    view.flags.writeable = False
    return view


def repeated(record: bytes, dtype: np.dtype[Any], shape: tuple[int, ...]) -> Array:
    """A writeable array of equal records."""
    return np.frombuffer(bytearray(record * math.prod(shape)), dtype).reshape(shape)


def addresses(array: Array, leading: int) -> Array:
    """The address of each row of an array, shape (rows,).

    The first `leading` indices, in C order, select the row.
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
    """The rows of an array that is broadcast to a shape.

    Returns the one row and True if all rows are the same, otherwise all rows in C order and False.
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
    """Return an integer within bounds; otherwise raise an error that names the argument."""
    try:
        integer = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        integer = least - 1
    if least <= integer <= most:
        return int(integer)
    raise ValueError(f"{name}: {reprlib.repr(value)} is not an integer from {least} to {most}")


Seed = int | np.random.Generator
"""A seed of random numbers: an integer, or a generator that draws one."""


def seed_of(seed: Seed, most: int = 2**31 - 1) -> int:
    """The integer of a seed. A generator draws it, which advances the generator."""
    if isinstance(seed, np.random.Generator):
        return int(seed.integers(min(most, 2**63 - 1), endpoint=True))
    try:
        return whole(seed, "seed", most=most)
    except ValueError as error:
        raise ValueError(f"{error}, or a numpy.random.Generator") from None


_Made = TypeVar("_Made", bound=Callable[..., Any])


def cached(function: _Made) -> _Made:
    """functools.lru_cache with an error that names an argument that is not hashable."""
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
                            f"{field}: {reprlib.repr(part)} is not a valid value"
                        ) from None
            raise

    return cast(_Made, call)


def called(function: _Made, name: str, text: str) -> _Made:
    """Set the name and the docstring of a function that another function made."""
    function.__name__ = function.__qualname__ = name
    function.__doc__ = text
    return function


def needed(module: str, user: str, package: str = "") -> Any:
    """Import a module of another package, or raise an error that shows how to install it.

    `package` is the package's name, if that differs from the module's.
    """
    try:
        return importlib.import_module(module)
    except ImportError as missing:
        package = package or module.partition(".")[0]
        raise ImportError(
            f"{user} needs {package}, which is not installed: pip install {package}",
            name=missing.name,
        ) from missing


def listing(module: str) -> Callable[[], list[str]]:
    """A module's __dir__, for tab completion: its public names, without those it imports."""

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
    """A Python string from a string of C."""
    return bytes(ffi.string(words)).decode()


def numbers_of(part: int) -> Iterator[Any]:
    """The rows of a part's parameters, each a `carom_number`."""
    k = 0
    while (row := lib.carom_number_of(part, k)) != ffi.NULL:
        yield row
        k += 1


def with_numbers(part: int) -> Callable[[_Made], _Made]:
    """Replace the parameter **kind of a docstring by the parameters of a part."""
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
    """The values of an enumeration of C by their names in lower case: "pool_9ft" of
    carom_table_kind.
    """
    values: dict[str, int] = ffi.typeof(enum).relements
    common = os.path.commonprefix(list(values)).rindex("_") + 1
    return {
        name[common:].lower(): value
        for name, value in sorted(values.items(), key=operator.itemgetter(1))
    }


def worded(kind: str) -> dict[str, int]:
    """The values of an enumeration of C by their names in its table of words: WORLD has carom and
    pooltool.
    """
    found: dict[str, int] = {}
    while (word := lib.carom_word(getattr(lib, f"CAROM_WORDS_{kind}"), len(found))) != ffi.NULL:
        found[text_of(word)] = len(found)
    return found


def _letters(name: str) -> str:
    """A name without capitals, hyphens, underscores and blanks."""
    return name.lower().translate(str.maketrans("", "", "-_ "))


_Name = TypeVar("_Name")


def named(names: Collection[str], value: object, option: str) -> str:
    """The name that a value of an option stands for; raises ValueError for an unknown one.

    C's table of synonyms decides what a name means: "9-ball" is "nineball".
    """
    if isinstance(value, str):
        if value in names:
            return value
        text = value.encode(errors="replace")
        # The letters of a name come before synonyms of another one.
        letters = _letters(value)
        for name in names:
            if letters and _letters(name) == letters:
                return name
        for name in names:
            if lib.carom_word_means(text, name.encode()):
                return name
    raise ValueError(unknown_value(option, value, names))


def choice(names: Mapping[str, _Name], value: object, option: str) -> _Name:
    """What the value of an option stands for, by its name or a synonym."""
    if isinstance(value, str) and value in names:
        return names[value]
    return names[named(names, value, option)]


def suggestion(value: object, names: Iterable[str]) -> str:
    """ "; did you mean 'nineball'?" for a value that is nearly one of the names, otherwise ""."""
    if not isinstance(value, str):
        return ""
    in_small_letters = {name.lower(): name for name in names}
    text = value.lower()
    beginning = [name for name in in_small_letters if text and name.startswith(text)]
    close = difflib.get_close_matches(text, in_small_letters, 1, 0.6)
    found = (close or beginning)[:1]
    return f"; did you mean {in_small_letters[found[0]]!r}?" if found else ""


def unknown_value(option: str, value: object, names: Collection[str]) -> str:
    """The error for a value that is none of the names of an option."""
    listed = either(map(repr, names))
    hint = suggestion(value, names)
    return f"{option}: unknown value {reprlib.repr(value)}{hint or ';'} {'Use' if hint else 'use'} {listed}"


def unknown_name(
    where: str, kind: str, name: object, names: Collection[str], listed_by: str = ""
) -> str:
    """The error for a name that does not exist, such as an unknown keyword.

    `listed_by` is the call that lists the names, if they are too many for an error.
    """
    hint = suggestion(name, names)
    listed = f"{'Use' if hint else 'use'} {either(names)}"
    if listed_by:
        listed = f"{listed_by} lists all"
    return f"{where}: unknown {kind} {reprlib.repr(name)}{hint or ';'} {listed}"


def either(names: Iterable[str]) -> str:
    """Names as a list: a, b or c."""
    *front, last = names
    return f"{', '.join(front)} or {last}" if front else last


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
            f"the leading dimensions cannot be broadcast: {described}; they must be equal or 1"
        ) from None


def fill(
    record: np.dtype[Any],
    vectors: dict[str, int],
    fields: Mapping[str, npt.ArrayLike | None],
    usual: bytes | None = None,
) -> Array:
    """An array of the record from fields that are broadcast against each other.

    Fields that are missing or None have the values of the record `usual`, or 0. A field "a.v" is v
    of the part a.
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
        # the name that the caller uses
        shown = (
            f"{last}_{part}"
            if part in ("a", "b") and (length is not None or (part == "b" and last != "radius"))
            else last
        )
        array = as_array(value, shown, np.float64)
        if length is not None and array.ndim > 0:
            if array.shape[-1] != length:
                raise ValueError(
                    f"{shown}: the shape is {array.shape}, but must be (..., {length})"
                )
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
