"""Which argument of a shot C refuses: the exception that names the field, the value given, and what would be right.

C says which number of a ball is at fault, and what it must be. Of cues and states the field follows from the name of the status,
ERROR_CUE_SPEED, and what would be right from its text.
"""

from __future__ import annotations

from typing import Any

from carom import dtypes
from carom._carom import ffi, lib
from carom.status import CaromError, Status

# Fields whose statuses have other names.
_NAMES = {"position": "r", "overlap": "r", "off_table": "r", "velocity": "v", "vertical": "v", "spin": "w"}
_NAMES |= {"radii_differ": "radius", "masses_differ": "mass", "cue_ball_out": "ball"}


def _word(status: int) -> str:
    return Status(status).name.removeprefix("ERROR_").lower()


def fault(status: int, name: str, record: dtypes.Records) -> CaromError:
    """The exception for a record, called `name`, that C refuses: a cue, or the kind or the state of a ball."""
    word = _word(status)
    if status == Status.ERROR_MISCUE:
        return CaromError(status, f"{name}.a, {name}.b", f"{record['a']}, {record['b']}")
    if record.dtype == dtypes.ball_kind:
        kind, must = record.tobytes(), ffi.new("char[]", 100)
        number = lib.carom_ball_fault(ffi.from_buffer("carom_ball_kind[]", kind), must, 100)
        if number != ffi.NULL:
            field = ffi.string(number.name).decode()
            return CaromError(status, f"{name}.{field}", record[field].item(), text=f"it must be {ffi.string(must).decode()}")
    field = _NAMES.get(word, word.removeprefix("cue_"))
    if field not in (record.dtype.names or ()):
        return CaromError(status, name)
    text = Status(status).text.replace(f"{name}.{field} must", "it must")
    return CaromError(status, f"{name}.{field}", record[field] if record[field].ndim else record[field].item(), text=text)


def is_of_cue(status: int) -> bool:
    """Whether a status is about a cue."""
    return _word(status).startswith(("cue", "miscue"))


def shot_arguments(table: Any, layout: dtypes.Records, cue: dtypes.Records | None, options: Any) -> tuple[Any, ...]:
    """The arguments of carom_shot_check() and carom_shoot()."""
    strike = ffi.NULL if cue is None else ffi.from_buffer("carom_cue[]", cue)
    return ffi.from_buffer("carom_table[]", table.record), ffi.from_buffer("carom_shot_ball[]", layout), len(layout), strike, options


def argument_error(arguments: tuple[Any, ...], layout: dtypes.Records, cue: dtypes.Records | None) -> CaromError | None:
    """The exception for arguments that carom_shot_check() refuses; None if they are right."""
    where = ffi.new("int *", -1)
    code = lib.carom_shot_check(*arguments, where)
    if code >= 0:
        return None
    if cue is not None and is_of_cue(code):
        return fault(code, "cue", cue)
    if code in (lib.CAROM_ERROR_TABLE, lib.CAROM_ERROR_NOSE_HEIGHT):
        return CaromError(code, "table")
    if not 0 <= where[0] < len(layout):
        return CaromError(code, "balls", len(layout)) if code == lib.CAROM_ERROR_BALLS else CaromError(code)
    part = "state" if _NAMES.get(_word(code), _word(code)) in ("r", "v", "w", "label") else "kind"
    return fault(code, f"balls[{where[0]}].{part}", layout[where[0]][part])
