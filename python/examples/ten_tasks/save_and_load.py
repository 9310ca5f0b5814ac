"""A break that is saved and loaded, and its motion as a table. pooltool: sandbox/copy_save_load.py."""

import carom

table = carom.tables.pool_9ft()
balls = carom.racks.nineball(table)
shot = carom.simulate(table, balls, carom.aim(table, balls, carom.cue(speed=8.0), ball=1).cue)
shot.save("break.carom")
loaded = carom.load("break.carom")
assert (loaded.final == shot.final).all()
loaded.to_dataframe(dt=0.01).to_csv("break.csv", index=False)
loaded.show()
print(loaded)
