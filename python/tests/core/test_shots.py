"""Whole shots: the command's output, batches, times between events, stopped shots, pictures,
frames.
"""

import json
import os
import pickle
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from conftest import same_bits
from numpy.testing import assert_allclose, assert_array_equal

import carom

TABLE = carom.tables.pool_9ft()
RACK = carom.racks.nineball(TABLE)


@pytest.mark.parametrize(
    ("words", "fields"),
    [
        ("", {}),
        ("--speed 3 --aim 95 --tip 0.2,-0.3", {"speed": 3.0, "phi": 95.0, "tip": (0.2, -0.3)}),
        (
            "--ball-speed 3 --aim 80 --tip -0.1,0.1",
            {"ball_speed": 3.0, "phi": 80.0, "tip": (-0.1, 0.1)},
        ),
        (
            "--speed 3 --aim 80 --tip -0.1,0.1 --elevation 20",
            {"speed": 3.0, "phi": 80.0, "a": 0.1, "b": 0.1, "theta": 20.0},
        ),
    ],
)
def test_a_shot_has_one_meaning(words, fields):
    """What is typed to the command is the same stroke here, and ends with the same bits."""
    command = os.path.join(os.environ.get("CAROM_BUILD", ""), "carom")
    if not os.access(command, os.X_OK) or os.path.isdir(command):
        pytest.skip("CAROM_BUILD names no build with the command carom")
    forms = [
        command,
        "shoot",
        "--cue",
        "0.6,0.8",
        "--balls",
        "0.5,1.6",
        *words.split(),
        "--events",
        "none",
    ]
    theirs = json.loads(
        subprocess.run(forms, capture_output=True, text=True, check=True).stdout.splitlines()[-1]
    )
    cue = carom.cue(**fields)
    for theirs_name, name in (
        ("V0", "speed"),
        ("phi", "phi"),
        ("theta", "theta"),
        ("a", "a"),
        ("b", "b"),
    ):
        assert theirs["cue"][theirs_name] == cue[name], name
    shot = carom.simulate(TABLE, carom.balls([[0.6, 0.8], [0.5, 1.6]]), cue)
    for name, state in zip(("cue", "1"), shot.final, strict=True):
        assert theirs["final"]["balls"][name][1:4] == state["r"].tolist()


def test_the_speed_of_a_ball():
    """`ball_speed` is what a ball of the game gets, for many cues too."""
    cues = carom.cue(
        ball_speed=[[1.0], [4.0]], tip=[[0.0, 0.0], [0.3, -0.2], [-0.4, 0.1]], game="snooker"
    )
    kind = carom.balls([[0.5, 0.5]], game="snooker")[0]["kind"]
    speeds = [[np.hypot(*carom.struck(cue, kind)["v"][:2]) for cue in row] for row in cues]
    assert_allclose(speeds, [[1.0] * 3, [4.0] * 3], rtol=1e-14)
    assert (cues["a"][0] == [0.0, -0.3, 0.4]).all()


def test_a_batch_has_the_bits_of_single_shots():
    cues = carom.cue(speed=[[6.0], [9.0]], phi=np.linspace(88.0, 92.0, 5))
    options = {"cushion_model": "han"}
    rack = carom.racks.nineball(TABLE, **options)
    shots = carom.simulate_batch(TABLE, rack, cues, room=1000, threads=3, **options)
    assert shots.shape == (2, 5) and not shots.failures() and (shots.count > 10).all()
    for index in np.ndindex(2, 5):
        single = carom.simulate(TABLE, rack, cues[index], **options)
        assert shots[index].count == single.count and shots.time[index] == single.time
        assert np.array_equal(shots[index].events, single.events)
        assert same_bits(shots.final[index], single.final)
        assert_array_equal(shots[index].positions([0.3, 1.0]), single.positions([0.3, 1.0]))
    finals = carom.simulate_batch(TABLE, rack, cues, **options)
    assert same_bits(finals.final, shots.final)
    # Where events were not kept, the shot is played again.
    assert_array_equal(finals[1, 2].positions([0.3, 1.0]), shots[1, 2].positions([0.3, 1.0]))


@pytest.fixture(scope="module")
def breaks():
    """Breaks of which every 3rd is in error: the batch, and each shot alone, None in place of
    those.
    """
    cues = carom.cue(
        speed=9.0,
        phi=np.linspace(85.0, 95.0, 12),
        a=np.where(np.arange(12) % 3 == 2, 1.0, 0.0),
        b=0.1,
    )
    alone = [carom.simulate(TABLE, RACK, cue) if k % 3 != 2 else None for k, cue in enumerate(cues)]
    return lambda **options: carom.simulate_batch(TABLE, RACK, cues, **options), alone


