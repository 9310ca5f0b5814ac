"""Environments of Gymnasium: `carom.games.gymnasium`."""

from carom.games.gymnasium import *
