"""Tables, balls and cues: the arguments of a shot."""

from __future__ import annotations

import contextlib
import functools
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes, pictures
from carom._carom import ffi, lib
from carom._described import BallNumbers, Condition, ShotCushion
from carom._described import Game as Game
from carom._faults import refuse_numbers, strike_error
from carom._rows import (
    Array,
    as_array,
    choice,
    fill,
    frozen,
    named,
    number,
    numbered,
    pointer,
    raw,
    sealed,
    several,
    text_of,
    unknown_name,
    whole,
    with_numbers,
    worded,
)
from carom.dtypes import Record, Records
from carom.status import CaromError, Status

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["Table", "balls", "by_number", "cue", "place_ball", "struck"]

GAMES, _CUSHIONS = worded("GAME"), worded("SHOT_CUSHION")
_CONDITIONS = worded("CONDITION")
# the names of the command, such as "9ft", and the names in carom.tables, such as "pool_9ft"
TABLE_KINDS = {**worded("TABLE"), **numbered("carom_table_kind")}


class Table:
    """A table of any geometry: cushions, their rounded ends (jaws), and pockets.

    A table is immutable: its arrays are read-only, and `changed` makes another table. Tables with
    equal parameters are equal and have the same hash.

    Parameters
    ----------
    width, length : float
        Extents, m, used for drawing and racks. The surface of the built-in tables is 0 <= x <=
        width, 0 <= y <= length.
    rails : ndarray of `carom.dtypes.rail`, shape (up to 32,)
        Straight cushions: ends p and q and height (m); side; line, which is derived if it is 0; and
        mu_cushion and restitution, where 0 stands for the ball's.
    jaws : ndarray of `carom.dtypes.jaw`, shape (up to 32,)
        Rounded ends of cushions: centre, radius and height (m); mu_cushion and restitution as for
        rails.
    pockets : ndarray of `carom.dtypes.pocket`, shape (up to 8,)
        Pockets: centre, radius and depth (m).
    ball_radius, rail_width, pocket_back : float
        Radius of the balls for which the rails are made, width of the tops of the rails, and height
        of the pockets' backs, m; 0 selects the defaults in carom_shot.h. They matter for balls in
        flight and for balls of other radii.
    slope_x, slope_y : float
        Rise of the cloth per metre along x and y; 0 is level.
    """

    def __init__(
        self,
        width: float,
        length: float,
        *,
        rails: Records,
        jaws: Records | None = None,
        pockets: Records | None = None,
        ball_radius: float = 0.0,
        rail_width: float = 0.0,
        pocket_back: float = 0.0,
        slope_x: float = 0.0,
        slope_y: float = 0.0,
    ) -> None:
        record: Array = np.zeros((), dtypes.table)
        sizes = {
            "width": width,
            "length": length,
            "ball_radius": ball_radius,
            "rail_width": rail_width,
            "pocket_back": pocket_back,
            "slope_x": slope_x,
            "slope_y": slope_y,
        }
        for name, size in sizes.items():
            unit = "rise per metre" if name.startswith("slope") else "length in m"
            record[name] = number(size, name, f"a {unit}")
            if name in ("width", "length") and not 0.0 < record[name] < np.inf:
                raise ValueError(f"{name}: {record[name]:g} m is not positive and finite")
        for name, part, values in (
            ("rails", "rail", rails),
            ("jaws", "jaw", jaws),
            ("pockets", "pocket", pockets),
        ):
            if values is None:
                continue
            values = as_array(values, name)
            room = record[part].shape[0]
            if values.dtype != getattr(dtypes, part) or values.ndim != 1 or len(values) > room:
                raise ValueError(
                    f"{name}: the dtype is {dtypes.described(values.dtype)} and the shape {values.shape}, "
                    f"but must be carom.dtypes.{part} and (n,) with n up to {room}"
                )
            record[name] = len(values)
            raw(record[part])[: len(values)] = raw(np.ascontiguousarray(values))
        self.record: Records = sealed(record)

    @classmethod
    def from_record(cls, record: Records) -> Table:
        """Make a table from a record of `carom.dtypes.table`, shape (), which is copied."""
        table = cls.__new__(cls)
        table.record = frozen(np.asarray(record, dtypes.table)).reshape(())
        return table

    def changed(self, **parts: Any) -> Table:
        """Return a copy of this table with some parameters changed, by name.

        >>> rails = table.rails.copy()
        >>> rails["mu_cushion"] = 0.3
        >>> table = table.changed(rails=rails)
        """
        sizes = ("width", "length", "ball_radius", "rail_width", "pocket_back", *self.slope)
        fields: dict[str, Any] = {name: float(self.record[name]) for name in sizes}
        fields |= {"rails": self.rails, "jaws": self.jaws, "pockets": self.pockets}
        if unknown := parts.keys() - fields.keys():
            raise TypeError(unknown_name("table", "parameter", min(unknown), fields))
        return Table(**{**fields, **parts})

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.record = sealed(state["record"])

    @property
    def width(self) -> float:
        """Extent along x, m."""
        return float(self.record["width"])

    @property
    def length(self) -> float:
        """Extent along y, m."""
        return float(self.record["length"])

    @property
    def slope(self) -> dict[str, float]:
        """slope_x and slope_y: the rise of the cloth per metre."""
        return {name: float(self.record[name]) for name in ("slope_x", "slope_y")}

    @property
    def rails(self) -> Records:
        """The straight cushions, a read-only view."""
        return self._parts("rail", "rails")

    @property
    def jaws(self) -> Records:
        """The rounded ends of cushions, a read-only view."""
        return self._parts("jaw", "jaws")

    @property
    def pockets(self) -> Records:
        """The pockets, a read-only view."""
        return self._parts("pocket", "pockets")

    @property
    def rail_names(self) -> list[str | None]:
        """The name of each rail: "head", "foot", "left" or "right", seen from the head, y = 0.

        None for the cut of a pocket, and on tables that are not rectangular.
        """
        return self._names(lib.carom_rail_name, "rails")

    @property
    def pocket_names(self) -> list[str | None]:
        """The name of each pocket, such as "foot-left" or "side-right"; None on tables that are not
        rectangular.
        """
        return self._names(lib.carom_pocket_name, "pockets")

    def _names(self, name: Any, count: str) -> list[str | None]:
        texts = (
            name(pointer("carom_table[]", self.record), k) for k in range(int(self.record[count]))
        )
        return [text_of(text) if text != ffi.NULL else None for text in texts]

    def _parts(self, part: str, count: str) -> Records:
        parts: Records = self.record[part]
        return parts[: int(self.record[count])]

    def check(self, radius: float = 0.028575) -> None:
        """Raise an error if the table is invalid for balls of a radius, m.

        Checks parameters, gaps through which a ball can leave, and the sides of rails, which takes
        some milliseconds. The built-in tables are valid. `simulate` checks only the parameters.

        Raises
        ------
        CaromError
            `field` is the invalid part; the message contains its position.
        """
        fault = ffi.new("carom_table_fault *")
        refuse_table(
            lib.carom_table_check(pointer("carom_table[]", self.record), radius, fault), fault
        )

    def __eq__(self, other: object) -> bool:
        """Whether all parameters are equal."""
        return isinstance(other, Table) and bool(np.array_equal(self.record, other.record))

    def __hash__(self) -> int:
        # of values, not of bytes: -0.0 and 0.0 are equal but have different bytes
        numbers = (self.rails["p"], self.rails["restitution"], self.pockets["centre"])
        parts = (tuple(values.ravel().tolist()) for values in numbers)
        return hash((self.width, self.length, len(self.jaws), *parts))

    def __repr__(self) -> str:
        sizes = f"{len(self.rails)} rails, {len(self.jaws)} jaws, {len(self.pockets)} pockets"
        return f"<carom.Table {self.width:.4g} m x {self.length:.4g} m, {sizes}>"

    def _repr_svg_(self) -> str:
        return pictures.picture(self)

    def plot(self, ax: Any = None) -> Any:
        """Draw the table on axes of matplotlib, in metres, and return the axes."""
        return pictures.plot(self, None, ax)