@pytest.mark.parametrize(
    "options", [{}, {"room": 1000}, {"room": 40}, {"room": 1000, "records": "brief"}]
)
def test_trajectories_of_a_batch(breaks, options):
    """Those of single shots, bit for bit, whatever was kept, in any order of times, on any number
    of threads.
    """
    play, alone = breaks
    shots = play(**options)
    times = np.array([[0.0, 0.7, 0.31], [99.0, 0.31, 0.0]])
    positions = shots.positions(times, threads=3)
    states = shots.states(times)
    assert positions.shape == (12, 2, 3, 10, 3) and states.shape == (12, 2, 3, 10)
    for k, single in enumerate(alone):
        if single is None:
            assert shots.record["count"][k] == 0 and shots.record["time"][k] == 0.0
            assert (
                np.isnan(positions[k]).all()
                and np.isnan(states["w"][k]).all()
                and (states["label"][k] == -1).all()
            )
            with pytest.raises(carom.CaromError, match="miscue|a\\^2"):
                shots[k].states(0.5)
        else:
            assert same_bits(states[k], single.states(times))
            assert_array_equal(positions[k], single.positions(times))
            assert same_bits(shots[k].states(times), states[k])
    assert_array_equal(shots[3:9:2].positions(times), positions[3:9:2])
    assert_array_equal(shots[[7, 1]].positions(0.5), shots.positions(0.5)[[7, 1]])
    assert_array_equal(pickle.loads(pickle.dumps(shots)).positions(times), positions)
    assert shots.positions(np.zeros(0)).shape == (12, 0, 10, 3) and shots[:0].positions(
        1.0
    ).shape == (0, 10, 3)


def test_shots_that_were_changed_are_not_played_again():
    cues = carom.cue(speed=[8.0, 8.0], phi=[89.0, 90.0])
    shots = carom.simulate_batch(TABLE, RACK, cues)
    cues["speed"][0] = 7.0
    with pytest.raises(
        ValueError,
        match=r"layouts, cues: changed since the shots were played, so the shots cannot be played again; simulate_batch\(room=\.\.\.\) keeps their",
    ):
        shots.positions(1.0)
    assert np.isfinite(shots[1:2].positions(1.0)).all()


def test_slices_and_iteration(breaks):
    play, alone = breaks
    shots = play(room=300, features=True)
    assert [shot.count for shot in shots] == shots.count.tolist() and len(list(shots)) == len(
        shots
    ) == 12
    part = shots[1:8:3]
    assert (
        isinstance(part, carom.Shots)
        and part.shape == (3,)
        and part.time.tolist() == shots.time[1:8:3].tolist()
    )
    assert np.array_equal(part[1].events, alone[4].events) and np.array_equal(
        shots[4].events, alone[4].events
    )
    assert part.features.pocket.tolist() == shots.features.pocket[1:8:3].tolist()
    assert [index for index, _ in shots[shots.status < 0].failures()] == [(0,), (1,), (2,), (3,)]
    last = shots[-2]
    assert (
        last.count == alone[10].count
        and same_bits(last.balls, alone[10].balls)
        and last.status is carom.Status.OK
    )
    copy = pickle.loads(pickle.dumps(last))
    assert np.array_equal(copy.events, last.events) and repr(copy) == repr(last)
    assert not hasattr(last, "colour")
    with pytest.raises(IndexError):
        shots[12]
    grid = carom.simulate_batch(
        TABLE, RACK, carom.cue(speed=[[5.0], [6.0]], phi=[89.0, 90.0, 91.0])
    )
    assert grid[1, :].shape == (3,) and grid[:, 2].time.tolist() == grid.time[:, 2].tolist()
    assert_array_equal(grid[:, 1:].positions(0.4), grid.positions(0.4)[:, 1:])
    assert [shot.time for shot in grid.flat] == grid.time.reshape(-1).tolist()
    assert [row.shape for row in grid] == [(3,), (3,)] and (grid.ndim, grid.size) == (2, 6)
    single = carom.simulate_batch(TABLE, RACK, carom.cue(speed=5.0), features=True)
    assert (
        single.shape == ()
        and single.features.contact[0] == 1
        and single.positions([0.1, 0.2]).shape == (2, 10, 3)
        and single.time > 1.0
    )


def test_a_shot_of_a_batch_is_made_in_few_calls(calls):
    """shots[k] makes the arrays of a shot when they are asked for."""
    cues = carom.cue(speed=3.0, phi=np.linspace(60.0, 120.0, 100))
    shots = carom.simulate_batch(TABLE, carom.balls([[0.5, 0.6], [0.7, 1.5]]), cues)
    assert calls(lambda: [shots[k] for k in range(100)]) <= 5 * 100


