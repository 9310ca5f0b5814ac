"""Derivatives of shots against differences, and what is refused."""

import pickle

import numpy as np
import pytest
from conftest import by_line, refused, same_bits
from numpy.testing import assert_allclose, assert_array_equal

import carom

TABLE = carom.tables.pool_9ft()
CLOSED = {"ball_model": "inelastic", "cushion_model": "smooth"}


def layout():
    return carom.balls(np.array([[0.4, 0.5], [0.6, 1.5], [0.9, 2.0]])), carom.cue(
        speed=1.5, phi=79.0, a=0.1, b=0.1
    )


def test_tangents_are_differences():
    balls, cue = layout()
    shot = carom.simulate(TABLE, balls, cue, **CLOSED)
    found = carom.tangents(
        shot, ["cue.speed", "cue.phi", "balls[1].r", "kind.mu_slide"], times=[0.5, 1.0]
    )
    assert found.names == (
        "cue.speed",
        "cue.phi",
        "balls[1].r[0]",
        "balls[1].r[1]",
        "kind.mu_slide",
    )
    assert found.units == ("m/s", "deg", "m", "m", "1")
    assert found.final["r"].shape == (3, 2, 5) and found.final["w"].shape == (3, 3, 5)
    assert found.at["v"].shape == (2, 3, 2, 5) and found.time.shape == (shot.count, 5)
    assert (found.reach > 0).all() and not (found.flags & carom.Flag.KINK).any()

    def moved(h, j):
        layout, stroke = balls.copy(), cue.copy()
        if j < 2:
            stroke["speed" if j == 0 else "phi"] += h
        elif j < 4:
            layout["state"]["r"][1, j - 2] += h
        else:
            layout["kind"]["mu_slide"] += h
        return carom.simulate(TABLE, layout, stroke, **CLOSED)

    for j in range(5):
        h = 1e-7
        more, less = moved(h, j), moved(-h, j)
        for name in "rvw":
            wide = 3 if name == "w" else 2
            difference = (more.final[name] - less.final[name])[:, :wide] / (2 * h)
            assert_allclose(
                found.final[name][..., j],
                difference,
                atol=1e-5 * np.abs(found.states[..., j]).max(),
            )
        difference = (more.positions([0.5, 1.0]) - less.positions([0.5, 1.0]))[..., :2] / (2 * h)
        assert_allclose(
            found.at["r"][..., j], difference, atol=1e-5 * np.abs(found.states_at[..., j]).max()
        )


WRT = ["cue.speed", "cue.phi", "cue.a", "cue.b"]


def second_differences(balls, cue, h, models):
    """Of the places at the end, from their values: (balls, 2, 4, 4)."""
    fields = [name[4:] for name in WRT]
    signs = [(i, j, s, t) for i in range(4) for j in range(4) for s in (1, -1) for t in (1, -1)]
    cues = np.repeat(cue.reshape(1), len(signs))
    for k, (i, j, s, t) in enumerate(signs):
        cues[fields[i]][k] += s * h[i]
        cues[fields[j]][k] += t * h[j]
    ends = (
        carom.simulate_batch(TABLE, balls, cues, **models)
        .final["r"][..., :2]
        .reshape(4, 4, 2, 2, -1, 2)
    )
    mixed = ends[:, :, 0, 0] - ends[:, :, 0, 1] - ends[:, :, 1, 0] + ends[:, :, 1, 1]
    return np.moveaxis(
        mixed / (4.0 * h[:, np.newaxis] * h)[..., np.newaxis, np.newaxis], (0, 1), (-2, -1)
    )


def test_second_derivatives_are_differences_of_values():
    """On 100 shots, compared for changes of a hundredth of the reach: those of values have errors
    of their own, in fourth derivatives.
    """
    random, shots, contacts, errors, off = np.random.default_rng(5), 0, 0, [], []
    while shots < 100:
        balls = carom.balls(random.uniform([0.15, 0.3], [1.1, 2.2], (3, 2)))
        direction = np.degrees(
            np.arctan2(*(balls["state"]["r"][1] - balls["state"]["r"][0])[1::-1])
        )
        cue = carom.cue(
            speed=random.uniform(1.0, 3.0),
            phi=direction + random.uniform(-10.0, 10.0),
            a=random.uniform(-0.2, 0.2),
            b=random.uniform(-0.2, 0.3),
        )
        try:
            shot = carom.simulate(TABLE, balls, cue, **CLOSED)
        except carom.CaromError:
            continue  # balls overlap
        found = carom.hessian(shot, WRT)
        if (
            not found.states.any()
            or (found.first.flags & (carom.Flag.SIMULTANEOUS | carom.Flag.KINK)).any()
        ):
            continue
        shots += 1
        contacts += (shot.events["type"] == carom.EventType.BALL_BALL).any()
        assert found.final["r"].shape == (3, 2, 4, 4) and np.isfinite(found.states).all()
        assert_array_equal(found.states, found.states.swapaxes(-1, -2))
        errors.append(found.error)
        h = 1e-2 * np.minimum(found.first.reach, 0.1)
        second, weight = second_differences(balls, cue, h, CLOSED), h[:, np.newaxis] * h
        off.append(
            np.abs((found.final["r"] - second) * weight).max() / np.abs(second * weight).max()
        )
    assert contacts > 50 and np.median(errors) < 1e-6 and np.quantile(errors, 0.9) < 1e-4, (
        np.quantile(errors, [0.5, 0.9, 1.0])
    )
    assert np.median(off) < 1e-4 and np.quantile(off, 0.9) < 1e-2, np.quantile(off, [0.5, 0.9, 1.0])


