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
    weak = carom.plan(TABLE, LAYOUT, rules="potting", shots=300, player=carom.player(6.0), best=1)
    assert len(weak) == 1 and weak["value"][0] < best["value"][0] - 0.1


def test_ball_in_hand():
    layout = LAYOUT.copy()
    layout["state"]["label"][0] = carom.Label.POCKETED
    best = carom.plan(TABLE, layout, rules="nineball", shots=200, in_hand=True)
    assert np.ptp(best["place"], axis=0).max() == 0.0 and (best["place"][0] > 0.0).all() and best["ball"][0] >= 1


def test_ball_in_hand_in_a_part():
    best = carom.plan(TABLE, LAYOUT, rules="potting", shots=200, in_hand=[[0.0, 0.0], [TABLE.width, 0.4]])
    assert 0.0 < best["place"][0, 1] < 0.4


def test_the_opponent_counts():
    # whoever misses against a weak opponent gets another turn
    values = [carom.plan(TABLE, LAYOUT, rules="nineball", shots=300, player=carom.player(2.0), opponent=carom.player(e), best=1)["value"][0]
              for e in (0.2, 8.0)]  # fmt: skip
    assert values[1] > values[0] + 0.05


def test_ratings():
    errors = [float(carom.player(fargo=rating)["phi"]) for rating in (300, 400, 500, 600, 700, 850)]
    assert errors == sorted(errors, reverse=True) and errors[0] > 5 * errors[-1] > 0.0
    with pytest.raises(ValueError, match="fargo: it must be 300 to 850, not 0"):
        carom.player(fargo=0)


def test_strokes_with_errors():
    cue = carom.cue(speed=2.0, phi=40.0)
    player = carom.player(2.0)
    made = np.array([carom.with_errors(cue, player, 5, k) for k in range(4000)])
    np.testing.assert_allclose([made["speed"].mean(), made["phi"].mean()], [2.0, 40.0], atol=0.02)
    np.testing.assert_allclose([made["speed"].std(), made["phi"].std(), made["a"].std()], [0.2, 0.2, 0.006], rtol=0.06)
    assert made[7].tobytes() == carom.with_errors(cue, player, 5, 7).tobytes() and made["theta"].min() >= 0.0
    player["phi"] = 0.0
    assert carom.with_errors(cue, player, 5)["phi"] == 40.0


def test_arguments_in_error():
    with pytest.raises(ValueError, match="rules"):
        carom.plan(TABLE, LAYOUT, rules="snooker")
    with pytest.raises(ValueError, match="shots"):
        carom.plan(TABLE, LAYOUT, shots=10)
    with pytest.raises(ValueError, match="errors"):
        carom.player(-1.0)
    with pytest.raises(ValueError, match="in_hand"):
        carom.plan(TABLE, LAYOUT, in_hand=[1.0, 2.0])
    with pytest.raises(TypeError, match="player"):
        carom.plan(TABLE, LAYOUT, player=carom.cue())
    layout = LAYOUT.copy()
    layout["state"]["r"][1] = layout["state"]["r"][0]
    with pytest.raises(carom.CaromError):
        carom.plan(TABLE, layout)
