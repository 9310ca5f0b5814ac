"""How a call ended: the values of C's carom_status, and the exception that carries one."""

from __future__ import annotations

import enum
import re
from typing import TYPE_CHECKING, Any

from carom._carom import ffi, lib


# Of faults of matches, which name calls of C and constants.
_NAMES = {
    "carom_match_continue()": "resume()",
    "carom_record_read()": "carom.record.replay()",
    "carom_rules_kind": "game of carom.plan()",
}


def in_python(text: str) -> str:
    """A text of C with the names of Python: place() for carom_match_place(), "potting" for
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
    error. `text` explains it.

    The names are those of carom.h without CAROM_, such as OK, STOPPED_AT_TIME and ERROR_MASS:
    `list(Status)` has them.
    """

    @property
    def text(self) -> str:
        """What the status means, in one sentence."""
        text: str = ffi.string(lib.carom_status_string(self)).decode()
        # What C has in a struct is an argument here.
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
    """A call that could not be served.

    `status` is a Status; `field` is the name of the field at fault ("a.mass", "balls[3].state.r"),
    None where no single one is to blame; `value` is the value of that field, None where nothing is
    to be shown; `shot` is the Shot until then, where one ended in an error, or None.
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
        """What pickle and the pools of multiprocessing make it of again; by default they would call
        it with its sentence alone.
        """
        return (
            type(self),
            (self.status, self.field, self.value, self.shot, self._text),
            self.__dict__,
        )