def features_of(shot, cue):
    """By a plain walk over the events of one shot."""
    count = len(shot.balls)
    found = {
        "contact": [-1, -1],
        "contact_time": [np.inf, np.inf],
        "cushions_before": [0, 0],
        "cushions_after": 0,
    }
    found |= {"pocket": [-1] * count, "pocket_time": [np.inf] * count, "cushions": [0] * count}
    features = []
    for event in shot.events:
        kind, a, b = carom.EventType(event["type"]).name, int(event["a"]), int(event["b"])
        if kind in ("RAIL", "JAW"):
            found["cushions"][a] += 1
            found["cushions_after"] += len(features) > 0
        elif kind == "POCKET":
            found["pocket"][a], found["pocket_time"][a] = b, event["time"]
        elif (
            kind == "BALL_BALL"
            and cue in (a, b)
            and len(features) < 2
            and a + b - cue not in features
        ):
            k = len(features)
            features.append(a + b - cue)
            found["contact"][k], found["contact_time"][k], found["cushions_before"][k] = (
                a + b - cue,
                event["time"],
                found["cushions"][cue],
            )
    return found


@pytest.mark.parametrize(
    "options", [{}, {"room": 500, "threads": 3}, {"room": 20}, {"room": 500, "records": "brief"}]
)
def test_features(breaks, options):
    play, alone = breaks
    shots = play(features=True, **options)
    plain = play(**{**options, "features": False})
    assert same_bits(shots.final, plain.final) and same_bits(shots.status, plain.status)
    assert shots.record[["time", "count"]].tolist() == plain.record[
        ["time", "count"]
    ].tolist() and not hasattr(plain, "features")
    seen = []
    for k, single in enumerate(alone):
        if single is None:
            assert (shots.features.contact[k] == -1).all() and not shots.features.cushions[k].any()
            continue
        if options.get("room") == 500:
            assert np.array_equal(shots[k].events, plain[k].events)
        for name, value in features_of(single, 0).items():
            assert getattr(shots.features, name)[k].tolist() == value, name
        seen.append(features_of(single, 0))
    assert sum(max(found["pocket"]) >= 0 for found in seen) > 1 and any(
        found["contact"][1] > 0 for found in seen
    )


def test_stops_unless_the_first_is_of_a_set():
    """Legal shots have the bits that they have without the option; the others stop at their first
    contact.
    """
    layout, cues = (
        carom.balls([[0.5, 0.6], [0.7, 1.5], [0.4, 1.6]]),
        carom.cue(speed=3.0, phi=np.linspace(60.0, 120.0, 60)),
    )
    whole = carom.simulate_batch(TABLE, layout, cues, features=True)
    shots = carom.simulate_batch(TABLE, layout, cues, features=True, first_of=2)
    stops = whole.features.contact[:, 0] == 1
    assert (
        5 < stops.sum() < 40
        and (shots.status == np.where(stops, carom.Status.STOPPED_AT_EVENT, carom.Status.OK)).all()
    )
    assert (shots.final[~stops] == whole.final[~stops]).all() and (
        shots.time[stops] == whole.features.contact_time[stops, 0]
    ).all()
    assert (carom.simulate_batch(TABLE, layout, cues, first_of=[1, 2]).final == whole.final).all()
    with pytest.raises(ValueError, match="first_of"):
        carom.simulate(TABLE, layout, cues[0], first_of=32)


def test_features_of_three_cushions():
    """Cushions before the second ball, of another cue ball than the first of the layout."""
    table = carom.tables.threecushion()
    cues = carom.cue(speed=5.0, phi=np.linspace(0.0, 360.0, 90), a=0.3, ball=1, game="billiard")
    shots = carom.simulate_batch(
        table, carom.racks.threecushion(table), cues, features=True, room=300
    )
    assert (
        0
        < ((shots.features.contact[:, 1] >= 0) & (shots.features.cushions_before[:, 1] >= 3)).sum()
        < 45
    )
    for shot, found in zip(shots, (shots.features[k] for k in range(90))):
        assert all(
            getattr(found, name).tolist() == value for name, value in features_of(shot, 1).items()
        )


