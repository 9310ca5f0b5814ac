"""The options of whole shots, by their names."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import Any, Literal, NamedTuple

import numpy as np

from carom._carom import ffi
from carom._rows import choice, whole

World = Literal["carom", "pooltool"]
BallModel = Literal["default", "exact", "euler", "inelastic", "mirror"]
ShotCushion = Literal["default", "mathavan", "stronge", "han", "mirror", "euler"]
Friction = Literal["alciatore", "constant"]
Space = Literal["3d", "flat"]
StopAt = Literal[
    "contact",
    "strike",
    "ball_ball",
    "rail",
    "jaw",
    "pocket",
    "sliding_rolling",
    "rolling_spinning",
    "rolling_stationary",
    "spinning_stationary",
    "slate",
    "rail_top",
    "left_table",
]
_WORLDS = {"carom": 0, "pooltool": 1}
_BALL_MODELS = {"default": 0, "exact": 1, "euler": 2, "inelastic": 3, "mirror": 4}
_CUSHIONS = {"default": 0, "mathavan": 1, "stronge": 2, "han": 3, "mirror": 4, "euler": 5}
_FRICTIONS = {"alciatore": 0, "constant": 1}
_SPACES = {"3d": 0, "flat": 1}
# CAROM_STOP_AT_CONTACT, and CAROM_STOP_AT() of the values of carom_event_type.
_STOPS: dict[str, int] = {name: k for k, name in enumerate(StopAt.__args__)}  # type: ignore[attr-defined]


class Options(NamedTuple):
    """By what a shot was played: the arguments of `carom.simulate` of these names."""

    world: World = "carom"
    ball_model: BallModel = "default"
    cushion_model: ShotCushion = "default"
    friction: Friction = "alciatore"
    space: Space = "3d"
    steps: int = 0
    events_most: int = 0
    plain: bool = False
    t_final: float | None = None
    stop_at: StopAt | tuple[StopAt, ...] = ()


@functools.lru_cache(maxsize=256)
def shot_options(given: Options, threads: int = 0) -> Any:
    """The options of C; they are never written to."""
    world, ball_model, cushion_model, friction, space, steps, events_most, plain, t_final, stop_at = given
    if t_final is not None and not 0.0 < t_final < np.inf:
        raise ValueError(f"t_final: it must be positive and finite, in s, or None, not {t_final}")
    stops = (stop_at,) if isinstance(stop_at, str) else stop_at
    return ffi.new(
        "carom_shot_options *",
        {
            "world": choice(_WORLDS, world, "world"),
            "ball_model": choice(_BALL_MODELS, ball_model, "ball_model"),
            "cushion_model": choice(_CUSHIONS, cushion_model, "cushion_model"),
            "friction": choice(_FRICTIONS, friction, "friction"),
            "space": choice(_SPACES, space, "space"),
            "steps": whole(steps, "steps"),
            "events_most": whole(events_most, "events_most"),
            "time_most": 0.0 if t_final is None else t_final,
            "stop_at": sum({1 << choice(_STOPS, stop, "stop_at") for stop in stops}),
            "threads": whole(threads, "threads", least=-1),
            "plain": whole(plain, "plain", most=1),
        },
    )


def hashable(stop_at: StopAt | Iterable[StopAt]) -> StopAt | tuple[StopAt, ...]:
    """As `shot_options` takes it."""
    return stop_at if isinstance(stop_at, str) else tuple(stop_at)
