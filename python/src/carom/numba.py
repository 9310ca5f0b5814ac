"""Single collisions and impacts inside code that Numba compiles.

    from numba import njit, prange
    from carom.numba import collide, mu_ball

    @njit(cache=True, parallel=True, nogil=True)
    def resolve(impacts, motion, status):                     # (n, 26), (n, 12), (n,)
        for k in prange(len(impacts)):
            impacts[k, 24] = mu_ball(impacts[k])
            status[k] = collide(impacts[k], motion[k], solver="exact")

The calls have the bits of `carom.collide`, `carom.cushion` and `carom.mu_ball`, without the overhead of Python. Importing this module
registers the addresses of the C functions in LLVM. Numba caches only their names, and resolves them in each process.

Needs Numba. Its objects have no types here, so that carom can be checked without it.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import choice, listing, pointer
from carom.collisions import SLIPS, SOLVERS, Slip, Solver
from carom.cushions import CONVENTIONS, LAWS, MODELS, CushionConvention, CushionLaw, CushionModel

__all__ = ["collide", "cushion", "mu_ball"]
__dir__ = listing(__name__)

try:
    _types: Any = importlib.import_module("numba").types
    _errors: Any = importlib.import_module("numba.core.errors")
    _overload: Any = importlib.import_module("numba.extending").overload
    _llvm: Any = importlib.import_module("llvmlite.binding")
except ImportError as missing:
    raise ImportError("carom.numba needs Numba, which is not installed here: pip install numba", name=missing.name) from missing

_IMPACT, _RESULT = dtypes.impact.itemsize // 8, dtypes.result.itemsize // 8
_CUSHION_IMPACT, _MOTION = dtypes.cushion_impact.itemsize // 8, dtypes.motion.itemsize // 8
_ALCIATORE = lib.carom_alciatore()
_A, _B, _C = float(_ALCIATORE.a), float(_ALCIATORE.b), float(_ALCIATORE.c)


def collide(impact: dtypes.Doubles, out: dtypes.Doubles, solver: Solver = "exact", slip: Slip = "paper", steps: int = 0) -> int:
    """Resolve one collision of two balls, in compiled code or, for debugging, outside it.

    Parameters
    ----------
    impact : ndarray of float64, shape (26,), in C order
        A row of the argument of `carom.collide`; `carom.dtypes.plain` converts records to rows.
    out : ndarray of float64, shape (12,), in C order
        Receives the motion: v (m/s) and w (rad/s) of a, then of b. NaN after an error.
    solver, slip
        As for `carom.collide`. In compiled code these are literals, or names of constants of the module.
    steps : int
        Euler's N; 0 is 1000.

    Returns
    -------
    int
        A value of `carom.Status`: 0: resolved; 1: the balls do not approach each other; negative: an error.

    Raises
    ------
    ValueError
        The sizes are wrong. (For an error of the impact, see the returned value.)
    """
    numbers = choice(SOLVERS, solver, "solver"), choice(SLIPS, slip, "slip"), steps
    return int(lib.carom_python_collide(_row(impact, _IMPACT, "impact"), *numbers, _row(out, _RESULT, "out")))


def mu_ball(impact: dtypes.Doubles, a: float = _A, b: float = _B, c: float = _C) -> float:
    """Friction between two balls from the speed of slip just before they collide, in compiled code or outside it.

    Parameters
    ----------
    impact : ndarray of float64, shape (26,), in C order
        As for `collide`; its field mu_ball is not read.
    a, b, c : float
        mu = a + b exp(-c |u|), |u| in m/s. By default those of `carom.alciatore()`.

    Returns
    -------
    float
        The coefficient of friction, to be stored in impact[24].
    """
    return float(lib.carom_python_mu_ball_one(_row(impact, _IMPACT, "impact"), a, b, c))


def cushion(
    impact: dtypes.Doubles,
    out: dtypes.Doubles,
    model: CushionModel = "mathavan",
    convention: CushionConvention = "paper",
    law: CushionLaw = "constant",
    steps: int = 0,
    least_step: float = 0.0,
    omega_ratio: float = 0.0,
) -> int:
    """Resolve one impact of a ball on a cushion, in compiled code or outside it.

    Parameters
    ----------
    impact : ndarray of float64, shape (15,), in C order
        A row of the argument of `carom.cushion`.
    out : ndarray of float64, shape (6,), in C order
        Receives the motion: v (m/s) and w (rad/s). NaN after an error.
    model, convention, law
        As for `carom.cushion`. In compiled code these are literals, or names of constants of the module.
    steps, least_step, omega_ratio
        As for `carom.cushion`.

    Returns
    -------
    int
        A value of `carom.Status`: 0: resolved; 1: the ball does not move into the cushion; negative: an error.

    Raises
    ------
    ValueError
        The sizes are wrong.
    """
    numbers = choice(MODELS, model, "model"), choice(CONVENTIONS, convention, "convention"), choice(LAWS, law, "law")
    given, moved = _row(impact, _CUSHION_IMPACT, "impact"), _row(out, _MOTION, "out")
    return int(lib.carom_python_cushion(given, *numbers, steps, least_step, omega_ratio, moved))


def _row(array: dtypes.Doubles, size: int, name: str) -> Any:
    """The numbers of one row for C, outside compiled code."""
    if array.dtype != np.float64 or array.shape != (size,) or not array.flags.c_contiguous:
        raise ValueError(f"{name}: an array of float64 in C order of shape ({size},) is needed, not {array.dtype} {array.shape}")
    return pointer("double[]", array)


# ---- What Numba compiles instead ----------------------------------------------------------------------------------------


def _external(name: str, returned: Any, *arguments: Any) -> Any:
    """A function of the extension module, by its name; its address is told to LLVM for this process only."""
    _llvm.add_symbol(name, int(ffi.cast("uintptr_t", ffi.addressof(lib, name))))
    return _types.ExternalFunction(name, returned(*arguments))


_ROW, _INT, _DOUBLE = _types.CPointer(_types.float64), _types.int32, _types.float64
_collide = _external("carom_python_collide", _INT, _ROW, _INT, _INT, _INT, _ROW)
_mu_ball = _external("carom_python_mu_ball_one", _DOUBLE, _ROW, _DOUBLE, _DOUBLE, _DOUBLE)
_cushion = _external("carom_python_cushion", _INT, _ROW, _INT, _INT, _INT, _INT, _DOUBLE, _DOUBLE, _ROW)


def _named(names: dict[str, int], given: Any, option: str) -> int:
    """The number of an option that is named in compiled code: by a literal, or by default."""
    value = getattr(given, "literal_value", getattr(given, "value", given))
    if not isinstance(value, str):
        raise _errors.TypingError(f"{option}: compiled code must name it by a literal, one of {', '.join(map(repr, names))}")
    try:
        return choice(names, value, option)
    except ValueError as wrong:
        raise _errors.TypingError(str(wrong)) from None


def _check(array: Any, name: str) -> None:
    """Whether the type of an array is that of a row."""
    if not (isinstance(array, _types.Array) and array.ndim == 1 and array.layout == "C" and array.dtype == _types.float64):
        raise _errors.TypingError(f"{name}: a one-dimensional array of float64 in C order is needed, not {array}")


def _compile_collide(impact: Any, out: Any, solver: Any = "exact", slip: Any = "paper", steps: Any = 0) -> Callable[..., int]:
    _check(impact, "impact")
    _check(out, "out")
    solver_number, slip_number = _named(SOLVERS, solver, "solver"), _named(SLIPS, slip, "slip")

    def call(impact: Any, out: Any, solver: Any = "exact", slip: Any = "paper", steps: Any = 0) -> int:
        if impact.size != _IMPACT or out.size != _RESULT:
            raise ValueError("collide: impact must have 26 numbers, and out 12")
        status: int = _collide(impact.ctypes, solver_number, slip_number, steps, out.ctypes)
        return status

    return call


def _compile_mu_ball(impact: Any, a: Any = _A, b: Any = _B, c: Any = _C) -> Callable[..., float]:
    _check(impact, "impact")

    def call(impact: Any, a: Any = _A, b: Any = _B, c: Any = _C) -> float:
        if impact.size != _IMPACT:
            raise ValueError("mu_ball: impact must have 26 numbers")
        mu: float = _mu_ball(impact.ctypes, a, b, c)
        return mu

    return call


def _compile_cushion(
    impact: Any,
    out: Any,
    model: Any = "mathavan",
    convention: Any = "paper",
    law: Any = "constant",
    steps: Any = 0,
    least_step: Any = 0.0,
    omega_ratio: Any = 0.0,
) -> Callable[..., int]:
    _check(impact, "impact")
    _check(out, "out")
    model_number, law_number = _named(MODELS, model, "model"), _named(LAWS, law, "law")
    convention_number = _named(CONVENTIONS, convention, "convention")

    def call(
        impact: Any,
        out: Any,
        model: Any = "mathavan",
        convention: Any = "paper",
        law: Any = "constant",
        steps: Any = 0,
        least_step: Any = 0.0,
        omega_ratio: Any = 0.0,
    ) -> int:
        if impact.size != _CUSHION_IMPACT or out.size != _MOTION:
            raise ValueError("cushion: impact must have 15 numbers, and out 6")
        status: int = _cushion(
            impact.ctypes, model_number, convention_number, law_number, steps, least_step, omega_ratio, out.ctypes
        )
        return status

    return call


for _function, _compiled in ((collide, _compile_collide), (mu_ball, _compile_mu_ball), (cushion, _compile_cushion)):
    _overload(_function, prefer_literal=True)(_compiled)
