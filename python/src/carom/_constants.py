"""What recorded shots are played with: named constants, and the table, balls and options that follow from them.

A constant is a field of `carom.dtypes.ball_kind`, but for the radius, or `nose_height` (m, of all cushions above the cloth). Fields
that the library's kind of ball gains are constants without a change here. Friction between balls is the constant mu_ball.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from carom import dtypes
from carom._rows import Array
from carom.layouts import Table, balls
from carom.shots import ShotCushion, shot_options

Constants = dict[str, float]

# Measured on one carom table (docs/using/tracks.md): these stand in for what a recording does not tell. Restitution and friction of
# the cushion belong to a model: they come from single impacts, fitted with that model.
_CLOTH_AND_BALLS = {
    "mu_slide": 0.206,
    "mu_roll": 0.0055,
    "mu_spin": 0.0045,
    "mu_ball": 0.08,
    "restitution": 0.951,
}
_CUSHION = {
    "mathavan": (0.898, 0.22, 0.037),
    "stronge": (0.874, 0.22, 0.0365),
    "han": (0.874, 0.231, 0.03545),
    "mirror": (0.875, 0.0, 0.037),
}
KINDS = tuple(name for name in dtypes.ball_kind.names or () if name not in ("radius", "mass", "gravity"))
NAMES = (*KINDS, "mass", "gravity", "nose_height")


def usual(cushion_model: ShotCushion) -> Constants:
    """The constants to begin with, for a model of the cushion."""
    if cushion_model not in _CUSHION:
        raise ValueError(f"cushion_model: must be one of {', '.join(map(repr, _CUSHION))}, not {cushion_model!r}")
    e, mu, height = _CUSHION[cushion_model]
    return {**_CLOTH_AND_BALLS, "restitution_cushion": e, "mu_cushion": mu, "nose_height": height}


def complete(given: Mapping[str, float], cushion_model: ShotCushion, where: str = "constants") -> Constants:
    """The given constants, and the usual ones for those that are not given."""
    for name, value in given.items():
        if name not in NAMES:
            raise ValueError(f"{where}: there is no constant {name!r}; known are {', '.join(NAMES)}")
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
            raise ValueError(f"{where}: {name} must be a finite number, not {value!r}")
    return {**usual(cushion_model), **{name: float(value) for name, value in given.items()}}


def rectangle(size: tuple[float, float], nose_height: float) -> Table:
    """A table without pockets, 0 to size[0] along x and 0 to size[1] along y, m, with noses so high above the cloth."""
    width, length = size
    corners = np.array([[0.0, 0.0], [width, 0.0], [width, length], [0.0, length]])
    rails: Array = np.zeros(4, dtypes.rail)
    rails["p"], rails["q"] = corners, np.roll(corners, -1, axis=0)
    rails["height"], rails["side"] = nose_height, 1
    return Table(width, length, rails=rails)


def layout(centres: dtypes.Doubles, radius: float, constants: Mapping[str, float]) -> dtypes.Records:
    """Balls at rest at centres of shape (..., balls, 2), of shape (..., balls). What is no constant, such as drag, is 0."""
    made = balls(centres, game="pooltool_billiard", radius=radius)
    for name, value in constants.items():
        if name != "nose_height":
            made["kind"][name] = value
    return made


def options(cushion_model: ShotCushion) -> Any:
    """The options of C that recorded shots are played with."""
    return shot_options("carom", "default", cushion_model, "constant", 0, 0, 0.0, 0)
