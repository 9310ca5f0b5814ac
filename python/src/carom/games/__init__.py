"""Games: their rules and plans, and environments for agents. `carom.plan` is `carom.games.plan`."""

from carom.games.plans import Pot, aim, chances, plan, player, value, with_errors
from carom.games.rules import Facts, Foul, Rules, Ruling, Turn, referee

__all__ = ["Facts", "Foul", "Pot", "Rules", "Ruling", "Turn"]
__all__ += ["aim", "chances", "plan", "player", "referee", "value", "with_errors"]
