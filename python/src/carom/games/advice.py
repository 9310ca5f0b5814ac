"""Advice by `carom_coach.h` that `carom ways`, `carom plan --why`, `carom break` and
`carom practice` print: every way to a goal, the reasons for a stroke, the results of many breaks,
and the strokes of matches that cost a player most.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._faults import argument_error, shot_arguments
from carom._rows import Array, Arrays, Seed, choice, copied, listing, number, pointer
from carom._rows import seed_of, whole, worded
from carom._shot_options import Options, chosen, shot_options
from carom.dtypes import Doubles, Records
from carom.games.coach import Review, review
from carom.games.match import Match
from carom.games.plans import Job, one_player
from carom.games.plans import player as usual_player
from carom.games.rules import GAMES, Game, GivenState, Made, Rules, words_of
from carom.layouts import Table, check_table, of_record, one_cue
from carom.layouts import cue as usual_cue
from carom.record import lines_of
from carom.status import CaromError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes
    from carom.games._described import Group

__all__ = ["Breaks", "Practice", "Reviewed", "Ways", "Why", "breaks", "practice", "ways", "why"]
__dir__ = listing(__name__)

_USUAL = Options()

# ---- Ways

WayGoal = Literal["pot", "score", "place"]
_WAY_GOALS = {"pot": 0, "score": 1, "place": 2}
# Directions of all strokes together, and of each: steps of 0.2 degrees find every window of 0.2.
_SCANNED, _SCANNED_EACH, _SCANNED_TO_SCORE = 20_000, 1800, 100_000
_WAYS_MOST = 1000


@dataclass(frozen=True, repr=False)
class Ways(Arrays):
    """The ways to a goal."""

    ways: Records
    """`carom.dtypes.shot_way`, shape (ways,), the best first: `cue` is the stroke, `chance` the share
    of 400 strokes with the player's errors that succeed, `phi` the directions between which it
    succeeds, and `kind` a `carom.plans.Kind`. `carom_coach.h` describes the other fields.
    """
    parts: list[tuple[int | str, ...]]
    """What each way meets, in this order: indices of balls and names of rails."""
    scanned: int
    """How many strokes were played in all directions."""
    good: int
    """How many of them succeeded."""
    left_out: int
    """How many succeeded, but had no room, because there were more ways than `most`."""


def ways(
    table: Table,
    balls: Records,
    cues: Records | None = None,
    *,
    goal: WayGoal | None = None,
    ball: int | None = None,
    pocket: int | str | None = None,
    rails: int = 2,
    place: tuple[float, float] | None = None,
    radius: float = 0.15,
    each: bool = False,
    player: Records | None = None,
    scan: int | None = None,
    most: int = 100,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Ways:
    """Find every way to pot, to score in three-cushion, or to bring the cue ball to a place.

    Parameters
    ----------
    table, balls, options, **changes
        As for `carom.simulate`; the balls are at rest.
    cues : ndarray of `carom.dtypes.cue`, shape (...), optional
        Strokes of one ball, each of which is tried in all directions. Default: `carom.cue()`.
    goal : {"pot", "score", "place"}, optional
        Default: "pot" on a table with pockets and more than one ball, "place" with one ball, else
        "score".
    ball, pocket : int; int or str, optional
        For pots: the ball, and the pocket by its index or name. Default: any.
    rails : int
        For pots and places: the largest number of rails.
    place : (float, float), optional
        Where the cue ball must come to rest, m, for all goals.
    radius : float
        The largest distance to that place, m.
    each : bool
        Whether a pot has a way for each stroke that makes it, in the order of the strokes, instead
        of the best one.
    player : ndarray of `carom.dtypes.player`, shape (), optional
        Whose errors the chances have. Default: `carom.player()`.
    scan : int, optional
        How many directions of all strokes together are tried. Default: 20,000, and for points
        100,000.
    most : int
        How many ways are returned at most.

    Returns
    -------
    Ways

    Raises
    ------
    CaromError
        The layout, a stroke or an option is in error.

    Examples
    --------
    >>> found = carom.ways(table, balls, carom.cue(speed=3.0), ball=1)
    >>> found.ways["chance"][0], found.parts[0]
    """
    check_table(table)
    layout = _layout(balls)
    strokes = copied(of_record(usual_cue() if cues is None else cues, dtypes.cue, "cues", "cue()"))
    strokes = strokes.reshape(-1)
    if strokes.size == 0:
        raise ValueError("cues: at least one is needed")
    usual: WayGoal = "score" if len(table.pockets) == 0 else "pot"
    if len(layout) == 1:
        usual = "place"
    code_of_goal = choice(_WAY_GOALS, usual if goal is None else goal, "goal")
    if code_of_goal == _WAY_GOALS["place"] and place is None:
        raise ValueError('place: the goal "place" needs where the cue ball is to come to rest')
    tried = _SCANNED_TO_SCORE if code_of_goal else max(_SCANNED, _SCANNED_EACH * strokes.size)
    striker = one_player(usual_player() if player is None else player)
    shot, record = shot_options(chosen(options, changes)), table.record
    room = whole(most, "most", least=1, most=_WAYS_MOST)
    memory: Array = np.empty(lib.carom_ways_memory(room) // 8 + 1, np.float64)
    target_place = (0.0, 0.0) if place is None else tuple(number(x, "place") for x in place)
    job = ffi.new(
        "carom_ways_job *",
        {
            "table": pointer("carom_table[]", record),
            "balls": pointer("carom_shot_ball[]", layout),
            "count": len(layout),
            "cues": pointer("carom_cue[]", strokes),
            "strokes": strokes.size,
            "player": striker,
            "shot": shot,
            "scan": tried if scan is None else whole(scan, "scan", least=strokes.size),
            "goal": code_of_goal,
            "ball": -1 if ball is None else whole(ball, "ball", most=len(layout) - 1),
            "pocket": -1 if pocket is None else _pocket(table, pocket),
            "rails": whole(rails, "rails", most=lib.CAROM_WAY_PARTS),
            "each": int(bool(each)),
            "place": target_place,
            "radius": 0.0 if place is None else number(radius, "radius"),
            "memory": pointer("double[]", memory),
            "memory_size": memory.nbytes,
        },
    )
    found: Array = np.zeros(room, dtypes.shot_way)
    result = ffi.new("carom_ways_result *")
    code = lib.carom_ways(job, pointer("carom_shot_way[]", found), room, result)
    if code < 0:
        wrong = argument_error(shot_arguments(table, layout, strokes[0], shot), layout, strokes[0])
        raise wrong or CaromError(code, "cues")
    found = found[: result.ways]
    return Ways(
        found,
        [_parts(table, way) for way in found],
        int(result.scanned),
        int(result.good),
        int(result.left_out),
    )


def _layout(balls: Records) -> Array:
    layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
    if layout.ndim != 1:
        raise ValueError(f"balls: the shape must be (balls,), not {layout.shape}")
    return layout


def _pocket(table: Table, pocket: int | str) -> int:
    """The index of a pocket by its index or name."""
    names = [name for name in table.pocket_names if name]
    if isinstance(pocket, str):
        if pocket not in names:
            raise ValueError(f"pocket: unknown pocket {pocket!r}; use one of {', '.join(names)}")
        return table.pocket_names.index(pocket)
    return whole(pocket, "pocket", most=len(table.pockets) - 1)


def _parts(table: Table, way: Any) -> tuple[int | str, ...]:
    """What a way meets: indices of balls and names of rails."""
    met: list[int | str] = []
    for part in way["part"][: way["parts"]]:
        index = int(part["index"])
        is_ball = part["kind"] == lib.CAROM_PART_BALL
        met.append(index if is_ball else table.rail_names[index] or f"rail {index}")
    return tuple(met)


# ---- Reasons


class Why(NamedTuple):
    """Why a choice of a plan is good. Values are chances to win, or those of the goal."""

    rails: tuple[str, ...]  # The cushions that the cue ball meets before any ball
    first: int | None  # The ball that the cue ball meets first
    cut: float  # Degrees, of the cue ball on it; NaN without one
    part: float  # How much of that ball is hit, 0 to 1; NaN without one
    speed: float  # m/s, of the cue ball just after the strike
    words: str  # What the stroke leaves without errors, as the referee says it
    leave: float  # The value of that leave to the player who strikes; NaN for a goal
    next: Records | None  # `carom.dtypes.plan_stroke`: the best stroke of the player who plays next
    value: float  # Of the choice
    misses: float  # The share of strokes with errors that pass the turn
    loses: float  # The share of strokes with errors that lose the game
    opponent: float  # The opponent's chance to win after those that pass; NaN without an opponent
    flawless_value: float  # Of the choice without errors of the player
    cost: dict[
        str, float
    ]  # What the errors of aim, speed, tip and eye cost; they add up to the rest


def why(
    table: Table,
    balls: Records,
    choice: Records,
    *,
    rules: Game | Rules = "eightball",
    group: Group | None = None,
    opening: bool = False,
    state: GivenState | None = None,
    player: Records | None = None,
    opponent: Records | None = None,
    shots: int | None = None,
    seed: Seed = 0,
    threads: int = 0,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Why:
    """Explain a choice of `carom.plan`: what it meets, what it leaves, and what errors cost.

    Parameters
    ----------
    choice : ndarray of `carom.dtypes.plan_stroke`, shape ()
        One of the plan, such as `carom.plan(...)[0]`.
    table, balls, rules, group, opening, state, player, opponent, shots, seed, threads, options
        Those of the plan. A cue ball in hand is put where the choice says.

    Raises
    ------
    ValueError
        The choice is to pass, which has no stroke.
    CaromError
        The layout or an option is in error.
    """
    chosen_stroke = copied(of_record(choice, dtypes.plan_stroke, "choice", "plan()"))
    if chosen_stroke.size != 1:
        raise ValueError(f"choice: one is needed, such as plan(...)[0], not {chosen_stroke.size}")
    if chosen_stroke.reshape(())["kind"] == lib.CAROM_PLAN_PASS:
        raise ValueError("choice: it is to pass, which has no stroke to explain")
    game = Made(rules, state, group, opening)
    job = Job(
        table,
        balls,
        chosen_stroke.reshape(())["cue"],
        game,
        player,
        opponent,
        shots,
        seed,
        threads,
        0.0,
        None,
        chosen(options, changes),
    )
    found = ffi.new("carom_why *")
    job.call(lib.carom_why_of, pointer("carom_plan_stroke *", chosen_stroke), found)
    ruling = ffi.addressof(found, "ruling")
    following = np.frombuffer(ffi.buffer(ffi.addressof(found, "next")), dtypes.plan_stroke)
    names = ("aim", "speed", "tip", "eye")
    return Why(
        tuple(table.rail_names[found.rail[k]] or "" for k in range(found.rails)),
        found.first if found.first >= 0 else None,
        found.cut,
        found.part,
        found.speed,
        words_of(lambda *text: lib.carom_ruling_string(ruling, *text)),
        found.leave,
        following.copy().reshape(()) if found.has_next else None,
        found.value,
        found.misses,
        found.loses,
        found.opponent,
        found.flawless_value,
        dict(zip(names, found.cost)),
    )


# ---- Breaks


class Breaks(NamedTuple):
    """The results of many breaks. Shares are of all breaks."""

    breaks: int  # How many were played
    makes: float  # Share that pots a ball
    balls: float  # Balls that fall, the mean of a break
    plays_on: float  # Share that plays on by the rules; NaN for a rack of no game with a break
    fouls: float  # Share of fouls, likewise
    wins: float  # The chance to win by the value of what each break leaves, likewise
    error: float  # The standard error of `wins`
    scratches: float  # Share in which the cue ball falls
    off: float  # Share in which a ball leaves the table
    wing: float  # Share in which a ball at a wing of the rack falls
    fell: Doubles  # How often each ball falls into each pocket: shares, shape (balls, pockets)
    place: tuple[float, float]  # m: the mean place of the cue balls that stay
    spread: float  # m: the standard deviation of these places


_BREAK_AIMS = {"full": 0, "direction": 1, "cut": 2}


def breaks(
    rack: str,
    table: Table,
    balls: Records,
    cue: Records | None = None,
    *,
    aim: Literal["full", "direction", "cut"] = "full",
    player: Records | None = None,
    opponent: Records | None = None,
    racks: int = 500,
    gap: float = 1e-4,
    seed: Seed = 1,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Breaks:
    """Play many breaks of one stroke, each with another rack and errors of the player.

    Parameters
    ----------
    rack, table, balls, cue, player, opponent, gap, seed, options
        As for `carom.best_breaks`.
    aim : {"full", "direction", "cut"}
        How each break is aimed: at the middle of the ball in front, in the direction `cue["phi"]`,
        or as far beside the middle of the ball in front as `cue["phi"]` is in the layout.
    racks : int
        How many breaks are played.

    Raises
    ------
    CaromError
        The layout, the cue or an option is in error.

    Examples
    --------
    >>> nine = carom.racks.nineball(table)
    >>> carom.breaks("nineball", table, nine, carom.cue(speed=9.0)).makes
    """
    check_table(table)
    kind = choice(worded("RACK"), rack, "rack")
    layout = _layout(balls)
    struck = copied(one_cue(usual_cue(speed=9.0) if cue is None else cue))
    memory: Array = np.empty(lib.carom_break_memory() // 8 + 1, np.float64)
    striker = one_player(usual_player() if player is None else player)
    rival = ffi.NULL if opponent is None else one_player(opponent, "opponent")
    shot, record = shot_options(chosen(options, changes)), table.record
    job = ffi.new(
        "carom_break_job *",
        {
            "table": pointer("carom_table[]", record),
            "balls": pointer("carom_shot_ball[]", layout),
            "count": len(layout),
            "cue": pointer("carom_cue[]", struck),
            "player": striker,
            "opponent": rival,
            "shot": shot,
            "rack": kind,
            "aim": choice(_BREAK_AIMS, aim, "aim"),
            "gap": number(gap, "gap", "a distance in m"),
            "seed": seed_of(seed),
            "memory": pointer("double[]", memory),
            "memory_size": memory.nbytes,
        },
    )
    counts = ffi.new("carom_break_counts *")
    many = whole(racks, "racks", least=1)
    for first in range(0, many, 64):  # Ctrl-C is handled between calls
        code = lib.carom_break_play(job, first, min(64, many - first), counts)
        if code < 0:
            wrong = argument_error(shot_arguments(table, layout, struck, shot), layout, struck)
            raise wrong or CaromError(code, "rack", rack)
    place = ffi.new("double[2]")
    spread = lib.carom_break_spread(counts, place)
    has_rules = bool(lib.carom_break_has_rules(kind))
    fell: Doubles = np.array([list(row) for row in counts.fell], np.float64)

    def share(times: float) -> float:
        return float(times) / many

    def by_rules(times: float) -> float:
        return share(times) if has_rules else np.nan

    mean = by_rules(counts.wins)
    variance = max(by_rules(counts.win_squares) - mean * mean, 0.0) if has_rules else np.nan
    return Breaks(
        many,
        share(counts.makes),
        share(counts.balls),
        by_rules(counts.plays_on),
        by_rules(counts.fouls),
        mean,
        float(np.sqrt(variance / many)),
        share(counts.scratches),
        share(counts.off),
        share(counts.wing),
        fell[: len(layout), : len(table.pockets)] / many,
        (place[0], place[1]),
        spread,
    )


# ---- Practice


class Reviewed(NamedTuple):
    """A stroke of a match, and its review."""

    line: int  # Of the recording, from 1
    seat: int  # Who played it
    balls: Records  # The layout before it
    cue: Records  # The stroke
    review: Review


class Practice(NamedTuple):
    """What strokes of a kind cost. Costs are games: chances to win that strokes lost, minus those
    that they won.
    """

    group: str  # Such as "long thin cut"
    strokes: int
    kept: int  # How many kept the turn
    due: float  # How many would keep it with the errors of the player
    miss_cost: float  # What the misses cost
    place_cost: float  # What the places of the balls cost
    off: float  # Degrees: the mean error of the aim to the left; NaN where no aim is known
    spread: float  # Degrees: its standard deviation
    reviewed: list[Reviewed]  # Its strokes, those that cost most first; each has a drill


def practice(
    recording: str | os.PathLike[str] | Iterable[str],
    seat: int | str | None = None,
    *,
    player: Records | None = None,
    opponent: Records | None = None,
    seed: Seed = 0,
) -> list[Practice]:
    """What the strokes of recorded matches cost, by kinds of strokes, the most costly kind first.

    Parameters
    ----------
    recording : path, text, or lines
        Matches of two sides with pockets, as `Match.save` writes them.
    seat : int or str, optional
        Whose strokes are reviewed: a seat or the name in it. Default: those of all seats.
    player, opponent, seed
        As for `carom.review`.

    Raises
    ------
    ValueError
        No seat has this name, or the game cannot be reviewed.
    CaromError
        A line is not by the rules, or has other bits.
    """
    groups: dict[str, list[Reviewed]] = {}
    for stroke in _strokes_of(recording, seat, player, opponent, seed):
        groups.setdefault(stroke.review.group, []).append(stroke)
    found = [_practice(group, strokes) for group, strokes in groups.items()]
    return sorted(found, key=lambda group: -(group.miss_cost + group.place_cost))


def _strokes_of(
    recording: Any, seat: int | str | None, player: Any, opponent: Any, seed: Seed
) -> list[Reviewed]:
    """The reviewed strokes of a seat."""
    found: list[Reviewed] = []
    begins: list[str] = []
    match: Match | None = None
    names: set[str] = set()
    key = seed_of(seed)
    for count, line in enumerate(lines_of(recording), start=1):
        if match is None:
            begins.append(line)
            if '"game"' not in line:
                continue
            match = Match.load(begins)
            names |= {sitter.name for sitter in match.seats if sitter.name}
            continue
        earlier, strokes = match.copy(), int(match._c.record.shots)
        match.read(line)
        if int(match._c.record.shots) == strokes or earlier.phase == "moving":
            continue
        mover = earlier.seat
        if seat is not None and seat not in (mover, earlier.seats[mover].name):
            continue
        rules = earlier.rules
        if isinstance(rules, Rules) or rules not in GAMES:
            raise ValueError(
                f"recording: line {count}: strokes by rules of your own have no review"
            )
        struck, called = match.shot, earlier._c.call
        assert struck is not None and struck.cue is not None
        review_of_stroke = review(
            earlier.table,
            earlier.balls,
            struck.cue,
            rules=rules,
            state=earlier.state,
            call=(called.ball, called.pocket),
            player=player,
            opponent=opponent,
            seed=key,
            options=earlier.options.changed({"t_final": None, "stop_at": ()}),
        )
        found.append(Reviewed(count, mover, earlier.balls, struck.cue, review_of_stroke))
    if isinstance(seat, str) and seat not in names:
        known = ", ".join(sorted(names)) or "none"
        raise ValueError(f"seat: unknown name {seat!r}; the names of the recording are: {known}")
    return found


def _practice(group: str, strokes: list[Reviewed]) -> Practice:
    """The sums of a group."""
    reviews = [stroke.review for stroke in strokes]

    def cost(stroke: Reviewed) -> float:
        return stroke.review.miss_cost + stroke.review.place_cost

    off: Doubles = np.array([reviewed.off for reviewed in reviews])
    aimed = off[np.isfinite(off)]
    return Practice(
        group,
        len(strokes),
        sum(reviewed.kept for reviewed in reviews),
        float(np.nansum([reviewed.told for reviewed in reviews])),
        sum(reviewed.miss_cost for reviewed in reviews),
        sum(reviewed.place_cost for reviewed in reviews),
        float(aimed.mean()) if aimed.size else np.nan,
        float(aimed.std()) if aimed.size else np.nan,
        sorted(strokes, key=lambda stroke: -cost(stroke)),
    )
