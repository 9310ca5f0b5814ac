"""The status of a call, C's carom_status, and the exception that carries it."""

from __future__ import annotations

import enum
import re
from typing import TYPE_CHECKING, Any

from carom._carom import ffi, lib


# Errors of matches name functions and constants of C.
_NAMES = {
    "carom_match_continue()": "resume()",
    "carom_record_read()": "carom.record.replay()",
    "carom_rules_kind": "game of carom.plan()",
}


def in_python(text: str) -> str:
    """Translate the names in a text of C to Python: place() for carom_match_place(), "potting" for
    CAROM_RULES_POTTING.
    """

    def named(name: re.Match[str]) -> str:
        if name[0] in _NAMES:
            return _NAMES[name[0]]
        if name[0].startswith("CAROM_"):
            return f'"{name[0].split("_", 2)[-1].lower()}"'
        return name[0].removeprefix("carom_").removeprefix("match_")

    return re.sub(r"\bcarom_\w+(?:\(\))?|\bCAROM_\w+", named, text)


class _Status(enum.IntEnum):
    """The outcome of a call: 0 is success, positive a valid result with a remark, negative an
    error.

    `text` explains it. `list(Status)` lists the names, which are the ones in carom.h without
    CAROM_, such as OK, STOPPED_AT_TIME and ERROR_MASS.
    """

    @property
    def text(self) -> str:
        """The meaning of the status, in one sentence."""
        text: str = ffi.string(lib.carom_status_string(self)).decode()
        # A field of a struct in C is an argument in Python.
        return text.replace("options.", "").replace("CAROM_ALL_THREADS", "carom.ALL_THREADS")


if TYPE_CHECKING:

    class _Named(enum.EnumMeta):
        def __getattr__(cls, name: str) -> Status: ...

    class Status(_Status, metaclass=_Named): ...

else:
    _values = sorted(
        ffi.typeof("carom_status").relements.items(), key=lambda item: (abs(item[1]), -item[1])
    )
    Status = _Status(
        "Status", {name.removeprefix("CAROM_"): value for name, value in _values}, module=__name__
    )
    Status.__doc__ = _Status.__doc__


class CaromError(ValueError):
    """A call failed.

    Attributes
    ----------
    status : Status
    field : str or None
        The invalid field, such as "a.mass" or "balls[3].state.r"; None if it is not a single one.
    value : object
        The value of that field, or None.
    shot : Shot or None
        The shot up to the error, if a shot failed.
    """

    def __init__(
        self,
        status: int,
        field: str | None = None,
        value: object = None,
        shot: Any = None,
        text: str | None = None,
    ) -> None:
        self.status = Status(status)
        self.field = field
        self.value = value
        self.shot = shot
        self._text = text or self.status.text
        where = "" if field is None else f"{field}: " if value is None else f"{field} = {value}: "
        super().__init__(where + self._text)

    def __reduce__(self) -> tuple[object, ...]:
        """For pickle and multiprocessing, which by default would pass only the message."""
        return (
            type(self),
            (self.status, self.field, self.value, self.shot, self._text),
            self.__dict__,
        )
