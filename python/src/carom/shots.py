"""Whole shots, from the strike of a cue until nothing moves: one, and many."""

from __future__ import annotations

import functools
from typing import Any, Literal

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import INT8, Array, apart, as_array, choice, in_chunks, output, pointer, whole
from carom.layouts import Table, cue_error
from carom.results import Shot, Shots
from carom.status import CaromError, Status

World = Literal["carom", "pooltool"]
BallModel = Literal["default", "exact", "euler", "inelastic", "mirror"]
ShotCushion = Literal["default", "mathavan", "stronge", "han", "mirror", "euler"]
Friction = Literal["alciatore", "constant"]
Space = Literal["3d", "flat"]
_WORLDS = {"carom": 0, "pooltool": 1}
_BALL_MODELS = {"default": 0, "exact": 1, "euler": 2, "inelastic": 3, "mirror": 4}
_CUSHIONS = {"default": 0, "mathavan": 1, "stronge": 2, "han": 3, "mirror": 4, "euler": 5}
_FRICTIONS = {"alciatore": 0, "constant": 1}
_SPACES = {"3d": 0, "flat": 1}
_FIRST_ROOM = 512


@functools.lru_cache(maxsize=256)
def shot_options(
    world: str,
    ball_model: str,
    cushion_model: str,
    friction: str,
    steps: int,
    events_most: int,
    time_most: float,
    threads: int,
    space: str = "3d",
) -> Any:
    """The options of C; they are never written to."""
    if not 0.0 <= time_most < np.inf:
        raise ValueError(f"time_most: it must be 0 s (the default) or more, and finite, not {time_most}")
    return ffi.new(
        "carom_shot_options *",
        {
            "world": choice(_WORLDS, world, "world"),
            "ball_model": choice(_BALL_MODELS, ball_model, "ball_model"),
            "cushion_model": choice(_CUSHIONS, cushion_model, "cushion_model"),
            "friction": choice(_FRICTIONS, friction, "friction"),
            "steps": whole(steps, "steps"),
            "events_most": whole(events_most, "events_most"),
            "time_most": time_most,
            "threads": whole(threads, "threads", least=-1),
            "space": choice(_SPACES, space, "space"),
        },
    )


def _records(values: dtypes.Records, record: dtypes.Record, name: str, builder: str) -> Array:
    array = as_array(values, name)
    if array.dtype != record:
        raise TypeError(f"{name}: an array of the dtype of carom.{builder} is needed, not of {array.dtype}")
    return np.asarray(array, order="C")


def _table(table: object) -> None:
    if not isinstance(table, Table):
        raise TypeError(f"table: a carom.Table is needed, such as carom.tables.pool_9ft() gives, not {type(table).__name__}")


def simulate(
    table: Table,
    balls: dtypes.Records,
    cue: dtypes.Records | None = None,
    *,
    world: World = "carom",
    ball_model: BallModel = "default",
    cushion_model: ShotCushion = "default",
    friction: Friction = "alciatore",
    space: Space = "3d",
    steps: int = 0,
    events_most: int = 0,
    time_most: float = 0.0,
) -> Shot:
    """Play a shot until nothing moves.

    Parameters
    ----------
    table : Table
        `carom.tables` has the usual ones.
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        1 to 32 of them, from `carom.racks` or `carom.balls`. Not changed.
    cue : ndarray of `carom.dtypes.cue`, shape (), optional
        From `carom.cue`. There is no strike without it, at speed 0, or if a ball moves already.
    world : {"carom", "pooltool"}
        The rules of contact: those of carom, or pooltool's, for the same histories as pooltool's.
    ball_model : {"default", "exact", "euler", "inelastic", "mirror"}
        The collision of two balls; by default exact in the world carom, inelastic in pooltool.
    cushion_model : {"default", "mathavan", "stronge", "han", "mirror", "euler"}
        The impact on a cushion; by default mathavan in the world carom, stronge in pooltool. mathavan takes most of the time.
    friction : {"alciatore", "constant"}
        Between balls: by the speed of slip, or the balls' mu_ball.
    space : {"3d", "flat"}
        Whether balls can leave the cloth, as by an elevated cue. The world pooltool is flat.
    steps : int
        Of Euler's models; 0 is 1000.
    events_most : int
        Bound of events; 0 is 10000.
    time_most : float
        Bound of the clock, s; 0 is 1000.

    Returns
    -------
    Shot

    Raises
    ------
    CaromError
        An argument is in error; or the shot ended in one (a bound, a ball that left the table, a collision): then the error's
        `shot` has what had happened.
    """
    layout = _records(balls, dtypes.shot_ball, "balls", "balls()")
    if layout.ndim != 1:
        raise ValueError(f"balls: the shape must be (balls,), not {layout.shape}; simulate_batch plays many layouts")
    layout = layout.copy()
    _table(table)
    if cue is None:
        strike: Any = ffi.NULL
    else:
        cues = _records(cue, dtypes.cue, "cue", "cue()")
        if cues.size != 1:
            raise ValueError(f"cue: one is needed, not {cues.size}; simulate_batch plays many")
        strike = pointer("carom_cue[]", cues)
    options = shot_options(world, ball_model, cushion_model, friction, steps, events_most, time_most, 0, space)
    final: Array = np.zeros(layout.shape, dtypes.ball_state)
    arguments = (pointer("carom_table[]", table.record), pointer("carom_shot_ball[]", layout), len(layout), strike, options)
    if lib.carom_shot_check(*arguments, ffi.NULL) < 0:
        raise _argument_error(arguments, layout, None if cue is None else cues.reshape(()))
    # A shot that has more events than there is room for is played again with enough of it: it has the same bits.
    room = _FIRST_ROOM
    while True:
        events: Array = np.empty(room, dtypes.event)
        shot = ffi.new(
            "carom_shot *",
            {
                "events": pointer("carom_event[]", events),
                "room": room,
                "final": pointer("carom_ball_state[]", final),
            },
        )
        code = lib.carom_shoot(*arguments, shot)
        if shot.count <= room:
            break
        room = shot.count
    played = Shot(table, layout, code, shot.time, shot.count, events[: shot.count].copy(), final)
    if code < 0:
        raise CaromError(code, shot=played)
    return played


