"""Derivatives of shots by the cue, the balls and their constants.

They exist for final states, for times of events and for states at given times. A derivative is
exact for small changes; `Tangents.reach` and `Tangents.flags` report how far it holds.
"""

from __future__ import annotations

import enum
import functools
import math
import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import (
    Array,
    addresses,
    as_array,
    broadcast,
    in_chunks,
    named,
    pointer,
    raw,
    several,
    suggestion,
    whole,
    workers,
)
from carom._shot_options import Options, chosen, shot_options
from carom.dtypes import Doubles, Records
from carom.layouts import Table, of_record
from carom.results import EventType, Shot, Shots
from carom.shots import simulate_batch
from carom.status import CaromError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes

__all__ = ["Flag", "Hessian", "Tangents", "aim_slope", "hessian", "jacobian", "tangents"]

MOST: int = lib.CAROM_DIRECTIONS_MOST
"""Largest number of directions of one call of C; more are divided among calls."""
STATE: int = lib.CAROM_STATE_NUMBERS
# shots per thread whose events are kept at a time; with more, memory access dominates
AT_ONCE = 128
_FEW = 64  # events for which a shot has memory at first; more memory would be slower
CUE = ("speed", "phi", "theta", "a", "b", "mass", "end_mass", "tip_restitution")
KIND = tuple(dtypes.ball_kind.names or ())
# A state is x, y, v_x, v_y, w_x, w_y, w_z, z, v_z. PARTS selects its parts; ELEMENTS has the indices
# of the components of r, v and w of a ball.
PARTS: dict[str, slice | int] = {
    "r": slice(0, 2),
    "v": slice(2, 4),
    "w": slice(4, 7),
    "z": 7,
    "v_z": 8,
}
ELEMENTS = {"r": (0, 1, 7), "v": (2, 3, 8), "w": (4, 5, 6)}
# Steps of second derivatives: this fraction of the reach, at most this fraction of the parameter's
# value or unit. The median error over 100 shots of three balls was 5e-7. With a third of these steps it
# was 1e-7 and 7e-6 (mostly noise of the exact collision), with three times these steps 1e-6.
_STEP, _STEP_MOST = 3e-3, 1e-3
_OF = (*(f"{group}.{part}" for group in ("final", "at") for part in PARTS), "time", "reach")
_TABLE = ("nose_height", "mu_cushion", "restitution")
_SLOPE = ("slope_x", "slope_y")
_UNITS = {
    "speed": "m/s",
    "phi": "deg",
    "theta": "deg",
    "a": "R",
    "b": "R",
    "mass": "kg",
    "end_mass": "kg",
    "radius": "m",
    "gravity": "m/s^2",
}
_UNITS |= {"drag": "1/m", "law_c": "s/m", "nose_height": "m", "r": "m", "v": "m/s", "w": "rad/s"}


class Flag(enum.IntFlag):
    """Reservations about a derivative at an event; `carom_tangent.h` explains each."""

    GRAZING = 1
    SLOW = 2
    SIMULTANEOUS = 4
    KINK = 8
    EULER = 16
    DIFFERENCES = 32
    DRAG = 64
    CLUSTER = 128


@dataclass(eq=False, repr=False)
class Tangents:
    """Derivatives of one or many shots by m directions, which are the last dimension.

    `final` maps "r" (m), "v" (m/s), both of shape (..., balls, 2, m), and "w" (rad/s), shape (...,
    balls, 3, m), to the derivatives of the final states; for balls in flight also "z" (m) and "v_z"
    (m/s), shape (..., balls, m). `at` contains the same for the states at `times`, with shape (...,
    times, balls, 2 or 3, m).
    """

    names: tuple[str, ...]  # what changes in each direction,
    units: tuple[str, ...]  # and the unit that derivatives are per
    states: Doubles  # all of `final`, (..., balls, 9, m)
    states_at: Doubles  # all of `at`, (..., times, balls, 9, m)
    time: (
        Doubles  # (..., events, m): of the times of the events, s; nan beyond the events of a shot
    )
    flags: NDArray[np.int32]  # (..., events): sums of `Flag`; -1 beyond the events
    # (..., m): the least change in each direction, in its unit, at which to first order a ball
    # meets something else, or in another order
    reach: Doubles
    error: Doubles  # (...): the largest relative error of what had to be found by differences
    status: NDArray[np.int8]  # (...): as `carom.Status`; derivatives of a shot in error are nan

    @property
    def final(self) -> dict[str, Doubles]:
        """Derivatives of the final states."""
        return _by_name(self.states)

    @property
    def at(self) -> dict[str, Doubles]:
        """Derivatives of the states at `times`."""
        return _by_name(self.states_at)

    def __repr__(self) -> str:
        return f"<carom.Tangents: {self.states.shape[:-3]}, by {', '.join(self.names)}>"


