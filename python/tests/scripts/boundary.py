"""The package carom with arbitrary arguments, drawn from bytes: boundary.py CALLS [SEED].

Arrays are of any dtype, shape, order, stride and alignment, read-only, subclasses, masked, objects;
numbers are huge, negative, NaN or none; anything may be None or a string. A call must return, or
raise TypeError, ValueError (and so CaromError) or, where an array of the size asked for has no
room, MemoryError, without a warning of NumPy's. What it reads stays as it was, and it writes
nothing beside the arrays it is given. Crashes are for the process to show, and writes beside other
arrays for the sanitizer of addresses: tools/fuzz builds the extension modules with it.

Each input has a seed of its own; every hundredth is printed, so a failure is among the hundred from
the last one on. With Atheris, and `boundary.py --atheris ARGUMENTS...`, libFuzzer chooses the bytes
instead.
"""

import os
import random
import sys
import typing
import warnings

import numpy as np

if __name__ == "__main__" and sys.argv[1:2] == ["--atheris"]:
    import atheris

    with atheris.instrument_imports(include=["carom"]):
        import carom
else:
    import carom
from carom import _objects, _shot_options, cushions

ALLOWED = (TypeError, ValueError, MemoryError)
OF_OBJECTS = (
    *ALLOWED,
    IndexError,
    AttributeError,
    OverflowError,
)  # carom._objects is for carom.pooltool alone


class Draws:
    """Choices made of bytes; bytes that are missing count as 0."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def choice(self, n):
        self.at += 1
        return (self.data[self.at - 1] if self.at <= len(self.data) else 0) % n

    def of(self, *things):
        return things[self.choice(len(things))]

    def rarely(self, n=8):
        return self.choice(n) == n - 1

    def number(self):
        if self.choice(4):
            return self.choice(256) / 64.0
        return self.of(
            0.0, -0.0, 1.0, -1.0, 0.5, np.nan, np.inf, -np.inf, 1e308, 5e-324, -1e9, 1e-9
        )


class Odd:
    """What looks like a number and an array, and is neither."""

    def __index__(self):
        raise ValueError("no index")

    def __float__(self):
        return "no float"

    def __array__(self, *arguments, **options):
        return np.array(["no", "array"], object)


class Sub(np.ndarray):
    """An array of a class of its own, which tells nothing true of itself."""

    __array_priority__ = 100

    def copy(self, *arguments, **options):
        return None


class Plain:
    """For carom._objects."""


def junk(draws):
    return draws.of(
        None,
        "text",
        b"",
        "",
        object(),
        {},
        [],
        (),
        [[1.0], [2.0, 3.0]],
        np.nan,
        np.inf,
        10**30,
        -(10**30),
        2**31,
        2**63,
        -1,
        0,
        7,
        True,
        1 + 2j,
        len,
        int,
        Odd(),
        np.float32(1.5),
        np.array(3.0),
        np.zeros(3),
        np.array(None),
        np.zeros((0, 26)),
        np.array(["a"]),
        np.datetime64("NaT"),
        Plain(),
        [None],
        "exact",
        "carom",
        ("contact", 3),
        range(3),
        iter([1]),
        memoryview(b"12345678"),
        slice(3),
    )


def guarded(shape, dtype, draws):
    """An array in the middle of a buffer of bytes 0x55, and a function that tells whether what is
    around it is still so.
    """
    dtype = np.dtype(dtype)
    size, before = (
        int(np.prod(shape)) * dtype.itemsize,
        64 + (draws.choice(8) if draws.rarely() else 0),
    )
    buffer = np.full(before + size + 64, 0x55, np.uint8)
    array = buffer[before : before + size].view(dtype).reshape(shape)
    return array, lambda: bool(
        (buffer[:before] == 0x55).all() and (buffer[before + size :] == 0x55).all()
    )


def spoil(array, draws):  # noqa: C901 - a table of what may be wrong with an array
    """The array, or one like it that does not fit."""
    for _ in range(draws.choice(3)):
        if type(array) is not np.ndarray:
            break
        how = draws.choice(20)
        if how == 0:
            array = (
                array.astype(draws.of("f4", "i8", "c16", "O", ">f8", "f2", "?", "u1", "g"))
                if array.dtype.names is None
                else array.astype("O")
            )
        elif how == 1:
            array = np.asfortranarray(array)
        elif how == 2 and array.ndim:
            array = array[::-1]
        elif how == 3 and array.ndim:
            array = array[:: draws.of(2, 3)]
        elif how == 4 and array.ndim:
            array = array[..., :-1]
        elif how == 5:
            array = array[np.newaxis]
        elif how == 6 and array.ndim:
            array = array[:0]
        elif how == 7:
            array = np.broadcast_to(array, (2, *array.shape))
        elif how == 8 and not array.dtype.hasobject:  # not aligned
            array = np.array(array)
            bytes_of = np.zeros(array.nbytes + 1, np.uint8)[1:]
            bytes_of[:] = array.reshape(-1).view(np.uint8)
            array = bytes_of.view(array.dtype).reshape(array.shape)
        elif how == 9:
            array = array.view()
            array.flags.writeable = False
        elif how == 10:
            array = array.view(Sub)
        elif how == 11 and array.size:
            array = array.copy()
            numbers = (
                array.reshape(-1).view(np.uint8).view(np.float64)
                if array.nbytes % 8 == 0 and not array.dtype.hasobject
                else np.zeros(1)
            )
            numbers[(256 * draws.choice(256) + draws.choice(256)) % numbers.size] = draws.number()
        elif how == 12:
            array = np.ma.masked_array(array)
        elif how == 13:
            array = array.tolist()
        elif how == 14 and array.dtype.names is not None:
            array = array.view(np.uint8) if array.flags.c_contiguous and array.ndim else array
        elif how == 15:
            array = array.T
        elif how == 16 and array.dtype.names is None and array.size and array.ndim:
            array = memoryview(np.ascontiguousarray(array)) if array.dtype.kind in "fiu" else array
        elif how == 17:
            array = array.reshape(-1)
        elif how == 18:
            array = np.zeros((0, *array.shape), array.dtype)
        elif how == 19:
            array = junk(draws)
    return array


def given(draws, **arguments):
    """Arguments, of which some are spoilt or something else; options may be left out."""
    found = {}
    for name, value in arguments.items():
        if isinstance(value, np.ndarray):
            value = spoil(value, draws)
        found[name] = junk(draws) if draws.rarely(16) else value
    return found


# ---- Calls
# -------------------------------------------------------------------------------------------------------------

TABLES = [carom.tables.pool_9ft(), carom.tables.threecushion()]
IMPACTS = carom.impacts(
    v_a=np.random.default_rng(1).uniform(-3, 3, (70, 3)) * (1, 1, 0), r_b=(0.05715, 0.0, 0.0)
)
CUSHIONS = carom.cushion_impacts(v=np.random.default_rng(2).uniform(-3, 3, (70, 3)) * (1, 1, 0))
RACKS = [carom.racks.nineball(TABLES[0]), carom.racks.threecushion(TABLES[1])]
SHOTS = [
    carom.simulate(TABLES[1], RACKS[1], carom.cue(speed=3.0, phi=80.0), t_final=2.0),
    carom.simulate(TABLES[0], RACKS[0], carom.cue(speed=6.0), events_most=10000),
]
BATCH = carom.simulate_batch(TABLES[1], RACKS[1], carom.cue(speed=[1.0, 2.0]), room=60)


def count(draws):
    return (
        draws.of(
            0,
            1,
            2,
            5,
            60,
            -1,
            2**31 - 1,
            2**31,
            2**63,
            -(2**31) - 1,
            1.5,
            np.int8(3),
            True,
            None,
            "3",
        )
        if draws.rarely(4)
        else draws.choice(5)
    )


def steps_of(draws):
    """Of Euler's method: none that would take for ever."""
    steps = count(draws)
    return 2**31 if steps == 2**31 - 1 else steps


