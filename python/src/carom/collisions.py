"""The collision of two balls: one and many, the friction between them, and a collision on its way."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import Slip as Slip
from carom._described import Solver as Solver
from carom._impacts import BALLS, Outcome, resolve
from carom._impacts import trace as follow
from carom._rows import (
    Array,
    as_array,
    cached,
    choice,
    fill,
    in_chunks,
    pointer,
    rows,
    whole,
    worded,
)

_SOLVERS, _SLIPS = worded("SOLVER"), worded("SLIP")

ALL_THREADS = -1
"""For `threads`: one thread for each processor that the process may use."""


@cached
def _options(solver: str, slip: str, steps: int, threads: int, plain: bool) -> Any:
    """The options of C; they are never written to."""
    numbers = {
        "solver": choice(_SOLVERS, solver, "solver"),
        "slip": choice(_SLIPS, slip, "slip"),
        "steps": whole(steps, "steps"),
    }
    numbers |= {
        "threads": whole(threads, "threads", least=ALL_THREADS),
        "plain": whole(plain, "plain", most=1),
    }
    return ffi.new("carom_options *", numbers)


def impacts(
    *,
    r_a: ArrayLike = (0.0, 0.0, 0.0),
    v_a: ArrayLike,
    w_a: ArrayLike = 0.0,
    r_b: ArrayLike,
    v_b: ArrayLike = 0.0,
    w_b: ArrayLike = 0.0,
    radius: ArrayLike = 0.028575,
    mass: ArrayLike = 0.170097,
    mass_b: ArrayLike | None = None,
    mu_slide: ArrayLike = 0.2,
    mu_slide_b: ArrayLike | None = None,
    mu_ball: ArrayLike = 0.05,
    restitution: ArrayLike = 0.95,
) -> dtypes.Records:
    """Build impacts for `collide`.

    The fields are broadcast against each other.

    Parameters
    ----------
    r_a, r_b : array_like, shape (..., 3)
        Centres of the two balls, m, at the same height. Only the direction from a to b counts.
    v_a, v_b : array_like, shape (..., 3)
        Velocities, m/s; the vertical ones must be 0.
    w_a, w_b : array_like, shape (..., 3)
        Angular velocities, rad/s.
    radius : array_like, shape (...)
        Radius of both balls, m. The defaults of this and all later arguments are those of pool
        balls.
    mass, mass_b : array_like, shape (...)
        Masses, kg; `mass_b` is `mass` if it is not given.
    mu_slide, mu_slide_b : array_like, shape (...)
        Friction of each ball and the cloth, 0 to 1.
    mu_ball : array_like, shape (...)
        Friction between the balls, 0 to 1. `mu_ball()` computes it from the speed of slip.
    restitution : array_like, shape (...)
        0 to 1.

    Returns
    -------
    ndarray of `carom.dtypes.impact`, shape (...)
        `carom.dtypes.plain()` gives the numbers, of shape (..., 26).
    """
    partner = {
        "b.mass": mass if mass_b is None else mass_b,
        "b.mu_slide": mu_slide if mu_slide_b is None else mu_slide_b,
    }
    return fill(
        dtypes.impact,
        {"r": 3, "v": 3, "w": 3},
        {
            "a.r": r_a,
            "a.v": v_a,
            "a.w": w_a,
            "a.radius": radius,
            "a.mass": mass,
            "a.mu_slide": mu_slide,
            "b.r": r_b,
            "b.v": v_b,
            "b.w": w_b,
            "b.radius": radius,
            **partner,
            "mu_ball": mu_ball,
            "restitution": restitution,
        },
    )


def collide(
    impacts: ArrayLike,
    *,
    solver: Solver = "exact",
    slip: Slip = "paper",
    steps: int = 0,
    plain: bool = False,
    threads: int = 0,
    out: tuple[Array, Array] | None = None,
) -> Outcome:
    """Resolve collisions of two balls.

    Parameters
    ----------
    impacts : array_like, shape (..., 26), or structured of shape (...)
        Rows of float64 or float32 (others are converted to float64), or of `carom.dtypes.impact`;
        see `carom.impacts`. Not copied where they are in C order.
    solver : {"exact", "euler", "fast"}
        The limit of infinitely many steps of impulse, or Mathavan's N steps. "fast" is the limit in
        less time, but not smooth: differences of results then need steps of 1e-4 or more.
    slip : {"paper", "pooltool"}
        Which velocity slips over the cloth.
    steps : int
        Euler's N; 0 is 1000.
    plain : bool
        Whether this call computes with the instruction set plain, as with CAROM_ISA=plain: it has
        the bits that all machines share.
    threads : int
        Most threads to use; 0 is the calling one alone, -1 all processors. Results do not depend on
        it.
    out : tuple of two arrays, optional
        Where motion and status go: an earlier result, for example. They may not overlap each other
        or the impacts.

    Returns
    -------
    motion : ndarray, shape (..., 12), or structured of shape (...)
        v (m/s) and w (rad/s) of a, then of b, in the precision of the impacts, or as
        `carom.dtypes.result`. NaN in error.
    status : ndarray of int8, shape (...)
        0: resolved; 1: the balls do not approach each other, and motion is that before; negative:
        an error, see `Status`.

    Raises
    ------
    CaromError
        One impact, of shape (26,) or (), that is in error.
    """
    options = _options(solver, slip, steps, threads, plain)
    return resolve(
        BALLS, impacts, options, 2e-7 if solver != "euler" else 1e-8 * (steps or 1000), threads, out
    )


def alciatore() -> tuple[float, float, float]:
    """The usual law of friction between pool balls: a, b (dimensionless) and c (s/m) of mu = a + b
    exp(-c |u|).
    """
    law = lib.carom_alciatore()
    return (law.a, law.b, law.c)


def mu_ball(impacts: ArrayLike, law: tuple[float, float, float] | None = None) -> dtypes.Doubles:
    """Friction between two balls from the speed of slip just before they collide: float64, shape
    (...).

    Impacts are as for `collide`, and their own mu_ball is not read. The law of a, b, c is mu = a +
    b exp(-c |u|), |u| in m/s; without one it is `alciatore()`. A law that leaves [0, 1] or motion
    that is not finite gives a number that `collide` refuses.
    """
    array = rows(impacts, dtypes.impact, "impacts")
    mu = np.empty(array.shape if array.dtype.names is not None else array.shape[:-1])
    a_b_c = alciatore() if law is None else as_array(law, "law", np.float64).tolist()
    if (
        not isinstance(a_b_c, (tuple, list))
        or len(a_b_c) != 3
        or not all(isinstance(value, float) for value in a_b_c)
    ):
        raise ValueError(f"law: three numbers a, b and c are needed, not {law!r}")
    source, target = pointer("carom_impact[]", array), pointer("double[]", mu)

    def fill_in(begin: int, count: int) -> int:
        lib.carom_python_mu_ball(source + begin, count, a_b_c, target + begin)
        return 0

    in_chunks(mu.size, 5e-8, 0, fill_in)
    return mu


def trace(
    impact: ArrayLike,
    points: int = 101,
    *,
    solver: Solver = "exact",
    slip: Slip = "paper",
    steps: int = 0,
    plain: bool = False,
) -> dtypes.Records:
    """Follow one collision, of shape (26,) or (), at `points` equal steps of normal impulse from 0
    to its end.

    Options are as for `collide`; Euler's method gives the nearest whole steps.

    Returns
    -------
    ndarray of `carom.dtypes.trace_point`, shape (points,)
        normal (N s), work (J), phase (0 compression, 1 restitution), sticks, v_n and slips (m/s) in
        the frame of the collision, state (both balls, along the axes of the table).

    Raises
    ------
    CaromError
        The impact is in error.
    """
    return follow(BALLS, impact, points, _options(solver, slip, steps, 0, plain))
