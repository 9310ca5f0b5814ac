"""Exceptions for the arguments of a shot that C rejects.

Each names the field, its value and the allowed range, as C reports them.
"""

from __future__ import annotations

import functools
from typing import Any

from carom._carom import ffi, lib
from carom._rows import numbers_of, text_of
from carom.dtypes import Records
from carom.status import CaromError, Status

_TABLE = {
    lib.CAROM_PART_RAIL: "rails",
    lib.CAROM_PART_JAW: "jaws",
    lib.CAROM_PART_POCKET: "pockets",
}


def _numbers(part: int, status: int) -> list[str]:
    """The parameters of a part whose error is this status."""
    return [text_of(row.name) for row in numbers_of(part) if row.error == status]


def _fault(
    status: int, name: str, fields: list[str], record: Records, must: str = ""
) -> CaromError:
    """The exception for fields of a record called `name`."""
    where = [f"{name}.{field}" for field in fields]
    values = [record[field] if record[field].ndim else record[field].item() for field in fields]
    text = (
        f"it must be {must}" if must else Status(status).text.replace(f"{where[0]} must", "it must")
    )
    return CaromError(
        status,
        ", ".join(where),
        values[0] if len(values) == 1 else ", ".join(map(str, values)),
        text=text,
    )


@functools.cache
def _ranges(part: int) -> list[tuple[str, float, float, float, Any]]:
    """Name, range, extra allowed value and row of each parameter of a part."""
    return [(text_of(row.name), row.low, row.high, row.other, row) for row in numbers_of(part)]


def refuse_numbers(part: int, name: str, record: Records) -> None:
    """Raise an error if a field of the record called `name` is out of range."""
    values = dict(zip(record.dtype.names or (), record.item(), strict=True))
    for field, low, high, limit, row in _ranges(part):
        if not low <= values[field] <= high and values[field] != limit:
            must = ffi.new("char[]", 100)
            lib.carom_number_range(row, must, 100)
            raise _fault(row.error, name, [field], record, text_of(must))


def strike_error(status: int, cue: Records, kind: Records) -> CaromError:
    """The exception for a cue and a kind of ball that carom_strike() rejects."""
    if fields := _numbers(lib.CAROM_PART_CUE, status):
        return _fault(status, "cue", fields, cue)
    must = ffi.new("char[]", 100)
    number = lib.carom_ball_fault(ffi.from_buffer("carom_ball_kind[]", kind.tobytes()), must, 100)
    return (
        CaromError(status, "kind")
        if number == ffi.NULL
        else _fault(status, "kind", [text_of(number.name)], kind, text_of(must))
    )


def shot_arguments(
    table: Any, layout: Records, cue: Records | None, options: Any
) -> tuple[Any, ...]:
    """The arguments of carom_shot_check() and carom_shoot()."""
    strike = ffi.NULL if cue is None else ffi.from_buffer("carom_cue[]", cue)
    return (
        ffi.from_buffer("carom_table[]", table.record),
        ffi.from_buffer("carom_shot_ball[]", layout),
        len(layout),
        strike,
        options,
    )


def argument_error(
    arguments: tuple[Any, ...], layout: Records, cue: Records | None
) -> CaromError | None:
    """The exception for arguments that carom_shot_check() rejects; None if they are valid."""
    where = ffi.new("int *", -1)
    if lib.carom_shot_check(*arguments, where) >= 0:
        return None
    fault, text = ffi.new("carom_fault *"), ffi.new("char[]", 100)
    code = lib.carom_shot_fault(*arguments, fault, text, 100)
    kind, index, must = fault.part.kind, fault.part.index, text_of(text)
    # Several fields of the cue can be invalid in combination.
    name = "" if fault.row == ffi.NULL else text_of(fault.row.name)
    if name and kind == lib.CAROM_PART_CUE and cue is not None:
        return _fault(code, "cue", [name] if must else _numbers(kind, fault.row.error), cue, must)
    if name and kind in (lib.CAROM_PART_BALL, lib.CAROM_PART_STATE):
        part = "kind" if kind == lib.CAROM_PART_BALL else "state"
        return _fault(code, f"balls[{index}].{part}", [name], layout[index][part], must)
    if code in (
        lib.CAROM_ERROR_TABLE,
        lib.CAROM_ERROR_NOSE_HEIGHT,
        lib.CAROM_ERROR_RAILS,
        lib.CAROM_ERROR_JAWS,
        lib.CAROM_ERROR_POCKETS,
    ):
        if name and must:
            part = f"table.{_TABLE[kind]}[{index}]" if kind in _TABLE else "table"
            return CaromError(code, f"{part}.{name}", fault.value, text=f"it must be {must}")
        return CaromError(code, "table")
    return (
        CaromError(code, "balls", len(layout))
        if code == lib.CAROM_ERROR_BALLS
        else CaromError(code)
    )
