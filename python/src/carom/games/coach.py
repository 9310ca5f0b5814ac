"""Advice for a player by `carom_coach.h`: odds of matches, what strokes of a match cost, and breaks
that win most often.
"""

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
    """The chances of a match. Those of the second side are 1 less these."""

    game: float  # That the first side wins a game in which nobody has the break
    set: float  # That it wins the first set
    match: float  # That it wins the match
    games: float  # The mean number of games
    score: dict[tuple[int, int], float]  # Of final scores: sets, or games where one set decides
    fair: tuple[int, int]  # The games of both sides with which the match is fairest


def _pair(given: int | Iterable[int], name: str) -> list[int]:
    """How many each side needs; one number is for both."""
    words = "a number, or one for each side"
    pair = [given, given] if isinstance(given, int) else several(given, name, words)
    if len(pair) != 2:
        raise ValueError(f"{name}: {words} is needed, not {given!r}")
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
    """The odds of a match of two players by their Fargo ratings, 0 to 1000.

    Parameters
    ----------
    ratings : (float, float)
        A player who is rated 100 points higher wins two games for each one of the other.
    games : int, or one for each side
        How many win a set, 1 to 100.
    sets : int, or one for each side
        How many win the match.
    order : {"alternate", "winner", "loser"}
        Who breaks within a set. Sets are begun in turn.
    side : int, optional
        Which side breaks first. Default: either, by lot.
    break_points : float
        How many points of rating a player has more in a game that he breaks, -1000 to 1000.

    Examples
    --------
    >>> carom.odds((600, 500), (9, 7)).match
    0.7968...
    """
    pair = several(ratings, "ratings", "the ratings of both players")
    if len(pair) != 2:
        raise ValueError(f"ratings: those of both players are needed, not {pair}")
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
            f"ratings, break_points: 0 to 1000 and -1000 to 1000 are needed, not {pair}, "
            f"{break_points}"
        )
    lib.carom_fair_series(series, fair)
    needed = list(series.sets if max(series.sets) > 1 else series.games)
    score = {(needed[0], k): found.score[0][k] for k in range(needed[1])}
    score |= {(k, needed[1]): found.score[1][k] for k in range(needed[0])}
    return Odds(found.game, found.set, found.match, found.games, score, (*fair.games,))


class Drill(NamedTuple):
    """A layout to practise a stroke: that of the review."""

    place: tuple[float, float]  # m: where the stroke without errors leaves the cue ball
    radius: float  # m: how near to it the cue ball has to come; 0: the pot alone counts
    rating: float  # Of a player who makes it in half of the tries


class Review(NamedTuple):
    """What a stroke of a match meant, and what came of it. Costs are chances to win."""

    group: str  # Such as "long thin cut"
    ball: int | None  # That was meant to fall; None: no direct pot was found
    pocket: int | None
    aim: Records  # The stroke that was meant
    off: float  # Degrees: how far the stroke was played to the left of it
    cut: float  # Degrees
    distance: float  # m: of both ways
    told: float  # The chance that the meant stroke keeps the turn
    kept: bool  # Whether the stroke kept it
    value: float  # The chance to win of the meant stroke, and
    came: float  # after the stroke
    miss_cost: float  # What the miss cost; its mean is 0 by the errors of the player
    place_cost: float  # What the places of the balls cost
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
    """What a stroke of a game of two sides with pockets cost its player.

    `balls`, `state` and `call` are those before the stroke; the others are those of `carom.plan`.

    Raises
    ------
    CaromError
        The layout or an option is in error, or the game cannot be reviewed.
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
    """The breaks that win most often: place of the cue ball, speed, height of the tip, and cut.

    Parameters
    ----------
    rack : str
        The rack of a game with a break, such as "nineball"; `balls` are one, the cue ball first.
    cue : ndarray of `carom.dtypes.cue`, optional
        The stroke to compare with; no break is faster. Default: 9 m/s.
    player, opponent, seed, options
        As for `carom.plan`.
    breaks : int
        How many breaks are played of each break that is proposed, at least 16.
    best : int
        How many are proposed, 1 to 8.
    gap : float
        m, between the balls of the racks.

    Returns
    -------
    ndarray of `carom.dtypes.break_choice`, shape (best,)
        The best one first; `counts` has the results of its breaks, and the costs of the first one
        say how much more often it would win without the player's errors.

    Raises
    ------
    CaromError
        The layout, the cue or an option is in error.
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
            "gap": number(gap, "gap", "a distance in m is needed"),
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
