"""Rules of games: what a shot amounts to, by the library's rules of eight-ball, nine-ball and a
drill, or by those of a game of one's own.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, cast, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import Leave as LeaveWord
from carom._described import Rules as RulesWord
from carom._described import Turn as TurnWord
from carom._rows import (
    Array,
    Arrays,
    as_array,
    choice,
    copied,
    listing,
    number,
    pointer,
    several,
    text_of,
    whole,
)
from carom._shot_options import Options
from carom.dtypes import Records
from carom.games._described import Foul, Group, Race
from carom.layouts import LAST, Table, of_record, one_cue
from carom.results import Label, Shot, Shots
from carom.shots import simulate_batch
from carom.status import CaromError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes

__all__ = ["Facts", "Foul", "Rules", "Ruling", "Turn", "Words", "referee"]
__dir__ = listing(__name__)

Game = RulesWord
State = NDArray[Any]
GivenState = Mapping[str, Any] | ArrayLike
Hand = Literal["no", "anywhere", "kitchen", "d", "baulk"]
GAMES = {word: k for k, word in enumerate(get_args(RulesWord))}
_GROUPS = {word: k for k, word in enumerate(get_args(Group))}
_TURNS = {word: k for k, word in enumerate(get_args(TurnWord))}
LEAVES = {word: k for k, word in enumerate(get_args(LeaveWord))}
_RACES = {word: k for k, word in enumerate(get_args(Race))}
_WORDS = 8  # of the state of rules of one's own
_USUAL = Options()
_NO_ROOM = "there is no room for a ball that comes back"
_MEMBERS = tuple(
    name for name in dtypes.rules_state.names or () if name not in ("user", "unused", "context")
)
_POCKETED, _OFF = int(Label.POCKETED), int(Label.OFF)  # with which NumPy compares in half the time


_A_LIST = "whole numbers are needed"


def _set_of(balls: Collection[int], name: str = "on", most: int = 31) -> int:
    return sum(1 << whole(ball, name, most=most) for ball in {*several(balls, name, _A_LIST)})


def of_set(bits: int) -> frozenset[int]:
    return frozenset(k for k in range(32) if bits >> k & 1)


@dataclass(frozen=True)
class Facts:
    """What happened in a shot, for `Rules.judge`."""

    first: int  # The ball that the cue ball met first, -1 for none, also after an error
    second: int  # The next other ball that it met, or -1
    cushions_before: tuple[
        int, int
    ]  # Impacts of the cue ball on cushions before it met each of both
    potted: Mapping[
        int, int
    ]  # The pocket that took each ball that fell, the cue ball 0 among them, in their order
    off: frozenset[int]  # Balls that left the table
    cushions: tuple[int, ...]  # Impacts of each ball on cushions
    cushions_after: int  # Those of all balls after the first contact
    frozen: frozenset[int]  # Balls that touched the cue ball when it was struck
    pushed: frozenset[int]  # Balls that it met before the tip left it
    jumped: frozenset[int]  # Balls that it flew over before it met one
    touches: int  # Of the tip: 1, or 2 and more of a double hit within the push; 0 without a strike
    cue_ball: int  # The ball that the cue struck
    _record: bytes = field(repr=False)  # Of C, which copies and pickles as they are

    def foul(self, on: Collection[int]) -> Foul:
        """The foul that it is in any game whose balls `on` may be met first: up to `Foul.CUSHION`,
        or `Foul.NONE`.
        """
        facts = ffi.from_buffer("carom_facts[]", self._record)
        return Foul(lib.carom_foul_of(facts, _set_of(on), self.cue_ball))


def _facts(record: Any, cue_ball: int) -> Facts:
    down = sorted(of_set(record.down), key=lambda ball: record.pocket_time[ball])
    potted = {ball: int(record.pocket[ball]) for ball in down}
    first, second = record.first
    cushions = (record.cushions_before[0], record.cushions_before[1])
    sets = [of_set(mask) for mask in (record.off, record.frozen, record.pushed, record.jumped)]
    return Facts(
        first,
        second,
        cushions,
        potted,
        sets[0],
        tuple(record.cushions),
        record.cushions_after,
        sets[1],
        sets[2],
        sets[3],
        record.touches,
        cue_ball,
        bytes(ffi.buffer(record)),
    )


def hand_of(leave: int) -> Hand:
    """Where a cue ball in hand may be put, by its `carom_leave`."""
    word = list(LEAVES)[leave]
    return cast("Hand", "no" if word in ("after", "before") else word)


@dataclass(frozen=True)
class Turn:
    """What a shot amounts to, from `Rules.judge`: the fields are its arguments.

    `turn`: who plays, or how the game ends; "pass": the other plays, or in a race of seats the one
    of `state.seat`, which with "win" has won. `leave`: his layout: as it is
    "after" the shot, as "before" it, or with the cue ball in hand, "anywhere", in the "kitchen"
    behind the head string, in the "d" of a snooker table or behind the "baulk" line. `foul`: a `Foul`. `spot`: balls that
    come back to the foot spot: any that are down or off the table, but the cue ball. `points`: of
    the shot; a plan reads them without an opponent only.
    """

    turn: TurnWord
    leave: LeaveWord = "after"
    foul: int = 0
    spot: Collection[int] = ()
    points: float = 0.0


class Words(list[int]):
    """The state of a game of one's own: eight numbers, and the seat at the table."""

    def __init__(self, numbers: Iterable[int], seat: int = 0) -> None:
        super().__init__(numbers)
        self.seat = seat


