"""Errors of fitted strikes and constants, from derivatives of complete shots.

For one shot, d are the distances of its samples, and J_p, J_c and J_r their derivatives by the
strike, the constants and the initial positions: `carom.tangents` at the times of the samples, and
-v for the time of the strike.

A strike that minimises |d|^2 has the error -(J_p^T J_p)^-1 J_p^T (noise + J_r times the noise of
the initial positions, which are fixed), so

    covariance of the strike = s^2 P + P J_p^T J_r S J_r^T J_p P,      P = (J_p^T J_p + bounds)^-1.

s^2 is the residual variance of the samples; S contains s^2 divided by the number of samples at
rest. The second term is usually larger, because contacts magnify errors of initial positions.
Quantities that no sample determines have the variance of the search bounds.

The constants from complete shots (`_joint`) have the error N^-1 sum of g, with the normal equations
N of all shots after elimination of the strikes, and each shot's gradient g = A^T W d, A = J_c - J_p
(J_p^T W J_p)^-1 J_p^T W J_c. Shots are independent but their samples are not, so the scatter of the
gradients over the shots estimates their size (the "sandwich" covariance, clustered by shots):

    covariance of the constants = N^-1 (n/(n - 1) sum of (g - mean g)(g - mean g)^T + priors) N^-1.

The error of a prior's gradient follows from the error of its mean. A derivative is meaningless
beyond its reach, so the weight of a sample that one deviation of the priors moves by more than 0.3
m is reduced to that of a move by 0.3 m.

The remainder of the search (`_joint.left`) is added to the diagonal. On synthetic recordings 3 of
100 constants deviate by more than three of these errors. On 91 real shots the constants of two
halves differ by less than one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from carom.dtypes import Doubles
from carom.tracks import _joint
from carom.tracks._strikes import Plays, derivatives

# Bounds of a strike: speeds (m/s), spins over the speed, and the time (s).
_SPEED, _SPIN, _TIME = 8.0, 2.0, 0.1


def bounds(strike: Doubles) -> Doubles:
    """The deviation of each parameter of a strike that no sample determines, (6,)."""
    speed = float(np.hypot(strike[0], strike[1]))
    return np.array([_SPEED, _SPEED, *3 * [_SPIN * speed + 0.2], _TIME])


def of_strike(
    plays: Plays, row: int, strike: Doubles, names: Sequence[str] = ()
) -> tuple[Doubles, Doubles, Doubles]:
    """For the strike of a shot: s^2 P, (6, 6); its derivatives by the named constants and by the
    deviations, m, of the initial coordinates, (6, names + 2 balls); and these deviations.
    """
    d, J_p, J_c, J_r = derivatives(plays, row, strike, list(names))
    variance = float(d @ d) / max(len(d) - 6, 1)
    shot = plays.recordings[row]
    spread = shot.deviations(shot.rest).ravel()
    # by R of the factorisation Q R, as the product J^T J has the square of its condition number
    root = np.linalg.inv(
        np.linalg.qr(np.vstack([J_p / np.sqrt(variance), np.diag(1.0 / bounds(strike))]), mode="r")
    )
    P = root @ root.T
    return (
        P,
        -(P / variance) @ J_p.T @ np.hstack([J_c, J_r]),
        np.sqrt(variance / np.repeat(shot.still, 2)) * (spread / shot.noise),
    )


def of_constants(search: _joint.Search, priors: Mapping[str, float]) -> Doubles | None:
    """The covariance of the constants of a finished search; None with too few shots.

    `told` are the errors of constants from single events, which are the errors of the priors'
    means. The error of other means is one deviation.
    """
    whole, g, _ = search.equations()
    if len(g) < _joint.LEAST:
        return None
    g = g - g.mean(axis=0)
    off = np.array(
        [
            min(priors.get(name, scale) / scale, 1.0)
            for name, scale in zip(search.names, search.scale)
        ]
    )
    inner = g.T @ g * (len(g) / (len(g) - 1.0)) + np.diag((search.prior_cost * off) ** 2)
    inverse = np.linalg.inv(whole)
    # the remainder of the search is separate for each constant
    return np.asarray(
        inverse @ inner @ inverse * np.outer(search.scale, search.scale)
        + np.diag(_joint.left(search) ** 2)
    )
