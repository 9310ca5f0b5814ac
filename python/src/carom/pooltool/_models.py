"""The exact Mathavan models as strategies for pooltool's own engine."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from carom._impacts import BALLS, CUSHION, resolve_one
from carom._rows import Array
from carom.collisions import _options as collision_options
from carom.cushions import _options as cushion_options
from carom.results import Label

# With the instruction set plain, whose bits all machines share; the cushion without a least step.
_EXACT = collision_options("exact", "paper", 0, 0, True)
_EXACT_CUSHION = cushion_options("mathavan", "paper", "constant", 0, 0, 0.0, True, ())

_balls: Any = importlib.import_module("pooltool.objects.ball.datatypes")
_friction: Any = importlib.import_module("pooltool.physics.resolve.ball_ball.friction")
_ball_ball_core: Any = importlib.import_module("pooltool.physics.resolve.ball_ball.core")
_ball_cushion_core: Any = importlib.import_module("pooltool.physics.resolve.ball_cushion.core")


class ExactBallBall(_ball_ball_core.CoreBallBallCollision):  # type: ignore[misc]
    """The collision of two balls by the exact limit of Mathavan's model of 2014, for pooltool's
    engine.

    `Resolver.ball_ball = carom.pooltool.ExactBallBall()`.

    Parameters
    ----------
    friction : a friction strategy of pooltool, optional
        Default: pooltool's AlciatoreBallBallFriction().
    """

    model = "carom_exact"

    def __init__(self, friction: Any = None) -> None:
        self.friction = friction if friction is not None else _friction.AlciatoreBallBallFriction()

    def solve(self, ball1: Any, ball2: Any) -> tuple[Any, Any]:
        """Set the balls' motion after the collision, and return them."""
        numbers = [*_numbers(ball1), *_numbers(ball2)]
        # The frame assumes two balls at the same height.
        numbers[14] = numbers[2]
        numbers.append(self.friction.calculate_friction(ball1, ball2))
        numbers.append((ball1.params.e_b + ball2.params.e_b) / 2)
        motion = resolve_one(BALLS, numbers, _EXACT)
        _set_motion(ball1, motion[:6])
        _set_motion(ball2, motion[6:])
        return ball1, ball2


def _numbers(ball: Any) -> list[float]:
    """A ball as in an impact: position, velocity, spin, radius, mass, friction of the cloth."""
    p = ball.params
    return [*ball.state.rvw.ravel().tolist(), p.R, p.m, p.u_s]


def _set_motion(ball: Any, motion: Array) -> None:
    """Set a ball's motion after an impact; it slides until pooltool finds that it rolls."""
    rvw = ball.state.rvw.copy()
    rvw[1:] = motion.reshape(2, 3)
    ball.state = _balls.BallState(rvw, Label.SLIDING)


def _resolve_cushion(ball: Any, cushion: Any, jaw_radius: float) -> tuple[Any, Any]:
    normal = cushion.get_normal_xy(ball.state.rvw[0].copy())[:2]
    # Into the cushion: from a jaw's axis the normal points to the ball; a rail's has either sense.
    if jaw_radius > 0.0 or np.dot(normal, ball.state.rvw[1][:2]) < 0.0:
        normal = -normal
    p = ball.params
    _, v, w = ball.state.rvw.tolist()
    numbers = [
        *v,
        *w,
        *normal.tolist(),
        cushion.height,
        p.R,
        p.m,
        p.u_s,
        p.f_c,
        p.e_c,
        jaw_radius,
    ]
    _set_motion(ball, resolve_one(CUSHION, numbers, _EXACT_CUSHION))
    return ball, cushion


class ExactLinearCushion(_ball_cushion_core.CoreBallLCushionCollision):  # type: ignore[misc]
    """The impact on a rail by the exact limit of Mathavan's model of 2010.

    For `Resolver.ball_linear_cushion`.
    """

    model = "carom_exact"

    def solve(self, ball: Any, cushion: Any) -> tuple[Any, Any]:
        """Set the ball's motion after the impact, and return it."""
        return _resolve_cushion(ball, cushion, 0.0)


class ExactCircularCushion(_ball_cushion_core.CoreBallCCushionCollision):  # type: ignore[misc]
    """The impact on a jaw by the exact limit of Mathavan's model of 2010.

    For `Resolver.ball_circular_cushion`.
    """

    model = "carom_exact"

    def solve(self, ball: Any, cushion: Any) -> tuple[Any, Any]:
        """Set the ball's motion after the impact, and return it."""
        return _resolve_cushion(ball, cushion, float(cushion.radius))