def _words(game: Any) -> Words:
    return Words(game.user, game.seat)


class Rules:
    """A game of one's own, for `plan`, `referee` and `Match`: a subclass says its rules.

    The cue ball is ball 0, or that of `facts.cue_ball`.

    `state` are eight numbers, as a list, for whatever the rules have to know: always as the player
    at the table has them. `judge` may change them, and leaves them as the next player has them.
    Balls in play are a frozenset of their indices.

    In a race of "seats" `state[k]` says what seat k has left, such as its lives; 0: it is out. The
    seat at the table is `state.seat`, and `judge` sets it to the one that plays next.
    """

    race: Race = "own"
    """Whose balls are to be potted: each player has his own, both have the same, or there is no
    opponent. "points": both make points, and `left` says how many each needs. "seats": 2 to 8 seats
    play each for itself.
    """
    any_cue_ball: bool = False
    """Whether a player may strike any ball."""
    calls: bool = False
    """Whether ball and pocket are called."""
    first_decides: bool = False
    """Whether a shot that first meets a ball that is not on is a foul, whatever else happens: it is
    not played to its end.
    """

    def on(self, state: Words, in_play: frozenset[int]) -> Collection[int]:
        """The balls that may be met first, and potted."""
        raise NotImplementedError(f"{type(self).__name__} needs the method on(state, in_play)")

    def judge(
        self, state: Words, in_play: frozenset[int], facts: Facts, call: tuple[int, int]
    ) -> Turn:
        """What a shot amounts to; `in_play` were the balls before it, `call` is a ball and its
        pocket, or (-1, -1).
        """
        raise NotImplementedError(
            f"{type(self).__name__} needs the method judge(state, in_play, facts, call)"
        )

    def left(self, state: Words, in_play: frozenset[int]) -> tuple[int, int]:
        """How many balls the player at the table, and the other, have to pot to win."""
        raise NotImplementedError(f"{type(self).__name__} needs the method left(state, in_play)")

    def pockets(self, state: Words) -> Collection[int]:
        """The pockets in which balls count, by their indices in `table.pocket_names`.

        Default: all.
        """
        return range(8)

    def value(self, state: Words, layout: Records, in_hand: bool) -> float:
        """The chance that the player at the table wins from a layout, 0 to 1: an array of
        `carom.dtypes.ball_state`, shape (balls,). Without an opponent: how many balls the player is
        still going to pot.

        Default: an estimate from the two best pots and from `left`. A plan in a race of seats needs
        yours.
        """
        raise NotImplementedError

    def points(self, state: Words, in_play: frozenset[int], ball: int) -> float:
        """In a race for points: the points of a ball that falls in the next stroke; for ball -1 the
        mean points of a later pot.

        Default: 1.
        """
        raise NotImplementedError

    def settle(self, state: Words, table: Table, balls: Records, turn: Turn) -> Turn:
        """Do what depends on the places of the balls after a stroke that was judged: return the
        turn, changed or not. `balls` is an array of `carom.dtypes.shot_ball`, shape (balls,); what
        is written to it and to `state` stays.

        Default: puts the balls of `turn.spot` on the foot spot, or behind it. Rules of your own do
        so by `super().settle(...)`.
        """
        for ball in sorted(turn.spot):
            code = lib.carom_spot_ball(
                pointer("carom_table *", table.record),
                pointer("carom_shot_ball[]", balls),
                len(balls),
                ball,
            )
            if code < 0:
                raise CaromError(code, "Turn.spot", text=_NO_ROOM)
        return turn


