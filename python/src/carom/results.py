"""Results of shots: `Shot` for one, `Shots` for a batch."""

from __future__ import annotations

import enum
import functools
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes, pictures
from carom._carom import ffi, lib
from carom._described import EventType as EventType
from carom._described import Label as Label
from carom._faults import argument_error, shot_arguments
from carom._rows import (
    INT8,
    Array,
    Arrays,
    addresses,
    as_array,
    fill,
    in_chunks,
    needed,
    one_or_all,
    pointer,
    sealed,
    several,
    spread,
    whole,
)
from carom._shot_options import Options, shot_options
from carom.dtypes import Doubles, Record, Records
from carom._verbs import ShotsVerbs, ShotVerbs, states_frame
from carom.animations import Animation, animated
from carom.layouts import Table
from carom.status import CaromError, Status


def _moments(times: ArrayLike) -> Doubles:
    moments = np.asarray(as_array(times, "times", np.float64), order="C")
    wrong = moments[~((moments >= 0.0) & (moments < np.inf))]
    if wrong.size:
        raise ValueError(
            f"times: {wrong.flat[0]} is negative or not finite; times are in s from the beginning of the shot"
        )
    return moments


def _states_at(balls: Any, count: int, shot: Any, times: Any, n: int, states: Any) -> int:
    return int(lib.carom_shot_frames(balls, count, shot, times, n, ffi.NULL, states, ffi.NULL))


def _picker(index: Any, shape: tuple[int, ...]) -> Callable[[Array], Array]:
    """A function that selects the shots of an index from any array of a batch.

    The index applies to the shape of the batch, as in NumPy; further dimensions of an array are
    kept. Integers, slices, None and Ellipsis return views, as in NumPy; other indices return
    copies.
    """
    entries: tuple[Any, ...] = index if isinstance(index, tuple) else (index,)
    if all(map(_is_basic, entries)):
        missing = len(shape) - sum(entry is not None and entry is not ... for entry in entries)
        if ... not in entries:
            entries += (...,)
        place = entries.index(...)
        whole_ones = (slice(None),) * missing
        view = (*entries[:place], *whole_ones, *entries[place + 1 :], ...)
        return lambda array: array[view]
    # the coordinates of the selected shots, so that a broadcast array is not copied
    places: Array = np.arange(math.prod(shape)).reshape(shape)[index]
    where: tuple[Any, ...] = (*np.unravel_index(places, shape or (1,)), ...)
    return lambda array: (array if shape else array[np.newaxis])[where]


def _is_basic(entry: Any) -> bool:
    """Whether an entry of an index is basic in NumPy's sense; True and False are masks."""
    if entry is None or entry is ... or isinstance(entry, slice):
        return True
    return isinstance(entry, (int, np.integer)) and not isinstance(entry, bool)


_USUAL = Options()
UNKNOWN = fill(dtypes.ball_state, {}, {**dict.fromkeys("rvw", np.nan), "label": -1})


