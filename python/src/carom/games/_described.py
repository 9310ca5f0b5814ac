"""Enumerations of games, acts of a match, and its state. Written by bindings/match.py:
UPDATE=1 ctest -R bindings/rows.
"""

from __future__ import annotations

import enum
from collections.abc import Callable
from typing import Any, Literal, get_args

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import Choice, Phase
from carom._rows import choice, number, text_of
from carom.dtypes import Records

Group = Literal["open", "solids", "stripes"]
Race = Literal["own", "shared", "alone", "points", "seats"]
BreakOrder = Literal["alternate", "winner", "loser"]


class Foul(enum.IntEnum):
    """Why a shot is a foul. The first value that applies is reported, except that DOUBLE_HIT
    precedes CUSHION and BREAK.
    """

    NONE = 0
    CUE_BALL = 1
    NO_BALL = 2
    FIRST = 3
    OFF = 4
    CUSHION = 5
    BREAK = 6
    OTHER = 7
    POT = 8
    DOUBLE_HIT = 9
    JUMP = 10

    @property
    def text(self) -> str:
        """The description of a foul, such as "the cue ball met no ball"."""
        return text_of(lib.carom_word_text(lib.CAROM_WORDS_FOUL, self))


class Kind(enum.IntEnum):
    """The kind of a choice, which follows from what happens in the shot. The kind of a pot is the
    first of combination, carom, kiss, kick, rail first, bank and pot that applies, by approach and
    banked of carom_facts.
    """

    POT = 0
    SCAN = 1
    FOUL = 2
    GIVEN = 3
    PUSH = 4
    PASS = 5
    BREAK = 6
    BANK = 7
    KICK = 8
    COMBINATION = 9
    CAROM = 10
    SAFETY = 11
    KISS = 12
    RAIL_FIRST = 13

    @property
    def text(self) -> str:
        """The name of a kind, such as "bank"."""
        return text_of(lib.carom_word_text(lib.CAROM_WORDS_PLAN_KIND, self))


_PHASES: tuple[Phase, ...] = get_args(Phase)
_CHOICES: tuple[Choice, ...] = get_args(Choice)
_BITS: dict[str, int] = {word: 1 << k for k, word in enumerate(_CHOICES)}


class MatchActs:
    """The acts and the state of a match, as in carom_match.h.

    The seat that acts defaults to the one at the table.
    """

    _c: Any

    def _act(self, call: Callable[[], int], field: str) -> bool:
        raise NotImplementedError

    def _seat(self, seat: int | None) -> int:
        raise NotImplementedError

    @property
    def phase(self) -> Phase:
        """What the match waits for: "none", "stroke", "place", "moving", "over"."""
        return _PHASES[int(self._c.phase)]

    @property
    def player(self) -> int:
        """The side at the table: 0 or 1, or the seat in games where each seat plays for itself."""
        return int(self._c.record.player)

    @property
    def seat(self) -> int:
        """The seat at the table."""
        return int(self._c.seat)

    @property
    def actor(self) -> int | None:
        """The seat that acted last."""
        return int(self._c.record.actor) if self._c.record.actor >= 0 else None

    @property
    def winner(self) -> int | None:
        """The side that has won."""
        return int(self._c.winner) - 1 if 0 < self._c.winner < lib.CAROM_DRAWN else None

    @property
    def drawn(self) -> bool:
        """Whether the match is over without a winner."""
        return bool(self._c.winner == lib.CAROM_DRAWN)

    @property
    def shots(self) -> int:
        """Number of strokes and continuations so far."""
        return int(self._c.record.shots)

    @property
    def may(self) -> tuple[Choice, ...]:
        """The choices for `choose`. "free_ball" is named by a call, and with "place" the cue ball
        is in hand.
        """
        return tuple(word for k, word in enumerate(_CHOICES) if self._c.may >> k & 1)

    @property
    def cue_ball(self) -> int:
        """The ball that the player at the table strikes."""
        return int(self._c.cue_ball)

    @property
    def cue(self) -> Records:
        """The cue of the seat at the table, for the cue ball: aim it. Its stroke is the usual one
        of the game.
        """
        return np.frombuffer(ffi.buffer(ffi.addressof(self._c.cue)), dtypes.cue).copy().reshape(())

    @property
    def on(self) -> frozenset[int]:
        """The balls that may be met first in the next stroke."""
        return frozenset(k for k in range(32) if self._c.on >> k & 1)

    @property
    def touching(self) -> frozenset[int]:
        """The balls that touch the cue ball."""
        return frozenset(k for k in range(32) if self._c.touching >> k & 1)

    def next(self) -> None:
        """Begin the next match of the set, with the same seats."""
        self._act(
            lambda: lib.carom_match_next(self._c),
            "next",
        )

    def choose(self, what: str, *, seat: int | None = None) -> None:
        """Make one of the choices `may`. "push" applies to the next stroke; the others replace it.
        """
        self._act(
            lambda: lib.carom_match_choose(self._c, self._seat(seat), choice(_BITS, what, "what")),
            "choose",
        )

    def place(self, x: float, y: float, *, seat: int | None = None) -> None:
        """Place the cue ball in hand at a position within `bounds`, m. Until the stroke it may be
        placed again. The choice to leave it where it was is then no longer available.
        """
        self._act(
            lambda: lib.carom_match_place(self._c, self._seat(seat), number(x, "x"), number(y, "y")),
            "place",
        )

    def extend(self, seat: int | None = None) -> None:
        """Take an extension of the time for this stroke: the caller measures the time, and the
        match counts the extensions. The act is refused where none is left.
        """
        self._act(
            lambda: lib.carom_match_extend(self._c, self._seat(seat)),
            "extend",
        )

    def timeout(self, seat: int | None = None) -> None:
        """Take a timeout: the caller measures the time, and the match counts the timeouts. The act
        is refused where none is left.
        """
        self._act(
            lambda: lib.carom_match_timeout(self._c, self._seat(seat)),
            "timeout",
        )

    def concede(self, seat: int | None = None) -> None:
        """Concede the game to the other side. A seat that plays for itself leaves the game. Any
        seat may do this at any time.
        """
        self._act(
            lambda: lib.carom_match_concede(self._c, self._seat(seat)),
            "concede",
        )

    def clock(self, seat: int | None = None) -> None:
        """End the time of the player at the table: the match rules this as a stroke that met no
        ball, which is a foul.
        """
        self._act(
            lambda: lib.carom_match_clock(self._c, self._seat(seat)),
            "clock",
        )
