"""What shots give: one, and many."""

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
from carom.layouts import Table
from carom.pictures import Animation
from carom.status import CaromError, Status


def _moments(times: ArrayLike) -> Doubles:
    moments = np.asarray(as_array(times, "times", np.float64), order="C")
    wrong = moments[~((moments >= 0.0) & (moments < np.inf))]
    if wrong.size:
        raise ValueError(
            f"times: each must be a finite number of seconds from the beginning of the shot, not {wrong.flat[0]}"
        )
    return moments


def _states_at(balls: Any, count: int, shot: Any, times: Any, n: int, states: Any) -> int:
    return int(lib.carom_shot_frames(balls, count, shot, times, n, ffi.NULL, states, ffi.NULL))


def _picker(index: Any, shape: tuple[int, ...]) -> Callable[[Array], Array]:
    """Takes the shots that an index chooses out of any array of a batch.

    The index is resolved against the shape of the batch alone, as NumPy resolves it on an array of
    that shape; what an array has in further dimensions stays whole. Integers, slices, None and
    Ellipsis give views, as in NumPy; other indices give copies.
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
    # which shots are chosen, as coordinates: an array that is broadcast is not copied for them
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
class Shot:
    """One shot.

    The table, the balls, the cue and the events cannot be written to, because later calls, such as
    `positions`, `carom.resume` and `carom.tangents`, read them. Copies can.

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
        In the order in which they happened. Of a batch with records="brief":
        `carom.dtypes.brief_event`.
    final : ndarray of `carom.dtypes.ball_state`, shape (balls,)
    cue : ndarray of `carom.dtypes.cue`, shape (), or None
    options : Options
        By what the shot was played.
    state
        What `carom.resume` needs; None where the shot was not to be stopped.
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
        """The states of all balls at any times, s: an ndarray of `carom.dtypes.ball_state`, shape
        (shape of the times..., balls).

        After the end they are as at the end, where nothing moves any more. With `drawn` a pocketed
        ball falls in its pocket until it lies at the depth or on others, and stays there; a shot of
        a batch then needs all its events: `simulate_batch(room=...)`.

        Raises
        ------
        CaromError
            A time is after the end of a shot that was stopped, or that ended in an error, while
            balls moved.
        ValueError
            A time is before 0, or not finite.
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
        """Calls look(balls, count, shot, times, n, out), in chunks of the times."""
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
        """How each ball has turned since the start of the shot, for drawing it: float64 of shape
        (..., balls, 4).

        These are unit quaternions (w, x, y, z), which take what is painted on a ball at the start
        to where it is then. Times and errors are those of `states`.
        """
        moments = _moments(times)
        turned: Doubles = np.zeros((*moments.shape, len(self.balls), 4))
        self._at(moments, turned, 4, "double[]", lib.carom_python_orientations)
        return turned

    @property
    def slips(self) -> Doubles:
        """How fast surfaces pass each other in each event, m/s: with `impulse` it says how a
        contact sounds. 0 where nothing touches.
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
        """The centres of all balls at any times: float64 of shape (..., balls, 3), m.

        Times and errors are those of `states`.
        """
        return np.asarray(self.states(times)["r"], dtype=np.float64)

    def to_dataframe(self) -> Any:
        """The events as a pandas DataFrame, a row an event: time, type (by name), a, b,
        before_a_r_x and so on. Where there is no second ball, the numbers of one are nan, and its
        labels -1.

        Needs pandas. `carom.dtypes.columns` makes columns of any records.
        """
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
        """The table and the paths, drawn on axes of matplotlib, in metres; the axes are returned.

        Balls are faint where they began and full where they ended. Needs matplotlib; `ax` is by
        default the current axes.
        """
        return pictures.plot(self.table, self, ax)

    def animate(self, speed: float = 1.0) -> Animation:
        """A moving picture, for Jupyter or a file: `speed` 1 is that of the shot, and `svg` is the
        text, which moves in any browser.
        """
        return pictures.animation(self, speed)