def test_shots_that_are_stopped():
    """At a time, at an event; both are outcomes. What goes on has the bits of the unbroken shot."""
    cue = carom.cue(speed=8.0)
    whole = carom.simulate(TABLE, RACK, cue)
    shot = carom.simulate(TABLE, RACK, cue, t_final=0.9)
    assert (
        shot.status is carom.Status.STOPPED_AT_TIME
        and shot.time == 0.9
        and (shot.events["time"] <= 0.9).all()
    )
    assert same_bits(shot.final["r"], whole.states(0.9)["r"])
    with pytest.raises(carom.CaromError) as caught:
        shot.states([0.5, 1.0])
    assert caught.value.status is carom.Status.ERROR_TIME
    for t_final in (1.0, 1.5):
        shot = carom.resume(shot, t_final=t_final)
        assert shot.status is carom.Status.STOPPED_AT_TIME and shot.time == t_final
    resumed = carom.resume(shot, stop_at=("rail", "pocket"))
    assert resumed.status is carom.Status.STOPPED_AT_EVENT and resumed.events["type"][-1] in (
        carom.EventType.RAIL,
        carom.EventType.POCKET,
    )
    end = carom.resume(shot)
    assert (
        end.status is carom.Status.OK
        and np.array_equal(end.events, whole.events)
        and same_bits(end.final, whole.final)
    )
    assert np.array_equal(carom.resume(resumed).events, whole.events)
    with pytest.raises(
        ValueError, match=r"t_final: 1\.0 s is before 1\.5 s, when the shot stopped"
    ):
        carom.resume(shot, t_final=1.0)
    # A shot that ends before t_final is no other than without it.
    assert carom.simulate(TABLE, RACK, cue, t_final=900.0).status is carom.Status.OK
    assert (
        carom.simulate(TABLE, RACK, cue, stop_at=["jaw", "contact"]).events["type"][-1]
        == carom.EventType.BALL_BALL
    )
    shots = carom.simulate_batch(TABLE, RACK, carom.cue(speed=[0.05, 8.0, 9.0]), t_final=0.9)
    assert (
        shots.status.tolist() == [0, 2, 2]
        and not shots.failures()
        and shots.time[1:].tolist() == [0.9, 0.9]
    )
    seen = shots.positions([0.9, 1.0])
    assert (
        np.isfinite(seen[:, 0]).all() and np.isfinite(seen[0]).all() and np.isnan(seen[1:, 1]).all()
    )


def test_orientations():
    """A ball that rolls in a straight line turns by its way over its radius, about the axis across."""
    balls = carom.balls(
        [[0.3, 0.3], [0.9, 2.0]],
        v=[[0.0, 0.5, 0.0], [0.0] * 3],
        w=[[-0.5 / 0.028575, 0.0, 0.0], [0.0] * 3],
    )
    shot = carom.simulate(TABLE, balls)
    times = np.array([[0.0, 0.1], [0.2, 0.4]])
    turned, half = shot.orientations(times), (shot.positions(times)[..., 0, 1] - 0.3) / 0.028575 / 2
    assert (
        turned.shape == (2, 2, 2, 4)
        and half[1, 1] > 2.6
        and (turned[..., 1, :] == [1, 0, 0, 0]).all()
    )
    assert_allclose(
        turned[..., 0, :2], np.stack([np.cos(half), -np.sin(half)], axis=-1), atol=1e-12
    )


def test_kinds_apart_are_the_same_balls():
    breaks = carom.cue(speed=8.0, phi=np.linspace(85.0, 95.0, 12), b=0.1)
    racks = np.stack([carom.racks.nineball(TABLE, seed=seed) for seed in range(len(breaks))])
    racks["kind"]["mu_slide"] = 0.15 + 0.01 * np.arange(10)
    kinds, states = racks["kind"][0].copy(), racks["state"].copy()
    for room in 0, 200:
        whole = carom.simulate_batch(TABLE, racks, breaks, room=room)
        apart = carom.simulate_batch(TABLE, states, breaks, kinds=kinds, room=room, threads=2)
        assert apart.layouts.nbytes * 3 < whole.layouts.nbytes
        assert same_bits(apart.final, whole.final) and same_bits(apart[1].balls, whole[1].balls)
        assert same_bits(apart[:2].states([0.1, 0.5]), whole[:2].states([0.1, 0.5]))
    slopes_apart, slopes_whole = (
        carom.tangents(shots, ["cue.phi"]).final["r"] for shots in (apart, whole)
    )
    assert same_bits(slopes_apart, slopes_whole)
    # One layout, one kind for all; and one that is bad.
    single = carom.simulate_batch(TABLE, RACK["state"], breaks, kinds=RACK["kind"][0])
    assert same_bits(single.final, carom.simulate_batch(TABLE, RACK, breaks).final)
    states["r"][1, 2, 0] = -1.0
    repeat = carom.simulate_batch(TABLE, states, breaks, kinds=kinds, room=200, out=apart)
    assert [index for index, _ in repeat.failures()] == [(1,)] and repeat.error(
        1
    ).field == "balls[2].state.r"


