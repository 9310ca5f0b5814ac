"""Whole shots as functions of some of their numbers, with Jacobians, for libraries that
differentiate: carom.jax and carom.torch.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._faults import shot_arguments
from carom._rows import Array, broadcast, pointer
from carom._shot_options import Options, shot_options
from carom.derivatives import (
    AT_ONCE,
    ELEMENTS,
    MOST,
    PARTS,
    STATE,
    Direction,
    by_steps,
    directions,
    numbers_of_direction,
    play,
    seeds_of,
    steps_of,
    tangent_options,
    tangents,
)
from carom.dtypes import Doubles, Records
from carom.layouts import Table, of_record
from carom.shots import simulate, simulate_batch
from carom.status import CaromError, Status

# The places of a state's numbers, x, y, v_x and so on, among those of r, v and w in
# `carom.dtypes.ball_state`.
_ORDER = np.argsort([*ELEMENTS["r"], *ELEMENTS["v"], *ELEMENTS["w"]])


class Final(NamedTuple):
    """Final states: arrays of float64, of the library that differentiates; and, with `reach=True`,
    how far derivatives hold.

    `reach` maps each parameter to the smallest change that alters the sequence of events, as in
    `carom.Tangents`: an array of the parameter's shape, in its unit. `flags`, shape (...), combines
    the `carom.Flag` of all events of a shot. Neither has a gradient.
    """

    r: Any  # (..., balls, 2): Positions, m, along x and y
    v: Any  # (..., balls, 2): Velocities, m/s, along x and y
    w: Any  # (..., balls, 3): Angular velocities, rad/s
    z: Any  # (..., balls): Heights of the centres, m
    v_z: Any  # (..., balls): Velocities upward, m/s
    reach: Any = None
    flags: Any = None


@dataclass(frozen=True, eq=False, repr=False)
class Shots:
    """Shots that differ in some parameters.

    The table, the layouts (..., balls) and the cues (...) are stored as bytes with their shapes.
    """

    table: bytes
    balls: bytes
    balls_shape: tuple[int, ...]
    cues: bytes | None
    cues_shape: tuple[int, ...]
    names: tuple[str, ...]
    options: Options
    threads: int
    room: int
    nan: bool
    has_extras: bool
    """Whether reach and flags are returned in addition to the states."""

    @property
    def count(self) -> int:
        return self.balls_shape[-1]

    @functools.cached_property
    def directions(self) -> list[Direction]:
        return [
            direction for several in _directions(self.names, self.count) for direction in several
        ]

    @functools.cached_property
    def seeds(self) -> dict[str, Doubles]:
        return seeds_of(self.directions, self.count)

    @functools.cached_property
    def played_on(self) -> Table:
        return Table.from_record(np.frombuffer(self.table, dtypes.table)[0])

    def records(self, x: Doubles) -> tuple[Records, Records | None]:
        """Layouts and cues with these parameter values, of shape (..., m)."""
        layouts: Array = np.frombuffer(self.balls, dtypes.shot_ball).reshape(self.balls_shape)
        cues: Array | None = (
            None
            if self.cues is None
            else np.frombuffer(self.cues, dtypes.cue).reshape(self.cues_shape)
        )
        arrays = {direction.array for direction in self.directions}
        if arrays & {"state", "kind"}:
            layouts = np.broadcast_to(layouts, (*x.shape[:-1], self.count)).copy()
        if cues is not None and "cue" in arrays:
            cues = np.broadcast_to(cues, x.shape[:-1]).copy()
        for j, direction in enumerate(self.directions):
            if direction.name == "kind.radius":
                # a ball stays as high above the cloth as it is
                layouts["state"]["r"][..., 2] += x[..., j, np.newaxis] - layouts["kind"]["radius"]
            for number in numbers_of_direction(direction, layouts, cues):
                number[...] = x[..., j]
        return layouts, cues

    @functools.cached_property
    def single_shot(self) -> _One | None:
        """Buffers for a single shot that is played repeatedly, if the arguments allow it."""
        single = (
            len(self.balls_shape) == 1 and self.cues_shape == () and len(self.directions) <= MOST
        )
        return _One(self) if single and "kind.radius" not in self.names else None

    def states(self, x: Any) -> tuple[Array, ...]:
        """The final states, shape (..., balls, STATE), and, if requested, reach (..., m) and flags
        (...).
        """
        numbers = np.asarray(x)
        if self.has_extras:
            states, _, *extras = self.both(numbers)
            return (states, *extras)
        if (
            numbers.ndim == 1
            and self.single_shot is not None
            and (played := self.single_shot.play(numbers, False)) is not None
        ):
            return (played[0],)
        layouts, cues = self.records(numbers)
        shots = simulate_batch(
            self.played_on, layouts, cues, threads=self.threads, options=self.options
        )
        return (self.numbers(numbers, shots.final, shots.status),)

    def both(self, x: Any) -> tuple[Array, ...]:
        """As `states`, with the derivatives, shape (..., balls, STATE, m), after the states."""
        numbers = np.asarray(x)
        if (
            not self.has_extras
            and numbers.ndim == 1
            and self.single_shot is not None
            and (found_alone := self.single_shot.play(numbers, True)) is not None
        ):
            return found_alone
        layouts, cues = self.records(numbers)
        found, codes, final = play(
            self.played_on,
            layouts,
            cues,
            self.seeds,
            np.zeros(0),
            ("final", "reach", "flags") if self.has_extras else ("final",),
            self.room,
            self.threads,
            self.options,
        )
        played = (
            np.where(np.isin(codes, (Status.ERROR_TANGENT, Status.ERROR_EVENTS_LOST)), 0, codes)
            if self.nan
            else codes
        )
        extras = (found["reach"], found["flags"]) if self.has_extras else ()
        return (self.numbers(numbers, final, played), found["final"], *extras)

    def second(self, x: Any) -> Doubles:
        """The second derivatives of the final states, of shape (..., balls, STATE, m, m), as
        `carom.hessian` computes them.
        """
        slopes = self._along(x, np.eye(len(self.directions)))
        return (slopes + slopes.swapaxes(-1, -2)) / 2.0

    def along(self, x: Any, vectors: Array) -> Doubles:
        """The derivatives along vectors (..., p, m) of the derivatives of the final states: (...,
        balls, STATE, m, p); nan where unknown.

        For at least m vectors the complete second derivatives are computed, which takes no longer
        and makes the result symmetric.
        """
        if vectors.shape[-2] < len(self.directions):
            return self._along(x, vectors)
        return self.second(x) @ vectors.swapaxes(-1, -2)[..., np.newaxis, np.newaxis, :, :]

    def _along(self, x: Any, vectors: Array) -> Doubles:
        numbers = np.asarray(x)
        shape, m = numbers.shape[:-1], numbers.shape[-1]
        layouts, cues = self.records(numbers)
        layouts = np.broadcast_to(layouts, (*shape, self.count)).reshape(-1, self.count)
        cues = None if cues is None else np.broadcast_to(cues, shape).reshape(-1)
        ways = np.broadcast_to(vectors, (*shape, *np.shape(vectors)[-2:])).reshape(
            len(layouts), -1, m
        )
        found = np.full((len(layouts), self.count, STATE, m, ways.shape[1]), np.nan)
        for begin in range(0, len(layouts), AT_ONCE):
            part = slice(begin, begin + AT_ONCE)
            struck = None if cues is None else cues[part]
            shots = simulate_batch(
                self.played_on,
                layouts[part],
                struck,
                room=self.room,
                threads=self.threads,
                options=self.options,
            )
            known = (shots.status >= 0) & (shots.count <= self.room)
            if known.any():
                some = shots[known]
                steps = steps_of(
                    self.directions, some, tangents(some, self.names, threads=self.threads).reach
                )
                found[part][known] = by_steps(
                    some, self.directions, steps, ways[part][known], self.threads
                )
        return found.reshape(*shape, *found.shape[1:])

    def numbers(self, x: Doubles, final: Records, status: Array) -> Doubles:
        """Final states as an array of float64; a failed shot becomes nan or raises its error."""
        invalid = status < 0
        failed = bool(invalid.any())
        if failed and not self.nan:
            first = tuple(int(k) for k in np.argwhere(invalid)[0])
            self.refuse(x, first, Status(int(status[first])))
        states: Doubles = final.view(np.float64).reshape(*final.shape, -1)[..., _ORDER]
        if failed:
            states[invalid] = np.nan
        return states

    def refuse(self, x: Doubles, where: tuple[int, ...], status: Status) -> None:
        """Raise the error of one shot, with its index in the batch and its parameters."""
        text = status.text
        layouts, cues = self.records(x)
        layouts = np.broadcast_to(layouts, (*x.shape[:-1], self.count))[where]
        cues = None if cues is None else np.broadcast_to(cues, x.shape[:-1])[where]
        try:
            simulate(self.played_on, layouts, cues, options=self.options)
        except CaromError as error:
            text = str(error)
        place = f"shot {list(where)} of the batch, " if where else ""
        values = ", ".join(
            f"{direction.name} = {value:g}" for direction, value in zip(self.directions, x[where])
        )
        raise CaromError(status, text=f"{place}{values}: {text}")


class _One:
    """A shot in buffers that are reused.

    Otherwise building the arguments of a single call takes longer than C takes for the shot and its
    derivatives.
    """

    def __init__(self, shots: Shots) -> None:
        balls, cue, table = (
            np.frombuffer(shots.balls, dtypes.shot_ball).copy(),
            None,
            shots.played_on,
        )
        if shots.cues is not None:
            cue = np.frombuffer(shots.cues, dtypes.cue).reshape(()).copy()
        simulate_batch(
            table, balls, cue, options=shots.options
        )  # which checks more than C does, and warns
        self.numbers = [
            numbers_of_direction(direction, balls, cue) for direction in shots.directions
        ]
        self.final: Array = np.zeros(shots.count, dtypes.ball_state)
        self.slopes: Array = np.zeros((shots.count, STATE, len(self.numbers)))
        self.memory = np.empty(shots.room, dtypes.event), shots.seeds, table
        self.arguments = shot_arguments(table, balls, cue, shot_options(shots.options))
        self.differentiated = (*self.arguments[:4], tangent_options(shots.options, 0))
        seeds = {name: pointer("double[]", row) for name, row in shots.seeds.items()}
        self.seeds = ffi.new("carom_tangent_seeds *", {"directions": len(self.numbers), **seeds})
        self.tangent = ffi.new("carom_tangent *", {"final": pointer("double[]", self.slopes)})
        events, final = (
            pointer("carom_event[]", self.memory[0]),
            pointer("carom_ball_state[]", self.final),
        )
        self.shot = ffi.new("carom_shot *", {"events": events, "room": shots.room, "final": final})
        self.free = threading.Lock()

    def play(self, x: Doubles, differentiated: bool) -> tuple[Doubles, Doubles] | None:
        """The final states and, if requested, their derivatives.

        None if the shot fails; the batch call then reports why.
        """
        with self.free:
            for numbers, value in zip(self.numbers, x.tolist()):
                for number in numbers:
                    number[...] = value
            self.shot.count, self.shot.time = 0, 0.0
            if lib.carom_shoot(*self.arguments, self.shot) < 0:
                return None
            if (
                differentiated
                and lib.carom_shot_tangent(
                    *self.differentiated, self.shot, self.seeds, self.tangent
                )
                < 0
            ):
                return None
            return self.final.view(np.float64).reshape(len(self.final), -1)[
                :, _ORDER
            ], self.slopes.copy()


_directions = functools.lru_cache(maxsize=256)(functools.partial(directions, argument="numbers"))
# JAX compiles a callback once for each object: equal shots are one object
_shots = functools.lru_cache(maxsize=256)(Shots)


def shots_of(
    table: Table,
    balls: Records,
    cue: Records | None,
    numbers: Mapping[str, Any],
    array: Callable[[Any], Any],
    room: int,
    errors: str,
    threads: int,
    options: Options,
    has_extras: bool,
) -> tuple[Shots, list[tuple[Any, tuple[int, ...]]], tuple[int, ...]]:
    """The shots; each parameter as an `array` (...) or (..., elements) with its broadcast shape;
    and the shape of the batch.
    """
    if errors not in ("raise", "nan"):
        raise ValueError(f"errors: unknown value {errors!r}; use 'raise' or 'nan'")
    layouts = of_record(balls, dtypes.shot_ball, "balls", "balls()")
    cues = None if cue is None else of_record(cue, dtypes.cue, "cue", "cue()")
    if layouts.ndim == 0:
        raise ValueError("balls: the shape is (), but must be (..., balls)")
    parts: list[Any] = []
    owns: list[tuple[int, ...]] = []  # () of a number, (elements,) of several
    for (name, value), several in zip(
        numbers.items(), _directions(tuple(numbers), layouts.shape[-1])
    ):
        if several[0].array in ("table", "slope"):
            raise ValueError(
                f"numbers: {name!r} cannot differ within a batch, which has one table; use kind.nose_height, kind.mu_cushion or kind.restitution_cushion"
            )
        if several[0].array == "cue" and cue is None:
            raise ValueError(
                f"numbers: {name!r} is given, but there is no cue; pass cue=carom.cue()"
            )
        part = array(value)
        if name != several[0].name and tuple(part.shape[-1:]) != (len(several),):
            raise ValueError(
                f"numbers: {name!r}: the shape is {tuple(part.shape)}, but must be (..., {len(several)})"
            )
        parts.append(part)
        owns.append(() if name == several[0].name else (len(several),))
    leading = {"balls": layouts.shape[:-1], "cue": () if cues is None else cues.shape}
    batch = broadcast(
        {
            **leading,
            **{
                name: tuple(part.shape[: part.ndim - len(layout_shape)])
                for name, part, layout_shape in zip(numbers, parts, owns)
            },
        }
    )
    shots = _shots(
        table.record.tobytes(),
        layouts.tobytes(),
        layouts.shape,
        None if cues is None else cues.tobytes(),
        () if cues is None else cues.shape,
        tuple(numbers),
        options,
        threads,
        room,
        errors == "nan",
        has_extras,
    )
    return (
        shots,
        [(part, (*batch, *layout_shape)) for part, layout_shape in zip(parts, owns)],
        batch,
    )


def named(shots: Shots, states: Any, reach: Any = None, flags: Any = None) -> Final:
    """The parts of states (..., balls, STATE), and of the reach (..., m)."""
    found = Final(**{name: states[..., part] for name, part in PARTS.items()})
    if reach is None:
        return found
    parts, first = dict[str, Any](), 0
    for name, several in zip(shots.names, _directions(shots.names, shots.count)):
        end = first + len(several)
        parts[name] = reach[..., first] if name == several[0].name else reach[..., first:end]
        first = end
    return found._replace(reach=parts, flags=flags)