def test_second_derivatives_of_a_ball_that_rolls():
    """It rolls v^2/(2 mu g), v in proportion to the speed of the cue, so that d2/dv2 = 2 y/v^2, and
    y falls like 1/mu.
    """
    balls = carom.balls([[0.6, 0.3]])
    speed, mu = 0.5, float(balls["kind"]["mu_roll"][0])
    shot = carom.simulate(TABLE, balls, carom.cue(speed=speed, b=0.4), **CLOSED)
    found, far = (
        carom.hessian(shot, ["cue.speed", "kind.mu_roll", "balls[0].r[1]"]),
        shot.final["r"][0, 1] - 0.3,
    )
    expected = far * np.array(
        [
            [2.0 / speed**2, -2.0 / speed / mu, 0.0],
            [-2.0 / speed / mu, 2.0 / mu**2, 0.0],
            [0.0, 0.0, 0.0],
        ]
    )
    assert_allclose(found.final["r"][0, 1], expected, rtol=1e-5, atol=1e-6)
    # of a radius, with the height of the balls
    by_radius = [
        carom.tangents(
            carom.simulate(
                TABLE,
                carom.balls([[0.6, 0.3]], radius=balls["kind"]["radius"] + h),
                carom.cue(speed=2.0),
                **CLOSED,
            ),
            ["kind.radius"],
        ).final["r"]
        for h in (1e-7, -1e-7)
    ]
    found = carom.hessian(
        carom.simulate(TABLE, balls, carom.cue(speed=2.0), **CLOSED), ["kind.radius"]
    )
    assert_allclose(
        found.final["r"][..., 0], (by_radius[0] - by_radius[1]) / 2e-7, rtol=1e-5, atol=1e-3
    )


def test_second_derivatives_of_batches(monkeypatch):
    """They have the bits of single shots, also some at a time and with kinds apart; along a vector
    they are products with it.
    """
    balls, cue = layout()
    cues = carom.cue(speed=1.5, phi=np.linspace(76.0, 81.0, 6).reshape(2, 3), a=0.1, b=0.1)
    cues["b"][1, 0] = 2.0
    wrt = [*WRT, "balls[1].r", "kind.mu_roll"]
    shots = carom.simulate_batch(
        TABLE, balls["state"], cues, kinds=balls["kind"], room=99, **CLOSED
    )
    found, vectors = (
        carom.hessian(shots, wrt),
        np.random.default_rng(1).normal(size=(2, 3, 7)) * [0.1, 0.1, 0.01, 0.01, 0.01, 0.01, 1e-3],
    )
    monkeypatch.setattr(carom.derivatives, "AT_ONCE", 5)
    along, repeat = carom.hessian(shots, wrt, along=vectors), carom.hessian(shots, wrt)
    assert (
        found.states.shape == (2, 3, 3, 9, 7, 7)
        and found.final["z"].shape == (2, 3, 3, 7, 7)
        and along.final["w"].shape == (2, 3, 3, 3, 7)
    )
    assert np.isnan(found.states[1, 0]).all() and np.isnan(along.error).all()
    for k in np.ndindex(2, 3):
        if k != (1, 0):
            single = carom.hessian(shots[k], wrt)
            assert (
                found.states[k].tobytes() == repeat.states[k].tobytes() == single.states.tobytes()
                and found.error[k] == single.error
            )
            expected = single.states @ vectors[k]
            assert_allclose(along.states[k], expected, rtol=0.0, atol=1e-5 * np.abs(expected).max())


def test_jacobian_has_the_batch_in_front():
    balls, cue = layout()
    cues = np.repeat(cue.reshape(1), 6).reshape(2, 3)
    cues["phi"] += np.linspace(0.0, 0.5, 6).reshape(2, 3)
    cues["b"][1, 2] = 2.0
    found = carom.jacobian(TABLE, balls, cues, ["cue.speed", "kind.mu_roll"], **CLOSED)
    assert found.shape == (2, 3, 3, 2, 2)
    assert np.isnan(found[1, 2]).all() and np.isfinite(found[:, :2]).all()
    single = carom.tangents(
        carom.simulate(TABLE, balls, cues[0, 1], **CLOSED), ["cue.speed", "kind.mu_roll"]
    )
    assert_array_equal(found[0, 1], single.final["r"])


