"""A match of 2 to 8 seats, as `carom_match.h` has it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, cast, get_args

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import Seed, choice, copied, listing, pointer, seed_of, several, whole
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
ORDERS = {word: k for k, word in enumerate(get_args(BreakOrder))}


class Bounds(NamedTuple):
    """Where a cue ball in hand may be put, m: within `low` and `high`, and where `radius` is above
    0 also in the half circle around `centre`, the D.
    """

    low: tuple[float, float]
    high: tuple[float, float]
    centre: tuple[float, float]
    radius: float


class Seat(NamedTuple):
    """A seat of a match: who sits there, and with what. A `rating` of 0 is unknown."""

    name: str
    side: int  # Seats of one side play together
    handicap: int  # Of a side, which its first seat has: points, or as the game has it
    rating: float  # A Fargo rating
    cue: Records  # Its stick and tip, `carom.dtypes.cue`; of the stroke itself nothing is read


class Standing(NamedTuple):
    """How a match stands, by sides, whoever is at the table."""

    sides: tuple[int, ...]  # The side of each seat
    points: tuple[int, ...]  # With the handicap; or what each seat has left, such as lives
    won: tuple[int, ...]  # Matches of the set, with this one
    set_winner: int | None  # The side that has won the set


def _members(struct: Any) -> dict[str, Any]:
    """The members of a struct of C."""
    values = {name: getattr(struct, name) for name, _ in ffi.typeof(struct).fields}
    return {
        name: (*value,) if isinstance(value, ffi.CData) else value for name, value in values.items()
    }


def _fill(struct: Any, values: Mapping[str, Any], name: str) -> None:
    """Sets members of a struct of C, by their names."""
    known = [member for member, _ in ffi.typeof(struct).fields]
    for member, value in values.items():
        if member not in known:
            raise TypeError(f"{name}: there is no {member!r}; there are {', '.join(known)}")
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
    """The seats of a match for C; NULL: the usual two. `partners`: two sides of own rules."""
    if seats is None and not alternate and limits is None:
        return ffi.NULL
    needed = "a number is needed, or names, or mappings with name, side, handicap, rating, cue"
    each: list[Any] = []
    if isinstance(seats, int):
        each = [{}] * seats
    elif seats is not None:
        each = several(seats, "seats", needed)
    seating = ffi.new("carom_seating *")
    if lib.carom_seating_make(game, len(each), seating) < 0:
        raise ValueError(f"seats: this game is not played by {len(each)}")
    each = each or [{}] * int(seating.count)
    for k, given in enumerate(each):
        if partners:
            seating.seat[k].side = k % 2
        one = {"name": given} if isinstance(given, str) else given
        one = one._asdict() if isinstance(one, Seat) else one
        if not isinstance(one, Mapping):
            raise TypeError(f"seats[{k}]: {needed}, not {given!r}")
        _fill(seating.seat[k], one, f"seats[{k}]")
    seating.alternate = bool(alternate)
    _fill(seating.limits, limits or {}, "limits")
    return seating


class Match(MatchVerbs, MatchActs):
    """A game of 2 to 8 seats: the table, the balls, the rules, the players with their cues, the last
    shot and the recording in one object, which takes one act after another.

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
        """Begin a match with the rack of a game, or with another layout.

        Parameters
        ----------
        rules : str or Rules
            The game, as for `carom.plan`; one of your own needs `balls`.
        table : Table
        seed : int
            Of the gaps of the rack, 0.1 mm at most.
        player : int
            The side that plays first.
        seats : int, or list of str, dict or Seat
            Who plays: how many, or their names, or what differs from the usual of `name`, `side`,
            `handicap`, `rating` and `cue`. Two sides play in turn: of four seats, 0 and 2 are
            partners. Default: two seats.
        alternate : bool
            Whether partners take turns by strokes, as in Scotch doubles, and not by visits.
        limits : dict
            Bounds of strokes, of which None is no bound: `speed` (15 m/s), `theta` (90 degrees),
            `tip` (0.75 radii), `mass_least`, `mass_most`, `end_mass_least` (0.2, 1.2, 0.001 kg),
            `tip_restitution_most`, and `own_cue`: whether the stick must be that of the seat.
        set : dict
            The match is one of a set: `race`, how many a side needs; `order`, whether the next
            break is "alternate", or that of the "winner" or the "loser"; `clock` and `extension`, s,
            which you measure; `extensions` of a side in a match, and `timeouts` in the set.
        balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,), optional
            Another layout than the rack. Only then `hand` is read.
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
        game = _OWN if isinstance(rules, Rules) else GAMES[rules]
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
                "side": whole(player, "player", most=lib.CAROM_SEATS_MOST - 1),
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
            raise ValueError("balls: rules of one's own have no rack: give a layout")
        else:
            begins = self._made.c.state
            setup.target, setup.equal_innings = begins.target, begins.innings
        self._act(lambda: lib.carom_match_begin_with(self._c, setup), "balls")

    def _make(self, rules: Game | Rules, state: GivenState | None = None) -> None:
        self.rules = rules
        self._made = Made(rules, state)
        self._c: Any = ffi.new("carom_match *")
        self._lines: list[str] = []  # but those in the text of C, of the last act
        self._undone: list[list[str]] = []
        self._shot: tuple[int, Shot | None] = 0, None  # by the hash of its end

    @classmethod
    def load(
        cls, recording: str | os.PathLike[str] | Iterable[str], *, rules: Rules | None = None
    ) -> Match:
        """Read a match, from a file, a text or lines as they come, and judge it again.

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
        for line in lines_of(recording):
            match._read(line, -1)
        if match.phase == "none":
            text = "cut off: there is no line game" if match._lines else "the text is empty"
            right = f'{text}: a match begins with a line "recording", and lines up to "game"'
            raise CaromError(Status.ERROR_RECORD, f"line {len(match._lines) + 1}", text=right)
        if rules is None:
            match.rules = list(GAMES)[match._c.record.rules]
        return match

    def __reduce__(self) -> tuple[object, ...]:
        return _loaded, (self.lines, self.rules if isinstance(self.rules, Rules) else None)

    def copy(self) -> Match:
        """Another match that stands as this one, and goes on by itself."""
        twin = type(self).__new__(type(self))
        twin.__dict__.update(self.__dict__)
        twin._c = ffi.new("carom_match *")
        ffi.buffer(twin._c)[:] = ffi.buffer(self._c)[:]
        twin._lines, twin._undone = [*self._lines], [*self._undone]
        return twin

    # ---- How the match stands

    @property
    def lines(self) -> list[str]:
        """The recording so far. Behind a line that was read, it has those of its ruling."""
        return [*self._lines, *self._written()]

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
        """How the game stands for the player at the table: `carom.dtypes.rules_state`."""
        state = ffi.buffer(ffi.addressof(self._c.rules, "state"))
        return np.frombuffer(state, dtypes.rules_state).copy().reshape(())

    @property
    def seats(self) -> tuple[Seat, ...]:
        """Who plays."""
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
        """The bounds of strokes; 0: none."""
        return _members(self._c.seating.limits)

    @property
    def set(self) -> dict[str, Any] | None:
        """The set that the match belongs to, with its `number` and how many each side had `won`."""
        values = _members(self._c.record.set)
        won = values["won"][: len(self.standing.won)]
        is_one = values["race"] > 0
        return {**values, "order": [*ORDERS][values["order"]], "won": won} if is_one else None

    @property
    def standing(self) -> Standing:
        """How the match stands, by sides."""
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
        """What the match waits for, or how it ended; `match.ruling.words` says the last ruling."""
        return words_of(lambda *text: lib.carom_match_string(self._c, *text))

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
    def shot(self) -> Shot | None:
        """The last shot, or what was played of it, with its events: played here or read."""
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
        """The models of all shots, and when the last one was to stop."""
        return options_of(self._c.record.options)

    @property
    def ruling(self) -> Ruling | None:
        """The last ruling, and the last shot, which is None before the first stroke."""
        if not self._c.rulings:
            return None
        shot = cast("Shot", self.shot)
        is_own, cue_ball = isinstance(self.rules, Rules), self._c.stroke.ball
        ruling = ffi.addressof(self._c, "ruling")
        return ruling_of(ruling, self._c.record.count, is_own, shot, cue_ball)

    # ---- Acts

    def _called(self, call: Callable[[], int], field: str) -> int:
        """What C returns; what it or a method of the rules refuses changes nothing."""
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
        """Does what C does. Returns whether a shot has ended."""
        known = self._written()
        code = self._called(call, field)
        self._lines += known
        self._undone.clear()
        return code == 0

    def _read(self, line: str, seat: int) -> None:
        record = self._c.record
        known, is_due, previous = self._written(), self._c.due > 0, (record.line, record.hash)
        scratch, text = ffi.new("carom_record *"), line.encode()
        self._called(
            lambda: lib.carom_match_read_from(self._c, scratch, text, len(text), seat), "line"
        )
        if is_due and self._c.size < sum(len(one.encode()) for one in known):
            self._lines.append(known[0])
        elif not is_due and (record.line, record.hash) != previous:  # no blank line, no event
            self._lines += [*known, line.rstrip() + "\n"]

    def read(self, line: str, seat: int | None = None) -> None:
        """Read a line of another program and judge it: an act, or a line of the ruling of the last
        act. With `seat` the act must be one of that seat.

        Raises
        ------
        CaromError
            The line is not by the rules, has other bits, or is an act of another seat. Then nothing
            has changed.
        """
        self._read(line, -1 if seat is None else self._seat(seat))
        self._undone.clear()

    def undo(self) -> bool:
        """Take the last act back, by judging the lines before it again.

        Returns
        -------
        bool
            Whether there was one.
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
        """Do the act again that was undone last, unless another act followed. Returns whether there
        was one.
        """
        if not self._undone:
            return False
        for line in self._undone.pop():
            self._read(line, -1)
        return True

    def _seat(self, seat: int | None) -> int:
        return self.seat if seat is None else whole(seat, "seat", most=lib.CAROM_SEATS_MOST - 1)

    # The seat that acts is by default the one at the table.

    def call(self, ball: int, pocket: int = -1, *, seat: int | None = None) -> None:
        """Call the ball and the pocket of the next stroke; ball -1: a safety. In snooker it names a
        colour or a free ball.
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
        """Play a stroke of `cue_ball`, up to when `carom.simulate` would stop it.

        Returns
        -------
        bool
            Whether the shot has ended, and is ruled.
        """
        struck, stop = pointer("carom_cue[]", copied(one_cue(cue))), _stop(t_final, stop_at)
        return self._act(
            lambda: lib.carom_match_stroke(self._c, self._seat(seat), struck, stop, ffi.NULL), "cue"
        )

    def resume(
        self, *, t_final: float | None = None, stop_at: StopAt | Iterable[StopAt] = ()
    ) -> bool:
        """Go on with a shot that was stopped; t_final counts from its beginning."""
        stop = _stop(t_final, stop_at)
        return self._act(lambda: lib.carom_match_continue(self._c, stop, ffi.NULL), "t_final")

    def prepare(self, best: Records, *, seat: int | None = None) -> None:
        """Do what a choice of `plan` asks for before its stroke: place, push out and call; or pass,
        and no stroke follows.
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
        """Take a choice of `plan`: `prepare` it, and play its `stroke` unless it is a pass.

        `cue` is the stroke as the player makes it; by default that of the choice.
        """
        self.prepare(best, seat=seat)
        if best["kind"] == Kind.PASS:
            return True
        stroke = best["cue"] if cue is None else cue
        return self.stroke(stroke, t_final=t_final, stop_at=stop_at, seat=seat)

    def end(self) -> str:
        """The whole recording, with its last line: nothing follows but the next match of a set."""
        self._act(lambda: lib.carom_match_end(self._c), "end")
        return "".join(self.lines)

    # ---- Plans

    def plan(self, **wanted: Any) -> Records:
        """The best strokes of the seat at the table, with a cue ball in hand within `bounds`.

        `wanted` is as for `carom.plan`: player, opponent, shots, best, seed, ... By default the cue
        is that of the seat, and the player one of its rating. The opponent is the next seat of the
        other side, by its rating, else as strong as its strokes in this set show.
        """

        c = self.copy()._c  # whose text and cue a plan changes

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
    """Raises what C refuses, in its words."""
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
