"""How far strikes and constants that were fitted may be off, by derivatives of whole shots.

Of one shot, d are the distances of its samples, J_p, J_c and J_r their derivatives by the strike, the constants and the places of rest:
`carom.tangents` at the times of the samples, and -v by the time of the strike.

A strike that minimises |d|^2 is off by -(J_p^T J_p)^-1 J_p^T (noise + J_r times the noise of the places of rest, which are held), so

    covariance of the strike = s^2 P + P J_p^T J_r S J_r^T J_p P,      P = (J_p^T J_p + bounds)^-1.

s^2 is what the samples leave over, S has s^2 over the number of samples at rest. The second part is the larger one as a rule: contacts
magnify where a ball lay. What no sample tells has the variance of the bounds of the search.

The constants of a search by whole shots (`_joint`) are off by N^-1 sum of g, with the normal equations N of all shots from which the
strikes are eliminated, and each shot's gradient g = A^T W d, A = J_c - J_p (J_p^T W J_p)^-1 J_p^T W J_c. Shots are independent, their
samples are not, so the scatter of the gradients over the shots tells how large they are (the "sandwich" covariance, clustered by shots):

    covariance of the constants = N^-1 (n/(n - 1) sum of (g - mean g)(g - mean g)^T + priors) N^-1.

A prior's gradient is off by as much as its mean is. A derivative says nothing beyond its reach: a sample that one deviation of the priors
moves by more than 0.3 m has as much less weight as if it were moved by 0.3 m.

The correlations are taken from this, and the standard errors from halves of the shots (`_joint.spread`). On synthetic recordings both
agree. On 91 real shots, constants of random halves differ by two to three times what derivatives say, since a search ends in
another minimum where events are missed, which no derivative sees.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from carom.derivatives import tangents
from carom.dtypes import Doubles
from carom.shots import simulate
from carom.status import CaromError
from carom.tracks import _joint
from carom.tracks._strikes import HUBER, Plays

_FARTHEST = 0.3  # m: what one deviation of the priors moves farther counts less
# What bounds a strike: speeds (m/s), spins over the speed, and the time (s).
_SPEED, _SPIN, _TIME = 8.0, 2.0, 0.1


def derivatives(plays: Plays, row: int, strike: Doubles, names: list[str]) -> tuple[Doubles, Doubles, Doubles, Doubles]:
    """Of one shot: distances of all samples, (2 n,), and their derivatives by the strike, (2 n, 6), by constants, by places of rest.

    The time of the strike is on the clock of the plays.
    """
    tracks, struck = plays.tracks[row], int(plays.struck[row])
    balls = plays.layouts[0, row].copy()
    balls["state"]["v"][struck, :2] = strike[:2]
    balls["state"]["w"][struck] = strike[2:5] / plays.radius
    played = simulate(plays.table, balls, cushion_model=plays.cushion_model)

    # the tangents at all times of samples, on the clock of the play
    times = np.unique(np.concatenate([track[:, 0] for track in tracks]))
    at = np.maximum(times - strike[5], 0.0)
    wrt = [f"balls[{struck}].v", f"balls[{struck}].w", *(f"kind.{name}" for name in names)]
    wrt += [f"balls[{ball}].r" for ball in range(len(balls))]
    found = tangents(played, wrt, times=at).at["r"]
    states = played.states(at)

    distances, slopes = [], []
    for ball, track in enumerate(tracks):
        when = np.searchsorted(times, track[:, 0])
        J = found[when, ball, :2]
        J[..., 2:5] /= plays.radius  # by R w
        later = np.where((times[when] > strike[5])[:, None], -states["v"][when, ball, :2], 0.0)
        distances.append(states["r"][when, ball, :2] - track[:, 1:])
        slopes.append(np.concatenate([J[..., :5], later[..., None], J[..., 5:]], axis=-1))
    d, J = np.concatenate(distances).ravel(), np.concatenate(slopes)
    J = J.reshape(len(d), -1)
    return d, J[:, :6], J[:, 6 : 6 + len(names)], J[:, 6 + len(names) :]


def of_strike(plays: Plays, row: int, strike: Doubles) -> Doubles:
    """The covariance of the strike of a shot, (6, 6)."""
    d, J_p, _, J_r = derivatives(plays, row, strike, [])
    variance = float(d @ d) / max(len(d) - 6, 1)
    speed = float(np.hypot(strike[0], strike[1]))
    bounds = np.array([_SPEED, _SPEED, *3 * [_SPIN * speed + 0.2], _TIME])
    # by R of the factorisation Q R, as the product J^T J has the square of its condition number
    root = np.linalg.inv(np.linalg.qr(np.vstack([J_p / np.sqrt(variance), np.diag(1.0 / bounds)]), mode="r"))
    P = root @ root.T / variance
    follow = P @ (J_p.T @ J_r) / np.sqrt(np.repeat(plays.recordings[row].still, 2))
    return np.asarray(variance * (P + follow @ follow.T))


def of_constants(search: _joint.Search, told: Mapping[str, float], spread: Mapping[str, float]) -> Doubles | None:
    """The covariance of the constants of a search that is done, whose standard errors are `spread`; None without these.

    `told` are the errors of constants that single events told: those of the means of the priors. Other means are off by a deviation.
    """
    if not spread:
        return None
    plays = search.plays
    plays.set(search.constants(search.values))
    n = len(search.names)
    whole, gradients = search.prior_cost * np.eye(n), []
    for row, strike in zip(search.rows, search.strikes):
        try:
            d, X, C, _ = derivatives(plays, int(row), strike, search.names)
        except CaromError:
            continue  # the play ends in an error
        C = C * search.scale
        size = (d.reshape(-1, 2) ** 2).sum(axis=1)
        root = np.sqrt(1.0 + size / HUBER**2)
        size_of_cost = 2.0 * HUBER**2 * float((root - 1.0).mean())
        if size_of_cost >= _joint.MOST:
            continue  # it does not count in the search either
        root = root * (1.0 + size_of_cost / search.middle)
        # a derivative says nothing beyond its reach
        moved = (C.reshape(len(size), -1) ** 2).sum(axis=1)
        W = np.repeat(np.minimum(1.0, _FARTHEST**2 / np.maximum(moved, 1e-12)) / root, 2)[:, None]
        A = C - X @ np.linalg.solve(_joint.damped(X.T @ (W * X)), X.T @ (W * C))
        whole += C.T @ (W * A)
        gradients.append(A.T @ (W[:, 0] * d))
    g = np.array(gradients).reshape(-1, n)
    g -= g.mean(axis=0)
    off = np.array([min(told.get(name, scale) / scale, 1.0) for name, scale in zip(search.names, search.scale)])
    inner = g.T @ g * (len(g) / max(len(g) - 1.0, 1.0)) + np.diag((search.prior_cost * off) ** 2)
    inverse = np.linalg.inv(whole)
    covariance = inverse @ inner @ inverse
    # what the search leaves, which the standard errors contain, is of each constant by itself
    method = _joint.left(search) ** 2
    size = np.sqrt((np.array([spread[name] for name in search.names]) ** 2 - method).clip(0.0) / covariance.diagonal())
    return np.asarray(covariance * np.outer(size, size) + np.diag(method))
