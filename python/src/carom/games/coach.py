"""Advice for players: odds of matches, the cost of strokes in a match, and the best breaks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._faults import argument_error, shot_arguments
from carom._rows import (
    Array,
    Seed,
    choice,
    copied,
    listing,
    number,
    pointer,
    seed_of,
    several,
    whole,
    worded,
)
from carom._shot_options import Options, chosen, shot_options
from carom.dtypes import Records
from carom.games.match import ORDERS, cue_of
from carom.games.plans import Job, one_player
from carom.games.plans import player as usual_player
from carom.games.rules import Game, GivenState, Made
from carom.layouts import Table, check_table, of_record, one_cue
from carom.layouts import cue as usual_cue
from carom.status import CaromError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from typing_extensions import Unpack

    from carom._shot_options import Changes

__all__ = ["Drill", "Odds", "Review", "best_breaks", "odds", "review"]
__dir__ = listing(__name__)

_USUAL = Options()


class Odds(NamedTuple):
    """The chances of the first side in a match; the second side has 1 minus these."""

    game: float  # Chance to win a game without an advantage of the break
    set: float  # Chance to win the first set
    match: float  # Chance to win the match
    games: float  # Mean number of games
    score: dict[
        tuple[int, int], float
    ]  # Chance of each final score: in sets, or in games of a single set
    fair: tuple[int, int]  # The race (games of each side) that makes the match most even


def _pair(given: int | Iterable[int], name: str) -> list[int]:
    """How many each side needs; a single number applies to both."""
    words = "a number, or one for each side"
    pair = [given, given] if isinstance(given, int) else several(given, name, words)
    if len(pair) != 2:
        raise ValueError(f"{name}: {given!r} is not {words}")
    return [whole(one, name, least=1, most=lib.CAROM_SERIES_MOST) for one in pair]


def odds(
    ratings: Iterable[float],
    games: int | Iterable[int] = 1,
    *,
    sets: int | Iterable[int] = 1,
    order: str = "alternate",
    side: int | None = None,
    break_points: float = 0.0,
) -> Odds:
    """Compute the odds of a match between two players from their Fargo ratings.

    Parameters
    ----------
    ratings : (float, float)
        The ratings, 0 to 1000. A player rated 100 points higher wins two games for each one that
        the other wins.
    games : int or (int, int)
        Games that win a set, 1 to 100, for both sides or for each.
    sets : int or (int, int)
        Sets that win the match, 1 to 100.
    order : {"alternate", "winner", "loser"}
        Who breaks in the next game of a set. The first break of each set alternates.
    side : int, optional
        The side that breaks first. Default: random.
    break_points : float
        Rating points that the player who breaks gains in that game, -1000 to 1000.

    Returns
    -------
    Odds

    Examples
    --------
    >>> carom.odds((600, 500), (9, 7)).match
    0.7968...
    """
    pair = several(ratings, "ratings", "a list of the ratings of both players")
    if len(pair) != 2:
        raise ValueError(f"ratings: {pair} are not two ratings; pass one for each player")
    series = ffi.new(
        "carom_series *",
        {
            "rating": [number(rating, "ratings") for rating in pair],
            "break_points": number(break_points, "break_points"),
            "games": _pair(games, "games"),
            "sets": _pair(sets, "sets"),
            "order": choice(ORDERS, order, "order"),
            "side": -1 if side is None else whole(side, "side", most=1),
        },
    )
    found, fair = ffi.new("carom_odds *"), ffi.new("carom_series *")
    if lib.carom_odds_of(series, found) < 0:
        raise ValueError(
            f"ratings, break_points: {pair}, {break_points} is out of range; ratings are 0 to 1000 and "
            "break_points -1000 to 1000"
        )
    lib.carom_fair_series(series, fair)
    needed = list(series.sets if max(series.sets) > 1 else series.games)
    score = {(needed[0], k): found.score[0][k] for k in range(needed[1])}
    score |= {(k, needed[1]): found.score[1][k] for k in range(needed[0])}
    return Odds(found.game, found.set, found.match, found.games, score, (*fair.games,))


class Drill(NamedTuple):
    """A drill for the stroke of a review."""

    place: tuple[float, float]  # Final position of the cue ball after a stroke without errors, m
    radius: float  # Largest distance from it, m; 0: only the pot counts
    rating: float  # Fargo rating of a player who succeeds in half of the attempts


class Review(NamedTuple):
    """The intention and the result of a stroke in a match. Costs are losses of the chance to win."""

    group: str  # Such as "long thin cut"
    ball: int | None  # Intended ball; None: no direct pot was found
    pocket: int | None
    aim: Records  # The intended stroke
    off: float  # How far to the left of it the stroke was played, degrees
    cut: float  # Degrees
    distance: float  # Total length of both paths, m
    told: float  # Chance that the intended stroke keeps the turn
    kept: bool  # Whether the stroke kept it
    value: float  # Chance to win with the intended stroke
    came: float  # Chance to win after the stroke
    miss_cost: float  # Cost of the miss; its mean over the player's errors is 0
    place_cost: float  # Cost of the positions of the balls
    drill: Drill | None


def review(
    table: Table,
    balls: Records,
    cue: Records,
    *,
    rules: Game = "eightball",
    state: GivenState | None = None,
    call: tuple[int, int] = (-1, -1),
    player: Records | None = None,
    opponent: Records | None = None,
    seed: Seed = 0,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Review:
    """Compute what a stroke cost its player, in a game of two sides with pockets.

    Parameters
    ----------
    table, rules, player, opponent, seed, options, **changes
        As for `carom.plan`.
    balls, state, call
        The layout, the state of the game and the call before the stroke.
    cue : ndarray of `carom.dtypes.cue`, shape ()
        The stroke that was played.

    Returns
    -------
    Review

    Raises
    ------
    CaromError
        The layout or an option is invalid, or the game cannot be reviewed.
    """
    made = Made(rules, state)
    job = Job(
        table, balls, cue, made, player, opponent, 100, seed, 0, 0.0, None, chosen(options, changes)
    )
    found, drill = ffi.new("carom_review *"), ffi.new("carom_drill *")
    struck = pointer("carom_cue[]", copied(one_cue(cue)))
    called = ffi.new("carom_call *", [whole(one, "call", least=-3) for one in call])[0]
    job.call(lib.carom_review_of, struck, called, found, field="rules")
    is_direct = lib.carom_drill_of(job.c, found, drill) == 0
    values: dict[str, Any] = {
        name: getattr(found, name)
        for name in Review._fields
        if name not in {"group", "aim", "drill"}
    }
    values["kept"] = bool(found.kept)
    if not is_direct:
        values |= {"ball": None, "pocket": None}
    return Review(
        group=ffi.string(lib.carom_word_text(lib.CAROM_WORDS_PRACTICE, found.group)).decode(),
        aim=cue_of(ffi.addressof(found, "aim")),
        drill=Drill((*drill.place,), drill.radius, drill.rating) if is_direct else None,
        **values,
    )


def best_breaks(
    rack: str,
    table: Table,
    balls: Records,
    cue: Records | None = None,
    *,
    player: Records | None = None,
    opponent: Records | None = None,
    breaks: int = 500,
    best: int = 3,
    gap: float = 1e-4,
    seed: Seed = 1,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> Records:
    """Find the breaks that win most often: position of the cue ball, speed, tip height, and cut.

    Parameters
    ----------
    rack : str
        The rack of a game with a break, such as "nineball".
    table : Table
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        A rack from `carom.racks`, the cue ball first.
    cue : ndarray of `carom.dtypes.cue`, optional
        The stroke to compare with, which also limits the speed. Default: 9 m/s.
    player, opponent, seed, options
        As for `carom.plan`.
    breaks : int
        Number of times that each proposed break is played, at least 16.
    best : int
        Number of proposed breaks, 1 to 8.
    gap : float
        Gap between the balls of the racks, m.

    Returns
    -------
    ndarray of `carom.dtypes.break_choice`, shape (best,)
        The best one first. `counts` contains the results of its breaks. The costs of the first one
        are the gain in its chance to win without each of the player's errors.

    Raises
    ------
    CaromError
        The layout, the cue or an option is invalid.
    """
    check_table(table)
    kind = choice(worded("RACK"), rack, "rack")
    layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
    struck = copied(one_cue(usual_cue(speed=9.0) if cue is None else cue))
    choices: Array = np.zeros(
        whole(best, "best", least=1, most=lib.CAROM_BREAK_CHOICES), dtypes.break_choice
    )
    memory: Array = np.empty(lib.carom_break_memory() // 8 + 1, np.float64)
    one = one_player(usual_player() if player is None else player)
    rival = ffi.NULL if opponent is None else one_player(opponent, "opponent")
    shot = shot_options(chosen(options, changes))
    record = table.record
    job = ffi.new(
        "carom_break_job *",
        {
            "table": pointer("carom_table[]", record),
            "balls": pointer("carom_shot_ball[]", layout),
            "count": len(layout),
            "cue": pointer("carom_cue[]", struck),
            "player": one,
            "opponent": rival,
            "shot": shot,
            "rack": kind,
            "gap": number(gap, "gap", "a distance in m"),
            "seed": seed_of(seed),
            "memory": pointer("double[]", memory),
            "memory_size": memory.nbytes,
        },
    )
    played = whole(breaks, "breaks", least=16)
    code = lib.carom_break_best(job, played, pointer("carom_break_choice[]", choices), best)
    if code < 0:
        wrong = argument_error(shot_arguments(table, layout, struck, shot), layout, struck)
        raise wrong or CaromError(code, "rack", rack)
    return choices
