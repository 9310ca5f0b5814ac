"""A break of nine-ball, in a browser. pooltool: hello_world.md of its guide."""

import carom

table = carom.tables.pool_9ft()
balls = carom.racks.nineball(table)
cue = carom.aim(table, balls, carom.cue(speed=8.0), ball=1).cue
shot = carom.simulate(table, balls, cue)
shot.show()
print(shot)
