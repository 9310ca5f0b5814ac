"""What a fit plays is what a shot plays: the numbers of every game, tables with pockets, balls that
leave the table, and shots of different numbers of balls.
"""

from typing import get_args

import numpy as np
import pytest

import carom
from carom import _described, tracks
from carom.layouts import GAMES
from carom.tracks import _constants, fit

NOISE = 1e-4  # m, of the synthetic recordings
NOISY = 1.3 * NOISE * np.sqrt(2.0)  # m: an RMSE that is no more than the noise


def seen(shot, names, start=1.0, rate=50.0, noise=NOISE, seed=0):
    """A recording of a played shot by a camera, whose rows end where a ball falls."""
    t = np.arange(0.0, start + min(shot.time, 3.0) + 0.3, 1.0 / rate)
    places = shot.positions(np.clip(t - start, 0.0, shot.time))[..., :2]
    places += np.random.default_rng(seed).normal(0.0, noise, places.shape)
    ends = np.full(len(names), np.inf)
    falls = shot.events[shot.events["type"] == carom.EventType.POCKET]
    ends[falls["a"]] = falls["time"] + start
    return tracks.Recording(
        seed,
        tuple(names),
        tuple(
            np.column_stack([t, places[:, ball]])[t < end] for ball, end in enumerate(ends.tolist())
        ),
    )


# ---- One reading of a game's numbers


@pytest.mark.filterwarnings("ignore:cushion_model", "ignore:balls")
@pytest.mark.parametrize("friction", get_args(_described.BallFriction))
@pytest.mark.parametrize("game", GAMES)
def test_a_fit_plays_the_numbers_of_a_shot(game, friction):
    """For each model of the cushion: the same bits, and a fit of the shot comes down to the noise."""
    size, radius = (1.27, 2.54), float(carom.balls([[0, 0]], game=game)["kind"]["radius"][0])
    ground = _constants.ground(size, radius, game)
    for model in get_args(_described.ShotCushion):
        balls = carom.balls([[0.4, 0.5], [0.7, 1.3]], game=game, cushion_model=model)
        cue = carom.cue(ball_speed=2.2, phi=68.2, a=0.2, b=0.3, game=game)
        how = {"cushion_model": model, "friction": friction, "game": game}
        shot = carom.simulate(ground.table, balls, cue, cushion_model=model, friction=friction)
        constants, cushion = _constants.complete({}, model, game=game, friction=friction)
        given = {"friction": friction, "table": ground.table}
        assert constants == _constants.complete(balls["kind"][0], model, **given)[0]
        known = balls.copy()
        for name, value in constants.items():
            known["kind"][name] = value
        again = carom.simulate(ground.table, known, cue, cushion_model=cushion)
        assert again.final.tobytes() == shot.final.tobytes(), model
        found = fit.fit([seen(shot, ("cue", "red"))], size, radius, free="none", **how)
        assert found.rmse[0] < NOISY and found.cushion_model == cushion, (model, found.rmse)
