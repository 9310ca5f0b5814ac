"""Each bad argument has its error: of the right kind, beginning with the argument's name, and
saying what would be right.
"""

import enum
import re
import warnings
from typing import get_args

import numpy as np
import pytest
from conftest import by_line, name_of, refused, refused_by_name

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


SHOT, BATCH = (
    carom.simulate(TABLE, RACK, CUE),
    carom.simulate_batch(TABLE, RACK, carom.cue(speed=[1.0, 2.0])),
)
STOPPED, PAIR = (
    carom.simulate(TABLE, RACK, CUE, t_final=0.1),
    carom.balls([[0.6, 0.8], [0.75, 1.6]]),
)
CORNERS = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def rows_of(part):
    """The numbers of a part: name, range, error."""
    k, text = 0, ffi.new("char[]", 100)
    while (row := lib.carom_number_of(part, k)) != ffi.NULL:
        lib.carom_number_range(row, text, 100)
        yield ffi.string(row.name).decode(), re.escape(ffi.string(text).decode()), row.error
        k += 1


def numbers_in_error():
    """Refusals of numbers outside the ranges in the library."""
    for name, allowed, error in rows_of(lib.CAROM_PART_CUE):
        for value in (99, -1) if name == "ball" else (np.nan, np.inf, -2000000000.0):
            message = rf"cue\.{name} = {value}: it must be {allowed}$"
            if name != "theta" or not np.isnan(value):
                yield pytest.param(
                    lambda name=name, value=value: carom.cue(**{name: value}),
                    message,
                    id=f"cue {name}={value}",
                )
            if error not in (0, lib.CAROM_ERROR_MISCUE) and (name == "ball" or np.isnan(value)):
                yield pytest.param(
                    lambda name=name, value=value: shot(**{name: value}),
                    message,
                    id=f"shot {name}={value}",
                )
    for name, allowed, _ in rows_of(lib.CAROM_PART_BALL):
        message = rf"balls\[1\]\.kind\.{name} = nan: it must be {allowed}$"
        good = RACK[0]["kind"][name]
        yield pytest.param(
            lambda name=name, good=good: balls(**{name: [good, np.nan]}),
            message,
            id=f"balls {name}",
        )


