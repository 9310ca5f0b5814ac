"""As game.c, in Python."""

import sys

import numpy as np

import carom
from carom.record import replay

WORD = 2**64 - 1


def add(hash_, numbers):
    """FNV-1a of the bits of numbers, the lowest byte first."""
    for byte in np.ascontiguousarray(numbers, "<f8").tobytes():
        hash_ = (hash_ ^ byte) * 0x100000001B3 & WORD
    return hash_


shots, game = 0, 0
for shot in replay(sys.argv[1]):
    assert shot.same, f"shot {shot.shot} has other bits than were recorded"
    shots, game = shot.shot, shot.played.hash
print(f"recording: {shots} shots, {game:016x}")

table = carom.tables.pool_9ft()
shot = carom.simulate(table, carom.racks.nineball(table), carom.cue(speed=8.0))
hash_ = add(0xCBF29CE484222325, shot.events["time"])
for state in shot.final:
    hash_ = add(add(add(hash_, state["r"]), state["v"]), state["w"])
print(f"break: {len(shot.events)} events, {hash_:016x}")

# The film of the shot in parts.
times = [k / 60.0 for k in range(int(shot.time * 60.0) + 1)]
parts = carom.simulate(table, shot.balls, carom.cue(speed=8.0), t_final=0.2)
for t_final in (0.4, 1.0, None):
    parts = carom.resume(parts, t_final=t_final)
for states, turned in zip(parts.states(times, drawn=True), parts.orientations(times)):
    for state, turn in zip(states, turned):
        hash_ = add(add(hash_, state["r"]), turn)
hash_ = add(hash_, shot.slips)
print(f"film: {len(times)} frames, {hash_:016x}")
