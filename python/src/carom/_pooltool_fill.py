"""Writes a shot into a System of pooltool's: events with their agents, states, histories, pockets.

Most of the time would go into objects that nobody looks at: for a nine-ball break some 1,000 states of histories and 250 balls of
agents. So histories and the balls of agents are made when they are first looked at. Until then they are of a subclass without
fields of its own, whose one field holds what makes them; then they become what pooltool's are, class and all.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from carom import dtypes
from carom.results import EventType, Shot

_events: Any = importlib.import_module("pooltool.events")
_balls: Any = importlib.import_module("pooltool.objects.ball.datatypes")
_PoolType = _events.EventType
_BallHistory: Any = _balls.BallHistory
_Agent: Any = _events.Agent
_BALL: Any = _events.AgentType.BALL
_CUE: Any = _events.AgentType.CUE
_POCKET: Any = _events.AgentType.POCKET
_LINEAR: Any = _events.AgentType.LINEAR_CUSHION_SEGMENT
_CIRCULAR: Any = _events.AgentType.CIRCULAR_CUSHION_SEGMENT

_TYPES: dict[int, Any] = {
    EventType.STRIKE: _PoolType.STICK_BALL,
    EventType.BALL_BALL: _PoolType.BALL_BALL,
    EventType.RAIL: _PoolType.BALL_LINEAR_CUSHION,
    EventType.JAW: _PoolType.BALL_CIRCULAR_CUSHION,
    EventType.POCKET: _PoolType.BALL_POCKET,
    EventType.SLIDING_ROLLING: _PoolType.SLIDING_ROLLING,
    EventType.ROLLING_SPINNING: _PoolType.ROLLING_SPINNING,
    EventType.ROLLING_STATIONARY: _PoolType.ROLLING_STATIONARY,
    EventType.SPINNING_STATIONARY: _PoolType.SPINNING_STATIONARY,
}


# ---- Made when first looked at ------------------------------------------------------------------------------------------

_states_of: Any = _BallHistory.__dict__["states"]
_id_of, _type_of, _initial_of, _final_of = (_Agent.__dict__[name] for name in ("id", "agent_type", "initial", "final"))


class _LaterHistory(_BallHistory):  # type: ignore[misc]
    """A BallHistory whose states are made when they are first looked at, from the function in their place."""

    __slots__ = ()

    @property
    def states(self) -> Any:
        """The states; from now on this is a BallHistory."""
        make: Callable[[], list[Any]] = _states_of.__get__(self)
        made = make()
        self.states = made
        return made

    @states.setter
    def states(self, value: Any) -> None:
        _states_of.__set__(self, value)
        self.__class__ = _BallHistory

    def __eq__(self, other: object) -> bool:
        _ = self.states
        return bool(self == other)

    def __reduce_ex__(self, protocol: Any) -> Any:
        _ = self.states
        return self.__reduce_ex__(protocol)

    __hash__ = None  # type: ignore[assignment]


class _LaterAgent(_Agent):  # type: ignore[misc]
    """An Agent whose ball is made when it is first looked at, from the function in the place of its initial state."""

    __slots__ = ()

    def _settle(self) -> None:
        """Becomes an Agent."""
        make: Callable[[], list[Any]] | None = None
        try:
            make = _initial_of.__get__(self)
        except AttributeError:
            pass  # a copy on its way, whose fields come next
        self.__class__ = _Agent
        if make is not None:
            initial, final = make()
            _initial_of.__set__(self, initial)
            _final_of.__set__(self, final)

    @property
    def initial(self) -> Any:
        """The ball before the event."""
        self._settle()
        return _initial_of.__get__(self)

    @initial.setter
    def initial(self, value: Any) -> None:
        self._settle()
        _initial_of.__set__(self, value)

    @property
    def final(self) -> Any:
        """The ball after the event."""
        self._settle()
        return _final_of.__get__(self)

    @final.setter
    def final(self, value: Any) -> None:
        self._settle()
        _final_of.__set__(self, value)

    def __eq__(self, other: object) -> bool:
        self._settle()
        return bool(self == other)

    def __reduce_ex__(self, protocol: Any) -> Any:
        self._settle()
        return self.__reduce_ex__(protocol)

    __hash__ = None  # type: ignore[assignment]


def _later_history(make: Callable[[], list[Any]]) -> Any:
    history = _LaterHistory.__new__(_LaterHistory)
    _states_of.__set__(history, make)
    return history


# ---- States ------------------------------------------------------------------------------------------------------------


def after_each_event(shot: Shot) -> dtypes.Records:
    """The states of all balls just after each event, (events, balls)."""
    events = shot.events
    times = events["time"]
    states = shot.states(times)
    # A state at a time is that after everything of the time: events at the same instant are taken apart here.
    for k in range(len(events) - 1, -1, -1):
        event = events[k]
        for side in range(2 if event["type"] == EventType.BALL_BALL else 1):
            ball = event["b"] if side else event["a"]
            states[k, ball] = event["after"][side]
            earlier = k - 1
            while earlier >= 0 and times[earlier] == times[k]:
                states[earlier, ball] = event["before"][side]
                earlier -= 1
    return states


def _rvw(states: dtypes.Records) -> dtypes.Doubles:
    """Copies of r, v, w as pooltool has them, (..., 3, 3)."""
    return np.stack([states["r"], states["v"], states["w"]], axis=-2)


class _Histories:
    """The states of all balls after each event that is kept, computed once for all balls."""

    def __init__(self, shot: Shot, kept: int) -> None:
        self.shot = shot
        self.kept = kept

    @functools.cached_property
    def _all(self) -> tuple[dtypes.Doubles, list[list[int]], list[float]]:
        states = after_each_event(self.shot)[: self.kept]
        return _rvw(states), states["label"].tolist(), self.shot.events["time"][: self.kept].tolist()

    def of(self, index: int, first: Any, last: Any) -> list[Any]:
        """The history of one ball: before the shot, after each event, and the last state once more for the end."""
        rvws, labels, times = self._all
        between = [_balls.BallState(rvws[k, index], labels[k][index], times[k]) for k in range(self.kept - 1)]
        return [first, *between, *([last] if self.kept else []), last]


# ---- Events ------------------------------------------------------------------------------------------------------------


class _Filler:
    """Makes pooltool's events from those of a shot."""

    def __init__(self, system: Any, events: dtypes.Records) -> None:
        self.system = system
        self.events = events
        self.balls = list(system.balls.values())
        self.kinds = [(ball.id, ball.params, ball.ballset, ball.initial_orientation) for ball in self.balls]
        self.linear = list(system.table.cushion_segments.linear.values())
        self.circular = list(system.table.cushion_segments.circular.values())
        self.pockets = list(system.table.pockets.values())

    @functools.cached_property
    def _states(self) -> list[tuple[dtypes.Doubles, list[list[int]]]]:
        """r, v, w and labels before and after each event, of both its balls."""
        return [(_rvw(self.events[when]), self.events[when]["label"].tolist()) for when in ("before", "after")]

    def before_and_after(self, index: int, k: int, side: int, time: float) -> list[Any]:
        """The ball before and after event k, in which it is the first or the second, without a history."""
        name, params, ballset, orientation = self.kinds[index]
        return [
            _balls.Ball(name, _balls.BallState(rvws[k, side], labels[k][side], time), params, ballset, orientation)
            for rvws, labels in self._states
        ]

    def _ball_agent(self, index: int, k: int, side: int, time: float) -> Any:
        agent = _LaterAgent.__new__(_LaterAgent)
        _id_of.__set__(agent, self.balls[index].id)
        _type_of.__set__(agent, _BALL)
        _initial_of.__set__(agent, functools.partial(self.before_and_after, index, k, side, time))
        return agent

    def event(self, k: int, time: float, kind: int, a: int, b: int) -> Any:
        """Event k with its agents; pockets take their balls."""
        if kind == EventType.BALL_BALL:
            # A pair is named in the order of the System, as pooltool names it.
            pair = (self._ball_agent(a, k, 0, time), self._ball_agent(b, k, 1, time))
            return _events.Event(_TYPES[kind], pair if a < b else pair[::-1], time)
        ball = self._ball_agent(a, k, 0, time)
        agents: tuple[Any, ...]
        if kind == EventType.STRIKE:
            cue = self.system.cue
            agents = (_Agent(cue.id, _CUE, cue.copy()), ball)
        elif kind == EventType.RAIL:
            agents = (ball, _Agent(self.linear[b].id, _LINEAR, self.linear[b].copy()))
        elif kind == EventType.JAW:
            agents = (ball, _Agent(self.circular[b].id, _CIRCULAR, self.circular[b].copy()))
        elif kind == EventType.POCKET:
            pocket = self.pockets[b]
            empty = pocket.copy()
            pocket.add(self.balls[a].id)
            agents = (ball, _Agent(pocket.id, _POCKET, empty, pocket.copy()))
        else:
            agents = (ball,)
        return _events.Event(_TYPES[kind], agents, time)


def fill(system: Any, shot: Shot, kept: int, stopped: bool) -> None:
    """Writes the first `kept` events of a shot into the System; `stopped`: its balls are then stopped, as max_events does."""
    events = shot.events[:kept]
    system.reset_history()
    filler = _Filler(system, events)
    numbers = (events["time"].tolist(), events["type"].tolist(), events["a"].tolist(), events["b"].tolist())
    happened = [filler.event(k, *of_event) for k, of_event in enumerate(zip(*numbers, strict=True))]
    end: float = happened[-1].time if happened else 0.0
    system.events = [_events.null_event(time=0), *happened, _events.null_event(time=end)]
    system.t = end
    final = shot.final if kept == shot.count else after_each_event(shot)[kept - 1]
    rvws, labels = _rvw(final), final["label"].tolist()
    histories = _Histories(shot, kept)
    for index, ball in enumerate(filler.balls):
        # The last state is the ball's own, and stands twice: after the last event and at the end.
        first = last = ball.state
        if kept:
            last = _balls.BallState(rvws[index].copy(), labels[index], end)
        ball.history = _later_history(functools.partial(histories.of, index, first, last))
        ball.state = last
    if stopped:
        system.stop_balls()