def rows(draws, records):
    part = records[: draws.choice(len(records) + 1)]
    part = part[0] if draws.rarely() and len(part) else part
    part = np.asarray(part)
    return carom.dtypes.plain(part) if draws.choice(2) else part


def of_impacts(draws, function, records, width, options):
    array = rows(draws, records)
    arguments = given(
        draws, impacts=array, threads=draws.of(0, 0, 0, 1, 2, -1, count(draws)), **options
    )
    intact = lambda: True  # noqa: E731
    if draws.choice(2) and isinstance(arguments["impacts"], np.ndarray):
        shape = array.shape if array.dtype.names else array.shape[:-1]
        result = {12: carom.dtypes.result, 6: carom.dtypes.motion}[width]
        motion, around = guarded(
            shape if array.dtype.names else (*shape, width),
            result if array.dtype.names else "f8",
            draws,
        )
        status, beside = guarded(shape, "i1", draws)
        intact = lambda: around() and beside()  # noqa: E731
        if draws.rarely():
            motion = array if draws.choice(2) else spoil(motion, draws)
        if draws.rarely():
            status = spoil(status, draws) if draws.choice(2) else motion
        arguments["out"] = junk(draws) if draws.rarely(16) else (motion, status)
    return function, arguments, intact


def models(draws):
    options = {
        "world": draws.of("carom", "carom", "pooltool"),
        "ball_model": draws.of("default", "exact", "euler", "inelastic", "mirror"),
        "cushion_model": draws.of(*typing.get_args(_shot_options.ShotCushion)),
        "space": draws.of("3d", "flat"),
        "friction": draws.of("alciatore", "constant"),
        "steps": draws.of(0, 10, steps_of(draws)),
        "events_most": draws.of(100, 20, count(draws)),
        "t_final": draws.of(None, 1.0, draws.number()),
        "stop_at": draws.of((), "contact", ("rail", "pocket"), "nothing"),
    }
    return {name: value for name, value in options.items() if draws.rarely(4)}


