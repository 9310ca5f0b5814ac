"""Play shots of the simulator pooltool with carom.

Fills a pooltool System as pooltool's own `simulate` does.

    import pooltool as pt
    import carom.pooltool
    system = carom.pooltool.simulate(pt.System.example())      # or carom.pooltool.install(), and
        pt.simulate as before

Needs pooltool 0.6 (pooltool-billiards), or the head of its repository. Its objects have no types
here, so that carom can be checked without it.
"""

from __future__ import annotations

import functools
import importlib
import struct
import sys
import types
import warnings
from collections.abc import Collection
from typing import Any, Literal

import numpy as np

from carom import dtypes
from carom._rows import Array, Seed, either, listing, seed_of, unknown_value
from carom._shot_options import BallModel, Friction, Options, ShotCushion
from carom.collisions import alciatore
from carom.dtypes import Records
from carom.games.plans import plan, player as usual_player, with_errors
from carom.games._described import Group
from carom.layouts import LAST, Table
from carom.pooltool._fill import fill
from carom.pooltool._models import ExactBallBall, ExactCircularCushion, ExactLinearCushion
from carom.results import Label
from carom.shots import simulate as _play
from carom.status import CaromError

__all__ = [
    "Agent",
    "ExactBallBall",
    "ExactCircularCushion",
    "ExactLinearCushion",
    "FallbackWarning",
    "UnsupportedError",
    "balls_of",
    "cue_of",
    "install",
    "original",
    "simulate",
    "table_of",
    "uninstall",
]
__dir__ = listing(__name__)

Models = Literal["pooltool", "carom"]

_pt: Any = importlib.import_module("pooltool")
_simulate: Any = importlib.import_module("pooltool.evolution.event_based.simulate")
_action: Any = importlib.import_module("pooltool.ai.action")

original: Any = _simulate.simulate
"""pooltool's own `simulate`, for comparison, even after `install`."""

# The strategies of pooltool's engines, and carom's, that carom can play; InstantaneousPoint2D is in
# the head of pooltool's repository.
_FIXED = {
    "stick_ball": ("InstantaneousPoint", "InstantaneousPoint2D"),
    "ball_pocket": ("CanonicalBallPocket",),
    "transition": ("CanonicalTransition",),
}
_PAIRS: dict[str, BallModel] = {
    "FrictionalInelastic": "inelastic",
    "FrictionalMathavan": "euler",
    "FrictionlessElastic": "mirror",
    "ExactBallBall": "exact",
}
_CUSHIONS: dict[str, ShotCushion] = {
    "StrongeCompliant": "stronge",
    "Han2005": "han",
    "Mathavan2010": "euler",
    "Unrealistic": "mirror",
    "ExactCushion": "mathavan",
}
_FRICTIONS: dict[str, Friction] = {
    "AlciatoreBallBallFriction": "alciatore",
    "AverageBallBallFriction": "constant",
}
_ALCIATORE = alciatore()


class UnsupportedError(ValueError):
    """Only pooltool supports this; with `simulate(..., fallback=True)` pooltool plays the shot."""


class FallbackWarning(UserWarning):
    """pooltool plays a system, at its own speed, because carom cannot.

    Each reason is reported once.
    """


# ---- Input
# -------------------------------------------------------------------------------------------------------


def table_of(table: Any) -> Table:
    """The table of a System, for `carom.simulate`."""
    segments = table.cushion_segments
    linear, circular = tuple(segments.linear.values()), tuple(segments.circular.values())
    pockets = tuple((p.center, p.radius, p.depth) for p in table.pockets.values())
    # Segments and centres of pockets never change, and tables share them with their copies. A
    # cached table keeps them, so an id stays theirs.
    key = (
        *map(id, linear),
        None,
        *map(id, circular),
        *((id(centre), radius, depth) for centre, radius, depth in pockets),
    )
    cached = _tables.get(key)
    if cached is None:
        if len(_tables) >= 16:
            _tables.clear()
        cached = _tables[key] = (_table_of(linear, circular, pockets), (linear, circular, pockets))
    return cached[0]


_tables: dict[tuple[Any, ...], tuple[Table, Any]] = {}