_OPTIONAL = ("pockets", "value", "points", "settle")
_CHANCE = "a chance of 0 to 1 is needed, or without an opponent a number of balls"


def _array_of(address: Any, count: int, dtype: np.dtype[Any]) -> Array:
    """Records of C, which are written where they are."""
    array: Array = np.frombuffer(ffi.buffer(address, count * dtype.itemsize), dtype)
    return array


def _turn_of(turn: Any) -> Turn:
    """A turn of C."""
    words = {number: word for word, number in _TURNS.items()}
    leaves = {number: word for word, number in LEAVES.items()}
    return Turn(
        cast("Any", words[turn.outcome]),
        cast("Any", leaves[turn.leave]),
        Foul(turn.foul),
        of_set(turn.spot),
        turn.points,
    )


def _write_turn(target: Any, turn: Any, method: str) -> None:
    """What a method of rules returned, to a turn of C."""
    if not isinstance(turn, Turn):
        raise TypeError(f"{method}: it must return a carom.Turn, not {turn!r}")
    target.outcome = choice(_TURNS, turn.turn, "Turn.turn")
    target.leave = choice(LEAVES, turn.leave, "Turn.leave")
    target.foul, target.spot = int(turn.foul), _set_of(turn.spot, "Turn.spot")
    target.points = _finite(turn.points, "Turn.points", "points are needed")


def _finite(value: object, name: str, needed: str) -> float:
    finite = number(value, name, needed)
    if not np.isfinite(finite):
        raise ValueError(f"{name}: {needed}, not {finite}")
    return finite


def _check_settled(table: Any, balls: Any, count: int, turn: Any, cue_ball: int) -> None:
    """Refuses balls that settle() laid where none can lie; a cue ball in hand may lie anywhere."""
    where = ffi.new("int *")
    code = lib.carom_shot_check(table, balls, count, ffi.NULL, ffi.NULL, where)
    in_hand = turn.leave >= lib.CAROM_LEAVE_ANYWHERE and where[0] == cue_ball
    if code < 0 and not in_hand:
        raise CaromError(code, f"settle: balls[{where[0]}]")


