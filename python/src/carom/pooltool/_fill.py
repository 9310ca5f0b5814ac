"""Writes a shot into a System of pooltool: events with their agents, states, histories, pockets.

Most of the time would be spent on objects that are never used: for a nine-ball break about 1,000
states in histories and 250 balls in agents, and ten times as many states in continuous histories.
They are therefore created on first access in C (`carom._objects`): all states of a history, and the
balls of all agents, at once. Until then histories and agents are instances of a subclass that
stores the function that creates them; afterwards they are instances of pooltool's classes.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from carom._objects import make, turn
from carom.dtypes import Doubles, Records
from carom.results import EventType, Shot

_events: Any = importlib.import_module("pooltool.events")
_balls: Any = importlib.import_module("pooltool.objects.ball.datatypes")
_PoolType = _events.EventType
_BallHistory: Any = _balls.BallHistory
_Agent: Any = _events.Agent
_BALL: Any = _events.AgentType.BALL
_CUE: Any = _events.AgentType.CUE
_POCKET_AGENT: Any = _events.AgentType.POCKET
_LINEAR: Any = _events.AgentType.LINEAR_CUSHION_SEGMENT
_CIRCULAR: Any = _events.AgentType.CIRCULAR_CUSHION_SEGMENT
_OWN_FIELDS = (
    "id",
    "params",
    "ballset",
    "initial_orientation",
)  # of a ball: the same in every state

# As plain numbers, which compare ten times as fast.
_STRIKE, _BALL_BALL = int(EventType.STRIKE), int(EventType.BALL_BALL)
_RAIL, _JAW, _POCKET = int(EventType.RAIL), int(EventType.JAW), int(EventType.POCKET)
_TYPES: dict[int, Any] = {
    EventType.STRIKE: _PoolType.STICK_BALL,
    EventType.BALL_BALL: _PoolType.BALL_BALL,
    EventType.RAIL: _PoolType.BALL_LINEAR_CUSHION,
    EventType.JAW: _PoolType.BALL_CIRCULAR_CUSHION,
    EventType.POCKET: _PoolType.BALL_POCKET,
    **{
        EventType[name]: getattr(_PoolType, name)
        for name in (
            "SLIDING_ROLLING",
            "ROLLING_SPINNING",
            "ROLLING_STATIONARY",
            "SPINNING_STATIONARY",
        )
    },
}


# ---- Created on first access
# ------------------------------------------------------------------------------------------

_states_of: Any = _BallHistory.__dict__["states"]
_BALL_FIELDS = [
    _balls.Ball.__dict__[name] for name in ("history", "history_cts", "state")
]  # to set, without attrs' setters
_time_of = _balls.BallState.__dict__["t"]
_id_of, _type_of, _initial_of, _final_of = (
    _Agent.__dict__[name] for name in ("id", "agent_type", "initial", "final")
)


class _LaterHistory(_BallHistory):  # type: ignore[misc]
    """A BallHistory whose states are created on first access by a stored function; without a
    function it is empty.
    """

    __slots__ = ()
    __qualname__ = "BallHistory"  # for repr()

    @property
    def states(self) -> Any:
        """The states; on first access this object becomes a BallHistory."""
        try:
            states: Callable[[], list[Any]] = _states_of.__get__(self)
        except AttributeError:
            states = list
        values = states()
        self.states = values
        return values

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
    """An Agent whose balls are created on first access by the function stored as its initial state.

    The function creates the balls of all agents of the shot, which become Agents.
    """

    __slots__ = ()
    __qualname__ = "Agent"  # for repr()

    def _settle(self) -> None:
        """Become an Agent."""
        try:
            settle: Callable[[], None] = _initial_of.__get__(self)
        except AttributeError:
            self.__class__ = _Agent  # a copy in progress, whose fields follow
        else:
            settle()

    def _field(slot: Any) -> Any:
        """The ball before or after the event; on first access this object becomes an Agent."""

        def get(self: Any) -> Any:
            self._settle()
            return slot.__get__(self)

        def put(self: Any, value: Any) -> None:
            self._settle()
            slot.__set__(self, value)

        return property(get, put)

    initial, final = _field(_initial_of), _field(_final_of)

    def __eq__(self, other: object) -> bool:
        self._settle()
        return bool(self == other)

    def __reduce_ex__(self, protocol: Any) -> Any:
        self._settle()
        return self.__reduce_ex__(protocol)

    __hash__ = None  # type: ignore[assignment]


def _later_history(states: Callable[[], list[Any]]) -> Any:
    history = _LaterHistory.__new__(_LaterHistory)
    _states_of.__set__(history, states)
    return history


# ---- States
# ------------------------------------------------------------------------------------------------------------


def after_each_event(shot: Shot) -> Records:
    """The states of all balls just after each event, (events, balls)."""
    events = shot.events
    times, pair = events["time"], events["type"] == _BALL_BALL
    states = shot.states(times)
    each = np.arange(len(events))
    states[each, events["a"]] = events["after"][:, 0]
    states[each[pair], events["b"][pair]] = events["after"][pair, 1]
    # A state at a time is the state after all events at that time. Here simultaneous events are
    # separated, the last one first.
    for k in np.flatnonzero(times[1:] == times[:-1])[::-1]:
        states[k] = states[k + 1]
        for side in range(1 + int(pair[k + 1])):
            states[k, events[k + 1][("a", "b")[side]]] = events[k + 1]["before"][side]
    return states


def _rvw(states: Records) -> Doubles:
    """Copies of r, v, w in pooltool's form, (..., 3, 3)."""
    rvw = np.empty((*states.shape, 3, 3))
    for k, name in enumerate("rvw"):
        rvw[..., k, :] = states[name]
    return rvw


