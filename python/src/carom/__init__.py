"""Billiards, computed: collisions of balls and cushions, whole shots, and millions of any of them.

    collisions   impacts, cushion_impacts, collide, cushion, mu_ball, alciatore, Outcome; step by
                 step: trace, cushion_trace
    layouts      tables, Table, racks, balls, by_number, cue, struck, place_ball
    shots        simulate, simulate_batch, simulate_arrow, resume, Options, ALL_THREADS
    results      Shot, Shots, Features, EventType, Label, Status, CaromError
    derivatives  tangents, jacobian, hessian, aim_slope, Tangents, Hessian, Flag
    plans        plan, player, with_errors, aim, value, chances, rating, Pot, Rating
    rules        referee, Rules, Ruling, Facts, Turn, Foul
    other        dtypes, the structured dtypes; cite, physics_revision, isa_in_force
    modules      record, tracks, fit, jax, torch, pooltool; games: potting, drills, pool, matches,
                 gymnasium, pettingzoo

`help(carom.simulate)` is the manual of a call. Units are SI; vectors are right-handed with z up.
Every call that computes releases the GIL.
"""

import importlib as _importlib
import sys as _sys
from typing import TYPE_CHECKING as _TYPE_CHECKING

from carom import dtypes, racks, tables
from carom._carom import ffi as _ffi
from carom._carom import lib as _lib
from carom._rows import listing as _listing
from carom._short_names import MODULES as _MODULES
from carom._short_names import Finder as _Finder
from carom._shot_options import Options
from carom._impacts import Outcome
from carom.collisions import ALL_THREADS, alciatore, collide, impacts, mu_ball, trace
from carom.cushions import cushion, cushion_impacts, cushion_trace
from carom.derivatives import Flag, Hessian, Tangents, aim_slope, hessian, jacobian, tangents
from carom.layouts import Table, balls, by_number, cue, place_ball, struck
from carom.results import EventType, Features, Label, Shot, Shots
from carom.shots import cite, resume, simulate, simulate_arrow, simulate_batch
from carom.status import CaromError, Status

_sys.meta_path.append(_Finder())
_MODULES_OF_LISTINGS = (
    "collisions cushions derivatives dtypes layouts racks results shots status tables".split()
)
for _name in _MODULES_OF_LISTINGS:
    setattr(_sys.modules[f"carom.{_name}"], "__dir__", _listing(f"carom.{_name}"))  # noqa: B010

__dir__ = _listing(__name__)
__version__: str = _ffi.string(_lib.carom_version()).decode()

__all__ = [
    "ALL_THREADS",
    "CaromError",
    "EventType",
    "Facts",
    "Features",
    "Flag",
    "Foul",
    "Hessian",
    "Label",
    "Options",
    "Outcome",
    "Pot",
    "Rating",
    "Rules",
    "Ruling",
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
    "by_number",
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
    "physics_revision",
    "place_ball",
    "plan",
    "player",
    "racks",
    "rating",
    "referee",
    "resume",
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

if _TYPE_CHECKING:
    from carom.games import Facts, Foul, Pot, Rating, Rules, Ruling, Turn
    from carom.games import aim, chances, plan, player, rating, referee, value, with_errors
else:
    _names = __all__
    del __all__

    def __getattr__(name: str) -> object:
        """What lies in a folder: a module by its short name, or what `carom.games` gives. pydoc
        would print the whole of all that `__all__` has.
        """
        if name == "__all__" and _sys._getframe(1).f_code.co_name != "docmodule":
            return _names
        try:
            if f"carom.{name}" in _MODULES:
                return _importlib.import_module(f"carom.{name}")
            if name in _names:
                return getattr(_importlib.import_module("carom.games"), name)
        except ModuleNotFoundError as missing:
            raise AttributeError(f"carom.{name}: {missing}", name=name) from missing
        raise AttributeError(f"module 'carom' has no attribute {name!r}", name=name)


def isa_in_force() -> str:
    """The instruction set in use: "plain", "sse2", "neon", "avx2" or "avx512".

    The variable CAROM_ISA limits it.
    """
    return str(_ffi.string(_lib.carom_isa_name(_lib.carom_isa_in_force())).decode())


def physics_revision() -> int:
    """A number that changes whenever a result of any call has other bits than before: recordings
    play back alike with the same one.
    """
    return int(_lib.carom_physics_revision())