def simulate_batch(
    table: Table,
    layouts: dtypes.Records,
    cues: dtypes.Records | None = None,
    *,
    room: int = 0,
    world: World = "carom",
    ball_model: BallModel = "default",
    cushion_model: ShotCushion = "default",
    friction: Friction = "alciatore",
    space: Space = "3d",
    steps: int = 0,
    events_most: int = 0,
    time_most: float = 0.0,
    threads: int = 0,
    out: Shots | None = None,
) -> Shots:
    """Play many shots.

    Parameters
    ----------
    table : Table
        Of all shots.
    layouts : ndarray of `carom.dtypes.shot_ball`, shape (..., balls)
    cues : ndarray of `carom.dtypes.cue`, shape (...), optional
        None: no strikes. Broadcast against the leading dimensions of the layouts: one layout and many cues, or the reverse.
    room : int
        How many events of each shot are kept; 0: final states only. `shots[k].positions()` needs all of them.
    world, ball_model, cushion_model, friction, space, steps, events_most, time_most
        As for `simulate`.
    threads : int
        Most threads to use; 0 is the calling one alone, -1 all processors. No bit depends on it.
    out : Shots, optional
        An earlier result of the same shape, balls and room, whose memory is used again.

    Returns
    -------
    Shots
        Each with the bits of `simulate`. One in error costs itself: see `status` and `failures()`.

    Raises
    ------
    CaromError
        The table or an option is in error.
    """
    all_balls = _records(layouts, dtypes.shot_ball, "layouts", "balls()")
    all_cues = np.zeros((), dtypes.cue) if cues is None else _records(cues, dtypes.cue, "cues", "cue()")
    if all_balls.ndim == 0:
        raise ValueError("layouts: the shape must be (..., balls), not ()")
    _table(table)
    whole(room, "room")
    count = all_balls.shape[-1]
    shape = np.broadcast_shapes(all_balls.shape[:-1], all_cues.shape)
    # One layout or one cue for all is not copied; what else is broadcast is.
    one_layout = all_balls.size == count
    one_cue = all_cues.size == 1
    if not one_layout:
        all_balls = np.ascontiguousarray(np.broadcast_to(all_balls, (*shape, count)))
    if not one_cue:
        all_cues = np.ascontiguousarray(np.broadcast_to(all_cues, shape))
    shots = Shots(table, all_balls, shape, room) if out is None else out
    output(shots.status, shape, INT8, "out.status")
    output(shots.final, (*shape, count), dtypes.ball_state, "out.final")
    output(shots.events, (*shape, room), dtypes.event, "out.events")
    if out is not None:
        written = (("out.status", out.status), ("out.final", out.final), ("out.events", out.events), ("out.record", out.record))
        apart((("layouts", all_balls), ("cues", all_cues), ("table", table.record)), written)
    shots.table, shots.layouts, shots.cues = table, all_balls, None if cues is None else all_cues
    n = shots.status.size
    record = shots.record
    flat = record.reshape(n)
    flat["time"], flat["count"], flat["room"] = 0.0, 0, room
    numbers = np.arange(n, dtype=np.uintp)
    flat["brief"], flat["state"] = 0, 0
    flat["events"] = 0 if room == 0 else shots.events.ctypes.data + numbers * np.uintp(room * dtypes.event.itemsize)
    flat["final"] = shots.final.ctypes.data + numbers * np.uintp(count * dtypes.ball_state.itemsize)
    options = shot_options(world, ball_model, cushion_model, friction, steps, events_most, time_most, threads, space)
    shots.status[...] = Status.OK
    balls, results, flags = pointer("carom_shot_ball[]", all_balls), pointer("carom_shot[]", record), pointer("int8_t[]", shots.status)
    strikes = ffi.NULL if cues is None else pointer("carom_cue[]", all_cues)
    of_table = pointer("carom_table[]", table.record)

    def play(begin: int, many: int) -> int:
        job = ffi.new(
            "carom_shot_job *",
            {
                "table": of_table,
                "balls": balls if one_layout else balls + begin * count,
                "cues": strikes if one_cue else strikes + begin,
                "count": count,
                "ball_stride": 0 if one_layout else count,
                "cue_stride": 0 if one_cue else 1,
                "n": many,
                "options": options,
                "shots": results + begin,
                "status": flags + begin,
            },
        )
        return int(lib.carom_shoot_batch(job))

    code = in_chunks(n, 5e-5, threads, play)
    if code < 0 and not (shots.status < 0).any():
        raise CaromError(code)
    return shots


