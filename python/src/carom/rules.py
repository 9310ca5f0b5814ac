"""Rules of games and their referee: `carom.games.rules`."""

from carom.games.rules import *