@pytest.mark.parametrize(
    "models", [CLOSED, {}, {"cushion_model": "mathavan"}, {"t_final": 0.7, **CLOSED}]
)
@pytest.mark.parametrize("threads", [0, 3])
def test_batches_have_the_bits_of_single_shots(models, threads):
    table, random = carom.tables.pool_9ft(), np.random.default_rng(11)
    layouts = carom.balls(
        random.uniform([0.1, 0.2], [0.5, 0.8], (9, 1, 2))
        + np.array([[0.0, 0.0], [0.2, 0.9], [0.5, 1.4]]),
        cushion_model=models.get("cushion_model", "default"),
    )
    cues = carom.cue(speed=random.uniform(0.8, 3.0, 9), phi=random.uniform(60.0, 85.0, 9), a=0.1)
    cues["b"][4] = 2.0
    names = ["cue.speed", "cue.phi", "balls[1].r", "kind.restitution", "table.slope_x"]
    shots = carom.simulate_batch(table, layouts, cues, room=200, **models)
    found = carom.tangents(shots, names, times=[0.1, 0.4], threads=threads)
    assert found.status[4] == carom.Status.ERROR_MISCUE and (found.status != 0).sum() == 1
    assert found.states.shape == (9, 3, carom.derivatives.STATE, 6) and found.reach.shape == (9, 6)
    ofs = {
        name: carom.jacobian(
            table,
            layouts,
            cues,
            names,
            of=name,
            times=[0.1, 0.4],
            room=200,
            threads=threads,
            **models,
        )
        for name in ("final.r", "at.w", "time", "reach")
    }
    for k in range(9):
        if k == 4:
            assert (
                np.isnan(found.states[k]).all()
                and np.isnan(found.reach[k]).all()
                and (found.flags[k] == -1).all()
            )
            assert all(np.isnan(array[k]).all() for array in ofs.values())
            continue
        single_shot = carom.tangents(
            carom.simulate(table, layouts[k], cues[k], **models), names, times=[0.1, 0.4]
        )
        events = len(single_shot.time)
        for batch, single in (
            (found.states[k], single_shot.states),
            (found.states_at[k], single_shot.states_at),
            (found.time[k, :events], single_shot.time),
            (found.flags[k, :events], single_shot.flags),
            (found.reach[k], single_shot.reach),
            (found.error[k], single_shot.error),
            (ofs["final.r"][k], single_shot.final["r"]),
            (ofs["at.w"][k], single_shot.at["w"]),
            (ofs["time"][k, :events], single_shot.time),
            (ofs["reach"][k], single_shot.reach),
        ):
            assert np.isfinite(single).any() and same_bits(batch, np.ascontiguousarray(single))
        assert np.isnan(found.time[k, events:]).all() and (found.flags[k, events:] == -1).all()
        # a shot that is taken out of the batch knows how it was played
        repeat = carom.tangents(shots[k], names)
        assert same_bits(repeat.states, single_shot.states)


def test_jacobians_of_more_shots_than_are_kept_at_a_time(monkeypatch):
    balls, _ = layout()
    cues = carom.cue(speed=1.5, phi=np.linspace(76.0, 81.0, 23))
    names = [
        "cue.phi",
        *(
            f"balls[{i}].kind.{field}"
            for i in range(3)
            for field in carom.dtypes.ball_kind.names
            if field != "radius"
        ),
    ]
    names = names[: carom.derivatives.MOST - 1]
    whole = {
        name: carom.jacobian(TABLE, balls, cues, names, of=name, **CLOSED)
        for name in ("final.v", "final.r", "time", "reach")
    }
    monkeypatch.setattr(carom.derivatives, "AT_ONCE", 5)
    monkeypatch.setattr(carom.derivatives, "MOST", 20)
    for name, array in whole.items():
        part = carom.jacobian(
            TABLE, np.broadcast_to(balls, (23, 3)), cues, names, of=name, **CLOSED
        )
        assert_allclose(
            part, array, rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(array[np.isfinite(array)]))
        )
        assert part.shape == array.shape and np.isfinite(part).sum() == np.isfinite(array).sum() > 0
    # none, one, and one of too many events for its room
    assert carom.jacobian(TABLE, balls, cues[:0], names, **CLOSED).shape == (0, 3, 2, len(names))
    assert carom.jacobian(TABLE, balls, cues[3], names, **CLOSED).shape == (3, 2, len(names))
    assert np.isnan(carom.jacobian(TABLE, balls, cues, names, room=2, **CLOSED)).all()
    with pytest.raises(ValueError, match="layouts"):
        carom.jacobian(TABLE, balls[0], cues, names)