def test_broadcasting_and_out():
    table = carom.tables.threecushion()
    layouts = np.stack([carom.racks.threecushion(table, seed=k) for k in range(1, 4)])
    cues = carom.cue(speed=3.0, phi=np.array([30.0, 60.0]), game="billiard")
    shots = carom.simulate_batch(table, layouts[:, np.newaxis], cues)
    assert shots.shape == (3, 2) and shots.final.shape == (3, 2, 3)
    final = shots.final.copy()
    repeat = carom.simulate_batch(table, layouts[:, np.newaxis], cues, out=shots)
    assert repeat is shots and same_bits(repeat.final, final)
    one_cue = carom.simulate_batch(table, layouts, cues[1])
    assert same_bits(one_cue.final, final[:, 1])
    with pytest.raises(ValueError, match="out.status"):
        carom.simulate_batch(table, layouts, cues[1], out=shots)
    assert len(carom.simulate_batch(table, layouts[:0], cues[1])) == 0


def test_a_bad_shot_costs_itself():
    cues = carom.cue(speed=5.0, a=[0.0, 0.9, 0.1], b=0.5)
    shots = carom.simulate_batch(TABLE, RACK, cues)
    assert shots.status.tolist() == [0, carom.Status.ERROR_MISCUE, 0]
    assert shots.failures() == [
        ((1,), f"cue.a, cue.b = 0.9, 0.5: {carom.Status.ERROR_MISCUE.text}")
    ]
    assert same_bits(shots.final[2], carom.simulate(TABLE, RACK, cues[2]).final)


def test_a_refused_shot_has_no_numbers():
    """Neither zeros nor those of an earlier batch whose memory is used again; one that ended in an
    error later keeps its own.
    """
    usual = carom.simulate_batch(
        TABLE,
        RACK,
        carom.cue(speed=[8.0, 7.0, 6.0, 5.0], phi=90.3),
        features=True,
    )
    positions = usual.final["r"].copy()
    for out in (None, usual):
        shots = carom.simulate_batch(
            TABLE,
            RACK,
            carom.cue(speed=[8.0, -1.0, np.nan, 5.0], phi=90.3),
            features=True,
            out=out,
        )
        assert shots.refused.tolist() == [False, True, True, False] and np.array_equal(
            shots.final["r"][::3], positions[::3]
        )
        assert (
            all(np.isnan(shots.final[name][1:3]).all() for name in "rvw")
            and (shots.final["label"][1:3] == -1).all()
        )
        assert np.isnan(shots[1].final["r"]).all() and (shots.features.pocket[1:3] == -1).all()
    ended = carom.simulate_batch(TABLE, RACK, carom.cue(speed=[8.0]), events_most=40)
    assert (
        ended.status.tolist() == [carom.Status.ERROR_TOO_MANY_EVENTS]
        and not ended.refused.any()
        and np.isfinite(ended.final["r"]).all()
    )
    pytest.importorskip("pandas")
    frame = usual.to_dataframe()
    assert (
        frame["ball_3_r_x"].isna().tolist() == [False, True, True, False]
        and frame["ball_0_label"][1] == -1
    )


def test_games_and_terms():
    """The terms by themselves, each shot of a batch with its own; rails of their own. The test
    terms of C has the numbers of each game.
    """
    table = carom.tables.threecushion()
    r, v = [[0.7, 1.0]], [0.6, 1.2, 0.0]
    measured, plain = (
        carom.balls(r, v=v, game="billiard"),
        carom.balls(r, v=v, game="billiard", drag=0.0, roll_loss=0.0),
    )
    assert measured["kind"]["drag"] > 0.0 and not plain["kind"]["drag"].any()
    named = carom.simulate(table, measured, cushion_model="smooth")
    assert same_bits(carom.simulate(table, measured).final, named.final)
    shots = carom.simulate_batch(table, np.stack([measured, plain]))
    assert shots.time[0] < shots.time[1]
    assert all(
        same_bits(shots.final[k], carom.simulate(table, layout).final)
        for k, layout in enumerate((measured, plain))
    )
    rails = table.rails.copy()
    rails["mu_cushion"], rails["restitution"] = 0.3, 0.7
    table_of_own = table.changed(rails=rails)
    layout = carom.balls(r, v=v, game="billiard", mu_cushion=0.3, restitution_cushion=0.7)
    assert same_bits(
        carom.simulate(table_of_own, measured).final, carom.simulate(table, layout).final
    )


def test_states_between_events():
    """A ball alone, sliding, in closed form."""
    shot = carom.simulate(TABLE, carom.balls([[0.6, 0.3]], v=[0.0, 1.0, 0.0]))
    times = np.linspace(0.0, 0.1, 7).reshape(7, 1)
    positions = shot.positions(times)
    assert (
        positions.shape == (7, 1, 1, 3)
        and shot.events["type"][0] == carom.EventType.SLIDING_ROLLING
    )
    assert_allclose(
        positions[:, 0, 0, 1], 0.3 + times[:, 0] - 0.5 * 0.2 * 9.81 * times[:, 0] ** 2, rtol=1e-14
    )
    assert same_bits(shot.states(1e9), shot.final) and shot.states(0.0)["r"].tolist() == [
        [0.6, 0.3, 0.028575]
    ]


