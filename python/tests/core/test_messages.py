"""Each bad argument has its error: of the right kind, beginning with the argument's name, and
saying what would be right.
"""

import enum
import importlib.util
import re
import warnings
from types import SimpleNamespace
from typing import get_args

import numpy as np
import pytest
from conftest import refused_by_name

import carom
import carom.record
from carom._carom import ffi, lib
from carom._described import ShotCushion

TABLE = carom.tables.pool_9ft()
RACK, CUE = carom.racks.nineball(TABLE), carom.cue()
GOOD = carom.impacts(v_a=(1.0, 0.0, 0.0), r_b=(0.05715, 0.0, 0.0))
WALL = carom.cushion_impacts(v=(0.0, 1.0, 0.0))
ROWS = np.tile(carom.dtypes.plain(GOOD), (4, 1))
POCKETED = RACK.copy()
POCKETED["state"]["label"][3] = carom.Label.POCKETED
MASKED = np.ma.masked_array(ROWS, mask=np.zeros_like(ROWS, bool))


def changed_cue(**fields):
    """A cue whose numbers were changed after it was made."""
    cue = carom.cue()
    for name, value in fields.items():
        cue[name] = value
    return cue


def shot(**fields):
    return carom.simulate(TABLE, POCKETED, changed_cue(**fields))


def balls(**fields):
    return carom.simulate(TABLE, carom.balls(**{"r": [[0.5, 0.5], [0.7, 0.5]], **fields}), CUE)


def unknown_motion():
    layout = RACK.copy()
    layout["state"]["v"][1] = 0.0, np.nan, 0.0
    return layout


def billiard(**fields):
    return carom.simulate(
        carom.tables.threecushion(), carom.balls([[0.7, 1.0]], game="billiard", **fields)
    )


def spoiled():
    table = carom.tables.pool_9ft()
    rails = table.rails.copy()
    rails["restitution"][3] = np.nan
    return table.changed(rails=rails)


def rows_of(part):
    """The numbers of a part, with their ranges."""
    k, text = 0, ffi.new("char[]", 100)
    while (row := lib.carom_number_of(part, k)) != ffi.NULL:
        lib.carom_number_range(row, text, 100)
        yield SimpleNamespace(
            name=ffi.string(row.name).decode(), range=ffi.string(text).decode(), error=row.error
        )
        k += 1


ROWS_OF_CUE, ROWS_OF_BALL = (
    list(rows_of(part)) for part in (lib.CAROM_PART_CUE, lib.CAROM_PART_BALL)
)