def _table_of(linear: tuple[Any, ...], circular: tuple[Any, ...], holes: tuple[Any, ...]) -> Table:
    rails = []
    for segment in linear:
        if segment.direction not in (0, 1):
            raise UnsupportedError(
                f"table: cushion {segment.id!r} can be hit from both sides; carom supports direction 0 or 1"
            )
        (x, y, height), (other_x, other_y, _) = (
            np.asarray(end, np.float64).tolist() for end in (segment.p1, segment.p2)
        )
        # The line in pooltool's form, lx, ly and l0; their signs define `side`.
        slope = (other_y - y) / (other_x - x) if other_x != x else None
        line = (1.0, 0.0, -x) if slope is None else (-slope, 1.0, slope * x - y)
        rails.append(((x, y), (other_x, other_y), height, line, segment.direction, 0.0, 0.0))
    # Plain numbers: arrays as small as these take ten times as long.
    jaws = [(c.center[:2].tolist(), c.radius, c.center[2], 0.0, 0.0) for c in circular]
    pockets = [(centre[:2].tolist(), radius, depth) for centre, radius, depth in holes]
    # The bed reaches from rail to rail, except for the oblique rails in the mouths of pockets.
    # (A System's own table.w and table.l need segments with the names of pooltool's tables.)
    size = []
    for axis in range(2):
        across = [rail for rail in rails if abs(rail[0][axis] - rail[1][axis]) < 1e-9] or rails
        ends = [end[axis] for rail in across for end in rail[:2]]
        size.append(max(ends) - min(ends) if ends else 1.0)
    pieces: list[Records] = [
        np.array(*part)
        for part in ((rails, dtypes.rail), (jaws, dtypes.jaw), (pockets, dtypes.pocket))
    ]
    return Table(size[0], size[1], rails=pieces[0], jaws=pieces[1], pockets=pieces[2])


def balls_of(system: Any) -> Records:
    """The balls of a System, in its order, for `carom.simulate`."""
    kinds: dict[int, bytes] = {}
    records = bytearray()
    for ball in system.balls.values():
        # Balls of a rack share their constants. Fields that pooltool lacks, from drag on, stay 0.
        p, state = ball.params, ball.state
        if id(p) not in kinds:
            kinds[id(p)] = struct.pack(
                "10d", p.m, p.R, p.u_s, p.u_r, p.u_sp, p.u_b, p.e_b, p.f_c, p.e_c, p.g
            ).ljust(dtypes.ball_kind.itemsize, b"\0")
        records += (
            kinds[id(p)] + np.asarray(state.rvw, np.float64).tobytes() + struct.pack("q", state.s)
        )
    return np.frombuffer(records, dtypes.shot_ball)


def cue_of(system: Any) -> Records:
    """The cue of a System, for `carom.simulate`."""
    cue, specs = system.cue, system.cue.specs
    ball = list(system.balls).index(cue.cue_ball_id)
    numbers = (
        cue.V0,
        cue.phi,
        cue.theta,
        cue.a,
        cue.b,
        specs.M,
        specs.end_mass,
        1.0,
        specs.tip_radius,
        ball,
        0.0,
        0.0,
        0.0,
    )
    return np.array(numbers, dtype=dtypes.cue)


def _name(part: Any) -> str:
    """The class name of a part of an engine."""
    return _named(part.__class__)


@functools.lru_cache(maxsize=64)
def _named(kind: Any) -> str:
    """The name of a class, without its module if it belongs to pooltool or carom."""
    ours = kind.__module__.partition(".")[0] in ("pooltool", "carom")
    return str(kind.__name__) if ours else f"{kind.__module__}.{kind.__qualname__}"


def _one_of(known: Collection[str], name: str, part: str) -> None:
    if name not in known:
        raise UnsupportedError(
            f"engine: {part} is {name}, which carom does not support; use {either(known)}"
        )


