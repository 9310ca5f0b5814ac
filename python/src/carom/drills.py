"""Environments of single tasks: `carom.games.drills`."""

from carom.games.drills import *
