"""Shots, from the strike of the cue until nothing moves: single ones and batches."""

from __future__ import annotations

import contextlib
import copy
import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._faults import argument_error, shot_arguments
from carom._rows import (
    INT8,
    Array,
    apart,
    broadcast,
    choice,
    copied,
    frozen,
    in_chunks,
    needed,
    number,
    output,
    pointer,
    whole,
)
from carom._shot_options import Options, StopAt, chosen, shot_options
from carom.dtypes import Records
from carom.layouts import Table, check_table, doubt_balls, of_record, one_cue
from carom.results import UNKNOWN, Shot, Shots
from carom.status import CaromError, Status

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes

_USUAL = Options()
_FIRST_ROOM = 512
# Memory for _FIRST_ROOM events, which a call of `simulate` leaves to the next: allocating it takes a
# third of the time of a soft shot. Concurrent calls allocate their own.
_spare: list[Array] = []
_NO_EVENTS: Array = np.zeros(0, dtypes.event)


def cite(*, options: Options = _USUAL, **changes: Unpack[Changes]) -> str:
    """Return the works to cite for shots with these options, as BibTeX.

    They are carom and the sources of the models in use.

    Parameters
    ----------
    options, **changes
        As for `simulate`: `carom.cite(cushion_model="mathavan")`.

    Returns
    -------
    str
    """
    record = shot_options(chosen(options, changes))
    room = lib.carom_cite(record, ffi.NULL, 0) + 1
    text = ffi.new("char[]", room)
    lib.carom_cite(record, text, room)
    return bytes(ffi.string(text)).decode()