# A call, the class of its error, and a pattern with which its message begins.
REFUSALS = [
    (
        lambda: carom.collide(ROWS, solver="exakt"),
        ValueError,
        r"solver: unknown value 'exakt'; did you mean 'exact'\? Use 'exact', 'euler' or 'fast'",
    ),
    (
        lambda: carom.collide(GOOD, threads=-7),
        ValueError,
        "threads: -7 is not an integer from -1 to 2147483647",
    ),
    (
        lambda: carom.cushion(WALL, threads=-2),
        ValueError,
        "threads: -2 is not an integer from -1 to 2147483647",
    ),
    (
        lambda: carom.cushion(WALL, threads=10**30),
        ValueError,
        "threads: 1000000000000000000000000000000 is not an integer from -1 to 2147483647",
    ),
    (
        lambda: carom.collide(GOOD, solver="euler", steps=-1),
        ValueError,
        "steps: -1 is not an integer from 0 to 2147483647",
    ),
    (
        lambda: carom.collide(GOOD, steps=2**31),
        ValueError,
        "steps: 2147483648 is not an integer from 0 to 2147483647",
    ),
    (
        lambda: carom.collide(np.zeros((4, 25))),
        ValueError,
        r"impacts: the shape is \(4, 25\), but must be \(\.\.\., 26\)",
    ),
    (
        lambda: carom.impacts(v_a=(1, 0), r_b=(1, 0, 0)),
        ValueError,
        r"v_a: the shape is \(2,\), but must be \(\.\.\., 3\)",
    ),
    (
        lambda: carom.trace(GOOD, 1),
        ValueError,
        "points: 1 is not an integer from 2 to 2147483647",
    ),
    (
        lambda: carom.cushion_trace(WALL, 1),
        ValueError,
        "points: 1 is not an integer from 2 to 2147483647",
    ),
    (
        lambda: carom.trace(ROWS),
        ValueError,
        r"impact: a trace follows one impact, of shape \(26,\), or structured of shape \(\); loop over several",
    ),
    (
        lambda: carom.cushion(WALL, least_step=-1.0),
        ValueError,
        r"least_step: -1\.0 N s is negative or not finite; use 0 or more",
    ),
    (
        lambda: carom.cushion_trace(WALL, least_step=np.nan),
        ValueError,
        "least_step: nan N s is negative or not finite; use 0 or more",
    ),
    (
        lambda: carom.cushion(WALL, model="stronge", omega_ratio=2.0),
        ValueError,
        r"omega_ratio: 2\.0 is out of range; it must be 0, or between 1 and 2",
    ),
    (
        lambda: carom.cushion(WALL, model="smooth", smooth_q=0.2),
        ValueError,
        r"smooth_x: 0\.0 is out of range; it must be above 0 where smooth_q is",
    ),
    (
        lambda: carom.cushion(WALL, model="mirrored"),
        ValueError,
        r"model: unknown value 'mirrored'; did you mean 'mirror'\? Use 'mathavan', 'stronge', 'han', 'mirror', 'euler' or 'smooth'",
    ),
    (
        lambda: carom.cushion_trace(WALL, model="han"),
        ValueError,
        r"model: unknown value 'han'; use 'mathavan' or 'euler'",
    ),
    (lambda: carom.racks.nineball(TABLE, seed=-1), ValueError, "seed: -1 is not an integer from 0"),
    (
        lambda: carom.racks.nineball(TABLE, seed=2**64),
        ValueError,
        r"seed: 18446744073709551616 is not an integer from 0 to 18446744073709551615, or a numpy\.random\.Generator",
    ),
    (
        lambda: carom.racks.nineball(TABLE, seed=1.5),
        ValueError,
        r"seed: 1\.5 is not an integer from 0",
    ),
    (
        lambda: carom.racks.nineball(TABLE, gap=-1),
        carom.CaromError,
        r"gap = -1\.0: it must be 0 m to the radius",
    ),
    (
        lambda: carom.Table(0.0, 1.0, rails=TABLE.rails),
        ValueError,
        "width: 0 m is not positive and finite",
    ),
    (lambda: carom.Table(1.0, 2.0, rails=[[0.0, 1.0]]), ValueError, "rails: "),
    (
        lambda: carom.Table(1.0, 2.0, rails=np.zeros(33, carom.dtypes.rail)),
        ValueError,
        r"rails: the dtype is carom\.dtypes\.rail and the shape \(33,\), but must be carom\.dtypes\.rail and \(n,\) with n up to 32",
    ),
    (
        lambda: carom.cue(speed=1.0, ball_speed=1.0),
        ValueError,
        "cue: speed and ball_speed cannot be combined; pass the cue's speed or the ball's",
    ),
    (
        lambda: carom.cue(tip=(0.1, 0.1), b=0.1),
        ValueError,
        r"cue: tip cannot be combined with a or b; pass tip=\(right, above\), or a=-right and b=above",
    ),
    (
        lambda: carom.cue(tip=0.1),
        ValueError,
        r"tip: the shape is \(\), but must be \(\.\.\., 2\): right of and above the centre",
    ),
    (lambda: carom.cue(ball_speed=1.0, theta=5.0), ValueError, "ball_speed: .* a level cue"),
    (
        lambda: carom.cue(ball=[0, np.nan]),
        ValueError,
        "ball: nan is not the index of a ball; pass an integer",
    ),
    (
        lambda: carom.cue(ball=1.7),
        ValueError,
        r"ball: 1\.7 is not the index of a ball; pass an integer",
    ),
    (
        lambda: carom.cue(ball=1e30),
        ValueError,
        r"ball: 1e\+30 is not the index of a ball; pass an integer",
    ),
    (
        lambda: carom.place_ball(TABLE, RACK, 10, 0.4, 0.5),
        ValueError,
        "ball: 10 is not an integer from 0 to 9",
    ),
    (lambda: carom.balls([[1.0, 2.0], [3.0]]), ValueError, "r: setting an array element"),
    (
        lambda: carom.balls([1.0, 2.0]),
        ValueError,
        r"r: the shape is \(2,\), but must be \(\.\.\., balls, 2\) or \(\.\.\., balls, 3\)",
    ),
    (
        lambda: carom.cue(speed=[1, 2], phi=[1, 2, 3]),
        ValueError,
        r"the leading dimensions cannot be broadcast: speed \(2,\), phi \(3,\); they must be equal or 1",
    ),
    (
        lambda: carom.balls([[0.5, 0.5]] * 2, radius=[0.03] * 3),
        ValueError,
        r"the leading dimensions cannot be broadcast: radius \(3,\), r \(2,\); they must be equal or 1",
    ),
    (
        lambda: carom.simulate(TABLE, np.stack([RACK] * 2)),
        ValueError,
        r"balls: the shape is \(2, 10\), but must be \(balls,\); simulate_batch\(\) accepts several layouts",
    ),
    (lambda: carom.simulate_batch(TABLE, RACK[0]), ValueError, "layouts: the shape"),
    (
        lambda: carom.simulate_batch(TABLE, RACK["state"], kinds=RACK["kind"][:3]),
        ValueError,
        r"kinds: the shape is \(3,\), but must be \(\) or \(10,\), one kind for each ball of the layouts",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, carom.cue(speed=[1, 2])),
        ValueError,
        r"cue: there are 2 cues, but only one is allowed; simulate_batch\(\) accepts several",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE, steps=1.5),
        ValueError,
        "steps: .* is not an integer from 0 to 2147483647",
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK, CUE, steps=-3),
        ValueError,
        "steps: .* is not an integer from 0 to 2147483647",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE, events_most=-1),
        ValueError,
        "events_most: -1 is not an integer from 0 to 2147483647",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE, t_final=np.nan),
        ValueError,
        "t_final: .* s is not positive and finite",
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK, CUE, t_final=0.0),
        ValueError,
        "t_final: .* s is not positive and finite",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE, stop_at="goal"),
        ValueError,
        r"stop_at: unknown value 'goal'; use 'contact', 'strike', 'ball_ball', 'rail', 'jaw', 'pocket',",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE, cushion_model="rubber"),
        ValueError,
        r"cushion_model: unknown value 'rubber'; use 'default', 'mathavan', 'stronge', 'han', 'mirror', 'euler' or",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE, options=carom.Options(space="2d")),
        ValueError,
        r"space: unknown value '2d'; use '3d' or 'flat'",
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK, CUE, records="some"),
        ValueError,
        "records: unknown value 'some'; use 'full' or 'brief'",
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK, CUE, threads=-7),
        ValueError,
        "threads: -7 is not an integer from -1 to 2147483647",
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK, CUE, room=-1),
        ValueError,
        "room: -1 is not an integer from 0 to 2147483647",
    ),
    (
        lambda: carom.resume(carom.simulate(TABLE, RACK, CUE)),
        ValueError,
        r"shot: this shot cannot be resumed; pass a result of simulate\(\) or resume\(\) with t_final= or stop_at=",
    ),
    (lambda: carom.resume(None), ValueError, "shot: "),
    (
        lambda: carom.tangents(shot(), ["cue.phi"], times=[-1.0]),
        ValueError,
        "times: .* from the beginning",
    ),
    (
        lambda: carom.jacobian(TABLE, RACK, CUE, ["cue.phi"], of="at.r", times=[-1.0, 1.0]),
        ValueError,
        "times: .* from the beginning",
    ),
    (
        lambda: carom.jacobian(TABLE, RACK, CUE, ["cue.phi"], of=None),
        ValueError,
        r"of: unknown value None; use 'final\.r', 'final\.v', 'final\.w', 'final\.z', 'final\.v_z', 'at\.r', 'at\.v', 'at\.w', 'at\.z', 'at\.v_z',",
    ),
    (
        lambda: carom.cushion(WALL, smooth_z=1.0),
        TypeError,
        r"cushion\(\): unknown argument 'smooth_z'; did you mean 'smooth_x'\? Use roll_loss, omega_ratio, restitution_log, mu_log, smooth_q,",
    ),
    (lambda: carom.cue(speed="fast"), TypeError, "speed: 'fast' does not consist of real numbers"),
    (
        lambda: carom.place_ball(TABLE, [1.0, 2.0], 0, 0.5, 0.5),
        TypeError,
        r"balls: .* carom\.balls\(\)",
    ),
    (lambda: carom.simulate(TABLE, np.zeros((2, 20))), TypeError, r"balls: .* carom\.balls\(\)"),
    (
        lambda: carom.simulate(TABLE, CUE),
        TypeError,
        r"balls: the dtype is carom\.dtypes\.cue; pass the result of carom\.balls\(\)$",
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK["state"]),
        TypeError,
        r"layouts: the dtype is carom\.dtypes\.ball_state; pass the result of carom\.balls\(\), or pass kinds= with states$",
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK, kinds=RACK["kind"]),
        TypeError,
        r'layouts: the dtype is carom\.dtypes\.shot_ball; pass the result of carom\.balls\(\)\["state"\], as kinds= is given$',
    ),
    (
        lambda: carom.simulate_batch(TABLE, RACK["state"], kinds=RACK),
        TypeError,
        r'kinds: the dtype is carom\.dtypes\.shot_ball; pass the result of carom\.balls\(\)\["kind"\]$',
    ),
    (
        lambda: carom.balls([[0.5, 0.5]], mu=0.2),
        TypeError,
        r"balls: unknown field 'mu'; did you mean 'mu_slide'\? help\(carom\.balls\) lists all",
    ),
    (
        lambda: carom.place_ball(None, RACK, 0, 0.5, 0.5),
        TypeError,
        r"table: NoneType is not a carom\.Table; pass carom\.tables\.pool_9ft\(\)",
    ),
    (
        lambda: carom.racks.nineball("9ft"),
        TypeError,
        r"table: '9ft' is not a carom\.Table; pass carom\.tables\.pool_9ft\(\)",
    ),
    (
        lambda: carom.simulate("pool", RACK, CUE),
        TypeError,
        r"table: 'pool' is not a carom\.Table; pass carom\.tables\.pool_9ft\(\)",
    ),
    (lambda: carom.struck(10**30, RACK[0]["kind"]), TypeError, r"cue: .* carom\.cue\(\)"),
    (lambda: carom.struck(CUE, [np.inf]), TypeError, "kind: "),
    (lambda: carom.cue(speed=[1j]), TypeError, r"speed: \[1j\] does not consist of real numbers"),
    (
        lambda: carom.collide(np.zeros((3, 26), np.complex128)),
        TypeError,
        r"impacts: array\(\[\[0\.\+0\.\.\.\.0\.j, 0\.\+0\.j\]\]\) does not consist of real numbers",
    ),
    (
        lambda: carom.collide(RACK),
        TypeError,
        r"impacts: the dtype is carom\.dtypes\.shot_ball, but must be carom\.dtypes\.impact$",
    ),
    (
        lambda: carom.collide(RACK["kind"][["mass", "radius"]]),
        TypeError,
        r"impacts: the dtype is a structured dtype of mass, radius, but must be carom\.dtypes\.impact$",
    ),
    (
        lambda: carom.collide(GOOD, out=("motion", "status")),
        TypeError,
        r"out\[0\]: str is not an array; it must have shape \(\) and dtype carom\.dtypes\.result",
    ),
    (
        lambda: carom.dtypes.columns(RACK.reshape(2, 5)),
        TypeError,
        r"records: dtype carom\.dtypes\.shot_ball and shape \(2, 5\) do not fit; pass a structured array of shape \(n,\)",
    ),
    (lambda: carom.dtypes.columns(np.zeros(3)), TypeError, "records: "),
    (
        lambda: carom.tangents("shot", ["cue.phi"]),
        TypeError,
        r"shot: str is not a result of carom\.simulate\(\) or carom\.simulate_batch\(\)",
    ),
    (
        lambda: carom.Options(cushon_model="han"),
        TypeError,
        r"options: unknown option 'cushon_model'; did you mean 'cushion_model'\? Use world, ball_model, cushion_model, friction, space,",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE, cushion="han"),
        TypeError,
        r"options: unknown option 'cushion'; did you mean 'cushion_model'\? Use world, ball_model, cushion_model, friction, space,",
    ),
    (
        lambda: carom.collide(carom.impacts(v_a=(1, 0, 0), r_b=(1, 0, 0), mass=-1.0)),
        carom.CaromError,
        r"a\.mass = -1\.0: a mass must be positive and finite",
    ),
    (
        lambda: carom.collide(np.where(np.arange(26) == 10, -1.0, ROWS[0]).astype(np.float32)),
        carom.CaromError,
        r"a\.mass = -1\.0: a mass must be",
    ),
    (
        lambda: carom.trace(carom.impacts(v_a=(1, 0, 0), r_b=(1, 0, 0), mass=-1.0)),
        carom.CaromError,
        r"a\.mass = -1\.0: a mass must be",
    ),
    (
        lambda: carom.collide(carom.impacts(v_a=(1, 0, 0), r_b=(0.05715, 0, 0), mu_ball=2.0)),
        carom.CaromError,
        r"mu_ball = 2\.0",
    ),
    (
        lambda: carom.cushion(carom.cushion_impacts(v=(0, 1, 0), mu_cushion=3.0)),
        carom.CaromError,
        r"mu_cushion = 3\.0",
    ),
    (
        lambda: carom.cushion_trace(carom.cushion_impacts(v=(0, 1, 0), mu_cushion=3.0)),
        carom.CaromError,
        r"mu_cushion = 3\.0",
    ),
    (lambda: carom.cue(speed=np.array(np.nan)), carom.CaromError, r"cue\.speed = nan"),
    (lambda: carom.cue(ball_speed=-1.0), carom.CaromError, r"cue\.speed = -"),
    (lambda: shot(ball=3), carom.CaromError, r"cue\.ball = 3: it must be in play"),
    (
        lambda: shot(a=0.8, b=0.8),
        carom.CaromError,
        r"cue\.a, cue\.b = 0\.8, 0\.8: the tip misses the ball: .* must be below",
    ),
    (
        lambda: shot(a=0.3, b=0.4, miscue=0.5),
        carom.CaromError,
        r"cue\.a, cue\.b = 0\.3, 0\.4: .*miscue",
    ),
    (
        lambda: carom.struck(changed_cue(phi=1e308), RACK[0]["kind"]),
        carom.CaromError,
        r"cue\.phi = 1e\+308: ",
    ),
    (
        lambda: carom.struck(changed_cue(speed=np.nan), RACK[0]["kind"]),
        carom.CaromError,
        r"cue\.speed = nan: it must be 0",
    ),
    (
        lambda: carom.struck(carom.cue(a=0.8, b=0.8), RACK[0]["kind"]),
        carom.CaromError,
        r"cue\.a, cue\.b = 0\.8, 0\.8: ",
    ),
    (
        lambda: carom.struck(CUE, carom.balls([[0, 0]], mass=-1.0)["kind"][0]),
        carom.CaromError,
        r"kind\.mass = -1\.0: it must be above 0 and finite, in kg",
    ),
    (
        lambda: carom.simulate(TABLE, np.repeat(RACK, 4)),
        carom.CaromError,
        "balls = 40: the count of balls must be 1 to 32",
    ),
    (
        lambda: carom.simulate_batch(TABLE, np.repeat(RACK, 4)),
        carom.CaromError,
        "layouts = 40: the count of balls must be 1 to 32",
    ),
    (
        lambda: carom.place_ball(TABLE, RACK, 0, np.nan, 0.5),
        carom.CaromError,
        r"x, y = nan, 0\.5: a position must be finite",
    ),
    (
        lambda: carom.simulate(TABLE, unknown_motion(), CUE),
        carom.CaromError,
        r"balls\[1\]\.state\.v = \[ ?0\. nan ",
    ),
    (
        lambda: balls(r=[[0.5, 0.5], [-0.5, 0.5]]),
        carom.CaromError,
        r"balls\[1\]\.state\.r = \[-0\.5",
    ),
    (
        lambda: billiard(nose_height=0.07),
        carom.CaromError,
        r"balls\[0\]\.kind\.nose_height = 0\.07: it must be below 2 R",
    ),
    (
        lambda: carom.simulate(spoiled(), RACK, CUE),
        carom.CaromError,
        r"table\.rails\[3\]\.restitution = nan: it must be 0 to 1",
    ),
    (lambda: carom.collide(MASKED), TypeError, "impacts: a masked array would lose its mask"),
    (
        lambda: carom.cushion(np.ma.masked_array(WALL)),
        TypeError,
        "impacts: a masked array would lose its mask",
    ),
    (lambda: carom.mu_ball(MASKED), TypeError, "impacts: a masked array would lose its mask"),
    (
        lambda: carom.trace(MASKED[0]),
        TypeError,
        r"impact: a masked array would lose its mask; pass its compressed\(\) or filled\(\) values",
    ),
    (
        lambda: carom.collide(ROWS, out=(np.ma.zeros((4, 12)), np.zeros(4, np.int8))),
        TypeError,
        r"out\[0\]: a masked array would lose its mask; pass its compressed\(\) or filled\(\) values",
    ),
    (
        lambda: carom.impacts(
            v_a=(1, 0, 0), r_b=(1, 0, 0), restitution=np.ma.masked_array([0.9], mask=[True])
        ),
        TypeError,
        r"restitution: a masked array would lose its mask; pass its compressed\(\) or filled\(\) values",
    ),
    (
        lambda: carom.simulate_batch(TABLE, np.ma.masked_array(RACK)),
        TypeError,
        r"layouts: a masked array would lose its mask; pass its compressed\(\) or filled\(\) values",
    ),
    (
        lambda: carom.simulate(TABLE, RACK, CUE).positions(np.ma.masked_array([0.1], mask=[True])),
        TypeError,
        r"times: a masked array would lose its mask; pass its compressed\(\) or filled\(\) values",
    ),
    (
        lambda: carom.balls(np.ma.zeros((3, 2))),
        TypeError,
        r"r: a masked array would lose its mask; pass its compressed\(\) or filled\(\) values",
    ),
    (lambda: carom.balls([[0.5, 0.5]], conditions=("felt",)), ValueError, ".*fast_cloth"),
    (
        lambda: carom.balls([[0.5, 0.5]], game="snooker", conditions=("fast_cloth",)),
        ValueError,
        r"conditions: there are none for the game 'snooker', only for pool; pass restitution_cushion, mu_roll, \.\.\. instead",
    ),
    (
        lambda: carom.calibrate([4.7, 5.6]),
        ValueError,
        r"readings: the shape is \(2,\), but must be \(3,\): three banks",
    ),
    (
        lambda: carom.calibrate([4.7, 5.6, 8.5]),
        ValueError,
        r"readings: \[4\.7, 5\.6, 8\.5\] is out of range; each reading must be above 0 and below 8 diamonds",
    ),
    (
        lambda: carom.dtypes.plain(np.zeros((2, 26))),
        TypeError,
        r"records: an array of float64 has no fields; pass a structured array, such as the result of carom\.impacts\(\)",
    ),
    (lambda: carom.cite(cushion_model="none"), ValueError, "cushion_model"),
    (
        lambda: carom.cushion_impacts(v=(1, 2, 0), game="snooker", model="stronge"),
        ValueError,
        "model: there are no constants for 'stronge' in the game 'snooker'; use 'mathavan', 'han', 'euler' or 'smooth'",
    ),
    (lambda: carom.hessian(TABLE, ["cue.phi"]), TypeError, "shot: "),
    (
        lambda: carom.balls(r=[[np.nan, 0.8]]),
        ValueError,
        "r: nan is not finite$",
    ),
    (
        lambda: carom.balls(r=[[0.6, 0.8]], v=np.inf),
        ValueError,
        "v: inf is not finite$",
    ),
    (
        lambda: carom.racks.nineball(TABLE, seed=0.5),
        ValueError,
        r"seed: 0\.5 is not an integer from 0 to 18446744073709551615, or a numpy\.random\.Generator",
    ),
    (lambda: carom.cue(phi="90"), TypeError, "phi: '90' does not consist of real numbers"),
    (
        lambda: carom.cue(speed=[None, 1.0]),
        TypeError,
        r"speed: \[None, 1\.0\] does not consist of real numbers",
    ),
    (
        lambda: carom.simulate(TABLE, PAIR, CUE, t_final="1"),
        TypeError,
        "t_final: '1' is not a time in s or None",
    ),
    (
        lambda: carom.simulate(TABLE, PAIR, CUE, options={}),
        TypeError,
        r"options: \{\} is not a carom\.Options; pass carom\.Options\(world='pooltool'\), or single options as keywords: world='pooltool'",
    ),
    (
        lambda: carom.balls([[0.5, 0.5]], cushion_model="rubber"),
        ValueError,
        r"cushion_model: unknown value 'rubber'; use 'default', 'mathavan', 'stronge', 'han', 'mirror', 'euler' or",
    ),
    (
        lambda: BATCH.features,
        AttributeError,
        r"features: these shots were played without them; pass features=True to simulate_batch\(\)",
    ),
    (lambda: carom.tables.pool_9ft(corner=2.0), carom.CaromError, ".*it must be 0.01 to 1, in m"),
    (
        lambda: carom.tables.pool_9ft(width=0.17),
        carom.CaromError,
        ".*must be below .* with this width",
    ),
    (lambda: carom.tables.pool_9ft(side_hole=0.01), carom.CaromError, ".*can leave"),
    (
        lambda: carom.tables.pool_9ft(mouth=1.0),
        TypeError,
        r"carom\.tables\.pool_9ft\(\): unknown measure 'mouth'; use width, length, nose_height, cushion_depth, corner, corner_cut,",
    ),
    (
        lambda: carom.tables.polygon([(0, 0), (1, 0, 0.1, 2), (0, 1)]),
        ValueError,
        r"corners\[1\]: there are 4 values; pass \(x, y\) or \(x, y, mouth\)",
    ),
]
REFUSALS += [
    (call, ValueError, f"{name}: {wrong!r} is not an integer from 0 to 1")
    for wrong in (2, -1, "yes", None)
    for name, call in (
        ("plain", lambda wrong=wrong: carom.collide(GOOD, plain=wrong)),
        ("plain", lambda wrong=wrong: carom.cushion(WALL, plain=wrong)),
        ("fast", lambda wrong=wrong: carom.simulate(TABLE, RACK, CUE, fast=wrong)),
    )
]
REFUSALS += [
    (
        lambda read=read, wrong=wrong: read([0.1, wrong]),
        ValueError,
        f"times: {wrong} is negative or not finite",
    )
    for read, times in (
        (SHOT.positions, (np.nan, np.inf, -5.0)),
        (SHOT.states, (np.nan, np.inf, -5.0)),
        (SHOT.orientations, (np.nan, np.inf, -5.0)),
        (BATCH.positions, (np.nan, -1.0)),
    )
    for wrong in times
]
REFUSALS += [
    (lambda play=play, ball=ball: play(TABLE, RACK, CUE, first_of=ball), ValueError, message)
    for play in (carom.simulate, carom.simulate_batch)
    for ball, message in (
        (0, "first_of: ball 0 is the cue ball"),
        (10, "first_of: there is no ball 10; the layout has balls 0 to 9"),
    )
]
REFUSALS += [
    (lambda name=name: carom.tangents(shot(), [name]), ValueError, "wrt: ")
    for name in (
        "phi",
        "cue.mu",
        "balls[17].r",
        "balls[0].r[3]",
        "kind",
        "balls[0].kind.radius",
        "cue.phi[0]",
    )
]
REFUSALS += [
    (
        lambda dtype=dtype: carom.dtypes.plain(np.zeros(2, dtype)),
        TypeError,
        f"records: .*{field}.* integers.* by their names",
    )
    for dtype, field in (
        (carom.dtypes.ball_state, "label"),
        (carom.dtypes.shot_ball, r"state\.label"),
        (carom.dtypes.event, r"type and \d+ more"),
        (carom.dtypes.trace_point, "phase"),
        (carom.dtypes.cushion_point, "phase"),
        (carom.dtypes.cue, "ball"),
        (carom.dtypes.rail, "side"),
        (carom.dtypes.table, ""),
        (carom.dtypes.shot, ""),
    )
]


