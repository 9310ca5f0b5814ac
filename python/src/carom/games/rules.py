"""Rules of games: rulings on shots by the built-in games or by custom rules."""

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
    named,
    number,
    pointer,
    several,
    text_of,
    unknown_name,
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
_WORDS = 8  # of the state of custom rules
_USUAL = Options()
_NO_ROOM = "there is no room to spot a ball"
_MEMBERS = tuple(
    name for name in dtypes.rules_state.names or () if name not in ("user", "unused", "context")
)
_POCKETED, _OFF = int(Label.POCKETED), int(Label.OFF)  # with which NumPy compares in half the time


_A_LIST = "a list of integers"


def _set_of(balls: Collection[int], name: str = "on", most: int = 31) -> int:
    return sum(1 << whole(ball, name, most=most) for ball in {*several(balls, name, _A_LIST)})


def of_set(bits: int) -> frozenset[int]:
    return frozenset(k for k in range(32) if bits >> k & 1)


@dataclass(frozen=True)
class Facts:
    """The facts of a shot, for `Rules.judge`."""

    first: int  # First ball that the cue ball hit; -1: none, or the shot failed
    second: int  # Second different ball that it hit, or -1
    cushions_before: tuple[
        int, int
    ]  # Impacts of the cue ball on cushions before each of these contacts
    potted: Mapping[int, int]  # Pocket of each ball that fell, including the cue ball 0, in order
    off: frozenset[int]  # Balls that left the table
    cushions: tuple[int, ...]  # Impacts of each ball on cushions
    cushions_after: int  # Impacts of all balls on cushions after the first contact
    frozen: frozenset[int]  # Balls that touched the cue ball when it was struck
    pushed: frozenset[int]  # Balls that it hit before the tip left it
    jumped: frozenset[int]  # Balls that it flew over before it hit one
    touches: int  # Contacts of the tip: 1; 2 or more: a double hit within the push; 0: no strike
    cue_ball: int  # The ball that the cue struck
    _record: bytes = field(repr=False)  # The C record, for copying and pickling

    def foul(self, on: Collection[int]) -> Foul:
        """The foul common to all games in which the balls `on` may be hit first.

        One of the fouls up to `Foul.CUSHION`, or `Foul.NONE`.
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
    """The area for a cue ball in hand, from a `carom_leave`."""
    word = list(LEAVES)[leave]
    return cast("Hand", "no" if word in ("after", "before") else word)


@dataclass(frozen=True)
class Turn:
    """The ruling on a shot, returned by `Rules.judge`.

    Parameters
    ----------
    turn : {"keep", "pass", "win", "lose", "draw"}
        Who plays next, or how the game ends. In a race of seats "pass" and "win" refer to
        `state.seat`.
    leave : {"after", "before", "anywhere", "kitchen", "d", "baulk"}
        The next layout: as "after" or "before" the shot; or with the cue ball in hand anywhere, in
        the kitchen behind the head string, in the D of a snooker table, or behind the baulk line.
    foul : int
        A `Foul`.
    spot : collection of int
        Balls to spot on the foot spot. They must be pocketed or off the table, and not the cue
        ball.
    points : float
        Points of the shot; a plan uses them only without an opponent.
    """

    turn: TurnWord
    leave: LeaveWord = "after"
    foul: int = 0
    spot: Collection[int] = ()
    points: float = 0.0


class Words(list[int]):
    """The state of custom rules: eight integers, and the seat at the table."""

    def __init__(self, numbers: Iterable[int], seat: int = 0) -> None:
        super().__init__(numbers)
        self.seat = seat


def _words(game: Any) -> Words:
    return Words(game.user, game.seat)


class Rules:
    """Custom rules, for `plan`, `referee` and `Match`: a subclass defines a game.

    The cue ball is ball 0, or `facts.cue_ball`.

    `state` is a list of eight integers for any purpose, seen from the player at the table. `judge`
    may change it, and leaves it as seen from the next player. Balls in play are a frozenset of
    indices.

    In a race of "seats" `state[k]` is what seat k has left, such as its lives; at 0 it is out. The
    seat at the table is `state.seat`, and `judge` sets it to the next one.
    """

    race: Race = "own"
    """The kind of race. "own": each player pots separate balls. "shared": both pot the same balls.
    "alone": there is no opponent. "points": both score points, and `left` returns how many each
    needs. "seats": 2 to 8 seats play for themselves.
    """
    any_cue_ball: bool = False
    """Whether a player may strike any ball as cue ball."""
    calls: bool = False
    """Whether ball and pocket are called."""
    first_decides: bool = False
    """Whether hitting a ball first that is not on is always a foul. Such a shot is not played to
    its end.
    """

    def on(self, state: Words, in_play: frozenset[int]) -> Collection[int]:
        """Return the balls that may be hit first and potted."""
        raise NotImplementedError(f"{type(self).__name__} needs the method on(state, in_play)")

    def judge(
        self, state: Words, in_play: frozenset[int], facts: Facts, call: tuple[int, int]
    ) -> Turn:
        """Return the ruling on a shot.

        `in_play` are the balls in play before it; `call` is a ball and a pocket, or (-1, -1).
        """
        raise NotImplementedError(
            f"{type(self).__name__} needs the method judge(state, in_play, facts, call)"
        )

    def left(self, state: Words, in_play: frozenset[int]) -> tuple[int, int]:
        """Return how many balls the player at the table and the other must pot to win."""
        raise NotImplementedError(f"{type(self).__name__} needs the method left(state, in_play)")

    def pockets(self, state: Words) -> Collection[int]:
        """Return the indices in `table.pocket_names` of the pockets in which balls count.

        Default: all.
        """
        return range(8)

    def value(self, state: Words, layout: Records, in_hand: bool) -> float:
        """Return the chance that the player at the table wins from a layout, 0 to 1.

        `layout` is an array of `carom.dtypes.ball_state`, shape (balls,). Without an opponent,
        return the number of balls that the player will still pot.

        Default: an estimate from the two best pots and from `left`. A plan in a race of seats
        requires this method.
        """
        raise NotImplementedError

    def points(self, state: Words, in_play: frozenset[int], ball: int) -> float:
        """In a race for points, return the points of a ball that falls in the next stroke.

        For ball -1, return the mean points of a later pot. Default: 1.
        """
        raise NotImplementedError

    def settle(self, state: Words, table: Table, balls: Records, turn: Turn) -> Turn:
        """Apply rules that depend on the final positions of the balls, and return the turn.

        `balls` is an array of `carom.dtypes.shot_ball`, shape (balls,). Changes to it and to
        `state` persist.

        Default: places the balls of `turn.spot` on the foot spot or behind it. An override calls
        `super().settle(...)` for this.
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
_CHANCE = "a chance of 0 to 1, or without an opponent a number of balls"


