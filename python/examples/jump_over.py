"""A jump over a ball: the least speed of the cue by its elevation, found by bisection.

A raised jump cue, light and with a hard tip, strikes the ball into the slate, which throws it up. A
shot clears the ball in the way if its first contact is the one behind it, or none. Between a speed
that fails and one that clears, each step halves the interval.

    python jump_over.py jump.svg
"""

import sys
from pathlib import Path

import carom

table = carom.tables.pool_9ft()
layout = carom.balls([[0.635, 0.6], [0.635, 0.6 + 0.305]])  # 12 inches, centre to centre


def play(speed: float, elevation: float) -> carom.Shot:
    """The shot straight at the ball, without side or height of the tip."""
    return carom.simulate(
        table,
        layout,
        carom.cue(
            speed=speed,
            phi=90.0,
            theta=elevation,
            b=0.0,
            mass=0.25,
            tip_time=0.0008,
            tip_restitution=0.85,
        ),
        t_final=1.0,
    )


def clears(shot: carom.Shot) -> bool:
    return not (shot.events["type"] == carom.EventType.BALL_BALL).any()


least = {}
for elevation in (30.0, 35.0, 40.0, 45.0, 50.0):
    low, high = 1.0, 6.0
    while high - low > 1e-3:
        middle = (low + high) / 2
        low, high = (low, middle) if clears(play(middle, elevation)) else (middle, high)
    least[elevation] = high
    print(f"{elevation:.0f} degrees: {high:.3f} m/s")

best = min(least, key=lambda elevation: least[elevation])
assert 35.0 < best < 50.0 and not clears(play(1.0, best))
Path(sys.argv[1] if len(sys.argv) > 1 else "jump.svg").write_text(
    play(least[best] + 0.05, best)._repr_svg_(), encoding="utf-8"
)