class _OfBatch(Shot):
    """A shot of a batch: its attributes are made when they are first used."""

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
    """What planners want of shots, besides `Shots.final`: arrays of the shape of the batch.

    contact, contact_time: (..., 2), the first and the second of the different balls that the cue
    ball met; when, s cushions_before: (..., 2), impacts of the cue ball on cushions before each of
    them; 0 without a contact cushions_after: (...), impacts on cushions, of all balls, after the
    first contact pocket, pocket_time: (..., balls), the pocket that took each ball, by its index in
    `table.pockets`; when, s cushions: (..., balls), impacts of each ball on cushions

    Indices are -1 and times inf where there is none. The cue ball is the ball struck, or ball 0
    without a cue. A cushion is a rail or its rounded end.
    """

    contact: NDArray[np.int32]
    contact_time: Doubles
    cushions_before: NDArray[np.int32]
    cushions_after: NDArray[np.int32]
    pocket: NDArray[np.int32]
    pocket_time: Doubles
    cushions: NDArray[np.int32]

    def __getitem__(self, index: Any) -> Features:
        """Those of some shots: the index is that of `Shots`."""
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
    """The unit of a column or variable, as attributes have it: of ball_0_r_x that of r."""
    *front, last = re.sub(r"^ball_\d+_", "", name).split("_")
    base = (
        "_".join(front)
        if front and (last.isdecimal() or last in "xyz")
        else "_".join([*front, last])
    )
    return {"units": _UNITS[base]} if base in _UNITS else {}


_OF_BALLS = {"pocket", "pocket_time", "cushions"}


