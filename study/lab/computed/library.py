"""library.py: the shared library by ctypes, with the types and constants of its headers, and the
shots that the other files of this folder play. The path of the library is the first argument of the
program.
"""

import ctypes
import sys
from functools import cache
from math import atan2, degrees
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "bindings"))
import api  # noqa: E402

# ---- The library, by ctypes


def types():
    """{name: type} of what the headers declare."""
    found = {name: getattr(ctypes, f"c_{name.removesuffix('_t')}") for name in api.SIZES}
    for declaration in api.types(api.describe(ROOT / "core/include")):
        fields = []
        for field in declaration.get("fields", ()):
            kind = (
                ctypes.c_void_p if field.get("pointer") else found.get(field["type"], ctypes.c_int)
            )
            for length in reversed(field.get("array", [])):
                kind *= length
            fields.append((field["name"], kind))
        found[declaration["name"]] = (
            type(declaration["name"], (ctypes.Structure,), {"_fields_": fields})
            if fields
            else ctypes.c_int
        )
        globals().update(
            {
                value["name"].removeprefix("CAROM_"): value["value"]
                for value in declaration.get("values", ())
            }
        )
    return found


LIBRARY, OF = ctypes.CDLL(sys.argv[1]), types()
Triple = ctypes.c_double * 3
for name, kind in {
    "ball_kind_of": "carom_ball_kind",
    "cue_of": "carom_cue",
    "alciatore": "carom_speed_law",
    "mu_ball": "double",
}.items():
    getattr(LIBRARY, f"carom_{name}").restype = OF[kind]
reference = ctypes.byref


# The names by which data/measured.csv calls games, tables and racks.
GAMES = {"pool": GAME_POOL, "snooker": GAME_SNOOKER, "billiard": GAME_BILLIARD}
TABLES = {
    "7ft": TABLE_POOL_7FT,
    "8ft": TABLE_POOL_8FT,
    "9ft": TABLE_POOL_9FT,
    "snooker": TABLE_SNOOKER,
    "threecushion": TABLE_THREECUSHION,
}
RACKS = {
    "nineball": RACK_NINEBALL,
    "eightball": RACK_EIGHTBALL,
    "tenball": RACK_TENBALL,
    "eightonspot": RACK_EIGHTONSPOT,
}


@cache
def ball(game=GAME_POOL):
    return LIBRARY.carom_ball_kind_of(GAMES.get(game, game))


@cache
def cue(game=GAME_POOL):
    return LIBRARY.carom_cue_of(GAMES.get(game, game))


@cache
def table(kind):
    shape = OF["carom_table"]()
    LIBRARY.carom_table_make(TABLES.get(kind, kind), reference(shape))
    return shape


# What all balls have instead of the numbers of their game, and the model of the cushion that they
# meet; 0 is the default. study/lab/cushions.py plays on other tables by these.
PLAYED_ON = {}
CUSHION_MODEL = [0]


def shot_ball(r, v=(0, 0, 0), w=(0, 0, 0), game=GAME_POOL, **numbers):
    placed_ball = OF["carom_shot_ball"](ball(game), (Triple(*r), Triple(*v), Triple(*w)))
    for name, value in (PLAYED_ON | numbers).items():
        setattr(placed_ball.kind, name, value)
    return placed_ball


def shoot(kind, balls, stroke=None, room=100):
    """The events of a shot on a table or on one of a kind, its facts, and where the first ball
    ends.
    """
    table_shape = table(kind) if isinstance(kind, (int, str)) else kind
    events, facts, final = (
        (OF["carom_event"] * room)(),
        OF["carom_facts"](),
        (OF["carom_ball_state"] * len(balls))(),
    )
    shot = OF["carom_shot"](room=room)
    shot.events, shot.facts, shot.final = (
        ctypes.cast(output, ctypes.c_void_p) for output in (events, reference(facts), final)
    )
    options = OF["carom_shot_options"](cushion_model=CUSHION_MODEL[0])
    LIBRARY.carom_shoot(
        reference(table_shape),
        (OF["carom_shot_ball"] * len(balls))(*balls),
        len(balls),
        reference(stroke) if stroke else None,
        reference(options) if CUSHION_MODEL[0] else None,
        reference(shot),
    )
    return events[: min(shot.count, room)], facts, final[0].r


def cluster(balls):
    """The motions of balls that touch, just after their contact."""
    motions = (OF["carom_motion"] * len(balls))()
    LIBRARY.carom_cluster(
        (OF["carom_shot_ball"] * len(balls))(*balls), len(balls), None, motions, None, 0, None
    )
    return motions


def angle(v):
    return degrees(atan2(v[0], v[1]))


def found(function, low, high, value):
    """Where a function between two numbers has a value."""
    rises = function(high) > function(low)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if (function(middle) > value) == rises else (middle, high)
    return 0.5 * (low + high)