VALUES = [
    # collisions and cushions
    (
        r"solver: must be one of 'exact', 'euler', 'fast', not 'exakt'",
        lambda: carom.collide(ROWS, solver="exakt"),
    ),
    (
        r"threads: it must be a whole number from -1 to .*, not -7",
        lambda: carom.collide(GOOD, threads=-7),
    ),
    (r"threads: .* from -1 to .*, not -2", lambda: carom.cushion(WALL, threads=-2)),
    (r"threads: .* whole number", lambda: carom.cushion(WALL, threads=10**30)),
    (r"steps: .* from 0 to .*, not -1", lambda: carom.collide(GOOD, solver="euler", steps=-1)),
    (r"steps: .* whole number", lambda: carom.collide(GOOD, steps=2**31)),
    (r"impacts: the shape must be \(\.\.\., 26\)", lambda: carom.collide(np.zeros((4, 25)))),
    (r"(a\.)?v(_a)?: the shape must be", lambda: carom.impacts(v_a=(1, 0), r_b=(1, 0, 0))),
    (r"points: it must be a whole number from 2 to .*, not 1", lambda: carom.trace(GOOD, 1)),
    (r"points: .* from 2 to .*, not 1", lambda: carom.cushion_trace(WALL, 1)),
    (r"impact: a trace is of one impact, of shape \(26,\)", lambda: carom.trace(ROWS)),
    (
        r"least_step: it must be 0 or more .*, not -1.0",
        lambda: carom.cushion(WALL, least_step=-1.0),
    ),
    (
        r"least_step: it must be 0 or more .*, not nan",
        lambda: carom.cushion_trace(WALL, least_step=np.nan),
    ),
    (
        r"omega_ratio: it must be 0, or between 1 and 2, not 2.0",
        lambda: carom.cushion(WALL, model="stronge", omega_ratio=2.0),
    ),
    (
        r"smooth_x: it must be above 0 where smooth_q is, not 0.0",
        lambda: carom.cushion(WALL, model="smooth", smooth_q=0.2),
    ),
    (r"model: must be one of", lambda: carom.cushion(WALL, model="mirrored")),
    (
        r"model: must be 'mathavan' or 'euler', .* not 'han'",
        lambda: carom.cushion_trace(WALL, model="han"),
    ),
    *(
        (
            r"plain: it must be a whole number from 0 to 1",
            lambda plain=plain, call=call: call(plain=plain),
        )
        for plain in (2, -1, "yes", None)
        for call in (lambda **p: carom.collide(GOOD, **p), lambda **p: carom.cushion(WALL, **p))
    ),
    *(
        (
            r"fast: it must be a whole number from 0 to 1",
            lambda fast=fast: carom.simulate(TABLE, RACK, CUE, fast=fast),
        )
        for fast in (2, -1, "yes", None)
    ),
    # tables, racks, cues
    (r"seed: it must be a whole number", lambda: carom.racks.nineball(TABLE, seed=-1)),
    (r"seed: it must be a whole number from 0", lambda: carom.racks.nineball(TABLE, seed=2**64)),
    (r"seed: it must be a whole number", lambda: carom.racks.nineball(TABLE, seed=1.5)),
    (r"gap = -1\.0: it must be 0 m to the radius", lambda: carom.racks.nineball(TABLE, gap=-1)),
    (r"width: it must be positive", lambda: carom.Table(0.0, 1.0, rails=TABLE.rails)),
    (r"rails: ", lambda: carom.Table(1.0, 2.0, rails=[[0.0, 1.0]])),
    (
        r"rails: .* \(up to 32,\)",
        lambda: carom.Table(1.0, 2.0, rails=np.zeros(33, carom.dtypes.rail)),
    ),
    (r"cue: speed is that of the cue, ball_speed", lambda: carom.cue(speed=1.0, ball_speed=1.0)),
    (r"cue: tip says what a and b say", lambda: carom.cue(tip=(0.1, 0.1), b=0.1)),
    (r"tip: the shape must be", lambda: carom.cue(tip=0.1)),
    (r"ball_speed: .* a level cue", lambda: carom.cue(ball_speed=1.0, theta=5.0)),
    (r"ball: .* a whole number, not nan", lambda: carom.cue(ball=[0, np.nan])),
    (r"ball: .* a whole number, not 1\.7", lambda: carom.cue(ball=1.7)),
    (r"ball: .* a whole number, not 1e\+30", lambda: carom.cue(ball=1e30)),
    (
        r"ball: it must be a whole number from 0 to 9",
        lambda: carom.place_ball(TABLE, RACK, 10, 0.4, 0.5),
    ),
    (r"r: setting an array element", lambda: carom.balls([[1.0, 2.0], [3.0]])),
    (r"r: the shape must be", lambda: carom.balls([1.0, 2.0])),
    (
        r"leading dimensions .* but are speed \(2,\), phi \(3,\)",
        lambda: carom.cue(speed=[1, 2], phi=[1, 2, 3]),
    ),
    (
        r"leading dimensions .* but are radius \(3,\), r \(2,\)",
        lambda: carom.balls([[0.5, 0.5]] * 2, radius=[0.03] * 3),
    ),
    # shots
    (r"balls: the shape must be \(balls,\)", lambda: carom.simulate(TABLE, np.stack([RACK] * 2))),
    (r"layouts: the shape", lambda: carom.simulate_batch(TABLE, RACK[0])),
    (
        r"kinds: the shape must be \(\) or \(10,\)",
        lambda: carom.simulate_batch(TABLE, RACK["state"], kinds=RACK["kind"][:3]),
    ),
    (r"cue: one is needed, not 2", lambda: carom.simulate(TABLE, RACK, carom.cue(speed=[1, 2]))),
    (r"steps: it must be a whole number", lambda: carom.simulate(TABLE, RACK, CUE, steps=1.5)),
    (r"steps: it must be a whole number", lambda: carom.simulate_batch(TABLE, RACK, CUE, steps=-3)),
    (
        r"events_most: it must be a whole number",
        lambda: carom.simulate(TABLE, RACK, CUE, events_most=-1),
    ),
    (
        r"t_final: it must be positive and finite",
        lambda: carom.simulate(TABLE, RACK, CUE, t_final=np.nan),
    ),
    (
        r"t_final: it must be positive and finite",
        lambda: carom.simulate_batch(TABLE, RACK, CUE, t_final=0.0),
    ),
    (
        r"stop_at: must be one of 'contact', 'strike'",
        lambda: carom.simulate(TABLE, RACK, CUE, stop_at="goal"),
    ),
    (
        r"cushion_model: must be one of",
        lambda: carom.simulate(TABLE, RACK, CUE, cushion_model="rubber"),
    ),
    (
        r"space: must be one of",
        lambda: carom.simulate(TABLE, RACK, CUE, options=carom.Options(space="2d")),
    ),
    (
        r"records: must be one of 'full', 'brief', not 'some'",
        lambda: carom.simulate_batch(TABLE, RACK, CUE, records="some"),
    ),
    (
        r"threads: it must be a whole number from -1",
        lambda: carom.simulate_batch(TABLE, RACK, CUE, threads=-7),
    ),
    (r"room: it must be a whole number", lambda: carom.simulate_batch(TABLE, RACK, CUE, room=-1)),
    (r"shot: only what simulate", lambda: carom.resume(carom.simulate(TABLE, RACK, CUE))),
    (r"shot: ", lambda: carom.resume(None)),
    *(
        (
            rf"times: .* not {time}",
            lambda time=time, look=look: look(carom.simulate(TABLE, RACK, CUE))([0.1, time]),
        )
        for time in (np.nan, np.inf, -5.0)
        for look in (lambda s: s.positions, lambda s: s.states, lambda s: s.orientations)
    ),
    *(
        (
            rf"times: .* not {time}",
            lambda time=time: carom.simulate_batch(TABLE, RACK, CUE).positions([0.1, time]),
        )
        for time in (np.nan, -1.0)
    ),
    (r"times: .* from the beginning", lambda: carom.tangents(shot(), ["cue.phi"], times=[-1.0])),
    (
        r"times: .* from the beginning",
        lambda: carom.jacobian(TABLE, RACK, CUE, ["cue.phi"], of="at.r", times=[-1.0, 1.0]),
    ),
    *(
        (
            rf"first_of: ball {ball} is {text}",
            lambda ball=ball, play=play: play(TABLE, RACK, CUE, first_of=ball),
        )
        for ball, text in ((0, "the cue ball"), (10, "none of 10"))
        for play in (carom.simulate, carom.simulate_batch)
    ),
    *(
        (r"wrt: ", lambda name=name: carom.tangents(shot(), [name]))
        for name in (
            "phi",
            "cue.mu",
            "balls[17].r",
            "balls[0].r[3]",
            "kind",
            "balls[0].kind.radius",
            "cue.phi[0]",
        )
    ),
    (r"of: .* not None", lambda: carom.jacobian(TABLE, RACK, CUE, ["cue.phi"], of=None)),
]