def refuse_table(code: int, fault: Any) -> None:
    """Raise the error of a table, with the position of the fault."""
    if code < 0:
        partner = (
            "" if fault.other.kind == lib.CAROM_PART_NONE else f", next to {_part(fault.other)}"
        )
        gap = f", {fault.gap:.4g} m wide" if fault.gap > 0.0 else ""
        where = ""
        if any(fault.place):
            where = f" (at x = {fault.place[0]:.4g} m, y = {fault.place[1]:.4g} m{gap}{partner})"
        elif partner:
            where = partner
        raise CaromError(code, _part(fault.part), text=Status(code).text + where)


def check_table(table: object) -> None:
    """Refuses what is no table."""
    if not isinstance(table, Table):
        shown = repr(table) if isinstance(table, str) else type(table).__name__
        raise TypeError(f"table: {shown} is not a carom.Table; pass carom.tables.{_maker(table)}()")


def _maker(table: object) -> str:
    """The function of carom.tables that makes the table with a name, or a common one."""
    kind = TABLE_KINDS["9ft"]
    if isinstance(table, str):
        with contextlib.suppress(ValueError):
            kind = choice(TABLE_KINDS, table, "table")
    return next(name for name, number in numbered("carom_table_kind").items() if number == kind)


_RADII = {lib.carom_ball_kind_of(number).radius: name for name, number in reversed(GAMES.items())}
_CUSHION = [
    "mu_cushion",
    "restitution_cushion",
    "nose_height",
    "roll_loss",
    "restitution_log",
    "mu_log",
    "smooth_q",
]


