"""NumPy dtypes with the layout and the field names of the C structs, read from the compiled
headers.

An array of one of them is an array of the C struct, without conversion: `impacts["a"]["v"]` is a
view of shape (..., 3).
"""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
import numpy.typing as npt

from carom._carom import ffi

Record = np.dtype[np.void]
"""Type of a structured dtype."""
Records = npt.NDArray[np.void]
"""Type of a structured array."""
Doubles = npt.NDArray[np.float64]

__all__ = [
    "ball_kind",
    "ball_state",
    "break_choice",
    "brief_event",
    "plan_stroke",
    "columns",
    "cue",
    "cushion_impact",
    "cushion_point",
    "event",
    "facts",
    "impact",
    "jaw",
    "motion",
    "plain",
    "player",
    "pocket",
    "rail",
    "result",
    "rules_state",
    "sequence_stroke",
    "shot",
    "shot_ball",
    "table",
    "tangent",
    "trace_point",
]

_NOT_SHOWN = {"reserved", "unused"}  # fields that only keep room for later


def _dtype(ctype: Any) -> np.dtype[Any]:
    """The dtype of a C type: every byte is in a field, since NumPy copies fields only."""
    if ctype.kind == "array":
        return np.dtype((_dtype(ctype.item), (ctype.length,)))
    if ctype.kind == "struct":
        fields, end = list[tuple[str, np.dtype[Any]]](), 0
        for name, begin, kind in [
            *((name, field.offset, field.type) for name, field in ctype.fields),
            ("", ffi.sizeof(ctype), None),
        ]:
            fields += (
                [(f"unused{end}", np.dtype((np.void, begin - end)))] if begin > end else []
            )  # the compiler's padding
            fields += [(name, _dtype(kind))] if kind else []
            end = begin + (ffi.sizeof(kind) if kind else 0)
        return np.dtype(fields)
    if ctype.kind == "pointer":
        return np.dtype(np.uintp)
    if ctype.cname == "_Bool":
        return np.dtype(np.bool_)
    letter = (
        "f" if ctype.cname in ("double", "float") else "u" if ctype.cname.startswith("u") else "i"
    )
    return np.dtype(f"{letter}{ffi.sizeof(ctype)}")


def _record(name: str) -> Record:
    return _dtype(ffi.typeof(name))


# The headers in core/include/ document the fields, with their units.
# Two balls at the instant of contact: a, b (r, v, w, radius, mass, mu_slide), mu_ball, restitution.
# 26 doubles.
impact: Record = _record("carom_impact")
result: Record = _record("carom_result")  # Two balls after the collision: a, b (v, w). 12 doubles.
motion: Record = _record("carom_motion")  # A ball's v (m/s) and w (rad/s). 6 doubles.
# A ball at a cushion: v, w, normal, height, radius, mass, mu_slide, mu_cushion, restitution,
# jaw_radius. 15 doubles.
cushion_impact: Record = _record("carom_cushion_impact")
trace_point: Record = _record("carom_trace_point")  # A point of `carom.trace`.
cushion_point: Record = _record("carom_cushion_point")  # A point of `carom.cushion_trace`.
ball_kind: Record = _record("carom_ball_kind")  # Properties of a ball, its cloth and its cushions.
# Where a ball is and how it moves: r (m), v (m/s), w (rad/s), label (`carom.Label`).
ball_state: Record = _record("carom_ball_state")
shot_ball: Record = _record("carom_shot_ball")  # A ball of a layout: kind, state.
cue: Record = _record("carom_cue")  # A cue and its strike.
rail: Record = _record("carom_rail")  # A straight piece of cushion.
jaw: Record = _record("carom_jaw")  # A rounded end of a cushion.
pocket: Record = _record("carom_pocket")  # A pocket.
table: Record = _record("carom_table")  # A table: any geometry.
# An event of a shot: time (s), type (`carom.EventType`), a, b, impulse (N s), before and after (two
# ball states each).
event: Record = _record("carom_event")
# An event without states, 24 bytes: time (s), type (`carom.EventType`), a, b.
brief_event: Record = _record("carom_brief_event")
# The errors of a player's strokes: standard deviations, and bounds.
player: Record = _record("carom_player")
plan_stroke: Record = _record("carom_plan_stroke")  # A shot that `carom.plan` proposes.
# A stroke of a run-out by `carom.sequence`.
sequence_stroke: Record = _record("carom_sequence_stroke")
# A break that `carom.best_breaks` proposes, with the results of breaks.
break_choice: Record = _record("carom_break_choice")
shot_way: Record = _record("carom_shot_way")  # A way that `carom.ways` finds.
facts: Record = _record(
    "carom_facts"
)  # The events of a shot in brief, as `carom.Features` shows them.
# The state of a game for the player at the table: opening, group, fouls, score, lost, pocket, may,
# on, free_ball, target, innings; `user` is for custom rules.
rules_state: Record = _record("carom_rules_state")
turn: Record = _record("carom_turn")  # A ruling on a shot.
shot: Record = _record(
    "carom_shot"
)  # The result of a shot with the addresses of its arrays, for calls of C.
# The derivatives of a shot with the addresses of their arrays, for calls of C.
tangent: Record = _record("carom_tangent")


