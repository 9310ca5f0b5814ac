"""Players and plans: `carom.games.plans`."""

from carom.games.plans import *
