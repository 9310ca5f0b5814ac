"""Impacts of a ball on a cushion, and an impact followed in steps."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, NamedTuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import CushionConvention, CushionLaw, CushionModel, CushionNumbers
from carom._impacts import CUSHION, Outcome, resolve
from carom._impacts import trace as follow
from carom._rows import (
    Array,
    as_array,
    cached,
    choice,
    either,
    fill,
    named,
    number,
    pointer,
    text_of,
    unknown_name,
    whole,
    worded,
)
from carom.status import CaromError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom.layouts import Table

_MODELS, _CONVENTIONS, _LAWS = (
    worded("CUSHION_MODEL"),
    worded("CUSHION_CONVENTION"),
    worded("CUSHION_LAW"),
)
_ROWS = iter((lib.carom_number_of(lib.CAROM_PART_BALL, k) for k in range(1000)).__next__, ffi.NULL)
NUMBERS = [text_of(row.name) for row in _ROWS if row.cushion_offset >= 0]


def _own(numbers: Any) -> tuple[tuple[str, float], ...]:
    """Parameters of the models by their names."""
    for name in numbers:
        if name not in NUMBERS:
            raise TypeError(unknown_name("cushion()", "argument", name, NUMBERS))
    return tuple((name, number(value, name)) for name, value in numbers.items())


@cached
def _options(
    model: str,
    convention: str,
    law: str,
    steps: int,
    threads: int,
    least_step: float,
    plain: bool,
    own_numbers: tuple[tuple[str, float], ...],
) -> Any:
    """The options of C, which are read-only."""
    if not 0.0 <= (least_step := number(least_step, "least_step", "a step in N s")) < np.inf:
        raise ValueError(f"least_step: {least_step!r} N s is negative or not finite; use 0 or more")
    kind, must = (
        ffi.new("carom_ball_kind *", lib.carom_ball_kind_of(lib.CAROM_GAME_POOLTOOL_POOL)),
        ffi.new("char[]", 100),
    )
    for name, value in own_numbers:
        setattr(kind, name, value)
    if (wrong := lib.carom_ball_fault(kind, must, 100)) != ffi.NULL:
        name = text_of(wrong.name)
        raise ValueError(
            f"{name}: {getattr(kind, name)!r} is out of range; it must be {text_of(must)}"
        )
    names = {
        "model": choice(_MODELS, model, "model"),
        "convention": choice(_CONVENTIONS, convention, "convention"),
        "law": choice(_LAWS, law, "law"),
    }
    numbers = {
        "steps": whole(steps, "steps"),
        "threads": whole(threads, "threads", least=-1),
        "plain": whole(plain, "plain", most=1),
    }
    return ffi.new(
        "carom_cushion_options *",
        {**names, **numbers, "least_step": least_step, **dict(own_numbers)},
    )


_GAMES = worded("GAME")


def _first_tables() -> dict[str, int]:
    """A built-in table of each game that has one; all tables of a game have the same noses."""
    names = {number: name for name, number in _GAMES.items()}
    found: dict[str, int] = {}
    for kind in worded("TABLE").values():
        found.setdefault(names[lib.carom_game_of_table(kind)], kind)
    return found


_TABLES = _first_tables()


def _has_constants(game: str, model: int, kind: Any) -> bool:
    """Whether a game has constants for a model of cushions, which are written to a kind of ball."""
    return bool(lib.carom_ball_kind_for(_GAMES[game], model + 1, kind))


@functools.cache
def _ball(game: str, model: str) -> Any:
    """The ball and the cushion of a game for a model.

    If the ball specifies no nose height, the game's table does.
    """
    kind, measures = ffi.new("carom_ball_kind *"), ffi.new("carom_measures *")
    if not _has_constants(game, _MODELS[model], kind):
        known = [name for name, number in _MODELS.items() if _has_constants(game, number, kind)]
        raise ValueError(
            f"model: there are no constants for {model!r} in the game {game!r}; use {either(map(repr, known))}"
        )
    lib.carom_table_measures(_TABLES[game], measures)
    kind.nose_height = kind.nose_height or measures.nose_height
    return kind


def cushion_impacts(
    *,
    v: ArrayLike,
    w: ArrayLike = 0.0,
    normal: ArrayLike = (0.0, 1.0),
    height: ArrayLike | None = None,
    radius: ArrayLike | None = None,
    mass: ArrayLike | None = None,
    mu_slide: ArrayLike | None = None,
    mu_cushion: ArrayLike | None = None,
    restitution: ArrayLike | None = None,
    jaw_radius: ArrayLike = 0.0,
    game: str = "pool",
    model: CushionModel = "mathavan",
) -> dtypes.Records:
    """Build impacts for `cushion`.

    The arguments are broadcast against each other. Omitted fields take the values of `game` for
    `model`.

    Parameters
    ----------
    v, w : array_like, shape (..., 3)
        Velocity, m/s (vertical 0), and angular velocity, rad/s.
    normal : array_like, shape (..., 2)
        Direction from the ball into the cushion, of any nonzero length.
    height : array_like, shape (...)
        Height of the nose above the cloth, m, between 0 and 2 radii.
    radius, mass : array_like, shape (...)
        Radius, m, and mass, kg, of the ball.
    mu_slide, mu_cushion, restitution : array_like, shape (...)
        Friction on the cloth, friction and restitution at the cushion, 0 to 1.
    jaw_radius : array_like, shape (...)
        Radius of a rounded jaw, m; 0 for a straight rail.
    game : {"pool", "snooker", "billiard", "blackball", "pyramid", "fourball"}
        The game whose ball, cloth and cushion supply the defaults.
    model : str
        The model of the cushion for which the defaults were fitted; pass the same one to `cushion`.

    Returns
    -------
    ndarray of `carom.dtypes.cushion_impact`, shape (...)
    """
    of_game: dict[str, tuple[ArrayLike | None, str]] = {
        "height": (height, "nose_height"),
        "radius": (radius, "radius"),
        "mass": (mass, "mass"),
        "mu_slide": (mu_slide, "mu_slide"),
        "mu_cushion": (mu_cushion, "mu_cushion"),
        "restitution": (restitution, "restitution_cushion"),
    }
    fields: dict[str, ArrayLike] = {"v": v, "w": w, "normal": normal, "jaw_radius": jaw_radius}
    defaults = _ball(named(_TABLES, game, "game"), named(_MODELS, model, "model"))
    for name, (value, number_of_kind) in of_game.items():
        fields[name] = value if value is not None else getattr(defaults, number_of_kind)
    return fill(dtypes.cushion_impact, {"v": 3, "w": 3, "normal": 2}, fields)


def cushion(
    impacts: ArrayLike,
    *,
    model: CushionModel = "mathavan",
    convention: CushionConvention = "paper",
    law: CushionLaw = "constant",
    steps: int = 0,
    least_step: float = 0.0,
    plain: bool = False,
    threads: int = 0,
    out: tuple[Array, Array] | None = None,
    game: str | None = None,
    **numbers: Unpack[CushionNumbers],
) -> Outcome:
    """Resolve impacts of a ball on a cushion.

    Parameters
    ----------
    impacts : array_like, shape (..., 15), or structured of shape (...)
        Rows of float64 (others are converted), or of `carom.dtypes.cushion_impact`; see
        `carom.cushion_impacts`.
    model : {"mathavan", "stronge", "han", "mirror", "euler", "smooth"}
        "mathavan": the exact limit of Mathavan's model of 2010. "euler": its steps. The others are
        closed forms (docs/understanding/cushion.md).
    convention : {"paper", "pooltool"}
        Whose geometry to use where pooltool departs from the papers.
    law : {"constant", "han"}
        "constant": restitution and friction of the impact. "han": Han's fits.
    steps : int
        Euler's N; 0 is 1000.
    least_step : float
        Smallest impulse of a step of "euler", N s; pooltool uses 0.001.
    plain, threads, out
        As for `carom.collide`.
    game : {"pool", "snooker", "billiard", "blackball", "pyramid", "fourball"}, optional
        The game that supplies omitted parameters of the model, such as roll_loss. None: they are 0,
        as in C.
    **numbers : float
        Parameters of the models, such as omega_ratio of stronge; the command `carom models` lists
        them.

    Returns
    -------
    motion : ndarray of float64, shape (..., 6), or structured of shape (...)
        v (m/s) and w (rad/s) after the impact, or `carom.dtypes.motion`. NaN for an invalid impact.
    status : ndarray of int8, shape (...)
        0: resolved. 1: the ball does not move into the cushion. Negative: an error, see `Status`.

    Raises
    ------
    CaromError
        A single impact, of shape (15,) or (), is invalid.
    """
    own_numbers = dict(_own(numbers))
    if game is not None:
        kind = _ball(named(_TABLES, game, "game"), named(_MODELS, model, "model"))
        own_numbers = {name: getattr(kind, name) for name in NUMBERS} | own_numbers
    options = _options(
        model, convention, law, steps, threads, least_step, plain, tuple(own_numbers.items())
    )
    seconds = 1e-5 if model == "mathavan" else 1e-7 * (steps or 1000) if model == "euler" else 1e-7
    return resolve(CUSHION, impacts, options, seconds, threads, out)


class Calibrated(TypedDict):
    """The fields of a ball's kind that three banks determine."""

    restitution_cushion: float
    mu_cushion: float


