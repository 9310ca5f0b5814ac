"""Which shot to play: the shots that win most often from a layout, for a player whose strokes err."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, get_args, overload

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import Goal as GoalKind
from carom._faults import argument_error, shot_arguments
from carom._rows import Array, Arrays, as_array, choice, copied, listing, number, pointer
from carom._rows import Seed, seed_of, several, whole
from carom._shot_options import Options, chosen, shot_options
from carom.dtypes import Records
from carom.games._described import Group, Kind
from carom.games.cuts import Hit, aim_by_cut
from carom.games.rules import GAMES, LEAVES, Game, GivenState, Hand, Made, Rules
from carom.layouts import Table, check_table, of_record, one_cue
from carom.layouts import cue as usual_cue
from carom.status import CaromError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes

__all__ = [
    "Goal",
    "Hit",
    "Kind",
    "Pot",
    "Rating",
    "RunOut",
    "aim",
    "chances",
    "plan",
    "player",
    "rating",
    "sequence",
    "value",
    "with_errors",
]
__dir__ = listing(__name__)

_USUAL = Options()


class Goal(NamedTuple):
    """What a stroke of `plan` is to leave.

    The kinds are the words of `carom plan --leave`; `carom_goal_kind` of `carom_plan.h` explains
    each.
    """

    kind: GoalKind
    ball: int = 0
    """Of "snooker": the index of the ball."""
    balls: Sequence[int] = ()
    """Of "apart": indices of the balls."""
    place: tuple[float, float] = (0.0, 0.0)
    """Of "near": the place, m."""
    distance: float = 0.0
    """Of "near" and "apart": the largest distance, or the smallest gap, m."""


def player(
    errors: float | None = None, *, fargo: float | None = None, rules: Game | None = None
) -> Records:
    """A player whose strokes err, as an array of `carom.dtypes.player`, shape ().

    Its fields may be changed.

    Parameters
    ----------
    errors : float
        At least 0. Standard deviations of a stroke of 2 m/s: 0.1 m/s, 0.1 degrees of direction and
        of elevation and 0.003 radii each way, times errors; they grow with the speed. Default: 1.
    fargo : float, optional
        A Fargo rating, 200 to 850, instead: errors that grow with the speed, the shots of a plan and
        `only_pots`, the share of strokes in which the player thinks of nothing but potting. Such
        players beat those who are 100 points weaker in about 2 of 3 games, if `shots` of `plan` is
        not given (docs/understanding/plan.md). Set `only_pots` to 0 for a plan that advises one.
    rules : str, optional
        A game in whose matches the player plays: there, players of other ratings than 500 differ so
        much that 100 points are odds of 2 to 1. Not given: the person, whom a plan advises.
    """
    if errors is not None and fargo is not None:
        raise ValueError("errors, fargo: a player has errors or a rating, not both")
    if not 0.0 <= (errors := 1.0 if errors is None else number(errors, "errors")) < np.inf:
        raise ValueError(f"errors: it must be finite and at least 0, not {errors}")
    if (
        fargo is not None
        and not 200.0
        <= (fargo := number(fargo, "fargo", "a rating of 200 to 850 is needed"))
        <= 850.0
    ):
        raise ValueError(f"fargo: it must be 200 to 850, not {fargo}")
    record: Array = np.zeros((), dtypes.player)
    made = lib.carom_player_of(errors)
    if fargo is not None:
        made = lib.carom_player_fargo(fargo)
    if rules is not None:
        if fargo is None:
            raise ValueError("rules: a game needs a rating in it, fargo")
        made = lib.carom_player_rated(fargo, choice(GAMES, rules, "rules"))
    pointer("carom_player[]", record)[0] = made
    return record


class Rating(NamedTuple):
    """A Fargo rating by games: the mean of the likely ones, and the interval that has 95 % of them,
    2.5 % on each side.
    """

    mean: float
    low: float
    high: float


def rating(scores: ArrayLike) -> Rating:
    """The Fargo rating of a player by games, 200 to 850.

    `scores` has a row (against, won, lost) for each opponent: the rating, 0 to 1000, and the games
    won and lost. Of ratings r and d, the odds that r wins a game are 2^((r - d) / 100) : 1; before
    the first game ratings are normal around 400 with a spread of 150, which is a stated choice; a
    player without games is unrated.
    """
    points = np.ascontiguousarray(as_array(scores, "scores", np.float64))
    if points.size and (points.ndim != 2 or points.shape[1] != 3):
        raise ValueError(
            f"scores: rows of 3 numbers are needed: against, won, lost; not the shape {points.shape}"
        )
    record = ffi.new("carom_rating *")
    if (code := lib.carom_rating_of(pointer("carom_score[]", points), len(points), record)) < 0:
        raise CaromError(code, f"scores[{record.row}]", points[record.row].tolist())
    return Rating(record.mean, record.low, record.high)


def with_errors(cue: Records, player: Records, seed: Seed, number: int = 0) -> Records:
    """The stroke that a player makes of the one that he means, with errors drawn from a seed and
    the number of the stroke.

    Returns
    -------
    array of `carom.dtypes.cue`, shape ()
        The same for the same arguments, on every machine.
    """
    struck = copied(one_cue(cue))
    lib.carom_player_strike(
        one_player(player),
        seed_of(seed, 2**63 - 1),
        whole(number, "number"),
        pointer("carom_cue[]", struck),
    )
    return struck


@dataclass(frozen=True, repr=False)
class Pot(Arrays):
    """A stroke that pots a ball, and what it may err."""

    cue: Records
    """An array of `carom.dtypes.cue`, shape ()."""
    cut: float
    """Degrees, of the cue ball on the first ball, which goes to the left of its way where this is
    above 0.
    """
    margin: float
    """Degrees by which the way of the ball into the pocket may turn, to either jaw."""
    phi: tuple[float, float]
    """Directions of the cue, degrees, between which the ball falls."""
    speed: tuple[float, float]
    """Speeds of the cue, m/s, between which it falls in the cue's direction."""
    elevation: float
    """Degrees: the least elevation with which the stick is over the cushions and balls behind the
    cue ball. A stroke with a lower `cue["theta"]` cannot be played.
    """