TYPES = [
    (
        r"cushion\(\) has no argument 'smooth_z'; numbers .* smooth_q, smooth_x",
        lambda: carom.cushion(WALL, smooth_z=1.0),
    ),
    (r"speed: real numbers are needed, not 'fast'", lambda: carom.cue(speed="fast")),
    (r"balls: .* carom\.balls\(\)", lambda: carom.place_ball(TABLE, [1.0, 2.0], 0, 0.5, 0.5)),
    (r"balls: .* carom\.balls\(\)", lambda: carom.simulate(TABLE, np.zeros((2, 20)))),
    (r"balls: .* not of carom\.dtypes\.cue$", lambda: carom.simulate(TABLE, CUE)),
    (
        r"layouts: .* or kinds= beside states, is needed, not of carom\.dtypes\.ball_state$",
        lambda: carom.simulate_batch(TABLE, RACK["state"]),
    ),
    (
        r'layouts: .* carom\.balls\(\)\["state"\], beside kinds, is needed, not of carom\.dtypes\.shot_ball$',
        lambda: carom.simulate_batch(TABLE, RACK, kinds=RACK["kind"]),
    ),
    (
        r'kinds: .* carom\.balls\(\)\["kind"\] is needed, not of carom\.dtypes\.shot_ball$',
        lambda: carom.simulate_batch(TABLE, RACK["state"], kinds=RACK),
    ),
    (
        r"balls: there is no field 'mu'; known are mass, radius",
        lambda: carom.balls([[0.5, 0.5]], mu=0.2),
    ),
    (r"table: .* not NoneType", lambda: carom.place_ball(None, RACK, 0, 0.5, 0.5)),
    (r"table: .* not str", lambda: carom.racks.nineball("9ft")),
    (r"table: a carom.Table is needed", lambda: carom.simulate("pool", RACK, CUE)),
    (r"cue: .* carom\.cue\(\)", lambda: carom.struck(10**30, RACK[0]["kind"])),
    (r"kind: ", lambda: carom.struck(CUE, [np.inf])),
    (r"speed: real numbers", lambda: carom.cue(speed=[1j])),
    (r"impacts: real numbers", lambda: carom.collide(np.zeros((3, 26), np.complex128))),
    (
        r"impacts: .* carom\.dtypes\.impact, not carom\.dtypes\.shot_ball$",
        lambda: carom.collide(RACK),
    ),
    (
        r"impacts: .* not a structured dtype of mass, radius$",
        lambda: carom.collide(RACK["kind"][["mass", "radius"]]),
    ),
    (r"out\[0\]: .* not str", lambda: carom.collide(GOOD, out=("motion", "status"))),
    (
        r"records: .* of carom\.dtypes\.shot_ball and shape",
        lambda: carom.dtypes.columns(RACK.reshape(2, 5)),
    ),
    (r"records: ", lambda: carom.dtypes.columns(np.zeros(3))),
    (r"shot: .* not str", lambda: carom.tangents("shot", ["cue.phi"])),
    (
        r"options: there is no 'cushon_model'; known are world, ball_model",
        lambda: carom.Options(cushon_model="han"),
    ),
    (
        r"options: there is no 'cushion'; known are world, ball_model",
        lambda: carom.simulate(TABLE, RACK, CUE, cushion="han"),
    ),
    # masks would be lost
    *(
        (rf"{name}: masks are not read", call)
        for name, call in (
            ("impacts", lambda: carom.collide(MASKED)),
            ("impacts", lambda: carom.cushion(np.ma.masked_array(WALL))),
            ("impacts", lambda: carom.mu_ball(MASKED)),
            ("impact", lambda: carom.trace(MASKED[0])),
            (
                r"out\[0\]",
                lambda: carom.collide(ROWS, out=(np.ma.zeros((4, 12)), np.zeros(4, np.int8))),
            ),
            (
                "restitution",
                lambda: carom.impacts(
                    v_a=(1, 0, 0), r_b=(1, 0, 0), restitution=np.ma.masked_array([0.9], mask=[True])
                ),
            ),
            ("layouts", lambda: carom.simulate_batch(TABLE, np.ma.masked_array(RACK))),
            (
                "times",
                lambda: carom.simulate(TABLE, RACK, CUE).positions(
                    np.ma.masked_array([0.1], mask=[True])
                ),
            ),
            ("r", lambda: carom.balls(np.ma.zeros((3, 2)))),
        )
    ),
]

