"""The cushion of a table by three banks."""

import pytest

import carom


def test_three_banks():
    usual = carom.calibrate(None)
    kind = carom.balls([[0.5, 0.5]])["kind"][0]
    assert usual.constants["restitution_cushion"] == kind["restitution_cushion"]
    assert usual.misfit == 0 and all(4 < place < 8 for place in usual.comes_back)
    same = carom.calibrate(usual.comes_back)
    assert same.constants["mu_cushion"] == pytest.approx(kind["mu_cushion"], abs=1e-6)
    lively = carom.calibrate([4.7, 5.6, 5.6], carom.tables.pool_9ft())
    assert lively.constants["restitution_cushion"] > kind["restitution_cushion"]
    assert 0 < lively.errors["restitution_cushion"] < 0.05 and lively.misfit < 2
    carom.balls([[0.5, 0.5]], **lively.constants)
    slow = carom.balls([[0.5, 0.5]], conditions=("slow_cloth", "old_cushion"), mu_cushion=0.3)
    assert slow["kind"]["mu_roll"][0] > kind["mu_roll"]
    assert slow["kind"]["restitution_cushion"][0] < kind["restitution_cushion"]
    assert slow["kind"]["mu_cushion"][0] == 0.3