def radius_on(kind: int) -> float:
    """The radius, m, of the balls of a built-in table, a carom_table_kind."""
    return float(lib.carom_ball_kind_of(lib.carom_game_of_table(kind)).radius)


def _sizes() -> dict[tuple[float, float], list[float]]:
    """The radii of the balls played on built-in tables, by the size of the table."""
    found: dict[tuple[float, float], list[float]] = {}
    measures = ffi.new("carom_measures *")
    for kind in worded("TABLE").values():
        lib.carom_table_measures(kind, measures)
        found.setdefault((measures.width, measures.length), []).append(radius_on(kind))
    return found


_SIZES = _sizes()


@functools.lru_cache(maxsize=256)
def _other_constants(kind: bytes, cushion_model: str) -> str:
    """A warning for a ball with a game's constants for another model of the cushion."""
    constants, of_c = (
        np.frombuffer(kind, dtypes.ball_kind)[_CUSHION].tobytes(),
        ffi.new("carom_ball_kind *"),
    )
    for game, number in list(GAMES.items())[:3]:
        constants_of_model = {}
        for model, numbers in _CUSHIONS.items():
            if lib.carom_ball_kind_for(number, numbers, of_c):
                constants_of_model[model] = np.frombuffer(ffi.buffer(of_c), dtypes.ball_kind)[
                    _CUSHION
                ].tobytes()
        if (
            constants in constants_of_model.values()
            and constants_of_model.get(cushion_model) != constants
        ):
            return (
                f"carom.balls(game={game!r}, cushion_model={cushion_model!r}) has its constants"
                if cushion_model in constants_of_model
                else f"there are none for it in the game {game!r}"
            )
    return ""


def doubt_balls(table: Table, kinds: Array, cushion_model: object) -> None:
    """Warn of balls that the table is not made for, and of constants for another cushion model."""
    table_radius = table.record["ball_radius"].item()
    radii = [table_radius] if table_radius else _SIZES.get((table.width, table.length), [])
    first: Any = (
        kinds[(0,) * kinds.ndim] if kinds.size else None
    )  # by index: kinds.flat[:1] copies field by field
    radius = None if first is None else first["radius"]
    if radius in _RADII and radii and radius not in radii and radii[0] in _RADII:
        meant = radii[0]
        warnings.warn(
            f"balls: these are {_RADII[radius]} balls, radius {radius:g} m, but the table is made for {_RADII[meant]} balls, radius {meant:g} m; "
            f"pass game={_RADII[meant]!r} to carom.balls()",
            stacklevel=3,
        )
    named = isinstance(cushion_model, str) and cushion_model != "default" and first is not None
    if (
        named
        and cushion_model in _CUSHIONS
        and (doubt := _other_constants(first.tobytes(), str(cushion_model)))
    ):
        warnings.warn(
            f"cushion_model: the balls have constants of another model than {cushion_model!r}; {doubt}",
            stacklevel=3,
        )


def of_record(values: Records, record: Record, name: str, builder: str) -> Array:
    """The values in C order; raises TypeError for another dtype than that of carom.<builder>."""
    array = as_array(values, name)
    if array.dtype != record:
        raise TypeError(
            f"{name}: the dtype is {dtypes.described(array.dtype)}; pass the result of carom.{builder}"
        )
    return np.asarray(array, order="C")


