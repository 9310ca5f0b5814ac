"""Rules of games, plans, and environments for agents. `carom.plan` is `carom.games.plan`."""

from carom.games.advice import Breaks, Practice, Reviewed, Ways, Why
from carom.games.advice import breaks, practice, ways, why
from carom.games.coach import Drill, Odds, Review, best_breaks, odds, review
from carom.games.match import Match
from carom.games.plans import Goal, Hit, Pot, Rating, RunOut, aim, chances, plan, player, rating
from carom.games.plans import sequence, value, with_errors
from carom.games.rules import Facts, Foul, Rules, Ruling, Turn, referee

__all__ = ["Drill", "Facts", "Foul", "Goal", "Hit", "Match", "Odds", "Pot", "Rating", "Review"]
__all__ += [
    "Rules",
    "Ruling",
    "RunOut",
    "Turn",
    "aim",
    "best_breaks",
    "chances",
    "odds",
    "plan",
    "player",
    "rating",
]
__all__ += ["referee", "review", "sequence", "value", "with_errors"]
__all__ += ["Breaks", "Practice", "Reviewed", "Ways", "Why", "breaks", "practice", "ways", "why"]