def simulate(
    table: Table,
    balls: Records,
    cue: Records | None = None,
    *,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Shot:
    """Play a shot until nothing moves.

    Parameters
    ----------
    table : Table
        A table, such as `carom.tables.pool_9ft()`.
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        1 to 32 balls from `carom.racks` or `carom.balls`. The array is not modified.
    cue : ndarray of `carom.dtypes.cue`, shape (), optional
        A cue from `carom.cue`. There is no strike without a cue, with speed 0, or if a ball already
        moves.
    options : Options
        Models, limits, and when to stop; see `carom.Options`.
    **changes
        Single options by name: cushion_model="mathavan", t_final=1.5, stop_at="contact",
        space="flat", ...

    Returns
    -------
    Shot

    Raises
    ------
    CaromError
        An argument is invalid, or the shot failed: it reached a limit, a ball left the table, or a
        collision could not be resolved. After a failure the error's `shot` contains the shot up to
        that point.
    """
    check_table(table)
    layout = of_record(balls, dtypes.shot_ball, "balls", "balls()")
    if layout.ndim != 1:
        raise ValueError(
            f"balls: the shape is {layout.shape}, but must be (balls,); simulate_batch() accepts several layouts"
        )
    layout = frozen(layout)
    cue = None if cue is None else frozen(one_cue(cue))
    models = chosen(options, changes)
    doubt_balls(table, layout["kind"], models.cushion_model)
    if models.first_of != ():
        _check_first_of(models, len(layout), cue)
    state = (
        np.zeros(ffi.sizeof("carom_shot_state") // 8, np.uint64)
        if models.t_final is not None or models.stop_at
        else None
    )
    arguments = shot_arguments(table, layout, cue, shot_options(models))
    if (error := argument_error(arguments, layout, cue)) is not None:
        raise error
    begun = Shot(table, layout, Status.OK, 0.0, 0, _NO_EVENTS, layout["state"], cue, models, state)
    return _run(begun, lambda shot: lib.carom_shoot(*arguments, shot))


def replayed(table: Table, balls: Records, cue: Records, options: Options, match: Any) -> Shot:
    """The last shot of a match in C, as far as it was played."""
    layout = frozen(balls)
    begun = Shot(table, layout, Status.OK, 0.0, 0, _NO_EVENTS, layout["state"], cue, options, None)
    shot = _run(begun, lambda shot: lib.carom_match_replay(match, shot))
    if shot.status > 0:
        state = ffi.buffer(ffi.addressof(match.record, "state"))
        shot.state = np.frombuffer(state, np.uint64).copy()
    return shot


def _check_first_of(options: Options, balls: int, cues: Records | None) -> None:
    """Raise an error for an index without a ball, or of the cue ball, which cannot hit itself."""
    struck = {0} if cues is None else set(np.unique(cues["ball"]).tolist())
    for ball in (options.first_of,) if isinstance(options.first_of, int) else options.first_of:
        if ball in struck or whole(ball, "first_of") >= balls:
            raise ValueError(
                f"first_of: ball {ball} is the cue ball; pass balls that it can hit"
                if ball in struck
                else f"first_of: there is no ball {ball}; the layout has balls 0 to {balls - 1}"
            )


def _room(events: int) -> Array:
    """Memory for this number of events."""
    if events == _FIRST_ROOM:
        with contextlib.suppress(IndexError):
            return _spare.pop()
    return np.empty(events, dtypes.event)


def _run(begun: Shot, play: Callable[[Any], int]) -> Shot:
    """Play or continue a shot in C.

    A shot with more events than the memory holds is played again with enough memory; its bits are
    the same.
    """
    room = max(_FIRST_ROOM, 2 * begun.count)
    while True:
        events = _room(room)
        if begun.count:
            events[: begun.count] = begun.events
        final = copied(begun.final)
        state = None if begun.state is None else begun.state.copy()
        pointers = {
            "events": pointer("carom_event[]", events),
            "room": room,
            "count": begun.count,
            "time": begun.time,
            "final": pointer("carom_ball_state[]", final),
            "state": ffi.NULL
            if state is None
            else ffi.cast("carom_shot_state *", pointer("uint64_t[]", state)),
        }
        shot = ffi.new("carom_shot *", pointers)
        code = play(shot)
        if shot.count <= room:
            break
        room = shot.count
    begun.status, begun.time, begun.count = Status(code), shot.time, shot.count
    begun.events, begun.final, begun.state = frozen(events[: shot.count]), final, state
    if room == _FIRST_ROOM:
        _spare.append(events)
    if code < 0:
        raise CaromError(code, shot=begun)
    return begun


def resume(
    shot: Shot, *, t_final: float | None = None, stop_at: StopAt | Iterable[StopAt] = ()
) -> Shot:
    """Continue a shot that was stopped at a time or an event.

    Parameters
    ----------
    shot : Shot
        A result of `simulate` or `resume` with `t_final` or `stop_at`. It is not modified.
    t_final : float, optional
        When to stop again, s from the beginning of the shot.
    stop_at : str or iterable of str
        Events at which to stop again, as for `simulate`.

    Returns
    -------
    Shot
        With all events from the beginning; events and states have the bits of the uninterrupted
        shot.

    Raises
    ------
    CaromError
        The shot fails.
    ValueError
        The shot was played without `t_final` and `stop_at`, or in a batch; or t_final is before the
        time at which it stopped.
    """
    if not isinstance(shot, Shot) or shot.state is None:
        raise ValueError(
            "shot: this shot cannot be resumed; pass a result of simulate() or resume() with t_final= or stop_at="
        )
    if t_final is not None and number(t_final, "t_final", "a time in s or None") < shot.time:
        raise ValueError(f"t_final: {t_final} s is before {shot.time} s, when the shot stopped")
    begun = copy.copy(shot)
    begun.options = shot.options.changed({"t_final": t_final, "stop_at": stop_at})
    table, balls, options = (
        pointer("carom_table[]", shot.table.record),
        pointer("carom_shot_ball[]", shot.balls),
        shot_options(begun.options),
    )
    return _run(
        begun, lambda job: lib.carom_shot_continue(table, balls, len(shot.balls), options, job)
    )


def simulate_batch(
    table: Table,
    layouts: Records,
    cues: Records | None = None,
    *,
    room: int = 0,
    kinds: Records | None = None,
    records: Literal["full", "brief"] = "full",
    features: bool = False,
    threads: int = 0,
    out: Shots | None = None,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Shots:
    """Play many shots.

    Parameters
    ----------
    table : Table
        The table of all shots.
    layouts : ndarray of `carom.dtypes.shot_ball`, shape (..., balls)
        The balls before each shot.
    cues : ndarray of `carom.dtypes.cue`, shape (...), optional
        The strikes, broadcast against the leading dimensions of the layouts: one layout and many
        cues, or the reverse. None: no strikes.
    room : int
        Number of events kept per shot; 0 keeps only the final states.
    kinds : ndarray of `carom.dtypes.ball_kind`, shape (balls,) or (), optional
        The properties that all layouts share. Then `layouts` is an array of
        `carom.dtypes.ball_state`, with 80 bytes per ball instead of 328.
    records : {"full", "brief"}
        The form of the events: "full" (`carom.dtypes.event`, 352 bytes each), or "brief" with time,
        type and participants (`carom.dtypes.brief_event`, 24 bytes).
    features : bool
        Whether to compute `Shots.features`: first contacts, cushions and pockets.
    threads : int
        Largest number of threads: 0 uses only the calling thread, -1 all processors. Results do not
        depend on it.
    out : Shots, optional
        An earlier result with the same shape, balls and room, whose memory is reused.
    options, **changes
        As for `simulate`.

    Returns
    -------
    Shots
        Each shot has the bits of `simulate`. Failed shots do not affect the others; see `status`
        and `failures()`.

    Raises
    ------
    CaromError
        The table or an option is invalid.
    """
    record, builder = (
        (dtypes.shot_ball, "balls(), or pass kinds= with states")
        if kinds is None
        else (dtypes.ball_state, 'balls()["state"], as kinds= is given')
    )
    all_balls = of_record(layouts, record, "layouts", builder)
    all_cues = (
        np.zeros((), dtypes.cue) if cues is None else of_record(cues, dtypes.cue, "cues", "cue()")
    )
    if all_balls.ndim == 0:
        raise ValueError("layouts: the shape is (), but must be (..., balls)")
    check_table(table)
    room = whole(room, "room")
    count = all_balls.shape[-1]
    if kinds is not None:
        kinds = of_record(kinds, dtypes.ball_kind, "kinds", 'balls()["kind"]')
        if kinds.shape not in ((), (1,), (count,)):
            raise ValueError(
                f"kinds: the shape is {kinds.shape}, but must be () or ({count},), one kind for each ball of the layouts"
            )
        kinds = np.ascontiguousarray(np.broadcast_to(kinds, (count,)))
    shape = broadcast({"layouts": all_balls.shape[:-1], "cues": all_cues.shape})
    # A single layout or cue for all shots is not copied; other broadcast arrays are.
    if all_balls.size != count:
        all_balls = np.ascontiguousarray(np.broadcast_to(all_balls, (*shape, count)))
    if all_cues.size != 1:
        all_cues = np.ascontiguousarray(np.broadcast_to(all_cues, shape))
    event = (dtypes.event, dtypes.brief_event)[choice({"full": 0, "brief": 1}, records, "records")]
    models = chosen(options, changes)
    of_c = shot_options(models, threads)
    doubt_balls(table, kinds if kinds is not None else all_balls["kind"], models.cushion_model)
    if models.first_of != ():
        _check_first_of(models, count, cues)
    if out is not None and not isinstance(out, Shots):
        raise TypeError(f"out: {type(out).__name__} is not an earlier result of simulate_batch()")
    shots = Shots(table, all_balls, shape, room, event) if out is None else out
    if out is not None:
        outputs = {"status": (shape, INT8), "final": ((*shape, count), dtypes.ball_state)}
        outputs |= {"events": ((*shape, room), event), "record": (shape, dtypes.shot)}
        written = tuple(
            (f"out.{name}", output(getattr(out, name), *form, f"out.{name}"))
            for name, form in outputs.items()
        )
        inputs = (("layouts", all_balls), ("cues", all_cues), ("table", table.record))
        apart(inputs if kinds is None else (*inputs, ("kinds", kinds)), written)
        out.table, out.layouts = table, all_balls
        out.record["time"], out.record["count"] = 0.0, 0
        out.status[...] = Status.OK
    shots.kinds = kinds
    shots.cues, shots.options = None if cues is None else all_cues, models
    shots._facts = np.zeros(shape, dtypes.facts) if features else None
    job = shots._jobs(of_c)
    code = in_chunks(
        shots.status.size,
        5e-5,
        threads,
        lambda begin, many: int(lib.carom_shoot_batch(job(begin, many))),
    )
    if code < 0 and not (shots.status < 0).any():
        raise (
            CaromError(code, "layouts", count)
            if code == Status.ERROR_BALLS
            else CaromError(code, "table")
        )
    if code < 0:
        shots.final[shots.refused] = UNKNOWN
    return shots


def simulate_arrow(
    table: Table,
    layouts: Records,
    cues: Records | Iterator[Records] | None = None,
    *,
    at_once: int = 10_000,
    **more: Any,
) -> Any:
    """Play any number of shots in constant memory, in parts that are played as they are read.

    Parameters
    ----------
    table, layouts, **more
        As for `simulate_batch`. Events are not kept.
    cues : ndarray of `carom.dtypes.cue`, or an iterator of such arrays
        Only one array of an iterator, such as a generator, is in memory at a time.
    at_once : int
        Number of shots in a part.

    Returns
    -------
    pyarrow.RecordBatchReader
        One row per shot, in C order, with the columns of `Shots.to_arrow`.
        `pyarrow.dataset.write_dataset` can write it as Parquet.
    """
    arrow, at_once = needed("pyarrow", "simulate_arrow()"), whole(at_once, "at_once", least=1)
    all_balls = of_record(
        layouts, dtypes.ball_state if "kinds" in more else dtypes.shot_ball, "layouts", "balls()"
    )

    def played() -> Iterator[Any]:
        first = 0
        for part in cues if isinstance(cues, Iterator) else [cues]:
            struck = part if part is None else of_record(part, dtypes.cue, "cues", "cue()")
            shape = broadcast(
                {"layouts": all_balls.shape[:-1], "cues": () if struck is None else struck.shape}
            ) or (1,)
            for begin in range(0, max(math.prod(shape), 1), at_once):
                where = np.unravel_index(
                    np.arange(begin, min(begin + at_once, math.prod(shape))), shape
                )
                balls = (
                    all_balls
                    if all_balls.ndim == 1
                    else np.broadcast_to(all_balls, (*shape, all_balls.shape[-1]))[where]
                )
                strikes = (
                    struck
                    if struck is None or struck.ndim == 0
                    else np.broadcast_to(struck, shape)[where]
                )
                shots = simulate_batch(table, balls, strikes, **more)
                yield shots.to_arrow(first)
                first += shots.status.size

    parts = played()
    begun = next(parts, None)
    if begun is None:
        raise ValueError("cues: the iterator is empty; it must yield at least one array of cues")
    batches = (batch for part in itertools.chain([begun], parts) for batch in part.to_batches())
    return arrow.RecordBatchReader.from_batches(begun.schema, batches)