class Made:
    """The rules for C, with what has to live as long; and the first exception of a method of Rules."""

    def __init__(
        self,
        rules: Game | Rules,
        state: GivenState | None,
        group: Group | None = None,
        opening: bool = False,
    ) -> None:
        self.raised: BaseException | None = None
        self.callbacks: list[Any] = []
        self.cue_ball = 0
        """Of the last stroke that rules of one's own judged."""
        self.rules = rules
        self.stop = ffi.new("int32_t *")
        """Of plans; set by an exception."""
        if isinstance(rules, type) and issubclass(rules, Rules):
            raise ValueError(
                f"rules: give a game, {rules.__name__}(), not the class {rules.__name__}"
            )
        if isinstance(rules, Rules):
            self.c = ffi.new("carom_plan_rules *")
            self._functions(rules)
            self.c.race = choice(_RACES, rules.race, "rules.race")
            for name in ("calls", "first_decides", "any_cue_ball"):
                setattr(self.c, name, bool(getattr(rules, name)))
        else:
            self.c = ffi.new(
                "carom_plan_rules *", lib.carom_plan_rules_of(choice(GAMES, rules, "rules"))
            )
        self.last = None if isinstance(rules, Rules) else LAST.get(rules)
        """The highest number of a ball."""
        if state is not None:
            for is_given, name in ((group is not None, "group"), (opening, "opening")):
                if is_given:
                    raise ValueError(
                        f"state, {name}: the state says the {name}, too: give one of both"
                    )
            self._stand(state)
        self.c.state.group += choice(_GROUPS, "open" if group is None else group, "group")
        self.c.state.opening |= bool(opening)
        if not isinstance(rules, Rules):
            wrong = lib.carom_rules_fault(
                GAMES[rules], ffi.addressof(self.c, "state"), limits := ffi.new("char **")
            )
            if wrong:
                raise ValueError(
                    f"{text_of(wrong)}: by the rules {rules} it must be {text_of(limits[0])}"
                )

    @property
    def state(self) -> State:
        """A copy of the state, of shape ()."""
        return np.frombuffer(
            bytearray(ffi.buffer(ffi.addressof(self.c, "state"))), dtypes.rules_state
        ).reshape(())

    def _stand(self, values: Any) -> None:
        """A record; or of a game some members by their names, of rules of one's own eight words."""
        members: Any = values
        if isinstance(self.rules, Rules):
            words = as_array(values, "state")
            if words.shape != (_WORDS,) or words.dtype.kind not in "iu" or (words < 0).any():
                raise ValueError(
                    f"state: {_WORDS} whole numbers, at least 0, are needed, not {values!r}"
                )
            members = {"user": words, "seat": getattr(values, "seat", 0)}
        elif not isinstance(values, Mapping):
            record = of_record(values, dtypes.rules_state, "state", "referee().state")
            members = {name: record[name] for name in _MEMBERS}
        for name, value in members.items():
            if not hasattr(self.c.state, name):
                raise ValueError(f"state: there is no {name!r}; there are {', '.join(_MEMBERS)}")
            try:
                setattr(
                    self.c.state,
                    name,
                    choice(_GROUPS, value, "state: group")
                    if isinstance(value, str)
                    else np.asarray(value).tolist(),
                )
            except (TypeError, OverflowError, IndexError) as wrong:
                raise ValueError(f"state: {name}: {wrong}") from None

    def _functions(self, rules: Rules) -> None:
        """The methods as functions for C."""

        def guarded(kind: str, call: Callable[..., Any], otherwise: Any) -> Any:
            def failed(kind: Any, value: BaseException, trace: Any) -> None:
                self.raised = self.raised or value
                self.stop[0] = 1

            return ffi.callback(kind, call, error=otherwise, onerror=failed)

        def keep(game: Any, state: Words, method: str) -> None:
            game.seat = whole(state.seat, f"{method}: state.seat", most=lib.CAROM_SEATS_MOST - 1)
            game.user = [
                whole(word, f"{method}: state[{k}]", most=2**64 - 1) for k, word in enumerate(state)
            ]

        def judge(game: Any, in_play: int, cue_ball: int, facts: Any, call: Any) -> Any:
            state, self.cue_ball = _words(game), cue_ball
            turn = rules.judge(
                state, of_set(in_play), _facts(facts, cue_ball), (call.ball, call.pocket)
            )
            keep(game, state, "judge")
            c_turn = ffi.new("carom_turn *")
            _write_turn(c_turn, turn, "judge")
            spots = of_set(c_turn.spot & (in_play & ~(facts.down | facts.off) | 1 << cue_ball))
            if spots:
                raise ValueError(
                    f"Turn.spot: balls come back that are down or off the table, not the cue ball, and not {sorted(spots)}"
                )
            return c_turn[0]

        def left(game: Any, in_play: int, out: Any) -> None:
            both = several(rules.left(_words(game), of_set(in_play)), "left", _A_LIST)
            if len(both) != 2:
                raise ValueError(f"left: two numbers are needed, not {both}")
            out[0:2] = whole(both[0], "left"), whole(both[1], "left")

        def on(game: Any, in_play: int) -> int:
            return _set_of(rules.on(_words(game), of_set(in_play)))

        def pockets(game: Any) -> int:
            return _set_of(rules.pockets(_words(game)), "pockets", lib.CAROM_POCKETS_MOST - 1)

        def value(game: Any, layout: Any, count: int, in_hand: int) -> float:
            states = _array_of(layout, count, dtypes.ball_state).copy()
            worth = _finite(rules.value(_words(game), states, bool(in_hand)), "value", _CHANCE)
            if not 0.0 <= worth <= (count if rules.race == "alone" else 1.0):
                raise ValueError(f"value: {_CHANCE}, not {worth}")
            return worth

        def points(game: Any, in_play: int, ball: int) -> float:
            points = rules.points(_words(game), of_set(in_play), ball)
            return _finite(points, "points", "points are needed")

        def settle(game: Any, table: Any, balls: Any, count: int, turn: Any) -> None:
            if self.raised is not None:
                return  # judge() has no turn that could be settled
            state = _words(game)
            on_table = Table.from_record(_array_of(table, 1, dtypes.table)[0])
            layout = _array_of(balls, count, dtypes.shot_ball)
            word = rules.settle(state, on_table, layout, _turn_of(turn))
            keep(game, state, "settle")
            _write_turn(turn, word, "settle")
            _check_settled(table, balls, count, turn, self.cue_ball)

        lost = ffi.new("carom_turn *", {"outcome": lib.CAROM_TURN_LOSE})[0]
        methods: dict[str, tuple[Callable[..., Any], Any]] = {
            "judge": (judge, lost),
            "left": (left, None),
            "on": (on, 0),
            "pockets": (pockets, 0),
            "value": (value, 0.0),
            "points": (points, 0.0),
            "settle": (settle, None),
        }
        for name, (call, otherwise) in methods.items():
            # The library has its own of those that a class may leave out.
            if name in _OPTIONAL and getattr(type(rules), name) is getattr(Rules, name):
                continue
            self.callbacks.append(guarded(f"carom_rules_{name} *", call, otherwise))
            setattr(self.c, name, self.callbacks[-1])

    def check_layout(self, table: Table, layout: Records) -> None:
        """Refuses what is no layout of the game, for a plan."""
        pockets = len(table.pocket_names)
        is_named = isinstance(self.rules, str)
        is_carom = is_named and self.c.rack in (
            lib.CAROM_RACK_THREECUSHION,
            lib.CAROM_RACK_FOURBALL,
        )
        size = lib.carom_rack_size(self.c.rack)
        if is_carom and (pockets or len(layout) < size):
            raise ValueError(
                f"table: {self.rules} needs one without pockets"
                if pockets
                else f"balls: {self.rules} needs {'three' if size == 3 else 'four'}"
            )
        if is_named and not is_carom and not pockets:
            raise ValueError(f"table: it has no pockets, which {self.rules} needs")
        label = layout["state"]["label"]
        for ball in range(len(layout) if self.last is None else self.last + 1, len(layout)):
            if label[ball] not in (_POCKETED, _OFF):
                raise ValueError(
                    f"balls: the balls of {self.rules} are the cue ball and 1 to {self.last}, not {ball}"
                )
        if self.c.race == lib.CAROM_RACE_SEATS and self.c.value == ffi.NULL:
            raise ValueError("rules: a plan in a race of seats needs the method value()")
        self.check_count(len(layout))

    def check_count(self, count: int) -> None:
        """Refuses a layout in which balls are missing that may come back. In eight-ball they come
        back for a new break alone, which the referee refuses without them.
        """
        is_built_in = not isinstance(self.rules, Rules) and self.rules != "eightball"
        if is_built_in and self.c.settle and count <= (self.last or 0):
            raise ValueError(
                f"balls: {self.rules} has the cue ball and 1 to {self.last}, of which some may be down, not {count} balls"
            )

    def check(self) -> None:
        """Raises what a method of the rules raised, once."""
        raised, self.raised = self.raised, None
        if raised is not None:
            raise raised