def _array_of(address: Any, count: int, dtype: np.dtype[Any]) -> Array:
    """Records of C as an array that shares their memory."""
    array: Array = np.frombuffer(ffi.buffer(address, count * dtype.itemsize), dtype)
    return array


def _turn_of(turn: Any) -> Turn:
    """A `Turn` from a turn of C."""
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
    """Write the result of a method of rules to a turn of C."""
    if not isinstance(turn, Turn):
        raise TypeError(f"{method}: it returned {turn!r}, but must return a carom.Turn")
    target.outcome = choice(_TURNS, turn.turn, "Turn.turn")
    target.leave = choice(LEAVES, turn.leave, "Turn.leave")
    target.foul, target.spot = int(turn.foul), _set_of(turn.spot, "Turn.spot")
    target.points = _finite(turn.points, "Turn.points", "a number of points")


def _finite(value: object, name: str, needed: str) -> float:
    finite = number(value, name, needed)
    if not np.isfinite(finite):
        raise ValueError(f"{name}: {finite} is not {needed}")
    return finite


def _check_settled(table: Any, balls: Any, count: int, turn: Any, cue_ball: int) -> None:
    """Raise an error if settle() placed a ball where it cannot be; a cue ball in hand may be
    anywhere.
    """
    where = ffi.new("int *")
    code = lib.carom_shot_check(table, balls, count, ffi.NULL, ffi.NULL, where)
    in_hand = turn.leave >= lib.CAROM_LEAVE_ANYWHERE and where[0] == cue_ball
    if code < 0 and not in_hand:
        raise CaromError(code, f"settle: balls[{where[0]}]")


