"""The racks, with the cue ball first: `carom.racks.nineball(table)`.

Each takes the table, the gap between neighbours (m; 0 is a frozen rack) and the seed that draws by how much each ball is moved, up
to a quarter of the gap, and where the other balls of the rack go; and gives an ndarray of `carom.dtypes.shot_ball`.
"""

from __future__ import annotations

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Array, whole
from carom.layouts import Table, check_table
from carom.status import CaromError


def _rack(kind: int, table: Table, gap: float, seed: int) -> dtypes.Records:
    size = int(lib.carom_rack_size(kind))
    balls: Array = np.zeros(size, dtypes.shot_ball)
    check_table(table)
    of_table = ffi.from_buffer("carom_table[]", table.record)
    code = lib.carom_rack(kind, of_table, gap, whole(seed, "seed", most=2**64 - 1), ffi.from_buffer("carom_shot_ball[]", balls), size)
    if code < 0:
        text = "it must be 0 m to the radius of a ball"
        raise CaromError(code, "gap", gap, text=text)
    return balls


def nineball(table: Table, gap: float = 1e-4, seed: int = 1) -> dtypes.Records:
    """10 balls: cue ball, then 1 to 9 by number; 1 in front, 9 in the middle."""
    return _rack(lib.CAROM_RACK_NINEBALL, table, gap, seed)


def eightball(table: Table, gap: float = 1e-4, seed: int = 1) -> dtypes.Records:
    """16 balls: cue ball, then 1 to 15 by number; 8 in the middle, both kinds in the corners."""
    return _rack(lib.CAROM_RACK_EIGHTBALL, table, gap, seed)


def tenball(table: Table, gap: float = 1e-4, seed: int = 1) -> dtypes.Records:
    """11 balls: cue ball, then 1 to 10 by number; 10 in the middle."""
    return _rack(lib.CAROM_RACK_TENBALL, table, gap, seed)


def snooker(table: Table, gap: float = 1e-4, seed: int = 1) -> dtypes.Records:
    """22 balls: white, 15 reds, yellow, green, brown, blue, pink, black."""
    return _rack(lib.CAROM_RACK_SNOOKER, table, gap, seed)


def threecushion(table: Table, gap: float = 1e-4, seed: int = 1) -> dtypes.Records:
    """3 balls: white, yellow, red, as for the opening."""
    return _rack(lib.CAROM_RACK_THREECUSHION, table, gap, seed)