_bits: NDArray[np.uint32] = np.uint32(1) << np.arange(32, dtype=np.uint32)


def judge(
    game: Made,
    layout: Records,
    shots: Shots,
    states: State | None = None,
    calls: Array | None = None,
) -> Array:
    """What shots with facts amount to, as `carom.dtypes.turn`, from the layouts before them, of
    shape (..., balls).

    `states` are changed; by default each shot has that of the rules. `calls` are int32 of shape
    (..., 2); by default none.
    """
    label = layout["state"]["label"]
    in_play = ((label != _POCKETED) & (label != _OFF)) @ _bits[: label.shape[-1]]
    turns: Array = np.zeros(shots.shape, dtypes.turn)
    lib.carom_python_judge(
        game.c,
        turns.size,
        pointer("int8_t[]", shots.status),
        pointer("carom_facts[]", shots._facts),
        pointer("uint32_t[]", in_play),
        ffi.NULL if calls is None else pointer("carom_call[]", calls),
        ffi.NULL if states is None else pointer("carom_rules_state[]", states),
        pointer("carom_turn[]", turns),
    )
    game.check()
    return turns


def on_of(game: Made, layout: Records) -> tuple[int, ...]:
    """The balls of a layout, of shape (balls,), that may be met first."""
    label = layout["state"]["label"]
    return tuple(
        sorted(
            of_set(
                int(
                    game.c.on(
                        ffi.addressof(game.c, "state"),
                        int(((label != _POCKETED) & (label != _OFF)) @ _bits[: label.shape[-1]]),
                    )
                )
            )
        )
    )


