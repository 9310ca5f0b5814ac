"""Built-in tables, such as `carom.tables.pool_9ft()`, and `carom.tables.polygon(corners)`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import (
    Array,
    as_array,
    called,
    choice,
    number,
    numbered,
    numbers_of,
    pointer,
    several,
    text_of,
    unknown_name,
)
from carom.layouts import TABLE_KINDS, Table, radius_on, refuse_table
from carom.status import CaromError


_ROWS = list(numbers_of(lib.CAROM_PART_MEASURES))
_KEYS = {text_of(row.key): text_of(row.name) for row in _ROWS}


def measures(table: str) -> dict[str, float]:
    """Return the measures of a built-in table by its name, such as "pool_9ft" or "9ft".

    Lengths are in m, cuts in degrees. Each measure is an argument of the table's function.
    """
    record = ffi.new("carom_measures *")
    lib.carom_table_measures(choice(TABLE_KINDS, table, "table"), record)
    return {key: getattr(record, name) for key, name in _KEYS.items()}


def _measured(name: str, changes: dict[str, float], record: Array) -> None:
    """Fill the record of a built-in table with changed measures."""
    values, fault, text, keys = (
        measures(name),
        ffi.new("carom_table_fault *"),
        ffi.new("char[]", 100),
        list(_KEYS),
    )
    radius = radius_on(numbered("carom_table_kind")[name])
    for key, value in changes.items():
        if key not in _KEYS:
            raise TypeError(unknown_name(f"carom.tables.{name}()", "measure", key, keys))
        values[key] = number(value, key, "a length in m, or a cut in degrees")
    c_measures = ffi.new("carom_measures *", {_KEYS[key]: value for key, value in values.items()})
    code = lib.carom_table_measured(c_measures, radius, pointer("carom_table[]", record), fault)
    if fault.part.kind == lib.CAROM_PART_MEASURES:
        lib.carom_number_range(_ROWS[fault.part.index], text, 100)
        is_measure = fault.other.kind == lib.CAROM_PART_MEASURES
        must = (
            f"below {fault.gap:.4g} m with this {keys[fault.other.index]}"
            if is_measure
            else text_of(text)
        )
        raise CaromError(
            code, keys[fault.part.index], values[keys[fault.part.index]], text=f"it must be {must}"
        )
    refuse_table(code, fault)


def _maker(name: str) -> Callable[..., Table]:
    kind = numbered("carom_table_kind")[name]

    def make(**measures: float) -> Table:
        record: Array = np.zeros((), dtypes.table)
        if measures:
            _measured(name, measures, record)
        elif (code := lib.carom_table_make(kind, pointer("carom_table[]", record))) < 0:
            raise CaromError(code)
        return Table.from_record(record)

    table, text = make(), text_of(lib.carom_word_text(lib.CAROM_WORDS_TABLE, kind))
    advice = (
        "Arguments change its measures, as in corner=0.108 (m); carom.tables.measures() lists them."
    )
    return called(
        make,
        name,
        f"{text[0].upper()}{text[1:]}: {table.width:.4g} x {table.length:.5g} m. {advice}",
    )


pool_7ft = _maker("pool_7ft")
pool_8ft = _maker("pool_8ft")
pool_9ft = _maker("pool_9ft")
snooker = _maker("snooker")
threecushion = _maker("threecushion")
pooltool = _maker("pooltool")
blackball = _maker("blackball")
heyball = _maker("heyball")
pyramid = _maker("pyramid")
fourball = _maker("fourball")


def polygon(
    corners: Sequence[Sequence[float]],
    *,
    nose_height: float = 0.0366,
    jaw_radius: float = 0.01,
    ball_radius: float = 0.028575,
) -> Table:
    """Make a table of any closed shape from its corners, in order around it.

    Parameters
    ----------
    corners : sequence of (x, y) or (x, y, mouth)
        Positions, m, from any origin, and the width of a pocket's mouth there, m; without it there
        is no pocket. A corner on a straight side makes a side pocket. The table is moved so that
        its smallest x and y are 0.
    nose_height, jaw_radius, ball_radius : float
        Height of all noses, radius of the jaws at pockets, and radius of the balls, m.

    Raises
    ------
    CaromError
        The table is not closed, has no room for a ball at its middle, or a value is out of range.
        `field` is the corner or the part.
    """
    rows = []
    for k, corner in enumerate(several(corners, "corners", "a list of (x, y) or (x, y, mouth)")):
        rows.append(tuple(as_array(corner, f"corners[{k}]", np.float64).ravel().tolist()))
        if len(rows[k]) not in (2, 3):
            raise ValueError(
                f"corners[{k}]: there are {len(rows[k])} values; pass (x, y) or (x, y, mouth)"
            )
    if len(rows) < 3:
        raise ValueError(f"corners: there are {len(rows)}, but a table needs at least 3")
    nose_height, jaw_radius, ball_radius = (
        number(size, name, "a length in m")
        for name, size in (
            ("nose_height", nose_height),
            ("jaw_radius", jaw_radius),
            ("ball_radius", ball_radius),
        )
    )
    array = ffi.new("carom_corner[]", [row + (0.0,) * (3 - len(row)) for row in rows])
    record: Array = np.zeros((), dtypes.table)
    fault = ffi.new("carom_table_fault *")
    refuse_table(
        lib.carom_table_polygon(
            array,
            len(rows),
            nose_height,
            jaw_radius,
            ball_radius,
            pointer("carom_table[]", record),
            fault,
        ),
        fault,
    )
    return Table.from_record(record)
