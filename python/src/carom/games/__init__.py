"""Games: their rules and plans, and environments for agents. `carom.plan` is `carom.games.plan`."""

from carom.games.match import Match
from carom.games.plans import Goal, Pot, Rating, RunOut, aim, chances, plan, player, rating
from carom.games.plans import sequence, value, with_errors
from carom.games.rules import Facts, Foul, Rules, Ruling, Turn, referee

__all__ = ["Facts", "Foul", "Goal", "Match", "Pot", "Rating", "Rules", "Ruling", "RunOut", "Turn"]
__all__ += ["aim", "chances", "plan", "player", "rating", "referee", "sequence", "value"]
__all__ += ["with_errors"]