def calls_of(game: Made, layout: Records, shots: Shots) -> Array:
    """The calls of shots with facts from a layout, int32 of shape (..., 2): the first ball on that
    falls, and its pocket; or -1, -1.
    """
    facts: Any = shots._facts
    falls = np.full(facts["pocket_time"].shape, np.inf)
    targets = [*on_of(game, layout)]
    falls[..., targets] = facts["pocket_time"][..., targets]
    ball = falls.argmin(axis=-1)
    pocket = np.take_along_axis(facts["pocket"], ball[..., np.newaxis], axis=-1)[..., 0]
    calls: Array = np.stack([np.where(pocket < 0, -1, ball), pocket], axis=-1).astype(np.int32)
    calls[~np.isfinite(falls.min(axis=-1))] = -1
    return calls


@dataclass(frozen=True, repr=False)
class Ruling(Arrays):
    """What a stroke was, and what comes next."""

    # "keep": the player plays on; "pass": the other plays; "win", "lose", "draw": the game
    # has ended
    turn: str
    foul: Foul
    # Whether the next player has the cue ball in hand: anywhere, behind the head string, or in the
    # D of a snooker table
    hand: Hand
    potted: tuple[int, ...]  # Balls that fell, the cue ball among them, in their order
    first: int  # The ball that the cue ball met first, -1 for none
    points: float
    balls: (
        Records  # (balls,): The next layout. A cue ball in hand is where the shot left it, or down.
    )
    put: frozenset[int]  # Balls that lie elsewhere than the shot left them
    # (): How the game stands for the next player, `carom.dtypes.rules_state`; of rules of one's own
    # eight numbers
    state: State
    seat: int  # The next seat in a race of seats: Words(state, seat) is the state of own rules
    score: tuple[
        int, int
    ]  # Points, or balls, of the next player and of the other, less those that they lost or owe
    # Of the shot: both balls that the cue ball met, its cushions before each, and more; no ball was
    # met in one that ended in an error
    facts: Facts
    words: str  # All of that in words
    shot: Shot