def shots_of(draws, function):
    table, rack = (TABLES[0], RACKS[0]) if draws.choice(2) else (TABLES[1], RACKS[1])
    cues = carom.cue(speed=np.linspace(1.0, 5.0, 1 + draws.choice(4)), phi=draws.number() * 90.0)
    if function is carom.simulate:
        return function, given(draws, table=table, balls=rack, cue=cues[0], **models(draws)), None
    layouts = np.broadcast_to(rack, (len(cues), len(rack))) if draws.choice(2) else rack
    extra = {"room": draws.of(0, 5, 60, count(draws))}
    if isinstance(extra["room"], int) and extra["room"] > 10**6:
        extra["room"] = 2**62  # what has no room, instead of all memory
    if function is carom.jacobian:
        extra |= {
            "wrt": draws.of(
                ["cue.phi"],
                ["kind.mu_slide", "balls[1].r"],
                [],
                "cue.phi",
                ["balls[99].v"],
                junk(draws),
            )
        }
        extra |= {
            "of": draws.of("final.r", "at.v", "time", "reach", "nothing"),
            "times": draws.of(None, [0.1, 0.2], [draws.number()]),
        }
    else:
        extra |= {
            "records": draws.of("full", "brief", "none"),
            "features": draws.of(False, True),
            "threads": draws.of(0, 1, 2, count(draws)),
        }
    return (
        function,
        given(draws, table=table, layouts=layouts, cues=cues, **extra, **models(draws)),
        None,
    )


def look(draws):
    """At a shot, or at a batch that may have been sliced."""
    times = np.array([draws.number() for _ in range(draws.choice(4))]).reshape(
        draws.of(-1, (-1, 1))
    )
    if draws.choice(2):
        shot = draws.of(*SHOTS)
        return (
            draws.of(shot.states, shot.positions, shot.orientations),
            given(draws, times=times),
            None,
        )
    shots = carom.simulate_batch(
        TABLES[1],
        RACKS[1],
        carom.cue(speed=[[1.0, 2.0], [3.0, 4.0]]),
        room=draws.of(0, 3, 100),
        events_most=50,
    )
    if draws.rarely():
        shots = shots[
            draws.of(
                slice(None, None, -1),
                (slice(None), 0),
                np.array([1, 0]),
                np.array([[True, False], [True, True]]),
            )
        ]
    return (
        draws.of(shots.states, shots.positions),
        given(draws, times=times, threads=draws.of(0, 2, count(draws))),
        None,
    )


def objects(draws):
    """carom._objects, which only carom.pooltool calls."""
    n = draws.choice(4)
    names, columns = (
        tuple("abc"[: draws.choice(4)]),
        tuple(draws.of([1, 2, 3], [1] * n, 7, None) for _ in range(draws.choice(4))),
    )
    kind = draws.of(
        Plain, Plain, Plain, int, dict, type, Odd, np.ndarray, Sub, Exception, junk(draws)
    )
    if draws.choice(2):
        n = draws.of(n, n, -1, -(2**63), 2**62, junk(draws))
        n = (
            2**62 if isinstance(n, int) and n > 10**6 else n
        )  # what has no room, instead of all memory
        return _objects.make, (kind, n, spoilt(draws, names), spoilt(draws, columns)), None
    return (
        _objects.turn,
        (
            spoilt(draws, [Odd(), Plain(), Odd()][:n]),
            kind,
            spoilt(draws, names),
            spoilt(draws, columns),
        ),
        None,
    )


def spoilt(draws, value):
    return junk(draws) if draws.rarely(16) else value


