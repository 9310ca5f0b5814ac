"""constants.py: constants of balls, cloths, cues and tables, in the units of the literature."""

from study.lab.computed.library import ball, cue, table


def number_of_ball(game, name):
    return getattr(ball(game), name)


def number_of_cue(game, name):
    return getattr(cue(game), name)


def ball_diameter(game):
    """mm"""
    return 2000 * ball(game).radius


def table_length(kind):
    return table(kind).length


def nose_height(kind):
    """mm"""
    return 1000 * table(kind).rail[0].height


def spin_deceleration(game):
    """rad/s2, about the vertical"""
    return 2.5 * ball(game).mu_spin * ball(game).gravity / ball(game).radius


def rolling_deceleration(game, speed):
    return ball(game).mu_roll * ball(game).gravity + ball(game).drag * speed**2


def sliding_deceleration(game):
    return ball(game).mu_slide * ball(game).gravity
