"""Billiards, computed: collisions of balls and cushions, whole shots, and millions of any of them.

`collide` and `cushion` resolve arrays of impacts, which `impacts` and `cushion_impacts` build; `mu_ball` is the friction between
balls by their speed of slip; `trace` and `cushion_trace` look closer. `simulate` plays a shot, `simulate_batch` many, on `tables`,
from `racks` or `balls`, struck by a `cue`; `resume` goes on with one that was stopped, `place_ball` is ball in hand. Units are SI, vectors right-handed, z up. `dtypes` has the
structured dtypes. Every call that computes releases the GIL.
"""

from carom import dtypes, racks, tables
from carom._carom import ffi as _ffi
from carom._carom import lib as _lib
from carom.collisions import ALL_THREADS, Outcome, alciatore, collide, impacts, mu_ball, trace
from carom.cushions import cushion, cushion_impacts, cushion_trace
from carom.layouts import Table, balls, cue, place_ball, struck
from carom.results import EventType, Features, Label, Shot, Shots
from carom.shots import resume, simulate, simulate_batch
from carom.status import CaromError, Status

__version__: str = _ffi.string(_lib.carom_version()).decode()

__all__ = [
    "ALL_THREADS",
    "CaromError",
    "EventType",
    "Features",
    "Label",
    "Outcome",
    "Shot",
    "Shots",
    "Status",
    "Table",
    "alciatore",
    "balls",
    "collide",
    "cue",
    "cushion",
    "cushion_impacts",
    "cushion_trace",
    "dtypes",
    "impacts",
    "isa_in_force",
    "mu_ball",
    "physics_revision",
    "place_ball",
    "racks",
    "resume",
    "simulate",
    "simulate_batch",
    "struck",
    "tables",
    "trace",
]


def isa_in_force() -> str:
    """The instruction set that is computed with: "plain", "sse2", "neon", "avx2" or "avx512"; CAROM_ISA limits it."""
    return str(_ffi.string(_lib.carom_isa_name(_lib.carom_isa_in_force())).decode())


def physics_revision() -> int:
    """A number that changes whenever a result of any call has other bits than before: recordings play back alike with the same one."""
    return int(_lib.carom_physics_revision())
