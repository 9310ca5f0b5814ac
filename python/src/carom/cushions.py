"""The impact of a ball on a cushion: one and many, and an impact on its way."""

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
    fill,
    number,
    pointer,
    text_of,
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
    """Numbers of the models by their names."""
    for name in numbers:
        if name not in NUMBERS:
            raise TypeError(
                f"cushion() has no argument {name!r}; numbers of its models are {', '.join(NUMBERS)}"
            )
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
    """The options of C; they are never written to."""
    if (
        not 0.0
        <= (least_step := number(least_step, "least_step", "a step in N s is needed"))
        < np.inf
    ):
        raise ValueError(f"least_step: it must be 0 or more and finite, in N s, not {least_step!r}")
    kind, must = (
        ffi.new("carom_ball_kind *", lib.carom_ball_kind_of(lib.CAROM_GAME_POOLTOOL_POOL)),
        ffi.new("char[]", 100),
    )
    for name, value in own_numbers:
        setattr(kind, name, value)
    if (wrong := lib.carom_ball_fault(kind, must, 100)) != ffi.NULL:
        name = text_of(wrong.name)
        raise ValueError(f"{name}: it must be {text_of(must)}, not {getattr(kind, name)!r}")
    named = {
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
        {**named, **numbers, "least_step": least_step, **dict(own_numbers)},
    )


_TABLES = {
    "pool": lib.CAROM_TABLE_POOL_9FT,
    "snooker": lib.CAROM_TABLE_SNOOKER,
    "billiard": lib.CAROM_TABLE_THREECUSHION,
    "blackball": lib.CAROM_TABLE_BLACKBALL,
    "pyramid": lib.CAROM_TABLE_PYRAMID,
    "fourball": lib.CAROM_TABLE_FOURBALL,
}


@functools.cache
def _ball(game: str, model: str) -> Any:
    """The ball and the cushion of a game for a model; its nose is that of the game's table where
    the ball has none.
    """
    if game not in _TABLES:
        raise ValueError(f"game: must be one of {', '.join(_TABLES)}, not {game!r}")
    kind, measures = ffi.new("carom_ball_kind *"), ffi.new("carom_measures *")
    shot_cushion = choice(_MODELS, model, "model") + 1
    if not lib.carom_ball_kind_for(choice(worded("GAME"), game, "game"), shot_cushion, kind):
        raise ValueError(f"model: {game} has no constants for {model!r}")
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
    """Impacts for `cushion`, from fields that are broadcast against each other. Fields that are
    not given are those of a game for a model.

    Parameters
    ----------
    v, w : array_like, shape (..., 3)
        Velocity, m/s (vertical 0), and angular velocity, rad/s.
    normal : array_like, shape (..., 2)
        Direction from the ball into the cushion, of any length but 0.
    height : array_like, shape (...)
        Of the nose above the cloth, m, between 0 and 2 radius.
    radius, mass : array_like, shape (...)
        Of the ball, m and kg.
    mu_slide, mu_cushion, restitution : array_like, shape (...)
        0 to 1.
    jaw_radius : array_like, shape (...)
        m; 0 for a straight rail.
    game : {"pool", "snooker", "billiard", "blackball", "pyramid", "fourball"}
        Whose ball, cloth and cushion.
    model : str
        The model of the cushion for which the game's numbers are; give the same to `cushion`.

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
    for name, (value, number_of_kind) in of_game.items():
        fields[name] = value if value is not None else getattr(_ball(game, model), number_of_kind)
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
        Mathavan's model of 2010 in its exact limit, closed forms, or the steps of that model.
    convention : {"paper", "pooltool"}
        Whose geometry holds where pooltool departs from the papers.
    law : {"constant", "han"}
        Restitution and friction from the impact, or Han's fits.
    steps : int
        Euler's N; 0 is 1000.
    least_step : float
        Least impulse of a step of Euler's, N s; pooltool has 0.001.
    plain, threads, out
        As for `carom.collide`.
    game : {"pool", "snooker", "billiard", "blackball", "pyramid", "fourball"}, optional
        Whose numbers of the model hold, such as the loss of roll, where none is given. None: the
        options of C, which are 0.
    **numbers : float
        Numbers of the models, such as omega_ratio of stronge; `carom models` of the command lists
        them.

    Returns
    -------
    motion : ndarray of float64, shape (..., 6), or structured of shape (...)
        v (m/s) and w (rad/s) after the impact, or `carom.dtypes.motion`. NaN in error.
    status : ndarray of int8, shape (...)
        0: resolved; 1: the ball does not move into the cushion; negative: an error, see `Status`.

    Raises
    ------
    CaromError
        One impact, of shape (15,) or (), that is in error.
    """
    own_numbers = dict(_own(numbers))
    if game is not None:
        kind = _ball(game, model)
        own_numbers = {name: getattr(kind, name) for name in NUMBERS} | own_numbers
    options = _options(
        model, convention, law, steps, threads, least_step, plain, tuple(own_numbers.items())
    )
    seconds = 1e-5 if model == "mathavan" else 1e-7 * (steps or 1000) if model == "euler" else 1e-7
    return resolve(CUSHION, impacts, options, seconds, threads, out)


