"""Racks, with the cue ball first: `carom.racks.nineball(table)`.

Parameters of each:

table : Table
gap : array_like, shape (...)
    The distance between neighbours, m; 0 is a frozen rack.
seed : int, numpy.random.Generator, or array_like of int, shape (...)
    It draws by how much each ball is moved, up to a quarter of the gap, and where the other balls
    of the rack go.
cushion_model : str
    The model of the cushion whose constants the balls have, as in `carom.balls`.
cue_ball : array_like, shape (..., 2), optional
    Positions of the cue ball, m. Default: on the head spot, or that of the game.

The result is an ndarray of `carom.dtypes.shot_ball`, shape (..., balls): gaps, seeds and positions
are broadcast against each other.
"""

from __future__ import annotations

import math
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes, layouts
from carom._described import Game, ShotCushion
from carom._carom import ffi, lib
from carom._rows import Array, Seed, as_array, broadcast, called, number, pointer, seed_of, worded
from carom.layouts import Table, check_table
from carom.status import CaromError


def _games() -> dict[int, Game]:
    """The game whose balls each rack has, for racks of games other than pool."""
    names = list(worded("GAME"))
    found: dict[int, Game] = {}
    k = 0
    while about := lib.carom_rules_about_of(k):
        found[about.rack] = cast(Game, names[about.balls])
        k += 1
    return found


_GAMES = _games()


class _Rack(Protocol):
    def __call__(
        self,
        table: Table,
        gap: ArrayLike = 1e-4,
        seed: Seed | ArrayLike = 1,
        cushion_model: ShotCushion = "default",
        cue_ball: ArrayLike | None = None,
    ) -> dtypes.Records: ...


def _seeds(seed: Seed | ArrayLike) -> Array:
    """Seeds as an array of whole numbers, of shape () for one."""
    if isinstance(seed, (int, np.random.Generator)):
        return np.array(seed_of(seed, 2**64 - 1), np.uint64)
    seeds = as_array(seed, "seed")
    if seeds.dtype.kind not in "iu" or (seeds.size and seeds.min() < 0):
        seed_of(cast(Any, seed), 2**64 - 1)  # which refuses it
        raise ValueError(f"seed: whole numbers from 0 on are required, not {seed!r}")
    return seeds.astype(np.uint64)


def _maker(name: str) -> _Rack:
    kind = worded("RACK")[name]
    text = f"{lib.carom_rack_size(kind)} balls: {ffi.string(lib.carom_word_text(lib.CAROM_WORDS_RACK, kind)).decode()}."

    game: Game = _GAMES.get(kind, "pool")
    size = int(lib.carom_rack_size(kind))

    def write_rack(table: Table, gap: float, seed: int, balls: Array) -> None:
        of_table, rows = pointer("carom_table[]", table.record), pointer("carom_shot_ball[]", balls)
        code = lib.carom_rack(kind, of_table, gap, seed, rows, size)
        if code < 0:
            raise CaromError(code, "gap", gap, text="it must be 0 m to the radius of a ball")

    def make(
        table: Table,
        gap: ArrayLike = 1e-4,
        seed: Seed | ArrayLike = 1,
        cushion_model: ShotCushion = "default",
        cue_ball: ArrayLike | None = None,
    ) -> dtypes.Records:
        check_table(table)
        if not isinstance(gap, (list, tuple, np.ndarray)):
            gap = number(gap, "gap", "a distance in m")
        gaps, seeds = as_array(gap, "gap", np.float64), _seeds(seed)
        shapes = {"gap": gaps.shape, "seed": seeds.shape}
        places = None if cue_ball is None else as_array(cue_ball, "cue_ball", np.float64)
        if places is not None:
            if places.ndim == 0 or places.shape[-1] != 2:
                raise ValueError(f"cue_ball: the shape must be (..., 2), not {places.shape}")
            shapes["cue_ball"] = places.shape[:-1]
        shape = broadcast(shapes)
        racks: Array = np.zeros((math.prod(shape), size), dtypes.shot_ball)
        all_gaps = np.broadcast_to(gaps, shape).reshape(-1).tolist()
        all_seeds = np.broadcast_to(seeds, shape).reshape(-1).tolist()
        for row, each_gap, each_seed in zip(racks, all_gaps, all_seeds, strict=True):
            write_rack(table, each_gap, each_seed, row)
        if places is not None:
            for row, place in zip(racks, np.broadcast_to(places, (*shape, 2)).reshape(-1, 2)):
                x, y = place.tolist()
                row["state"][0] = layouts.place_ball(table, row, 0, x, y)["state"][0]
        if cushion_model != "default":
            like = layouts.balls(np.zeros((1, 2)), game=game, cushion_model=cushion_model)
            racks["kind"] = like["kind"]
        return racks.reshape((*shape, size))

    return called(make, name, text)


nineball = _maker("nineball")
eightball = _maker("eightball")
tenball = _maker("tenball")
snooker = _maker("snooker")
threecushion = _maker("threecushion")
nineonspot = _maker("nineonspot")
blackball = _maker("blackball")
rotation = _maker("rotation")
pyramid = _maker("pyramid")
fourball = _maker("fourball")
cowboy = _maker("cowboy")
billiards = _maker("billiards")
eightonspot = _maker("eightonspot")
