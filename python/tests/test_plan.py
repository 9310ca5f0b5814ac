"""Plans: the choices are those of C whatever the threads, win more with smaller errors, and arguments in error are named."""

import numpy as np
import pytest

import carom

TABLE = carom.tables.pool_9ft()
LAYOUT = carom.balls([[0.4, 0.9], [0.3, 1.9], [0.9, 1.7], [0.7, 0.5]])


def test_plan():
    best = carom.plan(TABLE, LAYOUT, rules="potting", shots=300, plain=True)
    again = carom.plan(TABLE, LAYOUT, rules="potting", shots=300, plain=True, threads=2)
    assert best.dtype == carom.dtypes.choice and 1 <= len(best) <= 5 and best.tobytes() == again.tobytes()
    assert best["ball"][0] in (1, 2, 3) and 0.3 < best["value"][0] <= 1.0 and best["keep"][0] > 0.5
    # the stroke pots the ball that it says
    shots = carom.simulate_batch(TABLE, LAYOUT, best["cue"][:1], plain=True, features=True)
    assert shots.features.pocket[0, best["ball"][0]] == best["pocket"][0]
    weak = carom.plan(TABLE, LAYOUT, rules="potting", shots=300, errors=6.0, best=1)
    assert len(weak) == 1 and weak["value"][0] < best["value"][0] - 0.1


def test_ball_in_hand():
    layout = LAYOUT.copy()
    layout["state"]["label"][0] = carom.Label.POCKETED
    best = carom.plan(TABLE, layout, rules="nineball", shots=200, in_hand=True)
    assert np.ptp(best["place"], axis=0).max() == 0.0 and (best["place"][0] > 0.0).all() and best["ball"][0] >= 1


def test_arguments_in_error():
    with pytest.raises(ValueError, match="rules"):
        carom.plan(TABLE, LAYOUT, rules="snooker")
    with pytest.raises(ValueError, match="shots"):
        carom.plan(TABLE, LAYOUT, shots=10)
    with pytest.raises(ValueError, match="errors"):
        carom.plan(TABLE, LAYOUT, errors=-1.0)
    layout = LAYOUT.copy()
    layout["state"]["r"][1] = layout["state"]["r"][0]
    with pytest.raises(carom.CaromError):
        carom.plan(TABLE, layout)
