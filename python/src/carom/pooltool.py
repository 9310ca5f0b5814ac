"""Shots of the simulator pooltool, played by carom: takes a pooltool System and fills it as pooltool's own `simulate` does.

    import pooltool as pt
    import carom.pooltool
    system = carom.pooltool.simulate(pt.System.example())      # or carom.pooltool.install(), and pt.simulate as before

Needs pooltool 0.6 (pooltool-billiards). Its objects have no types here, so that carom can be checked without it.
"""

from __future__ import annotations

import importlib
import sys
import types
import warnings
from typing import Any, Literal

import numpy as np

from carom import dtypes
from carom._rows import Array
from carom._pooltool_fill import fill
from carom._pooltool_models import ExactBallBall, ExactCircularCushion, ExactLinearCushion
from carom.collisions import alciatore
from carom.layouts import Table
from carom.shots import BallModel, Friction, ShotCushion
from carom.shots import simulate as _play
from carom.status import CaromError

__all__ = [
    "ExactBallBall",
    "ExactCircularCushion",
    "ExactLinearCushion",
    "FallbackWarning",
    "UnsupportedError",
    "balls_of",
    "cue_of",
    "install",
    "simulate",
    "table_of",
    "uninstall",
]

Models = Literal["pooltool", "carom"]

_pt: Any = importlib.import_module("pooltool")
_simulate: Any = importlib.import_module("pooltool.evolution.event_based.simulate")

_pooltools_simulate: Any = _simulate.simulate

# The models of the default engine of pooltool.
_ENGINE = {"stick_ball": "InstantaneousPoint", "ball_pocket": "CanonicalBallPocket", "transition": "CanonicalTransition"}
_CUSHIONS: dict[str, ShotCushion] = {"StrongeCompliant": "stronge", "Han2005": "han"}


class UnsupportedError(ValueError):
    """What is asked for is pooltool's alone; `simulate(..., fallback=True)` lets pooltool do it."""


class FallbackWarning(UserWarning):
    """pooltool plays a system, at its own speed, because carom cannot. Each reason is told once."""


# ---- What goes in -------------------------------------------------------------------------------------------------------


def table_of(table: Any) -> Table:
    """The table of a System, for `carom.simulate`."""
    segments = table.cushion_segments
    linear, circular, holes = segments.linear.values(), segments.circular.values(), table.pockets.values()
    for segment in linear:
        if segment.direction not in (0, 1):
            raise UnsupportedError(f"cushion {segment.id!r} has balls on both sides: carom takes direction 0 or 1")
    rails: Array = np.array(
        [(c.p1[:2], c.p2[:2], c.height, (c.lx, c.ly, c.l0), c.direction, 0.0, 0.0) for c in linear], dtype=dtypes.rail
    )
    jaws: Array = np.array([(c.center[:2], c.radius, c.height, 0.0, 0.0) for c in circular], dtype=dtypes.jaw)
    pockets: Array = np.array([(p.center[:2], p.radius, p.depth) for p in holes], dtype=dtypes.pocket)
    # Width and length are for pictures; a table that is not made of pooltool's own parts may have none.
    ends = np.concatenate([rails["p"], rails["q"]])
    low, high = (ends.min(axis=0), ends.max(axis=0)) if len(ends) else (np.zeros(2), np.ones(2))
    return Table(float(high[0] - low[0]), float(high[1] - low[1]), rails=rails, jaws=jaws, pockets=pockets)


def balls_of(system: Any) -> dtypes.Records:
    """The balls of a System, in its order, for `carom.simulate`."""
    numbers: list[Any] = []
    own = (0.0,) * 7  # drag and what follows it, which pooltool has not
    for ball in system.balls.values():
        p, rvw = ball.params, ball.state.rvw
        kind = (p.m, p.R, p.u_s, p.u_r, p.u_sp, p.u_b, p.e_b, p.f_c, p.e_c, p.g, *own)
        numbers.append((kind, (rvw[0], rvw[1], rvw[2], ball.state.s)))
    return np.array(numbers, dtype=dtypes.shot_ball)