def _tangents(
    directions: Sequence[Direction],
    shape: tuple[int, ...],
    found: dict[str, Array],
    status: Array,
) -> Tangents:
    parts = ("final", "at", "time", "flags", "reach", "error")
    arrays = {name: found[name].reshape((*shape, *found[name].shape[1:])) for name in parts}
    arrays["states"], arrays["states_at"] = arrays.pop("final"), arrays.pop("at")
    names, units = (
        tuple(direction.name for direction in directions),
        tuple(direction.unit for direction in directions),
    )
    return Tangents(names, units, **arrays, status=status.reshape(shape))


def _by_name(states: Doubles) -> dict[str, Doubles]:
    return {name: states[..., part, :] for name, part in PARTS.items()}


class Direction(NamedTuple):
    """A direction: its name and unit, and the elements of an array of seeds that change by 1."""

    name: str
    unit: str
    array: str
    places: tuple[tuple[int, ...], ...]


def _names(wrt: Sequence[str], argument: str = "wrt") -> tuple[str, ...]:
    if isinstance(wrt, str):
        return (wrt,)
    return tuple(map(str, several(wrt, argument, "a list of names, such as ['cue.phi']")))


def _unknown(name: str, balls: int, argument: str) -> str:
    """The error for a name that is no parameter of a shot."""
    fields = [
        *(f"cue.{field}" for field in CUE),
        *(f"table.{field}" for field in _TABLE + _SLOPE),
        *(f"kind.{field}" for field in KIND),
        *(f"balls[{k}].kind.{field}" for k in range(balls) for field in KIND if field != "radius"),
        *(f"balls[{k}].{part}" for k in range(balls) for part in ELEMENTS),
    ]
    hint = suggestion(name, fields)
    return (
        f"{argument}: unknown parameter {name!r}{hint or ';'} {'Use' if hint else 'use'} cue.phi, kind.mu_slide (all balls), "
        f"balls[1].kind.mass, balls[0].r[1], table.nose_height, ...; balls are 0 to {balls - 1}. help(carom.tangents) lists all"
    )


def directions(wrt: Sequence[str], balls: int, argument: str = "wrt") -> list[list[Direction]]:
    """The directions of each name.

    Names are, for example, cue.phi; kind.mu_slide (all balls); balls[1].kind.mass; balls[0].r (x
    and y) or balls[0].r[1].
    """
    fields = {"cue": CUE, "table": _TABLE + _SLOPE, "kind": KIND}
    found: list[list[Direction]] = []
    for name in _names(wrt, argument):
        match = re.fullmatch(
            r"(cue|table|kind|balls\[(\d+)\])\.(?:(kind)\.)?(\w+)(?:\[(\d)\])?", name
        )
        group, ball, inner, field, index = match.groups() if match else ("", None, None, "", None)
        unit = _UNITS.get(field, "1")
        number = balls if ball is None else int(ball)
        if field in fields.get(group, ()) and index is None and not inner:
            column = fields[group].index(field)
            rows = ((i, column) for i in range(balls)) if group == "kind" else ((column,),)
            if field in _SLOPE:
                group, rows = "slope", ((_SLOPE.index(field),),)
            found.append([Direction(name, unit, group, tuple(rows))])
        elif number < balls and inner and field in KIND and field != "radius" and index is None:
            found.append([Direction(name, unit, "kind", ((number, KIND.index(field)),))])
        elif number < balls and not inner and field in ELEMENTS and int(index or 0) < 3:
            # the components of r and v along the cloth, unless an index selects the vertical one
            ks = range(3 if field == "w" else 2) if index is None else [int(index)]
            found.append(
                [
                    Direction(
                        f"balls[{number}].{field}[{k}]",
                        unit,
                        "state",
                        ((number, ELEMENTS[field][k]),),
                    )
                    for k in ks
                ]
            )
        else:
            raise ValueError(_unknown(name, balls, argument))
    if not found:
        raise ValueError(
            f"{argument}: the list is empty; name at least one parameter, such as 'cue.phi'"
        )
    return found


