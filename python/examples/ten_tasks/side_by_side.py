"""Twenty speeds of one break, next to each other. pooltool: sandbox/parallel_playback.py."""

import numpy as np

import carom

table = carom.tables.pool_9ft()
balls = carom.racks.nineball(table, cue_ball=(0.3, 0.6))
cue = carom.aim(table, balls, carom.cue(b=0.4), ball=1).cue
cues = carom.cue(speed=np.linspace(1.0, 3.0, 20), b=0.4, phi=cue["phi"] + 2.5)
shots = carom.simulate_batch(table, balls, cues)
shots.show()
print(shots)
