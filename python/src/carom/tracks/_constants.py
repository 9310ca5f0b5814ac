"""The constants of recorded shots, and the table and the balls that follow from them.

A constant is a field of `carom.dtypes.ball_kind` other than the radius, or the slope of the table
along x or y if it is given or fitted. carom_ball_kind_resolve() replaces a 0 by its default, so a
fit uses the same balls as a shot. Friction between balls is always the law of law_a, law_b and
law_c; a constant mu_ball without these is converted to it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, cast

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import BallFriction, Game
from carom._rows import Array, choice, pointer, unknown_name, worded
from carom._shot_options import Options, ShotCushion, options_of, shot_options
from carom.layouts import GAMES, TABLE_KINDS, Table, balls
from carom.status import CaromError

Constants = dict[str, float]
Extents = tuple[float, float]

KINDS = tuple(name for name in dtypes.ball_kind.names or () if name != "radius")
SLOPE = ("slope_x", "slope_y")
NAMES = KINDS + SLOPE
_LAW = ("law_a", "law_b", "law_c")
CUSHIONS = tuple(worded("SHOT_CUSHION"))
# names of the command
TABLES = worded("TABLE")


class Ground(NamedTuple):
    """A table of recorded shots, and the game that supplies constants that are not given."""

    table: Table
    game: Game
    radius: float  # of the balls, m

    @property
    def size(self) -> Extents:
        """Extents of x and y, m."""
        return self.table.width, self.table.length


def _built_in(kind: int) -> Table:
    record: Array = np.zeros((), dtypes.table)
    lib.carom_table_make(kind, pointer("carom_table[]", record))
    return Table.from_record(record)


def ground(table: str | Extents, radius: float | None = None, game: Game | None = None) -> Ground:
    """The table, the game and the radius of the balls, m, of recorded shots.

    `table` is a built-in table such as "9ft", or the extents (W, L), m, of one without pockets. The
    default game is the table's, or "billiard" for extents.
    """
    if isinstance(table, str):
        kind = choice(TABLE_KINDS, table, "table")
        number = lib.carom_game_of_table(kind) if game is None else choice(GAMES, game, "game")
        made = _built_in(kind)
    else:
        if radius is None and game is None:
            raise ValueError(
                "radius: missing for a table of two extents; pass the radius of the balls, m, or their game"
            )
        number = GAMES["billiard"] if game is None else choice(GAMES, game, "game")
        made = rectangle(table, _nose_height(number))
    if radius is None:
        radius = float(lib.carom_ball_kind_of(number).radius)
    if not min(made.width, made.length) > 4.0 * radius > 0.0:
        raise ValueError(
            f"table, radius: the extents {made.width:g} x {made.length:g} m are not above four radii, "
            f"{4.0 * radius:g} m, or the radius is not above 0"
        )
    return Ground(made, cast(Game, next(k for k, v in GAMES.items() if v == number)), radius)


def _nose_height(game: int) -> float:
    """The height of the noses of a table of a game, m."""
    word = next(name for name, number in GAMES.items() if number == game).split("_")[-1]
    kinds = [kind for kind in TABLES.values() if lib.carom_game_of_table(kind) == GAMES[word]]
    return float(_built_in(kinds[0]).rails["height"][0])


def rectangle(size: Extents, nose_height: float) -> Table:
    """A table without pockets, 0 to size[0] along x and 0 to size[1] along y, m.

    `nose_height` is the height of its noses above the cloth, m.
    """
    width, length = size
    corners = np.array([[0.0, 0.0], [width, 0.0], [width, length], [0.0, length]])
    rails: Array = np.zeros(4, dtypes.rail)
    rails["p"], rails["q"] = corners, np.roll(corners, -1, axis=0)
    rails["height"], rails["side"] = nose_height, 1
    return Table(width, length, rails=rails)


def _resolved(
    kind: Array, cushion_model: ShotCushion, friction: BallFriction, table: Table | None
) -> tuple[Constants, ShotCushion]:
    """The constants of a ball after defaults are resolved, and the model of the cushion."""
    options = ffi.new(
        "carom_shot_options *",
        shot_options(Options(cushion_model=cushion_model, friction=friction))[0],
    )
    record = ffi.NULL if table is None else pointer("carom_table[]", table.record)
    kind = np.array(kind)
    if (
        code := lib.carom_ball_kind_resolve(record, options, pointer("carom_ball_kind[]", kind))
    ) < 0:
        raise CaromError(code)
    values = {name: float(kind[name]) for name in KINDS if name != "mu_ball"}
    return values, options_of(options).cushion_model


def _kind_of(game: Game, cushion_model: ShotCushion) -> Array:
    """A game's balls with their constants for a model of the cushion."""
    kind: Array = np.zeros((), dtypes.ball_kind)
    lib.carom_ball_kind_for(
        GAMES[game],
        choice(worded("SHOT_CUSHION"), cushion_model, "cushion_model"),
        pointer("carom_ball_kind[]", kind),
    )
    return kind


