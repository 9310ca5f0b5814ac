"""The built-in tables: `carom.tables.pool_9ft()`."""

from __future__ import annotations

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Array
from carom.layouts import Table
from carom.status import CaromError


def _make(kind: int) -> Table:
    record: Array = np.zeros((), dtypes.table)
    code = lib.carom_table_make(kind, ffi.from_buffer("carom_table[]", record))
    if code < 0:
        raise CaromError(code)
    return Table.from_record(record)


def pool_7ft() -> Table:
    """Pool, 7 ft: 0.9906 x 1.9812 m."""
    return _make(lib.CAROM_TABLE_POOL_7FT)


def pool_8ft() -> Table:
    """Pool, 8 ft: 1.1176 x 2.2352 m."""
    return _make(lib.CAROM_TABLE_POOL_8FT)


def pool_9ft() -> Table:
    """Pool, 9 ft: 1.27 x 2.54 m."""
    return _make(lib.CAROM_TABLE_POOL_9FT)


def snooker() -> Table:
    """Snooker, 12 ft: 1.778 x 3.569 m."""
    return _make(lib.CAROM_TABLE_SNOOKER)


def threecushion() -> Table:
    """Carom billiards, 10 ft, without pockets: 1.42 x 2.84 m."""
    return _make(lib.CAROM_TABLE_THREECUSHION)


def pooltool() -> Table:
    """The default table of pooltool: that of `pool_7ft`, under this name for ever."""
    return _make(lib.CAROM_TABLE_POOLTOOL)
