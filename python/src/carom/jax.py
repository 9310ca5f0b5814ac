"""Whole shots as functions that JAX differentiates. This module is an experiment: its names may change in any version.

    import jax
    jax.config.update("jax_enable_x64", True)
    import carom.jax

    def miss(aim):                                             # (speed, phi) of the cue, m/s and degrees
        ends = carom.jax.final(table, balls, cue, {"cue.speed": aim[0], "cue.phi": aim[1]})
        return ((ends.r[1] - goal) ** 2).sum()                 # of ball 1, m^2

    jax.value_and_grad(miss)(aim)
    jax.jit(jax.vmap(jax.grad(miss)))(aims)                    # all shots in one batch

Shots are played and differentiated by C, in callbacks: a batch, or a function under `jax.vmap`, is one batch of `carom.simulate_batch`,
and its derivative one of `carom.tangents`. `grad`, `jacfwd` and `jacrev` all use the Jacobian of `carom.tangents`; second derivatives are not
known. docs/using/derivatives.md says what a derivative cannot tell: `carom.jacobian(..., of="reach")` has its reach.

Needs JAX with 64-bit numbers. Its objects have no types here, so that carom can be checked without it.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from carom import dtypes
from carom._rows import Array, broadcast, listing
from carom._shot_options import Options, chosen
from carom.derivatives import CUE, ELEMENTS, KIND, PARTS, STATE, Direction, directions, play, seeds_of
from carom.layouts import Table, of_record
from carom.shots import simulate, simulate_batch
from carom.status import CaromError, Status

__all__ = ["Final", "final"]
__dir__ = listing(__name__)

try:
    _jax: Any = importlib.import_module("jax")
    _jnp: Any = importlib.import_module("jax.numpy")
except ImportError as missing:
    raise ImportError("carom.jax needs JAX, which is not installed here: pip install jax", name=missing.name) from missing


class Final(NamedTuple):
    """Final states: JAX arrays of float64."""

    r: Any  # (..., balls, 2): Places, m, and velocities, m/s, along x and y
    v: Any  # (..., balls, 2): Places, m, and velocities, m/s, along x and y
    w: Any  # (..., balls, 3): Angular velocities, rad/s
    z: Any  # (..., balls): Heights of the centres, m, and velocities upward, m/s
    v_z: Any  # (..., balls): Heights of the centres, m, and velocities upward, m/s


@dataclass(frozen=True, eq=False)
class _Shots:
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
            for place in direction.places:
                if direction.array == "cue" and cues is not None:
                    cues[CUE[place[0]]] = x[..., j]
                elif direction.array == "kind":
                    name = KIND[place[1]]
                    if name == "radius":
                        # a ball stays as high above the cloth as it is
                        layouts["state"]["r"][..., place[0], 2] += x[..., j] - layouts["kind"]["radius"][..., place[0]]
                    layouts["kind"][name][..., place[0]] = x[..., j]
                elif direction.array == "state":
                    name, elements = next(item for item in ELEMENTS.items() if place[1] in item[1])
                    layouts["state"][name][..., place[0], elements.index(place[1])] = x[..., j]
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
        seeds, none = seeds_of(self.directions, self.count), np.zeros(0)
        found, codes, final = play(self.played_on, layouts, cues, seeds, none, ("final",), self.room, self.threads, self.options)
        played = np.where(np.isin(codes, (Status.ERROR_TANGENT, Status.ERROR_EVENTS_LOST)), 0, codes) if self.nan else codes
        return self.numbers(numbers, final, played), found["final"]

    def numbers(self, x: dtypes.Doubles, final: dtypes.Records, status: Array) -> dtypes.Doubles:
        """Final states as numbers; shots in error are nan, or raise."""
        bad = status < 0
        failed = bool(bad.any())
        if failed and not self.nan:
            first = tuple(int(k) for k in np.argwhere(bad)[0])
            self.refuse(x, first, Status(int(status[first])))
        states: dtypes.Doubles = np.empty((*final.shape, STATE))
        for name, elements in ELEMENTS.items():
            states[..., elements] = final[name]
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
_shots = functools.lru_cache(maxsize=256)(_Shots)


@functools.partial(_jax.custom_jvp, nondiff_argnums=(0,))
def _states(shots: _Shots, x: Any) -> Any:
    shape = _jax.ShapeDtypeStruct((*x.shape[:-1], shots.count, STATE), np.float64)
    return _jax.pure_callback(shots.states, shape, x, vmap_method="expand_dims")


@functools.partial(_jax.custom_jvp, nondiff_argnums=(0,))
def _both(shots: _Shots, x: Any) -> Any:
    states = (*x.shape[:-1], shots.count, STATE)
    shapes = (_jax.ShapeDtypeStruct(states, np.float64), _jax.ShapeDtypeStruct((*states, x.shape[-1]), np.float64))
    return _jax.pure_callback(shots.both, shapes, x, vmap_method="expand_dims")


def _of_states(shots: _Shots, primals: Any, changes: Any) -> Any:
    states, derivatives = _both(shots, primals[0])
    return states, _jnp.einsum("...bsm,...m->...bs", derivatives, changes[0])


def _of_both(shots: _Shots, primals: Any, changes: Any) -> Any:
    raise NotImplementedError("carom.jax: second derivatives of shots are not known; jax.grad, jacfwd and jacrev give first ones")


_states.defjvp(_of_states)
_both.defjvp(_of_both)


def final(
    table: Table, balls: dtypes.Records, cue: dtypes.Records | None, numbers: Mapping[str, Any], *, room: int = 512,
    errors: Literal["raise", "nan"] = "raise", threads: int = 0, options: Options = Options(), **changes: Any
) -> Final:  # fmt: skip
    """The final states of shots, as a function of some of their numbers that JAX can differentiate, compile and map.

    Parameters
    ----------
    table, balls, cue
        The shots, as for `carom.simulate_batch`, where `numbers` say nothing else. Leading dimensions of balls, cue and numbers are broadcast against each other.
    numbers : mapping of str to array_like
        The numbers of the shots that take part in derivatives, by the names of `carom.tangents`: "cue.phi", "kind.mu_slide" (of all
        balls), "balls[1].kind.mass" and "balls[0].r[1]" of shape (...); "balls[0].r", "balls[0].v" (..., 2), "balls[0].w" (..., 3).
        Under `jax.vmap` all shots are one batch, too. Those of the table are left out, as a batch has one table: the balls'
        own "kind.nose_height", "kind.mu_cushion" and "kind.restitution_cushion" are used instead.
    room : int
        Events of a shot at most, where it is differentiated.
    errors : {"raise", "nan"}
        What a shot in error gives: an exception, or nan, so that the other shots of a batch are not lost.
    threads, options, **changes
        As for `carom.simulate_batch`. With t_final the states are those at that time.

    Returns Final.
    Raises ValueError: A name or a shape is wrong.
    Raises TypeError: JAX has no 64-bit numbers: the error says what to set.
    Raises jax.errors.JaxRuntimeError, or ValueError: A shot is refused, ends in an error or cannot be differentiated: the last
    line has its numbers, and what is wrong with it. JAX makes this exception of what a callback raises.
    """
    if _jax.dtypes.canonicalize_dtype(np.float64) != np.float64:
        raise TypeError('carom.jax needs 64-bit numbers: set jax.config.update("jax_enable_x64", True) first, or JAX_ENABLE_X64=1')
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
        array = _jnp.asarray(value, np.float64)
        if name == several[0].name:
            array = array[..., np.newaxis]
        elif array.shape[-1:] != (len(several),):
            raise ValueError(f"numbers: {name}: the shape must be (..., {len(several)}), not {array.shape}")
        parts.append(array)
    leading = {"balls": layouts.shape[:-1], "cue": () if cues is None else cues.shape}
    batch = broadcast({**leading, **{name: part.shape[:-1] for name, part in zip(numbers, parts)}})
    shots = _shots(
        table.record.tobytes(), layouts.tobytes(), layouts.shape, None if cues is None else cues.tobytes(), () if cues is None else cues.shape,
        tuple(numbers), chosen(options, changes), threads, room, errors == "nan",
    )  # fmt: skip
    states = _states(shots, _jnp.concatenate([_jnp.broadcast_to(part, (*batch, part.shape[-1])) for part in parts], axis=-1))
    return Final(**{name: states[..., part] for name, part in PARTS.items()})
