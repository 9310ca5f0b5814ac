"""Games: their rules and plans, and environments for agents. `carom.plan` is `carom.games.plan`."""

from carom.games.match import Match
from carom.games.plans import Pot, Rating, aim, chances, plan, player, rating, value, with_errors
from carom.games.rules import Facts, Foul, Rules, Ruling, Turn, referee

__all__ = ["Facts", "Foul", "Match", "Pot", "Rating", "Rules", "Ruling", "Turn"]
__all__ += ["aim", "chances", "plan", "player", "rating", "referee", "value", "with_errors"]
