"""Constants from single events, without simulating shots, so each constant has separate evidence.

- mu_slide and mu_roll: medians and means over pieces. The engine's rolling resistance is constant,
    so mu_roll is the mean deceleration
  over the time that was recorded, over g.
- restitution: hits on a ball at rest, e = (z_n - w_n)/v_n. Friction between balls is not among
    them: its direction is that of a slip
  that side spin, which is not seen, can turn round.
- restitution_cushion, mu_cushion, nose_height: the impacts of rolling balls on cushions, predicted
    by the model of the cushion. Side
  spin is not seen, so each impact has one of its own: the best, with a prior of 0 +- 0.12 v for
  balls that were not struck before their first cushion, and 0 +- 0.7 v for others.

A constant's error is the scatter of its median, or for the cushion of fits to random halves of the
impacts, plus the error of the method, added in quadrature; see _METHOD.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, cast

import numpy as np

from carom import dtypes
from carom._described import CushionNumbers
from carom._rows import Array
from carom._shot_options import ShotCushion
from carom.cushions import NUMBERS, cushion
from carom.dtypes import Doubles, Records
from carom.tracks import _events
from carom.tracks._constants import usual
from carom.tracks._events import Events

_GRAVITY = 9.81
_SPINS = np.linspace(-3.0, 3.0, 101)  # R w_z over v, that are tried
# What synthetic recordings, whose truth is known, are off by in the mean of many: slides are cut
# late, and the prior of the delay at a cushion moves the constants by so much when it is changed by
# 3 ms.
_METHOD = {
    "mu_slide": 0.001,
    "mu_roll": 5e-5,
    "restitution_cushion": 0.003,
    "mu_cushion": 0.002,
    "nose_height": 3e-4,
}
_SPLITS = 4  # in halves
_MU_ERROR = 0.15  # deviation of the prior of mu_cushion
_OUTLIER = 3.0  # standard deviations where an impact's cost turns from a square to a logarithm


def measured(
    events: Events,
    radius: float,
    cushion_model: ShotCushion,
    seed: int,
    constants: Mapping[str, float] | None = None,
) -> tuple[dict[str, float], dict[str, float]]:
    """The constants that the events determine, and their errors.

    Constants with too few events are omitted. `given` contains the other constants of the cushion.
    """
    found: dict[str, tuple[float, float]] = {
        "mu_slide": (events.slide[0] / _GRAVITY, events.slide[1] / _GRAVITY),
        "mu_roll": (events.roll[0][0] / _GRAVITY, events.roll[0][1] / _GRAVITY),
        "drag": (max(events.roll[1][0], 0.0), events.roll[1][1]),
        "restitution": _hits(events.hits),
        **_cushion(
            events.impacts,
            radius,
            cushion_model,
            np.random.default_rng(seed),
            constants or usual(cushion_model),
        ),
    }
    found = {name: pair for name, pair in found.items() if math.isfinite(pair[0])}
    errors = {name: math.hypot(error, _METHOD.get(name, 0.0)) for name, (_, error) in found.items()}
    return {name: value for name, (value, _) in found.items()}, errors


def _hits(hits: Records) -> tuple[float, float]:
    """restitution."""
    good = hits[
        (hits["chi2"] < 3.0)
        & (hits["v_n"] > 0.5)
        & (hits["w_error"] < 0.1)
        & (hits["z_error"] < 0.1)
    ]
    if len(good) < 8:
        return math.nan, math.nan
    value, error = _events.median((good["z_n"] - good["w_n"]) / good["v_n"])
    return min(max(value, 0.0), 1.0), error


def chosen(impacts: Records) -> Records:
    """The impacts of rolling balls that are known well enough to fit a cushion by."""
    well = (
        (impacts["chi2"] < 2.5)
        & (impacts["v_error"] < 0.04)
        & (impacts["w_error"] < 0.04)
        & (impacts["u_error"] < 0.15)
    )
    picked: Records = impacts[impacts["rolling"] & well & (impacts["v_n"] > 0.45)]
    return picked


def rebound(
    v_t: Doubles,
    v_n: Doubles,
    spin: Doubles,
    radius: float,
    model: ShotCushion,
    constants: Mapping[str, Any],
) -> Doubles:
    """v_t, v_n and R w_t, R w_n, R w_z after impacts, (..., 5), as computed by carom_shoot();
    `spin` contains the last three before, (..., 3).
    """
    balls: Array = np.zeros(np.shape(v_t), dtypes.cushion_impact)
    balls["v"][..., 0], balls["v"][..., 1], balls["w"] = v_t, v_n, spin / radius
    balls["normal"], balls["radius"] = (0.0, 1.0), radius
    for field, name in (
        ("height", "nose_height"),
        ("mass", "mass"),
        ("mu_slide", "mu_slide"),
        ("mu_cushion", "mu_cushion"),
        ("restitution", "restitution_cushion"),
    ):
        balls[field] = constants[name]
    numbers = cast(CushionNumbers, {name: constants[name] for name in NUMBERS})
    motion = cushion(balls, model="mathavan" if model == "default" else model, **numbers)[0]
    return np.concatenate([motion["v"][..., :2], radius * motion["w"]], axis=-1)


def predicted(
    impacts: Records,
    radius: float,
    model: ShotCushion,
    e: float | Doubles,
    mu: float | Doubles,
    height: float,
    roll_loss: float = 0.0,
    constants: Mapping[str, float] | None = None,
) -> Doubles:
    """w_t, w_n, u_t and u_n after each impact of a rolling ball, by the model, with its best side
    spin, and the misfit, (n, 5).

    Other numbers of the cushion are `given`, or the usual ones. The misfit is chi^2 of the four,
        whose errors are those of the events and
    1.2 % of v for w, 3 % for u, and the prior's.
    """
    v = np.hypot(impacts["v_n"], impacts["v_t"])
    v_t, v_n = (
        np.broadcast_to(impacts[name][:, None], (len(impacts), len(_SPINS)))
        for name in ("v_t", "v_n")
    )
    numbers = {
        "restitution_cushion": e,
        "mu_cushion": mu,
        "nose_height": height,
        "roll_loss": roll_loss,
    }
    motions = rebound(
        v_t,
        v_n,
        np.stack([-v_n, v_t, _SPINS * v[:, None]], axis=-1),
        radius,
        model,
        {**(constants or usual(model)), **numbers},
    )
    outgoing = np.stack(
        [
            motions[..., 0],
            motions[..., 1],
            motions[..., 0] - motions[..., 3],
            motions[..., 1] + motions[..., 2],
        ],
        axis=-1,
    )
    seen = np.stack([impacts["w_t"], impacts["w_n"], impacts["u_t"], impacts["u_n"]], axis=-1)
    # the best spin of each
    w_error, u_error = (
        np.hypot(impacts["w_error"], 0.012 * v),
        np.hypot(impacts["u_error"], 0.03 * v),
    )
    error = np.stack([w_error, w_error, u_error, u_error], axis=-1)
    prior = np.where(impacts["first"], 0.12, 0.7)
    chi2 = (((outgoing - seen[:, None]) / error[:, None]) ** 2).sum(axis=-1) + (
        _SPINS / prior[:, None]
    ) ** 2
    best = np.argmin(np.where(np.isfinite(chi2), chi2, np.inf), axis=1)
    rows = np.arange(len(impacts))
    return np.concatenate([outgoing[rows, best], chi2[rows, best, None]], axis=1)


_CUSHION = ("restitution_cushion", "mu_cushion", "roll_loss", "nose_height")
_LEAST, _MOST = (
    np.array([0.05, 0.0, 0.0, 1.0]),
    np.array([1.0, 1.0, 0.5, 1.7]),
)  # of the last: over the radius


def _free(model: ShotCushion) -> tuple[str, ...]:
    """The constants of _CUSHION that impacts determine: without friction only the first."""
    return _CUSHION if model != "mirror" else _CUSHION[:1]


def _cost(
    impacts: Records,
    radius: float,
    model: ShotCushion,
    values: Doubles,
    constants: Mapping[str, float],
) -> float:
    """The cost of constants of _CUSHION, the last over the radius, with a prior of the friction:
    above some value every ball sticks.
    """
    e, mu, loss, height = values
    prior = ((mu - constants["mu_cushion"]) / _MU_ERROR) ** 2
    chi2 = predicted(impacts, radius, model, e, mu, height * radius, loss, constants)[:, 4]
    return float(prior + (_OUTLIER**2 * np.log1p(chi2 / _OUTLIER**2)).sum())


def _fit_cushion(
    impacts: Records,
    radius: float,
    model: ShotCushion,
    start: Doubles,
    constants: Mapping[str, float],
) -> Doubles:
    """The constants of _CUSHION, the last over the radius, of these impacts."""
    free = len(_free(model))

    def residuals(sets: Doubles) -> Doubles:
        rows: list[Doubles] = []
        for values in sets:
            e, mu, loss, height = bounded = np.clip([*values, *start[free:]], _LEAST, _MOST)
            chi2 = predicted(impacts, radius, model, e, mu, height * radius, loss, constants)[:, 4]
            # the square root of the cost, so that squares add up to it, and what leads back from
            # beyond the bounds
            outside = 100.0 * (np.array(values) - bounded[:free])
            outside = np.append(outside, (mu - constants["mu_cushion"]) / _MU_ERROR)
            rows.append(np.concatenate([_OUTLIER * np.sqrt(np.log1p(chi2 / _OUTLIER**2)), outside]))
        return np.array(rows)

    found = _events.least_squares(residuals, start[:free], np.full(free, 0.1), 25)[0]
    return np.asarray(np.clip([*found, *start[free:]], _LEAST, _MOST))


def _cushion(
    impacts: Records,
    radius: float,
    model: ShotCushion,
    random: np.random.Generator,
    constants: Mapping[str, float],
) -> dict[str, tuple[float, float]]:
    """The constants of _CUSHION."""
    good = chosen(impacts)
    if len(good) < 20:
        return {}
    size = np.array([1.0, 1.0, 1.0, radius])
    start = np.array([constants[name] for name in _CUSHION]) / size
    # another friction may be another minimum, in which most balls stick
    tried = [
        _fit_cushion(good, radius, model, start * [1.0, share, 1.0, 1.0], constants)
        for share in (1.0, 0.6)
    ]
    found = min(tried, key=lambda values: _cost(good, radius, model, values, constants))
    error = _events.halves(
        len(good),
        _SPLITS,
        random,
        lambda half: _fit_cushion(good[half], radius, model, found, constants),
    )
    return {
        name: (float(value), float(spread))
        for name, value, spread in zip(_free(model), found * size, error * size)
    }