def test_more_events_than_the_first_room(monkeypatch):
    """A shot of more events than there is room for at first keeps them all."""
    shot = carom.simulate(TABLE, RACK, carom.cue(speed=8.0))
    small = carom.simulate_batch(TABLE, RACK, carom.cue(speed=8.0), room=10)
    monkeypatch.setattr(carom.shots, "_FIRST_ROOM", 20)
    assert shot.count > 40 and same_bits(
        carom.simulate(TABLE, RACK, carom.cue(speed=8.0)).events, shot.events
    )
    assert small.count == shot.count and np.array_equal(small.events, shot.events[:10])


def test_tables_and_racks():
    racks = (
        carom.racks.nineball,
        carom.racks.eightball,
        carom.racks.tenball,
        carom.racks.snooker,
        carom.racks.threecushion,
    )
    for rack, size in zip(racks, (10, 16, 11, 22, 3)):
        table = (
            carom.tables.snooker()
            if size == 22
            else carom.tables.threecushion()
            if size == 3
            else carom.tables.pool_8ft()
        )
        assert rack(table).shape == (size,) and same_bits(rack(table), rack(table, 1e-4, 1))
        # The opening of three-cushion has its balls on their spots, whatever the gap and the seed.
        assert all(
            (same_bits(rack(table), rack(table, *second))) == (size == 3)
            for second in ((2e-4, 1), (1e-4, 2))
        )
    table = carom.tables.pool_7ft()
    assert (table.width, table.length) == (0.9906, 1.9812) and len(table.pockets) == 6
    copy = carom.Table(
        table.width, table.length, rails=table.rails, jaws=table.jaws, pockets=table.pockets
    )
    assert same_bits(copy.record, table.record) and "6 pockets" in repr(copy)
    assert not len(carom.tables.threecushion().pockets)
    assert carom.tables.pool_9ft() == TABLE != carom.tables.pool_8ft() and TABLE != "table"
    tight = carom.tables.pool_9ft(corner=0.108, side_cut=103)
    assert (
        tight != TABLE == carom.tables.pool_9ft(**carom.tables.measures("pool_9ft"))
        and tight.width == 1.27
    )


def test_pictures():
    shot = carom.simulate(TABLE, RACK, carom.cue(speed=8.0))
    name = "{http://www.w3.org/2000/svg}"
    still = ElementTree.fromstring(shot._repr_svg_())
    moved = int((np.abs(shot.final["r"] - shot.balls["state"]["r"]).max(axis=-1) > 1e-3).sum())
    # Noses of cushions have round ends, and paths have none.
    lines = [line for line in still.iter(name + "polyline") if not line.get("stroke-linecap")]
    assert len(lines) >= moved > 3
    assert len(list(still.iter(name + "circle"))) == len(TABLE.pockets) + len(TABLE.jaws) + 20
    # A long table lies on its side. Circles are where the balls begin; where they end, every ball
    # but the cue ball has its number.
    assert float(still.get("width")) > float(still.get("height"))
    balls = [part for part in still.iter(name + "g")]
    assert [[text.text for text in ball.iter(name + "text")] for ball in balls] == [
        *([] for _ in range(11)),
        *([str(k)] for k in range(1, 10)),
    ]
    # The balls of the moving picture go from where they lie in the still one to where they end
    # there.
    animation = shot.animate()
    moving = list(ElementTree.fromstring(animation.svg).iter(name + "g"))
    for k, ball in enumerate(moving):
        ways = [part.get("values").split(";") for part in ball.iter(name + "animateTransform")] or [
            [ball.get("transform")[10:-1]]
        ]
        assert [f"translate({ways[0][0]})", f"translate({ways[0][-1]})"] == [
            balls[k].get("transform"),
            balls[k + 10].get("transform"),
        ]
    assert len(moving) == 10 and len(repr(animation)) < 80
    assert len(list(ElementTree.fromstring(TABLE._repr_svg_()).iter(name + "circle"))) == len(
        TABLE.pockets
    ) + len(TABLE.jaws)