def seeds_of(directions: Sequence[Direction], balls: int) -> dict[str, Doubles]:
    """The arrays of carom_tangent_seeds."""
    m = len(directions)
    seeds = {
        "cue": np.zeros((len(CUE), m)),
        "kind": np.zeros((balls, len(KIND), m)),
        "state": np.zeros((balls, STATE, m)),
        "table": np.zeros((len(_TABLE), m)),
        "slope": np.zeros((len(_SLOPE), m)),
    }
    for j, direction in enumerate(directions):
        for place in direction.places:
            seeds[direction.array][(*place, j)] = 1.0
    return seeds


@functools.lru_cache(maxsize=256)
def _seeds(wrt: tuple[str, ...], balls: int) -> tuple[tuple[Direction, ...], dict[str, Doubles]]:
    """All directions of some names, and their seeds, which are read-only."""
    wanted_directions = tuple(
        direction for several in directions(wrt, balls) for direction in several
    )
    return wanted_directions, seeds_of(wanted_directions, balls)


def _differentiate(
    job: Callable[[int, int], Any],
    n: int,
    balls: int,
    events: int,
    seeds: dict[str, Doubles],
    times: Array,
    outputs: Collection[str],
    threads: int,
) -> tuple[dict[str, Array], Array]:
    """The requested `outputs` of the tangents of n played shots, each of shape (n, ...), and
    statuses.

    `job` returns the carom_shot_job of some of the shots. More directions than C accepts are
    divided among calls.
    """
    m = next(iter(seeds.values())).shape[-1]
    parts: list[dict[str, Array]] = []
    codes: Array = np.zeros(n, np.int8)
    for first in range(0, m, MOST):
        part = slice(first, min(first + MOST, m))
        width = part.stop - part.start
        rows = {name: np.ascontiguousarray(seed[..., part]) for name, seed in seeds.items()}
        of_c = ffi.new(
            "carom_tangent_seeds *",
            {"directions": width, **{name: pointer("double[]", row) for name, row in rows.items()}},
        )
        # C writes into arrays for all shots; other elements stay nan, and -1 for flags
        shapes = {
            "final": (balls, STATE, width),
            "at": (len(times), balls, STATE, width),
            "time": (events, width),
            "reach": (width,),
        }
        needed = {"final", *outputs} | ({"time"} if "reach" in outputs else set())
        arrays: dict[str, Array] = {
            name: np.full((n, *shape), np.nan) for name, shape in shapes.items() if name in needed
        }
        if "flags" in outputs:
            arrays["flags"] = np.full((n, events), -1, np.int32)
        record: Array = np.zeros(n, dtypes.tangent)
        for name, array in arrays.items():
            record[name] = addresses(array, 1)
        if "at" in arrays and len(times):
            record["times"], record["times_count"] = times.ctypes.data, len(times)
        results, statuses = pointer("carom_tangent[]", record), pointer("int8_t[]", codes)

        def differentiate(begin: int, many: int) -> int:
            pointers = {
                "played": job(begin, many),
                "seeds": of_c,
                "tangents": results + begin,
                "status": statuses + begin,
            }
            return int(lib.carom_shot_tangent_batch(ffi.new("carom_tangent_job *", pointers)))

        in_chunks(n, 1e-4, threads, differentiate)
        arrays["error"] = record["error"]
        parts.append(arrays)
    whole = parts[0]
    if len(parts) > 1:
        for name in set(whole) - {"flags", "error"}:
            whole[name] = np.concatenate([part[name] for part in parts], axis=-1)
        whole["error"] = np.max([part["error"] for part in parts], axis=0)
    return whole, codes


