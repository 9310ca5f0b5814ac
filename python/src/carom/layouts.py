"""What a shot begins with: tables, balls, cues."""

from __future__ import annotations

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
    number,
    pointer,
    raw,
    sealed,
    several,
    text_of,
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


class Table:
    """A table of any geometry: cushions, their rounded ends, pockets.

    A table does not change: its arrays cannot be written to, and `changed` makes another table.
    Tables with equal numbers are equal, and have one hash.

    Parameters
    ----------
    width, length : float
        m, for drawing and racks. The built-in tables have their surface at 0 <= x <= width, 0 <= y
        <= length.
    rails : ndarray of `carom.dtypes.rail`, shape (up to 32,)
        Straight pieces of cushion: p, q and height (m), side, and line, all 0 to have it derived;
        mu_cushion and restitution of its own, 0 for those of the ball.
    jaws : ndarray of `carom.dtypes.jaw`, shape (up to 32,)
        Rounded ends: centre, radius, height (m); mu_cushion and restitution, as of rails.
    pockets : ndarray of `carom.dtypes.pocket`, shape (up to 8,)
        centre, radius, depth (m).
    ball_radius, rail_width, pocket_back : float
        m; 0: as carom_shot.h says. The radius of the balls that the rails are meant for, the width
        of the tops of the rails, and the height of the pockets' backs. They count for balls that
        fly, and for balls of other radii.
    slope_x, slope_y : float
        By how much the cloth rises for each metre along x and y; 0: level.
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
            record[name] = number(size, name, f"a {unit} is needed")
            if name in ("width", "length") and not 0.0 < record[name] < np.inf:
                raise ValueError(
                    f"{name}: it must be positive and finite, in m, not {record[name]:g}"
                )
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
                    f"{name}: an array of carom.dtypes.{part} of shape (up to {room},) is needed"
                )
            record[name] = len(values)
            raw(record[part])[: len(values)] = raw(np.ascontiguousarray(values))
        self.record: Records = sealed(record)

    @classmethod
    def from_record(cls, record: Records) -> Table:
        """The table of a record of `carom.dtypes.table`, of shape (), which is copied."""
        table = cls.__new__(cls)
        table.record = frozen(np.asarray(record, dtypes.table)).reshape(())
        return table

    def changed(self, **parts: Any) -> Table:
        """This table except some of its parameters, by their names.

        >>> rails = table.rails.copy()
        >>> rails["mu_cushion"] = 0.3
        >>> table = table.changed(rails=rails)
        """
        sizes = ("width", "length", "ball_radius", "rail_width", "pocket_back", *self.slope)
        fields: dict[str, Any] = {name: float(self.record[name]) for name in sizes}
        fields |= {"rails": self.rails, "jaws": self.jaws, "pockets": self.pockets}
        if unknown := parts.keys() - fields.keys():
            raise TypeError(f"table: there is no {min(unknown)!r}; known are {', '.join(fields)}")
        return Table(**{**fields, **parts})

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.record = sealed(state["record"])

    @property
    def width(self) -> float:
        """m, along x."""
        return float(self.record["width"])

    @property
    def length(self) -> float:
        """m, along y."""
        return float(self.record["length"])

    @property
    def slope(self) -> dict[str, float]:
        """slope_x and slope_y."""
        return {name: float(self.record[name]) for name in ("slope_x", "slope_y")}

    @property
    def rails(self) -> Records:
        """The straight pieces of cushion: a view, which cannot be written to."""
        return self._parts("rail", "rails")

    @property
    def jaws(self) -> Records:
        """The rounded ends of cushions: a view, which cannot be written to."""
        return self._parts("jaw", "jaws")

    @property
    def pockets(self) -> Records:
        """The pockets: a view, which cannot be written to."""
        return self._parts("pocket", "pockets")

    @property
    def rail_names(self) -> list[str | None]:
        """Where each rail is for a player at the head, y = 0: "head", "foot", "left", "right"; None
        for a pocket's cut, and off rectangles.
        """
        return self._names(lib.carom_rail_name, "rails")

    @property
    def pocket_names(self) -> list[str | None]:
        """The same of each pocket, such as "foot-left" or "side-right"; None on tables that are no
        rectangles.
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
        """Raise what is wrong with the table for balls of a radius, m: numbers, holes through which
        a ball can leave, sides of rails.

        The built-in tables are right. This takes some milliseconds; `simulate` checks the numbers
        only.

        Raises
        ------
        CaromError
            Its `field` is the part at fault, its sentence says where the fault is.
        """
        fault = ffi.new("carom_table_fault *")
        refuse_table(
            lib.carom_table_check(pointer("carom_table[]", self.record), radius, fault), fault
        )

    def __eq__(self, other: object) -> bool:
        """Whether all numbers are the same."""
        return isinstance(other, Table) and bool(np.array_equal(self.record, other.record))

    def __hash__(self) -> int:
        # of what equal tables share; numbers, as -0.0 and 0.0 are equal and have other bytes
        numbers = (self.rails["p"], self.rails["restitution"], self.pockets["centre"])
        parts = (tuple(values.ravel().tolist()) for values in numbers)
        return hash((self.width, self.length, len(self.jaws), *parts))

    def __repr__(self) -> str:
        sizes = f"{len(self.rails)} rails, {len(self.jaws)} jaws, {len(self.pockets)} pockets"
        return f"<carom.Table {self.width:.4g} m x {self.length:.4g} m, {sizes}>"

    def _repr_svg_(self) -> str:
        return pictures.picture(self)

    def plot(self, ax: Any = None) -> Any:
        """The table, drawn on axes of matplotlib, in metres; the axes are returned."""
        return pictures.plot(self, None, ax)


