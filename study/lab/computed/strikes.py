"""strikes.py: strikes of pool by a cue. The elevation of the butt and the direction in degrees, the
speed of the cue, the position of the tip, another ball, its friction (0: the law of pool), numbers of
the cue.
"""

from math import hypot, radians, tan

from study.lab.computed.library import (
    EVENT_BALL_BALL,
    GAME_POOL,
    LIBRARY,
    TABLE_POOL_9FT,
    angle,
    ball,
    cue,
    found,
    shoot,
    shot_ball,
)

INCH = 0.0254
JUMP_CUE = {"mass": 0.28, "tip_time": 0.0008, "tip_restitution": 0.85}


def strike(theta, speed, tip=(0, 0), object_place=None, friction=0, phi=90, **numbers):
    stroke, balls = (
        LIBRARY.carom_cue_of(GAME_POOL),
        [shot_ball(place) for place in [(0.635, 0.635, ball().radius), object_place] if place],
    )
    for name, value in dict(numbers, phi=phi, theta=theta, speed=speed, a=tip[0], b=tip[1]).items():
        setattr(stroke, name, value)
    for struck_ball in balls if friction else ():
        struck_ball.kind.law_a, struck_ball.kind.law_b = friction, 0
    return shoot(TABLE_POOL_9FT, balls, stroke)[0]


def struck(a, b):
    """The motion of a ball by a level cue whose tip touches it there, in R."""
    return strike(0, cue().speed, (a, b))[0].after[0]


def rise(ahead, *numbers, **of_cue):
    """mm, of a ball that hops, at a position ahead; 0: at its highest"""
    _, forward, up = strike(*numbers, **of_cue)[0].after[0].v
    time = ahead / forward or up / ball().gravity
    return 1e3 * time * (up - 0.5 * ball().gravity * time)


def in_the_air(theta, speed, above):
    """the fraction of the time from the head spot to a ball on the foot spot, %"""
    events = strike(theta, speed, (0, above), (0.635, 1.905, ball().radius))
    impact_index = next(k for k, e in enumerate(events) if e.type == EVENT_BALL_BALL)
    return (
        100
        * sum(
            b.time - a.time
            for a, b in zip(events[:impact_index], events[1:])
            if a.after[0].v[2] > 0
        )
        / events[impact_index].time
    )


def inside(offset_angle, friction, speed):
    """how far the tip is from the centre where a frozen ball leaves in the direction of the cue,
    that angle off the line of centres, in R
    """

    def to_the_left(a):
        events = strike(
            0,
            speed,
            (-a, 0),
            (0.635, 0.635 + 2 * ball().radius, ball().radius),
            friction,
            90 + offset_angle,
        )
        impact = next(e for e in events if e.type == EVENT_BALL_BALL)
        return -angle(impact.after[(impact.a, impact.b).index(1)].v)

    return found(to_the_left, 0, 0.5, offset_angle)


def rise_by_jump_cue(ahead, theta, speed):
    return rise(ahead, theta, speed, **JUMP_CUE)


def speed_of_ball(a):
    """The speed of a ball over the speed of the cue."""
    return struck(a, 0).v[1] / cue().speed


def squirt_at(offset, **of_cue):
    """degrees, with the tip so far beside the centre, in R"""
    return abs(angle(strike(0, cue().speed, (offset, 0), **of_cue)[0].after[0].v))


def squirt(inches):
    return squirt_at(inches * INCH / ball().radius)


def pivot(offset=0.4):
    """in, the natural pivot length: the tip's offset, in R, over the tangent of the squirt"""
    return offset * ball().radius / tan(radians(squirt_at(offset))) / INCH


def side_spin(offset):
    """R w_z / v of a ball that is struck so far beside its centre, in R"""
    motion = struck(offset, 0)
    return ball().radius * abs(motion.w[2]) / hypot(*motion.v[:2])


def top_spin(offset):
    """R w / v of a ball that is struck so far above its centre, in R"""
    motion = struck(0, offset)
    return -ball().radius * motion.w[0] / motion.v[1]


def hung(ball_mass, cue_mass):
    """the speed of a ball over that of a cue, both hung, whose masses are given in one unit"""
    return (1 + cue("billiard").tip_restitution) / (1 + ball_mass / cue_mass)


def break_speed_of_cue(speed):
    """m/s, of the cue that gives the cue ball this speed"""
    return speed / (struck(0, 0.1).v[1] / cue().speed)
