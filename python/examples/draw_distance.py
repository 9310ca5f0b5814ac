"""Draw distance: how far the cue ball comes back from a full hit, by the height of the tip and the
distance to the object ball.

The tip gives backspin, the cloth takes it away on the way: a sliding ball loses it at a constant
rate. So a shot from afar needs a lower tip or more speed. The cue ball stops dead where the spin is
just used up at the contact (a stun shot). A curve is flat where the ball comes back to the rail.

    python draw_distance.py draw.svg
"""

import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import carom

matplotlib.use("Agg")
table = carom.tables.pool_9ft()
tips = np.linspace(-0.5, 0.0, 26)
cues = carom.cue(speed=2.9, phi=90.0, b=tips)

for away in (0.3, 0.6, 0.9):
    layout = carom.balls([[0.635, 0.9], [0.635, 0.9 + away]])
    shots = carom.simulate_batch(table, layout, cues, room=64)
    back = []
    for shot in shots:
        # From the contact to the next one of the cue ball, with a rail or with a ball that comes
        # back.
        types, a = shot.events["type"], shot.events["a"]
        hit_ball, *later = shot.events[
            (types == carom.EventType.BALL_BALL) | ((types == carom.EventType.RAIL) & (a == 0))
        ]
        end = later[0]["time"] if later else shot.time
        way = (
            shot.positions(np.linspace(hit_ball["time"], end, 400))[:, 0, 1]
            - hit_ball["before"][0]["r"][1]
        )
        back.append(max(0.0, -way.min()))  # the farthest behind the contact, m
    print(
        f"object ball {away:.1f} m away: {back[0]:.2f} m back with the tip at {tips[0]:.1f} R, {back[-1]:.2f} m with a centre hit"
    )
    assert back[0] > 0.1 and back[-1] < 0.02
    plt.plot(tips, back, label=f"{away:g} m to the object ball")
plt.xlabel("height of the tip, radii")
plt.ylabel("draw, m")
plt.legend()
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "draw.svg")