def described(dtype: np.dtype[Any]) -> str:
    """A short name of a dtype, for error messages."""
    if dtype.names is None:
        return str(dtype)
    fields = ", ".join(dtype.names[:3]) + (", ..." if len(dtype.names) > 3 else "")
    known = {name: value for name, value in globals().items() if isinstance(value, np.dtype)}
    return next(
        (f"carom.dtypes.{name}" for name, value in known.items() if value == dtype),
        f"a structured dtype of {fields}",
    )


@functools.lru_cache(maxsize=64)
def _integers(dtype: np.dtype[Any], name: str = "") -> tuple[str, ...]:
    """The full names of the fields that are not float64."""
    part = dtype.base
    if part.names is None:
        return () if part == np.float64 else (name,)
    return tuple(
        found
        for field in part.names
        for found in _integers(part[field], f"{name}.{field}" if name else field)
    )


def plain(records: Records) -> Doubles:
    """Return records of doubles as float64 of shape (..., width): a view if they are in C order.

    Records that contain integers, such as labels, event types or indices, raise TypeError, because
    their bytes would be read as doubles.

    >>> plain(carom.impacts(v_a=velocities, r_b=(0.05715, 0, 0))).shape
    (1000, 26)
    """
    if records.dtype.names is None:
        raise TypeError(
            f"records: an array of {described(records.dtype)} has no fields; pass a structured array, such as the result of carom.impacts()"
        )
    integers = _integers(records.dtype)
    if integers:
        kind = (
            f"{integers[0]} and {len(integers) - 1} more hold"
            if len(integers) > 1
            else f"{integers[0]} holds"
        )
        raise TypeError(
            f"records: {kind} integers, which cannot be viewed as float64; select the fields by their names"
        )
    numbers = np.ascontiguousarray(records).reshape(-1).view(np.float64)
    return numbers.reshape((*records.shape, records.dtype.itemsize // 8))


def columns(records: Records) -> dict[str, npt.NDArray[Any]]:
    """Return records of shape (n,) as columns of shape (n,), for example for `pandas.DataFrame`.

    Reserved fields are omitted. The names of nested fields are joined: state_r_x, before_a_v_y. The
    components of a vector are x, y, z, and two states are a, b.
    """
    if records.dtype.names is None or records.ndim != 1:
        raise TypeError(
            f"records: dtype {described(records.dtype)} and shape {records.shape} do not fit; pass a structured array of shape (n,)"
        )
    found: dict[str, npt.NDArray[Any]] = {}
    for name in (
        name for name in records.dtype.names if name.rstrip("0123456789") not in _NOT_SHOWN
    ):
        field: npt.NDArray[Any] = records[name]
        parts = {name: field}
        if field.ndim == 2:
            letters = "xyz" if field.dtype.names is None else "ab"
            parts = {
                f"{name}_{letter}": field[:, k]
                for k, letter in enumerate(letters[: field.shape[1]])
            }
        for part, values in parts.items():
            inner = {part: values} if values.dtype.names is None else columns(values)
            found |= {
                inner_name if inner_name == part else f"{part}_{inner_name}": column
                for inner_name, column in inner.items()
            }
    return found