FIELDS = [
    (
        r"a\.mass = -1\.0: a mass must be positive and finite",
        lambda: carom.collide(carom.impacts(v_a=(1, 0, 0), r_b=(1, 0, 0), mass=-1.0)),
    ),
    (
        r"a\.mass = -1\.0: a mass must be",
        lambda: carom.collide(np.where(np.arange(26) == 10, -1.0, ROWS[0]).astype(np.float32)),
    ),
    (
        r"a\.mass = -1\.0: a mass must be",
        lambda: carom.trace(carom.impacts(v_a=(1, 0, 0), r_b=(1, 0, 0), mass=-1.0)),
    ),
    (
        r"mu_ball = 2\.0",
        lambda: carom.collide(carom.impacts(v_a=(1, 0, 0), r_b=(0.05715, 0, 0), mu_ball=2.0)),
    ),
    (
        r"mu_cushion = 3\.0",
        lambda: carom.cushion(carom.cushion_impacts(v=(0, 1, 0), mu_cushion=3.0)),
    ),
    (
        r"mu_cushion = 3\.0",
        lambda: carom.cushion_trace(carom.cushion_impacts(v=(0, 1, 0), mu_cushion=3.0)),
    ),
    *(
        (
            rf"cue\.{row.name} = {value}: it must be {re.escape(row.range)}$",
            lambda row=row, value=value: shot(**{row.name: value}),
        )
        for row in ROWS_OF_CUE
        if row.error not in (0, lib.CAROM_ERROR_MISCUE)
        for value in ([99, -1] if row.name == "ball" else [np.nan])
    ),
    *(
        (
            rf"cue\.{row.name} = {value}: it must be {re.escape(row.range)}$",
            lambda row=row, value=value: carom.cue(**{row.name: value}),
        )
        for row in ROWS_OF_CUE
        for value in ([99, -1] if row.name == "ball" else [np.nan, np.inf, -2e9])
        if row.name != "theta" or value == value
    ),
    (r"cue\.speed = nan", lambda: carom.cue(speed=np.array(np.nan))),
    (r"cue\.speed = -", lambda: carom.cue(ball_speed=-1.0)),
    (r"cue\.ball = 3: it must be in play", lambda: shot(ball=3)),
    (
        r"cue\.a, cue\.b = 0\.8, 0\.8: the tip misses the ball: .* must be below",
        lambda: shot(a=0.8, b=0.8),
    ),
    (r"cue\.a, cue\.b = 0\.3, 0\.4: .*miscue", lambda: shot(a=0.3, b=0.4, miscue=0.5)),
    (r"cue\.phi = 1e\+308: ", lambda: carom.struck(changed_cue(phi=1e308), RACK[0]["kind"])),
    (
        r"cue\.speed = nan: it must be 0",
        lambda: carom.struck(changed_cue(speed=np.nan), RACK[0]["kind"]),
    ),
    (
        r"cue\.a, cue\.b = 0\.8, 0\.8: ",
        lambda: carom.struck(carom.cue(a=0.8, b=0.8), RACK[0]["kind"]),
    ),
    (
        r"kind\.mass = -1\.0: it must be above 0 and finite, in kg",
        lambda: carom.struck(CUE, carom.balls([[0, 0]], mass=-1.0)["kind"][0]),
    ),
    (
        r"balls = 40: the count of balls must be 1 to 32",
        lambda: carom.simulate(TABLE, np.repeat(RACK, 4)),
    ),
    (
        r"layouts = 40: the count of balls must be 1 to 32",
        lambda: carom.simulate_batch(TABLE, np.repeat(RACK, 4)),
    ),
    (
        r"x, y = nan, 0\.5: a position must be finite",
        lambda: carom.place_ball(TABLE, RACK, 0, np.nan, 0.5),
    ),
    *(
        (
            rf"balls\[1\]\.kind\.{row.name} = nan: it must be {re.escape(row.range)}$",
            lambda row=row: balls(**{row.name: [RACK[0]["kind"][row.name], np.nan]}),
        )
        for row in ROWS_OF_BALL
    ),
    (r"balls\[1\]\.state\.v = \[ ?0\. nan ", lambda: carom.simulate(TABLE, unknown_motion(), CUE)),
    (r"balls\[1\]\.state\.r = \[-0\.5", lambda: balls(r=[[0.5, 0.5], [-0.5, 0.5]])),
    (
        r"balls\[0\]\.kind\.nose_height = 0\.07: it must be below 2 R",
        lambda: billiard(nose_height=0.07),
    ),
    (
        r"table\.rails\[3\]\.restitution = nan: it must be 0 to 1",
        lambda: carom.simulate(spoiled(), RACK, CUE),
    ),
]