def cue_of(system: Any) -> dtypes.Records:
    """The cue of a System, for `carom.simulate`."""
    cue, specs = system.cue, system.cue.specs
    ball = list(system.balls).index(cue.cue_ball_id)
    numbers = (cue.V0, cue.phi, cue.theta, cue.a, cue.b, specs.M, specs.end_mass, specs.tip_radius, ball)
    return np.array(numbers, dtype=dtypes.cue)


def _models_of(resolver: Any) -> tuple[BallModel, ShotCushion, Friction, int]:
    """The models of carom that are those of an engine of pooltool's, or an error that says which is not."""
    for part, name in _ENGINE.items():
        if type(getattr(resolver, part)).__name__ != name:
            raise UnsupportedError(f"engine: carom knows {name} alone for {part}, not {type(getattr(resolver, part)).__name__}")
    if (resolver.stick_ball.english_throttle, resolver.stick_ball.squirt_throttle) != (1.0, 1.0):
        raise UnsupportedError("engine: carom knows a stick_ball with throttles of 1 alone")
    pair = resolver.ball_ball
    models: dict[str, BallModel] = {"FrictionalInelastic": "inelastic", "FrictionalMathavan": "euler"}
    ball_model = models.get(type(pair).__name__)
    if ball_model is None:
        raise UnsupportedError(f"engine: carom knows {', '.join(models)} for ball_ball, not {type(pair).__name__}")
    friction: Friction = "constant"
    if type(pair.friction).__name__ == "AlciatoreBallBallFriction":
        friction = "alciatore"
        if (pair.friction.a, pair.friction.b, pair.friction.c) != alciatore():
            raise UnsupportedError(f"engine: carom knows Alciatore's friction with a, b, c = {alciatore()} alone")
    elif type(pair.friction).__name__ != "AverageBallBallFriction":
        raise UnsupportedError(f"engine: carom does not know the friction {type(pair.friction).__name__}")
    linear, circular = resolver.ball_linear_cushion, resolver.ball_circular_cushion
    name = type(linear).__name__.removesuffix("Linear")
    cushion_model = _CUSHIONS.get(name)
    if cushion_model is None or type(circular).__name__ != f"{name}Circular":
        known = ", ".join(_CUSHIONS)
        raise UnsupportedError(f"engine: carom knows {known}, the same for linear and circular cushions, not {name}")
    if cushion_model == "stronge" and (linear.omega_ratio, circular.omega_ratio) != (1.8, 1.8):
        raise UnsupportedError("engine: carom knows an omega_ratio of 1.8 alone in whole shots")
    return ball_model, cushion_model, friction, int(getattr(pair, "num_iterations", 0))