@dataclass(eq=False, repr=False)
class Shot(ShotVerbs):
    """The result of one shot.

    The table, the balls, the cue and the events are read-only, because later calls, such as
    `positions`, `carom.resume` and `carom.tangents`, read them. Copies are writeable.

    Attributes
    ----------
    table : Table
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        The layout before the strike.
    status : Status
    time : float
        Time of the last event, or when the shot was stopped, s.
    count : int
        Number of events, including those that were not kept.
    events : ndarray of `carom.dtypes.event`, shape (kept,)
        Events in order of time. With records="brief" of a batch: `carom.dtypes.brief_event`.
    final : ndarray of `carom.dtypes.ball_state`, shape (balls,)
    cue : ndarray of `carom.dtypes.cue`, shape (), or None
    options : Options
        Models and limits of the shot.
    state
        Internal state for `carom.resume`; None if the shot had no `t_final` or `stop_at`.
    """

    table: Table
    balls: Records
    status: Status
    time: float
    count: int
    events: Records
    final: Records
    cue: Records | None
    options: Options
    state: Array | None = None

    def states(self, times: ArrayLike, *, drawn: bool = False) -> Records:
        """Return the states of all balls at given times.

        Parameters
        ----------
        times : array_like, shape (...)
            s from the beginning of the shot. After its end the states are the final ones.
        drawn : bool
            For drawing: a pocketed ball falls to the bottom of its pocket, or onto other balls, and
            stays there. A shot of a batch then needs all of its events, `simulate_batch(room=...)`.

        Returns
        -------
        ndarray of `carom.dtypes.ball_state`, shape (..., balls)

        Raises
        ------
        CaromError
            A time is after the end of a shot that was stopped or failed while balls were moving.
        ValueError
            A time is negative or not finite.
        """
        moments = _moments(times)
        states: Array = np.zeros((*moments.shape, len(self.balls)), dtypes.ball_state)
        look = (
            functools.partial(lib.carom_shot_drawn, pointer("carom_table[]", self.table.record))
            if drawn
            else _states_at
        )
        self._at(moments, states, 1, "carom_ball_state[]", look)
        return states

    def _at(
        self,
        instants: Doubles,
        out: Array,
        numbers: int,
        ctype: str,
        look: Callable[..., int],
    ) -> None:
        """Call look(balls, count, shot, times, n, out) for chunks of the times."""
        if self.events.dtype != dtypes.event:
            raise CaromError(Status.ERROR_EVENTS_LOST)
        events = np.ascontiguousarray(self.events)
        fields = {
            "events": pointer("carom_event[]", events),
            "room": len(events),
            "count": self.count,
            "time": self.time,
            **self.table.slope,
        }
        shot = ffi.new("carom_shot *", fields)
        balls, count = pointer("carom_shot_ball[]", self.balls), len(self.balls)
        moments, target = pointer("double[]", instants), pointer(ctype, out)

        def chunk(begin: int, many: int) -> int:
            return int(
                look(balls, count, shot, moments + begin, many, target + begin * count * numbers)
            )

        code = in_chunks(instants.size, 1e-6, 0, chunk)
        if code < 0:
            raise CaromError(code)

    def orientations(self, times: ArrayLike) -> Doubles:
        """Return the rotation of each ball since the beginning of the shot, for drawing.

        Times and errors are as for `states`.

        Returns
        -------
        ndarray of float64, shape (..., balls, 4)
            Unit quaternions (w, x, y, z) that rotate a ball's initial orientation to the one at the
            time.
        """
        moments = _moments(times)
        turned: Doubles = np.zeros((*moments.shape, len(self.balls), 4))
        self._at(moments, turned, 4, "double[]", lib.carom_python_orientations)
        return turned

    @property
    def slips(self) -> Doubles:
        """The slip speed at the contact of each event, m/s; 0 without a contact.

        With `impulse` it determines how a contact sounds.
        """
        table, balls = (
            pointer("carom_table[]", self.table.record),
            pointer("carom_shot_ball[]", self.balls),
        )
        events = pointer("carom_event[]", np.ascontiguousarray(self.events))
        return np.array(
            [
                lib.carom_event_slip(table, balls, len(self.balls), events + k)
                for k in range(len(self.events))
            ]
        )

    def positions(self, times: ArrayLike) -> Doubles:
        """Return the centres of all balls at given times: float64 of shape (..., balls, 3), m.

        Times and errors are as for `states`.
        """
        return np.asarray(self.states(times)["r"], dtype=np.float64)

    def to_dataframe(self, dt: float | None = None) -> Any:
        """Return the events as a pandas DataFrame, one row per event; or with `dt` the states, one row
        per ball and time.

        With `dt`, the columns are time, ball, r_x, and so on, every `dt` seconds and at the end.
        Without, they are as follows.

        The columns are time, type (by name), a, b, before_a_r_x, and so on. Without a second ball,
        its values are nan and its labels -1. Needs pandas. `carom.dtypes.columns` converts other
        records.
        """
        if dt is not None:
            return states_frame(self, dt)
        pandas = needed("pandas", "to_dataframe()")
        names = {kind.value: kind.name.lower() for kind in EventType}
        events = self.events.copy()
        for side in ("before", "after") if events.dtype == dtypes.event else ():
            events[side][events["type"] != EventType.BALL_BALL, 1] = UNKNOWN
        frame = pandas.DataFrame(dtypes.columns(events))
        frame.index.name = "event"
        frame["type"] = pandas.Categorical(
            [names[kind] for kind in self.events["type"].tolist()], list(names.values())
        )
        return frame

    def __repr__(self) -> str:
        return f"<carom.Shot: {len(self.balls)} balls, {self.count} events, {self.time:.4g} s, {self.status.text}>"

    def _repr_svg_(self) -> str:
        return pictures.picture(self.table, self)

    def plot(self, ax: Any = None) -> Any:
        """Draw the table and the paths on axes of matplotlib, in metres, and return the axes.

        Balls are faint at their initial positions and opaque at the final ones. `ax` defaults to
        the current axes. Needs matplotlib.
        """
        return pictures.plot(self.table, self, ax)

    def animate(self, speed: float = 1.0) -> Animation:
        """Return an animation for Jupyter; its `svg` is the text of a file that any browser plays.

        `speed` is relative to real time. `save("shot.gif", fps=30)` of the animation writes a file:
        .svg, .gif or .mp4.
        """
        return animated(self, speed)


