"""Whole shots: pooltool's recorded histories, the command's output, batches, times between events, errors, pictures."""

import json
import os
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from conftest import DATA

import carom

KINDS = {
    "m": "mass", "R": "radius", "u_s": "mu_slide", "u_r": "mu_roll", "u_sp": "mu_spin", "u_b": "mu_ball", "e_b": "restitution",
    "f_c": "mu_cushion", "e_c": "restitution_cushion", "g": "gravity",
}  # fmt: skip
TYPES = (
    "none stick_ball ball_ball ball_linear_cushion ball_circular_cushion ball_pocket sliding_rolling rolling_spinning "
    "rolling_stationary spinning_stationary"
).split()


def table_of(line):
    rails = np.zeros(len(line["linear"]), carom.dtypes.rail)
    for rail, given in zip(rails, line["linear"]):
        rail["p"], rail["q"], rail["height"] = given["p1"][:2], given["p2"][:2], given["p1"][2]
        rail["line"], rail["side"] = [given["lx"], given["ly"], given["l0"]], given["direction"]
    jaws = np.zeros(len(line["circular"]), carom.dtypes.jaw)
    for jaw, given in zip(jaws, line["circular"]):
        jaw["centre"], jaw["height"], jaw["radius"] = given["center"][:2], given["center"][2], given["radius"]
    pockets = np.zeros(len(line["pockets"]), carom.dtypes.pocket)
    for pocket, given in zip(pockets, line["pockets"]):
        pocket["centre"], pocket["radius"], pocket["depth"] = given["center"][:2], given["radius"], given["depth"]
    return carom.Table(line["w"], line["l"], rails=rails, jaws=jaws, pockets=pockets)


def recorded(name):
    """(table, balls, cue, line) of each shot of a file of data/."""
    tables, shots = {}, []
    for text in open(DATA / name, encoding="utf-8"):
        line = json.loads(text)
        if line["kind"] == "table":
            tables[line["id"]] = table_of(line)
        if line["kind"] == "shot":
            states = np.array([ball["state"] for ball in line["balls"]])
            kinds = {new: [ball["params"][old] for ball in line["balls"]] for old, new in KINDS.items()}
            balls = carom.balls(states[:, 1:4], v=states[:, 4:7], w=states[:, 7:10], **kinds)
            given = line["cue"]
            ids = [ball["id"] for ball in line["balls"]]
            cue = carom.cue(
                speed=given["V0"], phi=given["phi"], theta=given["theta"], a=given["a"], b=given["b"], mass=given["M"],
                end_mass=given["end_mass"], tip_radius=given["tip_radius"], ball=ids.index(given["ball"]),
            )  # fmt: skip
            shots.append((tables[line["table"]], balls, cue, line))
    return shots


def flat(states):
    """A state as x, v and 0.03 w: what the recorded sensitivities are of."""
    return np.concatenate([states["r"], states["v"], 0.03 * states["w"]], axis=-1)


@pytest.fixture(scope="module")
def pooltool_shots():
    return recorded("shots-pooltool.jsonl")


def test_pooltools_histories(pooltool_shots):
    assert len(pooltool_shots) >= 30
    for table, balls, cue, line in pooltool_shots:
        shot = carom.simulate(table, balls, cue, world="pooltool")
        ids = [ball["id"] for ball in line["balls"]]
        # pooltool begins and ends with an event of the type none.
        happened = [(k, given) for k, given in enumerate(line["events"]) if given[1] != "none"]
        assert shot.count == len(shot.events) == len(happened)
        for event, (k, given) in zip(shot.events, happened):
            if k >= line["sens"]["same_events"]:
                break
            assert TYPES[event["type"]] == given[1], line["id"]
            assert abs(event["time"] - given[0]) <= 1e-12 + 5e-13 * line["sens"]["t"][k]
            # Rails and pockets have names that may be those of balls.
            names = given[2][1:] if given[1] == "stick_ball" else given[2][: len(given[4])]
            assert {ids[event["a"]]} | ({ids[event["b"]]} if len(names) == 2 else set()) == set(names)
            for side, name in enumerate(names):
                after = np.array(given[4][side])
                # pooltool may name the balls of a pair in the other order.
                mine = event["after"][0 if ids[event["a"]] == name else 1]
                difference = flat(mine) - np.concatenate([after[1:7], 0.03 * after[7:10]])
                assert np.abs(difference).max() <= 1e-12 + 5e-13 * line["sens"]["state"][k]