class Made:
    """The rules for C, with the objects that must live as long, and the first exception of a
    method.
    """

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
        """The cue ball of the last stroke that custom rules judged."""
        self.rules = (
            rules if isinstance(rules, (Rules, type)) else cast(Game, named(GAMES, rules, "rules"))
        )
        self.stop = ffi.new("int32_t *")
        """The stop flag of plans; an exception sets it."""
        if isinstance(rules, type) and issubclass(rules, Rules):
            raise ValueError(
                f"rules: {rules.__name__} is a class; pass an instance, {rules.__name__}()"
            )
        if isinstance(rules, Rules):
            self.c = ffi.new("carom_plan_rules *")
            self._functions(rules)
            self.c.race = choice(_RACES, rules.race, "rules.race")
            for name in ("calls", "first_decides", "any_cue_ball"):
                setattr(self.c, name, bool(getattr(rules, name)))
        else:
            self.c = ffi.new("carom_plan_rules *", lib.carom_plan_rules_of(GAMES[self.rules]))
        self.last = None if isinstance(self.rules, Rules) else LAST.get(self.rules)
        """The highest ball number."""
        if state is not None:
            for is_given, name in ((group is not None, "group"), (opening, "opening")):
                if is_given:
                    raise ValueError(f"state, {name}: the state contains the {name}, too; omit one")
            self._stand(state)
        self.c.state.group += choice(_GROUPS, "open" if group is None else group, "group")
        self.c.state.opening |= bool(opening)
        if not isinstance(self.rules, Rules):
            wrong = lib.carom_rules_fault(
                GAMES[self.rules], ffi.addressof(self.c, "state"), limits := ffi.new("char **")
            )
            if wrong:
                raise ValueError(
                    f"{text_of(wrong)}: out of range; in the game {self.rules!r} it must be {text_of(limits[0])}"
                )

    @property
    def state(self) -> State:
        """A copy of the state, of shape ()."""
        return np.frombuffer(
            bytearray(ffi.buffer(ffi.addressof(self.c, "state"))), dtypes.rules_state
        ).reshape(())

    def _stand(self, values: Any) -> None:
        """Set the state from a record; from members of a game by name; or from eight integers of
        custom rules.
        """
        members: Any = values
        if isinstance(self.rules, Rules):
            words = as_array(values, "state")
            if words.shape != (_WORDS,) or words.dtype.kind not in "iu" or (words < 0).any():
                raise ValueError(f"state: {values!r} are not {_WORDS} integers of at least 0")
            members = {"user": words, "seat": getattr(values, "seat", 0)}
        elif not isinstance(values, Mapping):
            record = of_record(values, dtypes.rules_state, "state", "referee().state")
            members = {name: record[name] for name in _MEMBERS}
        for name, value in members.items():
            if not hasattr(self.c.state, name):
                raise ValueError(unknown_name("state", "member", name, _MEMBERS))
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
                    f"Turn.spot: balls {sorted(spots)} cannot be spotted; spot balls that are pocketed or off the table, but not the cue ball"
                )
            return c_turn[0]

        def left(game: Any, in_play: int, out: Any) -> None:
            both = several(rules.left(_words(game), of_set(in_play)), "left", _A_LIST)
            if len(both) != 2:
                raise ValueError(
                    f"left: {both} are not two numbers; return what the player and the other need"
                )
            out[0:2] = whole(both[0], "left"), whole(both[1], "left")

        def on(game: Any, in_play: int) -> int:
            return _set_of(rules.on(_words(game), of_set(in_play)))

        def pockets(game: Any) -> int:
            return _set_of(rules.pockets(_words(game)), "pockets", lib.CAROM_POCKETS_MOST - 1)

        def value(game: Any, layout: Any, count: int, in_hand: int) -> float:
            states = _array_of(layout, count, dtypes.ball_state).copy()
            worth = _finite(rules.value(_words(game), states, bool(in_hand)), "value", _CHANCE)
            if not 0.0 <= worth <= (count if rules.race == "alone" else 1.0):
                raise ValueError(f"value: {worth} is not {_CHANCE}")
            return worth

        def points(game: Any, in_play: int, ball: int) -> float:
            points = rules.points(_words(game), of_set(in_play), ball)
            return _finite(points, "points", "a number of points")

        def settle(game: Any, table: Any, balls: Any, count: int, turn: Any) -> None:
            if self.raised is not None:
                return  # judge() returned no turn to settle
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
            # The library has defaults for methods that a class omits.
            if name in _OPTIONAL and getattr(type(rules), name) is getattr(Rules, name):
                continue
            self.callbacks.append(guarded(f"carom_rules_{name} *", call, otherwise))
            setattr(self.c, name, self.callbacks[-1])

    def check_layout(self, table: Table, layout: Records) -> None:
        """Raise an error if a layout is not one of the game, for a plan."""
        pockets = len(table.pocket_names)
        is_named = isinstance(self.rules, str)
        is_carom = is_named and self.c.rack in (
            lib.CAROM_RACK_THREECUSHION,
            lib.CAROM_RACK_FOURBALL,
        )
        size = lib.carom_rack_size(self.c.rack)
        if is_carom and (pockets or len(layout) < size):
            raise ValueError(
                f"table: it has pockets, but {self.rules} needs a table without them"
                if pockets
                else f"balls: there are {len(layout)}, but {self.rules} needs {'three' if size == 3 else 'four'}"
            )
        if is_named and not is_carom and not pockets:
            raise ValueError(f"table: it has no pockets, but {self.rules} needs them")
        label = layout["state"]["label"]
        for ball in range(len(layout) if self.last is None else self.last + 1, len(layout)):
            if label[ball] not in (_POCKETED, _OFF):
                raise ValueError(
                    f"balls: there is no ball {ball} in {self.rules}; its balls are the cue ball and 1 to {self.last}"
                )
        if self.c.race == lib.CAROM_RACE_SEATS and self.c.value == ffi.NULL:
            raise ValueError(
                "rules: the method value() is missing; a plan in a race of seats needs it"
            )
        self.check_count(len(layout))

    def check_count(self, count: int) -> None:
        """Raise an error if balls are missing that may be spotted.

        In eight-ball balls return only for a new break, which the referee rejects without them.
        """
        is_built_in = not isinstance(self.rules, Rules) and self.rules != "eightball"
        if is_built_in and self.c.settle and count <= (self.last or 0):
            raise ValueError(
                f"balls: there are {count}, but {self.rules} needs the cue ball and 1 to {self.last}; pocketed balls count too"
            )

    def check(self) -> None:
        """Raise the exception of a method of the rules, once."""
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
    """Judge shots with facts: `carom.dtypes.turn`, from the layouts (..., balls) before them.

    `states` is modified; by default each shot has the state of the rules. `calls` is int32 of shape
    (..., 2); by default there are none.
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
    """The balls of a layout, shape (balls,), that may be hit first."""
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
    """The calls of shots with facts from a layout, int32 of shape (..., 2).

    Each is the first ball on that falls, and its pocket; or -1, -1.
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
    """The ruling on a stroke, and the next situation."""

    # "keep": the player plays again; "pass": the other plays; "win", "lose", "draw": the game has
    # ended
    turn: str
    foul: Foul
    # Whether the next player has the cue ball in hand: anywhere, behind the head string, or in the
    # D of a snooker table
    hand: Hand
    potted: tuple[int, ...]  # Balls that fell, including the cue ball, in order
    first: int  # First ball that the cue ball hit; -1: none
    points: float
    balls: (
        Records  # (balls,): The next layout. A cue ball in hand is where the shot left it, or down.
    )
    put: frozenset[int]  # Balls that the ruling moved
    # (): State of the game for the next player, `carom.dtypes.rules_state`; eight integers for custom
    # rules
    state: State
    seat: int  # Next seat in a race of seats; Words(state, seat) is the state of custom rules
    score: tuple[int, int]  # Points, or balls, of the next player and of the other, minus penalties
    # Facts of the shot: the balls that the cue ball hit, its cushions before each, and more; a failed
    # shot has no contacts
    facts: Facts
    words: str  # The ruling as a sentence
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
        As for `plan`; the cue ball is the one in `cue`.
    cue : ndarray of `carom.dtypes.cue`, shape ()
    rules, group, opening, state
        As for `plan`. The `state` of a ruling is the state for the next stroke.
    call : tuple of two ints
        The called ball and pocket: `ball` and `pocket` of a choice of `plan`, which also encode a
        push-out and a pass. Other choices that `state["may"]` allows are the balls -4 (new rack,
        the player breaks), -5 (new rack, the other breaks), -6 (the cue ball stays) and -7
        (touching balls are spotted; or, on a table with pockets, the ball nearest to the head
        string is placed on the foot spot).
    options, **changes
        As for `simulate`.

    Raises
    ------
    CaromError
        The layout or the cue is invalid. A shot that fails is a foul, and its layout is restored.
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
        raise ValueError(
            f"Turn.spot: there is no ball {beyond[0]}; the layout has balls 0 to {len(layout) - 1}"
        )
    if code < 0:
        raise CaromError(code, "Turn.spot", text=_NO_ROOM)
    return ruling_of(ruling, len(layout), isinstance(rules, Rules), shots[0], cue_ball)


def words_of(write: Callable[[Any, int], int]) -> str:
    """A sentence of C on a ruling or a match."""
    words = ffi.new("char[]", 1024)
    write(words, 1024)
    return text_of(words)


def ruling_of(ruling: Any, count: int, is_own: bool, shot: Shot, cue_ball: int) -> Ruling:
    """A `Ruling` from a ruling of C for a number of balls."""
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
