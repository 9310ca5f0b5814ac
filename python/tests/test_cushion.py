"""carom.cushion against recorded impacts of pooltool, and its errors."""

import numpy as np
import pytest
from conftest import columns

import carom

IMPACT = "vx vy vz wx wy wz nx ny h R M mu_s mu_w e rho"
MOTION = "avx avy avz awx awy awz"


def test_stronge_reference():
    impacts, expected = (columns("cushion-stronge.csv", wanted) for wanted in (IMPACT, MOTION))
    motion, status = carom.cushion(impacts, model="stronge", convention="pooltool")
    assert motion.shape == (479, 6) and not status.any()
    scale = np.repeat([1.0, 0.028575], 3)
    fastest = np.abs(impacts[:, :6] * scale).max(axis=1, keepdims=True)
    assert (np.abs((motion - expected) * scale) / fastest).max() < 1e-13


def test_mathavan_is_the_limit_of_its_steps():
    impact = carom.cushion_impacts(v=(0.4, 1.5, 0), w=(-20.0, 0, 30.0))
    exact = carom.cushion(impact).motion["v"]
    errors = [np.abs(carom.cushion(impact, model="euler", steps=n).motion["v"] - exact).max() for n in (1000, 100000)]
    assert errors[1] < errors[0] / 10 and errors[1] < 1e-4


def test_mirror_by_hand():
    motion, _ = carom.cushion(carom.cushion_impacts(v=(0.3, 2, 0), w=(1, 2, 3), restitution=[0.5, 1.0]), model="mirror")
    np.testing.assert_allclose(motion["v"], [[0.3, -1.0, 0], [0.3, -2.0, 0]], atol=1e-15)
    np.testing.assert_array_equal(motion["w"], [[1, 2, 3]] * 2)


def test_each_number_of_an_impact_has_its_place_and_its_default():
    numbers = carom.dtypes.plain(carom.cushion_impacts(v=(1, 2, 0)))
    assert numbers.tolist() == [1, 2, 0, 0, 0, 0, 0, 1, 0.036576, 0.028575, 0.170097, 0.2, 0.2, 0.85, 0]
    names = ("height", "radius", "mass", "mu_cloth", "mu_cushion", "restitution", "jaw_radius")
    built = carom.cushion_impacts(v=(0, 1, 2), w=(3, 4, 5), normal=(6, 7), **{name: 8 + k for k, name in enumerate(names)})
    assert carom.dtypes.plain(built).tolist() == [*range(15)]


def test_errors():
    with pytest.raises(carom.CaromError, match="mu_cushion = 3.0") as caught:
        carom.cushion(carom.cushion_impacts(v=(0, 1, 0), mu_cushion=3.0))
    assert caught.value.field == "mu_cushion"
    motion, status = carom.cushion(carom.cushion_impacts(v=(0, 1, 0), mu_cushion=[0.2, 3.0]))
    assert status.tolist() == [0, carom.Status.ERROR_MU_CUSHION] and np.isnan(motion["v"][1]).all()
    with pytest.raises(ValueError, match="omega_ratio: .* not 5.0"):
        carom.cushion(carom.cushion_impacts(v=[(0, 1, 0)]), omega_ratio=5.0, model="stronge")
    with pytest.raises(ValueError, match="model: must be one of"):
        carom.cushion(carom.cushion_impacts(v=(0, 1, 0)), model="mirrored")


def test_trace():
    impact = carom.cushion_impacts(v=(0.4, 1.5, 0), w=(0, 0, 30.0))
    points = carom.cushion_trace(impact, 21)
    np.testing.assert_allclose(points["state"]["v"][-1], carom.cushion(impact).motion["v"], atol=1e-7)
    with pytest.raises(ValueError, match="model: must be 'mathavan' or 'euler'"):
        carom.cushion_trace(impact, model="han")
