"""Fits to recorded shots: `carom.tracks.fit`. `python -m carom.fit` runs it."""

import sys

from carom.tracks.fit import *
from carom.tracks.fit import main

if __name__ == "__main__":
    sys.exit(main())