def _sorted_times(times: ArrayLike | None) -> Array:
    if times is None:
        return np.zeros(0)
    sorted_times = np.ascontiguousarray(as_array(times, "times", np.float64))
    if (
        sorted_times.ndim != 1
        or not (np.isfinite(sorted_times) & (sorted_times >= 0.0)).all()
        or (np.diff(sorted_times) < 0).any()
    ):
        raise ValueError(
            f"times: {times!r} is not an ascending list of finite times, in s from the beginning of the shot, of shape (times,)"
        )
    return sorted_times


def tangent_options(models: Options, threads: int) -> Any:
    """The options of C for the tangents of a shot with these options, without t_final and stop_at."""
    return shot_options(models._replace(t_final=None, stop_at=()), threads)


def _job_of_one(shot: Shot, options: Any) -> Callable[[int, int], Any]:
    """As `Shots._jobs`, for a single shot."""
    balls, events = np.ascontiguousarray(shot.balls), np.ascontiguousarray(shot.events)
    struck = ffi.NULL if shot.cue is None else pointer("carom_cue[]", shot.cue)
    of_c = {
        "events": pointer("carom_event[]", events),
        "room": len(events),
        "count": shot.count,
        "time": shot.time,
    }
    played = {
        "table": pointer("carom_table[]", shot.table.record),
        "balls": pointer("carom_shot_ball[]", balls),
        "cues": struck,
        "count": len(balls),
        "n": 1,
        "options": options,
        "shots": ffi.new("carom_shot *", of_c),
    }
    return lambda begin, many: ffi.new("carom_shot_job *", played)


def tangents(
    shot: Shot | Shots, wrt: Sequence[str], *, times: ArrayLike | None = None, threads: int = 0
) -> Tangents:
    """Differentiate a shot from `carom.simulate`, or many from `carom.simulate_batch`.

    Parameters
    ----------
    shot : Shot or Shots
        With all of its events; a batch needs a sufficient `room`.
    wrt : sequence of str
        Parameters to differentiate by: "cue.phi" and other fields of the cue; "kind.mu_slide" for
        all balls, "balls[1].kind.mass" for one; "balls[0].r" (two directions), "balls[0].r[1]",
        likewise v and w, and "balls[0].v[2]" of a ball in flight; "table.nose_height",
        "table.mu_cushion", "table.restitution", "table.slope_x", "table.slope_y".
    times : array_like, shape (times,), optional
        Times for `Tangents.at`, s, ascending.
    threads : int
        Largest number of threads for a batch: 0 uses only the calling thread, -1 all processors.
        Results do not depend on it.

    Returns
    -------
    Tangents
        Each shot of a batch has the bits of a single call. Failed shots, and shots without
        derivatives, do not affect the others; see `status`.

    Raises
    ------
    CaromError
        This shot has no derivatives: it was played in the world pooltool, or with Euler's model of
        balls.
    ValueError
        Shots of a batch have more events than were kept.
    """
    if not isinstance(shot, (Shot, Shots)):
        raise TypeError(
            f"shot: {type(shot).__name__} is not a result of carom.simulate() or carom.simulate_batch()"
        )
    balls = shot.final.shape[-1]
    directions, seeds = _seeds(_names(wrt), balls)
    moments = _sorted_times(times)
    whole(threads, "threads", least=-1)
    outputs = ("final", "at", "time", "flags", "reach")
    if shot.events.dtype != dtypes.event:
        raise ValueError(
            'shot: its events were kept with records="brief"; play it with records="full"'
        )
    count, status, room = np.asarray(shot.count), np.asarray(shot.status), shot.events.shape[-1]
    lost = count[(status >= 0) & (count > room)]
    if lost.size:
        raise ValueError(
            f"shot: {lost.size} of {count.size} shots have more events than room={room} keeps; use room={lost.max()}"
        )
    events = int(np.minimum(count, room).max(initial=0))
    if isinstance(shot, Shots):
        job = shot._jobs(tangent_options(shot.options, threads))
        found, codes = _differentiate(
            job, count.size, balls, events, seeds, moments, outputs, threads
        )
        return _tangents(directions, shot.shape, found, codes)
    job = _job_of_one(shot, tangent_options(shot.options, 0))
    found, codes = _differentiate(job, 1, balls, events, seeds, moments, outputs, 0)
    if codes[0] < 0:
        raise CaromError(int(codes[0]))
    return _tangents(directions, (), found, codes)