def test_balls_that_fly():
    """Off the table, which is no error; the batch takes the same options, as keywords or as one
    object. C has the heights of hops.
    """
    balls = carom.balls([[0.4, 2.14], [0.8, 1.8]])
    cue = carom.cue(speed=3.0, theta=45.0, b=0.0, tip_restitution=1.0, miscue=0.5, tip_time=-1.0)
    gone = carom.simulate(TABLE, balls, cue)
    assert gone.events["type"][:2].tolist() == [carom.EventType.STRIKE, carom.EventType.SLATE]
    assert gone.events["type"][-1] == carom.EventType.LEFT_TABLE
    assert gone.final["label"].tolist() == [carom.Label.OFF, 0]
    for space, label in (("3d", carom.Label.OFF), ("flat", carom.Label.STATIONARY)):
        options = carom.Options(space=space, ball_model="mirror")
        shots = (
            carom.simulate_batch(TABLE, balls, cue, space=space),
            carom.simulate_batch(TABLE, balls, cue, options=options, ball_model="default"),
        )
        assert all(
            single.final[0]["label"] == label and single.options == carom.Options(space=space)
            for single in shots
        )


def test_tables_are_checked():
    for table in (carom.tables.pool_9ft(), carom.tables.snooker(), carom.tables.threecushion()):
        table.check(0.026 if len(table.pockets) == 6 and table.length > 3 else 0.028575)
    whole = carom.tables.threecushion()
    rails = whole.rails.copy()
    rails["q"][1] = (rails["p"][1] + rails["q"][1]) / 2.0
    holed = whole.changed(rails=rails)
    with pytest.raises(
        carom.CaromError,
        match=r"table\.rails\[0\]: a ball can leave the table between two of its parts, or there is no room for a ball on it \(at x = 0\.71 m, y = 1\.42 m,",
    ) as caught:
        holed.check(0.0307)
    assert caught.value.status is carom.Status.ERROR_TABLE_OPEN


def test_ball_in_hand():
    rack = RACK.copy()
    rack["state"]["label"][0] = carom.Label.POCKETED
    layout = rack.copy()
    placed = carom.place_ball(TABLE, rack, 0, 0.4, 0.5)
    assert (
        placed["state"]["r"][0].tolist() == [0.4, 0.5, 0.028575]
        and placed["state"]["label"][0] == carom.Label.STATIONARY
    )
    assert same_bits(rack, layout) and same_bits(placed[1:], rack[1:])
    occupied = RACK["state"]["r"][1]
    for place, field in (
        ((occupied[0], occupied[1] - 0.04), "balls[1]"),
        ((0.01, 0.7), "table.rails"),
        ((0.0, 0.0), "table.pockets"),
        ((-1.0, 1.0), "table"),
    ):
        with pytest.raises(carom.CaromError, match="is in the way of ball 0") as caught:
            carom.place_ball(TABLE, RACK, 0, *place)
        assert caught.value.field is not None and caught.value.field.startswith(field)


def test_columns_and_frames():
    """Every number of the records is in a column of its name."""
    shot = carom.simulate(TABLE, RACK, carom.cue(speed=8.0))
    columns = carom.dtypes.columns(shot.events)
    assert all(column.shape == (shot.count,) for column in columns.values())
    assert_array_equal(columns["after_b_w_z"], shot.events["after"]["w"][:, 1, 2])
    assert_array_equal(columns["time"], shot.events["time"])
    assert set(carom.dtypes.columns(TABLE.rails)) >= {"p_x", "q_y", "height", "line_z"}
    assert "state_label" in carom.dtypes.columns(
        shot.balls
    ) and "kind_mass" in carom.dtypes.columns(shot.balls)
    pytest.importorskip("pandas")
    frame = shot.to_dataframe()
    assert list(frame) == list(columns) and frame["type"][0] == "strike"
    pair = (frame["type"] == "ball_ball").to_numpy()
    assert pair.tolist() == (shot.events["type"] == carom.EventType.BALL_BALL).tolist()
    for side in ("before", "after"):
        assert (
            frame[f"{side}_b_r_x"][pair].notna().all()
            and frame[f"{side}_b_r_x"][~pair].isna().all()
        )
        assert set(frame[f"{side}_b_label"][~pair]) == {-1} and frame[f"{side}_a_r_x"].notna().all()


