"""The errors of a player from recorded strokes with the same intention.

Strokes of one group have the same layout, up to some centimetres, and the same intention. Of each,
a fit gives y: the logarithm of the ball's speed, the direction of the cue (degrees), and where the
tip met the ball, a = - R w_z / (2.5 v) and b = R w_roll / (2.5 v) in radii, with the variances m of
the strike. The cue's direction differs from the ball's path by the squirt of a. A direction is
measured from the line to the ball that the struck ball hits first, which makes it insensitive to
the differences between the layouts.

The strokes of a group scatter about their unknown mean with the variances s^2 g^2 + m, s being the
player's error and g its growth with the speed. With the mean integrated out the likelihood is

    log L(s) = - 1/2 sum over groups of (sum of log(s^2 g^2 + m) + log sum of w + sum of w (y -
    y')^2),

with weights w = 1 / (s^2 g^2 + m) and the weighted mean y'. The posterior of s follows with a
uniform prior, and so does the posterior of the rating, which determines all four errors at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from carom import dtypes
from carom._carom import lib
from carom._rows import Array, pointer
from carom.dtypes import Doubles, Records
from carom.layouts import balls, cue, struck

NEAR, _TURNED, _FASTER = 0.03, 6.0, 0.3  # of strokes alike: places, m; degrees; of the speed
LEAST = 4  # strokes beyond the first of their groups
_RATINGS: Doubles = np.arange(200.0, 851.0, 2.0, dtype=np.float64)
_NAMES = ("speed_share", "phi", "a", "b")
_MOST = np.array([0.5, 10.0, 0.5, 0.5])  # of each error that is likely
_GRID = 400


class Likely(NamedTuple):
    """The posterior mean and the central 95 % interval."""

    mean: float
    low: float
    high: float


@dataclass(frozen=True)
class Player:
    """The errors of a player, from strokes with the same intention."""

    speed_share: Likely  # Relative error of the speed
    phi: Likely  # Of the direction, degrees
    a: Likely  # Of the tip to the side, radii
    b: Likely  # Of the tip up and down, radii
    rating: Likely  # The Fargo rating with these errors, 200 to 850
    groups: list[list[int]]  # The shots of each group
    record: Records  # For `carom.plan`: the rated player with these errors

    def __str__(self) -> str:
        def told(likely: Likely, unit: str) -> str:
            return f"{likely.mean:.3g} ({likely.low:.2g} to {likely.high:.2g}) {unit}"

        share = Likely(*(100.0 * x for x in self.speed_share))
        count = sum(map(len, self.groups))
        return (
            f"the player errs by {told(share, '%')} in speed, {told(self.phi, 'degrees')}, and by "
            f"{told(self.a, 'R')} to the side and {told(self.b, 'R')} in height of the tip, like "
            f"one rated {self.rating.mean:.0f} ({self.rating.low:.0f} to {self.rating.high:.0f}), "
            f"by {count} strokes of {len(self.groups)} kinds"
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the errors, for JSON."""
        found: dict[str, Any] = {
            name: getattr(self, name)._asdict() for name in (*_NAMES, "rating")
        }
        names = dtypes.player.names or ()
        record = dict(zip(names, self.record.item()))
        return {**found, "groups": self.groups, "player": record}


def _squirt(a: float, b: float) -> float:
    """The squirt of the usual cue, degrees."""
    room = max(np.hypot(a, b) / 0.9, 1.0)  # a strike that is found may be beyond the ball's edge
    kind = balls([[0.0, 0.0]], game="billiard")["kind"][0]
    v = struck(cue(phi=0.0, a=a / room, b=b / room, game="billiard"), kind)["v"]
    return float(np.degrees(np.arctan2(v[1], v[0])))


def _stroke(fit: Any, shot: int) -> tuple[Doubles, Doubles, float]:
    """y of a stroke, its variances, and the speed of the ball, m/s."""
    strike = fit.strikes[shot]
    v, spin = strike[:2], strike[2:5]
    speed = float(np.hypot(*v))
    along = v / speed

    # spin as the tip gave it: w_roll turns the ball the way it goes
    roll = along[0] * spin[1] - along[1] * spin[0]
    a, b = -spin[2] / (2.5 * speed), roll / (2.5 * speed)
    squirt = _squirt(a, b)
    by_a = (_squirt(a + 0.01, b) - squirt) / 0.01
    y = np.array([np.log(speed), np.degrees(np.arctan2(v[1], v[0])) - squirt, a, b])

    # the derivatives of y by v and the spins
    J: Doubles = np.zeros((4, 6))
    J[0, :2] = along / speed
    J[1, :2] = np.degrees([-along[1], along[0]]) / speed
    J[2, :2], J[2, 4] = -a * along / speed, -0.4 / speed
    J[3, :2], J[3, 2:4] = -b * along / speed, 0.4 * np.array([-along[1], along[0]]) / speed
    J[1] -= by_a * J[2]
    variances = (J @ fit.strike_covariance(shot) @ J.T).diagonal()

    # the direction from the line to the first ball
    events = fit.shot(shot).events
    first = fit.recordings[shot].cue
    hits = events[(events["type"] == lib.CAROM_EVENT_BALL_BALL)]
    cushions = events["time"][events["type"] == lib.CAROM_EVENT_RAIL]
    hits = hits[(hits["a"] == first) | (hits["b"] == first)]
    if len(hits) and not (cushions < hits["time"][0]).any():
        second = int(hits["b"][0] if hits["a"][0] == first else hits["a"][0])
        line = fit.recordings[shot].rest[second] - fit.recordings[shot].rest[first]
        y[1] -= np.degrees(np.arctan2(line[1], line[0]))
    y[1] = (y[1] + 180.0) % 360.0 - 180.0
    return y, variances, speed


