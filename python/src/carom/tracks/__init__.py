"""Recorded paths of balls: reading them, making synthetic ones, and detecting their events.

A recording is one shot: for each ball rows of time and position, s and m, in order of time. The
table is 0 <= x <= W, 0 <= y <= L, so a ball's centre stays a radius inside. Recordings of cameras
have four traps, which this module handles:

- the first rows of a ball, often only one, are its position at rest, whenever it starts to move;
- later rows may be thinned by displacement: a row is written once the ball is far enough from the
  last written row, and the last row is the final position, at the end of the recording;
- positions may be clamped to the cushions, so a coordinate of exactly R or W - R has little meaning;
- the strike occurred at some time before the first row of the moving ball, not at time 0.

`read` reads files. `events` finds pieces of rolling and sliding, impacts on cushions, and hits,
each with its quantities and errors, as structured arrays of the dtypes `piece`, `impact` and `hit`.
`synthetic` simulates shots with known strikes and records them with the traps and the noise of real
recordings.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from carom._rows import Seed, as_array, listing, number, seed_of, whole
from carom._shot_options import ShotCushion
from carom.dtypes import Doubles
from carom.results import Shot
from carom.shots import simulate
from carom.tracks import _constants
from carom.tracks._events import Events, events, hit, impact, piece
from carom.tracks._examination import Examination, Finding, examine
from carom.tracks._reading import Reading, read
from carom.tracks._recordings import MOVED, NOISE, Recording, TrackError

__all__ = [
    "MOVED",
    "NOISE",
    "Events",
    "Examination",
    "Finding",
    "Reading",
    "Recording",
    "Synthetic",
    "TrackError",
    "events",
    "examine",
    "hit",
    "impact",
    "piece",
    "read",
    "synthetic",
]
__dir__ = listing(__name__)


@dataclass(frozen=True, eq=False)
class Synthetic:
    """Recordings of simulated shots, with the true shots."""

    recordings: list[Recording]
    shots: list[Shot]  # As played; their clocks begin at the strikes
    strikes: Doubles  # (shots, 6): v_x, v_y (m/s); R w_x, R w_y, R w_z (m/s); start (s)
    constants: dict[str, float]


def _record(
    positions: Callable[[Doubles], Doubles],
    end: float,
    rate: float,
    thin: float,
    low: float,
    high: Doubles,
    noise: float,
    random: np.random.Generator,
) -> tuple[Doubles, ...]:
    """The tracks that a camera records of balls at positions(times), with the traps."""
    times: Doubles = np.arange(0.0, end + 1.0 / rate, 1.0 / rate, dtype=np.float64)
    seen = positions(times)
    seen = np.clip(seen + random.normal(0.0, noise, seen.shape), low, high)
    tracks: list[Doubles] = []
    for ball in range(seen.shape[1]):
        # a row once the ball is far enough from the last one, and the last of all
        rows_recorded = [0]
        for k in range(1, len(times)):
            if np.hypot(*(seen[k, ball] - seen[rows_recorded[-1], ball])) >= thin:
                rows_recorded.append(k)
        if rows_recorded[-1] != len(times) - 1:
            rows_recorded.append(len(times) - 1)
        tracks.append(np.column_stack([times[rows_recorded], seen[rows_recorded, ball]]))
    return tuple(tracks)


def synthetic(
    shots: int,
    *,
    table: tuple[float, float] = (2.84, 1.42),
    radius: float = 0.03075,
    cushion_model: ShotCushion = "smooth",
    constants: Mapping[str, float] | None = None,
    speeds: tuple[float, float] = (1.5, 5.0),
    noise: float = NOISE,
    rate: float = 50.0,
    thin: float = 0.016,
    seed: Seed = 0,
) -> Synthetic:
    """Simulate shots of three balls with random strikes, and record them like a camera.

    `table` contains the extents of x and y, and `radius` is the radius of the balls, m. `constants`
    are the constants of `carom.fit`, by default the usual ones. `speeds` are the lowest and the
    highest speed of a strike, m/s. The camera records `rate` frames per second with a standard
    deviation of `noise`, m, in each coordinate; a row is kept once the ball is `thin` m from the
    last kept row. The same seed returns the same recordings.
    """
    whole(shots, "shots")
    random = np.random.default_rng(seed_of(seed, 2**64 - 1))
    values, model = _constants.complete({} if constants is None else constants, cushion_model)
    radius, noise, rate, thin = (
        number(radius, "radius"),
        number(noise, "noise"),
        number(rate, "rate"),
        number(thin, "thin"),
    )
    for name, value, unit in (("radius", radius, "m"), ("rate", rate, "pictures a second")):
        if not 0.0 < value < np.inf:
            raise ValueError(f"{name}: {value:g} {unit} is not positive and finite")
    for name, pair, least, what in (
        ("table", table, 6.0 * radius, "six times the radius, "),
        ("speeds", speeds, 0.0, ""),
    ):
        pair_values = as_array(pair, name, np.float64)
        if (
            pair_values.shape != (2,)
            or not (np.isfinite(pair_values) & (pair_values > least)).all()
            or (name == "speeds" and pair_values[0] > pair_values[1])
        ):
            raise ValueError(f"{name}: {pair!r} are not two finite numbers above {what}{least:g}")
    for name, value in (("noise", noise), ("thin", thin)):
        if not 0.0 <= value < np.inf:
            raise ValueError(f"{name}: {value:g} m is not finite and at least 0")
    world = _constants.sloped(_constants.rectangle(table, values["nose_height"]), values)
    low, high = radius, np.array(table) - radius
    recordings: list[Recording] = []
    shots_played: list[Shot] = []
    strikes: list[Doubles] = []
    for index in range(shots):
        # positions clear of each other and of the cushions
        while True:
            centres = random.uniform(2.0 * low, high - radius, (3, 2))
            gaps = np.hypot(*(centres[[0, 0, 1]] - centres[[1, 2, 2]]).T)
            if gaps.min() > 4.0 * radius:
                break
        # towards the second ball or thereabouts, with spins that a cue can give
        speed = random.uniform(*speeds)
        direction = centres[1] - centres[0]
        angle = np.arctan2(direction[1], direction[0]) + random.normal(
            0.0, 1.2 * radius / np.hypot(*direction)
        )
        way = np.array([np.cos(angle), np.sin(angle)])
        follow, side = random.uniform(-0.5, 0.9) * speed, random.uniform(-1.0, 1.0) * speed
        start = random.uniform(0.0, 1.0 / rate)
        strike = np.array([*(speed * way), -way[1] * follow, way[0] * follow, side, start])
        # the shot, its clock beginning at the strike
        balls = _constants.layout(centres, radius, values)
        balls["state"]["v"][0, :2], balls["state"]["w"][0] = strike[:2], strike[2:5] / radius
        shot = simulate(world, balls, cushion_model=model)
        tracks = _record(
            lambda times, shot=shot, start=start: shot.positions(np.maximum(times - start, 0.0))[
                ..., :2
            ],  # type: ignore[misc]
            start + shot.time + 0.5,
            rate,
            thin,
            low,
            high,
            noise,
            random,
        )
        recordings.append(Recording(index + 1, (1, 2, 3), tracks))
        shots_played.append(shot)
        strikes.append(strike)
    return Synthetic(recordings, shots_played, np.array(strikes).reshape(-1, 6), values)
