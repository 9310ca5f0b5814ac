"""two_balls.py: collisions of two balls, and of frozen balls.

A collision has a cut in degrees, a speed in m/s, the fraction of rolling R w / v, the friction (0:
that of the game's balls), and side spin R w_z / v.
"""

from math import cos, exp, hypot, radians, sin, tan

from study.lab.computed.library import (
    GAME_POOL,
    GAME_SNOOKER,
    LIBRARY,
    OF,
    Triple,
    angle,
    ball,
    cluster,
    ctypes,
    found,
    reference,
    shot_ball,
)

FOOT = 0.3048


def law_of(game):
    """The friction of a game's balls over their slip: that of the kind, or else Alciatore's."""
    law, kind = LIBRARY.carom_alciatore(), ball(game)
    if kind.law_a or kind.law_b:
        law.a, law.b, law.c = kind.law_a, kind.law_b, kind.law_c
    return law


def friction_of(game, slip):
    law = law_of(game)
    return law.a + law.b * exp(-law.c * slip)


def marlow(speed):
    """Alciatore's fit of Marlow's friction, at a cut of 45 degrees."""
    law = LIBRARY.carom_alciatore()
    return law.a + law.b * exp(-law.c * speed * sin(radians(45)))


def hit(cut, speed, roll=0, friction=0, side=0, game=GAME_POOL):
    """The motions of both balls just after; y is the line of centres."""
    R, v = ball(game).radius, (speed * sin(radians(cut)), speed * cos(radians(cut)))
    w = (-roll * v[1] / R, roll * v[0] / R, side * speed / R)
    numbers_of_ball = (R, ball(game).mass, ball(game).mu_slide)
    pair = OF["carom_impact"](
        (Triple(), Triple(*v, 0), Triple(*w), *numbers_of_ball),
        (Triple(0, 2 * R, 0), Triple(), Triple(), *numbers_of_ball),
        friction,
        ball(game).restitution,
    )
    if friction == 0:
        pair.mu_ball = LIBRARY.carom_mu_ball(reference(pair), law_of(game))
    out = OF["carom_result"]()
    LIBRARY.carom_collide(reference(pair), None, reference(out))
    return out.a, out.b


def rolling(motion, game=GAME_POOL):
    v = Triple()
    LIBRARY.carom_rolling_velocity(motion.v, motion.w, ctypes.c_double(ball(game).radius), v)
    return v


# ---- Throw, degrees from the line of centres, along which the ball would go without friction


def throw(*numbers):
    return abs(angle(hit(*numbers)[1].v))


def throw_at(cut, object_feet, friction=0):
    """of a stun hit after which the object ball has a speed, ft/s"""
    speed = found(lambda v: hypot(*hit(cut, v, 0, friction)[1].v[:2]), 0.05, 20, object_feet * FOOT)
    return throw(cut, speed, 0, friction)


def frozen(cut, speed, friction=0):
    """The velocity of a ball that touches a second one, which a third drives at an angle to their
    line: the experiment with frozen balls.
    """
    R, x, y = ball().radius, sin(radians(cut)), cos(radians(cut))
    balls = [
        shot_ball((0, 0, R)),
        shot_ball((0, -2 * R, R)),
        shot_ball((-2 * R * x, -2 * R * (1 + y), R), (speed * x, speed * y, 0)),
    ]
    for placed_ball in balls if friction else ():
        kind = placed_ball.kind
        kind.law_a, kind.law_b, kind.law_c = friction, 0, 1
    return cluster(balls)[0].v


def frozen_throw(cut, object_feet, friction=0):
    """of the last of three frozen balls that leaves with a speed, ft/s"""
    speed = found(lambda v: hypot(*frozen(cut, v, friction)[:2]), 0.05, 20, object_feet * FOOT)
    return abs(angle(frozen(cut, speed, friction)))


