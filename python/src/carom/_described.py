"""Words and numbers of the library. Written by bindings/rows.py: UPDATE=1 ctest -R bindings/rows."""

from typing import Literal, TypedDict

World = Literal["carom", "pooltool"]
BallModel = Literal["default", "exact", "euler", "inelastic", "mirror"]
ShotCushion = Literal["default", "mathavan", "stronge", "han", "mirror", "euler", "smooth"]
BallFriction = Literal["alciatore", "constant"]
Space = Literal["3d", "flat"]
Simultaneous = Literal["cluster", "pairs"]
CushionModel = Literal["mathavan", "stronge", "han", "mirror", "euler", "smooth"]
CushionConvention = Literal["paper", "pooltool"]
CushionLaw = Literal["constant", "han"]


class CushionNumbers(TypedDict, total=False):
    """Numbers of an impact on a cushion, by the models that read them."""

    omega_ratio: float
    """stronge: frequency of the nose along its surface over that across it; 0: 1.8; 0, or between 1 and 2"""
    restitution_log: float
    """any model: change of the cushion's restitution for each unit of ln(speed); -1 to 1"""
    mu_log: float
    """any model: change of the cushion's friction for each unit of ln(speed); -1 to 1"""
    smooth_q: float
    """smooth: width of the passage from sticking to sliding; 0: all numbers as on one table; 0, or 1e-12 to 0.5"""
    smooth_x: float
    """smooth: part of the slip along the cushion that friction takes; 0 to 2"""
    smooth_t: float
    """smooth: part of the slip across the cushion that friction takes; 0 to 2"""
    smooth_a: float
    """smooth: how much farther friction across the cushion reaches; 0 to 1"""
    smooth_k: float
    """smooth: part of the impulse that the rebound gains where friction is used up; 0 to 1"""
    smooth_g: float
    """smooth: part of the impulse that the rebound gains, at most, where friction slides; -1 to 1"""
    smooth_g_log: float
    """smooth: change of smooth_g for each unit of ln(speed); -1 to 1"""
    smooth_e: float
    """smooth: restitution that a ball which rolls into the cushion gains, at most; -1 to 1"""
    restitution_log2: float
    """any model: change of the cushion's restitution with ln(speed)^2, which counts up to 1; -1 to 1"""
