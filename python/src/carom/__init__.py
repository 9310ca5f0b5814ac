"""Billiards, computed: collisions of balls and cushions, whole shots, and millions of any of them.

`impacts` and `cushion_impacts` build arrays of impacts; `collide` and `cushion` solve them. `mu_ball` computes the friction between
balls from their slip speed. `trace` and `cushion_trace` follow one impact. `simulate` plays a shot and `simulate_batch` many: on
`tables`, from `racks` or `balls`, with a `cue`. `resume` goes on with a shot that was stopped; `place_ball`
is ball in hand. `plan` finds the best shots of a `player`. Units are SI; vectors are right-handed with z up.
`dtypes` has the structured dtypes. Every call that computes releases the GIL.
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
for _name in "collisions cushions derivatives dtypes layouts racks results shots status tables".split():
    setattr(_sys.modules[f"carom.{_name}"], "__dir__", _listing(f"carom.{_name}"))

__dir__ = _listing(__name__)
__version__: str = _ffi.string(_lib.carom_version()).decode()

__all__ = [
    "ALL_THREADS", "CaromError", "EventType", "Facts", "Features", "Flag", "Foul", "Hessian", "Label",
    "Options", "Outcome", "Pot", "Rating", "Rules", "Ruling", "Shot", "Shots", "Status", "Table", "Tangents",
    "Turn", "aim", "aim_slope", "alciatore", "balls", "by_number", "chances", "cite", "collide", "cue",
    "cushion", "cushion_impacts", "cushion_trace", "dtypes", "hessian", "impacts", "isa_in_force", "jacobian",
    "mu_ball", "physics_revision", "place_ball", "plan", "player", "racks", "rating", "referee", "resume",
    "simulate", "simulate_arrow", "simulate_batch", "struck", "tables", "tangents", "trace", "value",
    "with_errors",
]  # fmt: skip

if _TYPE_CHECKING:
    from carom.games import Facts, Foul, Pot, Rating, Rules, Ruling, Turn
    from carom.games import aim, chances, plan, player, rating, referee, value, with_errors
else:

    def __getattr__(name: str) -> object:
        """What lies in a folder: a module by its short name, or what `carom.games` gives."""
        try:
            if f"carom.{name}" in _MODULES:
                return _importlib.import_module(f"carom.{name}")
            if name in __all__:
                return getattr(_importlib.import_module("carom.games"), name)
        except ModuleNotFoundError as missing:
            raise AttributeError(f"carom.{name}: {missing}", name=name) from missing
        raise AttributeError(f"module 'carom' has no attribute {name!r}", name=name)


def isa_in_force() -> str:
    """The instruction set in use: "plain", "sse2", "neon", "avx2" or "avx512". The variable CAROM_ISA limits it."""
    return str(_ffi.string(_lib.carom_isa_name(_lib.carom_isa_in_force())).decode())


def physics_revision() -> int:
    """A number that changes whenever a result of any call has other bits than before: recordings play back alike with the same one."""
    return int(_lib.carom_physics_revision())