class Shots:
    """Many shots: arrays of the shape of the batch.

    A batch is indexed, iterated and measured by `len` as its array `status` is. Where NumPy gives a
    number, a batch gives a `Shot`, whose attributes are made when they are first used; where NumPy
    gives an array, a batch gives `Shots`. Slices are views; masks and arrays of indices make copies.
    `flat` gives every shot, in C order.

    Attributes
    ----------
    table, options
        As of a `Shot`.
    layouts : ndarray of `carom.dtypes.shot_ball`, shape (..., balls) or (1, balls); or of
        `carom.dtypes.ball_state`, beside
    kinds : ndarray of `carom.dtypes.ball_kind`, shape (balls,), or None
    cues : ndarray of `carom.dtypes.cue`, shape (...) or one, or None
    status : ndarray of int8, shape (...)
        As `Status`; a shot in error costs itself alone.
    time, count : ndarrays of float64 and int64, shape (...)
        Time of the last event, or when the shot was stopped, s; events that happened, also beyond
        the room.
    final : ndarray of `carom.dtypes.ball_state`, shape (..., balls)
        Where an argument was in error, all numbers are nan and labels -1, as in `states`.
    events : ndarray of `carom.dtypes.event` or `carom.dtypes.brief_event`, shape (..., room)
        The first count of each row are valid.
    features : Features
        With `simulate_batch(features=True)`; without there is no such attribute.
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
        """When the last event happened, s: a view, which cannot be written to."""
        return sealed(self.record["time"])

    @property
    def count(self) -> NDArray[np.int64]:
        """Events that happened: a view, which cannot be written to."""
        return sealed(self.record["count"])

    @property
    def refused(self) -> NDArray[np.bool_]:
        """Which shots were not played, as an argument was in error."""
        return np.asarray((self.status < 0) & (self.count == 0) & (self.time == 0.0))

    @property
    def features(self) -> Features:
        """What planners want of the shots, where `simulate_batch(features=True)` was asked for it."""
        if self._facts is None:
            raise AttributeError(
                "features: simulate_batch(features=True) tells them; these shots were played without"
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
        """How many dimensions the batch has."""
        return self.status.ndim

    @property
    def size(self) -> int:
        """How many shots the batch has."""
        return self.status.size

    def __len__(self) -> int:
        return len(self.status)

    def __iter__(self) -> Iterator[Any]:
        """The parts `shots[0]`, `shots[1]` and so on, each a `Shot` in a batch of one dimension."""
        if not self.shape:
            raise TypeError("iteration over a batch of shape (), which is one shot: shots[()]")
        return (self[k] for k in range(len(self)))

    @property
    def flat(self) -> Iterator[Shot]:
        """Every shot, in C order."""
        return (_OfBatch(self, index) for index in np.ndindex(self.shape))

    @overload
    def __getitem__(self, index: tuple[int, ...]) -> Shot: ...
    @overload
    def __getitem__(self, index: slice | NDArray[Any] | list[Any]) -> Shots: ...
    @overload
    def __getitem__(self, index: Any) -> Any: ...
    def __getitem__(self, index: Any) -> Any:
        """One shot of the batch, or some, as NumPy indexes `status`."""
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
        # one layout or one cue for all stays one
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
        """The states of all balls of all shots at any times, s: an ndarray of
        `carom.dtypes.ball_state`, shape (batch..., times..., balls).

        After the end they are as at the end, where nothing moves any more. Shots of which not all
        events were kept are played again, which takes the time of playing them. Numbers are nan,
        and the label -1, where no state is known: of shots whose arguments were in error, and after
        shots were stopped, or ended in an error, while balls moved. No bit depends on `threads`.

        Raises
        ------
        ValueError
            A time is before 0, or not finite; or a shot has to be played again, and its layout or
            cue has been changed since.
        """
        return self._look_at(times, dtypes.ball_state, (), threads)[0]

    def positions(self, times: ArrayLike, *, threads: int = 0) -> Doubles:
        """The centres of all balls of all shots at any times: float64 of shape (batch..., times...,
        balls, 3), m.

        Parameters and errors are those of `states`.
        """
        return self._look_at(times, np.dtype(np.float64), (3,), threads)[0]

    def _look_at(
        self, times: ArrayLike, dtype: np.dtype[Any], numbers: tuple[int, ...], threads: int
    ) -> tuple[Array, NDArray[np.int8]]:
        """For `states` and `positions`: the array, and of each shot, in C order, whether some of it
        is unknown.
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
        """Calls look(job, codes, first row) for all rows, which take so many seconds each; the
        codes.
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
            raise MemoryError("no memory for the events of a shot")
        if (codes == Status.ERROR_STATE).any():
            raise ValueError(
                "layouts, cues: they were changed after the shots were played, so they cannot be played again; "
                "simulate_batch(room=...) keeps all events of shots of up to so many"
            )
        return codes

    def _jobs(self, options: Any) -> Callable[[int, int], Any]:
        """A function that gives the carom_shot_job of `many` rows from `begin` on."""
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
        """The shots as columns, a row a shot: statuses, what each is called, and the other columns
        by their names.
        """
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

    def to_dataframe(self, dims: Sequence[str] | None = None) -> Any:
        """The shots as a pandas DataFrame, a row a shot: status (by name), time, count, cue_speed
        and what else the cue has, ball_0_r_x and what else is known of each ball at the end, and
        the features where they were asked for, such as pocket_3.

        Needs pandas. The index is that of the batch; `dims` names its levels, which are else
        "shot", or "shot_0", "shot_1" and so on.
        """
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
        """The shots as a pyarrow Table with the columns of `to_dataframe`, after "shot", which
        counts from `first` on. The metadata of a field has its unit under "units", where it has
        one. Needs pyarrow.
        """
        arrow, (codes, names, found) = needed("pyarrow", "to_arrow()"), self._columns()
        status = arrow.DictionaryArray.from_arrays(codes.astype(np.int8), names)
        table = arrow.table(
            {"shot": np.arange(first, first + len(codes)), "status": status, **found}
        )
        fields_with_units = [field.with_metadata(_units(field.name)) for field in table.schema]
        return table.cast(arrow.schema(fields_with_units))

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """What libraries read that know Arrow, such as Polars: the table of `to_arrow`."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def to_xarray(self, dims: Sequence[str] | None = None) -> Any:
        """The shots as an xarray Dataset: status, time, count, cue_speed and what else the cue has;
        r, v, w and label of each ball at the end; and the features where they were asked for.
        Numbers that have a unit tell it by the attribute "units".

        Needs xarray. The dimensions are those of the batch, named as in `to_dataframe`, "ball",
        "axis" (x, y, z) and, of first contacts, "met"; each has coordinates: those of `dims` that
        are named as a field of the cue, which changes along it alone, have its values.
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
        # what codes mean, as the conventions of climate and forecast say it
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
        """The coordinates of a dimension: the cue's field of its name, where that changes along it
        alone, or else indices.
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
        names = tuple(
            map(str, several(dims, "dims", "a name for each dimension of the batch is needed"))
        )
        if len(names) != len(self.shape) or len({*names, "ball", "axis", "met"}) != len(names) + 3:
            raise ValueError(
                f"dims: {len(self.shape)} different names are needed, other than ball, axis and met, not {names}"
            )
        return names

    def failures(self) -> list[tuple[tuple[int, ...], str]]:
        """The index of each shot that ended in an error, and the error."""
        return [
            (index, str(self.error(index)))
            for index in (tuple(int(k) for k in row) for row in np.argwhere(self.status < 0))
        ]

    def error(self, index: Any) -> CaromError:
        """The exception for a shot that ended in an error, with the argument at fault if it was
        refused.
        """
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