class _OfBatch(Shot):
    """A shot of a batch, whose attributes are computed on first use."""

    def __init__(self, batch: Shots, index: Any) -> None:
        self._batch = batch
        self._index: Any = index

    def __getattr__(self, name: str) -> Any:
        make = _ATTRIBUTES.get(name)
        if make is None:
            raise AttributeError(f"a carom.Shot has no attribute {name!r}")
        value = self.__dict__[name] = make(self._batch, self._index)
        return value

    def __reduce__(self) -> tuple[Any, ...]:
        return Shot, tuple(getattr(self, field.name) for field in fields(Shot))

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *_ATTRIBUTES})

    def states(self, times: ArrayLike, *, drawn: bool = False) -> Records:
        return (
            super().states(times, drawn=True) if drawn else self._seen(times, dtypes.ball_state, ())
        )

    def positions(self, times: ArrayLike) -> Doubles:
        return self._seen(times, np.dtype(np.float64), (3,))

    def _seen(self, times: ArrayLike, dtype: np.dtype[Any], numbers: tuple[int, ...]) -> Array:
        index: tuple[Any, ...] = self._index if isinstance(self._index, tuple) else (self._index,)
        alone: Shots = self._batch[(*index, ...)]
        seen, codes = alone._look_at(times, dtype, numbers, 0)
        if codes[0] < 0:
            raise (
                self._batch.error(self._index)
                if self.status < 0 and self.time == 0.0
                else CaromError(int(codes[0]))
            )
        return seen

    def _at(
        self,
        instants: Doubles,
        out: Array,
        numbers: int,
        ctype: str,
        look: Callable[..., int],
    ) -> None:
        if self.count > len(self.events) or self.events.dtype != dtypes.event:
            raise CaromError(Status.ERROR_EVENTS_LOST)
        super()._at(instants, out, numbers, ctype, look)


def _kept(batch: Shots, index: Any) -> Records:
    brief: Records = batch.events[index]
    return sealed(brief[: int(batch.record["count"][index])])


def _layout(batch: Shots, index: Any) -> Records:
    layouts: Records = np.broadcast_to(batch.layouts, batch.final.shape)[index]
    if batch.kinds is None:
        return sealed(np.array(layouts, dtypes.shot_ball))
    balls = np.empty(layouts.shape, dtypes.shot_ball)
    balls["kind"], balls["state"] = batch.kinds, layouts
    return sealed(balls)


_ATTRIBUTES: dict[str, Callable[[Shots, Any], Any]] = {
    "table": lambda batch, index: batch.table,
    "balls": _layout,
    "status": lambda batch, index: Status(int(batch.status[index])),
    "time": lambda batch, index: float(batch.record["time"][index]),
    "count": lambda batch, index: int(batch.record["count"][index]),
    "events": _kept,
    "final": lambda batch, index: batch.final[index],
    "cue": lambda batch, index: None
    if batch.cues is None
    else sealed(np.array(np.broadcast_to(batch.cues, batch.shape)[index])),
    "options": lambda batch, index: batch.options,
}


