"""Names and parameters of the library. Written by bindings/rows.py: UPDATE=1 ctest -R bindings/rows."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from typing import Literal, NamedTuple, TypedDict

import numpy.typing as npt

World = Literal["carom", "pooltool"]
BallModel = Literal["default", "exact", "euler", "inelastic", "mirror"]
ShotCushion = Literal["default", "mathavan", "stronge", "han", "mirror", "euler", "smooth"]
BallFriction = Literal["alciatore", "constant"]
Space = Literal["3d", "flat"]
Simultaneous = Literal["cluster", "pairs"]
CushionModel = Literal["mathavan", "stronge", "han", "mirror", "euler", "smooth"]
CushionConvention = Literal["paper", "pooltool"]
CushionLaw = Literal["constant", "han"]
Game = Literal["pool", "snooker", "billiard", "pooltool_pool", "pooltool_snooker", "pooltool_billiard", "blackball", "pyramid", "fourball"]
Solver = Literal["exact", "euler", "fast"]
Slip = Literal["paper", "pooltool"]
Rules = Literal["eightball", "nineball", "potting", "threecushion", "straight", "snooker", "onepocket", "bank", "tenball", "straightrail", "blackball", "heyball", "rotation", "pyramid", "fourball", "cowboy", "killer", "cutthroat", "billiards"]
Condition = Literal["slow_cloth", "medium_cloth", "fast_cloth", "old_cushion", "new_cushion", "humid_cushion", "lively_cushion", "dead_cushion"]
Turn = Literal["keep", "pass", "win", "lose", "draw"]
Leave = Literal["after", "before", "anywhere", "kitchen", "d", "baulk"]
Choice = Literal["pass", "push", "free_ball", "place", "rack", "other_rack", "stay", "spot"]
Phase = Literal["none", "stroke", "place", "moving", "over"]
Goal = Literal["win", "hidden", "snooker", "near", "apart"]
StopAt = Literal[
    "contact", "strike", "ball_ball", "rail", "jaw", "pocket", "sliding_rolling", "rolling_spinning", "rolling_stationary",
    "spinning_stationary", "slate", "rail_top", "left_table",
]  # fmt: skip


class Label(enum.IntEnum):
    """The motion of a ball."""

    STATIONARY = 0
    SPINNING = 1
    SLIDING = 2
    ROLLING = 3
    POCKETED = 4
    AIRBORNE = 5
    OFF = 6


class EventType(enum.IntEnum):
    """The type of an event, of ball a with ball, rail, jaw or pocket b."""

    STRIKE = 1
    BALL_BALL = 2
    RAIL = 3
    JAW = 4
    POCKET = 5
    SLIDING_ROLLING = 6
    ROLLING_SPINNING = 7
    ROLLING_STATIONARY = 8
    SPINNING_STATIONARY = 9
    SLATE = 10
    RAIL_TOP = 11
    LEFT_TABLE = 12


class ShotOptions(NamedTuple):
    """Options of a shot. `carom.simulate` accepts them as keywords, as an object of this class, or both.

    Attributes
    ----------
    world : {"carom", "pooltool"}
        Rules of contact, and the default models
    ball_model : {"default", "exact", "euler", "inelastic", "mirror"}
        Model of the collision of two balls (default: exact; in the world pooltool inelastic)
    cushion_model : {"default", "mathavan", "stronge", "han", "mirror", "euler", "smooth"}
        Model of the impact on a cushion; mathavan, the exact limit, is the slowest (default: smooth for balls with a smooth_q, such as
        those of carom's games, else han; in the world pooltool stronge)
    friction : {"alciatore", "constant"}
        Friction between balls: a function of the speed of slip (default), or their mu_ball
    space : {"3d", "flat"}
        Whether balls can leave the cloth (default: 3d); the world pooltool is flat
    simultaneous : {"cluster", "pairs"}
        Contacts of several balls at one instant, as in a rack: they last and overlap in time (default), or are resolved one after the
        other, as always in the world pooltool and with the models euler and inelastic
    cluster_steps : int
        Steps of the integrator of clusters for the duration of a contact; 0: 25
    steps : int
        Steps of Euler's models; 0: 1000
    events_most : int
        Largest number of events of a shot; 0: 10000
    fast : bool
        1: computes with the instruction set in use; 0: computes the bits that all machines share
    t_final : float | None
        The shot stops at exactly this time, s, with the status STOPPED_AT_TIME if balls still move. Without it a shot that lasts longer
        than 1000 s is an error.
    stop_at : StopAt | Iterable[StopAt]
        The shot stops after the first event of these kinds, with the status STOPPED_AT_EVENT: "contact", of the cue ball with another, or a
        `carom.EventType` in lower case, such as "pocket". `carom.resume` continues a stopped shot.
    first_of : int | Iterable[int]
        Indices of balls. The shot stops right after the first contact of the cue ball with another ball, with the status STOPPED_AT_EVENT,
        unless that ball is one of these. (): it does not stop.
    """

    world: World = "carom"
    ball_model: BallModel = "default"
    cushion_model: ShotCushion = "default"
    friction: BallFriction = "alciatore"
    space: Space = "3d"
    simultaneous: Simultaneous = "cluster"
    cluster_steps: int = 0
    steps: int = 0
    events_most: int = 0
    fast: bool = False
    t_final: float | None = None
    stop_at: StopAt | Iterable[StopAt] = ()
    first_of: int | Iterable[int] = ()


class Changes(TypedDict, total=False):
    """Options as keywords."""

    world: World
    ball_model: BallModel
    cushion_model: ShotCushion
    friction: BallFriction
    space: Space
    simultaneous: Simultaneous
    cluster_steps: int
    steps: int
    events_most: int
    fast: bool
    t_final: float | None
    stop_at: StopAt | Iterable[StopAt]
    first_of: int | Iterable[int]


# The options that are names, with their enumerations, and the largest values of the integers.
WORDS = {
    "world": "WORLD", "ball_model": "BALL_MODEL", "cushion_model": "SHOT_CUSHION", "friction": "BALL_FRICTION", "space": "SPACE",
    "simultaneous": "SIMULTANEOUS",
}  # fmt: skip
COUNTS = {"cluster_steps": 10000, "steps": 2147483647, "events_most": 2147483647, "fast": 1}


class CushionNumbers(TypedDict, total=False):
    """Parameters of an impact on a cushion, with the models that use them."""

    roll_loss: float
    """any model: part of the speed along a cushion that an impact takes from the roll along it; 0 to 1"""
    omega_ratio: float
    """stronge: frequency of the nose along its surface divided by that across it; 0: 1.8; 0, or between 1 and 2"""
    restitution_log: float
    """any model: change of the cushion's restitution for each unit of ln(speed); -1 to 1"""
    mu_log: float
    """any model: change of the cushion's friction for each unit of ln(speed); -1 to 1"""
    smooth_q: float
    """smooth: width of the change from sticking to sliding; 0: all numbers of smooth as on one table; 0, or 1e-12 to 0.5"""
    smooth_x: float
    """smooth: part of the slip along the cushion that friction takes; 0 to 2"""
    smooth_t: float
    """smooth: part of the slip across the cushion that friction takes; 0 to 2"""
    smooth_a: float
    """smooth: how much farther friction across the cushion reaches; 0 to 1"""
    smooth_k: float
    """smooth: part of the impulse that the rebound gains where friction reaches its limit; 0 to 1"""
    smooth_g: float
    """smooth: part of the impulse that the rebound gains, at most, where friction slides; -1 to 1"""
    smooth_g_log: float
    """smooth: change of smooth_g for each unit of ln(speed); -1 to 1"""
    smooth_e: float
    """smooth: restitution that a ball which rolls into the cushion gains, at most; -1 to 1"""
    restitution_log2: float
    """any model: change of the cushion's restitution with ln(speed)^2, which counts up to 1; -1 to 1"""
    roll_loss_log: float
    """any model: change of roll_loss for each unit of ln(speed); -1 to 1"""


class BallNumbers(TypedDict, total=False):
    """Properties of a ball and its cushions, the fields of `carom.dtypes.ball_kind`."""

    mass: npt.ArrayLike | None
    """mass; above 0 and finite, in kg"""
    radius: npt.ArrayLike | None
    """radius; above 0 and finite, in m"""
    mu_slide: npt.ArrayLike | None
    """sliding friction of ball and cloth; above 0 and at most 1"""
    mu_roll: npt.ArrayLike | None
    """rolling resistance; above 0 and at most 1"""
    mu_spin: npt.ArrayLike | None
    """friction of the ball turning on the spot; above 0 and at most 1"""
    mu_ball: npt.ArrayLike | None
    """friction between balls; 0 to 1"""
    restitution: npt.ArrayLike | None
    """restitution of two balls; 0 to 1"""
    mu_cushion: npt.ArrayLike | None
    """friction of ball and cushion; 0 to 1"""
    restitution_cushion: npt.ArrayLike | None
    """restitution of ball and cushion; 0 to 1"""
    gravity: npt.ArrayLike | None
    """gravity; above 0 and at most 1e6, in m/s^2"""
    drag: npt.ArrayLike | None
    """deceleration of a rolling ball divided by the square of its speed; 0 to 1, in 1/m"""
    roll_loss: npt.ArrayLike | None
    """part of the speed along a cushion that an impact takes from the roll along it; 0 to 1"""
    law_a: npt.ArrayLike | None
    """friction between balls at great slips; law_a, law_b and law_c 0: carom_alciatore(); 0 to 1"""
    law_b: npt.ArrayLike | None
    """by how much friction between balls is greater at small slips; 0 to 1"""
    law_c: npt.ArrayLike | None
    """how fast friction between balls falls with the slip; 0 or more and finite, in s/m"""
    nose_height: npt.ArrayLike | None
    """height of the noses of all cushions above the cloth; 0: those of the table; 0 or more and finite, in m"""
    omega_ratio: npt.ArrayLike | None
    """frequency of the nose along its surface divided by that across it; 0: 1.8; 0, or between 1 and 2"""
    restitution_table: npt.ArrayLike | None
    """restitution of ball and slate; 0: 0.5; -1: none; -1, or 0 to 0.98"""
    modulus: npt.ArrayLike | None
    """E/(1 - nu^2) of the ball, for contacts that last; 0: 6.6e9; 0, or 1e6 to 1e15, in Pa"""
    restitution_log: npt.ArrayLike | None
    """change of the cushion's restitution for each unit of ln(speed); -1 to 1"""
    mu_log: npt.ArrayLike | None
    """change of the cushion's friction for each unit of ln(speed); -1 to 1"""
    smooth_q: npt.ArrayLike | None
    """width of the change from sticking to sliding; 0: all numbers of smooth as on one table; 0, or 1e-12 to 0.5"""
    smooth_x: npt.ArrayLike | None
    """part of the slip along the cushion that friction takes; 0 to 2"""
    smooth_t: npt.ArrayLike | None
    """part of the slip across the cushion that friction takes; 0 to 2"""
    smooth_a: npt.ArrayLike | None
    """how much farther friction across the cushion reaches; 0 to 1"""
    smooth_k: npt.ArrayLike | None
    """part of the impulse that the rebound gains where friction reaches its limit; 0 to 1"""
    smooth_g: npt.ArrayLike | None
    """part of the impulse that the rebound gains, at most, where friction slides; -1 to 1"""
    smooth_g_log: npt.ArrayLike | None
    """change of smooth_g for each unit of ln(speed); -1 to 1"""
    smooth_e: npt.ArrayLike | None
    """restitution that a ball which rolls into the cushion gains, at most; -1 to 1"""
    restitution_log2: npt.ArrayLike | None
    """change of the cushion's restitution with ln(speed)^2, which counts up to 1; -1 to 1"""
    roll_loss_log: npt.ArrayLike | None
    """change of roll_loss for each unit of ln(speed); -1 to 1"""
