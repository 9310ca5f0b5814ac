"""A match of 2 to 8 seats, as defined in `carom_match.h`."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, cast, get_args

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Seed, choice, copied, listing, pointer, seed_of, several, unknown_name
from carom._rows import whole
from carom._shot_options import Options, StopAt, chosen, options_of, shot_options
from carom.dtypes import Records
from carom.games._described import BreakOrder, Kind, MatchActs
from carom.games._match_verbs import MatchVerbs
from carom.games.plans import ByMatch, plan, player
from carom.games.rules import (
    GAMES,
    LEAVES,
    Game,
    GivenState,
    Hand,
    Made,
    Rules,
    Ruling,
    hand_of,
    ruling_of,
    words_of,
)
from carom.layouts import Table, check_table, of_record, one_cue
from carom.record import lines_of
from carom.results import Shot
from carom.shots import replayed
from carom.status import CaromError, Status, in_python

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes

__all__ = ["Bounds", "Match", "Seat", "Standing"]
__dir__ = listing(__name__)

_USUAL = Options()
_OWN = 1000  # the number of a game of one's own in recordings
_NOTE = re.compile(r'\s*\{\s*"note"')  # how the line of a note begins
ORDERS = {word: k for k, word in enumerate(get_args(BreakOrder))}


class Bounds(NamedTuple):
    """Where a cue ball in hand may be placed, m.

    The rectangle from `low` to `high`; if `radius` is above 0, only the D within it, the half
    circle around `centre`.
    """

    low: tuple[float, float]
    high: tuple[float, float]
    centre: tuple[float, float]
    radius: float


class Seat(NamedTuple):
    """A seat of a match: its player and cue. A `rating` of 0 means unknown."""

    name: str
    side: int  # Seats on the same side are partners
    handicap: int  # Of the side, stored in its first seat: points, or as the game defines it
    rating: float  # A Fargo rating
    cue: Records  # Stick and tip, `carom.dtypes.cue`; the stroke itself is ignored


class Standing(NamedTuple):
    """The score of a match by sides, regardless of who is at the table."""

    sides: tuple[int, ...]  # The side of each seat
    points: tuple[int, ...]  # Including the handicap; or what each seat has left, such as lives
    won: tuple[int, ...]  # Matches won in the set, including this one
    set_winner: int | None  # The side that won the set


def _members(struct: Any) -> dict[str, Any]:
    """The members of a struct of C."""
    values = {name: getattr(struct, name) for name, _ in ffi.typeof(struct).fields}
    return {
        name: (*value,) if isinstance(value, ffi.CData) else value for name, value in values.items()
    }


def _fill(struct: Any, values: Mapping[str, Any], name: str) -> None:
    """Set members of a struct of C by name."""
    known = [member for member, _ in ffi.typeof(struct).fields]
    for member, value in values.items():
        if member not in known:
            raise TypeError(unknown_name(name, "member", member, known))
        try:
            if member == "cue":
                stick = copied(one_cue(value))
                for stroke in ("speed", "phi", "theta", "a", "b", "ball"):
                    stick[stroke] = 0
                ffi.buffer(ffi.addressof(struct, member))[:] = stick.tobytes()
            elif member == "order":
                struct.order = choice(ORDERS, value, f"{name}: order")
            else:
                setattr(struct, member, value.encode() if isinstance(value, str) else value or 0)
        except (TypeError, OverflowError, IndexError) as wrong:
            raise ValueError(f"{name}: {member}: {wrong}") from None


def _seating(
    game: int,
    partners: bool,
    seats: int | Iterable[str | Mapping[str, Any] | Seat] | None,
    alternate: bool,
    limits: Mapping[str, Any] | None,
) -> Any:
    """The seats of a match for C; NULL: the usual two. `partners`: custom rules with two sides."""
    if seats is None and not alternate and limits is None:
        return ffi.NULL
    needed = (
        "a number of seats, or a list of names or mappings with name, side, handicap, rating, cue"
    )
    each: list[Any] = []
    if isinstance(seats, int):
        each = [{}] * seats
    elif seats is not None:
        each = several(seats, "seats", needed)
    seating = ffi.new("carom_seating *")
    if lib.carom_seating_make(game, len(each), seating) < 0:
        raise ValueError(
            f"seats: this game is not played with {len(each)} seats; help(carom.Match) describes seats"
        )
    each = each or [{}] * int(seating.count)
    for k, value in enumerate(each):
        if partners:
            seating.seat[k].side = k % 2
        seat = {"name": value} if isinstance(value, str) else value
        seat = seat._asdict() if isinstance(seat, Seat) else seat
        if not isinstance(seat, Mapping):
            raise TypeError(
                f"seats[{k}]: {value!r} is not a name or a mapping with name, side, handicap, rating, cue"
            )
        _fill(seating.seat[k], seat, f"seats[{k}]")
    seating.alternate = bool(alternate)
    _fill(seating.limits, limits or {}, "limits")
    return seating


class Match(MatchVerbs, MatchActs):
    """A game for 2 to 8 seats, which is played act by act.

    The object contains the table, the balls, the rules, the players with their cues, the last shot
    and the recording. An act that the rules forbid raises `CaromError` with an explanation, and
    changes nothing. `lines` is the recording so far, which the command `carom verify` checks.

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
        side: int = 0,
        seats: int | Iterable[str | Mapping[str, Any] | Seat] | None = None,
        alternate: bool = False,
        limits: Mapping[str, Any] | None = None,
        set: Mapping[str, Any] | None = None,
        balls: Records | None = None,
        state: GivenState | None = None,
        hand: Hand = "no",
        options: Options = _USUAL,
        **changes: Unpack[Changes],
    ) -> None:
        """Begin a match with the rack of a game, or with a custom layout.

        Parameters
        ----------
        rules : str or Rules
            The game, as for `carom.plan`. Custom rules require `balls`.
        table : Table
        seed : int
            Seed of the gaps in the rack, at most 0.1 mm.
        side : int
            The side that plays first.
        seats : int, or list of str, dict or Seat
            The players: a number, a list of names, or a list of mappings with any of `name`,
            `side`, `handicap`, `rating` and `cue`. Two sides alternate: of four seats, 0 and 2 are
            partners. Default: two seats.
        alternate : bool
            Whether partners alternate after each stroke, as in Scotch doubles, instead of after
            each visit.
        limits : dict
            Limits of strokes; None removes one. `speed` (15 m/s), `theta` (90 degrees), `tip` (0.75
            radii), `mass_least`, `mass_most`, `end_mass_least` (0.2, 1.2, 0.001 kg),
            `tip_restitution_most`, and `own_cue`: whether a stroke must use the seat's cue.
        set : dict
            Makes the match part of a set. `race`: matches that win the set. `order`: who breaks
            next, "alternate", "winner" or "loser". `clock` and `extension`: times in s, which the
            caller measures. `extensions` of a side per match, and `timeouts` per set.
        balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,), optional
            A custom layout instead of the rack.
        state : dict or ndarray of `carom.dtypes.rules_state`, optional
            The state of the game, as for `carom.plan`. With the rack, only `target` and `innings`
            are used: `{"innings": 1}` means equal innings, which allows a draw.
        hand : {"no", "anywhere", "kitchen", "d", "baulk"}
            Where the cue ball in hand may be placed; used only with `balls`.
        options, **changes
            Models of all shots, as for `carom.simulate`.
        """
        check_table(table)
        self._make(rules, state)
        game = _OWN if isinstance(self.rules, Rules) else GAMES[self.rules]
        partners = isinstance(rules, Rules) and rules.race != "seats"
        models = shot_options(chosen(options, changes))
        pointed = pointer("carom_table *", table.record)
        seating = _seating(game, partners, seats, alternate, limits)
        setup = ffi.new(
            "carom_match_setup *",
            {
                "rules": game,
                "table": pointed,
                "options": models,
                "side": whole(side, "side", most=lib.CAROM_SEATS_MOST - 1),
                "seed": seed_of(seed),
                "seating": seating,
            },
        )
        if set is not None:
            setup.set = series = ffi.new("carom_set *")
            _fill(series[0], set, "set")
        if balls is not None:
            layout = of_record(balls, dtypes.shot_ball, "balls", "balls()")
            setup.of, setup.count = self._made.c, layout.size
            setup.balls = pointer("carom_shot_ball[]", layout)
            setup.leave = choice(LEAVES, "after" if hand == "no" else hand, "hand")
        elif isinstance(rules, Rules):
            raise ValueError("balls: custom rules have no rack; pass a layout")
        else:
            begins = self._made.c.state
            setup.target, setup.equal_innings = begins.target, begins.innings
        self._act(lambda: lib.carom_match_begin_with(self._c, setup), "balls")

    def _make(self, rules: Game | Rules, state: GivenState | None = None) -> None:
        self._made = Made(rules, state)
        self.rules = self._made.rules
        self._c: Any = ffi.new("carom_match *")
        self._lines: list[str] = []  # but those in the text of C, of the last act
        self._undone: list[list[str]] = []
        self._shot: tuple[int, Shot | None] = 0, None  # by the hash of its end

    @classmethod
    def load(
        cls, recording: str | os.PathLike[str] | Iterable[str], *, rules: Rules | None = None
    ) -> Match:
        """Read a match from a file, a text or an iterator of lines, and judge it again.

        `rules` are the custom rules of the match, if any.

        Raises
        ------
        CaromError
            A line violates the rules, or its bits differ.
        """
        match = cls.__new__(cls)
        match._make("eightball" if rules is None else rules)
        if rules is not None:
            match._c.rules = match._made.c[0]
        for line in lines_of(recording):
            match.read(line)
        if match.phase == "none":
            text = "the recording has no line game" if match._lines else "the recording is empty"
            right = f'{text}; a match begins with a line "recording" and further lines up to "game"'
            raise CaromError(Status.ERROR_RECORD, f"line {len(match._lines) + 1}", text=right)
        if rules is None:
            match.rules = list(GAMES)[match._c.record.rules]
        return match

    def __reduce__(self) -> tuple[object, ...]:
        return _loaded, (self.lines, self.rules if isinstance(self.rules, Rules) else None)

    def copy(self) -> Match:
        """Return an independent copy of the match."""
        twin = type(self).__new__(type(self))
        twin.__dict__.update(self.__dict__)
        twin._c = ffi.new("carom_match *")
        ffi.buffer(twin._c)[:] = ffi.buffer(self._c)[:]
        twin._lines, twin._undone = [*self._lines], [*self._undone]
        return twin

    # ---- The state of the match

    @property
    def lines(self) -> list[str]:
        """The recording so far. Each line that was read is followed by its ruling."""
        return [*self._lines, *self._written()]

    @property
    def notes(self) -> list[dict[str, str | int | float]]:
        """The notes of the recording so far, with the keys of `note` that each has. A recording does
        not seal its notes: anybody who can edit it can change them.
        """
        notes: list[dict[str, str | int | float]] = []
        for line in self.lines:
            if _NOTE.match(line):
                note = json.loads(line)["note"]
                seconds = note.get("seconds", 0)
                if isinstance(seconds, str):  # more digits than a decimal of a recording has
                    note["seconds"] = float.fromhex(seconds)
                notes.append(note)
        return notes

    def _written(self) -> list[str]:
        text: bytes = ffi.unpack(self._c.text, self._c.size)
        return text.decode().splitlines(keepends=True)

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
        """The state of the game for the player at the table: `carom.dtypes.rules_state`."""
        state = ffi.buffer(ffi.addressof(self._c.rules, "state"))
        return np.frombuffer(state, dtypes.rules_state).copy().reshape(())

    @property
    def seats(self) -> tuple[Seat, ...]:
        """The seats and their players."""
        seats = self._c.seating.seat[0 : self._c.seating.count]
        return tuple(
            Seat(
                ffi.string(seat.name).decode(),
                seat.side,
                seat.handicap,
                seat.rating,
                cue_of(ffi.addressof(seat, "cue")),
            )
            for seat in seats
        )

    @property
    def limits(self) -> dict[str, Any]:
        """The limits of strokes; 0: no limit."""
        return _members(self._c.seating.limits)

    @property
    def set(self) -> dict[str, Any] | None:
        """The set of the match, with the match's `number` and how many each side had `won` before."""
        values = _members(self._c.record.set)
        won = values["won"][: len(self.standing.won)]
        is_one = values["race"] > 0
        return {**values, "order": [*ORDERS][values["order"]], "won": won} if is_one else None

    @property
    def standing(self) -> Standing:
        """The score of the match by sides."""
        standing = ffi.new("carom_standing *")
        lib.carom_match_standing(self._c, standing)
        points, won = (
            (*numbers[0 : standing.sides],) for numbers in (standing.points, standing.won)
        )
        sides = (*standing.side_of[0 : self._c.seating.count],)
        set_winner = standing.set_winner - 1 if standing.set_winner else None
        return Standing(sides, points, won, set_winner)

    @property
    def words(self) -> str:
        """A sentence on what the match waits for, or how it ended; `match.ruling.words` is the last
        ruling.
        """
        return words_of(lambda *text: lib.carom_match_string(self._c, *text))

    @property
    def bounds(self) -> Bounds | None:
        """Where the cue ball in hand may be placed before the stroke."""
        if self._c.leave < lib.CAROM_LEAVE_ANYWHERE:
            return None
        bounds = self._c.bounds
        return Bounds((*bounds.low,), (*bounds.high,), (*bounds.centre,), bounds.radius)

    @property
    def hand(self) -> Hand:
        """The name of the area in which a cue ball in hand may be placed before the stroke."""
        return "no" if self.phase == "over" else hand_of(self._c.leave)

    @property
    def shot(self) -> Shot | None:
        """The last shot, as far as it was played, with its events."""
        key: int = self._c.record.played.hash
        if not self._c.stroke.mass > 0.0:
            return None
        if self._shot[0] != key:
            size = self._c.record.count * dtypes.shot_ball.itemsize
            before = np.frombuffer(ffi.buffer(self._c.before, size), dtypes.shot_ball)
            cue = cue_of(ffi.addressof(self._c, "stroke"))
            try:
                shot = replayed(self.table, before, cue, self.options, self._c)
            except CaromError as failed:
                shot = cast("Shot", failed.shot)
            self._shot = key, shot
        return self._shot[1]

    @property
    def options(self) -> Options:
        """The models of all shots, and the stop of the last one."""
        return options_of(self._c.record.options)

    @property
    def ruling(self) -> Ruling | None:
        """The last ruling with the last shot; None before the first stroke."""
        if not self._c.rulings:
            return None
        shot = cast("Shot", self.shot)
        is_own, cue_ball = isinstance(self.rules, Rules), self._c.stroke.ball
        ruling = ffi.addressof(self._c, "ruling")
        return ruling_of(ruling, self._c.record.count, is_own, shot, cue_ball)

    # ---- Acts

    def _called(self, call: Callable[[], int], field: str) -> int:
        """Call C. If C rejects the call, or a method of the rules raises, nothing changes."""
        previous = bytes(ffi.buffer(self._c))
        code = call()
        try:
            self._made.check()
            _refuse(self._c, code, field)
        except BaseException:
            ffi.buffer(self._c)[:] = previous
            raise
        return code

    def _act(self, call: Callable[[], int], field: str) -> bool:
        """Perform an act in C. Returns whether a shot has ended."""
        known = self._written()
        code = self._called(call, field)
        self._lines += known
        self._undone.clear()
        return code == 0

    def read(self, line: str) -> None:
        """Read the next line of a file and judge it: an act, or a line of the ruling of the last
        act.

        Raises
        ------
        CaromError
            The line is not by the rules, or has other bits. Then nothing has changed.
        """
        record = self._c.record
        known, is_due, previous = self._written(), self._c.due > 0, (record.line, record.hash)
        scratch, text = ffi.new("carom_record *"), line.encode()
        self._called(lambda: lib.carom_match_read(self._c, scratch, text, len(text)), "line")
        if is_due and self._c.size < sum(len(one.encode()) for one in known):
            self._lines.append(known[0])
        elif is_due and record.line != previous[0]:  # a note, before the lines that are due
            self._lines.append(line.rstrip() + "\n")
        elif not is_due and (record.line, record.hash) != previous:  # no blank line, no event
            self._lines += [*known, line.rstrip() + "\n"]
        self._undone.clear()

    def receive(self, line: str, seat: int | None) -> bool:
        """Judge a line that a peer has sent, such as a client of a server.

        The lines of the ruling need not follow: the match makes them. A line of the last act that
        comes again changes nothing.

        Parameters
        ----------
        line : str
            One line, with or without its end.
        seat : int or None
            The seat that sent it. None: a sender that may send every line, such as the server of a
            client.

        Returns
        -------
        bool
            Whether the match has changed. Then `lines` has new ones.

        Raises
        ------
        CaromError
            The line is not by the rules, has other bits, or is an act of another seat. The match
            stays as it was, to the bit.
        """
        sender = -1 if seat is None else whole(seat, "seat", least=0, most=2**31)
        known, count = self._written(), self._c.record.line
        room, text = ffi.new("carom_match *"), line.encode()
        self._called(
            lambda: lib.carom_match_receive(self._c, room, text, len(text), sender), "line"
        )
        if self._c.record.line == count:
            return False
        self._lines += known
        if self._c.size == 0:  # a line of the beginning, which is read and not made
            self._lines.append(line.rstrip() + "\n")
        self._undone.clear()
        return True

    def undo(self) -> bool:
        """Undo the last act, by judging the lines before it again.

        Returns
        -------
        bool
            Whether there was an act to undo.
        """
        lines = self.lines
        text = "".join(lines).encode()
        kept = text[: lib.carom_match_undone(text, len(text))].decode().splitlines(keepends=True)
        if len(kept) == len(lines):
            return False
        undone = [*self._undone, lines[len(kept) :]]
        before = self.load(kept, rules=self.rules if isinstance(self.rules, Rules) else None)
        self.__dict__.update(before.__dict__, _undone=undone)
        return True

    def redo(self) -> bool:
        """Repeat the act that was undone last, unless another act followed.

        Returns
        -------
        bool
            Whether there was an act to repeat.
        """
        if not self._undone:
            return False
        *others, lines = self._undone
        for line in lines:
            self.read(line)
        self._undone = others
        return True

    def _seat(self, seat: int | None) -> int:
        return self.seat if seat is None else whole(seat, "seat", most=lib.CAROM_SEATS_MOST - 1)

    # The seat that acts is by default the one at the table.

    def call(self, ball: int, pocket: int = -1, *, seat: int | None = None) -> None:
        """Call the ball and the pocket of the next stroke; ball -1 calls a safety.

        In snooker this nominates a colour or a free ball.
        """
        numbers = [whole(ball, "ball", least=-1), whole(pocket, "pocket", least=-1)]
        call = ffi.new("carom_call *", numbers)[0]
        self._act(lambda: lib.carom_match_call(self._c, self._seat(seat), call), "call")

    def stroke(
        self,
        cue: Records,
        *,
        t_final: float | None = None,
        stop_at: StopAt | Iterable[StopAt] = (),
        seat: int | None = None,
    ) -> bool:
        """Play a stroke with `cue_ball`; `t_final` and `stop_at` are as for `carom.simulate`.

        Returns
        -------
        bool
            Whether the shot has ended and been ruled on.
        """
        struck, stop = pointer("carom_cue[]", copied(one_cue(cue))), _stop(t_final, stop_at)
        return self._act(
            lambda: lib.carom_match_stroke(self._c, self._seat(seat), struck, stop, ffi.NULL), "cue"
        )

    def resume(
        self, *, t_final: float | None = None, stop_at: StopAt | Iterable[StopAt] = ()
    ) -> bool:
        """Continue a shot that was stopped; t_final counts from its beginning."""
        stop = _stop(t_final, stop_at)
        return self._act(lambda: lib.carom_match_continue(self._c, stop, ffi.NULL), "t_final")

    def prepare(self, best: Records, *, seat: int | None = None) -> None:
        """Perform the acts of a choice of `plan` before its stroke: place, push out and call.

        A pass is performed completely; no stroke follows.
        """
        choice = pointer("carom_plan_stroke *", copied(best))
        self._act(lambda: lib.carom_match_prepare(self._c, self._seat(seat), choice), "best")

    def take(
        self,
        best: Records,
        cue: Records | None = None,
        *,
        t_final: float | None = None,
        stop_at: StopAt | Iterable[StopAt] = (),
        seat: int | None = None,
    ) -> bool:
        """Play a choice of `plan`: `prepare` it, and play its `stroke` unless it is a pass.

        `cue` is the stroke that is actually played; it defaults to the choice's.
        """
        self.prepare(best, seat=seat)
        if best["kind"] == Kind.PASS:
            return True
        stroke = best["cue"] if cue is None else cue
        return self.stroke(stroke, t_final=t_final, stop_at=stop_at, seat=seat)

    def note(
        self,
        *,
        seat: int | None = None,
        date: str | None = None,
        event: str | None = None,
        site: str | None = None,
        round: str | None = None,
        name: str | None = None,
        comment: str | None = None,
        offer: Literal["draw", "take_back"] | None = None,
        answer: Literal["yes", "no"] | None = None,
        seconds: float | None = None,
        **extras: str | float,
    ) -> None:
        """Write words into the recording. They change neither the game nor a hash.

        The rules have no draw by agreement and no take-back: an offer and its answer are words.
        After both sides have agreed, `end` the match, or `undo` the last act.

        Parameters
        ----------
        seat : int or None
            Who says it. None: nobody in particular, such as a judge.
        date, event, site, round, name, comment : str
            UTF-8 of at most 31 bytes (`date`, `round`), 127 (`event`, `site`), 63 (`name`) or 1023
            (`comment`), without control characters.
        offer : {"draw", "take_back"}
            What the seat offers or asks for.
        answer : {"yes", "no"}
            The answer to the last offer of another seat.
        seconds : float
            The time, s, that the last stroke took the player.
        **extras
            At most 8 keys of your own program, which begin with `x_`: texts of at most 255 bytes, or
            numbers. carom keeps them.

        Raises
        ------
        CaromError
            A key or a value is not allowed, or the match has no such seat. Nothing has changed.
        """
        texts = {
            "date": date,
            "event": event,
            "site": site,
            "round": round,
            "name": name,
            "comment": comment,
        }
        words = {**texts, "offer": offer, "answer": answer, **extras}
        for key, value in words.items():
            is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
            if not (value is None or isinstance(value, str) or (key in extras and is_number)):
                needed = "a text or a number" if key in extras else "a text"
                raise TypeError(f"{key}: it must be {needed}, not {value!r}")
        if seconds is not None:
            words["seconds"] = float(f"{float(seconds):.15g}")  # the digits that a line may have
        said = {key: value for key, value in words.items() if value is not None}
        line = json.dumps({"note": said}, ensure_ascii=False).encode()
        scratch = ffi.new("carom_record *")
        ffi.buffer(scratch)[:] = ffi.buffer(ffi.addressof(self._c, "record"))
        code = lib.carom_record_read(scratch, line, len(line))
        if code < 0:
            raise CaromError(code, "note", text=ffi.string(scratch.fault).decode())
        sender = -1 if seat is None else whole(seat, "seat", most=2**31 - 1)
        note = ffi.addressof(scratch, "note")
        self._act(lambda: lib.carom_match_note(self._c, sender, note), "note")

    def end(self) -> str:
        """End the recording and return all of it; only the next match of a set can follow."""
        self._act(lambda: lib.carom_match_end(self._c), "end")
        return "".join(self.lines)

    # ---- Plans

    def plan(self, **wanted: Any) -> Records:
        """Find the best strokes of the seat at the table, with a cue ball in hand within `bounds`.

        The keywords are as for `carom.plan`: player, opponent, shots, best, seed, ... The defaults
        are the seat's cue and a player with the seat's rating. The opponent is the next seat of the
        other side, with its rating, or if that is unknown, a strength estimated from its strokes in
        this set.
        """

        c = self.copy()._c  # a plan changes the text and the cue of the copy

        def call(*job: Any) -> int:
            code: int = lib.carom_match_plan(c, *job)
            if code == Status.ERROR_ACT:
                _refuse(c, code, "plan")
            return code

        is_own = isinstance(self.rules, Rules)
        if rating := self._c.seating.seat[self.seat].rating:
            game: Game = "eightball" if isinstance(self.rules, Rules) else self.rules
            wanted = {"player": player(fargo=rating, rules=game), **wanted}
        return plan(
            self.table,
            self.balls,
            wanted.pop("cue", self.cue),
            rules=self.rules,
            state=None if is_own else self.state,
            options=self.options,
            _by=ByMatch(self._made if is_own else None, call),
            **wanted,
        )


def _refuse(match: Any, code: int, field: str) -> None:
    """Raise the error of C, with its text."""
    if code < 0:
        act, _, right = in_python(ffi.string(match.fault).decode()).partition(": ")
        act = "resume" if act == "continue" else act
        raise CaromError(code, act or field, text=right or None)


def cue_of(cue: Any) -> Records:
    return np.frombuffer(ffi.buffer(cue), dtypes.cue).copy().reshape(())


def _stop(t_final: float | None, stop_at: StopAt | Iterable[StopAt]) -> Any:
    return shot_options(_USUAL.changed({"t_final": t_final, "stop_at": stop_at}))


def _loaded(lines: list[str], rules: Rules | None) -> Match:
    return Match.load(lines, rules=rules)