def referee(
    table: Table,
    balls: Records,
    cue: Records,
    *,
    rules: Game | Rules = "eightball",
    group: Group | None = None,
    opening: bool = False,
    state: GivenState | None = None,
    call: tuple[int, int] = (-1, -1),
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Ruling:
    """Play a stroke and judge it by the rules of a game.

    Parameters
    ----------
    table : Table
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        As for `plan`; the cue ball is that of the cue.
    cue : ndarray of `carom.dtypes.cue`, shape ()
    rules, group, opening, state
        As for `plan`. The `state` of a ruling is that for the next stroke.
    call : tuple of two ints
        The ball and the pocket that are called: `ball` and `pocket` of a choice of `plan`, which
        say a push-out and a pass, too. The other choices that `state["may"]` allows are the balls
        -4 (racked again, the player breaks), -5 (racked again, the other breaks), -6 (the cue ball
        stays) and -7 (touching balls go to their spots; or, on a table with pockets, the ball
        nearest to the head string goes to the foot spot).
    options, **changes
        As for `simulate`.

    Raises
    ------
    CaromError
        The layout or the cue is in error. A shot that ends in an error is a foul, whose layout is
        taken back.
    """
    layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
    game = Made(rules, state, group, opening)
    game.check_count(layout.shape[-1])
    strike = one_cue(cue).copy()
    cue_ball = int(strike["ball"])
    if call[0] <= lib.CAROM_CALL_PASS:  # a choice without a stroke
        strike["speed"] = 0.0
    shots = simulate_batch(
        table,
        layout[np.newaxis],
        strike[np.newaxis],
        room=512,
        features=True,
        options=options,
        **changes,
    )
    failed = shots.status[0] < 0
    if shots.refused[0]:
        raise CaromError(int(shots.status[0]), "balls, cue")
    ruling = ffi.new("carom_ruling *")
    seen = ffi.new(
        "carom_shot *",
        {
            "facts": pointer("carom_facts *", shots._facts),
            "final": pointer("carom_ball_state[]", shots.final),
        },
    )
    called = ffi.new(
        "carom_call *",
        [whole(call[0], "call", least=lib.CAROM_CALL_SPOT), whole(call[1], "call", least=-1)],
    )
    code = lib.carom_referee(
        game.c,
        pointer("carom_table *", table.record),
        pointer("carom_shot_ball[]", layout),
        len(layout),
        cue_ball,
        ffi.NULL if failed else seen,
        called[0],
        ruling,
    )
    game.check()
    beyond = [ball for ball in of_set(ruling.turn.spot) if ball >= len(layout)]
    if beyond:
        raise ValueError(f"Turn.spot: there are {len(layout)} balls, none is {beyond[0]}")
    if code < 0:
        raise CaromError(code, "Turn.spot", text=_NO_ROOM)
    return ruling_of(ruling, len(layout), isinstance(rules, Rules), shots[0], cue_ball)


def words_of(write: Callable[[Any, int], int]) -> str:
    """The words of a ruling or a match that C writes to a text with room."""
    words = ffi.new("char[]", 1024)
    write(words, 1024)
    return text_of(words)


def ruling_of(ruling: Any, count: int, is_own: bool, shot: Shot, cue_ball: int) -> Ruling:
    """A ruling of C for so many balls."""
    facts, turn = _facts(ffi.addressof(ruling, "facts"), cue_ball), ruling.turn
    size = count * dtypes.shot_ball.itemsize
    layout = np.frombuffer(ffi.buffer(ruling.balls, size), dtypes.shot_ball).copy()
    state = (
        np.frombuffer(ffi.buffer(ffi.addressof(ruling, "state")), dtypes.rules_state)
        .copy()
        .reshape(())
    )
    return Ruling(
        tuple(_TURNS)[turn.outcome],
        Foul(turn.foul),
        hand_of(turn.leave),
        tuple(facts.potted),
        facts.first,
        turn.points,
        layout,
        of_set(ruling.put),
        state["user"] if is_own else state,
        int(state["seat"]),
        tuple((state["score"] - state["lost"]).tolist()),
        facts,
        words_of(lambda *text: lib.carom_ruling_string(ruling, *text)),
        shot,
    )
