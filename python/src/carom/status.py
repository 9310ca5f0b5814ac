"""How a call ended: the values of C's carom_status, and the exception that carries one."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING

from carom._carom import ffi, lib

if TYPE_CHECKING:
    from carom.results import Shot


class Status(enum.IntEnum):
    """The outcome of a call: 0 is success, positive a valid result with a remark, negative an error. `text` explains it."""

    OK = 0
    SEPARATING = 1
    STOPPED_AT_TIME = 2
    STOPPED_AT_EVENT = 3
    ERROR_NULL = -1
    ERROR_SOLVER = -2
    ERROR_SLIP = -3
    ERROR_STEPS = -4
    ERROR_POSITION = -5
    ERROR_VELOCITY = -6
    ERROR_SPIN = -7
    ERROR_RADIUS = -8
    ERROR_MASS = -9
    ERROR_MU_CLOTH = -10
    ERROR_MU_BALL = -11
    ERROR_RESTITUTION = -12
    ERROR_RADII_DIFFER = -13
    ERROR_HEIGHTS_DIFFER = -14
    ERROR_VERTICAL = -15
    ERROR_COINCIDENT = -16
    ERROR_TOO_SLOW = -17
    ERROR_OVERFLOW = -18
    ERROR_MASSES_DIFFER = -19
    ERROR_THREADS = -20
    ERROR_POINTS = -21
    ERROR_UNRESOLVED = -22
    ERROR_OPTIONS = -23
    ERROR_CUSHION_MODEL = -30
    ERROR_CUSHION_OPTIONS = -31
    ERROR_NORMAL = -32
    ERROR_NOSE_HEIGHT = -33
    ERROR_MU_CUSHION = -34
    ERROR_JAW_RADIUS = -35
    ERROR_TOO_MANY_EVENTS = -40
    ERROR_TOO_LONG = -41
    ERROR_LEFT_TABLE = -42
    ERROR_SHOT_OPTIONS = -43
    ERROR_BALLS = -44
    ERROR_LABEL = -45
    ERROR_OVERLAP = -46
    ERROR_OFF_TABLE = -47
    ERROR_MU_MOTION = -48
    ERROR_GRAVITY = -49
    ERROR_CUE = -50
    ERROR_MISCUE = -51
    ERROR_TABLE = -52
    ERROR_RACK = -53
    ERROR_EVENTS_LOST = -54
    ERROR_TIME = -55
    ERROR_DRAG = -56
    ERROR_BALL_CUSHION = -57
    ERROR_STATE = -60
    ERROR_TABLE_OPEN = -61
    ERROR_RAIL_SIDE = -62
    ERROR_RAIL_LINE = -63
    ERROR_TANGENT = -70
    ERROR_DIRECTIONS = -71

    @property
    def text(self) -> str:
        """What the status means, in one sentence."""
        text: str = ffi.string(lib.carom_status_string(self)).decode()
        # What C has in a struct is an argument here.
        return text.replace("options.", "").replace("CAROM_ALL_THREADS", "carom.ALL_THREADS")


class CaromError(ValueError):
    """A call that could not be served.

    Attributes
    ----------
    status : Status
    field : str or None
        Name of the field at fault ("a.mass", "balls[3].state.r"), None where no single one is to blame.
    value : object
        What stands there, None where nothing is to be shown.
    shot : Shot or None
        What had happened until then, where a shot ended in an error.
    """

    def __init__(
        self, status: int, field: str | None = None, value: object = None, shot: Shot | None = None, text: str | None = None
    ) -> None:
        self.status = Status(status)
        self.field = field
        self.value = value
        self.shot = shot
        self._text = text or self.status.text
        where = "" if field is None else f"{field}: " if value is None else f"{field} = {value}: "
        super().__init__(where + self._text)

    def __reduce__(self) -> tuple[object, ...]:
        """What pickle and the pools of multiprocessing make it of again; by default they would call it with its sentence alone."""
        return type(self), (self.status, self.field, self.value, self.shot, self._text), self.__dict__