def test_the_command_gives_the_same_bits():
    """carom shoot, on the recorded break, where the build is known."""
    command = os.path.join(os.environ.get("CAROM_BUILD", ""), "carom")
    if not os.access(command, os.X_OK) or os.path.isdir(command):
        pytest.skip("CAROM_BUILD names no build with the command carom")
    given = [json.loads(text) for text in open(DATA / "break-nineball.jsonl", encoding="utf-8")]
    out = subprocess.run(
        [command, "shoot", "--events", "brief", str(DATA / "break-nineball.jsonl")], capture_output=True, text=True, check=True
    )
    theirs = json.loads(out.stdout.splitlines()[-1])
    line = given[-1]
    balls = carom.balls([ball["state"][1:4] for ball in line["balls"]])
    cue = carom.cue(speed=line["cue"]["V0"], phi=line["cue"]["phi"], b=line["cue"]["b"])
    shot = carom.simulate(carom.tables.pool_9ft(), balls, cue)
    # The command begins and ends with an event of the type none, as pooltool does.
    assert [event[0] for event in theirs["events"] if event[1] != "none"] == shot.events["time"].tolist()


def test_a_batch_has_the_bits_of_single_shots():
    table = carom.tables.pool_9ft()
    rack = carom.racks.nineball(table)
    cues = carom.cue(speed=[[6.0], [9.0]], phi=np.linspace(88.0, 92.0, 5))
    options = {"cushion_model": "han"}
    shots = carom.simulate_batch(table, rack, cues, room=1000, threads=3, **options)
    assert shots.shape == (2, 5) and not shots.failures() and (shots.count > 10).all()
    for index in np.ndindex(2, 5):
        one = carom.simulate(table, rack, cues[index], **options)
        assert shots[index].count == one.count and shots.time[index] == one.time
        assert np.array_equal(shots[index].events, one.events)
        assert shots.final[index].tobytes() == one.final.tobytes()
        np.testing.assert_array_equal(shots[index].positions([0.3, 1.0]), one.positions([0.3, 1.0]))
    finals = carom.simulate_batch(table, rack, cues, **options)
    assert finals.final.tobytes() == shots.final.tobytes()
    with pytest.raises(carom.CaromError, match="more events"):
        finals[0, 0].positions(1.0)


def test_broadcasting_and_out():
    table = carom.tables.threecushion()
    layouts = np.stack([carom.racks.threecushion(table, seed=k) for k in range(1, 4)])
    cues = carom.cue(speed=3.0, phi=np.array([30.0, 60.0]), game="billiard")
    shots = carom.simulate_batch(table, layouts[:, np.newaxis], cues, cushion_model="han")
    assert shots.shape == (3, 2) and shots.final.shape == (3, 2, 3)
    kept = shots.final.copy()
    again = carom.simulate_batch(table, layouts[:, np.newaxis], cues, cushion_model="han", out=shots)
    assert again is shots and again.final.tobytes() == kept.tobytes()
    one_cue = carom.simulate_batch(table, layouts, cues[1], cushion_model="han")
    assert one_cue.final.tobytes() == kept[:, 1].tobytes()
    with pytest.raises(ValueError, match="out.status"):
        carom.simulate_batch(table, layouts, cues[1], out=shots)
    assert len(carom.simulate_batch(table, layouts[:0], cues[1])) == 0


def test_a_bad_shot_costs_itself():
    table = carom.tables.pool_9ft()
    rack = carom.racks.nineball(table)
    cues = carom.cue(speed=5.0, a=[0.0, 0.9, 0.1], b=0.5)
    shots = carom.simulate_batch(table, rack, cues, cushion_model="han")
    assert shots.status.tolist() == [0, carom.Status.ERROR_MISCUE, 0]
    assert shots.failures() == [((1,), f"cue: {carom.Status.ERROR_MISCUE.text}")]
    assert shots.final[2].tobytes() == carom.simulate(table, rack, cues[2], cushion_model="han").final.tobytes()


