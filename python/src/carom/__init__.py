"""Billiards, computed: collisions of balls and cushions, whole shots, and millions of any of them.

    collisions   impacts, cushion_impacts, collide, cushion, mu_ball, alciatore, Outcome; step by
                 step: trace, cushion_trace; a table's cushion by three banks: calibrate, Calibration
    layouts      tables, Table, racks, balls, by_number, cue, struck, place_ball
    shots        simulate, simulate_batch, simulate_arrow, resume, Options, ALL_THREADS
    results      Shot, Shots, Features, EventType, Label, Status, CaromError
    derivatives  tangents, jacobian, hessian, aim_slope, Tangents, Hessian, Flag
    plans        plan, player, with_errors, aim, value, chances, rating, Pot, Rating; Goal, sequence,
                 RunOut
    coach        odds, Odds; review, Review, Drill; best_breaks
    rules        Match, a whole game; referee, Rules, Ruling, Facts, Turn, Foul
    other        dtypes, the structured dtypes; cite, physics_revision, isa_in_force
    modules      record, tracks, fit, jax, torch, pooltool; games: potting, drills, pool, matches,
                 gymnasium, pettingzoo, sb3

`help(carom.simulate)` is the manual of a call. Units are SI; vectors are right-handed with z up.
Every call that computes releases the GIL.
"""

import importlib as _importlib
import sys as _sys
from typing import TYPE_CHECKING as _TYPE_CHECKING

from carom import dtypes as dtypes
from carom import racks as racks
from carom import tables as tables
from carom._carom import ffi as _ffi
from carom._carom import lib as _lib
from carom._rows import listing as _listing
from carom._shot_options import Options as Options
from carom._impacts import Outcome as Outcome
from carom.collisions import (
    ALL_THREADS as ALL_THREADS,
    alciatore as alciatore,
    collide as collide,
    impacts as impacts,
    mu_ball as mu_ball,
    trace as trace,
)
from carom.cushions import (
    Calibration as Calibration,
    calibrate as calibrate,
    cushion as cushion,
    cushion_impacts as cushion_impacts,
    cushion_trace as cushion_trace,
)
from carom.derivatives import (
    Flag as Flag,
    Hessian as Hessian,
    Tangents as Tangents,
    aim_slope as aim_slope,
    hessian as hessian,
    jacobian as jacobian,
    tangents as tangents,
)
from carom.layouts import (
    Table as Table,
    balls as balls,
    by_number as by_number,
    cue as cue,
    place_ball as place_ball,
    struck as struck,
)
from carom.results import (
    EventType as EventType,
    Features as Features,
    Label as Label,
    Shot as Shot,
    Shots as Shots,
)
from carom.shots import (
    cite as cite,
    resume as resume,
    simulate as simulate,
    simulate_arrow as simulate_arrow,
    simulate_batch as simulate_batch,
)
from carom.status import (
    CaromError as CaromError,
    Status as Status,
)

if _TYPE_CHECKING:
    from carom import drills as drills
    from carom import fit as fit
    from carom import gymnasium as gymnasium
    from carom import matches as matches
    from carom import pettingzoo as pettingzoo
    from carom import plans as plans
    from carom import pool as pool
    from carom import potting as potting
    from carom import rules as rules
    from carom import sb3 as sb3
    from carom.games import (
        Drill as Drill,
        Facts as Facts,
        Foul as Foul,
        Goal as Goal,
        Match as Match,
        Odds as Odds,
        Pot as Pot,
        Rating as Rating,
        Review as Review,
        Rules as Rules,
        Ruling as Ruling,
        RunOut as RunOut,
        Turn as Turn,
        aim as aim,
        best_breaks as best_breaks,
        chances as chances,
        odds as odds,
        plan as plan,
        player as player,
        rating as rating,
        referee as referee,
        review as review,
        sequence as sequence,
        value as value,
        with_errors as with_errors,
    )

# What the package gives, as dir(carom) shows it. It has no __all__, since help(carom) would print the
# whole of every name there.
_OFFERED = [
    "ALL_THREADS",
    "Calibration",
    "CaromError",
    "Drill",
    "EventType",
    "Facts",
    "Features",
    "Flag",
    "Foul",
    "Goal",
    "Hessian",
    "Label",
    "Match",
    "Odds",
    "Options",
    "Outcome",
    "Pot",
    "Rating",
    "Review",
    "Rules",
    "Ruling",
    "RunOut",
    "Shot",
    "Shots",
    "Status",
    "Table",
    "Tangents",
    "Turn",
    "aim",
    "aim_slope",
    "alciatore",
    "balls",
    "best_breaks",
    "by_number",
    "calibrate",
    "chances",
    "cite",
    "collide",
    "cue",
    "cushion",
    "cushion_impacts",
    "cushion_trace",
    "dtypes",
    "hessian",
    "impacts",
    "isa_in_force",
    "jacobian",
    "mu_ball",
    "odds",
    "physics_revision",
    "place_ball",
    "plan",
    "player",
    "racks",
    "rating",
    "referee",
    "resume",
    "review",
    "sequence",
    "simulate",
    "simulate_arrow",
    "simulate_batch",
    "struck",
    "tables",
    "tangents",
    "trace",
    "value",
    "with_errors",
]

# Names of the folder games, and modules of folders, which are loaded when they are asked for.
_OF_GAMES = frozenset(
    [
        "Drill",
        "Facts",
        "Foul",
        "Goal",
        "Match",
        "Odds",
        "Pot",
        "Rating",
        "Review",
        "Rules",
        "Ruling",
        "RunOut",
        "Turn",
        "aim",
        "best_breaks",
        "chances",
        "odds",
        "plan",
        "player",
        "rating",
        "referee",
        "review",
        "sequence",
        "value",
        "with_errors",
    ]
)
_MODULES_OF_FOLDERS = frozenset(
    [
        "drills",
        "fit",
        "gymnasium",
        "matches",
        "pettingzoo",
        "plans",
        "pool",
        "potting",
        "rules",
        "sb3",
    ]
)

_MODULES_OF_LISTINGS = [
    "collisions",
    "cushions",
    "derivatives",
    "dtypes",
    "layouts",
    "racks",
    "results",
    "shots",
    "status",
    "tables",
]
for _name in _MODULES_OF_LISTINGS:
    setattr(_sys.modules[f"carom.{_name}"], "__dir__", _listing(f"carom.{_name}"))  # noqa: B010

__version__: str = _ffi.string(_lib.carom_version()).decode()


def __dir__() -> list[str]:
    return sorted(_OFFERED)


def __getattr__(name: str) -> object:
    """What lies in a folder of the package, which the core loads only when it is asked for."""
    try:
        if name in _MODULES_OF_FOLDERS:
            return _importlib.import_module(f"carom.{name}")
        if name in _OF_GAMES:
            return getattr(_importlib.import_module("carom.games"), name)
    except ModuleNotFoundError as missing:
        raise AttributeError(f"carom.{name}: {missing}", name=name) from missing
    raise AttributeError(f"module 'carom' has no attribute {name!r}", name=name)


def isa_in_force() -> str:
    """The instruction set in use: "plain", "sse2", "neon", "avx2" or "avx512".

    The variable CAROM_ISA limits it.
    """
    return str(_ffi.string(_lib.carom_word(_lib.CAROM_WORDS_ISA, _lib.carom_isa_in_force())).decode())


def physics_revision() -> int:
    """A number that changes whenever a result of any call has other bits than before: recordings
    play back alike with the same one.
    """
    return int(_lib.carom_physics_revision())