def test_a_shot_knows_what_it_was_played_with():
    """Its cue, its table and its models, also in a pickle; what is changed afterwards is not the
    shot's.
    """
    table = carom.tables.pool_9ft()
    balls, cue = layout()
    shot, names = (
        carom.simulate(table, balls, cue, t_final=2.0, **CLOSED),
        ["cue.phi", "kind.mu_slide"],
    )
    expected = carom.tangents(shot, names).states.tobytes()
    assert (
        shot.options.cushion_model == "smooth" and shot.options.t_final == 2.0 and shot.cue == cue
    )
    repeat = carom.resume(shot, t_final=3.0)
    assert repeat.options == shot.options._replace(t_final=3.0) and repeat.cue == cue
    assert carom.tangents(pickle.loads(pickle.dumps(shot)), names).states.tobytes() == expected
    cues = np.repeat(cue.reshape(1), 3)
    cues["speed"][1] = 1.7
    shots = carom.simulate_batch(table, balls, cues, room=99, **CLOSED)
    assert shots[1].cue == cues[1] and pickle.loads(pickle.dumps(shots[1])).cue == cues[1]
    cue["phi"], balls["kind"]["mu_slide"] = 12.0, 0.3
    assert carom.tangents(shot, names).states.tobytes() == expected
    with pytest.raises(
        ValueError, match=r"wrt: the list is empty; name at least one parameter, such as 'cue\.phi'"
    ):
        carom.tangents(shot, [])


def test_events_that_were_not_kept():
    """The error says which room keeps them, and in that room there are derivatives."""
    balls, cue = layout()
    cues = carom.cue(speed=[1.5, 1.5, 3.0], phi=79.0, b=[0.1, 2.0, 0.1])
    for room in (0, 4):
        shots = carom.simulate_batch(TABLE, balls, cues, room=room)
        most = shots.count.max()
        with pytest.raises(
            ValueError,
            match=f"^shot: 2 of 3 shots have more events than room={room} keeps; use room={most}$",
        ):
            carom.tangents(shots, ["cue.phi"])
        with pytest.raises(
            ValueError,
            match=f"^shot: 1 of 1 shots have more events than room={room} keeps; use room={most}$",
        ):
            carom.tangents(shots[2], ["cue.phi"])
    found = carom.tangents(carom.simulate_batch(TABLE, balls, cues, room=most), ["cue.phi"])
    assert np.isfinite(found.states[[0, 2]]).all() and np.isnan(found.states[1]).all()


def test_what_is_not_known():
    balls, cue = layout()
    with pytest.raises(carom.CaromError) as error:
        carom.tangents(carom.simulate(TABLE, balls, cue, world="pooltool"), ["cue.phi"])
    assert error.value.status is carom.Status.ERROR_TANGENT


def hessian_of_one(wrt, **how):
    shot = carom.simulate(TABLE, carom.balls([[0.6, 0.3]]), carom.cue(speed=0.5, b=0.4), **CLOSED)
    return carom.hessian(shot, wrt, **how)


def tangents_of_brief_records():
    cues = carom.cue(speed=[1.5, 1.5, 3.0], phi=79.0, b=[0.1, 2.0, 0.1])
    shots = carom.simulate_batch(TABLE, layout()[0], cues, room=99, records="brief")
    return carom.tangents(shots, ["cue.phi"])


# A call, the class of its error, and a pattern with which its message begins.
REFUSALS = [
    (
        lambda: hessian_of_one(["table.nose_height"], along=None),
        ValueError,
        r"wrt: 'table\.nose_height' has no second derivatives; use fields of the balls, or of a cue that strikes",
    ),
    (
        lambda: hessian_of_one([], along=None),
        ValueError,
        r"wrt: the list is empty; name at least one parameter, such as 'cue\.phi'",
    ),
    (
        lambda: hessian_of_one(["cue.phi"], along=[1.0, 2.0]),
        ValueError,
        r"along: the shape is \(2,\), but must be \(1,\) or \(1,\), one component per direction",
    ),
    (lambda: hessian_of_one(["cue.phi"], along=[[1.0]]), ValueError, "along: the shape"),
    (lambda: tangents_of_brief_records(), ValueError, '.*records="full"'),
    (
        lambda: carom.tangents(carom.simulate(TABLE, *layout()), ["cue.phi"], times=[1.0, 0.5]),
        ValueError,
        "times",
    ),
]


@pytest.mark.parametrize(("call", "error", "message"), by_line(REFUSALS))
def test_refusals(call, error, message):
    refused(call, error, message)