def test_each_layout_has_its_own_radius():
    table = carom.tables.threecushion()
    kind = carom.balls([[0.7, 0.5]], game="billiard")
    layouts = np.stack([kind, kind, kind])
    for layout, radius in zip(layouts, [0.02, 0.06, 0.015]):
        layout["kind"]["radius"], layout["state"]["r"][:, 2] = radius, radius
        layout["state"]["v"][:, 1], layout["state"]["w"][:, 0] = -0.2992, 0.2992 / radius
    shots = carom.simulate_batch(table, layouts, room=50)
    assert shots.status.tolist() == [0, 0, carom.Status.ERROR_NOSE_HEIGHT]
    for k in range(2):
        assert shots.final[k].tobytes() == carom.simulate(table, layouts[k]).final.tobytes()


def test_games_and_terms():
    """The measured balls of billiard, the terms by themselves, each shot of a batch with its own; pooltool's figures."""
    table = carom.tables.threecushion()
    r, v = [[0.7, 1.0]], [0.6, 1.2, 0.0]
    measured = carom.balls(r, v=v, game="billiard")
    kind = measured["kind"][0]
    assert kind["drag"] == 0.0129 and kind["roll_loss"] == 0.087 and kind["law_a"] == kind["mu_ball"] == 0.08
    terms = ("drag", "roll_loss", "law_a", "law_b", "law_c", "nose_height", "omega_ratio")
    for game in ("pool", "snooker", "pooltool_pool", "pooltool_snooker", "pooltool_billiard"):
        assert not any(carom.balls(r, game=game)["kind"][name].any() for name in terms)
    plain = carom.balls(r, v=v, game="billiard", drag=0.0, roll_loss=0.0)
    shots = carom.simulate_batch(table, np.stack([measured, plain]), cushion_model="han")
    assert shots.record["time"][0] < shots.record["time"][1]
    for k, layout in enumerate((measured, plain)):
        assert shots.final[k].tobytes() == carom.simulate(table, layout, cushion_model="han").final.tobytes()
    # Rails of their own are balls of their own.
    own = carom.Table.from_record(table.record)
    own.rails["mu_cushion"], own.rails["restitution"] = 0.3, 0.7
    other = carom.balls(r, v=v, game="billiard", mu_cushion=0.3, restitution_cushion=0.7)
    assert carom.simulate(own, measured).final.tobytes() == carom.simulate(table, other).final.tobytes()
    higher = carom.Table.from_record(table.record)
    higher.rails["height"] = 0.036
    lower = carom.balls(r, v=v, game="billiard", nose_height=0.036)
    assert carom.simulate(higher, measured).final.tobytes() == carom.simulate(table, lower).final.tobytes()
    for name, value in [("drag", 2.0), ("roll_loss", -0.1), ("law_b", 1.5), ("law_c", np.inf), ("nose_height", 0.07), ("omega_ratio", 2.0)]:
        with pytest.raises(carom.CaromError, match=rf"balls\[0\]\.kind\.{name}"):
            carom.simulate(table, carom.balls(r, v=v, game="billiard", **{name: value}))


def test_states_between_events():
    """A ball alone, sliding, in closed form."""
    table = carom.tables.pool_9ft()
    balls = carom.balls([[0.6, 0.3]], v=[0.0, 1.0, 0.0])
    shot = carom.simulate(table, balls)
    times = np.linspace(0.0, 0.1, 7).reshape(7, 1)
    at = shot.positions(times)
    assert at.shape == (7, 1, 1, 3)
    np.testing.assert_allclose(at[:, 0, 0, 1], 0.3 + times[:, 0] - 0.5 * 0.2 * 9.81 * times[:, 0] ** 2, rtol=1e-14)
    assert shot.states(1e9).tobytes() == shot.final.tobytes() and shot.states(-1.0)["r"].tolist() == [[0.6, 0.3, 0.028575]]
    assert shot.events["type"][0] == carom.EventType.SLIDING_ROLLING
    assert shot.final["label"].tolist() == [carom.Label.STATIONARY]