def _options_of(engine: Any, table: Table, balls: Records) -> tuple[Options, Table]:
    """The options and the table for an engine of pooltool; raises UnsupportedError.

    Some parameters of pooltool's models belong to balls, rails and jaws in carom; the balls are
    modified.
    """
    resolver, kinds = engine.resolver, balls["kind"]
    if getattr(engine, "is_3d", False):
        raise UnsupportedError(
            "engine: is_3d is True; carom supports only is_3d=False, balls that stay on the cloth"
        )
    for part, known in _FIXED.items():
        _one_of(known, _name(getattr(resolver, part)), part)
    if (resolver.stick_ball.english_throttle, resolver.stick_ball.squirt_throttle) != (1.0, 1.0):
        raise UnsupportedError(
            "engine: a throttle of stick_ball is not 1, the only value that carom supports"
        )

    pair, steps = resolver.ball_ball, set()
    _one_of(_PAIRS, _name(pair), "ball_ball")
    ball_model = _PAIRS[_name(pair)]
    friction: Friction = "constant"
    if ball_model == "mirror":
        kinds["restitution"] = 1.0
    else:
        _one_of(_FRICTIONS, _name(pair.friction), "friction")
        friction = _FRICTIONS[_name(pair.friction)]
    if ball_model == "euler":
        steps.add(int(pair.num_iterations))
    if (
        friction == "alciatore"
        and (law := (pair.friction.a, pair.friction.b, pair.friction.c)) != _ALCIATORE
    ):
        kinds["law_a"], kinds["law_b"], kinds["law_c"] = law
        if not any(law):  # zeros would select the default law
            friction, kinds["mu_ball"] = "constant", 0.0

    linear, circular = resolver.ball_linear_cushion, resolver.ball_circular_cushion
    name = _name(linear).replace("Linear", "")
    if _name(circular).replace("Circular", "") != name:
        raise UnsupportedError(
            f"engine: the cushions have the models {name} and {_name(circular)}; carom needs the same model for both kinds"
        )
    _one_of(_CUSHIONS, name, "cushions")
    cushion_model = _CUSHIONS[name]
    numbers = {"stronge": ("omega_ratio",), "euler": ("max_steps", "delta_p")}.get(
        cushion_model, ()
    )
    for number in numbers:
        if getattr(linear, number) != getattr(circular, number):
            raise UnsupportedError(
                f"engine: {number} differs between the two kinds of cushions; carom needs the same value"
            )
    if cushion_model == "stronge":
        kinds["omega_ratio"] = linear.omega_ratio
    elif cushion_model == "mirror":
        rails, jaws = table.rails.copy(), table.jaws.copy()
        rails["restitution"] = 0.0 if linear.restitution else 1.0
        jaws["restitution"] = 0.0 if circular.restitution else 1.0
        table = table.changed(rails=rails, jaws=jaws)
    elif cushion_model == "euler":
        steps.add(int(linear.max_steps))
        if linear.delta_p != 0.001:
            raise UnsupportedError(
                f"engine: delta_p of Mathavan2010 is {linear.delta_p} N s; carom supports only 0.001"
            )
    if len(steps) > 1:
        raise UnsupportedError(
            "engine: FrictionalMathavan and Mathavan2010 have different numbers of steps; carom needs the same number"
        )
    most = next(iter(steps), 0)
    return Options("pooltool", ball_model, cushion_model, friction, steps=most), table


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
    """Simulate a System with carom, with the interface of pooltool's `simulate`.

    Parameters
    ----------
    shot : pooltool.System
        The System; it is copied unless `inplace` is true.
    engine : pooltool.physics.PhysicsEngine, optional
        Default: pooltool's. Supported are, for two balls, FrictionalInelastic, FrictionalMathavan,
        FrictionlessElastic and `ExactBallBall`; for cushions StrongeCompliant, Han2005,
        Mathavan2010, Unrealistic, and `ExactLinearCushion` with `ExactCircularCushion`.
    inplace, continuous, dt, t_final, max_events
        As for pooltool's `simulate`.
    include : set of pooltool.EventType
        Must contain all types.
    models : {"pooltool", "carom"}
        "pooltool": the rules and models of pooltool's engine, for the same history up to rounding.
        "carom": carom's own rules and exact models, without an engine.
    cushion_model : str
        As for `carom.simulate`; only with models="carom".
    fallback : bool
        Whether pooltool plays what carom does not support, instead of an error. A `FallbackWarning`
        reports each reason once.

    Returns
    -------
    pooltool.System
        With the same contents as after pooltool's `simulate`: events with their agents, states,
        histories, and pockets with their balls.

    Raises
    ------
    UnsupportedError
        Only pooltool supports this engine, table or `include`.
    CaromError
        The System is invalid for carom (overlapping balls, a ball off the table, more than 32
        balls), or the shot fails.
    """
    try:
        if models not in ("pooltool", "carom"):
            raise ValueError(unknown_value("models", models, ("pooltool", "carom")))
        if set(include) != set(_simulate.INCLUDED_EVENTS):
            raise UnsupportedError(
                "include: some types of events are missing; carom always resolves all types"
            )
        table, balls, cue = table_of(shot.table), balls_of(shot), cue_of(shot)
        if models == "pooltool":
            options, table = _options_of(engine or _simulate.DEFAULT_ENGINE, table, balls)
            played = _play(table, balls, cue, options=options)
        else:
            if engine is not None:
                raise UnsupportedError(
                    "engine: not allowed with models='carom'; omit it, or use models='pooltool'"
                )
            played = _play(
                table, balls, cue, cushion_model=cushion_model, space="flat"
            )  # as pooltool's 2D engine
    except (UnsupportedError, CaromError) as reason:
        if not fallback:
            raise
        _tell(reason)
        return original(shot, engine, inplace, continuous, dt, t_final, include, max_events)
    system = shot if inplace else shot.copy()
    retained, stopped = played.count, False
    if t_final is not None:
        # pooltool ends with the first event that is not before t_final.
        retained = min(
            retained, int(np.searchsorted(played.events["time"], t_final, side="left")) + 1
        )
    if 0 < max_events < retained - 1:
        # pooltool looks after the event, and counts from 0.
        retained, stopped = max_events + 2, True
    fill(system, played, retained, stopped, (0.01 if dt is None else dt) if continuous else None)
    return system