_WHY_NOT = {
    lib.CAROM_POT_NO_WAY: "no direction of the cue sends ball {ball} there by this way",
    lib.CAROM_POT_BARRED: "something is in the way: {met}",
    lib.CAROM_POT_SHORT: "ball {at_rest} comes to rest on its way",
    lib.CAROM_POT_REJECTED: "the jaws send ball {ball} back at this speed",
    lib.CAROM_POT_STICK: "the stick would be raised by {elevation:.1f} degrees over what is behind the cue ball, and nobody plays above 60",
}


@overload
def aim(
    table: Table,
    balls: Records,
    cue: Records,
    *,
    ball: int,
    pocket: int | str,
    via: Sequence[int | str] = (),
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Pot: ...
@overload
def aim(
    table: Table,
    balls: Records,
    cue: Records,
    *,
    ball: int,
    cut: ArrayLike = 0.0,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Hit: ...
def aim(
    table: Table,
    balls: Records,
    cue: Records,
    *,
    ball: int,
    pocket: int | str | None = None,
    via: Sequence[int | str] = (),
    cut: ArrayLike | None = None,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Pot | Hit:
    """Aim a pot, or aim at a ball by its cut, also on a table without pockets.

    With `pocket` it is the direction in which `ball` goes to the middle of a pocket's mouth, with squirt,
    swerve, throw and the cushion's model.

    Parameters
    ----------
    table, balls, cue, options, **changes
        As for `simulate`. The speed, the tip and the elevation of the cue count. A `theta` of nan
        becomes the least one with which the stick is over the cushions and balls behind the cue
        ball.
    ball : int
        Index of the ball.
    pocket : int or str
        Index of the table's pocket, or its name: "foot-left"; `table.pocket_names` has all. Without
        it, the cue ball meets `ball` at the cut `cut`.
    via : sequence of int or str
        The way there, up to four contacts: indices of balls and names of rails, "head", "foot",
        "left" or "right", that the ball before them meets. `["left"]` is a bank of `ball`, `[2]` a
        combination by ball 2, `["head", ball]` a kick: where `ball` is not named, it comes after
        the last other ball.
    cut : array_like, shape (...)
        Without `pocket`: the angle in degrees, above -90 and below 90, from the direction of the
        cue ball when it meets `ball` to the line of centres. 0 is a full hit; above 0, `ball`
        leaves to the left. Default: 0. It is exact to 1e-6 degrees, with squirt and swerve. An
        array results in an array of cues, broadcast against `cue`.

    Returns
    -------
    Pot or Hit
        With `pocket` a `Pot`, without one a `Hit`. `cue` of either is the stroke.

    Raises
    ------
    ValueError
        There is no such aim, and why; or an argument is in error.
    CaromError
        The layout, the cue or an option is in error.

    Examples
    --------
    >>> two = carom.balls([[0.6, 0.5], [0.6, 1.7]])
    >>> cues = carom.aim(table, two, carom.cue(speed=3.0, a=0.3), ball=1, cut=[-30, 0, 30]).cue
    >>> cues["phi"]
    array([...])
    """
    if pocket is None:
        if several(via, "via", "names of rails and indices of balls are needed"):
            raise ValueError("via: it needs a pocket; pass pocket= too, or leave via= out")
        models = chosen(options, changes)
        return aim_by_cut(table, balls, cue, ball, 0.0 if cut is None else cut, models)
    if cut is not None:
        raise ValueError("pocket, cut: a pocket determines the cut; pass only one of both")
    check_table(table)
    layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
    if layout.ndim != 1:
        raise ValueError(f"balls: the shape must be (balls,), not {layout.shape}")
    struck = copied(one_cue(cue))

    # The ball, the pocket and the way as C knows them.
    def index(value: int | str, name: str, names: list[str | None], most: int) -> int:
        if isinstance(value, str):
            if value not in names:
                raise ValueError(
                    f"{name}: it must be one of {', '.join(sorted({known for known in names if known}))}, not {value!r}"
                )
            return names.index(value)
        if whole(value, name, least=0) >= most:
            raise ValueError(f"{name}: there are {most}, not {value + 1}")
        return value

    rails, pockets = table.rail_names, table.pocket_names
    via = several(via, "via", "names of rails and indices of balls are needed")
    way = [
        (
            lib.CAROM_PART_RAIL if isinstance(step, str) else lib.CAROM_PART_BALL,
            index(step, "via", rails, len(layout)),
        )
        for step in via
    ]
    balls_hit = [step for step in via if not isinstance(step, str)]
    if (
        len(way) > lib.CAROM_VIA_MOST
        or len({0, *balls_hit}) <= len(balls_hit)
        or ball in balls_hit[:-1]
    ):
        raise ValueError(
            f"via: it must be up to {lib.CAROM_VIA_MOST} names of rails and indices of balls, each once, not the cue ball, and {ball} last, not {list(via)}"
        )
    pot = ffi.new(
        "carom_pot *",
        {
            "ball": index(ball, "ball", [], len(layout)),
            "pocket": index(pocket, "pocket", pockets, len(pockets)),
            "vias": len(way),
            "via": way,
        },
    )
    shot = shot_options(chosen(options, changes))
    code = lib.carom_aim(
        pointer("carom_table[]", table.record),
        pointer("carom_shot_ball[]", layout),
        len(layout),
        shot,
        pot,
        pointer("carom_cue[]", struck),
    )
    if code < 0:
        raise argument_error(
            shot_arguments(table, layout, struck, shot), layout, struck
        ) or CaromError(code, "balls")
    if reason := pot.outcome:
        part = (
            f"ball {pot.met.b}"
            if pot.met.type == lib.CAROM_EVENT_BALL_BALL
            else "a part of the table"
        )
        why = _WHY_NOT[reason].format(
            ball=ball,
            at_rest=pot.met.a,
            met=f"ball {pot.met.a} meets {part}",
            elevation=pot.elevation,
        )
        raise ValueError(f"pocket: no such aim at {pocket}: {why}")
    return Pot(
        struck,
        pot.cut,
        pot.margin,
        (pot.phi[0], pot.phi[1]),
        (pot.speed[0], pot.speed[1]),
        pot.elevation,
    )


_usual_player = player
# the ranges of a player's numbers, except those from 0 to 1000
_RANGES = {"tip_most": (0.0, 1.0), "eye": (-np.inf, 0.01), "reserved": (0.0, 0.0)}


def one_player(player: Records, name: str = "player") -> Any:
    """A player for C. It keeps the array that it is made of."""
    record = copied(of_record(player, dtypes.player, name, "player()"))
    if record.ndim != 0:
        raise ValueError(f"{name}: one is needed, of shape (), not {record.shape}")
    for field in dtypes.player.names or ():
        least, most = _RANGES.get(field, (0.0, 1000.0))
        if not ((record[field] >= least) & (record[field] <= most)).all():
            raise ValueError(
                f"{name}: {field}: it must be {least:g} to {most:g}, not {record[field]}"
            )
    return pointer("carom_player[]", record)


def _corners(in_hand: Hand | ArrayLike) -> tuple[int, Any, Any] | None:
    """The leave within whose bounds the cue ball is put, and corners for C; NULL: no further bound.
    None: not in hand.
    """
    if isinstance(in_hand, str):
        leave = choice({word: LEAVES.get(word, 0) for word in get_args(Hand)}, in_hand, "in_hand")
        if leave == 0:
            return None
        return leave, ffi.NULL, ffi.NULL
    corners = as_array(in_hand, "in_hand", np.float64)
    if corners.shape != (2, 2) or not (corners[0] <= corners[1]).all():
        raise ValueError(
            f"in_hand: the hand of a ruling, {', '.join(map(repr, get_args(Hand)))}, or the corners "
            f"[[x, y], [x, y]] of a rectangle, the lower ones first, not {in_hand!r}"
        )
    low, high = np.ascontiguousarray(corners)
    return 0, pointer("double[]", low), pointer("double[]", high)


def _stoppable(call: Callable[[], int], flag: Any, stop: threading.Event | None) -> int:
    """What C gives, which a thread of its own calls, so that Python handles signals meanwhile and
    looks at `stop`.
    """
    if stop is None and threading.current_thread() is not threading.main_thread():
        return call()
    with ThreadPoolExecutor(1) as pool:
        called = pool.submit(call)
        try:
            while not wait([called], 0.02).done:
                flag[0] |= stop is not None and stop.is_set()
        except BaseException:  # of Ctrl-C
            flag[0] = 1
            raise
    return called.result()


_GOALS = {word: k for k, word in enumerate(get_args(GoalKind))}


def _goal(goal: Goal, count: int) -> Any:
    """A goal for C, which checks its numbers."""
    return ffi.new(
        "carom_plan_goal *",
        {
            "kind": choice(_GOALS, goal.kind, "goal"),
            "ball": whole(goal.ball, "goal: ball", most=count - 1),
            "balls": sum(1 << whole(k, "goal: balls", most=count - 1) for k in {*goal.balls}),
            "place": [number(x, "goal: place") for x in goal.place],
            "distance": number(goal.distance, "goal: distance"),
        },
    )


class Job:
    """What a plan is made for, checked, as C has it; and what has to live as long."""

    def __init__(
        self,
        table: Table,
        balls: Records,
        cue: Records | None,
        game: Made,
        personal: Records | None,
        opponent: Records | None,
        shots: int | None,
        seed: Seed,
        threads: int,
        unsure: float,
        stop: threading.Event | None,
        options: Options,
        level: bool = False,
        seconds: float = 0.0,
        run_out: bool = False,
        goal: Goal | None = None,
        safeties: bool = False,
        memory_of: Callable[[Any], int] = lib.carom_plan_memory,
    ) -> None:
        check_table(table)
        self.layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
        if self.layout.ndim != 1:
            raise ValueError(f"balls: the shape must be (balls,), not {self.layout.shape}")
        if len(self.layout) < 2:
            raise ValueError("balls: a plan needs the cue ball and one more")
        self.strike = copied(one_cue(usual_cue() if cue is None else cue))
        self.shot = shot_options(options)
        if stop is not None and not hasattr(stop, "is_set"):
            raise TypeError(f"stop: a threading.Event is needed, not {stop!r}")
        request = ffi.new(
            "carom_plan_options *",
            {
                "shots": 0 if shots is None else whole(shots, "shots", least=100, most=1_000_000),
                "seed": seed_of(seed),
            },
        )
        request.threads = whole(threads, "threads", least=-1)
        request.level = whole(level, "level", most=1)
        request.unsure = number(unsure, "unsure")
        if not 0.0 <= request.unsure <= 1.0:
            raise ValueError(f"unsure: it must be 0 to 1, not {unsure}")
        request.seconds = number(seconds, "seconds")
        if not 0.0 <= request.seconds <= 1e6:
            raise ValueError(f"seconds: they must be 0 to 1e6, not {seconds}")
        request.chance_opponent = whole(run_out, "run_out", most=1)
        request.safeties = whole(safeties, "safeties", most=1)
        request.once = stop is None and seconds == 0.0  # Ctrl-C asks for no choice
        rival = None if opponent is None else one_player(opponent, "opponent")
        request.opponent = ffi.NULL if rival is None else rival
        request.stop = game.stop
        player = one_player(_usual_player() if personal is None else personal)
        game.check_layout(table, self.layout)
        memory: Array = np.empty(memory_of(request) // 8 + 1, np.float64)
        wanted = ffi.NULL if goal is None else _goal(goal, len(self.layout))
        record = table.record
        self.c = ffi.new(
            "carom_plan_job *",
            {
                "table": pointer("carom_table[]", record),
                "balls": pointer("carom_shot_ball[]", self.layout),
                "count": len(self.layout),
                "cue": pointer("carom_cue[]", self.strike),
                "player": player,
                "rules": game.c,
                "shot": self.shot,
                "options": request,
                "memory": pointer("double[]", memory),
                "memory_size": memory.nbytes,
                "goal": wanted,
            },
        )
        self.table, self.game, self.stop, self.references = (
            table,
            game,
            stop,
            (request, rival, player, memory, record, wanted),
        )

    def call(self, function: Callable[..., int], *arguments: Any, field: str = "balls") -> None:
        """Calls a function of C with the job; raises what it refuses, by its argument."""
        code = _stoppable(lambda: function(self.c, *arguments), self.game.stop, self.stop)
        self.game.check()
        if code < 0:
            wrong = argument_error(
                shot_arguments(self.table, self.layout, self.strike, self.shot),
                self.layout,
                self.strike,
            )
            raise wrong or CaromError(code, field)


class ByMatch(NamedTuple):
    """A plan that a match makes: its own rules of the caller's, and its call of C."""

    game_record: Made | None
    call: Callable[..., int]


def plan(
    table: Table,
    balls: Records,
    cue: Records | None = None,
    *,
    rules: Game | Rules = "eightball",
    group: Group | None = None,
    opening: bool = False,
    state: GivenState | None = None,
    player: Records | None = None,
    opponent: Records | None = None,
    shots: int | None = None,
    seconds: float = 0.0,
    in_hand: Hand | ArrayLike = "no",
    best: int = 5,
    seed: Seed = 0,
    threads: int = 0,
    unsure: float = 0.0,
    level: bool = False,
    run_out: bool = False,
    goal: Goal | None = None,
    safeties: bool = False,
    stop: threading.Event | None = None,
    options: Options = _USUAL,
    _by: ByMatch | None = None,
    **changes: Unpack[Changes],
) -> Records:
    """Find the best shots of a layout.

    Parameters
    ----------
    table : Table
        With pockets.
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        2 to 32 of them at rest, with the cue ball first. For eight-ball and nine-ball a ball's
        index is its number.
    cue : ndarray of `carom.dtypes.cue`, shape (), optional
        Its masses, its tip and its miscue count; the stroke does not. Default: that of
        `carom.cue()`.
    rules : str or Rules
        The game, by its name in `carom plan --help`; of "potting", a drill, the value is the share
        of the balls that one visit pots, of "threecushion" the chance of the point, on a table
        without pockets with the balls of `racks.threecushion`; or a game of your own. Games of 15
        balls have those of `racks.eightball`, snooker those of `racks.snooker`.
    group : {"open", "solids", "stripes"}
        The balls of the player, where each has a group. Default: "open".
    opening : bool
        Whether the stroke is the break, where the rules have one.
    state : dict or ndarray of `carom.dtypes.rules_state`, optional
        How the game stands, instead of `group` and `opening`: that of a ruling of `referee`, or
        what differs from a new game, such as `{"score": (5, 6), "target": 50}`. Of each pair the
        first is the player's. Of rules of your own eight whole numbers.
    player : ndarray of `carom.dtypes.player`, shape (), optional
        Default: `carom.player()`.
    opponent : ndarray of `carom.dtypes.player`, shape (), optional
        Default: he errs as the player does.
    shots : int, optional
        That the plan plays, about: 100 to 1,000,000. Default: 200,000 with `seconds`, else those of
        `player`, or 2,000.
    seconds : float
        At which the plan ends, if it has not played its shots by then; 0 is never. It then has one
        choice, the best so far.
    in_hand : {"no", "anywhere", "kitchen", "d", "baulk"} or array_like, shape (2, 2)
        Where a cue ball in hand may be put, as `hand` of a ruling, or between two corners (m) of a
        rectangle: `place` of the choices then says where to put it.
    best : int
        How many choices at most.
    seed : int or numpy.random.Generator
        Of the errors of strokes.
    threads : int
        Most threads to use; 0 is one alone, -1 all processors. No bit depends on it.
    unsure : float
        How little the player knows of the table, 0 to 1. Above 0 restitution and friction of its
        cushions, rolling resistance and sliding friction are drawn with the errors of strokes; 1
        stands for all tables that there are.
    level : bool
        Whether strokes are by a level cue, whose stick may be in cushions and balls. By default the
        cue is raised over them.
    run_out : bool
        Whether to plan to run out: a turn that ends before the game is won is worth nothing.
    goal : Goal, optional
        What the stroke is to leave, such as `Goal("near", place=(0.6, 0.6), distance=0.2)`. `value`
        is then the chance that it does, without a foul.
    safeties : bool
        Whether to try only safeties: strokes that without errors pass the turn without a foul.
    stop : threading.Event, optional
        Ends the plan early when another thread, or a handler of a signal, sets it: the plan then
        has one choice, the best so far. Without a handler of yours Ctrl-C ends the plan, too, and
        raises KeyboardInterrupt.
    options, **changes
        As for `simulate`; t_final, stop_at and first_of are not read.

    Returns
    -------
    ndarray of `carom.dtypes.plan_stroke`, shape (up to best,)
        The best first: `cue` is the stroke, `value` the chance to win, and `kind` what the stroke
        is, as `carom.plans.Kind`.

    Raises
    ------
    CaromError
        The layout, the cue or an option is in error.
    """
    check_table(table)
    corners = _corners(in_hand)
    game = (_by and _by.game_record) or Made(rules, state, group, opening)
    game.stop[0] = 0
    job = Job(
        table,
        balls,
        cue,
        game,
        player,
        opponent,
        shots,
        seed,
        threads,
        unsure,
        stop,
        chosen(options, changes),
        level,
        seconds,
        run_out,
        goal,
        safeties,
    )
    choices: Array = np.zeros(whole(best, "best", least=1, most=1000), dtypes.plan_stroke)
    found = ffi.new("int *")
    rows = pointer("carom_plan_stroke[]", choices)
    if _by is not None:
        job.call(_by.call, rows, len(choices), found)
    elif corners is not None:
        job.c.leave, *bounds = corners
        job.call(lib.carom_plan_hand, *bounds, rows, len(choices), found)
    else:
        job.call(lib.carom_plan, rows, len(choices), found)
    return choices[: found[0]]


class RunOut(NamedTuple):
    """A run-out as one answer."""

    strokes: Records
    """`carom.dtypes.sequence_stroke`, shape (strokes,): `choice` is the stroke, `zone` the corners of
    the landing zone of the cue ball (m), `speed` and `phi` the tolerance, and `turn_ball` the ball
    that is played instead where the cue ball misses the zone, or -1. `carom_coach.h` has the rest.
    """
    chance: float
    """The share of the played run-outs that succeeded; NaN of none."""
    plays: int
    """How many were played."""


def sequence(
    table: Table,
    balls: Records,
    cue: Records | None = None,
    *,
    rules: Game | Rules = "eightball",
    group: Group | None = None,
    state: GivenState | None = None,
    player: Records | None = None,
    shots: int | None = None,
    in_hand: Hand = "no",
    within: float = 0.03,
    plays: int = 100,
    seed: Seed = 0,
    threads: int = 0,
    stop: threading.Event | None = None,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> RunOut:
    """Plan a run-out as a whole: each stroke from what the one before leaves without errors.

    Parameters
    ----------
    table, balls, cue, rules, group, state, player, shots, in_hand, seed, threads, stop, options
        As for `plan`.
    within : float
        How much chance to run out the cue ball may lose within a landing zone.
    plays : int
        How many run-outs with errors to play for the chance of the whole, each stroke planned anew.

    Raises
    ------
    CaromError
        The layout, the cue or an option is in error.
    """
    check_table(table)
    corners = _corners(in_hand)
    job = Job(
        table,
        balls,
        cue,
        Made(rules, state, group, False),
        player,
        None,
        shots,
        seed,
        threads,
        0.0,
        stop,
        chosen(options, changes),
        memory_of=lib.carom_sequence_memory,
    )
    if corners is not None:
        job.c.leave = corners[0]
    hand = corners is not None
    strokes: Array = np.zeros(lib.CAROM_SEQUENCE_MOST, dtypes.sequence_stroke)
    found = ffi.new("int *")
    rows = pointer("carom_sequence_stroke[]", strokes)
    job.call(lib.carom_sequence, hand, number(within, "within"), rows, len(strokes), found)
    counts = ffi.new("carom_sequence_counts *")
    job.call(lib.carom_sequence_play, hand, 0, whole(plays, "plays"), counts)
    chance = counts.runs / counts.plays if counts.plays > 0 else np.nan
    return RunOut(strokes[: found[0]], chance, counts.plays)


def chances(
    table: Table,
    balls: Records,
    cues: Records,
    *,
    rules: Game | Rules = "eightball",
    group: Group | None = None,
    opening: bool = False,
    state: GivenState | None = None,
    player: Records | None = None,
    opponent: Records | None = None,
    shots: int = 2000,
    seed: Seed = 0,
    threads: int = 0,
    unsure: float = 0.0,
    stop: threading.Event | None = None,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Records:
    """How likely strokes of yours are to win: the chances of each, played with a player's errors.

    Parameters
    ----------
    table, balls
        As for `plan`.
    cues : ndarray of `carom.dtypes.cue`, of any shape
        Up to 1,000 strokes. Speed, direction, elevation and tip of each count; the rest is that of
        the first.
    rules, group, opening, state, player, opponent, seed, threads, unsure, options, **changes
        As for `plan`.
    shots : int
        100 to 1,000,000, of which each stroke has an equal share, at least 10.
    stop : threading.Event, optional
        As for `plan`: strokes that were not played before have `seen` 0 and the value NaN.

    Returns
    -------
    ndarray of `carom.dtypes.plan_stroke`, of the shape of `cues`
        In their order. `value` is the chance to win, `keep` that to play on; `ball` and `pocket`
        are what falls without errors.

    Raises
    ------
    CaromError
        The layout, a stroke or an option is in error.
    """
    strokes = copied(of_record(cues, dtypes.cue, "cues", "cue()"))
    if not 1 <= strokes.size <= 1000:
        raise ValueError(f"cues: 1 to 1000 are needed, not {strokes.size}")
    game = Made(rules, state, group, opening)
    job = Job(
        table,
        balls,
        strokes.reshape(-1)[0],
        game,
        player,
        opponent,
        shots,
        seed,
        threads,
        unsure,
        stop,
        chosen(options, changes),
    )
    choices: Array = np.zeros(strokes.shape, dtypes.plan_stroke)
    job.call(
        lib.carom_plan_try,
        pointer("carom_cue[]", strokes),
        strokes.size,
        pointer("carom_plan_stroke[]", choices),
        field="cues",
    )
    return choices


def value(
    table: Table,
    balls: Records,
    *,
    rules: Game | Rules = "eightball",
    group: Group | None = None,
    opening: bool = False,
    state: GivenState | None = None,
    player: Records | None = None,
    opponent: Records | None = None,
    in_hand: bool = False,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> float:
    """The chance that the player at the table wins from a layout, 0 to 1: an estimate that plays no
    shot, in some 20 us.

    Without an opponent it is the share of the balls that one visit pots. The arguments are those of
    `plan`; `in_hand` says whether the cue ball may be put anywhere.

    Raises
    ------
    CaromError
        The layout or an option is in error.
    """
    job = Job(
        table,
        balls,
        None,
        Made(rules, state, group, opening),
        player,
        opponent,
        100,
        0,
        0,
        0.0,
        None,
        chosen(options, changes),
    )
    found = ffi.new("double *")
    job.call(lib.carom_plan_value, bool(in_hand), found)
    return float(found[0])