# Which field of a ball a status is about.
_BALL_FIELDS = {
    Status.ERROR_POSITION: "state.r",
    Status.ERROR_VELOCITY: "state.v",
    Status.ERROR_VERTICAL: "state.v",
    Status.ERROR_SPIN: "state.w",
    Status.ERROR_LABEL: "state.label",
    Status.ERROR_OVERLAP: "state.r",
    Status.ERROR_OFF_TABLE: "state.r",
    Status.ERROR_RADIUS: "kind.radius",
    Status.ERROR_RADII_DIFFER: "kind.radius",
    Status.ERROR_MASS: "kind.mass",
    Status.ERROR_MASSES_DIFFER: "kind.mass",
    Status.ERROR_MU_CUSHION: "kind.mu_cushion",
    Status.ERROR_GRAVITY: "kind.gravity",
    Status.ERROR_DRAG: "kind.drag",
}


def _argument_error(arguments: tuple[Any, ...], layout: Array, cue: Array | None) -> CaromError:
    """The exception for arguments that carom_shot_check() refuses."""
    where = ffi.new("int *", -1)
    status = Status(lib.carom_shot_check(*arguments, where))
    if cue is not None and status in (Status.ERROR_CUE, Status.ERROR_MISCUE):
        return cue_error(status, cue, layout)
    if status in (Status.ERROR_TABLE, Status.ERROR_NOSE_HEIGHT):
        return CaromError(status, "table")
    if not 0 <= where[0] < len(layout):
        return CaromError(status)
    kind = layout[where[0]]["kind"]
    field = _BALL_FIELDS.get(status)
    if status is Status.ERROR_MU_MOTION:
        motions = ("mu_slide", "mu_roll", "mu_spin")
        field = next((f"kind.{name}" for name in motions if not 0 < kind[name] <= 1), None)
    if status is Status.ERROR_RESTITUTION:
        restitutions = ("restitution", "restitution_cushion")
        field = next((f"kind.{name}" for name in restitutions if not 0 <= kind[name] <= 1), None)
        if field is None:
            text = "it must be 0 to 0.98, or -1 for none"
            return CaromError(status, f"balls[{where[0]}].kind.restitution_table", kind["restitution_table"], text=text)
    if status is Status.ERROR_MU_BALL:
        laws = ("law_a", "law_b", "law_c")
        bad = (name for name in laws if not 0 <= kind[name] < np.inf or (name != "law_c" and kind[name] > 1))
        field = "kind.mu_ball" if not 0 <= kind["mu_ball"] <= 1 else next((f"kind.{name}" for name in bad), None)
    if status is Status.ERROR_BALL_CUSHION:
        field = (
            "kind.roll_loss"
            if not 0 <= kind["roll_loss"] <= 1
            else "kind.nose_height"
            if not 0 <= kind["nose_height"] < 2 * kind["radius"]
            else "kind.omega_ratio"
        )
    ball = f"balls[{where[0]}]"
    if field is None:
        return CaromError(status, ball)
    group, name = field.split(".")
    return CaromError(status, f"{ball}.{field}", layout[where[0]][group][name])