def refuse_table(code: int, fault: Any) -> None:
    """Raises an error of a table, with the place of its fault."""
    if code < 0:
        partner = (
            "" if fault.other.kind == lib.CAROM_PART_NONE else f", beside {_part(fault.other)}"
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
        raise TypeError(
            f"table: a carom.Table is needed, such as carom.tables.pool_9ft() gives, not {type(table).__name__}"
        )


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
    """The radius of the balls of a built-in table, a carom_table_kind, m."""
    return float(lib.carom_ball_kind_of(lib.carom_game_of_table(kind)).radius)


def _sizes() -> dict[tuple[float, float], list[float]]:
    """The radii of the balls that are played on built-in tables of a size."""
    found: dict[tuple[float, float], list[float]] = {}
    measures = ffi.new("carom_measures *")
    for kind in worded("TABLE").values():
        lib.carom_table_measures(kind, measures)
        found.setdefault((measures.width, measures.length), []).append(radius_on(kind))
    return found


_SIZES = _sizes()


@functools.lru_cache(maxsize=256)
def _other_constants(kind: bytes, cushion_model: str) -> str:
    """What is to be said of a ball that has a game's constants of another model of the cushion."""
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
                f"balls(game={game!r}, cushion_model={cushion_model!r}) have its own"
                if cushion_model in constants_of_model
                else f"{game} has no constants for it"
            )
    return ""


def doubt_balls(table: Table, kinds: Array, cushion_model: object) -> None:
    """Warns of balls of another game than that whose balls the table is made for, and of those with
    a game's constants of another model of the cushion than that which is asked for by name.
    """
    table_radius = table.record["ball_radius"].item()
    radii = [table_radius] if table_radius else _SIZES.get((table.width, table.length), [])
    first: Any = (
        kinds[(0,) * kinds.ndim] if kinds.size else None
    )  # of one record: kinds.flat[:1] copies it field by field
    radius = None if first is None else first["radius"]
    if radius in _RADII and radii and radius not in radii and radii[0] in _RADII:
        meant = radii[0]
        warnings.warn(
            f"balls: they are of {_RADII[radius]}, radius {radius:g} m, but the table is made for those of {_RADII[meant]}, radius {meant:g} m: "
            f"game={_RADII[meant]!r} makes these",
            stacklevel=3,
        )
    named = isinstance(cushion_model, str) and cushion_model != "default" and first is not None
    if (
        named
        and cushion_model in _CUSHIONS
        and (doubt := _other_constants(first.tobytes(), str(cushion_model)))
    ):
        warnings.warn(
            f"cushion_model: {cushion_model!r} plays constants of another model: {doubt}",
            stacklevel=3,
        )


