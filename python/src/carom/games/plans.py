"""Planning: the shots that win most often from a layout, for a player with given errors."""

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
from carom._rows import Array, Arrays, Seed, as_array, choice, copied, either, listing, named
from carom._rows import number, pointer, seed_of, several, whole
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
    """What a stroke of `plan` should leave.

    The kinds are the ones of `carom plan --leave`; `carom_goal_kind` in `carom_plan.h` explains
    each.
    """

    kind: GoalKind
    ball: int = 0
    """For "snooker": the index of the ball."""
    balls: Sequence[int] = ()
    """For "apart": the indices of the balls."""
    place: tuple[float, float] = (0.0, 0.0)
    """For "near": the position, m."""
    distance: float = 0.0
    """For "near": the largest distance, m; for "apart": the smallest gap, m."""


def player(
    errors: float | None = None,
    *,
    fargo: float | None = None,
    rating: float | None = None,
    rules: Game | None = None,
) -> Records:
    """Make a player whose strokes have errors.

    Parameters
    ----------
    errors : float
        Scale of the errors, at least 0. At a speed of 2 m/s, errors=1 means standard deviations of
        0.1 m/s, 0.1 degrees in direction and elevation, and 0.003 radii of the tip in each
        direction; they grow with the speed. Default: 1.
    fargo : float, optional
        A Fargo rating, 200 to 850, instead of `errors`. It determines the errors, the number of
        shots of a plan, and `only_pots`, the fraction of strokes for which the player considers
        only pots. Such a player beats one rated 100 points lower in about 2 of 3 games if `shots`
        of `plan` is not given (docs/understanding/plan.md). Set the field `only_pots` to 0 for a
        plan that advises a person.
    rating : float, optional
        Another name of `fargo`.
    rules : str, optional
        The game of a match that the player plays in. Ratings other than 500 are then adjusted so
        that 100 points are odds of 2 to 1 in this game. Default: a person whom a plan advises.

    Returns
    -------
    ndarray of `carom.dtypes.player`, shape ()
        Its fields may be modified.
    """
    if fargo is not None and rating is not None:
        raise ValueError("fargo, rating: two names of the same rating; omit one")
    fargo = rating if fargo is None else fargo
    if errors is not None and fargo is not None:
        raise ValueError("errors, fargo: a player has errors or a rating, not both; omit one")
    if not 0.0 <= (errors := 1.0 if errors is None else number(errors, "errors")) < np.inf:
        raise ValueError(f"errors: {errors} is not finite and at least 0")
    if (
        fargo is not None
        and not 200.0 <= (fargo := number(fargo, "fargo", "a rating of 200 to 850")) <= 850.0
    ):
        raise ValueError(f"fargo: {fargo} is out of range; ratings are 200 to 850")
    record: Array = np.zeros((), dtypes.player)
    made = lib.carom_player_of(errors)
    if fargo is not None:
        made = lib.carom_player_fargo(fargo)
    if rules is not None:
        if fargo is None:
            raise ValueError("rules: a game is given without a rating; pass fargo, too")
        made = lib.carom_player_rated(fargo, choice(GAMES, rules, "rules"))
    pointer("carom_player[]", record)[0] = made
    return record


class Rating(NamedTuple):
    """A Fargo rating from games: the posterior mean and the central 95 % interval."""

    mean: float
    low: float
    high: float


def rating(scores: ArrayLike) -> Rating:
    """Estimate a player's Fargo rating, 200 to 850, from games.

    The odds that rating r wins a game against rating d are 2^((r - d) / 100) : 1. The prior is
    normal with mean 400 and standard deviation 150, a convention.

    Parameters
    ----------
    scores : array_like, shape (opponents, 3)
        Rows (against, won, lost): the opponent's rating, 0 to 1000, and the games won and lost.

    Returns
    -------
    Rating
    """
    points = np.ascontiguousarray(as_array(scores, "scores", np.float64))
    if points.size and (points.ndim != 2 or points.shape[1] != 3):
        raise ValueError(
            f"scores: the shape is {points.shape}, but must be (opponents, 3): against, won, lost"
        )
    record = ffi.new("carom_rating *")
    if (code := lib.carom_rating_of(pointer("carom_score[]", points), len(points), record)) < 0:
        raise CaromError(code, f"scores[{record.row}]", points[record.row].tolist())
    return Rating(record.mean, record.low, record.high)