_told: set[object] = set()


def _tell(reason: UnsupportedError | CaromError) -> None:
    """Warn, once for each reason, at the line that called the caller of this function."""
    kind = reason.status if isinstance(reason, CaromError) else str(reason)
    if kind in _told:
        return
    _told.add(kind)
    warnings.warn(
        f"pooltool plays this system instead of carom: {reason}", FallbackWarning, stacklevel=3
    )


# ---- A player
# -----------------------------------------------------------------------------------------------------------


PooltoolGame = Literal["eightball", "nineball"]
_GAMES: dict[str, PooltoolGame] = {"_EightBall": "eightball", "_NineBall": "nineball"}


class Agent:
    """A player of eight-ball and nine-ball by pooltool's rules.

    Use it as the `ai` of pooltool's `Player`, or to find a stroke for a System.

    Parameters
    ----------
    player : ndarray of `carom.dtypes.player`, shape (), optional
        The errors of its strokes. Default: `carom.player()`.
    opponent : ndarray of `carom.dtypes.player`, shape (), optional
        Default: a player with the same errors.
    exact : bool
        Whether strokes are returned without errors, for callers that add them. Plans allow for
        errors in any case.
    engine : pooltool.physics.PhysicsEngine, optional
        The engine for the shots of a plan. Default: pooltool's.
    shots, seed, threads
        As for `carom.plan`; each stroke has a different seed.
    """

    def __init__(
        self,
        player: Records | None = None,
        opponent: Records | None = None,
        *,
        exact: bool = False,
        engine: Any = None,
        shots: int = 2000,
        seed: Seed = 0,
        threads: int = 0,
    ) -> None:
        self.player = usual_player() if player is None else player
        self.opponent, self.exact, self.engine, self.shots, self.seed, self.threads = (
            opponent,
            exact,
            engine,
            shots,
            seed_of(seed),
            threads,
        )
        self.strokes = 0

    def decide(self, system: Any, game: Any, callback: Any = None) -> Any:
        """Choose the stroke for a System in a game; returns a `pooltool.ai.action.Action`.

        Places a cue ball in hand in the System, and sets the called ball and pocket in the game.
        Because pooltool's eight-ball requires a call, a safety calls a ball that does not fall.
        `callback` is called with the stroke.

        Raises
        ------
        UnsupportedError
            The game, the engine or the table is not supported.
        """
        kind = next((base.__name__ for base in type(game).__mro__ if base.__name__ in _GAMES), None)
        if kind is None:
            raise UnsupportedError(
                f"game: {type(game).__name__} is not supported; the agent plays pooltool's eight-ball and nine-ball"
            )
        constraints = game.shot_constraints
        hand = str(constraints.ball_in_hand)
        best = self.stroke(
            system,
            constraints.hittable,
            rules=_GAMES[kind],
            opening=game.shot_number == 0,
            hand=hand,
        )
        if hand != "none":
            ball = system.balls["cue"]
            ball.state.rvw[:] = 0.0
            ball.state.rvw[0] = (*best["place"], ball.params.R)
            ball.state.s = int(Label.STATIONARY)
        if constraints.call_shot:
            targets = [
                name
                for name in constraints.hittable
                if name in system.balls and system.balls[name].state.s != Label.POCKETED
            ]
            constraints.ball_call = str(best["ball"]) if best["ball"] > 0 else targets[0]
            constraints.pocket_call = list(system.table.pockets)[best["pocket"]]
        action = _action.Action(
            *(float(best["cue"][name]) for name in ("speed", "phi", "theta", "a", "b"))
        )
        if callback is not None:
            callback(action)
        return action

    def stroke(
        self,
        system: Any,
        targets: Collection[str],
        *,
        rules: PooltoolGame = "eightball",
        opening: bool = False,
        hand: str = "none",
    ) -> Records:
        """Choose the stroke for a System without a game of pooltool. The System is not modified.

        Parameters
        ----------
        system : pooltool.System
            The ball "cue" and balls named by their numbers. Missing balls count as pocketed.
        targets : collection of str
            The balls that the cue ball may hit first. In eight-ball they determine the group; in
            nine-ball the lowest ball is on.
        rules : {"eightball", "nineball"}
        opening : bool
            Whether the stroke is the break.
        hand : {"none", "anywhere", "behind_line"}
            Where the cue ball in hand may be placed.

        Returns
        -------
        ndarray of `carom.dtypes.plan_stroke`, shape ()
            Its cue includes the player's errors, unless `exact` is set.

        Raises
        ------
        UnsupportedError
            A name, the engine or the table is not supported.
        """
        if rules not in _GAMES.values():
            raise UnsupportedError(unknown_value("rules", rules, list(_GAMES.values())))
        hands = {"none": "no", "anywhere": "anywhere", "behind_line": "kitchen"}
        if hand not in hands:
            raise UnsupportedError(unknown_value("hand", hand, ("none", "anywhere", "behind_line")))

        # The layout by numbers; a cue ball in hand has no position yet.
        table, names = table_of(system.table), ["cue", *map(str, range(1, LAST[rules] + 1))]
        layout_of = dict(zip(system.balls, balls_of(system), strict=True))
        layout: Array = np.array(
            [layout_of.get(name, layout_of["cue"]) for name in names], dtype=dtypes.shot_ball
        )
        down = [k for k, name in enumerate(names) if name not in layout_of] + (
            [0] if hand != "none" else []
        )
        layout["state"]["label"][down] = Label.POCKETED
        options, table = _options_of(self.engine or _simulate.DEFAULT_ENGINE, table, layout)
        cue = cue_of(system)
        cue["ball"] = 0

        best: Records = plan(
            table,
            layout,
            cue,
            rules=rules,
            group=_group(targets, layout_of) if rules == "eightball" else None,
            opening=opening,
            player=self.player,
            opponent=self.opponent,
            shots=self.shots,
            in_hand=hands[hand],
            best=1,
            seed=self.seed + self.strokes,
            threads=self.threads,
            options=options,
        )[0].copy()
        if not self.exact:
            best["cue"] = with_errors(best["cue"], self.player, self.seed, self.strokes)
        self.strokes += 1
        return best

    def apply(self, system: Any, action: Any) -> None:
        """Set the stroke of a System's cue, for `simulate`."""
        action.apply(system.cue)