def _final_states(shots: Shots, directions: Sequence[Direction], threads: int) -> Doubles:
    """Derivatives of the final states of shots with all of their events: (shots, balls, STATE, m)."""
    balls = shots.final.shape[-1]
    job = shots._jobs(tangent_options(shots.options, threads))
    return _differentiate(
        job, shots.size, balls, 0, seeds_of(directions, balls), np.zeros(0), ("final",), threads
    )[0]["final"]


@dataclass(eq=False, repr=False)
class Hessian:
    """Second derivatives of the final states of one or many shots by pairs of m directions.

    `final` maps "r" (m) and "v" (m/s), shape (..., balls, 2, m, m), "w" (rad/s), shape (..., balls,
    3, m, m), and "z" and "v_z", shape (..., balls, m, m). Along a vector the last dimension is
    omitted.
    """

    # first derivatives, with the names and units of the directions, their reach, and the flags of
    # the events
    first: Tangents
    states: Doubles  # all of `final`, (..., balls, 9, m, m)
    # (...): the largest difference of d2/dx dy and d2/dy dx over the largest second derivative,
    # each for changes in proportion to the steps; nan along a vector, where it is unknown
    error: Doubles

    @property
    def final(self) -> dict[str, Doubles]:
        """Derivatives of the final states."""
        batch = (slice(None),) * (self.first.states.ndim - 2)
        return {name: self.states[(*batch, part)] for name, part in PARTS.items()}

    def __repr__(self) -> str:
        return f"<carom.Hessian: by {', '.join(self.first.names)}, error {np.max(self.error, initial=0.0):.1e}>"


def numbers_of_direction(
    direction: Direction, layouts: Records, cues: Records | None
) -> list[Array]:
    """The elements that a direction changes, as views into layouts (..., balls) and cues (...);
    none for the table.
    """
    found: list[Array] = []
    for place in direction.places:
        if direction.array == "cue" and cues is not None:
            found.append(cues[CUE[place[0]]])
        elif direction.array == "kind":
            found.append(layouts["kind"][KIND[place[1]]][..., place[0]])
        elif direction.array == "state":
            name, elements = next(item for item in ELEMENTS.items() if place[1] in item[1])
            found.append(layouts["state"][name][..., place[0], elements.index(place[1])])
    return found


def hessian(
    shot: Shot | Shots, wrt: Sequence[str], *, along: ArrayLike | None = None, threads: int = 0
) -> Hessian:
    """Compute second derivatives of the final states of played shots.

    They are central differences of exact first derivatives, and take two shots with their tangents
    for each direction, or for the vector. Steps are small compared with the reach. Derivatives by a
    direction are nan if a shot of the difference has other events. `flags` and `reach` of the first
    derivatives apply here too.

    Parameters
    ----------
    shot, wrt, threads
        As for `tangents`, but without parameters of the table; use "kind.nose_height".
    along : array_like, shape (..., m), optional
        A vector for each shot, or one for all. Then only the product of the Hessian and this vector
        is computed, of shape (..., balls, 9, m).

    Returns
    -------
    Hessian

    Raises
    ------
    CaromError
        This shot has no derivatives.
    """
    first = tangents(shot, wrt, threads=threads)
    directions = _seeds(_names(wrt), shot.final.shape[-1])[0]
    shape, m = first.error.shape, len(directions)
    if isinstance(shot, Shot):
        shot = simulate_batch(
            shot.table, shot.balls, shot.cue, room=shot.count, options=shot.options
        )
    for direction in directions:
        if direction.array in ("table", "slope") or (
            direction.array == "cue" and shot.cues is None
        ):
            raise ValueError(
                f"wrt: {direction.name!r} has no second derivatives; use fields of the balls, or of a cue that strikes"
            )
    steps = steps_of(directions, shot, first.reach)
    if along is None:
        d = by_steps(shot, directions, steps, np.eye(m), threads)
        transposed, axes = d.swapaxes(-1, -2), (-4, -3, -2, -1)
        weight = (steps[..., :, np.newaxis] * steps[..., np.newaxis, :])[
            ..., np.newaxis, np.newaxis, :, :
        ]
        largest, apart = (
            np.fmax.reduce(np.abs(each) * weight, axis=axes, initial=0.0)
            for each in (d, d - transposed)
        )
        return Hessian(first, (d + transposed) / 2.0, apart / np.where(largest > 0.0, largest, 1.0))
    vectors = as_array(along, "along", np.float64)
    if (
        vectors.shape[-1:] != (m,)
        or broadcast({"along": vectors.shape[:-1], "shots": shape}) != shape
    ):
        raise ValueError(
            f"along: the shape is {vectors.shape}, but must be ({m},) or {(*shape, m)}, one component per direction"
        )
    return Hessian(
        first,
        by_steps(shot, directions, steps, vectors[..., np.newaxis, :], threads)[..., 0],
        np.full(shape, np.nan),
    )


