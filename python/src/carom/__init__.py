"""Billiards physics: collisions, impacts on cushions, and complete shots, one or millions at a time.

Units, axes and signs: docs/reference/conventions.md. All quantities are in SI units, except that the
cue's angles are in degrees; vectors are right-handed with z up.

    collisions   impacts, cushion_impacts, collide, cushion, mu_ball, alciatore, Outcome; one impact
                 in steps: trace, cushion_trace; a cushion from three banks: calibrate, Calibration
    layouts      tables, Table, racks, balls, by_number, cue, struck, place_ball
    shots        simulate, simulate_batch, simulate_arrow, resume, Options, ALL_THREADS
    files        load; Shot.save, Shots.save, Match.save
    results      Shot, Shots, Features, EventType, Label, Status, CaromError
    derivatives  tangents, jacobian, hessian, aim_slope, Tangents, Hessian, Flag
    plans        plan, player, with_errors, aim, value, chances, rating, Hit, Pot, Rating; Goal, sequence,
                 RunOut
    coach        odds, Odds; review, Review, Drill; best_breaks; ways, Ways; why, Why; breaks,
                 Breaks; practice, Practice, Reviewed
    rules        Match, a complete game; referee, Rules, Ruling, Facts, Turn, Foul
    other        dtypes, the structured dtypes; cite, physics_revision, isa_in_force
    modules      record, tracks, fit, jax, torch, pooltool; games: potting, drills, pool, matches,
                 gymnasium, pettingzoo, sb3

`help(carom.simulate)` describes a function. Functions release the GIL while they compute.
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
from carom.saved import load as load
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
    from carom import games as games
    from carom import jax as jax
    from carom import record as record
    from carom import torch as torch
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
        Breaks as Breaks,
        Drill as Drill,
        Facts as Facts,
        Foul as Foul,
        Goal as Goal,
        Hit as Hit,
        Match as Match,
        Odds as Odds,
        Pot as Pot,
        Practice as Practice,
        Rating as Rating,
        Review as Review,
        Reviewed as Reviewed,
        Rules as Rules,
        Ruling as Ruling,
        RunOut as RunOut,
        Turn as Turn,
        Ways as Ways,
        Why as Why,
        aim as aim,
        best_breaks as best_breaks,
        breaks as breaks,
        chances as chances,
        odds as odds,
        plan as plan,
        player as player,
        practice as practice,
        rating as rating,
        referee as referee,
        review as review,
        sequence as sequence,
        value as value,
        ways as ways,
        why as why,
        with_errors as with_errors,
    )

# The public names, as dir(carom) lists them. There is no __all__, because help(carom) would then
# print the documentation of each of them.
_OFFERED = [
    "ALL_THREADS",
    "Breaks",
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
    "Hit",
    "Label",
    "Match",
    "Odds",
    "Options",
    "Outcome",
    "Pot",
    "Practice",
    "Rating",
    "Review",
    "Reviewed",
    "Rules",
    "Ruling",
    "RunOut",
    "Shot",
    "Shots",
    "Status",
    "Table",
    "Tangents",
    "Turn",
    "Ways",
    "Why",
    "aim",
    "aim_slope",
    "alciatore",
    "balls",
    "best_breaks",
    "breaks",
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
    "load",
    "mu_ball",
    "odds",
    "physics_revision",
    "place_ball",
    "plan",
    "player",
    "practice",
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
    "ways",
    "why",
    "with_errors",
]

# Names of carom.games, and modules in subfolders, which are loaded on first use.
_OF_GAMES = frozenset(
    [
        "Breaks",
        "Drill",
        "Facts",
        "Foul",
        "Goal",
        "Hit",
        "Match",
        "Odds",
        "Pot",
        "Practice",
        "Rating",
        "Review",
        "Reviewed",
        "Rules",
        "Ruling",
        "RunOut",
        "Turn",
        "Ways",
        "Why",
        "aim",
        "best_breaks",
        "breaks",
        "chances",
        "odds",
        "plan",
        "player",
        "practice",
        "rating",
        "referee",
        "review",
        "sequence",
        "value",
        "ways",
        "why",
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
# Other parts of the package, which are loaded when they are asked for, too.
_PARTS = frozenset(["film", "games", "jax", "pooltool", "record", "torch", "tracks"])

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
    """Return a name from a subfolder of the package, which is imported on first use."""
    try:
        if name in _MODULES_OF_FOLDERS or name in _PARTS:
            return _importlib.import_module(f"carom.{name}")
        if name in _OF_GAMES:
            return getattr(_importlib.import_module("carom.games"), name)
    except ModuleNotFoundError as missing:
        raise AttributeError(f"carom.{name}: {missing}", name=name) from missing
    raise AttributeError(f"module 'carom' has no attribute {name!r}", name=name)


def isa_in_force() -> str:
    """Return the instruction set in use: "plain", "neon", "avx2" or "avx512".

    It is the best one of the processor, unless the environment variable CAROM_ISA limits it.
    "sse2" exists only in a package that was built with ``CAROM_ISAS=all``.
    """
    return str(
        _ffi.string(_lib.carom_word(_lib.CAROM_WORDS_ISA, _lib.carom_isa_in_force())).decode()
    )


def physics_revision() -> int:
    """Return the revision of the physics.

    It changes whenever the bits of any result change. Recordings replay identically between builds
    of the same revision.
    """
    return int(_lib.carom_physics_revision())