@dataclass(frozen=True, repr=False)
class Features(Arrays):
    """Contacts, cushions and pockets of shots, as planners need them: arrays over the batch.

    Missing contacts and pockets have index -1 and time inf. The cue ball is the ball struck, or
    ball 0 without a cue. A cushion is a rail or its rounded end.

    Attributes
    ----------
    contact, contact_time : shape (..., 2)
        The first and the second different ball that the cue ball hit, and when, s.
    cushions_before : shape (..., 2)
        Impacts of the cue ball on cushions before each of these contacts; 0 without a contact.
    cushions_after : shape (...)
        Impacts of all balls on cushions after the first contact.
    pocket, pocket_time : shape (..., balls)
        Index in `table.pockets` of the pocket into which each ball fell, and when, s.
    cushions : shape (..., balls)
        Impacts of each ball on cushions.
    """

    contact: NDArray[np.int32]
    contact_time: Doubles
    cushions_before: NDArray[np.int32]
    cushions_after: NDArray[np.int32]
    pocket: NDArray[np.int32]
    pocket_time: Doubles
    cushions: NDArray[np.int32]

    def __getitem__(self, index: Any) -> Features:
        """The features of some shots, indexed as in `Shots`."""
        pick = _picker(index, self.cushions_after.shape)
        return Features(*(pick(getattr(self, field.name)) for field in fields(self)))


# Units of the columns and variables of tables.
_UNITS = {
    **dict.fromkeys(("time", "contact_time", "pocket_time", "cue_tip_time"), "s"),
    **dict.fromkeys(("cue_phi", "cue_theta"), "degree"),
    **dict.fromkeys(("cue_mass", "cue_end_mass"), "kg"),
    **dict.fromkeys(("cue_tip_radius", "cue_follow", "r"), "m"),
    **dict.fromkeys(("cue_speed", "v"), "m/s"),
    "w": "rad/s",
}


def _units(name: str) -> dict[str, str]:
    """The attributes of a column or variable: the unit of r for ball_0_r_x."""
    *front, last = re.sub(r"^ball_\d+_", "", name).split("_")
    base = (
        "_".join(front)
        if front and (last.isdecimal() or last in "xyz")
        else "_".join([*front, last])
    )
    return {"units": _UNITS[base]} if base in _UNITS else {}


_OF_BALLS = {"pocket", "pocket_time", "cushions"}