def test_a_batch_as_a_frame(breaks):
    """A row a shot, with what it was played with, what became of the balls, and features; an index
    of many dimensions has as many.
    """
    pandas = pytest.importorskip("pandas")
    shots = breaks[0](features=True)
    frame = shots.to_dataframe()
    assert (
        len(frame) == 12
        and frame["status"].tolist().count("error_miscue") == 4
        and frame["status"][0] == "ok"
    )
    for column, values in (
        ("time", shots.time),
        ("count", shots.count),
        ("cue_phi", shots.cues["phi"]),
        ("ball_3_r_y", shots.final["r"][:, 3, 1]),
        ("ball_0_label", shots.final["label"][:, 0]),
        ("contact_1", shots.features.contact[:, 1]),
        ("pocket_9", shots.features.pocket[:, 9]),
        ("cushions_after", shots.features.cushions_after),
    ):
        assert_array_equal(frame[column], values, err_msg=column)
    grid = carom.simulate_batch(
        TABLE,
        carom.balls([[0.5, 0.6]], v=[0.0, 0.5, 0.0]),
        carom.cue(speed=[[0.0], [0.0]], phi=[0.0, 1.0, 2.0]),
    )
    assert grid.to_dataframe().loc[(1, 2), "cue_phi"] == 2.0 and isinstance(
        grid.to_dataframe().index, pandas.MultiIndex
    )
    assert "cue_phi" not in carom.simulate_batch(TABLE, carom.balls([[0.5, 0.6]])).to_dataframe()
    # each level has a name
    assert (shots[0].to_dataframe().index.name, frame.index.name) == ("event", "shot")
    assert list(grid.to_dataframe().index.names) == ["shot_0", "shot_1"]
    assert list(grid.to_dataframe(["speed", "phi"]).index.names) == ["speed", "phi"]
    with pytest.raises(
        ValueError,
        match=r"^dims: \('speed',\) are not 2 different names other than ball, axis and met",
    ):
        grid.to_dataframe(["speed"])


def test_a_batch_as_a_dataset(breaks):
    pytest.importorskip("xarray")
    shots = breaks[0](features=True)
    data = shots.to_xarray()
    assert dict(data.sizes) == {"shot": 12, "ball": 10, "axis": 3, "met": 2}
    for name, values in (
        ("time", shots.time),
        ("cue_phi", shots.cues["phi"]),
        ("r", shots.final["r"]),
        ("label", shots.final["label"]),
        ("contact", shots.features.contact),
        ("pocket", shots.features.pocket),
        ("cushions_after", shots.features.cushions_after),
    ):
        assert_array_equal(data[name], values, err_msg=name)
    assert data.sel(axis="y", ball=3)["r"].dims == ("shot",) and data["v"].attrs == {"units": "m/s"}
    assert dict(
        zip(data["label"].attrs["flag_meanings"].split(), data["label"].attrs["flag_values"])
    ) == {label.name.lower(): label.value for label in carom.Label}
    grid = carom.simulate_batch(
        TABLE, carom.balls([[0.5, 0.6]]), carom.cue(speed=[[1.0], [2.0]], phi=[0.0, 1.0, 2.0])
    )
    named = grid.to_xarray(("speed", "phi"))
    assert (
        named["time"].dims == ("speed", "phi")
        and "contact" not in grid.to_xarray()
        and set(data.coords) == set(data.dims)
    )
    assert [named.coords[name].values.tolist() for name in ("speed", "phi")] == [
        [1.0, 2.0],
        [0.0, 1.0, 2.0],
    ]
    assert grid.to_xarray(("phi", "b")).coords["b"].values.tolist() == [
        0,
        1,
        2,
    ]  # which do not change along these


def test_what_is_shown_is_short(breaks):
    shots = breaks[0](features=True)
    for shown in (shots, shots.features, shots[0], shots[0].table, shots.features[0]):
        assert len(repr(shown)) < 250 and "\n" not in repr(shown), repr(shown)
    assert "pocket (12, 10)" in repr(shots.features)
    assert {"events", "final", "cue", "positions"} <= set(dir(shots[0]))


def test_a_batch_of_one_makes_few_calls(calls):
    """Those of C included."""
    TABLE, balls, cue = (
        carom.tables.pool_9ft(),
        carom.balls([[0.5, 0.6], [0.7, 1.5]]),
        carom.cue(speed=3.0, phi=79.0),
    )
    carom.simulate_batch(TABLE, balls, cue)
    assert calls(lambda: carom.simulate_batch(TABLE, balls, cue)) <= 80


def test_tables_of_any_shape():
    corners = [(1, 0, 0.12), (2, 0.5, 0.12), (2, 1.5, 0.12), (1, 2, 0.12), (0, 1.5, 0.12), (0, 0.5)]
    table = carom.tables.polygon(corners)
    assert (len(table.rails), len(table.jaws), len(table.pockets), table.width, table.length) == (
        6,
        10,
        5,
        2.0,
        2.0,
    )
    ends = np.array([0, np.pi]) + np.linspace(0, 6, 40)[:, None]
    shots = carom.simulate_batch(
        table, carom.balls([[1.0, 1.0]]), carom.cue(speed=4.0, phi=np.degrees(ends.ravel()))
    )
    assert (shots.status == 0).all() and (table.pockets["radius"] == 0.06).all()
    bent = carom.tables.polygon(
        [(0, 0), (2, 0), (2, 0.5), (0.5, 0.5), (0.5, 2), (0, 2)]
    )  # its middle is outside
    assert (
        carom.simulate(bent, carom.balls([[0.3, 0.3]]), carom.cue(speed=4.0, phi=20.0)).status
        == carom.Status.OK
    )
