"""How far strikes and constants that were fitted may be off, by derivatives of whole shots.

Of one shot, d are the distances of its samples, J_p, J_c and J_r their derivatives by the strike,
the constants and the places of rest: `carom.tangents` at the times of the samples, and -v by the
time of the strike.

A strike that minimises |d|^2 is off by -(J_p^T J_p)^-1 J_p^T (noise + J_r times the noise of the
places of rest, which are held), so

    covariance of the strike = s^2 P + P J_p^T J_r S J_r^T J_p P,      P = (J_p^T J_p + bounds)^-1.

s^2 is what the samples leave over, S has s^2 over the number of samples at rest. The second part is
the larger one as a rule: contacts magnify where a ball lay. What no sample tells has the variance
of the bounds of the search.

The constants of a search by whole shots (`_joint`) are off by N^-1 sum of g, with the normal
equations N of all shots from which the strikes are eliminated, and each shot's gradient g = A^T W
d, A = J_c - J_p (J_p^T W J_p)^-1 J_p^T W J_c. Shots are independent, their samples are not, so the
scatter of the gradients over the shots tells how large they are (the "sandwich" covariance,
clustered by shots):

    covariance of the constants = N^-1 (n/(n - 1) sum of (g - mean g)(g - mean g)^T + priors) N^-1.

A prior's gradient is off by as much as its mean is. A derivative says nothing beyond its reach: a
sample that one deviation of the priors moves by more than 0.3 m has as much less weight as if it
were moved by 0.3 m.

What the search leaves (`_joint.left`) is added to the diagonal. On synthetic recordings 3 in 100
constants are off by more than three of these errors. On 91 real shots the constants of two halves
differ by less than one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from carom.dtypes import Doubles
from carom.tracks import _joint
from carom.tracks._strikes import Plays, derivatives

# What bounds a strike: speeds (m/s), spins over the speed, and the time (s).
_SPEED, _SPIN, _TIME = 8.0, 2.0, 0.1


def bounds(strike: Doubles) -> Doubles:
    """How far off each number of a strike may be where no sample tells it, (6,)."""
    speed = float(np.hypot(strike[0], strike[1]))
    return np.array([_SPEED, _SPEED, *3 * [_SPIN * speed + 0.2], _TIME])


def of_strike(
    plays: Plays, row: int, strike: Doubles, names: Sequence[str] = ()
) -> tuple[Doubles, Doubles, Doubles]:
    """Of the strike of a shot: s^2 P, (6, 6), and how it follows each constant of these names, and
    each deviation, m, of a coordinate of a place of rest, (6, names + 2 balls), and these
    deviations.
    """
    d, J_p, J_c, J_r = derivatives(plays, row, strike, list(names))
    variance = float(d @ d) / max(len(d) - 6, 1)
    # by R of the factorisation Q R, as the product J^T J has the square of its condition number
    root = np.linalg.inv(
        np.linalg.qr(np.vstack([J_p / np.sqrt(variance), np.diag(1.0 / bounds(strike))]), mode="r")
    )
    P = root @ root.T
    return (
        P,
        -(P / variance) @ J_p.T @ np.hstack([J_c, J_r]),
        np.sqrt(variance / np.repeat(plays.recordings[row].still, 2)),
    )


def of_constants(search: _joint.Search, priors: Mapping[str, float]) -> Doubles | None:
    """The covariance of the constants of a search that is done; None where too few shots tell.

    `told` are the errors of constants that single events told: those of the means of the priors.
    Other means are off by a deviation.
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
    # what the search leaves is of each constant by itself
    return np.asarray(
        inverse @ inner @ inverse * np.outer(search.scale, search.scale)
        + np.diag(_joint.left(search) ** 2)
    )
