"""carom.collide and carom.cushion, their impacts, mu_ball and traces, against recorded references
and the C calls' promises.
"""

import pickle
import re
import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import columns
from numpy.testing import assert_allclose, assert_array_equal

import carom
from carom.cushions import NUMBERS

MOTION = ["vx", "vy", "vz", "wx", "wy", "wz"]
IMPACT = [*MOTION, "nx", "ny", "h", "R", "M", "mu_s", "mu_w", "e", "rho"]
SCALE = np.repeat([1.0, 0.028575], 3)


def pair_error(got, expected, impacts):
    """Largest difference of a v or R w, over the fastest of them before the collision."""
    scale = np.tile(SCALE, 2)
    speeds = np.abs(np.concatenate([impacts[:, 3:9], impacts[:, 15:21]], axis=1) * scale).max(
        axis=1
    )
    return (np.abs(got - expected) * scale).max(axis=1) / speeds


@pytest.mark.parametrize("slip", ["paper", "pooltool"])
def test_exact_references(impacts, reference, slip):
    motion, status = carom.collide(impacts, slip=slip)
    assert motion.shape == (204, 12) and status.dtype == np.int8 and not status.any()
    assert pair_error(motion, reference(f"reference-exact-{slip}.csv"), impacts).max() < 1e-6
    motion, status = carom.collide(impacts.astype(np.float32), slip=slip)
    assert motion.dtype == np.float32 and not status.any()
    assert pair_error(motion, reference(f"reference-exact-{slip}.csv"), impacts).max() < 2e-5


def test_pooltools_bits(impacts, reference):
    motion, _ = carom.collide(impacts, solver="euler", slip="pooltool", steps=1000)
    assert_array_equal(motion, reference("reference-pooltool-n1000.csv"))


def test_cushions():
    """Recorded impacts of pooltool; a mirror by hand."""
    impacts, expected = (
        columns("cushion-stronge.csv", names) for names in (IMPACT, [f"a{name}" for name in MOTION])
    )
    motion, status = carom.cushion(impacts, model="stronge", convention="pooltool")
    assert motion.shape == (479, 6) and not status.any()
    fastest = np.abs(impacts[:, :6] * SCALE).max(axis=1, keepdims=True)
    assert (np.abs((motion - expected) * SCALE) / fastest).max() < 1e-13
    pooltool = carom.cushion(
        impacts, model="stronge", convention="pooltool", omega_ratio=1.7
    ).motion
    assert (pooltool != motion).any(axis=1).mean() > 0.1
    # every number of a model reaches it
    smooth = {"model": "smooth", "smooth_q": 0.35, "smooth_x": 1.3, "smooth_t": 1.2}
    for name in NUMBERS:
        usual = smooth if name.startswith("smooth") else {"model": "stronge"}
        tolerance = {"smooth_q": 0.2, "smooth_x": 1.0, "smooth_t": 1.0, "omega_ratio": 1.2}.get(
            name, 0.1
        )
        assert (
            carom.cushion(impacts, **usual).motion
            != carom.cushion(impacts, **(usual | {name: tolerance})).motion
        ).any(), name
    motion, _ = carom.cushion(
        carom.cushion_impacts(v=(0.3, 2, 0), w=(1, 2, 3), restitution=[0.5, 1.0]), model="mirror"
    )
    assert_allclose(motion["v"], [[0.3, -1.0, 0], [0.3, -2.0, 0]], atol=1e-15)
    assert_array_equal(motion["w"], [[1, 2, 3]] * 2)