class Calibration(NamedTuple):
    """The properties of a table's cushion from three banks; see `calibrate`.

    `constants` are fields of a ball's kind, for `carom.balls(r, **constants)`.
    """

    constants: Calibrated
    errors: Calibrated
    comes_back: tuple[float, float, float]
    misfit: float


def calibrate(
    readings: ArrayLike | None, table: Table | None = None, *, game: str = "pool"
) -> Calibration:
    """Find the restitution and the friction of a table's cushions from three played banks.

    Parameters
    ----------
    readings : array_like, shape (3,), or None
        Where the three banks of the command `carom calibrate` returned, in diamonds from their
        corner, each above 0 and below 8. None: nothing is fitted, and `comes_back` contains the
        readings that the game's constants predict.
    table : Table, optional
        The table on which they were played. Default: `carom.tables.pool_9ft()`.
    game : {"pool", "snooker", "billiard"}
        The game whose ball and cushion are the prior.

    Returns
    -------
    Calibration
        The constants, their standard deviations, the readings that these constants predict, and the
        rms misfit of the readings in units of 25 mm. A misfit above 2 means that a reading is
        wrong.

    Raises
    ------
    ValueError
        The readings are not three numbers above 0 and below 8.
    CaromError
        A bank does not return to its rail.
    """
    from carom import (
        tables,
    )  # not at the top: carom.tables imports layouts, which must not depend on this module

    record = (tables.pool_9ft() if table is None else table).record
    kind = ffi.new("carom_ball_kind *", lib.carom_ball_kind_of(choice(_GAMES, game, "game")))
    measured, found = ffi.NULL, ffi.new("carom_calibration *")
    if readings is not None:
        read = as_array(readings, "readings", np.float64)
        if read.shape != (3,):
            raise ValueError(f"readings: the shape is {read.shape}, but must be (3,): three banks")
        if not ((read > 0) & (read < 8)).all():
            raise ValueError(
                f"readings: {read.tolist()} is out of range; each reading must be above 0 and below 8 diamonds"
            )
        measured = ffi.new("double[3]", read.tolist())
    code = lib.carom_calibrate(pointer("carom_table[]", record), kind, measured, found)
    if code < 0:
        raise CaromError(code, "readings", None if readings is None else tuple(read.tolist()))
    return Calibration(
        {"restitution_cushion": found.restitution, "mu_cushion": found.friction},
        {"restitution_cushion": found.restitution_error, "mu_cushion": found.friction_error},
        tuple(found.comes_back),
        found.misfit,
    )


def cushion_trace(
    impact: ArrayLike,
    points: int = 101,
    *,
    model: CushionModel = "mathavan",
    convention: CushionConvention = "paper",
    law: CushionLaw = "constant",
    steps: int = 0,
    least_step: float = 0.0,
    plain: bool = False,
) -> dtypes.Records:
    """Follow one impact, of shape (15,) or (), at `points` equally spaced normal impulses.

    They range from 0 to the end of the impact. The model is "mathavan" or "euler"; options are as
    for `cushion`.

    Returns
    -------
    ndarray of `carom.dtypes.cushion_point`, shape (points,)

    Raises
    ------
    CaromError
        The impact is invalid.
    """
    followed = named(("mathavan", "euler"), model, "model")
    return follow(
        CUSHION,
        impact,
        points,
        _options(followed, convention, law, steps, 0, least_step, plain, ()),
    )