def _whole(shots: Shots) -> tuple[Records, Records | None]:
    """The layouts (n, balls) and cues (n,) of shots, one row per shot."""
    layouts = np.broadcast_to(shots.layouts, shots.final.shape).reshape(-1, shots.final.shape[-1])
    if shots.kinds is not None:
        states, layouts = layouts, np.zeros(layouts.shape, dtypes.shot_ball)
        layouts["state"], layouts["kind"] = states, shots.kinds
    return layouts, None if shots.cues is None else np.broadcast_to(
        shots.cues, shots.shape
    ).reshape(-1)


def steps_of(directions: Sequence[Direction], shots: Shots, reach: Doubles) -> Doubles:
    """The steps (..., m) of second derivatives."""
    steps: Doubles = np.fmin(_STEP * reach, _STEP_MOST)
    if all(direction.array != "kind" for direction in directions):
        return steps
    layouts = _whole(shots)[0]
    for j, direction in enumerate(directions):
        if direction.array == "kind":
            numbers = np.max(
                np.abs(numbers_of_direction(direction, layouts, None)), axis=0
            ).reshape(shots.shape)
            steps[..., j] = np.minimum(
                steps[..., j], _STEP_MOST * np.where(numbers > 0.0, numbers, 1.0)
            )
    return steps


def _repeated(records: Array, p: int) -> Array:
    """Records (n, ...) twice for each of p vectors: (n, 2, p, ...)."""
    many = np.repeat(raw(np.ascontiguousarray(records))[:, np.newaxis], 2 * p, axis=1)
    return many.view(records.dtype).reshape(-1, 2, p, *records.shape[1:])