@pytest.mark.parametrize(("call", "error", "message"), by_line(REFUSALS))
def test_message(call, error, message):
    refused(call, error, message)


@pytest.mark.parametrize(("call", "message"), list(numbers_in_error()))
def test_number_in_error(call, message):
    refused(call, carom.CaromError, message)


def test_what_is_wrong_is_refused_when_it_is_made():
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


# A call, arguments that it takes, and the arguments in whose place it gets values of another kind.
ARGUMENTS = [
    (
        carom.cue,
        {},
        [
            "speed",
            "phi",
            "theta",
            "a",
            "b",
            "ball",
            "game",
            "mass",
            "end_mass",
            "tip_radius",
            "miscue",
            "tip_time",
            "tip_restitution",
            "ball_speed",
            "tip",
            "follow",
        ],
    ),
    (carom.balls, {"r": [[0.6, 0.8]]}, ["r", "v", "w", "game", "mass", "mu_slide", "nose_height"]),
    (
        carom.simulate,
        {"table": TABLE, "balls": PAIR},
        [
            "table",
            "balls",
            "options",
            "world",
            "ball_model",
            "cushion_model",
            "friction",
            "space",
            "simultaneous",
            "cluster_steps",
            "steps",
            "events_most",
            "plain",
            "t_final",
            "stop_at",
            "first_of",
        ],
    ),
    (
        carom.simulate_batch,
        {"table": TABLE, "layouts": PAIR},
        [
            "table",
            "layouts",
            "room",
            "kinds",
            "records",
            "threads",
            "out",
            "options",
            "t_final",
            "stop_at",
        ],
    ),
    (carom.resume, {"shot": STOPPED}, ["shot", "t_final", "stop_at"]),
    (carom.cite, {}, ["options", "world"]),
    (carom.tangents, {"shot": SHOT, "wrt": ["cue.phi"]}, ["shot", "wrt", "times", "threads"]),
    (
        carom.jacobian,
        {"table": TABLE, "layouts": PAIR, "cues": CUE, "wrt": ["cue.phi"]},
        ["table", "layouts", "wrt", "of", "times", "room", "threads", "options"],
    ),
    (
        carom.place_ball,
        {"table": TABLE, "balls": PAIR, "ball": 0, "x": 0.5, "y": 0.5},
        ["table", "balls", "ball", "x", "y"],
    ),
    (
        carom.by_number,
        {"balls": PAIR, "ids": ["cue", 1], "rules": "nineball"},
        ["balls", "ids", "rules", "cue"],
    ),
    (carom.struck, {"cue": CUE, "kind": PAIR[0]["kind"]}, ["cue", "kind"]),
    (
        carom.impacts,
        {"v_a": (1.0, 0.0, 0.0), "r_b": (0.05715, 0.0, 0.0)},
        ["v_a", "r_b", "w_a", "radius", "mass", "mass_b", "mu_ball"],
    ),
    (
        carom.collide,
        {"impacts": GOOD},
        ["impacts", "solver", "slip", "steps", "threads", "plain", "out"],
    ),
    (carom.mu_ball, {"impacts": GOOD}, ["impacts", "law"]),
    (carom.trace, {"impact": GOOD}, ["impact", "points", "solver"]),
    (
        carom.cushion_impacts,
        {"v": (0.0, 1.0, 0.0)},
        ["v", "w", "normal", "height", "radius", "jaw_radius"],
    ),
    (
        carom.cushion,
        {"impacts": WALL},
        [
            "impacts",
            "model",
            "convention",
            "law",
            "steps",
            "least_step",
            "omega_ratio",
            "plain",
            "threads",
            "out",
        ],
    ),
    (carom.cushion_trace, {"impact": WALL}, ["impact", "points", "model", "least_step"]),
    (carom.racks.nineball, {"table": TABLE}, ["table", "gap", "seed"]),
    (
        carom.tables.polygon,
        {"corners": CORNERS},
        ["corners", "nose_height", "jaw_radius", "ball_radius"],
    ),
    (
        carom.Table,
        {"width": 1.0, "length": 2.0, "rails": TABLE.rails},
        ["width", "length", "rails", "jaws", "pockets", "ball_radius", "rail_width", "pocket_back"],
    ),
    (SHOT.positions, {"times": 0.1}, ["times"]),
    (SHOT.animate, {}, ["speed"]),
    (BATCH.positions, {"times": 0.1}, ["times", "threads"]),
]


