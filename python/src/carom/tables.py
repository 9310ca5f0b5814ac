"""The built-in tables, `carom.tables.pool_9ft()`, and tables of any closed shape, `carom.tables.polygon(corners)`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Array, as_array, called, number, numbered, pointer, several
from carom.layouts import Table, refuse_table
from carom.status import CaromError


def _maker(name: str) -> Callable[[], Table]:
    kind = numbered("carom_table_kind")[name]

    def make() -> Table:
        record: Array = np.zeros((), dtypes.table)
        code = lib.carom_table_make(kind, pointer("carom_table[]", record))
        if code < 0:
            raise CaromError(code)
        return Table.from_record(record)

    made, text = make(), ffi.string(lib.carom_word_text(lib.CAROM_WORDS_TABLE, kind)).decode()
    return called(make, name, f"{text[0].upper()}{text[1:]}: {made.width:.4g} x {made.length:.5g} m.")


pool_7ft = _maker("pool_7ft")
pool_8ft = _maker("pool_8ft")
pool_9ft = _maker("pool_9ft")
snooker = _maker("snooker")
threecushion = _maker("threecushion")
pooltool = _maker("pooltool")


def polygon(
    corners: Sequence[Sequence[float]], *, nose_height: float = 0.0366, jaw_radius: float = 0.01, ball_radius: float = 0.028575
) -> Table:
    """A table of any closed shape, from its corners in the order of a walk around it.

    Parameters
    ----------
    corners : sequence of (x, y) or (x, y, mouth)
        Places, m, from 0, and the width of a pocket's mouth there, m. Without a mouth there is no pocket. A corner on a straight side makes
        a side pocket.
    nose_height, jaw_radius, ball_radius : float
        Of all noses, of the rounded ends of rails at pockets, and of the balls, m.

    Raises CaromError: The table is not closed, its middle has no room for a ball, or a number is out of range; the sentence says where.
    """
    rows = []
    for k, corner in enumerate(several(corners, "corners", "a list of (x, y) or (x, y, mouth) is needed")):
        rows.append(tuple(as_array(corner, f"corners[{k}]", np.float64).ravel().tolist()))
        if len(rows[k]) not in (2, 3):
            raise ValueError(f"corners[{k}]: x, y and perhaps the mouth are needed, not {len(rows[k])} numbers")
    if len(rows) < 3:
        raise ValueError(f"corners: at least 3 are needed, not {len(rows)}")
    nose_height, jaw_radius, ball_radius = (
        number(size, name, "a length in m is needed")
        for name, size in (("nose_height", nose_height), ("jaw_radius", jaw_radius), ("ball_radius", ball_radius))
    )
    array = ffi.new("carom_corner[]", [row + (0.0,) * (3 - len(row)) for row in rows])
    record: Array = np.zeros((), dtypes.table)
    fault = ffi.new("carom_table_fault *")
    refuse_table(lib.carom_table_polygon(array, len(rows), nose_height, jaw_radius, ball_radius, pointer("carom_table[]", record), fault), fault)
    return Table.from_record(record)