class Calibrated(TypedDict):
    """The fields of a ball's kind that three banks tell."""

    restitution_cushion: float
    mu_cushion: float


class Calibration(NamedTuple):
    """What three banks tell of a table's cushion; `constants` are fields of a ball's kind, which
    `carom.balls(r, **constants)` takes.
    """

    constants: Calibrated
    errors: Calibrated
    comes_back: tuple[float, float, float]
    misfit: float


def calibrate(
    readings: ArrayLike | None, table: Table | None = None, *, game: str = "pool"
) -> Calibration:
    """Find restitution and friction of a table's cushions from three banks that were played.

    Parameters
    ----------
    readings : array_like, shape (3,), or None
        Where the three banks of `carom calibrate` came back, in sights from their corner. None:
        nothing is found, and `comes_back` tells where they come back on the usual table.
    table : Table, optional
        Where they were played; by default `carom.tables.pool_9ft()`.
    game : {"pool", "snooker", "billiard"}
        Whose ball and cushion are the most probable before.

    Returns
    -------
    Calibration
        The constants and their standard deviations, where the banks come back by them, and the
        misfit of the readings over 25 mm, which is above 2 where one is misread.

    Raises
    ------
    ValueError
        There are not three readings, or one is not above 0 and below 8.
    CaromError
        A bank does not come back.
    """
    from carom import tables  # a table is made of layouts, which do not know of cushions

    record = (tables.pool_9ft() if table is None else table).record
    kind = ffi.new(
        "carom_ball_kind *", lib.carom_ball_kind_of(choice(worded("GAME"), game, "game"))
    )
    measured, found = ffi.NULL, ffi.new("carom_calibration *")
    if readings is not None:
        read = as_array(readings, "readings", np.float64)
        if read.shape != (3,):
            raise ValueError(f"readings: three are needed, of shape (3,), not {read.shape}")
        if not ((read > 0) & (read < 8)).all():
            raise ValueError(f"readings: each must be above 0 and below 8, not {read.tolist()}")
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
    """Follow one impact, of shape (15,) or (), by the model mathavan or euler, at `points` equal
    steps of normal impulse from 0 to its end.

    Options are as for `cushion`.

    Returns
    -------
    ndarray of `carom.dtypes.cushion_point`, shape (points,)

    Raises
    ------
    CaromError
        The impact is in error.
    """
    if not isinstance(model, str) or model not in ("mathavan", "euler"):
        raise ValueError(
            f"model: must be 'mathavan' or 'euler', which can be followed, not {model!r}"
        )
    return follow(
        CUSHION, impact, points, _options(model, convention, law, steps, 0, least_step, plain, ())
    )