def one_cue(cue: Records, name: str = "cue") -> Array:
    """A cue of shape (); raises ValueError for several cues."""
    cues = of_record(cue, dtypes.cue, name, "cue()")
    if cues.size != 1:
        raise ValueError(
            f"{name}: there are {cues.size} cues, but only one is allowed; simulate_batch() accepts several"
        )
    return cues.reshape(())


def _part(part: Any) -> str:
    """The name of a part of a table, or of a ball."""
    names = {
        lib.CAROM_PART_RAIL: "table.rails",
        lib.CAROM_PART_JAW: "table.jaws",
        lib.CAROM_PART_POCKET: "table.pockets",
        lib.CAROM_PART_BALL: "balls",
        lib.CAROM_PART_CORNER: "corners",
    }
    return f"{names[part.kind]}[{part.index}]" if part.kind in names else "table"


def place_ball(table: Table, balls: Records, ball: int, x: float, y: float) -> Records:
    """Place a ball: return a copy of a layout in which this ball is at rest at (x, y).

    Parameters
    ----------
    table : Table
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
    ball : int
        Index of the ball, which may be pocketed.
    x, y : float
        Its new position, m.

    Returns
    -------
    ndarray of `carom.dtypes.shot_ball`, shape (balls,)

    Raises
    ------
    CaromError
        The position is not free; `field` is the ball or the part of the table in the way.
    """
    placed = of_record(balls, dtypes.shot_ball, "balls", "balls()").copy()
    if placed.ndim != 1:
        raise TypeError(f"balls: the shape is {placed.shape}, but must be (balls,)")
    check_table(table)
    way = ffi.new("carom_part *")
    of_table, layout = pointer("carom_table[]", table.record), pointer("carom_shot_ball[]", placed)
    index = whole(ball, "ball", most=len(placed) - 1)
    x, y = number(x, "x", "a position in m"), number(y, "y", "a position in m")
    code = lib.carom_place_ball(of_table, layout, len(placed), index, x, y, way)
    if code in (lib.CAROM_ERROR_OVERLAP, lib.CAROM_ERROR_OFF_TABLE):
        raise CaromError(
            code,
            _part(way),
            text=f"is in the way of ball {index} at x = {x} m, y = {y} m; choose a free position on the table",
        )
    if code == lib.CAROM_ERROR_POSITION:
        raise CaromError(code, "x, y", f"{x}, {y}")
    if code == lib.CAROM_ERROR_RADIUS:
        raise CaromError(
            code, f"balls[{index}].kind.radius", placed[index]["kind"]["radius"].item()
        )
    if code < 0:
        raise CaromError(code, "balls" if code == lib.CAROM_ERROR_BALLS else _part(way))
    return placed


LAST = {
    text_of(about.name): about.last
    for k in range(99)
    if (about := lib.carom_rules_about_of(k)) and about.last
}  # the highest number of a ball
_COLOURS = {"yellow": "16", "green": "17", "brown": "18", "blue": "19", "pink": "20", "black": "21"}


def by_number(
    balls: Records, ids: Sequence[int | str], rules: str, *, cue: int | str = "cue"
) -> Records:
    """Sort balls by their numbers, as `plan` and `referee` require: ball k has number k.

    Balls that are missing are pocketed.

    Parameters
    ----------
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
    ids : sequence of int or str
        The number of each ball; in snooker also "red1" to "red15" and the names of the colours.
    rules : str
        The game, as for `plan`. The numbers are 1 to 15, 1 to 9, or 1 to 21 in snooker, where 16 to
        21 are the colours.
    cue : int or str
        The id of the cue ball.

    Returns
    -------
    ndarray of `carom.dtypes.shot_ball`, shape (16,), (10,) or (22,)

    Raises
    ------
    ValueError
        A ball does not belong to the game or occurs twice, or there is no cue ball.
    """
    layout = of_record(balls, dtypes.shot_ball, "balls", "balls()")
    names = list(
        map(
            str, several(ids, "ids", "a list of the number of each ball and the id of the cue ball")
        )
    )
    rules = named(LAST, rules, "rules")
    last = LAST[rules]
    if layout.shape != (len(names),):
        raise ValueError(
            f"ids: there are {len(names)} ids for balls of shape {layout.shape}; pass one id per ball and balls of shape (balls,)"
        )
    if names.count(str(cue)) != 1:
        raise ValueError(f"cue: {cue!r} is not exactly one of the ids: {', '.join(names)}")
    index_of: dict[int, int] = {}
    for k, name in enumerate(names):
        number = _COLOURS.get(name, name.removeprefix("red")) if rules == "snooker" else name
        of_ball = 0 if name == str(cue) else int(number) if number.isdecimal() else -1
        if not 0 <= of_ball <= last or of_ball in index_of or (of_ball == 0 and name != str(cue)):
            raise ValueError(
                f"ids: ball {name!r} is unknown or occurs twice; the balls of {rules} are the cue ball and 1 to {last}, each once"
            )
        index_of[of_ball] = k
    ordered = layout[[index_of.get(ball, index_of[0]) for ball in range(last + 1)]]
    down = [ball for ball in range(last + 1) if ball not in index_of]
    ordered["state"][down] = np.zeros((), dtypes.ball_state)
    ordered["state"]["r"][down, 2], ordered["state"]["label"][down] = -0.1, lib.CAROM_BALL_POCKETED
    return ordered


