"""Environments of PettingZoo: `carom.games.pettingzoo`."""

from carom.games.pettingzoo import *
