"""A break on a table and with balls of other measures. pooltool: sandbox/custom_table.py."""

import numpy as np

import carom

table = carom.tables.pool_7ft(corner=0.10, side=0.08, corner_jaw=0.08, side_jaw=0.03)
balls = carom.racks.eightball(table)
balls["kind"]["mu_slide"], balls["kind"]["mu_roll"] = 0.2, 0.01
places = balls["state"]["r"]
nearest = 1 + np.linalg.norm(places[1:] - places[0], axis=1).argmin()
cue = carom.aim(table, balls, carom.cue(speed=7.0), ball=nearest, cut=-25).cue
shot = carom.simulate(table, balls, cue)
shot.show()
print(shot)
