"""Design of further shots that determine the constants of a fit best.

Candidates are strokes of the cue ball at an object ball or past it, with random positions, speeds
and tips, as a camera with 30 frames per second would record them. With the derivatives J_c and J_p
of the samples by the constants and the strike, a shot adds

    (J_c^T J_c - J_c^T J_p (J_p^T J_p)^-1 J_p^T J_c) / V

to the inverse of the covariance of the constants. V is the variance of one sample in the fit, as in
`_joint.Search.weigh`. The shots are chosen greedily: each minimises the sum of the variances
relative to those of the priors.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.dtypes import Doubles, Records
from carom.layouts import balls, cue
from carom.shots import simulate
from carom.status import CaromError
from carom.tracks import _constants, _joint, _strikes
from carom.tracks._profile import NORMAL
from carom.tracks._recordings import Recording

_CANDIDATES, _RATE, _LONGEST = (
    60,
    30.0,
    4.0,
)  # drawn shots; frames per second, and their duration, s
_STILL = 0.4  # s at rest before a strike
_FARTHEST = (
    0.03  # m: samples that a deviation of a prior moves farther count less, as fits lose them
)


@dataclass(frozen=True)
class Design:
    """A shot to play and to record."""

    places: Doubles  # (2, 2): Of the cue ball and of an object ball, m
    cue: Records  # The stroke, as `carom.simulate` takes it
    old_errors: dict[str, float]  # The standard error of each constant without the shot,
    new_errors: dict[str, float]  # and with it and the shots before it

    def __str__(self) -> str:
        (x, y), (p, q) = self.places
        right, above = 0.0 - float(self.cue["a"]), float(self.cue["b"])
        gains = sorted(
            self.old_errors, key=lambda name: self.new_errors[name] / self.old_errors[name]
        )
        gain = ", ".join(
            f"{k} {self.old_errors[k]:.2g} to {self.new_errors[k]:.2g}" for k in gains[:3]
        )
        return (
            f"cue ball at {x:.2f}, {y:.2f} m, a ball at {p:.2f}, {q:.2f} m, direction "
            f"{float(self.cue['phi']):.0f} degrees, cue {float(self.cue['speed']):.1f} m/s, tip "
            f"{right:+.1f} R right and {above:+.1f} R above; errors fall: {gain}"
        )


def _drawn(fit: Any, random: np.random.Generator) -> tuple[Doubles, Records]:
    """Random positions and a stroke."""
    size = np.array(fit.ground.size)
    margin = 4.0 * fit.radius
    while True:
        places = random.uniform(margin, size - margin, (2, 2))
        line = places[1] - places[0]
        if np.hypot(*line) > 8.0 * fit.radius:
            break
    aim = np.degrees(np.arctan2(line[1], line[0])) + random.choice([0.0, 1.5, -1.5, 30.0, -60.0])
    tip = random.choice([-0.4, 0.0, 0.4]), random.choice([-0.4, 0.0, 0.4])
    speed = random.choice([0.8, 1.5, 2.5])
    stroke = cue(speed=speed, phi=aim % 360.0, a=tip[0], b=tip[1], game=fit.ground.game)
    return np.round(places, 2), stroke


def _recorded(fit: Any, places: Doubles, stroke: Records) -> tuple[Recording, Doubles]:
    """The shot as a camera would record it, and its strike, on the clock of the recording."""
    layout = balls(places, game=fit.ground.game, radius=fit.radius)
    for name, value in fit.constants.items():
        if name in _constants.KINDS:
            layout["kind"][name] = value
    shot = simulate(fit.ground.table, layout, stroke, cushion_model=fit.cushion_model)
    moved = shot.events["after"][0, 0]
    times = np.arange(0.0, _STILL + min(shot.time, _LONGEST), 1.0 / _RATE)
    seen = shot.positions(np.clip(times - _STILL, 0.0, shot.time))[..., :2]
    tracks = tuple(np.column_stack([times, seen[:, ball]]) for ball in range(2))
    strike = np.array([*moved["v"][:2], *(fit.radius * moved["w"]), _STILL])
    view = fit.recordings[0].view
    return Recording("design", (1, 2), tracks, fit.noise, view), strike


def _information(
    fit: Any, names: list[str], scale: Doubles, shot: Recording, strike: Doubles
) -> Doubles:
    """The information of a shot on the constants, in deviations of their priors, times V."""
    plays = _strikes.Plays([shot], fit.table, fit.radius, fit.constants, fit.cushion_model)
    on_clock = strike - [0.0, 0.0, 0.0, 0.0, 0.0, plays.origins[0]]
    _, J_p, J_c, _ = _strikes.derivatives(plays, 0, on_clock, names, rest=False)
    J_c = J_c * scale
    moved = (J_c.reshape(len(J_c) // 2, -1) ** 2).sum(axis=1)
    weight = np.repeat(np.minimum(1.0, _FARTHEST**2 / np.maximum(moved, 1e-12)), 2)[:, np.newaxis]
    follow = np.linalg.solve(_joint.damped(J_p.T @ (weight * J_p)), J_p.T @ (weight * J_c))
    return np.asarray(J_c.T @ (weight * (J_c - J_p @ follow)))


def design(fit: Any, count: int, seed: int) -> list[Design]:
    """The shots; see `Fit.design`."""
    names = list(fit.fitted)
    if not names:
        raise ValueError(
            "design: this fit determined no constants from complete shots; choose them with free"
        )
    priors = [_joint.prior(name, fit.constants[name])[0] for name in names]
    scale = np.array([width or 1.0 for width in priors])

    # what is known so far, in deviations of the priors
    if fit.covariance is not None:
        known = fit.covariance / np.outer(scale, scale)
    else:
        ends = [fit.intervals.get(name) for name in names]
        sizes = [
            1.0 if end is None else (end[1] - end[0]) / (2.0 * NORMAL) / width
            for end, width in zip(ends, scale)
        ]
        known = np.diag(np.maximum(sizes, 1e-6) ** 2)
    excess = max(fit.median_rmse**2 - 2.5 * fit.noise**2, 0.0)
    variance = min(fit.noise**2 + _joint.ALIKE * excess, _joint.PRIOR_MOST)

    random = np.random.default_rng(seed)
    candidates: list[tuple[Doubles, Records, Doubles]] = []
    while len(candidates) < _CANDIDATES:
        places, stroke = _drawn(fit, random)
        try:
            shot, strike = _recorded(fit, places, stroke)
            gain = _information(fit, names, scale, shot, strike) / variance
        except (CaromError, ValueError):
            continue  # a ball of the drawn layout has no room, or its play has no derivatives
        candidates.append((places, stroke, gain))

    chosen = []
    inverse = np.linalg.inv(known)
    for _ in range(count):
        left = [np.linalg.inv(inverse + gain).trace() for _, _, gain in candidates]
        places, stroke, gain = candidates.pop(int(np.argmin(left)))
        old_errors, inverse = np.linalg.inv(inverse), inverse + gain
        errors = [
            dict(zip(names, (scale * np.sqrt(part.diagonal())).tolist()))
            for part in (old_errors, np.linalg.inv(inverse))
        ]
        chosen.append(Design(places, stroke, *errors))
    return chosen
