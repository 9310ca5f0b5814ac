"""Racks, with the cue ball first: `carom.racks.nineball(table)`.

Each function has the same parameters: the table; the gap between neighbours, m (0: a frozen rack);
a seed, an integer or a `numpy.random.Generator`; and the model of the cushion for which the balls'
constants are chosen, as in `carom.balls`. The seed determines the displacement of each ball, up to
a quarter of the gap, and the order of the balls that may be anywhere. Each returns an ndarray of
`carom.dtypes.shot_ball`.
"""

from __future__ import annotations

from typing import Protocol, cast

import numpy as np

from carom import dtypes, layouts
from carom._described import Game, ShotCushion
from carom._carom import ffi, lib
from carom._rows import Array, Seed, called, number, pointer, seed_of, worded
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
        gap: float = 1e-4,
        seed: Seed = 1,
        cushion_model: ShotCushion = "default",
    ) -> dtypes.Records: ...


def _maker(name: str) -> _Rack:
    kind = worded("RACK")[name]
    text = f"{lib.carom_rack_size(kind)} balls: {ffi.string(lib.carom_word_text(lib.CAROM_WORDS_RACK, kind)).decode()}."

    game: Game = _GAMES.get(kind, "pool")

    def make(
        table: Table,
        gap: float = 1e-4,
        seed: Seed = 1,
        cushion_model: ShotCushion = "default",
    ) -> dtypes.Records:
        size = int(lib.carom_rack_size(kind))
        balls: Array = np.zeros(size, dtypes.shot_ball)
        check_table(table)
        of_table, drawn = (
            pointer("carom_table[]", table.record),
            seed_of(seed, 2**64 - 1),
        )
        gap = number(gap, "gap", "a distance in m")
        code = lib.carom_rack(kind, of_table, gap, drawn, pointer("carom_shot_ball[]", balls), size)
        if code < 0:
            raise CaromError(code, "gap", gap, text="it must be 0 m to the radius of a ball")
        if cushion_model != "default":
            like = layouts.balls(np.zeros((1, 2)), game=game, cushion_model=cushion_model)
            balls["kind"] = like["kind"]
        return balls

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