def with_errors(cue: Records, player: Records, seed: Seed, number: int = 0) -> Records:
    """Apply a player's random errors to an intended stroke.

    Parameters
    ----------
    cue : ndarray of `carom.dtypes.cue`, shape ()
        The intended stroke.
    player : ndarray of `carom.dtypes.player`, shape ()
    seed : int or numpy.random.Generator
    number : int
        Number of the stroke; each has different errors.

    Returns
    -------
    ndarray of `carom.dtypes.cue`, shape ()
        The executed stroke; the same for the same arguments on every machine.
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
    """A stroke that pots a ball, and its tolerances."""

    cue: Records
    """An array of `carom.dtypes.cue`, shape ()."""
    cut: float
    """Cut of the cue ball on the first ball, degrees; positive if that ball goes to the left."""
    margin: float
    """Degrees by which the ball's path into the pocket may turn towards either jaw."""
    phi: tuple[float, float]
    """The interval of the cue's direction in which the ball falls, degrees."""
    speed: tuple[float, float]
    """The interval of the cue's speed in which it falls at this direction, m/s."""
    elevation: float
    """Smallest elevation at which the stick clears the cushions and balls behind the cue ball,
    degrees.

    A stroke with a lower `cue["theta"]` cannot be played.
    """


_WHY_NOT = {
    lib.CAROM_POT_NO_WAY: "no direction of the cue sends ball {ball} there along this path",
    lib.CAROM_POT_BARRED: "something is in the way: {met}",
    lib.CAROM_POT_SHORT: "ball {at_rest} stops before it gets there; use a higher speed",
    lib.CAROM_POT_REJECTED: "the jaws reject ball {ball} at this speed; use a lower one",
    lib.CAROM_POT_STICK: "the stick needs an elevation of {elevation:.1f} degrees to clear what is behind the cue ball, above the limit of 60",
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

    With `pocket`, it finds the direction of the cue that sends `ball` to the middle of the pocket's
    mouth; without one, the direction in which the cue ball meets `ball` at the cut `cut`. Both allow
    for squirt and swerve, and a pot also for throw and the cushion's model.

    Parameters
    ----------
    table, balls, cue, options, **changes
        As for `simulate`. Of the cue, speed, tip and elevation are used. A `theta` of nan is
        replaced by the smallest elevation at which the stick clears the cushions and balls behind
        the cue ball.
    ball : int
        Index of the ball.
    pocket : int or str
        Index of the pocket, or its name, such as "foot-left"; `table.pocket_names` lists the names.
        Without it, the cue ball meets `ball` at the cut `cut`.
    via : sequence of int or str
        The path, up to four contacts in order: indices of balls, and the rails "head", "foot",
        "left" or "right". `["left"]` is a bank of `ball`, `[2]` a combination via ball 2, `["head",
        ball]` a kick. If `ball` is not named, it follows the last other ball.
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
        There is no such aim, for a stated reason, or an argument is invalid.
    CaromError
        The layout, the cue or an option is invalid.

    Examples
    --------
    >>> two = carom.balls([[0.6, 0.5], [0.6, 1.7]])
    >>> cues = carom.aim(table, two, carom.cue(speed=3.0, a=0.3), ball=1, cut=[-30, 0, 30]).cue
    >>> cues["phi"]
    array([...])
    """
    if pocket is None:
        if several(via, "via", "names of rails and indices of balls"):
            raise ValueError("via: it needs a pocket; pass pocket= too, or leave via= out")
        models = chosen(options, changes)
        return aim_by_cut(table, balls, cue, ball, 0.0 if cut is None else cut, models)
    if cut is not None:
        raise ValueError("pocket, cut: a pocket determines the cut; pass only one of both")
    check_table(table)
    layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
    if layout.ndim != 1:
        raise ValueError(f"balls: the shape is {layout.shape}, but must be (balls,)")
    struck = copied(one_cue(cue))

    # The ball, the pocket and the path for C.
    def index(value: int | str, name: str, kind: str, names: list[str | None], most: int) -> int:
        if isinstance(value, str):
            known = sorted({known for known in names if known})
            return names.index(named(known, value, name)) if known else whole(value, name)
        if whole(value, name) >= most:
            raise ValueError(f"{name}: there is no {kind} {value}; use 0 to {most - 1}")
        return value

    rails, pockets = table.rail_names, table.pocket_names
    via = several(via, "via", "a list of names of rails and indices of balls")
    way = [
        (
            lib.CAROM_PART_RAIL if isinstance(step, str) else lib.CAROM_PART_BALL,
            index(step, "via", "ball", rails, len(layout)),
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
            f"via: {list(via)} is not a path; pass up to {lib.CAROM_VIA_MOST} names of rails and indices of balls, "
            f"each ball once, without the cue ball, and ball {ball} last"
        )
    pot = ffi.new(
        "carom_pot *",
        {
            "ball": index(ball, "ball", "ball", [], len(layout)),
            "pocket": index(pocket, "pocket", "pocket", pockets, len(pockets)),
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
        raise ValueError(f"pocket: no aim at {pocket}: {why}")
    return Pot(
        struck,
        pot.cut,
        pot.margin,
        (pot.phi[0], pot.phi[1]),
        (pot.speed[0], pot.speed[1]),
        pot.elevation,
    )


_usual_player = player
# ranges of a player's fields; the others are 0 to 1000
_RANGES = {"tip_most": (0.0, 1.0), "eye": (-np.inf, 0.01), "reserved": (0.0, 0.0)}


def one_player(player: Records, name: str = "player") -> Any:
    """A player for C, which keeps its array alive."""
    record = copied(of_record(player, dtypes.player, name, "player()"))
    if record.ndim != 0:
        raise ValueError(f"{name}: the shape is {record.shape}, but must be (), a single player")
    for field in dtypes.player.names or ():
        least, most = _RANGES.get(field, (0.0, 1000.0))
        if not ((record[field] >= least) & (record[field] <= most)).all():
            raise ValueError(
                f"{name}: {field}: {record[field]} is out of range; it must be {least:g} to {most:g}"
            )
    return pointer("carom_player[]", record)


def _corners(in_hand: Hand | ArrayLike) -> tuple[int, Any, Any] | None:
    """The carom_leave in which the cue ball is placed, and corners for C (NULL: no further limit).

    None: the cue ball is not in hand.
    """
    if isinstance(in_hand, str):
        leave = choice({word: LEAVES.get(word, 0) for word in get_args(Hand)}, in_hand, "in_hand")
        if leave == 0:
            return None
        return leave, ffi.NULL, ffi.NULL
    corners = as_array(in_hand, "in_hand", np.float64)
    if corners.shape != (2, 2) or not (corners[0] <= corners[1]).all():
        raise ValueError(
            f"in_hand: {in_hand!r} is not a rectangle; pass its corners [[x, y], [x, y]], the lower ones "
            f"first, or {either(map(repr, get_args(Hand)))}"
        )
    low, high = np.ascontiguousarray(corners)
    return 0, pointer("double[]", low), pointer("double[]", high)


def _stoppable(call: Callable[[], int], flag: Any, stop: threading.Event | None) -> int:
    """Call C in a separate thread, so that Python can handle signals and check `stop` meanwhile."""
    if stop is None and threading.current_thread() is not threading.main_thread():
        return call()
    with ThreadPoolExecutor(1) as pool:
        called = pool.submit(call)
        try:
            while not wait([called], 0.02).done:
                flag[0] |= stop is not None and stop.is_set()
        except BaseException:  # including Ctrl-C
            flag[0] = 1
            raise
    return called.result()


_GOALS = {word: k for k, word in enumerate(get_args(GoalKind))}


def _goal(goal: Goal, count: int) -> Any:
    """A goal for C, which checks its values."""
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
    """The checked arguments of a plan for C, with the objects that must live as long."""

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
            raise ValueError(f"balls: the shape is {self.layout.shape}, but must be (balls,)")
        if len(self.layout) < 2:
            raise ValueError(
                f"balls: there are {len(self.layout)}; a plan needs the cue ball and at least one more"
            )
        self.strike = copied(one_cue(usual_cue() if cue is None else cue))
        self.shot = shot_options(options)
        if stop is not None and not hasattr(stop, "is_set"):
            raise TypeError(f"stop: {stop!r} is not a threading.Event")
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
            raise ValueError(f"unsure: {unsure} is out of range; it must be 0 to 1")
        request.seconds = number(seconds, "seconds")
        if not 0.0 <= request.seconds <= 1e6:
            raise ValueError(f"seconds: {seconds} is out of range; it must be 0 to 1e6")
        request.chance_opponent = whole(run_out, "run_out", most=1)
        request.safeties = whole(safeties, "safeties", most=1)
        request.once = stop is None and seconds == 0.0  # Ctrl-C then needs no choice
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
        """Call a function of C with the job; raises an error that names the invalid argument."""
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
    """A plan of a match: its custom rules, if any, and its call of C."""

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
        2 to 32 balls at rest, the cue ball first. In eight-ball and nine-ball a ball's index is its
        number.
    cue : ndarray of `carom.dtypes.cue`, shape (), optional
        The cue; its stroke is ignored. Default: `carom.cue()`.
    rules : str or Rules
        The game, by name, or custom rules. `carom plan --help` lists the names. For the drill
        "potting" the value is the fraction of the balls that one visit pots; for "threecushion" it
        is the chance of the point, on a table without pockets with the balls of
        `racks.threecushion`. Games with 15 balls use the balls of `racks.eightball`, snooker the
        ones of `racks.snooker`.
    group : {"open", "solids", "stripes"}
        The player's group, in games with groups. Default: "open".
    opening : bool
        Whether the stroke is the break, in games with a break.
    state : dict or ndarray of `carom.dtypes.rules_state`, optional
        The state of the game, instead of `group` and `opening`: the state of a ruling of `referee`,
        or the members that differ from a new game, such as `{"score": (5, 6), "target": 50}`. In
        each pair the player is first. For custom rules, eight integers.
    player : ndarray of `carom.dtypes.player`, shape (), optional
        Default: `carom.player()`.
    opponent : ndarray of `carom.dtypes.player`, shape (), optional
        Default: a player with the same errors.
    shots : int, optional
        Approximate number of simulated shots, 100 to 1,000,000. Default: 200,000 with `seconds`,
        otherwise the player's, or 2,000.
    seconds : float
        Time limit, s; 0: no limit. If the plan reaches it, it returns only the best choice so far.
    in_hand : {"no", "anywhere", "kitchen", "d", "baulk"} or array_like, shape (2, 2)
        Where a cue ball in hand may be placed: the `hand` of a ruling, or two corners of a
        rectangle, m. The field `place` of a choice contains the position.
    best : int
        Largest number of choices.
    seed : int or numpy.random.Generator
        Seed of the strokes' errors.
    threads : int
        Largest number of threads: 0 uses only the calling thread, -1 all processors. Results do not
        depend on it.
    unsure : float
        The player's uncertainty about the table, 0 to 1. Above 0, restitution and friction of the
        cushions, rolling resistance and sliding friction vary together with the errors of strokes;
        1 covers the range of existing tables.
    level : bool
        Whether the cue is level and may pass through cushions and balls. By default it is elevated
        to clear them.
    run_out : bool
        Whether to plan a run-out: a turn that ends before the game is won has value 0.
    goal : Goal, optional
        What the stroke should leave, such as `Goal("near", place=(0.6, 0.6), distance=0.2)`.
        `value` is then the chance to achieve this without a foul.
    safeties : bool
        Whether to try only safeties: strokes that, without errors, end the turn without a foul.
    stop : threading.Event, optional
        Ends the plan early when another thread or a signal handler sets it; the plan then returns
        only the best choice so far. Ctrl-C ends the plan with KeyboardInterrupt unless the caller
        handles the signal.
    options, **changes
        As for `simulate`; t_final, stop_at and first_of are ignored.

    Returns
    -------
    ndarray of `carom.dtypes.plan_stroke`, shape (up to best,)
        The best one first. `cue` is the stroke, `value` the chance to win, and `kind` the kind of
        stroke, a `carom.plans.Kind`.

    Raises
    ------
    CaromError
        The layout, the cue or an option is invalid.
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
    """A planned run-out: its strokes and its chance."""

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
    """Plan a complete run-out: each stroke starts from the layout that the one before leaves
    without errors.

    Parameters
    ----------
    table, balls, cue, rules, group, state, player, shots, in_hand, seed, threads, stop, options
        As for `plan`.
    within : float
        Loss of the chance to run out that bounds the landing zone of the cue ball.
    plays : int
        Number of run-outs played with errors to estimate the total chance; each stroke is planned
        again.

    Returns
    -------
    RunOut

    Raises
    ------
    CaromError
        The layout, the cue or an option is invalid.
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
    """Compute the chances of given strokes, each played with a player's errors.

    Parameters
    ----------
    table, balls
        As for `plan`.
    cues : ndarray of `carom.dtypes.cue`, of any shape
        Up to 1,000 strokes. Speed, direction, elevation and tip of each are used; the rest of the
        cue is taken from the first.
    rules, group, opening, state, player, opponent, seed, threads, unsure, options, **changes
        As for `plan`.
    shots : int
        Total number of shots, 100 to 1,000,000, divided equally among the strokes, at least 10
        each.
    stop : threading.Event, optional
        As for `plan`. Strokes that were not played by then have `seen` 0 and the value NaN.

    Returns
    -------
    ndarray of `carom.dtypes.plan_stroke`, of the shape of `cues`
        In the order of `cues`. `value` is the chance to win, `keep` the chance to keep the turn;
        `ball` and `pocket` are the pot without errors.

    Raises
    ------
    CaromError
        The layout, a stroke or an option is invalid.
    """
    strokes = copied(of_record(cues, dtypes.cue, "cues", "cue()"))
    if not 1 <= strokes.size <= 1000:
        raise ValueError(f"cues: there are {strokes.size}; pass 1 to 1000")
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
    """Estimate the chance that the player at the table wins from a layout, 0 to 1.

    The estimate simulates no shot and takes about 20 us. In games without an opponent it is the
    fraction of the balls that one visit pots. The arguments are as for `plan`; `in_hand` is whether
    the cue ball may be placed anywhere.

    Raises
    ------
    CaromError
        The layout or an option is invalid.
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