@pytest.mark.parametrize(("function", "good", "names"), ARGUMENTS, ids=name_of)
def test_a_value_of_another_kind_is_refused_by_the_name_of_its_argument(function, good, names):
    refused_by_name(function, good, names)


def test_a_value_of_another_kind_in_a_data_frame():
    pytest.importorskip("pandas")
    refused_by_name(BATCH.to_dataframe, {}, ["dims"])


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
        "snooker, by its number": carom.tables.polygon(CORNERS, ball_radius=0.02625),
    }
    for made_for, table in tables.items():
        for game in ("pool", "snooker", "billiard", "blackball", "pyramid"):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                play(table, carom.balls([[0.5, 0.5]], game=game))
            doubt = f"balls: these are {game} balls, .* made for {made_for.partition(',')[0]} balls"
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
                f"there are none for it in the game {game!r}" in text for text in caught
            )
            # what is another shot, or has none of its own, is told
            assert (
                len(message)
                == (none or doubt_of_default.tobytes() != own_ball.tobytes())
                == len(played(model, "default", carom.simulate_batch)[1])
            )
            assert model not in ("default", "smooth") or (not message and not none)
        assert len(played("han", "mathavan")[1]) == 1


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
    with pytest.warns(UserWarning, match="looks like radians, but the unit is degrees") as caught:
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