def of_record(values: Records, record: Record, name: str, builder: str) -> Array:
    """The values in C order, refused where they are not of the record, which carom.<builder> gives."""
    array = as_array(values, name)
    if array.dtype != record:
        raise TypeError(
            f"{name}: an array of the dtype of carom.{builder} is needed, not of {dtypes.described(array.dtype)}"
        )
    return np.asarray(array, order="C")


def one_cue(cue: Records, name: str = "cue") -> Array:
    """A cue of shape (); many are refused."""
    cues = of_record(cue, dtypes.cue, name, "cue()")
    if cues.size != 1:
        raise ValueError(f"{name}: one is needed, not {cues.size}; simulate_batch plays many")
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
    """Ball in hand: a copy of a layout, in which the ball of this index lies at rest at (x, y), m,
    also one that was pocketed.

    Raises
    ------
    CaromError
        The place is not free: `field` is the ball or the part of the table that is in the way.
    """
    placed = of_record(balls, dtypes.shot_ball, "balls", "balls()").copy()
    if placed.ndim != 1:
        raise TypeError(f"balls: an array of shape (balls,) is needed, not of {placed.shape}")
    check_table(table)
    way = ffi.new("carom_part *")
    of_table, layout = pointer("carom_table[]", table.record), pointer("carom_shot_ball[]", placed)
    index = whole(ball, "ball", most=len(placed) - 1)
    x, y = number(x, "x", "a place in m is needed"), number(y, "y", "a place in m is needed")
    code = lib.carom_place_ball(of_table, layout, len(placed), index, x, y, way)
    if code in (lib.CAROM_ERROR_OVERLAP, lib.CAROM_ERROR_OFF_TABLE):
        raise CaromError(
            code,
            _part(way),
            text=f"is in the way of ball {index} at x = {x} m, y = {y} m; a free place on the table is needed",
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
    """A layout as `plan` and `referee` want it, in which ball k is number k, from balls in any
    order; those that are missing are down.

    Parameters
    ----------
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
    ids : sequence of int or str
        The number of each, as a line of `carom shoot` names its balls; in snooker also "red1" to
        "red15", and the names of the colours.
    rules : str
        The game, as of `plan`: numbers are 1 to 15, 1 to 9, or 1 to 21, from 16 on the colours.
    cue : int or str
        Which of the ids is the cue ball's.

    Returns
    -------
    ndarray of `carom.dtypes.shot_ball`, shape (16,), (10,) or (22,)

    Raises
    ------
    ValueError
        A ball is none of the game, or there twice, or there is no cue ball.
    """
    layout = of_record(balls, dtypes.shot_ball, "balls", "balls()")
    names = list(
        map(str, several(ids, "ids", "the number of each ball is needed, and the cue ball's name"))
    )
    last = choice(LAST, rules, "rules")
    if layout.shape != (len(names),):
        raise ValueError(
            f"ids: one for each ball of an array of shape (balls,) is needed, not {len(names)} for {layout.shape}"
        )
    if names.count(str(cue)) != 1:
        raise ValueError(f"cue: it must be one of the ids, once, not {cue!r}")
    index_of: dict[int, int] = {}
    for k, name in enumerate(names):
        number = _COLOURS.get(name, name.removeprefix("red")) if rules == "snooker" else name
        of_ball = 0 if name == str(cue) else int(number) if number.isdecimal() else -1
        if not 0 <= of_ball <= last or of_ball in index_of or (of_ball == 0 and name != str(cue)):
            raise ValueError(
                f"ids: ball {name!r}: the balls of {rules} are the cue ball and 1 to {last}, each once"
            )
        index_of[of_ball] = k
    ordered = layout[[index_of.get(ball, index_of[0]) for ball in range(last + 1)]]
    down = [ball for ball in range(last + 1) if ball not in index_of]
    ordered["state"][down] = np.zeros((), dtypes.ball_state)
    ordered["state"]["r"][down, 2], ordered["state"]["label"][down] = -0.1, lib.CAROM_BALL_POCKETED
    return ordered


def _finite(**named: ArrayLike) -> None:
    """Refuses one layout whose numbers are not finite; of many, a wrong one costs its own shots."""
    for name, values in named.items():
        numbers = as_array(values, name, np.float64)
        if not np.isfinite(numbers).all():
            wrong = numbers[~np.isfinite(numbers)].flat[0]
            raise ValueError(f"{name}: finite numbers are needed, not {wrong}")


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
    """Balls on a table, from fields that are broadcast against each other.

    Parameters
    ----------
    r : array_like, shape (..., balls, 2) or (..., balls, 3)
        Centres, m; without a z they lie on the cloth.
    v, w : array_like, shape (..., 3)
        Velocities, m/s, and angular velocities, rad/s.
    game : {"pool", "snooker", "billiard", "pooltool_pool", "pooltool_snooker", "pooltool_billiard"}
        Whose balls they are: the defaults of the fields of `carom.dtypes.ball_kind`, which follow.
        docs/reference/constants.md has the source of each number: those of billiard are
        measured, with drag and loss of roll; pooltool_... are pooltool's figures.
    cushion_model
        The model of the cushion whose constants they have, as of `simulate`. A warning tells where
        the game has none for it.
    conditions : sequence of str
        Conditions of a pool table, such as ("fast_cloth", "old_cushion"); docs/using/fit.md
        lists them. Numbers that are given besides replace theirs.
    **kind : array_like, shape (...)
        Numbers of `carom.dtypes.ball_kind`, by their names.

    Returns
    -------
    ndarray of `carom.dtypes.shot_ball`, shape (..., balls)
    """
    unknown = [name for name in kind if name not in (dtypes.ball_kind.names or ())]
    if unknown:
        raise TypeError(
            f"balls: there is no field {unknown[0]!r}; known are {', '.join(dtypes.ball_kind.names or ())}"
        )
    fields = {
        f"kind.{name}": value for name, value in cast("dict[str, ArrayLike | None]", kind).items()
    }
    centres = as_array(r, "r", np.float64)
    if centres.ndim < 2 or centres.shape[-1] not in (2, 3):
        raise ValueError(
            f"r: the shape must be (..., balls, 2) or (..., balls, 3), not {centres.shape}"
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
            f"cushion_model: {game} has no constants for {cushion_model!r}; the balls have those for its default model",
            stacklevel=2,
        )
    pool = lib.carom_ball_kind_of(GAMES["pool"])
    if (
        conditions
        and lib.carom_ball_kind_of(number).restitution_cushion != pool.restitution_cushion
    ):
        raise ValueError(f"conditions: they are of tables of pool, not of {game}")
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
    """Build a cue with its strike, or many.

    The fields are broadcast against each other. One cue with a number outside its range is refused.
    Of many, a wrong one costs its own shot.

    Parameters
    ----------
    speed : array_like, shape (...)
        Speed of the cue before the strike, m/s; 0: no strike. Default 2.
    phi, theta : array_like, shape (...)
        Direction in the plane from +x towards +y, and elevation of the butt, degrees. With a theta
        of nan `carom.aim` finds the least elevation; shots refuse it.
    a, b : array_like, shape (...)
        Where the tip touches the ball, in units of its radius, with pooltool's sign: a > 0 left, b
        > 0 above the centre; a^2 + b^2 < miscue^2. Default 0 and 0.25.
    ball : array_like of int, shape (...)
        Index of the ball that is struck.
    game : {"pool", "snooker", "billiard", "pooltool_pool", "pooltool_snooker", "pooltool_billiard"}
        The game whose cue gives the defaults of the later arguments.
    mass, end_mass, tip_radius : array_like, shape (...)
        kg, kg, m.
    miscue : array_like, shape (...)
        0 to 1: the offset at which the tip slips off the ball; 0: 1, at its edge. Chalked tips
        reach 0.5.
    tip_time : array_like, shape (...)
        s, to 0.01: how long the tip of a raised cue presses the ball on the slate; 0: 0.001, a
        leather tip. Hard resin, with which balls jump, has 0.0008. -1: no time, so that the blow
        and the landing are two events, as before revision 8.
    tip_restitution : array_like, shape (...)
        Restitution of the tip and the ball, 0 to 1; 0: 1, without loss. The speed of the ball is in
            proportion to 1 + tip_restitution. Default
        0.73, leather, and 1 for pooltool's games; phenolic resin has 0.85.
    ball_speed : array_like, shape (...)
        Instead of `speed`: that of a ball of `game` just after the strike of a level cue, m/s.
    tip : array_like, shape (..., 2)
        Instead of `a` and `b`: where the tip touches, right of and above the centre, as `carom
        shoot --tip` has it.
    follow : array_like, shape (...)
        m, to 1: how far the cue goes on after it has touched the ball; 0: it stops. Default 0.03, a
        convention; 0 for pooltool's games.

    Returns
    -------
    ndarray of `carom.dtypes.cue`, shape (...)
    """
    if speed is not None and ball_speed is not None:
        raise ValueError(
            "cue: speed is that of the cue, ball_speed that of the ball: one of both is needed"
        )
    if tip is not None:
        if a is not None or b is not None:
            raise ValueError("cue: tip says what a and b say: one of both is needed")
        places = as_array(tip, "tip", np.float64)
        if places.ndim < 1 or places.shape[-1] != 2:
            raise ValueError(
                f"tip: the shape must be (..., 2), right of and above the centre, not {places.shape}"
            )
        a, b = 0.0 - places[..., 0], places[..., 1]
    for name, angle in (("phi", phi), ("theta", theta)):
        _doubt_radians(name, angle)
    if type(ball) is not int or abs(ball) >= 2**31:
        numbers = as_array(ball, "ball", np.float64)
        whole_ones = (np.abs(numbers) < 2**31) & (np.trunc(numbers) == numbers)
        if not whole_ones.all():
            raise ValueError(
                f"ball: it must be the index of one of the balls, a whole number, not {numbers[~whole_ones].flat[0]}"
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
            checked["theta"] = 0.0  # nan is right: carom.aim() then finds the elevation
        refuse_numbers(lib.CAROM_PART_CUE, "cue", checked)
    return record


def _strike_to(cues: Records, game: Game) -> None:
    """Gives cues, whose speeds are those of balls, the speeds that they need.

    The ball's speed is in proportion to the level cue's.
    """
    if (cues["theta"] != 0.0).any():
        raise ValueError(
            "ball_speed: it is that which a level cue gives the ball; with theta give speed, the speed of the cue"
        )
    kind = balls([[0.0, 0.0]], game=game)[0]["kind"]
    flat = cues.reshape(-1)
    speed, phi = flat["speed"].copy(), flat["phi"].copy()
    flat["speed"], flat["phi"] = (
        1.0,
        0.0,
    )  # along x, and by a root, it has the same bits in other languages
    for k in range(flat.size):
        x, y, _ = struck(flat[k : k + 1].reshape(()), kind)["v"]
        flat["speed"][k] = speed[k] / np.sqrt(x * x + y * y)
    flat["phi"] = phi


def _doubt_radians(name: str, angle: ArrayLike) -> None:
    """Warns of angles that are within a turn in radians, one of them a twelfth of pi or a multiple
    of it, as few degrees are.
    """
    angles = as_array(angle, name, np.float64)
    if not (np.abs(angles) < 24.5 * np.pi / 12.0).all():
        return
    turns = angles * (12.0 / np.pi)
    nearest = np.round(turns)
    like = angles[(np.abs(turns - nearest) < 1e-12) & (nearest != 0.0)]
    if like.size:
        first = like.flat[0]
        warnings.warn(
            f"{name}: degrees are taken, but {first} looks like radians, for {np.degrees(first):.6g} degrees: np.degrees() converts",
            stacklevel=3,
        )


def struck(cue: Records, kind: Records) -> Records:
    """The motion of a ball at rest after a strike: `carom.dtypes.motion` of a `carom.dtypes.cue`
    and a `carom.dtypes.ball_kind`, shapes ().
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
