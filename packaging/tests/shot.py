"""Plays a break and solves a batch of collisions, and prints a hash of their bits, for the wheels
of all systems. Plain C solves the collisions, because only its bits are the same everywhere. The
inputs need only operations whose results IEEE 754 rounds: NumPy's sine has other last bits on
Windows.
"""

import hashlib

import numpy as np

import carom

table = carom.tables.pool_9ft()
shot = carom.simulate(table, carom.racks.nineball(table, gap=1e-4, seed=1), carom.cue(speed=8.0))
# points of the unit circle, by the tangent of half their angle
tangent = np.linspace(-0.7, 0.7, 201)
square = tangent * tangent
centres = np.stack([1.0 - square, 2.0 * tangent, 0.0 * tangent], axis=-1) / (1.0 + square)[:, None]
impacts = carom.impacts(v_a=(1.5, 0, 0), w_a=(3.0, 10.0, 5.0), r_b=centres)
motion, _ = carom.collide(impacts, plain=True)
parts = [shot.events["time"], shot.final["r"], motion]
bits = b"".join(np.ascontiguousarray(part).tobytes() for part in parts)
print(f"{shot.count} events, {shot.time:.9f} s, {hashlib.sha256(bits).hexdigest()[:16]}")