@pytest.mark.parametrize(
    ("change", "field", "status"),
    [
        ({"mass": [0.17, -1.0]}, "balls[1].kind.mass", "MASS"),
        ({"mu_roll": 0.0}, "balls[0].kind.mu_roll", "MU_MOTION"),
        ({"restitution_cushion": 2.0}, "balls[0].kind.restitution_cushion", "RESTITUTION"),
        ({"v": [[0, 0, 0], [0, np.nan, 0]]}, "balls[1].state.v", "VELOCITY"),
        ({"r": [[0.5, 0.5], [-0.5, 0.5]]}, "balls[1].state.r", "OFF_TABLE"),
    ],
)
def test_bad_balls(change, field, status):
    balls = carom.balls(**{"r": [[0.5, 0.5], [0.7, 0.5]], **change})
    with pytest.raises(carom.CaromError) as caught:
        carom.simulate(carom.tables.pool_9ft(), balls, carom.cue())
    assert caught.value.field == field and caught.value.status.name == f"ERROR_{status}"


def test_other_errors():
    table = carom.tables.pool_9ft()
    rack = carom.racks.nineball(table)
    with pytest.raises(carom.CaromError, match="cue"):
        carom.simulate(table, rack, carom.cue(a=0.9, b=0.9))
    with pytest.raises(carom.CaromError) as caught:
        carom.simulate(table, rack, carom.cue(speed=8.0), events_most=20)
    assert caught.value.status is carom.Status.ERROR_TOO_MANY_EVENTS
    stopped = caught.value.shot
    assert stopped is not None and stopped.count == 20 and stopped.states(stopped.time).tobytes() == stopped.final.tobytes()
    with pytest.raises(carom.CaromError) as caught:
        stopped.states([0.0, stopped.time + 1.0])
    assert caught.value.status is carom.Status.ERROR_TIME
    with pytest.raises(TypeError, match=r"carom\.balls\(\)"):
        carom.simulate(table, np.zeros((2, 20)))
    with pytest.raises(ValueError, match="cushion_model: must be one of"):
        carom.simulate(table, rack, carom.cue(), cushion_model="rubber")
    with pytest.raises(carom.CaromError, match="rack|gap"):
        carom.racks.nineball(table, gap=-1.0)
    with pytest.raises(ValueError, match="steps"):
        carom.simulate_batch(table, rack, carom.cue(), steps=-3)


def test_more_events_than_the_first_room():
    """A shot of more than 512 events keeps them all."""
    table = carom.tables.snooker()
    rack = carom.racks.snooker(table)
    shots = [carom.simulate(table, rack, carom.cue(speed=s, game="snooker"), cushion_model="han") for s in (8, 12, 16)]
    for shot in shots:
        assert shot.count == len(shot.events) and (np.diff(shot.events["time"]) >= 0).all()
    small = carom.simulate_batch(table, rack, carom.cue(speed=16, game="snooker"), room=10, cushion_model="han")
    assert small.count == shots[-1].count and np.array_equal(small.events, shots[-1].events[:10])


def test_tables_and_racks():
    racks = (carom.racks.nineball, carom.racks.eightball, carom.racks.tenball, carom.racks.snooker, carom.racks.threecushion)
    for rack, size in zip(racks, (10, 16, 11, 22, 3)):
        table = carom.tables.snooker() if size == 22 else carom.tables.threecushion() if size == 3 else carom.tables.pool_8ft()
        assert rack(table).shape == (size,)
    table = carom.tables.pool_7ft()
    assert (table.width, table.length) == (0.9906, 1.9812) and len(table.pockets) == 6
    copy = carom.Table(table.width, table.length, rails=table.rails, jaws=table.jaws, pockets=table.pockets)
    assert copy.record.tobytes() == table.record.tobytes() and "6 pockets" in repr(copy)
    assert not len(carom.tables.threecushion().pockets)
    with pytest.raises(ValueError, match="rails"):
        carom.Table(1.0, 2.0, rails=np.zeros(33, carom.dtypes.rail))


