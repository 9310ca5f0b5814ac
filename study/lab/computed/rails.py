"""rails.py: rebounds from cushions, banks and kicks by diamonds, and bounces on the slate."""

from math import hypot, nan

from study.lab.computed.library import (
    EVENT_RAIL,
    EVENT_SLATE,
    GAMES,
    TABLE_POOL_9FT,
    ball,
    shoot,
    shot_ball,
    table,
)
from study.lab.computed.two_balls import rolling

TABLE_OF = {"pool": "9ft", "snooker": "snooker", "billiard": "threecushion"}

# The table of 2017, by a fit of 21 shots. The table of 2022 has the constants of the game.
MATCH_2017 = {
    "restitution_cushion": 0.753,
    "mu_cushion": 0.238,
    "mu_slide": 0.203,
    "mu_roll": 0.0045,
    "drag": 0.0126,
}


def contact_of(game, speed, **numbers):
    """Of a ball that rolls into a rail, full on: once to find where it meets the rail, and once
    from just before it.
    """
    kind, R, x = TABLE_OF[game], ball(game).radius, 0.5
    for _ in range(2):
        events, _, _ = shoot(
            kind, [shot_ball((x, 0.7, R), (-speed, 0, 0), (0, -speed / R, 0), game, **numbers)]
        )
        contact = next(e for e in events if e.type == EVENT_RAIL)
        x = contact.before[0].r[0] + 1e-6
    return contact


def rebound(game, speed, **numbers):
    """the speed just after over that before, of a ball that rolls into a rail, full on"""
    contact = contact_of(game, speed, **numbers)
    return -contact.after[0].v[0] / contact.before[0].v[0]


def rebound_rolling(game, speed):
    """the speed once the ball rolls again over that before, of a ball that rolls into a rail, full
    on
    """
    contact = contact_of(game, speed)
    return rolling(contact.after[0], GAMES[game])[0] / -contact.before[0].v[0]


def lengths_of_travel(speed, cloth):
    """lengths of a 9 ft table that a ball goes from the head spot through the foot spot, on a cloth
    with this mu_roll
    """
    shape = table(TABLE_POOL_9FT)
    head_spot = 0.25 * shape.length
    events, _, _ = shoot(
        TABLE_POOL_9FT,
        [shot_ball((0.5 * shape.width, head_spot, ball().radius), (0, speed, 0), mu_roll=cloth)],
    )
    places = [head_spot] + [e.before[0].r[1] for e in events]
    return sum(abs(b - a) for a, b in zip(places, places[1:])) / shape.length


def diamond(kind, game, start, aim, speed, side, nth, **numbers):
    """How far beyond its aim a ball meets a rail, in diamonds: it rolls from one long rail to the
    other, with side spin R w_z / v to run on. Diamonds count from the end that it nears, 94 mm
    behind the noses. Of the rail `nth`, which is that from which it came.
    """
    shape, R, back, x = table(kind), ball(game).radius, 0.094, 0.3
    diamond_length, across = shape.length / 8, shape.width + 2 * back
    along = (start - aim) * diamond_length
    v = speed * across / hypot(across, along), speed * along / hypot(across, along)
    place = (x, shape.length - start * diamond_length + (x + back) * along / across, R)
    events, _, _ = shoot(
        kind, [shot_ball(place, (*v, 0), (-v[1] / R, v[0] / R, -side * speed / R), game, **numbers)]
    )
    contact = [e for e in events if e.type == EVENT_RAIL][nth - 1].before[0]
    return (
        (shape.length - contact.r[1] + (contact.r[0] + back) * contact.v[1] / contact.v[0])
        / diamond_length
        if contact.r[0] < 0.5 * shape.width
        else nan
    )


def bank_by_diamonds(origin, beyond):
    """The diamonds to where a bank returns, aimed so many half diamonds beyond its origin."""
    return origin - diamond("9ft", "pool", origin, origin - 0.5 * beyond, 1.5, 0, 2)


def third_rail(origin, aim, **numbers):
    """Where the corner-five system arrives on the third rail; 3 m/s, side spin R w_z / v of 0.6."""
    start = 2 * (origin - 1)
    return diamond("threecushion", "billiard", start, aim, 3, 0.6, 3, **numbers)


def rebound_of_2017(speed):
    return rebound("billiard", speed, **MATCH_2017)


def third_rail_of_2017(origin, aim):
    return third_rail(origin, aim, **MATCH_2017)


def bounce(height):
    """how high a ball bounces on the slate, over the height from which it falls"""
    first = shoot(TABLE_POOL_9FT, [shot_ball((0.5, 0.7, ball().radius + height))])[0][0]
    return (first.after[0].v[2] / first.before[0].v[2]) ** 2 if first.type == EVENT_SLATE else nan
