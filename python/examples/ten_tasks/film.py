"""A film of a break, without a window. pooltool: sandbox/offscreen/offscreen.py."""

from pathlib import Path

import carom

table = carom.tables.pool_9ft()
balls = carom.racks.nineball(table, seed=1)
shot = carom.simulate(table, balls, carom.aim(table, balls, carom.cue(speed=8.0), ball=1).cue)
shot.animate().save("break.gif", fps=10)
print(f"break.gif: {Path('break.gif').stat().st_size >> 10} kB")