def test_shapes_and_layouts_have_the_same_bits(impacts):
    expected, _ = carom.collide(impacts)
    for k in (0, 7, 203):
        single, status = carom.collide(impacts[k])
        assert single.shape == (12,) and status.shape == () and status == 0
        assert_array_equal(single, expected[k])
    shaped, status = carom.collide(impacts.reshape(3, 68, 26))
    assert status.shape == (3, 68)
    assert_array_equal(shaped.reshape(204, 12), expected)
    assert_array_equal(carom.collide(np.asfortranarray(impacts)).motion, expected)
    assert_array_equal(carom.collide(impacts[::-2]).motion, expected[::-2])
    assert_array_equal(carom.collide(impacts.astype(">f8")).motion, expected)
    records = impacts.view(carom.dtypes.impact).reshape(204)
    moved, _ = carom.collide(records)
    assert moved.dtype == carom.dtypes.result
    assert_array_equal(moved["b"]["w"], expected[:, 9:])
    assert_array_equal(carom.collide(records[3]).motion["a"]["v"], expected[3, :3])
    many = np.tile(impacts, (50, 1))
    assert_array_equal(carom.collide(many, threads=3).motion, np.tile(expected, (50, 1)))
    motion, status = carom.collide(np.empty((0, 26)))
    assert motion.shape == (0, 12) and status.shape == (0,)


def test_out_is_written_and_checked(impacts):
    out = (np.empty((204, 12)), np.empty(204, np.int8))
    result = carom.collide(impacts, out=out)
    assert result.motion is out[0] and result.status is out[1]
    assert_array_equal(out[0], carom.collide(impacts).motion)
    with pytest.raises(ValueError, match=r"out\[0\].*\(204, 12\)"):
        carom.collide(impacts, out=(np.empty((203, 12)), out[1]))
    frozen = out[0].copy()
    frozen.flags.writeable = False
    with pytest.raises(ValueError, match="writeable"):
        carom.collide(impacts, out=(frozen, out[1]))


def test_a_bad_row_costs_itself(impacts):
    expected, _ = carom.collide(impacts)
    invalid = impacts.copy()
    invalid[5, 10], invalid[6, 3:6] = -1.0, [-1.0, 0.0, 0.0]
    motion, status = carom.collide(invalid)
    assert status[5] == carom.Status.ERROR_MASS and np.isnan(motion[5]).all()
    assert status[6] == carom.Status.SEPARATING and (motion[6, :3] == [-1.0, 0.0, 0.0]).all()
    keep = (np.arange(204) < 5) | (np.arange(204) > 6)
    assert_array_equal(motion[keep], expected[keep])
    motion, status = carom.cushion(carom.cushion_impacts(v=(0, 1, 0), mu_cushion=[0.2, 3.0]))
    assert status.tolist() == [0, carom.Status.ERROR_MU_CUSHION] and np.isnan(motion["v"][1]).all()


def test_impacts_broadcast_and_have_their_places_and_defaults():
    built = carom.impacts(
        v_a=np.ones((5, 1, 3)) * [1, 0, 0], r_b=[0.05715, 0, 0], mu_ball=np.linspace(0, 0.1, 4)
    )
    assert built.shape == (5, 4) and built.dtype == carom.dtypes.impact
    assert carom.collide(built).motion.shape == (5, 4)
    assert carom.dtypes.plain(built).shape == (5, 4, 26) and carom.dtypes.plain(
        built[0, 0]
    ).shape == (26,)
    assert_array_equal(
        carom.collide(carom.dtypes.plain(built)).motion,
        carom.dtypes.plain(carom.collide(built).motion),
    )
    ball = [0.028575, 0.170097, 0.2]  # radius, mass, friction with the cloth, of a pool ball
    built = carom.impacts(v_a=(1, 2, 0), r_b=(0.05715, 0, 0))
    assert carom.dtypes.plain(built).tolist() == [
        0,
        0,
        0,
        1,
        2,
        0,
        0,
        0,
        0,
        *ball,
        0.05715,
        *[0] * 8,
        *ball,
        0.05,
        0.95,
    ]
    vectors = {
        name: np.arange(3) + 3 * k
        for k, name in enumerate(["r_a", "v_a", "w_a", "r_b", "v_b", "w_b"])
    }
    built = carom.impacts(
        **vectors,
        radius=20,
        mass=21,
        mu_slide=22,
        mass_b=23,
        mu_slide_b=24,
        mu_ball=25,
        restitution=26,
    )
    assert carom.dtypes.plain(built).tolist() == [
        *range(9),
        20,
        21,
        22,
        *range(9, 18),
        20,
        23,
        24,
        25,
        26,
    ]
    numbers = carom.dtypes.plain(carom.cushion_impacts(v=(1, 2, 0)))
    assert numbers.tolist() == [
        1,
        2,
        0,
        0,
        0,
        0,
        0,
        1,
        0.03629025,
        0.028575,
        0.170097,
        0.2,
        0.3,
        0.97,
        0,
    ]
    snooker = carom.cushion_impacts(v=(1, 2, 0), game="snooker", model="smooth", mass=0.15)
    kind = carom.balls([[0.5, 0.5]], game="snooker")["kind"][0]
    assert snooker["restitution"] == kind["restitution_cushion"] and snooker["mass"] == 0.15
    assert snooker["height"] == kind["nose_height"] and snooker["radius"] == kind["radius"]
    lossless = carom.cushion(snooker, model="smooth").motion
    assert (carom.cushion(snooker, model="smooth", game="snooker").motion != lossless).any()
    small = carom.cushion_impacts(v=(1, 2, 0), game="blackball", model="smooth")
    assert small["radius"] == carom.balls([[0, 0]], game="blackball")["kind"]["radius"][0]
    names = ["height", "radius", "mass", "mu_slide", "mu_cushion", "restitution", "jaw_radius"]
    built = carom.cushion_impacts(
        v=(0, 1, 2), w=(3, 4, 5), normal=(6, 7), **{name: 8 + k for k, name in enumerate(names)}
    )
    assert carom.dtypes.plain(built).tolist() == [*range(15)]


