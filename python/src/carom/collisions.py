"""Collisions of two balls, the friction between them, and a collision followed in steps."""

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
    """The options of C, which are read-only."""
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

    The arguments are broadcast against each other.

    Parameters
    ----------
    r_a, r_b : array_like, shape (..., 3)
        Centres of the two balls, m, at the same height. Only the direction from a to b matters.
    v_a, v_b : array_like, shape (..., 3)
        Velocities, m/s; the vertical components must be 0.
    w_a, w_b : array_like, shape (..., 3)
        Angular velocities, rad/s.
    radius : array_like, shape (...)
        Radius of both balls, m. From here on, the defaults describe pool balls.
    mass, mass_b : array_like, shape (...)
        Masses, kg. `mass_b` defaults to `mass`.
    mu_slide, mu_slide_b : array_like, shape (...)
        Coefficient of friction between each ball and the cloth, 0 to 1.
    mu_ball : array_like, shape (...)
        Coefficient of friction between the balls, 0 to 1. `mu_ball()` computes it from the slip
        speed.
    restitution : array_like, shape (...)
        Coefficient of restitution of the two balls, 0 to 1.

    Returns
    -------
    ndarray of `carom.dtypes.impact`, shape (...)
        `carom.dtypes.plain()` converts it to float64, shape (..., 26).
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
        see `carom.impacts`. Arrays in C order are not copied.
    solver : {"exact", "euler", "fast"}
        "exact": the limit of infinitely many steps of impulse. "euler": Mathavan's N steps. "fast":
        the limit in less time, partly in single precision; its results are not smooth, so finite
        differences need a step of 1e-3 (docs/understanding/accuracy.md, "Smoothness").
    slip : {"paper", "pooltool"}
        The definition of the slip on the cloth: the paper's, or pooltool's
        (docs/reference/conventions.md).
    steps : int
        Number of steps of "euler"; 0 stands for 1000.
    plain : bool
        Whether to use the instruction set plain, as with CAROM_ISA=plain: its results have the same
        bits on all machines.
    threads : int
        Largest number of threads: 0 uses only the calling thread, -1 all processors. Results do not
        depend on it.
    out : tuple of two arrays, optional
        Arrays that receive motion and status, such as an earlier result. They must not overlap each
        other or the impacts.

    Returns
    -------
    motion : ndarray, shape (..., 12), or structured of shape (...)
        v (m/s) and w (rad/s) of a, then of b, in the precision of the impacts, or as
        `carom.dtypes.result`. NaN for an invalid impact.
    status : ndarray of int8, shape (...)
        0: resolved. 1: the balls do not approach each other; motion is unchanged. Negative: an
        error, see `Status`.

    Raises
    ------
    CaromError
        A single impact, of shape (26,) or (), is invalid.
    """
    options = _options(solver, slip, steps, threads, plain)
    return resolve(
        BALLS, impacts, options, 2e-7 if solver != "euler" else 1e-8 * (steps or 1000), threads, out
    )


def alciatore() -> tuple[float, float, float]:
    """Return Alciatore's law of friction between pool balls.

    Returns
    -------
    tuple of three floats
        a, b (dimensionless) and c (s/m) of mu = a + b exp(-c |u|), with the slip speed |u| in m/s.
    """
    law = lib.carom_alciatore()
    return (law.a, law.b, law.c)


def mu_ball(impacts: ArrayLike, law: tuple[float, float, float] | None = None) -> dtypes.Doubles:
    """Compute the friction between two balls from their slip speed just before they collide.

    Parameters
    ----------
    impacts : array_like, shape (..., 26), or structured of shape (...)
        As for `collide`. Their field mu_ball is ignored.
    law : (a, b, c), optional
        mu = a + b exp(-c |u|), |u| in m/s. Default: `alciatore()`.

    Returns
    -------
    ndarray of float64, shape (...)
        mu. `collide` rejects a value outside [0, 1] or one from motion that is not finite.
    """
    array = rows(impacts, dtypes.impact, "impacts")
    mu = np.empty(array.shape if array.dtype.names is not None else array.shape[:-1])
    a_b_c = alciatore() if law is None else as_array(law, "law", np.float64).tolist()
    if (
        not isinstance(a_b_c, (tuple, list))
        or len(a_b_c) != 3
        or not all(isinstance(value, float) for value in a_b_c)
    ):
        raise ValueError(f"law: {law!r} does not consist of three numbers; pass (a, b, c)")
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
    """Follow one collision, of shape (26,) or (), at `points` equally spaced normal impulses.

    They range from 0 to the end of the collision. Options are as for `collide`; "euler" returns the
    nearest steps.

    Returns
    -------
    ndarray of `carom.dtypes.trace_point`, shape (points,)
        normal (N s), work (J), phase (0 compression, 1 restitution), sticks, v_n and slips (m/s) in
        the frame of the collision, state (both balls, along the axes of the table).

    Raises
    ------
    CaromError
        The impact is invalid.
    """
    return follow(BALLS, impact, points, _options(solver, slip, steps, 0, plain))
