"""Matches of two players: `carom.games.matches`."""

from carom.games.matches import *
