"""A match between two players, as `carom_match.h` has it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple, cast, get_args

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Seed, choice, copied, listing, number, pointer, seed_of, whole
from carom._shot_options import Options, StopAt, chosen, options_of, shot_options
from carom.dtypes import Records
from carom.games.plans import ByMatch, Kind, plan
from carom.games.rules import GivenState, Hand, Made, Rules, Ruling, of_set, ruling_of, words_of
from carom._described import Choice, Phase
from carom.games.rules import GAMES, LEAVES, Game, hand_of
from carom.layouts import Table, check_table, of_record, one_cue
from carom.layouts import cue as usual_cue
from carom.record import lines_of
from carom.results import Shot
from carom.shots import simulate
from carom.status import CaromError, Status

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes

__all__ = ["Bounds", "Match"]
__dir__ = listing(__name__)

_USUAL = Options()
_PHASES = get_args(Phase)
_CHOICES = get_args(Choice)
_OWN = 1000  # the number of a game of one's own in recordings


class Bounds(NamedTuple):
    """Where a cue ball in hand may be put, m: within `low` and `high`, and where `radius` is above
    0 also in the half circle around `centre`, the D.
    """

    low: tuple[float, float]
    high: tuple[float, float]
    centre: tuple[float, float]
    radius: float


class Match:
    """A game between two players: the table, the balls, the rules and the recording in one object,
    which takes one act after another.

    An act that the rules forbid raises `CaromError`, whose text says what would be right, and
    changes nothing. `lines` is the recording so far, which `carom verify` judges again.

    >>> match = carom.Match("eightball", carom.tables.pool_9ft(), seed=7)
    >>> while match.phase != "over":
    ...     best = match.plan(shots=100)[0]
    ...     match.take(best)
    """

    def __init__(
        self,
        rules: Game | Rules,
        table: Table,
        *,
        seed: Seed = 0,
        player: int = 0,
        balls: Records | None = None,
        state: GivenState | None = None,
        hand: Hand = "no",
        options: Options = _USUAL,
        **changes: Unpack[Changes],
    ) -> None:
        """Begin a match with the rack of a game, or with another layout.

        Parameters
        ----------
        rules : str or Rules
            The game, as for `carom.plan`; one of your own needs `balls`.
        table : Table
        seed : int
            Of the gaps of the rack, 0.1 mm at most.
        player : int
            Who plays first, 0 or 1.
        balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,), optional
            Another layout than the rack. Only then `hand` and options are read.
        state : dict or ndarray of `carom.dtypes.rules_state`, optional
            How the game stands, as for `carom.plan`. With the rack `target` and `innings` are read:
            `{"innings": 1}` gives equal innings, and the match may be drawn.
        hand : {"no", "anywhere", "kitchen", "d", "baulk"}
            Whether the cue ball is in hand.
        options, **changes
            Models of all shots, as for `carom.simulate`.
        """
        check_table(table)
        self._make(rules, state)
        pointed = pointer("carom_table *", table.record)
        if balls is None:
            if isinstance(rules, Rules):
                raise ValueError("balls: rules of one's own have no rack: give a layout")
            begins = self._made.c.state
            code = lib.carom_match_begin_to(
                self._c,
                GAMES[rules],
                begins.target,
                begins.innings,
                pointed,
                seed_of(seed),
                whole(player, "player", most=1),
            )
        else:
            layout = of_record(balls, dtypes.shot_ball, "balls", "balls()")
            code = lib.carom_match_begin_at(
                self._c,
                _OWN if isinstance(rules, Rules) else GAMES[rules],
                self._made.c,
                pointed,
                pointer("carom_shot_ball[]", layout),
                layout.size,
                shot_options(chosen(options, changes)),
                choice(LEAVES, "after" if hand == "no" else hand, "hand"),
                whole(player, "player", most=1),
            )
        self._act(lambda: code, "balls")

    def _make(self, rules: Game | Rules, state: GivenState | None = None) -> None:
        self.rules = rules
        self.lines: list[str] = []
        self._made = Made(rules, state)
        self._c: Any = ffi.new("carom_match *")
        self._struck: tuple[Records, Records] | None = None

    @classmethod
    def load(
        cls, recording: str | os.PathLike[str] | Iterable[str], *, rules: Rules | None = None
    ) -> Match:
        """Read the lines of a match, from a file or as they come, and judge them again.

        `rules` are those of a game of your own.

        Raises
        ------
        CaromError
            A line is not by the rules, or has other bits.
        """
        match = cls.__new__(cls)
        match._make("eightball" if rules is None else rules)
        if rules is not None:
            match._c.rules = match._made.c[0]
        scratch = ffi.new("carom_record *")
        for text in lines_of(recording, match.lines):
            line, previous = text.encode(), match.balls
            match._told(lib.carom_match_read(match._c, scratch, line, len(line)), "line")
            match._made.check()
            if text.startswith('{"shot"'):
                cue = ffi.buffer(ffi.addressof(match._c.record, "cue"))
                match._struck = previous, np.frombuffer(cue, dtypes.cue).copy().reshape(())
        if rules is None:
            match.rules = list(GAMES)[match._c.record.rules]
        match._act(lambda: 0, "line")  # the lines that are missing, of a text that was cut off
        return match

    def __reduce__(self) -> tuple[object, ...]:
        return _loaded, (self.lines, self.rules if isinstance(self.rules, Rules) else None)

    def _told(self, code: int, field: str) -> None:
        if code < 0:
            act, _, right = ffi.string(self._c.fault).decode().partition(": ")
            raise CaromError(code, act or field, text=right or None)

    # ---- How the match stands

    @property
    def table(self) -> Table:
        """The table."""
        record = ffi.buffer(ffi.addressof(self._c.record, "table"))
        return Table.from_record(np.frombuffer(record, dtypes.table).reshape(()))

    @property
    def balls(self) -> Records:
        """The layout of the next stroke: `carom.dtypes.shot_ball`, of shape (balls,)."""
        size = self._c.record.count * dtypes.shot_ball.itemsize
        return np.frombuffer(ffi.buffer(self._c.record.balls, size), dtypes.shot_ball).copy()

    @property
    def state(self) -> Records:
        """How the game stands for the player at the table: `carom.dtypes.rules_state`."""
        state = ffi.buffer(ffi.addressof(self._c.rules, "state"))
        return np.frombuffer(state, dtypes.rules_state).copy().reshape(())

    @property
    def phase(self) -> str:
        """What the match waits for: a "stroke", a "place" of the cue ball in hand, the rest of a
        shot that was stopped ("moving"), or nothing ("over").
        """
        return str(_PHASES[self._c.phase])

    @property
    def player(self) -> int:
        """Who is at the table, 0 or 1."""
        return int(self._c.record.player)

    @property
    def winner(self) -> int | None:
        """Who has won, 0 or 1."""
        return int(self._c.winner) - 1 if self._c.winner in (1, 2) else None

    @property
    def drawn(self) -> bool:
        """Whether the match is over without a winner."""
        return bool(self._c.winner == lib.CAROM_DRAWN)

    @property
    def shots(self) -> int:
        """How many strokes were played."""
        return int(self._c.record.shots)

    @property
    def may(self) -> tuple[str, ...]:
        """The choices for `choose`, of "pass", "push", "rack", "other_rack", "stay" and "spot"; a
        "free_ball" is named by a call, and with "place" the cue ball is in hand.
        """
        return tuple(word for k, word in enumerate(_CHOICES) if self._c.may >> k & 1)

    @property
    def cue_ball(self) -> int:
        """The ball that the player at the table strikes."""
        return int(self._c.cue_ball)

    @property
    def on(self) -> frozenset[int]:
        """The balls that may be met first."""
        return of_set(self._c.on)

    @property
    def touching(self) -> frozenset[int]:
        """The balls that touch the cue ball."""
        return of_set(self._c.touching)

    @property
    def bounds(self) -> Bounds | None:
        """Where the cue ball in hand may be put, until the stroke."""
        if self._c.leave < lib.CAROM_LEAVE_ANYWHERE:
            return None
        bounds = self._c.bounds
        return Bounds((*bounds.low,), (*bounds.high,), (*bounds.centre,), bounds.radius)

    @property
    def hand(self) -> Hand:
        """Where the rules let a cue ball in hand be put, until the stroke: `bounds` in a word."""
        return "no" if self.phase == "over" else hand_of(self._c.leave)

    @property
    def text(self) -> str:
        """The last ruling in words; "" before it."""
        return words_of(ffi.addressof(self._c, "ruling")) if self._c.rulings else ""

    @property
    def shot(self) -> Shot | None:
        """The last shot, or what was played of it, with its events."""
        if self._struck is None:
            return None
        balls, cue = self._struck
        try:
            return simulate(self.table, balls, cue, options=self.options)
        except CaromError as failed:
            return cast("Shot | None", failed.shot)

    @property
    def options(self) -> Options:
        """The models of all shots, and when the last one was to stop."""
        return options_of(self._c.record.options)

    @property
    def ruling(self) -> Ruling | None:
        """The last ruling, and its shot."""
        if not self._c.rulings or (shot := self.shot) is None:
            return None
        is_own = isinstance(self.rules, Rules)
        return ruling_of(ffi.addressof(self._c, "ruling"), self._c.record.count, is_own, shot)

    # ---- Acts

    def _act(self, call: Callable[[], int], field: str) -> bool:
        """Does what C does; an act that C or a method of the rules refuses changes nothing."""
        is_own = isinstance(self.rules, Rules)
        previous = bytes(ffi.buffer(self._c)) if is_own else b""
        code = call()
        raised, self._made.raised = self._made.raised, None
        if raised is not None:
            ffi.buffer(self._c)[:] = previous
            raise raised
        self._told(code, field)
        text = ffi.unpack(self._c.text, self._c.size).decode()
        self.lines += text.splitlines(keepends=True)
        return code == 0

    def choose(self, what: str) -> None:
        """Take a choice of `may`: "push" for the next stroke, the others instead of it."""
        bit = choice({word: 1 << k for k, word in enumerate(_CHOICES)}, what, "what")
        self._act(lambda: lib.carom_match_choose(self._c, self.player, bit), "what")

    def place(self, x: float, y: float) -> None:
        """Put the cue ball in hand to a place within `bounds`, m; until the stroke it may be put
        elsewhere.
        """
        point = number(x, "x"), number(y, "y")
        self._act(lambda: lib.carom_match_place(self._c, self.player, *point), "place")

    def call(self, ball: int, pocket: int = -1) -> None:
        """Call the ball and the pocket of the next stroke; ball -1: a safety. In snooker it names a
        colour or a free ball.
        """
        numbers = [whole(ball, "ball", least=-1), whole(pocket, "pocket", least=-1)]
        call = ffi.new("carom_call *", numbers)[0]
        self._act(lambda: lib.carom_match_call(self._c, self.player, call), "call")

    def stroke(
        self,
        cue: Records,
        *,
        t_final: float | None = None,
        stop_at: StopAt | Iterable[StopAt] = (),
    ) -> bool:
        """Play a stroke of `cue_ball`, up to when `carom.simulate` would stop it.

        Returns
        -------
        bool
            Whether the shot has ended, and is ruled.
        """
        balls, strike, stop = self.balls, copied(one_cue(cue)), _stop(t_final, stop_at)
        struck_cue = pointer("carom_cue[]", strike)
        is_ended = self._act(
            lambda: lib.carom_match_stroke(self._c, self.player, struck_cue, stop, ffi.NULL), "cue"
        )
        self._struck = balls, strike
        return is_ended

    def resume(
        self, *, t_final: float | None = None, stop_at: StopAt | Iterable[StopAt] = ()
    ) -> bool:
        """Go on with a shot that was stopped; t_final counts from its beginning."""
        stop = _stop(t_final, stop_at)
        return self._act(lambda: lib.carom_match_continue(self._c, stop, ffi.NULL), "t_final")

    def concede(self, player: int) -> None:
        """A player, 0 or 1, gives the game to the other."""
        seat = whole(player, "player", most=1)
        self._act(lambda: lib.carom_match_concede(self._c, seat), "player")

    def clock(self) -> None:
        """The time of the player at the table is over: a foul."""
        self._act(lambda: lib.carom_match_clock(self._c, self.player), "clock")

    def end(self) -> str:
        """The whole recording, with its last line: nothing follows."""
        self._act(lambda: lib.carom_match_end(self._c), "end")
        return "".join(self.lines)

    # ---- Plans

    def plan(self, **wanted: Any) -> Records:
        """The best strokes of the player at the table, with a cue ball in hand within `bounds`.

        `wanted` is as for `carom.plan`: player, opponent, shots, best, seed, ...
        """

        def call(*job: Any) -> int:
            code: int = lib.carom_match_plan(self._c, *job)
            if code == Status.ERROR_ACT:
                self._told(code, "plan")
            return code

        is_own = isinstance(self.rules, Rules)
        return plan(
            self.table,
            self.balls,
            usual_cue(ball=self.cue_ball),
            rules=self.rules,
            state=None if is_own else self.state,
            options=self.options,
            _by=ByMatch(self._made if is_own else None, call),
            **wanted,
        )

    def take(self, best: Records, cue: Records | None = None) -> None:
        """Take a choice of `plan`: place, call and play its stroke, or pass.

        `cue` is the stroke as the player makes it; by default that of the choice.
        """
        choice = pointer("carom_plan_stroke *", copied(best))
        self._act(lambda: lib.carom_match_prepare(self._c, self.player, choice), "best")
        if best["kind"] != Kind.PASS:
            self.stroke(best["cue"] if cue is None else cue)


def _stop(t_final: float | None, stop_at: StopAt | Iterable[StopAt]) -> Any:
    return shot_options(_USUAL.changed({"t_final": t_final, "stop_at": stop_at}))


def _loaded(lines: list[str], rules: Rules | None) -> Match:
    return Match.load(lines, rules=rules)