def groups_of(fit: Any) -> list[list[int]]:
    """Groups of usable shots, except doubtful ones, with similar layouts and strikes."""
    groups: list[list[int]] = []
    for shot in np.flatnonzero(fit.counts).tolist():
        if fit.status[shot].startswith("doubtful"):
            continue  # the strike may be another than the player's
        for group in groups:
            first = group[0]
            here, there = fit.recordings[shot], fit.recordings[first]
            if here.rest.shape != there.rest.shape or here.cue != there.cue:
                continue
            v, w = fit.strikes[shot, :2], fit.strikes[first, :2]
            speeds = np.hypot(*v), np.hypot(*w)
            turned = np.degrees(np.arctan2(v[0] * w[1] - v[1] * w[0], v @ w))
            near = np.hypot(*(here.rest - there.rest).T).max() < NEAR
            if near and abs(turned) < _TURNED and max(speeds) < (1.0 + _FASTER) * min(speeds):
                group.append(shot)
                break
        else:
            groups.append([shot])
    return [group for group in groups if len(group) > 1]


def _likelihood(y: Doubles, variance: Doubles) -> float:
    """The likelihood of the values y of a group, with their mean integrated out."""
    w = 1.0 / variance
    middle = float(w @ y / w.sum())
    return float(-0.5 * (np.log(variance).sum() + np.log(w.sum()) + w @ (y - middle) ** 2))


def _likely(values: Doubles, logarithms: Doubles) -> Likely:
    """The mean and the interval of values on a grid, from their log likelihoods."""
    mass = np.exp(logarithms - logarithms.max())
    part = np.cumsum(mass) / mass.sum()
    low, high = np.interp([0.025, 0.975], part, values)
    return Likely(float(values @ mass / mass.sum()), float(low), float(high))


def player_of(fit: Any, groups: Sequence[Sequence[int]] | None = None) -> Player:
    """The player of a fit; see `Fit.player`."""
    chosen = groups_of(fit) if groups is None else [list(map(int, group)) for group in groups]
    wrong = [shot for group in chosen for shot in group if not fit.counts[shot]]
    if wrong:
        raise ValueError(f"groups: shot {fit.recordings[wrong[0]].id} has no strike; leave it out")
    if sum(len(group) - 1 for group in chosen) < LEAST:
        raise ValueError(
            f"groups: {sum(map(len, chosen))} strokes in {len(chosen)} groups are too few; at least {LEAST} "
            f"repetitions are required, with the balls within {1e3 * NEAR:.0f} mm and the same aim and speed"
        )
    strokes = [[_stroke(fit, shot) for shot in group] for group in chosen]
    parts = [[np.array(part) for part in zip(*group)] for group in strokes]

    # each error by itself
    found = []
    for k in range(len(_NAMES)):
        sizes = _MOST[k] * np.linspace(1e-3, 1.0, _GRID) ** 2
        found.append(
            _likely(
                sizes,
                np.array(
                    [sum(_likelihood(y[:, k], s * s + m[:, k]) for y, m, _ in parts) for s in sizes]
                ),
            )
        )

    # all of them by the rating, whose errors grow with the speed of the cue; carom's rated players
    # have a tip that loses nothing, with which cue and ball are about as fast
    rating: Doubles = np.zeros(len(_RATINGS))
    for row, value in enumerate(_RATINGS):
        rated = lib.carom_player_fargo(float(value))
        for y, m, speed in parts:
            grown = np.sqrt(1.0 + (rated.growth * speed) ** 2)
            errors = [np.hypot(rated.speed / speed, rated.speed_share)]
            errors += [size * grown for size in (rated.phi, rated.a, rated.b)]
            rating[row] += sum(
                _likelihood(y[:, k], error**2 + m[:, k]) for k, error in enumerate(errors)
            )
    rated_as = _likely(_RATINGS, rating)

    record: Array = np.zeros((), dtypes.player)
    pointer("carom_player[]", record)[0] = lib.carom_player_fargo(rated_as.mean)
    speeds = np.concatenate([speed for _, _, speed in parts])
    grown = float(np.sqrt(np.mean(1.0 + (record["growth"] * speeds) ** 2)))
    record["speed"], record["speed_share"] = 0.0, found[0].mean
    for name, likely in zip(_NAMES[1:], found[1:]):
        record[name] = likely.mean / grown
    speed_share, phi, a, b = found
    return Player(speed_share, phi, a, b, rated_as, chosen, record)
