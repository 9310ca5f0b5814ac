"""Whole shots as functions of some of their numbers, with Jacobians, for libraries that differentiate: carom.jax and carom.torch."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from carom import dtypes
from carom._rows import Array, broadcast
from carom._shot_options import Options
from carom.derivatives import ELEMENTS, PARTS, STATE, Direction, directions, numbers_of_direction, play, seeds_of
from carom.layouts import Table, of_record
from carom.shots import simulate, simulate_batch
from carom.status import CaromError, Status

# The places of a state's numbers, x, y, v_x and so on, among those of r, v and w in `carom.dtypes.ball_state`.
_ORDER = np.argsort([*ELEMENTS["r"], *ELEMENTS["v"], *ELEMENTS["w"]])


class Final(NamedTuple):
    """Final states: arrays of float64, of the library that differentiates."""

    r: Any  # (..., balls, 2): Places, m, and velocities, m/s, along x and y
    v: Any  # (..., balls, 2): Places, m, and velocities, m/s, along x and y
    w: Any  # (..., balls, 3): Angular velocities, rad/s
    z: Any  # (..., balls): Heights of the centres, m, and velocities upward, m/s
    v_z: Any  # (..., balls): Heights of the centres, m, and velocities upward, m/s


@dataclass(frozen=True, eq=False, repr=False)
class Shots:
    """Shots that differ by some numbers: on a table, of layouts (..., balls) and cues (...), as bytes with their shapes."""

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

    @property
    def count(self) -> int:
        return self.balls_shape[-1]

    @functools.cached_property
    def directions(self) -> list[Direction]:
        return [direction for several in directions(self.names, self.count, "numbers") for direction in several]

    @functools.cached_property
    def seeds(self) -> dict[str, dtypes.Doubles]:
        return seeds_of(self.directions, self.count)

    @functools.cached_property
    def played_on(self) -> Table:
        return Table.from_record(np.frombuffer(self.table, dtypes.table)[0])

    def records(self, x: dtypes.Doubles) -> tuple[dtypes.Records, dtypes.Records | None]:
        """Layouts and cues with these numbers, of shape (..., m)."""
        layouts: Array = np.frombuffer(self.balls, dtypes.shot_ball).reshape(self.balls_shape)
        cues: Array | None = None if self.cues is None else np.frombuffer(self.cues, dtypes.cue).reshape(self.cues_shape)
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

    def states(self, x: Any) -> dtypes.Doubles:
        """The final states, of shape (..., balls, STATE)."""
        numbers = np.asarray(x)
        layouts, cues = self.records(numbers)
        shots = simulate_batch(self.played_on, layouts, cues, threads=self.threads, options=self.options)
        return self.numbers(numbers, shots.final, shots.status)

    def both(self, x: Any) -> tuple[dtypes.Doubles, dtypes.Doubles]:
        """The final states and their derivatives, of shape (..., balls, STATE, m)."""
        numbers = np.asarray(x)
        layouts, cues = self.records(numbers)
        found, codes, final = play(self.played_on, layouts, cues, self.seeds, np.zeros(0), ("final",), self.room, self.threads, self.options)
        played = np.where(np.isin(codes, (Status.ERROR_TANGENT, Status.ERROR_EVENTS_LOST)), 0, codes) if self.nan else codes
        return self.numbers(numbers, final, played), found["final"]

    def numbers(self, x: dtypes.Doubles, final: dtypes.Records, status: Array) -> dtypes.Doubles:
        """Final states as numbers; shots in error are nan, or raise."""
        bad = status < 0
        failed = bool(bad.any())
        if failed and not self.nan:
            first = tuple(int(k) for k in np.argwhere(bad)[0])
            self.refuse(x, first, Status(int(status[first])))
        states: dtypes.Doubles = final.view(np.float64).reshape(*final.shape, -1)[..., _ORDER]
        if failed:
            states[bad] = np.nan
        return states

    def refuse(self, x: dtypes.Doubles, where: tuple[int, ...], status: Status) -> None:
        """Raises the error of one shot, with its place in the batch and its numbers."""
        text = status.text
        layouts, cues = self.records(x)
        layouts = np.broadcast_to(layouts, (*x.shape[:-1], self.count))[where]
        cues = None if cues is None else np.broadcast_to(cues, x.shape[:-1])[where]
        try:
            simulate(self.played_on, layouts, cues, options=self.options)
        except CaromError as error:
            text = str(error)
        which = f"shot {list(where)} of the batch, " if where else ""
        values = ", ".join(f"{direction.name} = {value:g}" for direction, value in zip(self.directions, x[where]))
        raise CaromError(status, text=f"{which}{values}: {text}")


# JAX compiles a callback once for each object: equal shots are one object
_shots = functools.lru_cache(maxsize=256)(Shots)


def shots_of(
    table: Table, balls: dtypes.Records, cue: dtypes.Records | None, numbers: Mapping[str, Any], array: Callable[[Any], Any],
    room: int, errors: str, threads: int, options: Options
) -> tuple[Shots, list[tuple[Any, tuple[int, ...]]]]:  # fmt: skip
    """The shots, and each of their numbers as an `array` (..., elements) with the shape to which it is broadcast, for one array (..., m)."""
    if errors not in ("raise", "nan"):
        raise ValueError(f"errors: must be 'raise' or 'nan', not {errors!r}")
    layouts = of_record(balls, dtypes.shot_ball, "balls", "balls()")
    cues = None if cue is None else of_record(cue, dtypes.cue, "cue", "cue()")
    if layouts.ndim == 0:
        raise ValueError("balls: the shape must be (..., balls), not ()")
    parts: list[Any] = []
    for (name, value), several in zip(numbers.items(), directions(list(numbers), layouts.shape[-1], "numbers")):
        if several[0].array == "table":
            raise ValueError(f"numbers: {name}: a batch has one table; kind.nose_height, kind.mu_cushion and kind.restitution_cushion can differ")
        if several[0].array == "cue" and cue is None:
            raise ValueError(f"numbers: {name}: there is no cue; give one of carom.cue()")
        part = array(value)
        if name == several[0].name:
            part = part[..., None]
        elif tuple(part.shape[-1:]) != (len(several),):
            raise ValueError(f"numbers: {name}: the shape must be (..., {len(several)}), not {tuple(part.shape)}")
        parts.append(part)
    leading = {"balls": layouts.shape[:-1], "cue": () if cues is None else cues.shape}
    batch = broadcast({**leading, **{name: tuple(part.shape[:-1]) for name, part in zip(numbers, parts)}})
    shots = _shots(
        table.record.tobytes(), layouts.tobytes(), layouts.shape, None if cues is None else cues.tobytes(), () if cues is None else cues.shape,
        tuple(numbers), options, threads, room, errors == "nan",
    )  # fmt: skip
    return shots, [(part, (*batch, part.shape[-1])) for part in parts]


def named(states: Any) -> Final:
    """The parts of states (..., balls, STATE)."""
    return Final(**{name: states[..., part] for name, part in PARTS.items()})
