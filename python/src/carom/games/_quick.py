"""A stroke of pool found by geometry and a few shots: an opponent that takes a millisecond.

The candidates are strokes at ghost balls, the positions of the cue ball at which it drives a ball
straight into a pocket. Each pair of a legal object ball and a pocket has a cut c, a path d of the
cue ball to the ghost ball, and a path p of the object ball to the pocket. On the way to the pocket
an error of the direction grows with d p / cos(c), so the pairs are ranked by

    ease = cos(c) / (d p).

Friction throws a ball towards the cue ball's path by about 2 degrees for cuts of 20 to 60 degrees
(docs/understanding/physics.md). Each pair is therefore aimed at with and without this throw, at two
speeds: four candidates. A cue ball in hand is placed DISTANCE behind the ghost ball, on the line to
the pocket, if that position is free.

Each candidate is played once without errors and judged by the rules. The best one is the stroke, or
the first of several equal ones. Neither the next layout nor errors are considered.

`carom.games.pool` imports this module, so `Pool` and `Position` have no types here.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from carom import dtypes
from carom._rows import Array, raw
from carom.dtypes import Doubles, Records
from carom.games.rules import Made, calls_of, judge, on_of
from carom.layouts import cue as cue_of

DISTANCE = 0.35  # m
THROWN = np.radians([0.0, 2.0])
SPEEDS = np.array([2.0, 3.5])  # m/s, of the cue, and more for long ways
OF_PAIR = len(THROWN) * len(SPEEDS)
BREAK = 9.0  # m/s
_LEAST_COS = np.cos(np.radians(75.0))  # of a cut


def quick_stroke(pool: Any, position: Any, shots: int) -> tuple[Records, Records, tuple[int, int]]:
    """The layout with the placed cue ball, the cue, and the call for eight-ball."""
    game = Made(pool.game, position.state)
    layouts, cues = _candidates(pool, position, game, max(shots // OF_PAIR, 1))
    played = pool.played(layouts, cues)
    calls = calls_of(game, position.balls, played) if pool.game == "eightball" else None
    best = int(pool.worth(judge(game, layouts, played, calls=calls)).argmax())
    call = (-1, -1) if calls is None else (int(calls[best, 0]), int(calls[best, 1]))
    return layouts[best], cues[best], call


def _candidates(pool: Any, position: Any, game: Made, pairs: int) -> tuple[Records, Records]:
    """Layouts (n, balls) and cues (n,) for the easiest pairs of a ball and a pocket."""
    balls, radius = position.balls, pool.base.radius
    centres = balls["state"]["r"][:, :2]
    targets = np.array(on_of(game, balls))
    if position.state["opening"]:
        return _break(pool, position, centres[targets])

    # of each pair: the way of the ball to the pocket, and the ghost ball
    way = pool.table.pockets["centre"] - centres[targets][:, np.newaxis]
    far = np.linalg.norm(way, axis=-1).ravel()
    way = way.reshape(-1, 2) / far[:, np.newaxis]
    ghost = np.repeat(centres[targets], len(pool.table.pockets), axis=0) - 2.0 * radius * way
    if position.hand:
        places = np.clip(ghost - DISTANCE * way, *pool.area(position.hand))
    else:
        places = np.broadcast_to(centres[0], ghost.shape)
    line = ghost - places
    distances = np.linalg.norm(line, axis=-1)
    cosine = np.einsum("ij,ij->i", line, way) / distances
    ease = np.where(cosine > _LEAST_COS, cosine, 1e-3 * (2.0 + cosine)) / (distances * far)

    # the easiest of them, from free positions
    chosen = np.argsort(-ease, kind="stable")[:pairs]
    way, ghost, far = way[chosen], ghost[chosen], far[chosen]
    places = _free(pool, position, places[chosen])
    line = ghost - places
    distances = np.linalg.norm(line, axis=-1)

    # to compensate for throw, the ghost ball moves to the side
    side = np.sign(line[:, 0] * way[:, 1] - line[:, 1] * way[:, 0])
    cos, sin = np.cos(THROWN), side[:, np.newaxis] * np.sin(THROWN)
    x, y = way[:, :1], way[:, 1:]
    turned = np.stack([x * cos - y * sin, x * sin + y * cos], axis=-1)
    aim = (line + 2.0 * radius * way)[:, np.newaxis] - 2.0 * radius * turned
    phi = np.degrees(np.arctan2(aim[..., 1], aim[..., 0]))[..., np.newaxis]
    longer = 0.7 + 0.3 * (distances + far)[:, np.newaxis, np.newaxis]
    phi, speed = np.broadcast_arrays(phi, np.minimum(SPEEDS * longer, pool.base.speeds[1]))
    layouts = _laid(pool, position, np.repeat(places, OF_PAIR, axis=0))
    return layouts, cue_of(speed=speed.ravel(), phi=phi.ravel(), b=0.0)


def _break(pool: Any, position: Any, targets: Doubles) -> tuple[Records, Records]:
    """A break at the first ball of the rack, from behind the head string."""
    low, high = pool.area(position.hand)
    place = np.array([(low[0] + high[0]) / 2.0, high[1]])
    line = targets[np.argmin(targets[:, 1])] - place
    phi = np.degrees(np.arctan2(line[1], line[0]))
    speed = min(BREAK, pool.base.speeds[1])
    return _laid(pool, position, place[np.newaxis]), cue_of(speed=[speed], phi=[phi], b=0.0)


def _free(pool: Any, position: Any, point: Doubles) -> Doubles:
    """The positions for a cue ball in hand, with occupied ones replaced."""
    if not position.hand:
        return point
    tried: Array = position.balls.copy()
    draws = position.draws.copy()
    for place in point:
        pool.lay(tried, place)
        if not pool.base.free(tried):
            pool.put(tried, position.hand, np.zeros(2), draws)
            place[...] = tried["state"]["r"][0, :2]
    return point


def _laid(pool: Any, position: Any, places: Doubles) -> Records:
    """The layout with the cue ball at each of several positions, if it is in hand."""
    layouts: Array = np.repeat(raw(position.balls)[np.newaxis], len(places), axis=0)
    layouts = layouts.view(dtypes.shot_ball)
    if position.hand:
        pool.lay(layouts, places)
    return layouts