def by_steps(
    shots: Shots,
    directions: Sequence[Direction],
    steps: Doubles,
    vectors: Array,
    threads: int,
) -> Doubles:
    """Differences of the tangents of shots along vectors (..., p, m), per unit length: (..., balls,
    STATE, m, p).
    """
    n, balls, m, p = shots.status.size, shots.final.shape[-1], len(directions), vectors.shape[-2]
    ways = np.broadcast_to(vectors, (*shots.shape, p, m)).reshape(n, p, m)
    layouts, cues = _whole(shots)
    events, count, status = (
        shots.events.reshape(n, -1),
        shots.count.reshape(n),
        shots.status.reshape(n),
    )
    found = np.full((n, balls, STATE, m, p), np.nan)

    # The longest step whose components together do not exceed the steps along single directions.
    with np.errstate(divide="ignore", invalid="ignore"):
        slower = (np.abs(ways) / steps.reshape(n, 1, m)).sum(axis=-1)
        h = 1.0 / np.where(ways.any(axis=-1), slower, 1.0)

    at_once = max(AT_ONCE * workers(threads) // (2 * p), 1)
    for begin in range(0, n, at_once):
        # For each shot, one shifted forward and one shifted backward along each vector: (shots, 2, p).
        part = slice(begin, begin + at_once)
        changes = h[part, np.newaxis, :, np.newaxis] * np.stack([ways[part], -ways[part]], axis=1)
        moved, struck = (
            _repeated(layouts[part], p),
            None if cues is None else _repeated(cues[part], p),
        )
        for j, direction in enumerate(directions):
            if direction.name == "kind.radius":
                # keep the ball's height above the cloth
                moved["state"]["r"][..., 2] += changes[..., j, np.newaxis]
            for number in numbers_of_direction(direction, moved, struck):
                number += changes[..., j]
        room = int(count[part].max())
        others = simulate_batch(
            shots.table, moved, struck, room=room, threads=threads, options=shots.options
        )

        # Use the shots with the same events as the original.
        same = (others.count == count[part, np.newaxis, np.newaxis]) & (
            others.status == status[part, np.newaxis, np.newaxis]
        )
        beyond = np.arange(room) >= count[part, np.newaxis, np.newaxis, np.newaxis]
        for name in ("type", "a", "b"):
            same &= (
                (others.events[name] == events[name][part, np.newaxis, np.newaxis, :room]) | beyond
            ).all(axis=-1)
        slopes = np.full((*same.shape, balls, STATE, m), np.nan)
        if same.any():
            matching = others if same.all() else others[same]
            slopes[same] = _final_states(matching, directions, threads)
        with np.errstate(invalid="ignore"):
            change = (slopes[:, 0] - slopes[:, 1]) / (
                2.0 * h[part, :, np.newaxis, np.newaxis, np.newaxis]
            )
        found[part] = np.moveaxis(change, 1, -1)
    return found.reshape(*shots.shape, balls, STATE, m, p)


def aim_slope(shot: Shot, ball: int, wrt: Sequence[str], *, by: str = "cue.phi") -> Doubles:
    """Compute how the cue's direction must follow other parameters so that a ball still falls.

    The ball then crosses the end of its path at the same position.

    Parameters
    ----------
    shot : Shot
        A shot that pots the ball, for example with a cue from `carom.aim`.
    ball : int
        Index of the ball.
    wrt : sequence of str
        The parameters that change, such as "cue.speed", "cue.b" or "balls[1].r", as for `tangents`.
    by : str
        The parameter that follows.

    Returns
    -------
    ndarray of float64, shape (m,)
        d by / d wrt to first order: degrees per m/s, per radius, per m, ...

    Raises
    ------
    ValueError
        The ball does not fall, or `by` does not change the direction of its path.
    """
    if not isinstance(shot, Shot):
        raise TypeError(f"shot: {type(shot).__name__} is not a result of carom.simulate()")
    events = shot.events[: shot.count]
    fell = events[(events["type"] == EventType.POCKET) & (events["a"] == whole(ball, "ball"))]
    if len(fell) == 0:
        raise ValueError(f"ball: ball {ball} does not fall in this shot; choose one that falls")
    # Just before the fall, the position across the path equals that at the fall, whenever it happens.
    before_end = fell["time"][-1] * (1.0 - 1e-9)
    v_x, v_y, _ = shot.states(before_end)["v"][ball]
    d = tangents(shot, [by, *wrt], times=[before_end]).at["r"][0, ball]
    across = v_x * d[1] - v_y * d[0]
    if across[0] == 0.0 or len(directions([by], shot.final.shape[-1], "by")[0]) != 1:
        raise ValueError(
            f"by: {by!r} does not change the direction of ball {ball}; use a parameter such as 'cue.phi'"
        )
    slopes: Doubles = -across[1:] / across[0]
    return slopes


def play(
    table: Table,
    layouts: Records,
    cues: Records | None,
    seeds: dict[str, Doubles],
    times: Array,
    outputs: Collection[str],
    room: int,
    threads: int,
    options: Options,
) -> tuple[dict[str, Array], Array, Records]:
    """Play and differentiate shots in parts: the requested outputs, statuses and final states over
    the batch.
    """
    whole(threads, "threads", least=-1)
    room = whole(room, "room")
    balls, shape = (
        layouts.shape[-1],
        np.broadcast_shapes(layouts.shape[:-1], () if cues is None else cues.shape),
    )
    n = math.prod(shape)
    one_layout, one_cue = layouts.size == balls, cues is None or cues.size == 1
    rows = (
        layouts.reshape(1, balls)
        if one_layout
        else np.broadcast_to(layouts, (*shape, balls)).reshape(n, balls)
    )
    strikes = (
        cues
        if cues is None
        else cues.reshape(())
        if one_cue
        else np.broadcast_to(cues, shape).reshape(n)
    )
    parts: list[dict[str, Array]] = []
    codes: Array = np.empty(n, np.int8)
    final: Array = np.empty((n, balls), dtypes.ball_state)
    shots: Shots | None = None
    at_once = AT_ONCE * workers(threads)
    at_once = max(
        -(-n // max(-(-n // at_once), 1)), 1
    )  # equal parts, which all reuse the memory of the first
    room_used = min(room, _FEW)
    for begin in range(0, max(n, 1), at_once):
        part = slice(begin, min(begin + at_once, n))
        many = part.stop - part.start
        struck = strikes if strikes is None or one_cue else strikes[part]
        while True:
            reused = (
                shots
                if shots is not None
                and shots.shape == (many,)
                and shots.events.shape[-1] == room_used
                else None
            )
            shots = simulate_batch(
                table,
                rows if one_layout else rows[part],
                struck,
                room=room_used,
                threads=threads,
                out=reused,
                options=options,
            )
            longest = int(shots.count.max(initial=0))
            if longest <= room_used or room_used == room:
                break
            room_used = min(longest, room)
        events = min(longest, room)
        job = shots._jobs(tangent_options(shots.options, threads))
        found, codes[part] = _differentiate(
            job, many, balls, events, seeds, times, outputs, threads
        )
        if "flags" in found:  # combined over the events of a shot
            found["flags"] = np.bitwise_or.reduce(np.maximum(found["flags"], 0), axis=1)
        raw(final)[part] = raw(shots.final)
        parts.append(found)
    gathered: dict[str, Array] = {}
    for name in parts[0]:
        blocks = [found[name] for found in parts]
        if name == "time":
            # as many events as the longest shot
            most = max(block.shape[1] for block in blocks)
            longer = [np.full((len(block), most, *block.shape[2:]), np.nan) for block in blocks]
            for target, block in zip(longer, blocks):
                target[:, : block.shape[1]] = block
            blocks = longer
        joined = np.concatenate(blocks) if len(blocks) > 1 else blocks[0]
        gathered[name] = joined.reshape((*shape, *joined.shape[1:]))
    return gathered, codes.reshape(shape), final.reshape((*shape, balls))


def jacobian(
    table: Table,
    layouts: Records,
    cues: Records | None,
    wrt: Sequence[str],
    *,
    of: str = "final.r",
    times: ArrayLike | None = None,
    room: int = 512,
    threads: int = 0,
    options: Options = Options(),
    **changes: Unpack[Changes],
) -> Doubles:
    """Play shots and return one derivative of each, with leading batch dimensions.

    Parameters
    ----------
    table, layouts, cues, wrt
        As for `carom.simulate_batch` and `tangents`.
    of : str
        "final.r", "final.v", "final.w", "final.z", "final.v_z"; likewise "at.r", ... at `times`;
        "time" for the times of events; or "reach".
    room : int
        Largest number of events of a shot; a shot with more returns nan.
    threads, options, **changes
        As for `carom.simulate_batch`.

    Returns
    -------
    ndarray of float64
        For "final.r" of shape (..., balls, 2, m); nan for failed shots. Each shot has the bits of
        `tangents`.
    """
    group, _, field = named(_OF, of, "of").partition(".")
    layouts = of_record(layouts, dtypes.shot_ball, "layouts", "balls()")
    cues = None if cues is None else of_record(cues, dtypes.cue, "cues", "cue()")
    if layouts.ndim == 0:
        raise ValueError("layouts: the shape is (), but must be (..., balls)")
    seeds = _seeds(_names(wrt), layouts.shape[-1])[1]
    found = play(
        table,
        layouts,
        cues,
        seeds,
        _sorted_times(times),
        (group,),
        room,
        threads,
        chosen(options, changes),
    )[0][group]
    return _by_name(found)[field] if field else found
