"""A massé: the cue ball goes round a ball that is in its way, and hits the one behind it.

A cue that is raised steeply and strikes beside the centre presses the ball on the slate and gives
it spin about a nearly level axis. The slip of this spin on the cloth bends the path until the ball
rolls. Here the other ball lies right behind the one in the way, on one line with the cue ball.
Directions and speeds are tried in one batch; the shot that is shown has the most room for errors.

    python masse.py masse.svg
"""

import sys
from pathlib import Path

import numpy as np

import carom

table = carom.tables.pool_9ft()
balls = carom.balls(
    [[0.635, 0.8], [0.635, 1.05], [0.635, 1.5]]
)  # m: the cue ball, the ball in the way, the one to be hit
speeds, aims = np.linspace(2.0, 4.0, 21), np.arange(30.0, 80.0, 0.25)
cues = carom.cue(
    speed=speeds[:, None], phi=aims, theta=60.0, tip=(-0.45, -0.2)
)  # low left: the path bends to the left
shots = carom.simulate_batch(table, balls, cues, features=True, threads=carom.ALL_THREADS)

# Ball 2 is met first, without a cushion.
seen = shots.features
assert seen is not None  # they were asked for
good = (shots.status == 0) & (seen.contact[..., 0] == 2) & (seen.cushions_before[..., 0] == 0)
runs = np.zeros(good.shape, int)  # neighbouring directions that succeed, counted from the left
for k in range(len(aims)):
    runs[:, k] = np.where(good[:, k], (runs[:, k - 1] if k else 0) + 1, 0)
row, last = np.unravel_index(runs.argmax(), runs.shape)
widest = runs[row, last]
aim = aims[last - widest // 2]
print(f"{good.sum()} of {good.size} strokes hit the ball behind")
print(f"at {speeds[row]:.1f} m/s those of {widest * 0.25:.2f} degrees around {aim:.2f} do")

shot = carom.simulate(
    table, balls, carom.cue(speed=speeds[row], phi=aim, theta=60.0, tip=(-0.45, -0.2))
)
way = shot.positions(
    np.linspace(0.0, shot.events["time"][shot.events["type"] == carom.EventType.BALL_BALL][0], 200)
)[:, 0]
straight = way[0, :2] + np.linspace(0, 1, 200)[:, None] * (way[-1, :2] - way[0, :2])
bend = np.abs(way[:, 0] - straight[:, 0]).max()
print(f"the path is up to {100 * bend:.1f} cm beside the straight one")
assert (
    widest >= 2
    and bend > 0.05715
    and np.hypot(*(way[:, :2] - balls["state"]["r"][1, :2]).T).min() > 0.05715
)
Path(sys.argv[1] if len(sys.argv) > 1 else "masse.svg").write_text(
    shot._repr_svg_(), encoding="utf-8"
)