CASES = [
    (kind, *case)
    for kind, cases in ((ValueError, VALUES), (TypeError, TYPES), (carom.CaromError, FIELDS))
    for case in cases
]


@pytest.mark.parametrize(
    ("kind", "message", "call"), CASES, ids=[f"{k}-{case[1][:24]}" for k, case in enumerate(CASES)]
)
def test_message(kind, message, call):
    """Short, without a warning of NumPy's; the field of a CaromError is the one that the message
    names.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(kind, match=f"^{message}") as caught:
            call()
    assert (
        len(str(caught.value)) < 400
        and "offsets" not in str(caught.value)
        and "options." not in str(caught.value)
    )
    if kind is carom.CaromError:
        assert (
            caught.value.field == str(caught.value).partition(" = ")[0] and caught.value.status < 0
        )


def test_what_is_wrong_is_refused_when_it_is_made():
    for name, fields in (("r", {"r": [[np.nan, 0.8]]}), ("v", {"r": [[0.6, 0.8]], "v": np.inf})):
        with pytest.raises(ValueError, match=f"^{name}: finite numbers are needed, not (nan|inf)$"):
            carom.balls(**fields)
    # of many layouts a wrong one costs its own shot
    layouts = carom.balls([[[0.6, 0.8]], [[np.nan, 0.8]]])
    assert carom.simulate_batch(TABLE, layouts, CUE).refused.tolist() == [False, True]
    for wrong in ({"cushion_model": "hann"}, {"steps": -1}, {"t_final": -1.0}, {"first_of": 99}):
        (name,) = wrong
        with pytest.raises(ValueError, match=f"^{name}: "):
            carom.Options(**wrong)


def test_a_generator_is_a_seed():
    """It draws a seed, so that each call has another, and the same generator gives the same."""

    def racks(generator):
        return [carom.racks.nineball(TABLE, seed=generator).tobytes() for _ in range(2)]

    first, second = (racks(np.random.default_rng(5)) for _ in range(2))
    assert first == second and first[0] != first[1]
    with pytest.raises(ValueError, match="^seed: it must be a whole number .*Generator will do"):
        carom.racks.nineball(TABLE, seed=0.5)


SHOT, BATCH = (
    carom.simulate(TABLE, RACK, CUE),
    carom.simulate_batch(TABLE, RACK, carom.cue(speed=[1.0, 2.0])),
)
STOPPED, PAIR = (
    carom.simulate(TABLE, RACK, CUE, t_final=0.1),
    carom.balls([[0.6, 0.8], [0.75, 1.6]]),
)
CORNERS = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
# Each function with arguments that are right, and those that each wrong value takes the place of in
# turn.
CALLS = [
    (
        carom.cue,
        {},
        "speed phi theta a b ball game mass end_mass tip_radius miscue tip_time tip_restitution ball_speed tip follow",
    ),
    (carom.balls, {"r": [[0.6, 0.8]]}, "r v w game mass mu_slide nose_height"),
    (
        carom.simulate,
        {"table": TABLE, "balls": PAIR},
        "table balls options world ball_model cushion_model friction space simultaneous cluster_steps steps events_most plain t_final stop_at first_of",
    ),
    (
        carom.simulate_batch,
        {"table": TABLE, "layouts": PAIR},
        "table layouts room kinds records threads out options t_final stop_at",
    ),
    (carom.resume, {"shot": STOPPED}, "shot t_final stop_at"),
    (carom.cite, {}, "options world"),
    (carom.tangents, {"shot": SHOT, "wrt": ["cue.phi"]}, "shot wrt times threads"),
    (
        carom.jacobian,
        {"table": TABLE, "layouts": PAIR, "cues": CUE, "wrt": ["cue.phi"]},
        "table layouts wrt of times room threads options",
    ),
    (
        carom.place_ball,
        {"table": TABLE, "balls": PAIR, "ball": 0, "x": 0.5, "y": 0.5},
        "table balls ball x y",
    ),
    (
        carom.by_number,
        {"balls": PAIR, "ids": ["cue", 1], "rules": "nineball"},
        "balls ids rules cue",
    ),
    (carom.struck, {"cue": CUE, "kind": PAIR[0]["kind"]}, "cue kind"),
    (
        carom.impacts,
        {"v_a": (1.0, 0.0, 0.0), "r_b": (0.05715, 0.0, 0.0)},
        "v_a r_b w_a radius mass mass_b mu_ball",
    ),
    (carom.collide, {"impacts": GOOD}, "impacts solver slip steps threads plain out"),
    (carom.mu_ball, {"impacts": GOOD}, "impacts law"),
    (carom.trace, {"impact": GOOD}, "impact points solver"),
    (carom.cushion_impacts, {"v": (0.0, 1.0, 0.0)}, "v w normal height radius jaw_radius"),
    (
        carom.cushion,
        {"impacts": WALL},
        "impacts model convention law steps least_step omega_ratio plain threads out",
    ),
    (carom.cushion_trace, {"impact": WALL}, "impact points model least_step"),
    (carom.racks.nineball, {"table": TABLE}, "table gap seed"),
    (carom.tables.polygon, {"corners": CORNERS}, "corners nose_height jaw_radius ball_radius"),
    (
        carom.Table,
        {"width": 1.0, "length": 2.0, "rails": TABLE.rails},
        "width length rails jaws pockets ball_radius rail_width pocket_back",
    ),
    (SHOT.positions, {"times": 0.1}, "times"),
    (SHOT.animate, {}, "speed"),
    (BATCH.positions, {"times": 0.1}, "times threads"),
    *([(BATCH.to_dataframe, {}, "dims")] if importlib.util.find_spec("pandas") else []),
]


@pytest.mark.parametrize(
    ("call", "good", "names"), CALLS, ids=[case[0].__qualname__ for case in CALLS]
)
def test_a_value_of_another_kind_is_refused_by_the_name_of_its_argument(call, good, names):
    refused_by_name(call, good, names)


def test_what_looks_like_a_number_and_is_none():
    for call, message in (
        (lambda: carom.cue(phi="90"), "phi: real numbers are needed, not '90'"),
        (lambda: carom.cue(speed=[None, 1.0]), "speed: real numbers are needed, not [None, 1.0]"),
        (
            lambda: carom.simulate(TABLE, PAIR, CUE, t_final="1"),
            "t_final: a time in s is needed, or None, not '1'",
        ),
        (
            lambda: carom.simulate(TABLE, PAIR, CUE, options={}),
            "options: a carom.Options is needed, such as",
        ),
    ):
        with pytest.raises(TypeError, match="^" + re.escape(message)):
            call()


PRIVATE = re.compile(r"(?<![\w.])_[a-z]\w*|\._[a-z]\w*|ShotOptions")


def test_errors_name_public_names():
    """Of a misspelt argument, by each call and class of the package."""
    for module in (carom, carom.racks, carom.tables, carom.dtypes, carom.record, carom.derivatives):
        for call in (
            getattr(module, name, None) for name in dir(module)
        ):  # without the folders, of the core
            if callable(call) and not isinstance(call, enum.EnumMeta):
                with pytest.raises(TypeError) as caught:
                    call(misspelt=1)
                assert not PRIVATE.search(str(caught.value)), str(caught.value)
    for about in (carom.simulate, carom.tangents, carom.Options, carom.Shot, carom.Shots):
        assert not PRIVATE.search(about.__doc__), about


@pytest.mark.parametrize("play", [carom.simulate, carom.simulate_batch])
def test_balls_of_another_game_than_the_table_are_doubted(play):
    tables = {
        "snooker": carom.tables.snooker(),
        "billiard": carom.tables.threecushion(),
        "blackball": carom.tables.blackball(),
        "pyramid": carom.tables.pyramid(corner=0.073),
        "pool": TABLE,
        "snooker, by its number": carom.tables.polygon(CORNERS, ball_radius=0.02619375),
    }
    for made_for, table in tables.items():
        for game in ("pool", "snooker", "billiard", "blackball", "pyramid"):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                play(table, carom.balls([[0.5, 0.5]], game=game))
            doubt = f"balls: they are of {game}, .* made for those of {made_for.partition(',')[0]}"
            assert len(caught) == (not made_for.startswith(game)) and all(
                re.match(doubt, str(warning.message)) for warning in caught
            )
    for game in ("pool", "fourball"):  # tables of one size
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            play(carom.tables.fourball(), carom.balls([[0.5, 0.5]], game=game))


def test_a_model_of_the_cushion_has_its_own_constants_or_says_that_it_has_none():
    tables = {
        "pool": TABLE,
        "snooker": carom.tables.snooker(),
        "billiard": carom.tables.threecushion(),
    }
    models = get_args(ShotCushion)
    for game, table in tables.items():

        def played(model, options, play=carom.simulate):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                layout = carom.balls([[0.5, 0.5]], game=game, cushion_model=options)
                count = len(caught)
                final = play(table, layout, carom.cue(speed=4.0), cushion_model=model).final
            return count, [str(warning.message) for warning in caught[count:]], final

        for model in models:
            none, caught, own_ball = played(model, model)
            message, doubt_of_default = played(model, "default")[1:]
            assert none == (len(caught) == 1) and all(
                f"{game} has no constants for it" in text for text in caught
            )
            # what is another shot, or has none of its own, is told
            assert (
                len(message)
                == (none or doubt_of_default.tobytes() != own_ball.tobytes())
                == len(played(model, "default", carom.simulate_batch)[1])
            )
            assert model not in ("default", "smooth") or (not message and not none)
        assert len(played("han", "mathavan")[1]) == 1
    with pytest.raises(ValueError, match="cushion_model: must be one of 'default', 'mathavan'"):
        carom.balls([[0.5, 0.5]], cushion_model="rubber")


def test_features_that_were_not_asked_for_are_told():
    with pytest.raises(
        AttributeError, match=r"^features: simulate_batch\(features=True\) tells them"
    ):
        BATCH.features  # noqa: B018


def test_completion_has_no_internals():
    """What dir() lists, which completion shows, is told in the docs or in the text of its class."""
    private = {
        "look_at",
        "jobs",
        "facts",
        "batch",
        "index",
        "directions",
        "seeds_of",
        "play",
        "check_table",
        "of_record",
        "Made",
        "judge",
        "colour",
    }
    for shown in (BATCH, BATCH[0], carom.derivatives, carom.layouts, carom.pictures, carom.shots):
        assert not private & set(dir(shown)), shown


def test_failures_of_a_batch():
    layouts = np.stack([RACK] * 4)
    layouts["kind"]["mass"][2, 3], layouts["state"]["r"][3, 5] = -1.0, 0.0
    shots = carom.simulate_batch(
        TABLE, layouts, carom.cue(speed=[1.0, np.nan, 1.0, 1.0], ball=[99, 0, 0, 0])
    )
    failures = [(index[0], text.partition(":")[0]) for index, text in shots.failures()]
    assert failures == [
        (0, "cue.ball = 99"),
        (1, "cue.speed = nan"),
        (2, "balls[3].kind.mass = -1.0"),
        (3, "balls[5].state.r = [0. 0. 0.]"),
    ]
    with pytest.raises(carom.CaromError, match=r"^balls\[3\]\.kind\.mass = -1\.0"):
        shots[2].positions(0.1)
    assert all("options." not in status.text for status in carom.Status)


@pytest.mark.parametrize(
    "angles",
    [
        {"phi": np.pi / 2},
        {"phi": np.linspace(0.0, 2.0 * np.pi, 100)},
        {"phi": -np.pi / 3},
        {"phi": 0.0, "theta": np.pi / 12},
    ],
)
def test_radians_are_doubted(angles):
    with pytest.warns(UserWarning, match="degrees are taken, but .* looks like radians") as caught:
        carom.cue(**angles)
    assert caught[0].filename == __file__


def test_degrees_are_not_doubted():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for phi in (
            0.0,
            90.0,
            1.5,
            np.linspace(0.0, 360.0, 100),
            np.zeros(0),
            [np.nan],
            [np.inf],
            360.0 * np.pi,
        ):
            carom.cue(phi=phi)


def test_balls_documents_each_number():
    """Editors and help() show what a ball may be given: all that the library knows."""
    words = set(re.findall(r"\w+", carom.balls.__doc__))
    assert [name for name in carom.dtypes.ball_kind.names if name not in words] == []
