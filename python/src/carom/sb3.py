"""A vector environment of Stable Baselines3: `carom.games.sb3`."""

from carom.games.sb3 import *
