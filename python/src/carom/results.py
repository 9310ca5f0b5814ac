"""What shots give: one, and many."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import INT8, Array, as_array, in_chunks, pointer
from carom.layouts import Table, cue_error
from carom.status import CaromError, Status

if TYPE_CHECKING:
    from carom.pictures import Animation


class Label(enum.IntEnum):
    """How a ball moves."""

    STATIONARY = 0
    SPINNING = 1
    SLIDING = 2
    ROLLING = 3
    POCKETED = 4
    AIRBORNE = 5
    OFF = 6


class EventType(enum.IntEnum):
    """What happened: to ball a, and to ball, rail, jaw or pocket b."""

    STRIKE = 1
    BALL_BALL = 2
    RAIL = 3
    JAW = 4
    POCKET = 5
    SLIDING_ROLLING = 6
    ROLLING_SPINNING = 7
    ROLLING_STATIONARY = 8
    SPINNING_STATIONARY = 9
    SLATE = 10
    RAIL_TOP = 11
    LEFT_TABLE = 12


class Shot:
    """One shot.

    Attributes
    ----------
    table : Table
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        The layout before the strike.
    status : Status
    time : float
        Time of the last event, s.
    count : int
        Number of events, including those that were not kept.
    events : ndarray of `carom.dtypes.event`, shape (kept,)
        In the order in which they happened.
    final : ndarray of `carom.dtypes.ball_state`, shape (balls,)
    """

    def __init__(
        self,
        table: Table,
        balls: dtypes.Records,
        status: int,
        time: float,
        count: int,
        events: dtypes.Records,
        final: dtypes.Records,
    ) -> None:
        self.table = table
        self.balls = balls
        self.status = Status(status)
        self.time = time
        self.count = count
        self.events = events
        self.final = final

    def states(self, times: npt.ArrayLike) -> dtypes.Records:
        """The states of all balls at any times.

        Parameters
        ----------
        times : array_like, shape (...)
            s. Before 0: as at 0; after the end: as at the end, where nothing moves any more.

        Returns
        -------
        ndarray of `carom.dtypes.ball_state`, shape (..., balls)

        Raises
        ------
        CaromError
            Not all events were kept (`simulate_batch` with too little room), or a time is after the end of a shot that a bound
            or an error stopped while balls moved.
        ValueError
            A time is nan.
        """
        at = np.asarray(as_array(times, "times", np.float64), order="C")
        if np.isnan(at).any():
            raise ValueError("times: a time must be a number of seconds, not nan")
        states: Array = np.zeros((*at.shape, len(self.balls)), dtypes.ball_state)
        events = np.ascontiguousarray(self.events)
        shot = ffi.new(
            "carom_shot *",
            {"events": pointer("carom_event[]", events), "room": len(events), "count": self.count, "time": self.time},
        )
        balls, count = pointer("carom_shot_ball[]", self.balls), len(self.balls)
        moments, target = pointer("double[]", at), pointer("carom_ball_state[]", states)

        def look(begin: int, many: int) -> int:
            return int(lib.carom_python_shot_at(balls, count, shot, many, moments + begin, target + begin * count))

        code = in_chunks(at.size, 1e-6, 0, look)
        if code < 0:
            raise CaromError(code)
        return states

    def positions(self, times: npt.ArrayLike) -> dtypes.Doubles:
        """The centres of all balls at any times.

        Parameters
        ----------
        times : array_like, shape (...)
            s.

        Returns
        -------
        ndarray of float64, shape (..., balls, 3)
            m.

        Raises
        ------
        CaromError, ValueError
            As for `states`.
        """
        return np.asarray(self.states(times)["r"], dtype=np.float64)

    def to_dataframe(self) -> Any:
        """The events as a pandas DataFrame, a row an event: time, type (by name), a, b, before_a_r_x and so on.

        Needs pandas. `carom.dtypes.columns` makes columns of any records.
        """
        import pandas

        names = {kind.value: kind.name.lower() for kind in EventType}
        frame = pandas.DataFrame(dtypes.columns(self.events))
        frame["type"] = pandas.Categorical([names[kind] for kind in self.events["type"].tolist()], list(names.values()))
        return frame

    def __repr__(self) -> str:
        return f"<carom.Shot: {len(self.balls)} balls, {self.count} events, {self.time:.4g} s, {self.status.text}>"

    def _repr_svg_(self) -> str:
        from carom import pictures

        return pictures.picture(self.table, self)

    def animate(self, speed: float = 1.0) -> Animation:
        """A moving picture, for Jupyter or a file.

        Parameters
        ----------
        speed : float
            1 is that of the shot.

        Returns
        -------
        Animation
            Its `svg` is the text of a file that moves in any browser.
        """
        from carom import pictures

        return pictures.animation(self, speed)


class Shots:
    """Many shots: arrays of the shape of the batch.

    Attributes
    ----------
    table : Table
    layouts : ndarray of `carom.dtypes.shot_ball`, shape (..., balls) or (1, balls)
    cues : ndarray of `carom.dtypes.cue`, shape (...) or one, or None
    status : ndarray of int8, shape (...)
        As `Status`; a shot in error costs itself alone.
    time : ndarray of float64, shape (...)
        Time of the last event, s.
    count : ndarray of int64, shape (...)
        Events that happened, also beyond the room.
    final : ndarray of `carom.dtypes.ball_state`, shape (..., balls)
        Undefined where an argument was in error.
    events : ndarray of `carom.dtypes.event`, shape (..., room)
        The first count of each row are valid.
    record : ndarray of `carom.dtypes.shot`, shape (...)
        The structs of C, with the addresses of final and events.
    """

    def __init__(self, table: Table, layouts: dtypes.Records, shape: tuple[int, ...], room: int) -> None:
        balls = layouts.shape[-1]
        self.table = table
        self.layouts = layouts
        self.cues: dtypes.Records | None = None
        self.status: npt.NDArray[np.int8] = np.zeros(shape, INT8)
        self.final: dtypes.Records = np.zeros((*shape, balls), dtypes.ball_state)
        self.events: dtypes.Records = np.zeros((*shape, room), dtypes.event)
        self.record: dtypes.Records = np.zeros(shape, dtypes.shot)

    @property
    def time(self) -> dtypes.Doubles:
        """When the last event happened, s."""
        return np.asarray(self.record["time"])

    @property
    def count(self) -> npt.NDArray[np.int64]:
        """Events that happened."""
        return np.asarray(self.record["count"])

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the batch."""
        return self.status.shape

    def __len__(self) -> int:
        return len(self.status)

    def __getitem__(self, index: int | tuple[int, ...]) -> Shot:
        """One shot of the batch, by its full index."""
        status = self.status[index]
        if np.ndim(status) != 0:
            raise IndexError(f"a shot of a batch of shape {self.shape} has {len(self.shape)} indices")
        count = int(self.count[index])
        kept: dtypes.Records = self.events[index][: min(count, self.events.shape[-1])]
        layout = np.broadcast_to(self.layouts, self.final.shape)[index]
        balls = np.array(layout, dtypes.shot_ball)
        return Shot(self.table, balls, int(status), float(self.time[index]), count, kept, self.final[index])

    def failures(self) -> list[tuple[tuple[int, ...], str]]:
        """The index of each shot that ended in an error, and the error."""
        return [(index, self._why(index)) for index in (tuple(int(k) for k in row) for row in np.argwhere(self.status < 0))]

    def _why(self, index: tuple[int, ...]) -> str:
        status = Status(int(self.status[index]))
        if self.cues is None or status not in (Status.ERROR_CUE, Status.ERROR_MISCUE):
            return status.text
        layout = np.broadcast_to(self.layouts, self.final.shape)[index]
        return str(cue_error(status, np.broadcast_to(self.cues, self.shape)[index], layout))

    def __repr__(self) -> str:
        return f"<carom.Shots: {self.shape}, {int((self.status < 0).sum())} in error>"