def simulate(
    shot: Any,
    engine: Any = None,
    inplace: bool = False,
    continuous: bool = False,
    dt: float | None = None,
    t_final: float | None = None,
    include: Any = _simulate.INCLUDED_EVENTS,
    max_events: int = 0,
    *,
    models: Models = "pooltool",
    cushion_model: ShotCushion = "default",
    fallback: bool = False,
) -> Any:
    """pooltool's `simulate`, by carom.

    Parameters
    ----------
    shot : pooltool.System
        Simulated as a copy, unless `inplace`.
    engine : pooltool.physics.PhysicsEngine, optional
        None: pooltool's default. Ball and ball FrictionalInelastic or FrictionalMathavan, cushions StrongeCompliant or Han2005.
    inplace, continuous, dt, t_final, max_events
        As for pooltool's.
    include : set of pooltool.EventType
        All of them.
    models : {"pooltool", "carom"}
        The rules and models of pooltool's engine, for the same history but for rounding; or carom's, without an engine: exact
        collisions and contacts.
    cushion_model : {"default", "mathavan", "stronge", "han", "mirror", "euler"}
        With models="carom" only; as for `carom.simulate`.
    fallback : bool
        What carom cannot do is played by pooltool instead of an error. A `FallbackWarning` says why, once for each reason.

    Returns
    -------
    pooltool.System
        Events with their agents before and after, the balls' states and histories, pockets and their contents, as pooltool
        leaves them.

    Raises
    ------
    UnsupportedError
        An engine, a table or an `include` that is pooltool's alone.
    CaromError
        A System that carom refuses (overlapping balls, a ball off the table, more than 32 balls), or a shot that ends in an error.
    """
    try:
        if models not in ("pooltool", "carom"):
            raise ValueError(f"models: must be 'pooltool' or 'carom', not {models!r}")
        if set(include) != set(_simulate.INCLUDED_EVENTS):
            raise UnsupportedError("include: carom resolves all types of events")
        table, balls, cue = table_of(shot.table), balls_of(shot), cue_of(shot)
        if models == "pooltool":
            resolver = (engine or _simulate.DEFAULT_ENGINE).resolver
            ball_model, of_cushion, friction, steps = _models_of(resolver)
            played = _play(
                table,
                balls,
                cue,
                world="pooltool",
                ball_model=ball_model,
                cushion_model=of_cushion,
                friction=friction,
                steps=steps,
            )
        else:
            if engine is not None:
                raise UnsupportedError("engine: with models='carom' the models are carom's")
            played = _play(table, balls, cue, cushion_model=cushion_model, space="flat")  # as pooltool's 2D engine
    except (UnsupportedError, CaromError) as reason:
        if not fallback:
            raise
        _tell(reason)
        return _pooltools_simulate(shot, engine, inplace, continuous, dt, t_final, include, max_events)
    system = shot if inplace else shot.copy()
    kept, stopped = played.count, False
    if t_final is not None:
        # pooltool ends with the first event that is not before t_final.
        kept = min(kept, int(np.searchsorted(played.events["time"], t_final, side="left")) + 1)
    if 0 < max_events < kept - 1:
        # pooltool looks after the event, and counts from 0.
        kept, stopped = max_events + 2, True
    fill(system, played, kept, stopped)
    if continuous:
        _pt.continuize(system, dt=0.01 if dt is None else dt, inplace=True)
    return system


_told: set[object] = set()


def _tell(reason: UnsupportedError | CaromError) -> None:
    """Warns, once for each reason, whoever called simulate() from outside this module."""
    kind = reason.status if isinstance(reason, CaromError) else str(reason)
    if kind in _told:
        return
    _told.add(kind)
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals is globals():
        level, frame = level + 1, frame.f_back
    warnings.warn(f"pooltool plays this system instead of carom: {reason}", FallbackWarning, stacklevel=level)


# ---- In its place -------------------------------------------------------------------------------------------------------


def _replace(old: Any, new: Any) -> None:
    """Under every name that the old function has in a module, but in this one, which keeps both."""
    for name, module in list(sys.modules.items()):
        if name != __name__ and issubclass(type(module), types.ModuleType):
            # Not by vars(), which would load a module that waits for its first use.
            names = object.__getattribute__(module, "__dict__")
            for its in [its for its, value in list(names.items()) if value is old]:
                names[its] = new


def install() -> None:
    """Put carom in place of `pooltool.simulate`: in pooltool, and in every module that has imported it by now under any name.

    What carom cannot do is then played by pooltool; a `FallbackWarning` says why, once for each reason.
    """
    _told.clear()
    _replace(_pooltools_simulate, _installed)


def uninstall() -> None:
    """Put `pooltool.simulate` back."""
    _replace(_installed, _pooltools_simulate)


def _installed(
    shot: Any,
    engine: Any = None,
    inplace: bool = False,
    continuous: bool = False,
    dt: float | None = None,
    t_final: float | None = None,
    include: Any = _simulate.INCLUDED_EVENTS,
    max_events: int = 0,
) -> Any:
    return simulate(shot, engine, inplace, continuous, dt, t_final, include, max_events, fallback=True)


_installed.__name__ = _installed.__qualname__ = "simulate"
_installed.__doc__ = _pooltools_simulate.__doc__