def _finite(**named: ArrayLike) -> None:
    """Raise an error if a value is not finite."""
    for name, values in named.items():
        numbers = as_array(values, name, np.float64)
        if not np.isfinite(numbers).all():
            wrong = numbers[~np.isfinite(numbers)].flat[0]
            raise ValueError(f"{name}: {wrong} is not finite")


@with_numbers(lib.CAROM_PART_BALL)
def balls(
    r: ArrayLike,
    *,
    v: ArrayLike = 0.0,
    w: ArrayLike = 0.0,
    game: Game = "pool",
    cushion_model: ShotCushion = "default",
    conditions: Sequence[Condition] = (),
    **kind: Unpack[BallNumbers],
) -> Records:
    """Make balls from their positions and properties.

    The arguments are broadcast against each other. A single layout is checked for values that are
    not finite; in a batch they affect only their own shots.

    Parameters
    ----------
    r : array_like, shape (..., balls, 2) or (..., balls, 3)
        Centres, m. Without z the balls are on the cloth.
    v, w : array_like, shape (..., 3)
        Velocities, m/s, and angular velocities, rad/s.
    game : {"pool", "snooker", "billiard", "pooltool_pool", "pooltool_snooker", "pooltool_billiard"}
        The game that supplies the defaults of the properties below; also "blackball", "pyramid" and
        "fourball". docs/reference/constants.md lists the source of each value.
    cushion_model : str
        The model of the cushion for which the constants are chosen, as for `simulate`. A warning is
        issued if the game has no constants for it.
    conditions : sequence of str
        Conditions of a pool table, such as ("fast_cloth", "old_cushion"); docs/using/fit.md lists
        them. Properties passed explicitly take precedence.
    **kind : array_like, shape (...)
        Fields of `carom.dtypes.ball_kind` by name.

    Returns
    -------
    ndarray of `carom.dtypes.shot_ball`, shape (..., balls)
    """
    unknown = [name for name in kind if name not in (dtypes.ball_kind.names or ())]
    if unknown:
        raise TypeError(
            unknown_name(
                "balls", "field", unknown[0], dtypes.ball_kind.names or (), "help(carom.balls)"
            )
        )
    fields = {
        f"kind.{name}": value for name, value in cast("dict[str, ArrayLike | None]", kind).items()
    }
    centres = as_array(r, "r", np.float64)
    if centres.ndim < 2 or centres.shape[-1] not in (2, 3):
        raise ValueError(
            f"r: the shape is {centres.shape}, but must be (..., balls, 2) or (..., balls, 3)"
        )
    if centres.ndim == 2:
        _finite(r=centres, v=v, w=w)
    places = np.zeros((*centres.shape[:-1], 3))
    places[..., : centres.shape[-1]] = centres
    ball, number = ffi.new("carom_shot_ball *"), choice(GAMES, game, "game")
    if not lib.carom_ball_kind_for(
        number, choice(_CUSHIONS, cushion_model, "cushion_model"), ffi.addressof(ball, "kind")
    ):
        warnings.warn(
            f"cushion_model: there are no constants for {cushion_model!r} in the game {game!r}; the balls have those of the default model",
            stacklevel=2,
        )
    pool = lib.carom_ball_kind_of(GAMES["pool"])
    if (
        conditions
        and lib.carom_ball_kind_of(number).restitution_cushion != pool.restitution_cushion
    ):
        raise ValueError(
            f"conditions: there are none for the game {game!r}, only for pool; pass restitution_cushion, mu_roll, ... instead"
        )
    for word in conditions:
        condition = choice(_CONDITIONS, word, "conditions")
        lib.carom_condition_give(condition, ffi.addressof(ball, "kind"))
    usual = bytes(ffi.buffer(ball))
    layout = fill(
        dtypes.shot_ball,
        {"r": 3, "v": 3, "w": 3},
        {**fields, "state.r": places, "state.v": v, "state.w": w},
        usual,
    )
    if centres.shape[-1] == 2:
        layout["state"]["r"][..., 2] = layout["kind"]["radius"]
    return layout