def test_strike():
    """A blow at the centre with no elevation: no spin, and the speed of an impact without loss and with squirt's end mass."""
    motion = carom.struck(carom.cue(speed=3.0, b=0.0, phi=0.0), carom.balls([[0.5, 0.5]])[0]["kind"])
    assert motion["v"][0] > 3.0 and abs(motion["v"][1]) < 1e-12 and not motion["w"].any()


def test_pictures():
    table = carom.tables.pool_9ft()
    shot = carom.simulate(table, carom.racks.nineball(table), carom.cue(speed=8.0), cushion_model="han")
    name = "{http://www.w3.org/2000/svg}"
    still = ElementTree.fromstring(shot._repr_svg_())
    moved = int((np.abs(shot.final["r"] - shot.balls["state"]["r"]).max(axis=-1) > 1e-3).sum())
    lines = [line for line in still.iter(name + "polyline") if line.get("stroke") not in ("#1b5e42",)]
    assert len(lines) >= moved > 3
    assert len(list(still.iter(name + "circle"))) == len(table.pockets) + len(table.jaws) + 20
    # A long table lies on its side, and every ball but the cue ball has its number.
    assert float(still.get("width")) > float(still.get("height"))
    balls = [part for part in still.iter(name + "g")]
    assert [[text.text for text in ball.iter(name + "text")] for ball in balls] == 2 * [[], *([str(k)] for k in range(1, 10))]
    # The balls of the moving picture go from where they lie in the still one to where they end there.
    animation = shot.animate()
    moving = list(ElementTree.fromstring(animation.svg).iter(name + "g"))
    for k, ball in enumerate(moving):
        ways = [part.get("values").split(";") for part in ball.iter(name + "animateTransform")] or [[ball.get("transform")[10:-1]]]
        assert [f"translate({ways[0][0]})", f"translate({ways[0][-1]})"] == [balls[k].get("transform"), balls[k + 10].get("transform")]
    assert len(moving) == 10 and len(repr(animation)) < 80
    assert len(list(ElementTree.fromstring(table._repr_svg_()).iter(name + "circle"))) == len(table.pockets) + len(table.jaws)