def usual(
    cushion_model: ShotCushion,
    game: Game = "billiard",
    friction: BallFriction = "alciatore",
    table: Table | None = None,
) -> Constants:
    """The initial constants: a game's balls for a model of the cushion."""
    table = table or rectangle((1.0, 1.0), _nose_height(GAMES[game]))
    return _resolved(_kind_of(game, cushion_model), cushion_model, friction, table)[0]


def complete(
    constants: Mapping[str, float] | Array | np.void,
    cushion_model: ShotCushion,
    where: str = "constants",
    *,
    game: Game = "billiard",
    friction: BallFriction = "alciatore",
    table: Table | None = None,
) -> tuple[Constants, ShotCushion]:
    """The given constants completed by the game's, and the model of the cushion for the shots."""
    table = table or rectangle((1.0, 1.0), _nose_height(GAMES[game]))
    if (
        isinstance(constants, (np.ndarray, np.void))
        and constants.dtype == dtypes.ball_kind
        and constants.shape == ()
    ):
        return _resolved(cast(Array, constants), cushion_model, friction, table)
    if not isinstance(constants, Mapping):
        raise TypeError(
            f"{where}: {constants!r} is not a mapping from constants to numbers, such as {{'mu_slide': 0.2}}"
        )
    for name, value in constants.items():
        if name not in NAMES:
            raise ValueError(unknown_name(where, "constant", name, NAMES, "help(carom.fit.fit)"))
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
            raise ValueError(f"{where}: {name}: {value!r} is not a finite number")
    kind = _kind_of(game, cushion_model)
    if "mu_ball" in constants and not any(name in constants for name in _LAW):
        friction, kind["mu_ball"] = "constant", constants["mu_ball"]
    # the game's law, if only some of its parameters are given
    for values in (_resolved(kind, cushion_model, friction, None)[0], constants):
        _give(kind, values)
    found, model = _resolved(kind, cushion_model, "alciatore", table)
    return found | {name: float(constants[name]) for name in SLOPE if name in constants}, model


def _give(kinds: Array, constants: Mapping[str, float]) -> None:
    for name, value in constants.items():
        if name in KINDS:
            kinds[name] = value


def path(name: str) -> str:
    """The name of a constant for `carom.tangents`."""
    return f"{'table' if name in SLOPE else 'kind'}.{name}"


def sloped(table: Table, constants: Mapping[str, float]) -> Table:
    """The table with the slope of some constants."""
    slope = {name: constants.get(name, 0.0) for name in SLOPE}
    return table if table.slope == slope else table.changed(**slope)


def layout(
    centres: dtypes.Doubles, radius: float, constants: Mapping[str, float]
) -> dtypes.Records:
    """Balls at rest at centres of shape (..., balls, 2), of shape (..., balls)."""
    layout = balls(centres, game="billiard", radius=radius)
    _give(layout["kind"], constants)
    return layout