def call_of(draws):
    """What is called, its arguments, and whether what is around an output is intact."""
    which = draws.choice(16)
    steps = {"steps": draws.of(0, 20, steps_of(draws))} if draws.choice(2) else {}
    balls = {
        "solver": draws.of("exact", "euler", "none"),
        "slip": draws.of("paper", "pooltool"),
        **steps,
    }
    noses = {
        "model": draws.of(*typing.get_args(cushions.CushionModel)),
        "law": draws.of("constant", "han"),
        **steps,
    }
    points = draws.of(2, 5, -1, 0, 2**62, count(draws))
    points = 2**62 if isinstance(points, int) and points > 10**6 else points
    if which in (0, 1):
        return of_impacts(draws, carom.collide, IMPACTS, 12, balls)
    if which in (2, 3):
        return of_impacts(
            draws,
            carom.cushion,
            CUSHIONS,
            6,
            {**noses, "omega_ratio": draws.of(0.0, 1.5, draws.number())},
        )
    if which == 4:
        return (
            carom.mu_ball,
            given(
                draws,
                impacts=rows(draws, IMPACTS),
                law=draws.of(None, (0.1, 0.1, 1.0), (draws.number(),) * draws.choice(5)),
            ),
            None,
        )
    if which == 5:
        return (
            carom.trace,
            given(draws, impact=np.asarray(IMPACTS[0]), points=points, **balls),
            None,
        )
    if which == 6:
        return (
            carom.cushion_trace,
            given(draws, impact=np.asarray(CUSHIONS[0]), points=points, **noses),
            None,
        )
    if which in (7, 8):
        return shots_of(draws, carom.simulate)
    if which in (9, 10):
        return shots_of(draws, draws.of(carom.simulate_batch, carom.simulate_batch, carom.jacobian))
    if which == 11:
        return look(draws)
    if which == 12:
        shot = draws.of(*SHOTS)
        if draws.choice(2):
            return (
                carom.resume,
                given(
                    draws,
                    shot=shot,
                    t_final=draws.of(None, 3.0, draws.number()),
                    stop_at=draws.of((), "rail"),
                ),
                None,
            )
        wrt = draws.of(["cue.phi", "kind.mass"], ["balls[0].v[1]"] * 70, [], junk(draws))
        shot, cue = draws.of(
            (shot, carom.cue(speed=3.0, phi=80.0)), (BATCH, None), (BATCH[1], None)
        )
        return (
            carom.tangents,
            given(
                draws,
                shot=shot,
                cue=cue,
                wrt=wrt,
                times=np.array([0.5]),
                threads=draws.of(0, 0, 2, count(draws)),
            ),
            None,
        )
    if which == 13:
        return objects(draws)
    table = draws.of(*TABLES)
    if which == 14:
        if draws.choice(2):
            return (
                carom.place_ball,
                given(
                    draws,
                    table=table,
                    balls=RACKS[0],
                    ball=count(draws),
                    x=draws.number(),
                    y=draws.number(),
                ),
                None,
            )
        parts = {
            "rails": table.rails,
            "jaws": table.jaws,
            "pockets": table.pockets,
            "ball_radius": draws.number(),
        }
        return carom.Table, given(draws, width=draws.number(), length=draws.number(), **parts), None
    if draws.choice(2):
        return (
            carom.struck,
            given(draws, cue=carom.cue(speed=draws.number()), kind=RACKS[0][0]["kind"]),
            None,
        )
    if draws.choice(2):
        return (
            draws.of(carom.racks.snooker, carom.racks.tenball),
            given(draws, table=table, gap=draws.number() * 1e-3, seed=count(draws)),
            None,
        )
    return table.check, given(draws, radius=draws.of(0.03, draws.number())), None


def one(data):
    """One call. Raises AssertionError, or what is not allowed."""
    draws = Draws(data)
    try:
        function, arguments, intact = call_of(draws)
    except (*ALLOWED, OverflowError):  # NumPy has no such array
        return
    values = list(arguments.values()) if isinstance(arguments, dict) else []
    before = [
        value.tobytes() if isinstance(value, np.ndarray) and value.dtype != object else None
        for value in values
    ]
    allowed = OF_OBJECTS if function in (_objects.make, _objects.turn) else ALLOWED
    try:
        with warnings.catch_warnings():
            # numpy's own: carom says itself what is wrong
            warnings.simplefilter("error", RuntimeWarning)
            function(**arguments) if isinstance(arguments, dict) else function(*arguments)
    except allowed:
        pass
    except Exception as wrong:
        raise AssertionError(
            f"{type(wrong).__name__} by {function} of {arguments!r}"[:3000]
        ) from wrong
    assert intact is None or intact(), f"{function} writes beside its outputs: {arguments!r}"
    for value, bytes_of in zip(values, before):
        assert bytes_of is None or value.tobytes() == bytes_of, (
            f"{function} writes to what it reads: {arguments!r}"
        )


def main():
    warnings.simplefilter("ignore")
    if sys.argv[1:2] == ["--atheris"]:
        atheris.Setup([sys.argv[0], *sys.argv[2:]], one)
        atheris.Fuzz()
    seed = int(sys.argv[2] if len(sys.argv) > 2 else os.environ.get("CAROM_TEST_SEED", "20141"))
    for call in range(int(sys.argv[1])):
        if call % 100 == 0:
            print(f"seed {seed + call}", flush=True)
        one(random.Random(seed + call).randbytes(200))


main()
