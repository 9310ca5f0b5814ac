"""The built-in tables: `carom.tables.pool_9ft()`."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from carom import dtypes
from carom._carom import lib
from carom._rows import Array, called, pointer
from carom.layouts import Table
from carom.status import CaromError


def _maker(name: str, kind: int, text: str) -> Callable[[], Table]:
    def make() -> Table:
        record: Array = np.zeros((), dtypes.table)
        code = lib.carom_table_make(kind, pointer("carom_table[]", record))
        if code < 0:
            raise CaromError(code)
        return Table.from_record(record)

    return called(make, name, text)


pool_7ft = _maker("pool_7ft", lib.CAROM_TABLE_POOL_7FT, "Pool, 7 ft: 0.9906 x 1.9812 m.")
pool_8ft = _maker("pool_8ft", lib.CAROM_TABLE_POOL_8FT, "Pool, 8 ft: 1.1176 x 2.2352 m.")
pool_9ft = _maker("pool_9ft", lib.CAROM_TABLE_POOL_9FT, "Pool, 9 ft: 1.27 x 2.54 m.")
snooker = _maker("snooker", lib.CAROM_TABLE_SNOOKER, "Snooker, 12 ft: 1.778 x 3.569 m.")
threecushion = _maker("threecushion", lib.CAROM_TABLE_THREECUSHION, "Carom billiards, 10 ft, without pockets: 1.42 x 2.84 m.")
pooltool = _maker("pooltool", lib.CAROM_TABLE_POOLTOOL, "The default table of pooltool: that of `pool_7ft`, under this name for ever.")
