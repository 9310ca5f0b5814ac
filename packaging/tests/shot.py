"""Plays a break and solves a batch of collisions, and prints a hash of their bits, for the wheels
of all systems. Plain C solves the collisions, because only its bits are the same everywhere.
"""

import hashlib

import numpy as np

import carom

table = carom.tables.pool_9ft()
shot = carom.simulate(table, carom.racks.nineball(table, gap=1e-4, seed=1), carom.cue(speed=8.0))
angles = np.linspace(-1.2, 1.2, 201)
centres = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=-1)
impacts = carom.impacts(v_a=(1.5, 0, 0), w_a=(3.0, 10.0, 5.0), r_b=centres)
motion, _ = carom.collide(impacts, plain=True)
parts = [shot.events["time"], shot.final["r"], motion]
bits = b"".join(np.ascontiguousarray(part).tobytes() for part in parts)
print(f"{shot.count} events, {shot.time:.9f} s, {hashlib.sha256(bits).hexdigest()[:16]}")
