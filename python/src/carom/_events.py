"""The first event of a kind in each shot of a batch, and what was potted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes
from carom._described import EventType, Label
from carom._rows import Array, Arrays, as_array, choice, whole
from carom.dtypes import Doubles, Records

_TYPES = {kind.name.lower(): kind.value for kind in EventType}


@dataclass(frozen=True, repr=False)
class FirstEvents(Arrays):
    """The first event of a kind in each shot; arrays of the shape of the batch."""

    index: NDArray[np.int64]
    """The event's index in the shot's events; -1 where there is none."""
    time: Doubles
    """s; NaN where there is none."""
    other: NDArray[np.int32]
    """What the ball met: the index of a ball, or of a part of the table; -1 where there is none."""
    before: Records
    """The state of the ball just before the event: `carom.dtypes.ball_state`. Numbers are NaN, and
    the label -1, where there is none.
    """
    after: Records
    """Its state just after the event."""
    event: Records
    """The events: `carom.dtypes.event`."""


def _unknown(shape: tuple[int, ...], dtype: Any) -> Array:
    """Records whose numbers are NaN and whose whole numbers are -1."""
    records: Array = np.zeros(shape, dtype)

    def fill(part: Array) -> None:
        if part.dtype.names is None:
            part[...] = np.nan if part.dtype.kind == "f" else -1
            return
        for name in part.dtype.names:
            fill(part[name])

    fill(records)
    return records


def first_events(
    events: Records, counts: Array, kind: str, ball: int | None, earliest: ArrayLike, balls: int
) -> FirstEvents:
    """The first event of a kind in each row of events, of which `counts` happened in each shot."""
    number = choice(_TYPES, kind, "kind")
    if events.dtype != dtypes.event:
        raise ValueError('events: they are brief; first() needs simulate_batch(records="full")')
    shape, room = events.shape[:-1], events.shape[-1]
    moment = np.broadcast_to(as_array(earliest, "after", np.float64), shape)
    valid: NDArray[np.int64] = np.minimum(counts, room)
    is_match = (np.arange(room) < valid[..., np.newaxis]) & (events["type"] == number)
    is_match &= events["time"] > moment[..., np.newaxis]
    if ball is not None:
        index = whole(ball, "ball", most=balls - 1)
        of_second = (events["b"] == index) & (number == EventType.BALL_BALL)
        is_match &= (events["a"] == index) | of_second
    found = is_match.any(axis=-1)
    if (~found & (counts > room)).any():
        raise ValueError(
            f"events: up to {int(counts.max())} happened in a shot, and {room} were kept; "
            f"first() needs all: simulate_batch(room={int(counts.max())})"
        )
    if room == 0:
        return _found_none(shape)
    places = is_match.argmax(axis=-1)
    event: Array = np.take_along_axis(events, places[..., np.newaxis], axis=-1)[..., 0]
    event = np.where(found, event, _unknown((), dtypes.event)).astype(dtypes.event)
    # Of a collision of two balls, the ball that was asked for is a or b.
    second = np.zeros(shape, np.bool_)
    if ball is not None and number == EventType.BALL_BALL:
        second = found & (event["b"] == ball)
    state_before, later = (
        np.where(second, event[side][..., 1], event[side][..., 0]).astype(dtypes.ball_state)
        for side in ("before", "after")
    )
    partner = np.where(second, event["a"], event["b"]).astype(np.int32)
    return FirstEvents(
        np.where(found, places, -1), event["time"], partner, state_before, later, event
    )


def _found_none(shape: tuple[int, ...]) -> FirstEvents:
    event, state = _unknown(shape, dtypes.event), _unknown(shape, dtypes.ball_state)
    none = np.full(shape, -1, np.int64)
    return FirstEvents(none, event["time"], event["b"], state, state.copy(), event)


def potted(layouts: Records, final: Records, ball: ArrayLike | None) -> NDArray[np.bool_]:
    """Which balls were on the table at the start and are in a pocket at the end."""
    states = layouts if layouts.dtype == dtypes.ball_state else layouts["state"]
    start = np.broadcast_to(states["label"], final.shape)
    down: NDArray[np.bool_] = (final["label"] == Label.POCKETED) & (start != Label.POCKETED)
    if ball is None:
        return down
    balls = as_array(ball, "ball")
    count = final.shape[-1]
    if balls.dtype.kind not in "iu" or not ((balls >= 0) & (balls < count)).all():
        raise ValueError(f"ball: indices from 0 to {count - 1} are required, not {ball!r}")
    chosen: NDArray[np.bool_] = np.asarray(down[..., balls])
    return chosen
