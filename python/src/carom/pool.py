"""Pool by its rules, as an environment: `carom.games.pool`."""

from carom.games.pool import *
