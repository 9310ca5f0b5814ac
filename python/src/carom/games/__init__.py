"""Games: their rules and plans, and environments for agents. `carom.plan` is `carom.games.plan`."""

from carom.games.coach import Drill, Odds, Review, odds, review
from carom.games.match import Match
from carom.games.plans import Pot, Rating, aim, chances, plan, player, rating, value, with_errors
from carom.games.rules import Facts, Foul, Rules, Ruling, Turn, referee

__all__ = [
    "Drill",
    "Facts",
    "Foul",
    "Match",
    "Odds",
    "Pot",
    "Rating",
    "Review",
    "Rules",
    "Ruling",
    "Turn",
]
__all__ += [
    "aim",
    "chances",
    "odds",
    "plan",
    "player",
    "rating",
    "review",
    "referee",
    "value",
    "with_errors",
]
