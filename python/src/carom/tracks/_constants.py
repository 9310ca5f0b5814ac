"""What recorded shots are played with: named constants, and the table and balls that follow from
them.

A constant is a field of `carom.dtypes.ball_kind`, but for the radius. Friction between balls is the
law of law_a, law_b and law_c; mu_ball stands for a law that does not depend on the slip.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import Game
from carom._rows import Array, numbered, numbers_of, text_of
from carom._shot_options import ShotCushion
from carom.cushions import NUMBERS
from carom.layouts import Table, balls

Constants = dict[str, float]

# The constants of the game were fitted to whole shots with the smooth law. For the others these are
# what single events say, and what a cushion has besides is 0.
_SINGLE = {
    "mu_slide": 2.02 / 9.81,
    "mu_roll": 0.0418 / 9.81,
    "drag": 0.0129,
    "mu_spin": 0.004,
    "restitution": 0.951,
    "roll_loss": 0.087,
}
# Friction between balls over their slip: Alciatore's law, 4.5 times.
_LAW = {"law_a": 0.0448, "law_b": 0.486, "law_c": 1.088}
KINDS = tuple(name for name in dtypes.ball_kind.names or () if name != "radius")
_START = ("restitution_cushion", "mu_cushion", "nose_height")


def _own(model: int) -> Constants:
    """The numbers that this model of the cushion alone reads and whose 0 stands for another value,
    which their texts name: "...; 0: 1.8".
    """
    found = {}
    for row in numbers_of(lib.CAROM_PART_BALL):
        default = re.search(r"\b0: ([\d.]+(?:e-?\d+)?)", text_of(row.text))
        if default and (row.reader, row.model) == (lib.CAROM_READ_BY_CUSHION, model):
            found[text_of(row.name)] = float(default[1])
    return found


def _starts() -> dict[str, Constants]:
    """What a fit begins with, by the models of the cushion: single impacts on the table of
    CAROM_GAME_BILLIARD told it (docs/reference/constants.md), whose other constants stand in
    for what a recording does not tell.
    """
    found, kind = {}, ffi.new("carom_ball_kind *")
    for word, model in numbered("carom_cushion_model").items():
        if lib.carom_cushion_start(model, kind):
            found[word] = {name: getattr(kind, name) for name in _START} | _own(model)
    return found


STARTS = _starts()


def of_kind(kind: Array | np.void) -> Constants:
    """The constants of a kind of ball. Those that are left out stand for others: mu_ball where
    there is a law, a law of zeros where there is none, and a nose height of 0.
    """
    law = any(kind[name] for name in _LAW)
    left_out = {"mu_ball"} if law else set(_LAW)
    if not kind["nose_height"]:
        left_out.add("nose_height")
    return {name: float(kind[name]) for name in KINDS if name not in left_out}


def of_game(game: Game) -> Constants:
    """The constants of a game's balls."""
    return of_kind(balls(np.zeros((1, 2)), game=game)["kind"][0])


def usual(cushion_model: ShotCushion) -> Constants:
    """The constants to begin with, for a model of the cushion."""
    if not isinstance(cushion_model, str) or cushion_model not in STARTS:
        raise ValueError(
            f"cushion_model: must be one of {', '.join(map(repr, STARTS))}, which a fit can begin with, not {cushion_model!r}"
        )
    numbers = of_game("billiard")
    if cushion_model == "smooth":
        return {**numbers, **STARTS[cushion_model]}
    constants = {
        **numbers,
        **dict.fromkeys(NUMBERS, 0.0),
        **_SINGLE,
        **_LAW,
        **STARTS[cushion_model],
    }
    return constants if constants["mu_cushion"] else {**constants, "roll_loss": 0.0}


def complete(
    constants: Mapping[str, float] | Array | np.void,
    cushion_model: ShotCushion,
    where: str = "constants",
) -> Constants:
    """The given constants, and the usual ones for those that are not given."""
    if (
        isinstance(constants, (np.ndarray, np.void))
        and constants.dtype == dtypes.ball_kind
        and constants.shape == ()
    ):
        constants = of_kind(constants)
    if not isinstance(constants, Mapping):
        raise TypeError(
            f"{where}: numbers by the names of constants are needed, such as {{'mu_slide': 0.2}}, not {constants!r}"
        )
    for name, value in constants.items():
        if name not in KINDS:
            raise ValueError(
                f"{where}: there is no constant {name!r}; known are {', '.join(KINDS)}"
            )
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
            raise ValueError(f"{where}: {name} must be a finite number, not {value!r}")
    values = {**usual(cushion_model), **{name: float(value) for name, value in constants.items()}}
    # friction between balls as one number is a law that does not depend on the slip
    number = values.pop("mu_ball", None)
    if number is not None and not any(name in constants for name in _LAW):
        values.update(law_a=number, law_b=0.0, law_c=0.0)
    return values


def rectangle(size: tuple[float, float], nose_height: float) -> Table:
    """A table without pockets, 0 to size[0] along x and 0 to size[1] along y, m, with noses so high
    above the cloth.
    """
    width, length = size
    corners = np.array([[0.0, 0.0], [width, 0.0], [width, length], [0.0, length]])
    rails: Array = np.zeros(4, dtypes.rail)
    rails["p"], rails["q"] = corners, np.roll(corners, -1, axis=0)
    rails["height"], rails["side"] = nose_height, 1
    return Table(width, length, rails=rails)


def layout(
    centres: dtypes.Doubles, radius: float, constants: Mapping[str, float]
) -> dtypes.Records:
    """Balls at rest at centres of shape (..., balls, 2), of shape (..., balls)."""
    layout = balls(centres, game="billiard", radius=radius)
    for name, value in constants.items():
        layout["kind"][name] = value
    return layout