def test_balls_that_fly():
    table = carom.tables.pool_9ft()
    balls = carom.balls([[0.5, 0.6], [0.5, 0.905]])
    cue = carom.cue(speed=3.0, theta=45.0, b=0.0)
    over = carom.simulate(table, balls, cue, cushion_model="han")
    kinds = over.events["type"].tolist()
    assert kinds[:2] == [carom.EventType.STRIKE, carom.EventType.SLATE] and kinds.count(carom.EventType.SLATE) > 3
    top = over.positions(np.linspace(0.0, 0.3, 31))[:, 0, 2].max()
    assert abs(top - 0.028575 - 0.135695) < 1e-4
    flat = carom.simulate(table, balls, cue, cushion_model="han", space="flat")
    assert flat.events["type"][1] == carom.EventType.BALL_BALL and (flat.events["after"]["v"][..., 2] == 0).all()
    # off the table, which is no error; the batch takes the same option
    balls = carom.balls([[0.4, 2.14], [0.8, 1.8]])
    cue = carom.cue(speed=3.0, theta=45.0, b=0.0, miscue=0.5)
    gone = carom.simulate(table, balls, cue, cushion_model="han")
    assert gone.events["type"][-1] == carom.EventType.LEFT_TABLE and gone.final["label"].tolist() == [carom.Label.OFF, 0]
    for space in ("3d", "flat"):
        shots = carom.simulate_batch(table, balls, cue, cushion_model="han", space=space)
        assert shots.final[0]["label"] == (carom.Label.OFF if space == "3d" else carom.Label.STATIONARY)
    with pytest.raises(carom.CaromError, match="miscue"):
        carom.simulate(table, balls, carom.cue(a=0.3, b=0.4, miscue=0.5))
    with pytest.raises(ValueError, match="space"):
        carom.simulate(table, balls, cue, space="2d")
    with pytest.raises(carom.CaromError, match="restitution_table = 0.99: it must be 0 to 0.98"):
        carom.simulate(table, carom.balls([[0.5, 0.5]], restitution_table=0.99))
    # a large ball rolls into a small one: spheres in space
    unlike = carom.balls([[0.4, 0.5], [0.7, 0.5]], radius=[0.0302, 0.028575], v=[[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    hit = carom.simulate(table, unlike, cushion_model="han")
    assert carom.EventType.SLATE in hit.events["type"].tolist()


def test_each_bad_argument_has_its_message():
    """In Python's words, with the argument's name and what would be right."""
    table = carom.tables.pool_9ft()
    rack, cue = carom.racks.nineball(table), carom.cue()
    pocketed = rack.copy()
    pocketed["state"]["label"][0] = carom.Label.POCKETED
    for message, call in (
        ("seed: it must be a whole number", lambda: carom.racks.nineball(table, seed=-1)),
        ("seed: it must be a whole number", lambda: carom.racks.nineball(table, seed=1.5)),
        ("gap = -1: it must be 0 m to the radius", lambda: carom.racks.nineball(table, gap=-1)),
        ("width: it must be positive", lambda: carom.Table(0.0, 1.0, rails=table.rails)),
        ("table: a carom.Table is needed", lambda: carom.simulate("pool", rack, cue)),
        ("steps: it must be a whole number", lambda: carom.simulate(table, rack, cue, steps=1.5)),
        ("events_most: it must be a whole number", lambda: carom.simulate(table, rack, cue, events_most=-1)),
        ("time_most: it must be 0 s", lambda: carom.simulate(table, rack, cue, time_most=np.nan)),
        ("threads: it must be a whole number from -1", lambda: carom.simulate_batch(table, rack, cue, threads=-7)),
        ("room: it must be a whole number", lambda: carom.simulate_batch(table, rack, cue, room=-1)),
        ("cue.speed = nan: it must be 0 to 1000 m/s", lambda: carom.simulate(table, rack, carom.cue(speed=np.nan))),
        ("cue.ball = 99: it must be the index", lambda: carom.simulate(table, rack, carom.cue(ball=99))),
        ("cue.ball = 0: this ball is out of play", lambda: carom.simulate(table, pocketed, cue)),
    ):
        with pytest.raises((ValueError, TypeError), match=f"^{message}"):
            call()
    shots = carom.simulate_batch(table, rack, carom.cue(speed=[1.0, np.nan], ball=[99, 0]))
    assert [(index, text.partition(":")[0]) for index, text in shots.failures()] == [((0,), "cue.ball = 99"), ((1,), "cue.speed = nan")]


def test_tables_are_equal_by_their_numbers():
    assert carom.tables.pool_9ft() == carom.tables.pool_9ft() != carom.tables.pool_8ft()
    other = carom.tables.pool_9ft()
    other.rails["restitution"][3] = 0.5
    assert other != carom.tables.pool_9ft() and other != "table"


def test_columns_and_frames():
    """Every number of the records is in a column of its name."""
    table = carom.tables.pool_9ft()
    shot = carom.simulate(table, carom.racks.nineball(table), carom.cue(speed=8.0), cushion_model="han")
    columns = carom.dtypes.columns(shot.events)
    assert all(column.shape == (shot.count,) for column in columns.values())
    np.testing.assert_array_equal(columns["after_b_w_z"], shot.events["after"]["w"][:, 1, 2])
    np.testing.assert_array_equal(columns["time"], shot.events["time"])
    assert set(carom.dtypes.columns(table.rails)) >= {"p_x", "q_y", "height", "line_z"}
    assert "state_label" in carom.dtypes.columns(shot.balls) and "kind_mass" in carom.dtypes.columns(shot.balls)
    with pytest.raises(TypeError, match="records"):
        carom.dtypes.columns(np.zeros(3))
    pytest.importorskip("pandas")
    frame = shot.to_dataframe()
    assert list(frame) == list(columns) and frame["type"][0] == "strike"
    assert (frame["type"] == "ball_ball").sum() == (shot.events["type"] == carom.EventType.BALL_BALL).sum()