def _states(rvws: Doubles, labels: list[int], times: list[float]) -> list[Any]:
    """States of pooltool from an array (n, 3, 3)."""
    states: list[Any] = make(
        _balls.BallState, len(labels), ("rvw", "s", "t"), (list(rvws), labels, times)
    )
    return states


class _Histories:
    """The states of all balls between the first and the last time, computed once for all histories."""

    def __init__(self, look: Callable[[], tuple[Records, Doubles]]) -> None:
        self.look = look

    @functools.cached_property
    def _all(self) -> tuple[Doubles, list[list[int]], list[float]]:
        states, times = self.look()
        of_ball = np.swapaxes(states, 0, 1)
        return _rvw(of_ball), of_ball["label"].tolist(), times.tolist()

    def history(self, index: int, first: list[Any], last: list[Any]) -> list[Any]:
        """The states of one ball."""
        rvws, labels, times = self._all
        return [*first, *_states(rvws[index], labels[index], times), *last]


# ---- Events
# ------------------------------------------------------------------------------------------------------------


class _Filler:
    """Converts the events of a shot to pooltool's."""

    def __init__(self, system: Any, events: Records) -> None:
        self.system = system
        self.events = events
        self.balls = list(system.balls.values())
        self.linear = list(system.table.cushion_segments.linear.values())
        self.circular = list(system.table.cushion_segments.circular.values())
        self.pockets = list(system.table.pockets.values())
        # The balls of agents: the first of each event, then the second where there is one. Event k
        # has rows 2 k and 2 k + 1.
        self.types, self.others, first = (
            events["type"].tolist(),
            events["b"].tolist(),
            events["a"].tolist(),
        )
        pairs = [k for k, kind in enumerate(self.types) if kind == _BALL_BALL]
        self.rows = [*range(0, 2 * len(first), 2), *(2 * k + 1 for k in pairs)]
        self.numbers = [*first, *(self.others[k] for k in pairs)]
        ids = [self.balls[number].id for number in self.numbers]
        self.agents = make(
            _Agent, len(ids), ("id", "agent_type", "initial"), (ids, _BALL, self.settle)
        )
        turn(self.agents, _LaterAgent, (), ())

    def settle(self) -> None:
        """Set the balls of all agents before and after their events, without histories."""
        n, when = len(self.agents), self.events["time"][np.array(self.rows) // 2].tolist()
        owners = [self.balls[number] for number in self.numbers]
        fields = [[getattr(ball, field) for ball in owners] for field in _OWN_FIELDS]
        columns = []
        for side in ("before", "after"):
            states = self.events[side]
            rvws, labels = (
                _rvw(states).reshape(-1, 3, 3)[self.rows],
                states["label"].ravel()[self.rows].tolist(),
            )
            empty, empty_cts = (make(_LaterHistory, n, (), ()) for _ in range(2))
            values = (*fields, _states(rvws, labels, when), empty, empty_cts)
            columns.append(
                make(_balls.Ball, n, (*_OWN_FIELDS, "state", "history", "history_cts"), values)
            )
        turn(self.agents, _Agent, ("initial", "final"), tuple(columns))

    def happened(self) -> list[Any]:
        """The events with their agents; balls are added to their pockets."""
        seconds = iter(self.agents[len(self.types) :])
        agents: list[tuple[Any, ...]] = []
        for kind, a, b, ball in zip(
            self.types, self.numbers, self.others, self.agents, strict=False
        ):
            if kind == _BALL_BALL:
                # A pair is named in the order of the System, as pooltool names it.
                second = next(seconds)
                agents.append((ball, second) if a < b else (second, ball))
            elif kind == _STRIKE:
                cue = self.system.cue
                agents.append((_Agent(cue.id, _CUE, cue.copy()), ball))
            elif kind == _RAIL:
                agents.append((ball, _Agent(self.linear[b].id, _LINEAR, self.linear[b].copy())))
            elif kind == _JAW:
                agents.append(
                    (ball, _Agent(self.circular[b].id, _CIRCULAR, self.circular[b].copy()))
                )
            elif kind == _POCKET:
                pocket = self.pockets[b]
                empty = pocket.copy()
                pocket.add(self.balls[a].id)
                agents.append((ball, _Agent(pocket.id, _POCKET_AGENT, empty, pocket.copy())))
            else:
                agents.append((ball,))
        columns = ([_TYPES[kind] for kind in self.types], agents, self.events["time"].tolist())
        events: list[Any] = make(
            _events.Event, len(agents), ("event_type", "agents", "time"), columns
        )
        return events


def fill(system: Any, shot: Shot, retained: int, stopped: bool, dt: float | None) -> None:
    """Write the first `kept` events of a shot into the System.

    With `stopped` its balls are stopped, as for max_events. With `dt` it receives the continuous
    histories of pooltool's `continuize`, one state per dt.
    """
    events = shot.events[:retained]
    filler = _Filler(system, events)
    happened = filler.happened()
    end: float = happened[-1].time if happened else 0.0
    system.events = [_events.null_event(time=0), *happened, _events.null_event(time=end)]
    system.t = end
    final = shot.final if retained == shot.count else after_each_event(shot)[retained - 1]
    lasts = (
        _states(_rvw(final), final["label"].tolist(), [end] * len(final))
        if retained
        else [b.state for b in filler.balls]
    )
    histories = _Histories(
        lambda: (after_each_event(shot)[: retained - 1], events["time"][: retained - 1])
    )
    continuous = None
    if dt is not None:
        # pooltool adds up its steps.
        times = np.add.accumulate(np.full(int(end // dt), dt))
        continuous = _Histories(lambda: (shot.states(times), times))
    for index, ball in enumerate(filler.balls):
        # The last state is the ball's final one, and occurs twice: after the last event and at the end.
        first, last = ball.state, lasts[index]
        _time_of.__set__(first, 0.0)
        history = _later_history(
            functools.partial(
                histories.history, index, [first], [last, last] if retained else [last]
            )
        )
        values = (
            list
            if continuous is None
            else functools.partial(continuous.history, index, [first], [last])
        )
        for slot, value in zip(_BALL_FIELDS, (history, _later_history(values), last), strict=True):
            slot.__set__(ball, value)
    if stopped:
        system.stop_balls()