def test_mu_ball(impacts):
    a, b, c = carom.alciatore()
    shot = carom.impacts(v_a=[(0, 0, 0), (0, 3, 0)], r_b=(0.05715, 0, 0))
    assert_allclose(carom.mu_ball(shot), a + b * np.exp(-c * np.array([0.0, 3.0])), rtol=1e-14)
    assert (
        carom.mu_ball(impacts).shape == (204,) and carom.mu_ball(impacts[0], law=(0.1, 0, 1)) == 0.1
    )


def test_traces(impacts):
    points = carom.trace(impacts[0], 11)
    assert (
        points.shape == (11,) and points["normal"][0] == 0 and (np.diff(points["normal"]) > 0).all()
    )
    assert_allclose(points["state"][-1]["a"]["v"], carom.collide(impacts[0]).motion[:3], atol=1e-5)
    impact = carom.cushion_impacts(v=(0.4, 1.5, 0), w=(0, 0, 30.0))
    assert_allclose(
        carom.cushion_trace(impact, 21)["state"]["v"][-1],
        carom.cushion(impact).motion["v"],
        atol=1e-7,
    )


def test_the_lock_of_the_interpreter_is_released(impacts):
    """While one call computes, this thread counts on: with the lock held it could not before the
    call has ended.
    """
    many = np.tile(impacts, (20, 1))
    done, found = threading.Event(), []

    def work():
        found.append(carom.collide(many, solver="euler", steps=2000).motion)
        done.set()

    thread = threading.Thread(target=work)
    counted = 0
    thread.start()
    while not done.wait(0.001):
        counted += 1
    thread.join()
    assert counted > 5
    assert_array_equal(found[0], carom.collide(many, solver="euler", steps=2000).motion)


def test_statuses_and_labels_are_those_of_c():
    from carom._carom import ffi

    header = (Path(__file__).parents[3] / "core/include/carom.h").read_text(encoding="utf-8")
    enumerators = header[header.index("enum carom_status") :].partition("}")[0]
    names = {
        int(value): name
        for name, value in re.findall(r"^  CAROM_(\w+) = (-?\d+),?", enumerators, re.M)
    }
    assert {status.value: status.name for status in carom.Status} == names and len(names) > 50
    assert (
        list(carom.Status)[:3] == [0, 1, -1]
        and pickle.loads(pickle.dumps(carom.Status.ERROR_CUE_BALL)) is carom.Status.ERROR_CUE_BALL
    )
    for kind, enumeration, prefix in (
        (carom.Label, "carom_label", "CAROM_BALL_"),
        (carom.EventType, "carom_event_type", "CAROM_EVENT_"),
    ):
        names = {
            value: name.removeprefix(prefix)
            for value, name in ffi.typeof(enumeration).elements.items()
        }
        assert {member.value: member.name for member in kind} == names
