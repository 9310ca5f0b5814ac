"""The options of shots by their names; `_described` lists them."""

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
from carom._rows import (
    cached,
    choice,
    named,
    number,
    numbered,
    several,
    unknown_name,
    whole,
    worded,
)

Friction = BallFriction
_WORDS = {name: worded(kind) for name, kind in WORDS.items()}
# CAROM_STOP_AT_CONTACT, and CAROM_STOP_AT() of the values of carom_event_type.
_STOPS = {"contact": 0, **numbered("carom_event_type")}


def _known(changes: Any) -> Any:
    """Return the options; raise an error for an unknown name."""
    unknown = changes.keys() - set(ShotOptions._fields)
    if unknown:
        raise TypeError(unknown_name("options", "option", min(unknown), ShotOptions._fields))
    return changes


class Options(ShotOptions):
    __slots__ = ()

    if not TYPE_CHECKING:

        def __new__(cls, *values, **named):
            options = super().__new__(cls, *values, **_known(named)).changed({})
            shot_options(options)  # raises errors now, not when a shot is played
            return options

    def __repr__(self) -> str:
        """The options that differ from the defaults, which keeps signatures short."""
        others = [
            f"{name}={value!r}"
            for name, value in zip(self._fields, self, strict=True)
            if value != self._field_defaults[name]
        ]
        return f"Options({', '.join(others)})"

    def changed(self, changes: Any) -> Options:
        """A copy of these options with some changed, by name."""
        options = self._replace(**_known(changes))
        other_words: Any = {
            name: named(words, value, name)
            for name, words in _WORDS.items()
            if not (isinstance(value := getattr(options, name), str) and value in words)
        }
        options = options._replace(**other_words)
        if not isinstance(options.first_of, (int, tuple)):
            balls = several(options.first_of, "first_of", "the index of a ball, or a list of them")
            options = options._replace(
                first_of=tuple(whole(ball, "first_of", most=31) for ball in balls)
            )
        if not isinstance(options.stop_at, (str, tuple)):
            options = options._replace(
                stop_at=tuple(
                    several(options.stop_at, "stop_at", "the name of an event, or a list of them")
                )
            )
        return options


Options.__doc__ = ShotOptions.__doc__
Options.__signature__ = inspect.signature(ShotOptions)  # type: ignore[attr-defined]


def chosen(options: object, changes: Any) -> Options:
    """The argument `options` with single options applied; raises TypeError if it is no Options."""
    if not isinstance(options, Options):
        raise TypeError(
            f"options: {reprlib.repr(options)} is not a carom.Options; pass carom.Options(world='pooltool'), "
            "or single options as keywords: world='pooltool'"
        )
    return options.changed(changes) if changes else options


@cached
def shot_options(options: Options, threads: int = 0) -> Any:
    """The options of C, which are read-only."""
    t_final, stop_at, first_of = options.t_final, options.stop_at, options.first_of
    if (
        t_final is not None
        and not 0.0 < (t_final := number(t_final, "t_final", "a time in s or None")) < np.inf
    ):
        raise ValueError(
            f"t_final: {t_final:g} s is not positive and finite; pass a time in s, or None"
        )
    stops = (stop_at,) if isinstance(stop_at, str) else tuple(stop_at)
    balls = (first_of,) if isinstance(first_of, int) else tuple(first_of)
    values = {name: choice(words, getattr(options, name), name) for name, words in _WORDS.items()}
    counts = {name: whole(getattr(options, name), name, most=most) for name, most in COUNTS.items()}
    sets = {
        "stop_at": sum({1 << choice(_STOPS, stop, "stop_at") for stop in stops}),
        "first_of": sum({1 << whole(ball, "first_of", most=31) for ball in balls}),
    }
    return ffi.new(
        "carom_shot_options *",
        {
            **values,
            **counts,
            **sets,
            "threads": whole(threads, "threads", least=-1),
            "time_most": t_final or 0.0,
        },
    )


def options_of(record: Any) -> Options:
    """Options of C as `Options`; `threads` is ignored."""
    values: dict[str, Any] = {
        name: next(word for word, value in known.items() if value == getattr(record, name))
        for name, known in _WORDS.items()
    }
    values |= {name: getattr(record, name) for name in COUNTS}
    values["stop_at"] = tuple(word for word, bit in _STOPS.items() if record.stop_at >> bit & 1)
    values["first_of"] = tuple(ball for ball in range(32) if record.first_of >> ball & 1)
    return Options(**values, t_final=record.time_most or None)