class Shots(ShotsVerbs):
    """The results of a batch of shots: arrays over the batch.

    Indexing, iteration and `len` work as for the array `status`. Where NumPy would return a scalar,
    a batch returns a `Shot`, whose attributes are computed on first use; where NumPy would return
    an array, it returns `Shots`. Slices are views; masks and index arrays make copies. `flat`
    iterates over all shots in C order.

    Attributes
    ----------
    table, options
        As for `Shot`.
    layouts : ndarray of `carom.dtypes.shot_ball`, shape (..., balls) or (1, balls)
        With `kinds`, an array of `carom.dtypes.ball_state`.
    kinds : ndarray of `carom.dtypes.ball_kind`, shape (balls,), or None
    cues : ndarray of `carom.dtypes.cue`, shape (...) or (), or None
    status : ndarray of int8, shape (...)
        The `Status` of each shot. Failed shots do not affect the others.
    time, count : ndarrays of float64 and int64, shape (...)
        Time of the last event, or when the shot was stopped, s; number of events, including those
        beyond the room.
    final : ndarray of `carom.dtypes.ball_state`, shape (..., balls)
        For an invalid argument all values are nan and the labels -1, as in `states`.
    events : ndarray of `carom.dtypes.event` or `carom.dtypes.brief_event`, shape (..., room)
        The first `count` entries of each row are valid.
    features : Features
        Only with `simulate_batch(features=True)`; otherwise the attribute does not exist.
    record : ndarray of `carom.dtypes.shot`, shape (...)
        The structs of C, with the addresses of final and events.
    """

    table: Table
    options: Options

    def __init__(
        self,
        table: Table,
        layouts: Records,
        shape: tuple[int, ...],
        room: int,
        event: Record = dtypes.event,
    ) -> None:
        balls = layouts.shape[-1]
        self.table = table
        self.layouts = layouts
        self.kinds: Records | None = None
        self.cues: Records | None = None
        self.status: NDArray[np.int8] = np.zeros(shape, INT8)
        self.final: Records = np.zeros((*shape, balls), dtypes.ball_state)
        self.events: Records = np.zeros((*shape, room), event)
        self.record: Records = np.zeros(shape, dtypes.shot)
        self._facts: Records | None = None  # dtypes.facts, with features
        self.options = _USUAL

    @property
    def time(self) -> Doubles:
        """The time of the last event, s, a read-only view."""
        return sealed(self.record["time"])

    @property
    def count(self) -> NDArray[np.int64]:
        """The number of events, a read-only view."""
        return sealed(self.record["count"])

    @property
    def refused(self) -> NDArray[np.bool_]:
        """Which shots were not played because an argument was invalid."""
        return np.asarray((self.status < 0) & (self.count == 0) & (self.time == 0.0))

    @property
    def features(self) -> Features:
        """The `Features` of the shots, if `simulate_batch(features=True)` computed them."""
        if self._facts is None:
            raise AttributeError(
                "features: these shots were played without them; pass features=True to simulate_batch()"
            )
        names = {"contact": "first", "contact_time": "first_time"}
        found = {
            each.name: self._facts[names.get(each.name, each.name)] for each in fields(Features)
        }
        count = self.final.shape[-1]
        return Features(
            **{
                name: array[..., :count] if name in _OF_BALLS else array
                for name, array in found.items()
            }
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the batch."""
        return self.status.shape

    @property
    def ndim(self) -> int:
        """The number of dimensions of the batch."""
        return self.status.ndim

    @property
    def size(self) -> int:
        """The number of shots in the batch."""
        return self.status.size

    def __len__(self) -> int:
        return len(self.status)

    def __iter__(self) -> Iterator[Any]:
        """Iterate over `shots[0]`, `shots[1]`, ...; each is a `Shot` if the batch has one
        dimension.
        """
        if not self.shape:
            raise TypeError(
                "cannot iterate over a batch of shape (), which is one shot; use shots[()]"
            )
        return (self[k] for k in range(len(self)))

    @property
    def flat(self) -> Iterator[Shot]:
        """All shots, in C order."""
        return (_OfBatch(self, index) for index in np.ndindex(self.shape))

    @overload
    def __getitem__(self, index: tuple[int, ...]) -> Shot: ...
    @overload
    def __getitem__(self, index: slice | NDArray[Any] | list[Any]) -> Shots: ...
    @overload
    def __getitem__(self, index: Any) -> Any: ...
    def __getitem__(self, index: Any) -> Any:
        """One shot of the batch, or several, as NumPy indexes `status`."""
        chosen = self.status[index]
        if not isinstance(chosen, np.ndarray):
            return _OfBatch(self, index)
        pick = _picker(index, self.shape)
        part = Shots.__new__(Shots)
        part.table, part.options, part.kinds = self.table, self.options, self.kinds
        part.status, part.final, part.events, part.record = (
            pick(self.status),
            pick(self.final),
            pick(self.events),
            pick(self.record),
        )
        part._facts = None if self._facts is None else pick(self._facts)
        # a single layout or cue for all shots stays single
        count = self.final.shape[-1]
        part.layouts = (
            self.layouts.reshape(count)
            if self.layouts.size == count
            else pick(np.broadcast_to(self.layouts, self.final.shape))
        )
        part.cues = self.cues
        if self.cues is not None:
            part.cues = (
                self.cues.reshape(())
                if self.cues.size == 1
                else pick(np.broadcast_to(self.cues, self.shape))
            )
        return part

    # ---- Trajectories
    # ---------------------------------------------------------------------------------------------------

    def states(self, times: ArrayLike, *, threads: int = 0) -> Records:
        """Return the states of all balls of all shots at given times.

        Shots whose events were not all kept are played again, which takes as long as playing them
        did.

        Parameters
        ----------
        times : array_like, shape (times...)
            s from the beginning of each shot. After its end the states are the final ones.
        threads : int
            As for `simulate_batch`.

        Returns
        -------
        ndarray of `carom.dtypes.ball_state`, shape (batch..., times..., balls)
            Unknown states have values of nan and the label -1: for invalid arguments, and after a
            shot was stopped or failed while balls were moving.

        Raises
        ------
        ValueError
            A time is negative or not finite; or a shot must be played again, but its layout or cue
            was changed in the meantime.
        """
        return self._look_at(times, dtypes.ball_state, (), threads)[0]

    def positions(self, times: ArrayLike, *, threads: int = 0) -> Doubles:
        """Return the centres of all balls of all shots at given times.

        Parameters and errors are as for `states`.

        Returns
        -------
        ndarray of float64, shape (batch..., times..., balls, 3)
            m.
        """
        return self._look_at(times, np.dtype(np.float64), (3,), threads)[0]

    def _look_at(
        self, times: ArrayLike, dtype: np.dtype[Any], numbers: tuple[int, ...], threads: int
    ) -> tuple[Array, NDArray[np.int8]]:
        """For `states` and `positions`: the array, and a code for each shot, in C order, which is
        negative if a state is unknown.
        """
        instants = _moments(times)
        order = np.argsort(instants.reshape(-1), kind="stable")
        ordered = instants.reshape(-1)[order]
        count = self.final.shape[-1]
        out: Array = np.empty((self.status.size, ordered.size, count, *numbers), dtype)
        seen = pointer("double[]" if numbers else "carom_ball_state[]", out)
        moments, row = (
            pointer("double[]", ordered),
            ordered.size * count * (numbers[0] if numbers else 1),
        )

        def look(job: Any, codes: Any, begin: int) -> int:
            states, positions = (
                (ffi.NULL, seen + begin * row) if numbers else (seen + begin * row, ffi.NULL)
            )
            return int(lib.carom_python_look(job, moments, ordered.size, states, positions, codes))

        codes = self._look(look, 5e-6 + 2e-8 * ordered.size * count, threads)
        if (np.diff(order) < 0).any():
            back = np.empty_like(order)
            back[order] = np.arange(len(order))
            out = out[:, back]
        return out.reshape((*self.shape, *instants.shape, count, *numbers)), codes

    def _look(
        self, look: Callable[[Any, Any, int], int], seconds: float, threads: int
    ) -> NDArray[np.int8]:
        """Call look(job, codes, first row) for all rows and return the codes.

        `seconds` is the time that one row takes.
        """
        whole(threads, "threads", least=-1)
        codes: NDArray[np.int8] = np.zeros(self.status.size, INT8)
        flags = pointer("int8_t[]", codes)
        job = self._jobs(shot_options(self.options))
        code = in_chunks(
            codes.size,
            seconds,
            threads,
            spread(threads, lambda begin, many: look(job(begin, many), flags + begin, begin)),
        )
        if code < 0:
            raise MemoryError("not enough memory for the events of a shot")
        if (codes == Status.ERROR_STATE).any():
            raise ValueError(
                "layouts, cues: changed since the shots were played, so the shots cannot be played again; "
                "simulate_batch(room=...) keeps their events instead"
            )
        return codes

    def _jobs(self, options: Any) -> Callable[[int, int], Any]:
        """A function that returns the carom_shot_job of `many` rows starting at `begin`."""
        lead, count = len(self.shape), self.final.shape[-1]
        layouts, one_layout = one_or_all(self.layouts, self.final.shape, lead)
        cues, one_cue = (
            (None, True) if self.cues is None else one_or_all(self.cues, self.shape, lead)
        )
        record, status = (
            np.ascontiguousarray(self.record).reshape(-1),
            np.ascontiguousarray(self.status).reshape(-1),
        )
        room = self.events.shape[-1]
        record["room"] = room
        if room > 0:
            record["events" if self.events.dtype == dtypes.event else "brief"] = addresses(
                self.events, lead
            )
        record["final"] = addresses(self.final, lead)
        record["facts"] = 0 if self._facts is None else addresses(self._facts, lead)
        table = pointer("carom_table[]", self.table.record)
        balls = pointer(
            "carom_shot_ball[]" if self.kinds is None else "carom_ball_state[]", layouts
        )
        kinds = ffi.NULL if self.kinds is None else pointer("carom_ball_kind[]", self.kinds)
        strikes = ffi.NULL if cues is None else pointer("carom_cue[]", cues)
        results, flags = pointer("carom_shot[]", record), pointer("int8_t[]", status)

        def job(begin: int, many: int) -> Any:
            pointers = {
                "table": table,
                "balls" if self.kinds is None else "states": balls
                if one_layout
                else balls + begin * count,
                "kinds": kinds,
                "cues": strikes if one_cue else strikes + begin,
                "count": count,
                "ball_stride": 0 if one_layout else count,
                "cue_stride": 0 if one_cue else 1,
                "n": many,
                "options": options,
                "shots": results + begin,
                "status": flags + begin,
            }
            return ffi.new("carom_shot_job *", pointers)

        return job

    def _columns(self) -> tuple[Array, list[str], dict[str, Array]]:
        """The shots as columns, one row per shot: status codes, their names, and the other columns."""
        count = self.final.shape[-1]
        found: dict[str, Array] = {"time": self.time.reshape(-1), "count": self.count.reshape(-1)}
        if self.cues is not None:
            cues = np.broadcast_to(self.cues, self.shape).reshape(-1)
            found |= {f"cue_{name}": column for name, column in dtypes.columns(cues).items()}
        final = self.final.reshape(-1, count)
        for k in range(count):
            found |= {
                f"ball_{k}_{name}": column for name, column in dtypes.columns(final[:, k]).items()
            }
        for name, values in vars(self.features).items() if self._facts is not None else ():
            parts = (
                [("", ())]
                if values.shape == self.shape
                else [(f"_{k}", (k,)) for k in range(values.shape[-1])]
            )
            found |= {
                f"{name}{suffix}": values[(..., *index)].reshape(-1) for suffix, index in parts
            }
        known = sorted(Status)
        return (
            np.searchsorted(known, self.status.reshape(-1)),
            [status.name.lower() for status in known],
            found,
        )

    def to_dataframe(self, dims: Sequence[str] | None = None, *, dt: float | None = None) -> Any:
        """Return the shots as a pandas DataFrame, one row per shot.

        The columns are status (by name), time, count, the fields of the cue (cue_speed, ...), the
        final state of each ball (ball_0_r_x, ...), and the features if they were computed
        (pocket_3, ...). Needs pandas.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the levels of the index, one per dimension of the batch. Default: "shot", or
            "shot_0", "shot_1", ...
        dt : float, optional
            With it there is one row per shot, time and ball instead, every `dt` seconds up to the
            end of the longest shot, with the states.
        """
        if dt is not None:
            return states_frame(self, dt, self._dims(dims))
        pandas, dims, (codes, names, found) = (
            needed("pandas", "to_dataframe()"),
            self._dims(dims),
            self._columns(),
        )
        columns = {"status": pandas.Categorical.from_codes(codes, names), **found}
        if len(self.shape) == 1:
            return pandas.DataFrame(columns, index=pandas.RangeIndex(len(codes), name=dims[0]))
        index = (
            pandas.MultiIndex.from_tuples(list(np.ndindex(self.shape)), names=dims)
            if self.shape
            else None
        )
        return pandas.DataFrame(columns, index=index)

    def to_arrow(self, first: int = 0) -> Any:
        """Return the shots as a pyarrow Table with the columns of `to_dataframe`.

        The first column, "shot", counts from `first`. The metadata of a field contains its unit as
        "units". Needs pyarrow.
        """
        arrow, (codes, names, found) = needed("pyarrow", "to_arrow()"), self._columns()
        status = arrow.DictionaryArray.from_arrays(codes.astype(np.int8), names)
        table = arrow.table(
            {"shot": np.arange(first, first + len(codes)), "status": status, **found}
        )
        fields_with_units = [field.with_metadata(_units(field.name)) for field in table.schema]
        return table.cast(arrow.schema(fields_with_units))

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The table of `to_arrow` for libraries that read Arrow, such as Polars."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def to_xarray(self, dims: Sequence[str] | None = None) -> Any:
        """Return the shots as an xarray Dataset.

        The variables are status, time, count, the fields of the cue (cue_speed, ...), the final r,
        v, w and label of each ball, and the features if they were computed. The attribute "units"
        contains the unit. Needs xarray.

        The dimensions are the dimensions of the batch, named as in `to_dataframe`, then "ball",
        "axis" (x, y, z) and, for first contacts, "met". A dimension named after a field of the cue
        that varies only along it has the field's values as coordinates; others have indices.
        """
        xarray, count, dims = (
            needed("xarray", "to_xarray()"),
            self.final.shape[-1],
            self._dims(dims),
        )
        found: dict[str, tuple[tuple[str, ...], Array]] = {
            "status": (dims, self.status),
            "time": (dims, self.time),
            "count": (dims, self.count),
        }
        if self.cues is not None:
            cues = np.broadcast_to(self.cues, self.shape)
            found |= {f"cue_{name}": (dims, cues[name]) for name in cues.dtype.names or ()}
        found |= {name: ((*dims, "ball", "axis"), self.final[name]) for name in "rvw"}
        found["label"] = (*dims, "ball"), self.final["label"]
        for name, values in vars(self.features).items() if self._facts is not None else ():
            last = (
                () if values.shape == self.shape else ("ball",) if name in _OF_BALLS else ("met",)
            )
            found[name] = (*dims, *last), values
        # the meanings of codes, as in the CF (climate and forecast) conventions
        codes: dict[str, type[enum.IntEnum]] = {"status": Status, "label": Label}
        attributes = {
            name: {
                "flag_values": [code.value for code in kind],
                "flag_meanings": " ".join(code.name.lower() for code in kind),
            }
            for name, kind in codes.items()
        }
        variables = {
            name: (
                names,
                np.array(values),
                {**attributes.get(name, {}), **_units(name)},
            )
            for name, (names, values) in found.items()
        }
        sizes = {
            **dict(zip(dims, self.shape)),
            "ball": count,
            **({} if self._facts is None else {"met": 2}),
        }
        along = {name: self._along(dims, name, size) for name, size in sizes.items()}
        coordinates: dict[str, Any] = {
            name: (name, values, _units(f"cue_{name}") if values.dtype == np.float64 else {})
            for name, values in along.items()
        }
        return xarray.Dataset(variables, {**coordinates, "axis": list("xyz")})

    def _along(self, dims: tuple[str, ...], name: str, size: int) -> Array:
        """The coordinates of a dimension: the cue's field of that name if it varies only along this
        dimension, otherwise indices.
        """
        if (
            name in dims
            and self.cues is not None
            and name in (dtypes.cue.names or ())
            and self.status.size
        ):
            values = np.moveaxis(
                np.broadcast_to(self.cues, self.shape)[name], dims.index(name), 0
            ).reshape(size, -1)
            if (values == values[:, :1]).all() and len(np.unique(values[:, 0])) == size:
                return values[:, 0]
        return np.arange(size)

    def _dims(self, dims: Sequence[str] | None) -> tuple[str, ...]:
        """The names of the dimensions of the batch."""
        if dims is None:
            return (
                ("shot",)
                if len(self.shape) == 1
                else tuple(f"shot_{k}" for k in range(len(self.shape)))
            )
        names = tuple(map(str, several(dims, "dims", "a name for each dimension of the batch")))
        if len(names) != len(self.shape) or len({*names, "ball", "axis", "met"}) != len(names) + 3:
            raise ValueError(
                f"dims: {names} are not {len(self.shape)} different names other than ball, axis and met"
            )
        return names

    def failures(self) -> list[tuple[tuple[int, ...], str]]:
        """Return the index and the error of each failed shot."""
        return [
            (index, str(self.error(index)))
            for index in (tuple(int(k) for k in row) for row in np.argwhere(self.status < 0))
        ]

    def error(self, index: Any) -> CaromError:
        """Return the exception for a failed shot, which names an invalid argument."""
        shot = self[index]
        error = argument_error(
            shot_arguments(self.table, shot.balls, shot.cue, shot_options(self.options)),
            shot.balls,
            shot.cue,
        )
        return (
            error if error is not None and error.status == shot.status else CaromError(shot.status)
        )

    def __repr__(self) -> str:
        return f"<carom.Shots: {self.shape}, {int((self.status < 0).sum())} in error>"
