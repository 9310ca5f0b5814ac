"""Derivatives of shots: how final states, events and states at times change with the cue, the balls and their constants.

A derivative is exact for small changes and says nothing about larger ones: see `Tangents.reach` and `Tangents.flags`.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Array, as_array, pointer
from carom.layouts import Table, of_record
from carom.results import Shot
from carom._shot_options import shot_options
from carom.shots import simulate_batch
from carom.status import CaromError

MOST = 64
"""Directions of one call of C; more are given in parts."""
_CUE = ("speed", "phi", "theta", "a", "b", "mass", "end_mass")
_KIND = tuple(dtypes.ball_kind.names or ())
_STATE = {"r": (0, 2), "v": (2, 2), "w": (4, 3)}
_TABLE = ("nose_height", "mu_cushion", "restitution")
_UNITS = {"speed": "m/s", "phi": "deg", "theta": "deg", "a": "R", "b": "R", "mass": "kg", "end_mass": "kg", "radius": "m", "gravity": "m/s^2"}
_UNITS |= {"drag": "1/m", "law_c": "s/m", "nose_height": "m", "r": "m", "v": "m/s", "w": "rad/s"}


class Flag(enum.IntFlag):
    """What a derivative at an event has to be read with; `carom_tangent.h` explains each."""

    GRAZING = 1
    SLOW = 2
    SIMULTANEOUS = 4
    KINK = 8
    EULER = 16
    DIFFERENCES = 32
    DRAG = 64


class Tangents:
    """Derivatives of a shot, or of many: the last dimension is that of the directions, m.

    Attributes
    ----------
    names, units : tuple of str
        What changes in each direction, and the unit that derivatives are per.
    final : dict of ndarray
        "r" of shape (..., balls, 2, m), m; "v" likewise, m/s; "w" (..., balls, 3, m), rad/s: of the final states.
    at : dict of ndarray
        The same of the states at `times`, of shape (..., times, balls, 2 or 3, m).
    time : ndarray, shape (..., events, m)
        Of the times of the events, s. nan beyond the events of a shot.
    flags : ndarray of int32, shape (..., events)
        Sums of `Flag`; -1 beyond the events.
    reach : ndarray, shape (..., m)
        The least change in each direction, in its unit, at which to first order a ball meets something else, or in another order.
    error : ndarray, shape (...)
        The largest relative error of what had to be found by differences.
    status : ndarray of int8, shape (...)
        As `carom.Status`; derivatives of a shot in error are nan.
    """

    def __init__(self, names: tuple[str, ...], units: tuple[str, ...], shape: tuple[int, ...], balls: int, events: int, times: int) -> None:
        m = len(names)
        self.names = names
        self.units = units
        self.states: dtypes.Doubles = np.full((*shape, balls, 7, m), np.nan)
        self.states_at: dtypes.Doubles = np.full((*shape, times, balls, 7, m), np.nan)
        self.time: dtypes.Doubles = np.full((*shape, events, m), np.nan)
        self.flags: npt.NDArray[np.int32] = np.full((*shape, events), -1, np.int32)
        self.reach: dtypes.Doubles = np.full((*shape, m), np.nan)
        self.error: dtypes.Doubles = np.zeros(shape)
        self.status: npt.NDArray[np.int8] = np.zeros(shape, np.int8)

    @property
    def final(self) -> dict[str, dtypes.Doubles]:
        """Of the final states."""
        return _by_name(self.states)

    @property
    def at(self) -> dict[str, dtypes.Doubles]:
        """Of the states at the times that were asked for."""
        return _by_name(self.states_at)

    def __repr__(self) -> str:
        return f"<carom.Tangents: {self.states.shape[:-3]}, by {', '.join(self.names)}>"


def _by_name(states: dtypes.Doubles) -> dict[str, dtypes.Doubles]:
    return {name: states[..., first : first + many, :] for name, (first, many) in _STATE.items()}


def _seeds(wrt: Sequence[str], balls: int) -> tuple[tuple[str, ...], tuple[str, ...], dict[str, dtypes.Doubles]]:
    """The directions of names: cue.phi; kind.mu_slide of all balls; balls[1].kind.mass; balls[0].r, both places, or balls[0].r[1]."""
    found: list[tuple[str, str, tuple[str, list[tuple[int, ...]]]]] = []
    for name in wrt:
        match = re.fullmatch(r"(cue|table|kind|balls\[(\d+)\])\.(?:(kind)\.)?(\w+)(?:\[(\d)\])?", name)
        group, ball, inner, field, index = match.groups() if match else ("", None, None, "", None)
        unit = _UNITS.get(field, "1")
        if group == "cue" and field in _CUE and index is None and not inner:
            found.append((name, unit, ("cue", [(_CUE.index(field),)])))
        elif group == "table" and field in _TABLE and index is None and not inner:
            found.append((name, unit, ("table", [(_TABLE.index(field),)])))
        elif group == "kind" and field in _KIND and index is None and not inner:
            found.append((name, unit, ("kind", [(i, _KIND.index(field)) for i in range(balls)])))
        elif ball is not None and int(ball) < balls and inner and field in _KIND and field != "radius" and index is None:
            found.append((name, unit, ("kind", [(int(ball), _KIND.index(field))])))
        elif ball is not None and int(ball) < balls and not inner and field in _STATE and (index is None or int(index) < _STATE[field][1]):
            first, many = _STATE[field]
            for k in range(many) if index is None else [int(index)]:
                found.append((f"balls[{ball}].{field}[{k}]", unit, ("state", [(int(ball), first + k)])))
        else:
            raise ValueError(
                f"wrt: {name!r} is no number of a shot; such are cue.phi, kind.mu_slide (of all balls), balls[1].kind.mass, "
                f"balls[0].r[1] and table.nose_height, with 0 to {balls - 1} for balls"
            )
    if not found:
        raise ValueError("wrt: name at least one number, such as 'cue.phi'")
    m = len(found)
    seeds = {
        "cue": np.zeros((len(_CUE), m)),
        "kind": np.zeros((balls, len(_KIND), m)),
        "state": np.zeros((balls, 7, m)),
        "table": np.zeros((len(_TABLE), m)),
    }
    for j, (_, _, (array, places)) in enumerate(found):
        for place in places:
            seeds[array][(*place, j)] = 1.0
    return tuple(f[0] for f in found), tuple(f[1] for f in found), seeds


def _differentiate(
    table: Table, balls: Array, cue: Array | None, events: Array, time: float, options: Any, seeds: dict[str, dtypes.Doubles], times: Array, to: Tangents, where: tuple[int, ...]
) -> None:
    """The tangents of one shot into `to`, in parts of as many directions as C takes."""
    m, n = len(to.names), len(balls)
    shot = ffi.new("carom_shot *", {"events": pointer("carom_event[]", events), "room": len(events), "count": len(events), "time": time})
    for first in range(0, m, MOST):
        part = slice(first, min(first + MOST, m))
        width = part.stop - part.start
        rows = {name: np.ascontiguousarray(seed[..., part]) for name, seed in seeds.items()}
        final, moments, reach = np.zeros((n, 7, width)), np.zeros((len(events), width)), np.zeros(width)
        states, flags = np.zeros((len(times), n, 7, width)), np.zeros(len(events), np.int32)
        of_c = ffi.new("carom_tangent_seeds *", {"directions": width, **{name: pointer("double[]", row) for name, row in rows.items()}})
        results = {"final": final, "time": moments, "reach": reach, "at": states, "times": times}
        tangent = ffi.new(
            "carom_tangent *",
            {
                **{name: pointer("double[]", array) for name, array in results.items()},
                "times_count": len(times),
                "flags": pointer("int32_t[]", flags),
            },
        )
        struck = ffi.NULL if cue is None else pointer("carom_cue[]", cue)
        code = lib.carom_shot_tangent(
            pointer("carom_table[]", table.record), pointer("carom_shot_ball[]", balls), n, struck, options, shot, of_c, tangent
        )
        to.status[where] = code
        if code < 0:
            return
        to.states[where][..., part] = final
        to.states_at[where][..., part] = states
        to.time[where][: len(events), part] = moments
        to.reach[where][part] = reach
        to.flags[where][: len(events)] = flags
        to.error[where] = max(to.error[where], tangent.error)


def _sorted_times(times: npt.ArrayLike | None) -> Array:
    at = np.zeros(0) if times is None else np.ascontiguousarray(as_array(times, "times", np.float64))
    if at.ndim != 1 or not np.isfinite(at).all() or (np.diff(at) < 0).any():
        raise ValueError("times: finite numbers of seconds in ascending order are needed, of shape (times,)")
    return at


def tangents(
    shot: Shot,
    cue: dtypes.Records | None,
    wrt: Sequence[str],
    *,
    times: npt.ArrayLike | None = None,
) -> Tangents:
    """Differentiate a shot that `carom.simulate` has played.

    Parameters
    ----------
    shot : Shot
        With all of its events.
    cue : ndarray of `carom.dtypes.cue`, shape ()
        That of the shot; None if there was none.
    wrt : sequence of str
        By what: "cue.phi" and other numbers of the cue; "kind.mu_slide" of all balls, "balls[1].kind.mass" of one;
        "balls[0].r" (two directions), "balls[0].r[1]", v, w; "table.nose_height", "table.mu_cushion", "table.restitution".
    times : array_like, shape (times,), optional
        s, ascending: for `Tangents.at`.

    Returns
    -------
    Tangents

    Raises
    ------
    CaromError
        Derivatives are not known for this shot: in the world pooltool, by Euler's model of balls, where a ball flies.
    """
    if not isinstance(shot, Shot):
        raise TypeError(f"shot: what carom.simulate() gives is needed, not {type(shot).__name__}")
    names, units, seeds = _seeds(wrt, len(shot.balls))
    at = _sorted_times(times)
    if shot.options is None:
        raise ValueError("shot: it does not know by which models it was played; give one of carom.simulate()")
    options = shot_options(*shot.options[:7], None, (), 0)
    found = Tangents(names, units, (), len(shot.balls), len(shot.events), len(at))
    if shot.count > len(shot.events):
        raise CaromError(-54)
    struck = None if cue is None else of_record(cue, dtypes.cue, "cue", "cue()").reshape(1)
    _differentiate(shot.table, np.ascontiguousarray(shot.balls), struck, np.ascontiguousarray(shot.events), shot.time, options, seeds, at, found, ())
    if found.status < 0:
        raise CaromError(int(found.status))
    return found


def jacobian(
    table: Table,
    layouts: dtypes.Records,
    cues: dtypes.Records | None,
    wrt: Sequence[str],
    *,
    of: str = "final.r",
    times: npt.ArrayLike | None = None,
    room: int = 512,
    **models: Any,
) -> dtypes.Doubles:
    """Play shots and give one derivative of each, with leading batch dimensions.

    Parameters
    ----------
    table, layouts, cues
        As for `carom.simulate_batch`.
    wrt : sequence of str
        As for `tangents`.
    of : str
        "final.r", "final.v", "final.w"; "at.r", "at.v", "at.w" at `times`; "time" of the events; or "reach".
    room : int
        Events of a shot at most; a shot with more has nan.
    models
        ball_model, cushion_model, friction, space and so on, as for `carom.simulate_batch`.

    Returns
    -------
    ndarray of float64
        (..., balls, 2, m) for "final.r"; nan for shots in error.
    """
    group, _, field = str(of).partition(".")
    if (group not in ("final", "at") or field not in _STATE) and of not in ("time", "reach"):
        raise ValueError(f"of: must be final.r, final.v, final.w, at.r, at.v, at.w, time or reach, not {of!r}")
    shots = simulate_batch(table, layouts, cues, room=room, **models)
    balls = shots.final.shape[-1]
    names, units, seeds = _seeds(wrt, balls)
    at = _sorted_times(times)
    options = shot_options(*shots.options[:7], None, (), 0)
    found = Tangents(names, units, shots.shape, balls, int(np.minimum(shots.count, room).max(initial=0)), len(at))
    all_cues = None if shots.cues is None else np.broadcast_to(shots.cues, shots.shape)
    all_balls = np.broadcast_to(shots.layouts.reshape(balls) if shots.layouts.size == balls else shots.layouts, shots.final.shape)
    for where in np.ndindex(shots.shape):
        count = int(shots.count[where])
        if shots.status[where] < 0 or count > room:
            continue
        cue = None if all_cues is None else np.array(all_cues[where]).reshape(1)
        events = np.ascontiguousarray(shots.events[where][:count])
        _differentiate(table, np.array(all_balls[where]), cue, events, float(shots.time[where]), options, seeds, at, found, where)
    if of in ("time", "reach"):
        return found.time if of == "time" else found.reach
    return (found.final if group == "final" else found.at)[field]
