"""Practice of pots, as an environment: `carom.games.potting`."""

from carom.games.potting import *