def throw_most(speed):
    """the cut at which the throw is greatest"""
    return max((throw(0.5 * k, speed), 0.5 * k) for k in range(2, 179))[1]


# ---- The paths of both balls


def speeds(*numbers):
    return [hypot(*motion.v[:2]) for motion in hit(*numbers)]


def object_speed(cut, speed):
    """of the object ball over the speed before; stun"""
    return speeds(cut, speed)[1] / speed


def speed_ratio(cut, speed):
    """of the object ball over the cue ball, just after; stun"""
    of_cue_ball, of_object_ball = speeds(cut, speed)
    return of_object_ball / of_cue_ball


def object_distance(cut, speed):
    """of the object ball over that of a ball that meets nothing; stun"""
    return object_speed(cut, speed) ** 2


def full_hit(game, speed):
    """the object ball's speed just after a full hit by a rolling ball, over the speed before"""
    return hit(0, speed, 1, game=game)[1].v[1] / speed


def deflection(cut, *numbers):
    """degrees from the path before to the path once the ball rolls"""
    return angle(rolling(hit(cut, *numbers)[0])) - cut


def deflection_of_cut(cut, speed):
    """over the cut, of a rolling ball"""
    return deflection(cut, speed, 1) / cut


def share_of_tangent_line(cut, speed):
    """The deflection of a rolling ball over that of a sliding one."""
    return deflection(cut, speed, 1) / (90 - cut)


def oblique(speed, object_angle, what):
    """Of a rolling ball of snooker whose object ball leaves at this angle from its path: the speed
    of the "cue" or "object" ball once it rolls, or the "angle" of the cue ball's path.
    """

    def motions(cut):
        return [rolling(motion, GAME_SNOOKER) for motion in hit(cut, speed, 1, game=GAME_SNOOKER)]

    cut = found(lambda cut: cut - angle(motions(cut)[1]), 5, 70, object_angle)
    of_cue_ball, of_object_ball = motions(cut)
    if what == "angle":
        return angle(of_cue_ball) - cut
    return hypot(*{"cue": of_cue_ball, "object": of_object_ball}[what][:2])


def draw_angle(cut, speed):
    """between the path to the ball and the path back, with the draw that turns that of a half-ball
    hit by 90 degrees
    """
    return 180 - deflection(cut, speed, found(lambda roll: deflection(30, speed, roll), -2, 0, 90))


def gearing(cut, speed, roll):
    """the offset of the tip at which nothing is thrown, over that of the point of contact"""
    return (
        found(lambda side: hit(cut, speed, roll, 0, side)[1].v[0], -1.25, 1.25, 0)
        / 2.5
        / sin(radians(cut))
    )


def distance_ratio(*numbers):
    """of the object ball over the cue ball: of the distances that they roll, which grow with the
    square of the speed
    """
    a, b = (hypot(*rolling(motion)) for motion in hit(*numbers))
    return (b / a) ** 2


def kiss_share(angle, speed):
    """of the first of two frozen balls: how far from the kiss line to the line of centres its path
    lies, by tangents; a third ball drives it
    """
    R, along, across = ball().radius, sin(radians(angle)), cos(radians(angle))
    motions = cluster(
        [
            shot_ball((0, 0, R)),
            shot_ball((2 * R, 0, R)),
            shot_ball((-2 * R * along, -2 * R * across, R), (speed * along, speed * across, 0)),
        ]
    )
    return motions[0].v[0] / motions[0].v[1] / tan(radians(angle))


RULE_SPEEDS = (1, 1.5, 2, 3, 4)


def at_any_speed(name, cut, *numbers):
    """A function of this file by its name, for a rule that names no speed: the middle and half of
    the range over the speeds of ordinary strokes, 1 to 4 m/s.
    """
    values = [globals()[name](cut, speed, *numbers) for speed in RULE_SPEEDS]
    low, high = min(values), max(values)
    return 0.5 * (low + high), 0.5 * (high - low)