def cue(
    *,
    speed: ArrayLike | None = None,
    phi: ArrayLike = 90.0,
    theta: ArrayLike = 0.0,
    a: ArrayLike | None = None,
    b: ArrayLike | None = None,
    ball: ArrayLike = 0,
    game: Game = "pool",
    mass: ArrayLike | None = None,
    end_mass: ArrayLike | None = None,
    tip_radius: ArrayLike | None = None,
    miscue: ArrayLike = 0.0,
    tip_time: ArrayLike = 0.0,
    tip_restitution: ArrayLike | None = None,
    ball_speed: ArrayLike | None = None,
    tip: ArrayLike | None = None,
    follow: ArrayLike | None = None,
) -> Records:
    """Make a cue with its strike, or several cues.

    The arguments are broadcast against each other. A single cue with a value outside its range
    raises CaromError; in a batch an invalid cue affects only its own shot.

    Parameters
    ----------
    speed : array_like, shape (...)
        Speed of the cue before the strike, m/s; 0: no strike. Default: 2.
    phi, theta : array_like, shape (...)
        Direction in the plane, counterclockwise from +x, and elevation of the butt, degrees.
        `carom.aim` replaces a theta of nan by the smallest possible elevation; shots reject nan.
    a, b : array_like, shape (...)
        Where the tip hits the ball, in radii, with pooltool's sign: a > 0 is left of the centre, b
        > 0 above it; a^2 + b^2 < miscue^2. Default: 0 and 0.25. See also `tip`.
    ball : array_like of int, shape (...)
        Index of the ball that is struck.
    game : {"pool", "snooker", "billiard", "pooltool_pool", "pooltool_snooker", "pooltool_billiard"}
        The game whose cue supplies the defaults of the arguments below.
    mass, end_mass, tip_radius : array_like, shape (...)
        Mass of the cue, effective mass of its end, kg, and radius of the tip, m.
    miscue : array_like, shape (...)
        The offset, in radii, at which the tip slips off the ball, 0 to 1; 0 stands for 1, the edge.
        Chalked tips reach 0.5.
    tip_time : array_like, shape (...)
        Time for which the tip of an elevated cue presses the ball on the slate, s, up to 0.01; 0
        stands for 0.001, a leather tip. The hard resin of jump cues has 0.0008. -1: the blow and
        the landing are separate events.
    tip_restitution : array_like, shape (...)
        Restitution of tip and ball, 0 to 1; 0 stands for 1, without loss. The ball's speed is
        proportional to 1 + tip_restitution. Default: 0.73, leather, and 1 for pooltool's games;
        phenolic resin has 0.85.
    ball_speed : array_like, shape (...)
        Instead of `speed`: the speed of a ball of `game` just after the strike by a level cue, m/s.
    tip : array_like, shape (..., 2)
        Instead of `a` and `b`: (right, above), where the tip hits the ball relative to its centre,
        in radii, as in `carom shoot --tip`.
    follow : array_like, shape (...)
        How far the cue follows through after the contact, m, up to 1; 0: it stops. Default: 0.03, a
        convention, and 0 for pooltool's games.

    Returns
    -------
    ndarray of `carom.dtypes.cue`, shape (...)
    """
    if speed is not None and ball_speed is not None:
        raise ValueError(
            "cue: speed and ball_speed cannot be combined; pass the cue's speed or the ball's"
        )
    if tip is not None:
        if a is not None or b is not None:
            raise ValueError(
                "cue: tip cannot be combined with a or b; pass tip=(right, above), or a=-right and b=above"
            )
        places = as_array(tip, "tip", np.float64)
        if places.ndim < 1 or places.shape[-1] != 2:
            raise ValueError(
                f"tip: the shape is {places.shape}, but must be (..., 2): right of and above the centre"
            )
        a, b = 0.0 - places[..., 0], places[..., 1]
    for name, angle in (("phi", phi), ("theta", theta)):
        _doubt_radians(name, angle)
    if type(ball) is not int or abs(ball) >= 2**31:
        numbers = as_array(ball, "ball", np.float64)
        whole_ones = (np.abs(numbers) < 2**31) & (np.trunc(numbers) == numbers)
        if not whole_ones.all():
            raise ValueError(
                f"ball: {numbers[~whole_ones].flat[0]} is not the index of a ball; pass an integer"
            )
    usual = bytes(ffi.buffer(ffi.new("carom_cue *", lib.carom_cue_of(choice(GAMES, game, "game")))))
    if ball_speed is not None:
        speed = as_array(ball_speed, "ball_speed", np.float64)
    stroke = {"speed": speed, "phi": phi, "theta": theta, "a": a, "b": b, "ball": ball}
    more = {
        "miscue": miscue,
        "tip_time": tip_time,
        "tip_restitution": tip_restitution,
        "mass": mass,
        "end_mass": end_mass,
        "tip_radius": tip_radius,
    }
    more["follow"] = follow
    record = fill(dtypes.cue, {}, {**stroke, **more}, usual)
    if ball_speed is not None:
        _strike_to(record, game)
    if record.shape == ():
        checked = record.copy()
        if np.isnan(record["theta"]):
            checked["theta"] = 0.0  # nan is allowed: carom.aim() then finds the elevation
        refuse_numbers(lib.CAROM_PART_CUE, "cue", checked)
    return record


