"""Whole shots, from the strike of a cue until nothing moves: one, and many."""

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
# Memory for _FIRST_ROOM events, which a call of `simulate` leaves to the next: getting it from the
# system takes a third of the time of a light shot. Calls at the same time each take their own.
_spare: list[Array] = []
_NO_EVENTS: Array = np.zeros(0, dtypes.event)


def cite(*, options: Options = _USUAL, **changes: Unpack[Changes]) -> str:
    """What to cite for shots by these options, as BibTeX: carom, and the sources of the models that
    they use.

    Parameters
    ----------
    options, **changes
        As for `simulate`: `carom.cite(cushion_model="mathavan")`.
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
        `carom.tables` has the standard ones.
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        1 to 32 of them, from `carom.racks` or `carom.balls`. Not changed.
    cue : ndarray of `carom.dtypes.cue`, shape (), optional
        From `carom.cue`. Without it, with speed 0, or if a ball moves already, there is no strike.
    options : Options
        Models, bounds and when to stop: see `carom.Options`.
    **changes
        Single options, by their names: cushion_model="mathavan", t_final=1.5, stop_at="contact",
        space="flat", ...

    Returns
    -------
    Shot

    Raises
    ------
    CaromError
        An argument is in error; or the shot ended in one (a bound, a ball that left the table, a
        collision): then the error's `shot` has what had happened.
    """
    layout = of_record(balls, dtypes.shot_ball, "balls", "balls()")
    if layout.ndim != 1:
        raise ValueError(
            f"balls: the shape must be (balls,), not {layout.shape}; simulate_batch plays many layouts"
        )
    check_table(table)
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
    """The last shot of a match of C, as far as it was played."""
    layout = frozen(balls)
    begun = Shot(table, layout, Status.OK, 0.0, 0, _NO_EVENTS, layout["state"], cue, options, None)
    shot = _run(begun, lambda shot: lib.carom_match_replay(match, shot))
    if shot.status > 0:
        state = ffi.buffer(ffi.addressof(match.record, "state"))
        shot.state = np.frombuffer(state, np.uint64).copy()
    return shot


def _check_first_of(options: Options, balls: int, cues: Records | None) -> None:
    """Refuses indices of no ball, and of the cue ball, which does not meet itself."""
    struck = {0} if cues is None else set(np.unique(cues["ball"]).tolist())
    for ball in (options.first_of,) if isinstance(options.first_of, int) else options.first_of:
        if ball in struck or whole(ball, "first_of") >= balls:
            raise ValueError(
                f"first_of: ball {ball} is {'the cue ball' if ball in struck else f'none of {balls}'}: it must be one that the cue ball meets"
            )


def _room(events: int) -> Array:
    """Memory for so many events."""
    if events == _FIRST_ROOM:
        with contextlib.suppress(IndexError):
            return _spare.pop()
    return np.empty(events, dtypes.event)


def _run(begun: Shot, play: Callable[[Any], int]) -> Shot:
    """The shot that has begun, as C plays it from its beginning, or goes on with it.

    One that has more events than there is room for is played again with enough of it: it has the
    same bits.
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
    """Go on with a shot that was stopped at a time or an event, as if it had not been.

    The shot, of `simulate` or `resume` with `t_final` or `stop_at`, is not changed. These say when
    to stop again; t_final counts from the beginning of the shot. The result has all events from the
    beginning, and events and states have the bits of the unbroken shot.

    Raises
    ------
    CaromError
        The shot ends in an error.
    ValueError
        The shot was played without `t_final` and `stop_at`, or as one of a batch; or t_final is
        before the time at which it stopped.
    """
    if not isinstance(shot, Shot) or shot.state is None:
        raise ValueError(
            "shot: only what simulate() or resume() stopped, with t_final= or stop_at=, can be gone on with"
        )
    if (
        t_final is not None
        and number(t_final, "t_final", "a time in s is needed, or None") < shot.time
    ):
        raise ValueError(
            f"t_final: it must not be before {shot.time} s, when the shot stopped, but is {t_final}"
        )
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
        Of all shots.
    layouts : ndarray of `carom.dtypes.shot_ball`, shape (..., balls)
    kinds : ndarray of `carom.dtypes.ball_kind`, shape (balls,) or (), optional
        What all layouts have in common: then `layouts` is of `carom.dtypes.ball_state`, 80 bytes a
        ball instead of 288.
    cues : ndarray of `carom.dtypes.cue`, shape (...), optional
        None: no strikes. Broadcast against the leading dimensions of the layouts: one layout and
        many cues, or the reverse.
    room : int
        How many events of each shot are kept; 0: final states only.
    records : {"full", "brief"}
        What is kept of an event: all (`carom.dtypes.event`, 352 bytes), or time, type and who
        (`carom.dtypes.brief_event`, 24 bytes).
    features : bool
        Whether `shots.features` tells first contacts, cushions and pockets.
    threads : int
        Most threads to use; 0 is the calling one alone, -1 all processors. No bit depends on it.
    out : Shots, optional
        An earlier result of the same shape, balls and room, whose memory is used again.
    options, **changes
        As for `simulate`.

    Returns
    -------
    Shots
        Each with the bits of `simulate`. One in error costs itself: see `status` and `failures()`.

    Raises
    ------
    CaromError
        The table or an option is in error.
    """
    record, builder = (
        (dtypes.shot_ball, "balls(), or kinds= beside states,")
        if kinds is None
        else (dtypes.ball_state, 'balls()["state"], beside kinds,')
    )
    all_balls = of_record(layouts, record, "layouts", builder)
    all_cues = (
        np.zeros((), dtypes.cue) if cues is None else of_record(cues, dtypes.cue, "cues", "cue()")
    )
    if all_balls.ndim == 0:
        raise ValueError("layouts: the shape must be (..., balls), not ()")
    check_table(table)
    room = whole(room, "room")
    count = all_balls.shape[-1]
    if kinds is not None:
        kinds = of_record(kinds, dtypes.ball_kind, "kinds", 'balls()["kind"]')
        if kinds.shape not in ((), (1,), (count,)):
            raise ValueError(
                f"kinds: the shape must be () or ({count},), a kind for each ball of the layouts, not {kinds.shape}"
            )
        kinds = np.ascontiguousarray(np.broadcast_to(kinds, (count,)))
    shape = broadcast({"layouts": all_balls.shape[:-1], "cues": all_cues.shape})
    # One layout or one cue for all is not copied; what else is broadcast is.
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
        raise TypeError(
            f"out: an earlier result of simulate_batch is needed, not {type(out).__name__}"
        )
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
    """Play as many shots as one likes, a part of them at a time, as they are read, so that memory
    does not grow with them.

    Parameters
    ----------
    table, layouts, **more
        As for `simulate_batch`. Events are not kept.
    cues : ndarray of `carom.dtypes.cue`, or an iterator of them
        Of an iterator, such as a generator that draws cues, no two arrays need be in memory
        together.
    at_once : int
        Shots of a part.

    Returns
    -------
    pyarrow.RecordBatchReader
        A row a shot, in C order, as of `Shots.to_arrow`. `pyarrow.dataset.write_dataset` writes it
        as Parquet.
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
        raise ValueError("cues: the iterator gave none")
    batches = (batch for part in itertools.chain([begun], parts) for batch in part.to_batches())
    return arrow.RecordBatchReader.from_batches(begun.schema, batches)
