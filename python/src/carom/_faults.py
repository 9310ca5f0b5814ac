"""Which argument of a shot C refuses: the exception that names the field, the value given, and what would be right.

The field follows from the name of the status, ERROR_CUE_SPEED or ERROR_MASS, and what would be right from its text. Where fields share a
status, the first that is out of its range is at fault.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom.status import CaromError, Status

_Range = tuple[Callable[[Any], bool], str]
_UNIT: _Range = (lambda x: 0 <= x <= 1, "0 to 1")
_FRICTION: _Range = (lambda x: 0 < x <= 1, "above 0 and at most 1")
_SHARED: dict[str, dict[str, _Range]] = {
    "mu_motion": {"mu_slide": _FRICTION, "mu_roll": _FRICTION, "mu_spin": _FRICTION},
    "restitution": {
        "restitution": _UNIT,
        "restitution_cushion": _UNIT,
        "restitution_table": (lambda x: x == -1 or 0 <= x <= 0.98, "0 to 0.98, or -1 for none"),
    },
    "mu_ball": {"mu_ball": _UNIT, "law_a": _UNIT, "law_b": _UNIT, "law_c": (lambda x: 0 <= x < np.inf, "0 or more, and finite")},
    "modulus": {"modulus": (lambda x: x == 0 or 1e6 <= x <= 1e15, "0, or 1e6 to 1e15 Pa")},
    "ball_cushion": {
        "roll_loss": _UNIT,
        "omega_ratio": (lambda x: x == 0 or 1 < x < 2, "0, or between 1 and 2"),
        **dict.fromkeys(("restitution_log", "mu_log"), (lambda x: abs(x) <= 1, "-1 to 1")),
        "smooth_q": (lambda x: x == 0 or 1e-12 <= x <= 0.5, "0, or 1e-12 to 0.5"),
        **dict.fromkeys(("smooth_x", "smooth_t"), (lambda x: 0 <= x <= 2, "above 0 and at most 2, or 0 if smooth_q is 0")),
        **dict.fromkeys(("smooth_a", "smooth_k"), (lambda x: 0 <= x <= 1, "0 to 1, or 0 if smooth_q is 0")),
        "nose_height": (lambda x: False, "0 to less than 2 R"),
    },
}
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
    for field, (is_right, right) in _SHARED.get(word, {}).items():
        if not is_right(record[field]):
            return CaromError(status, f"{name}.{field}", record[field].item(), text=f"it must be {right}")
    field = _NAMES.get(word, word.removeprefix("cue_"))
    if field not in (record.dtype.names or ()) or word in _SHARED:
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