def _strike_to(cues: Records, game: Game) -> None:
    """Convert the speeds of cues from balls' speeds to cues' speeds.

    A ball's speed is proportional to the speed of a level cue.
    """
    if (cues["theta"] != 0.0).any():
        raise ValueError(
            "ball_speed: defined for a level cue only; with theta, pass speed, the cue's speed"
        )
    kind = balls([[0.0, 0.0]], game=game)[0]["kind"]
    flat = cues.reshape(-1)
    speed, phi = flat["speed"].copy(), flat["phi"].copy()
    flat["speed"], flat["phi"] = (
        1.0,
        0.0,
    )  # along x, and by a square root, for the same bits in other languages
    for k in range(flat.size):
        x, y, _ = struck(flat[k : k + 1].reshape(()), kind)["v"]
        flat["speed"][k] = speed[k] / np.sqrt(x * x + y * y)
    flat["phi"] = phi


def _doubt_radians(name: str, angle: ArrayLike) -> None:
    """Warn of angles that look like radians: within a turn, and one a multiple of pi / 12."""
    angles = as_array(angle, name, np.float64)
    if not (np.abs(angles) < 24.5 * np.pi / 12.0).all():
        return
    turns = angles * (12.0 / np.pi)
    nearest = np.round(turns)
    like = angles[(np.abs(turns - nearest) < 1e-12) & (nearest != 0.0)]
    if like.size:
        first = like.flat[0]
        warnings.warn(
            f"{name}: {first} looks like radians, but the unit is degrees; if you mean {np.degrees(first):.6g} degrees, use np.degrees()",
            stacklevel=3,
        )


def struck(cue: Records, kind: Records) -> Records:
    """Compute the motion of a ball at rest after a strike.

    Parameters
    ----------
    cue : ndarray of `carom.dtypes.cue`, shape ()
    kind : ndarray of `carom.dtypes.ball_kind`, shape ()

    Returns
    -------
    ndarray of `carom.dtypes.motion`, shape ()
        v (m/s) and w (rad/s).
    """
    motion: Array = np.zeros((), dtypes.motion)
    strike = one_cue(cue)
    ball = of_record(kind, dtypes.ball_kind, "kind", "balls()['kind']").reshape(1)
    code = lib.carom_strike(
        pointer("carom_cue[]", strike),
        pointer("carom_ball_kind[]", ball),
        pointer("carom_motion[]", motion),
    )
    if code < 0:
        raise strike_error(code, strike, ball[0])
    return motion
