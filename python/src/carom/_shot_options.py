"""The options of whole shots, by their names: those of the rows, which `_described` has."""

from __future__ import annotations

import inspect
import reprlib
from typing import TYPE_CHECKING, Any

import numpy as np

from carom._carom import ffi
from carom._described import COUNTS, WORDS, BallFriction, ShotOptions
from carom._described import BallModel as BallModel
from carom._described import Changes as Changes
from carom._described import ShotCushion as ShotCushion
from carom._described import Simultaneous as Simultaneous
from carom._described import Space as Space
from carom._described import StopAt as StopAt
from carom._described import World as World
from carom._rows import cached, choice, number, numbered, several, whole, worded

Friction = BallFriction
_WORDS = {name: worded(kind) for name, kind in WORDS.items()}
# CAROM_STOP_AT_CONTACT, and CAROM_STOP_AT() of the values of carom_event_type.
_STOPS = {"contact": 0, **numbered("carom_event_type")}


def _known(changes: Any) -> Any:
    """Options by their names; another name is refused."""
    unknown = changes.keys() - set(ShotOptions._fields)
    if unknown:
        raise TypeError(
            f"options: there is no {min(unknown)!r}; known are {', '.join(ShotOptions._fields)}"
        )
    return changes


class Options(ShotOptions):
    __slots__ = ()

    if not TYPE_CHECKING:

        def __new__(cls, *values, **named):
            options = super().__new__(cls, *values, **_known(named)).changed({})
            shot_options(options)  # refuses what is wrong now, not when a shot is played
            return options

    def __repr__(self) -> str:
        """What differs from the defaults, which keeps signatures short."""
        others = [
            f"{name}={value!r}"
            for name, value in zip(self._fields, self, strict=True)
            if value != self._field_defaults[name]
        ]
        return f"Options({', '.join(others)})"

    def changed(self, changes: Any) -> Options:
        """These options except some, by their names."""
        options = self._replace(**_known(changes))
        if not isinstance(options.first_of, (int, tuple)):
            balls = several(
                options.first_of, "first_of", "the index of a ball is needed, or several"
            )
            options = options._replace(
                first_of=tuple(whole(ball, "first_of", most=31) for ball in balls)
            )
        if not isinstance(options.stop_at, (str, tuple)):
            options = options._replace(
                stop_at=tuple(
                    several(
                        options.stop_at, "stop_at", "the name of an event is needed, or several"
                    )
                )
            )
        return options


Options.__doc__ = ShotOptions.__doc__
Options.__signature__ = inspect.signature(ShotOptions)  # type: ignore[attr-defined]


def chosen(options: object, changes: Any) -> Options:
    """The argument `options` with single options; what is no Options is refused."""
    if not isinstance(options, Options):
        raise TypeError(
            f"options: a carom.Options is needed, such as carom.Options(world='pooltool'), not {reprlib.repr(options)}; "
            "single options are keywords of their own: world='pooltool'"
        )
    return options.changed(changes) if changes else options


@cached
def shot_options(options: Options, threads: int = 0) -> Any:
    """The options of C; they are never written to."""
    t_final, stop_at, first_of = options.t_final, options.stop_at, options.first_of
    if (
        t_final is not None
        and not 0.0
        < (t_final := number(t_final, "t_final", "a time in s is needed, or None"))
        < np.inf
    ):
        raise ValueError(f"t_final: it must be positive and finite, in s, or None, not {t_final:g}")
    stops = (stop_at,) if isinstance(stop_at, str) else tuple(stop_at)
    balls = (first_of,) if isinstance(first_of, int) else tuple(first_of)
    named = {name: choice(words, getattr(options, name), name) for name, words in _WORDS.items()}
    counts = {name: whole(getattr(options, name), name, most=most) for name, most in COUNTS.items()}
    sets = {
        "stop_at": sum({1 << choice(_STOPS, stop, "stop_at") for stop in stops}),
        "first_of": sum({1 << whole(ball, "first_of", most=31) for ball in balls}),
    }
    return ffi.new(
        "carom_shot_options *",
        {
            **named,
            **counts,
            **sets,
            "threads": whole(threads, "threads", least=-1),
            "time_most": t_final or 0.0,
        },
    )


def options_of(record: Any) -> Options:
    """Options of C as they are here; threads are not read."""
    values: dict[str, Any] = {
        name: next(word for word, value in known.items() if value == getattr(record, name))
        for name, known in _WORDS.items()
    }
    values |= {name: getattr(record, name) for name in COUNTS}
    values["stop_at"] = tuple(word for word, bit in _STOPS.items() if record.stop_at >> bit & 1)
    values["first_of"] = tuple(ball for ball in range(32) if record.first_of >> ball & 1)
    return Options(**values, t_final=record.time_most or None)