def _group(hittable: Collection[str], balls: dict[str, Any]) -> Group:
    """The player's group, from the balls that may be hit first."""

    def are_in_play(low: int, high: int) -> bool:
        return any(
            name.isdigit() and low <= int(name) <= high and ball["state"]["label"] != Label.POCKETED
            for name, ball in balls.items()
        )

    numbers = set(map(int, hittable))
    if numbers == {8}:
        return "stripes" if are_in_play(1, 7) else "solids"
    return "solids" if max(numbers) < 8 else "stripes" if min(numbers) > 8 else "open"


# ---- Replacing pooltool's simulate
# -------------------------------------------------------------------------------------------------------


def _replace(old: Any, new: Any) -> None:
    """Replace a function under all its names in all modules except this one, which keeps both."""
    for name, module in list(sys.modules.items()):
        if name != __name__ and issubclass(type(module), types.ModuleType):
            # vars() would load a module that is imported on first use.
            names = object.__getattribute__(module, "__dict__")
            for key in [key for key, value in list(names.items()) if value is old]:
                names[key] = new


def install() -> None:
    """Replace `pooltool.simulate` by carom in pooltool and in all modules that have imported it.

    pooltool still plays what carom does not support; a `FallbackWarning` reports each reason once.
    """
    _told.clear()
    _replace(original, _installed)


def uninstall() -> None:
    """Restore `pooltool.simulate`."""
    _replace(_installed, original)


@functools.wraps(original)
def _installed(*arguments: Any, **options: Any) -> Any:
    try:
        return simulate(*arguments, **options)
    except (UnsupportedError, CaromError) as reason:
        _tell(reason)
        known_to_pooltool = {
            name: value
            for name, value in options.items()
            if name not in ("models", "cushion_model")
        }
        return original(*arguments, **known_to_pooltool)
