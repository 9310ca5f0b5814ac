"""Every object of the package has copies of all kinds, which its calls take for the original."""

import copy
import pickle
import re
from pathlib import Path

import numpy as np
import pytest

import carom
import carom.fit
import carom.pool
import carom.potting
import carom.record
import carom.tracks
from carom._carom import ffi
from carom.games import potting

TABLE, LONE = carom.tables.pool_9ft(), carom.tables.threecushion()
RACK, CUE = carom.racks.nineball(TABLE), carom.cue(speed=8.0)
PLACES = [[0.6, 0.8], [0.75, 1.6]]
TWO = carom.balls(PLACES)
OF_STRONGE = carom.balls(PLACES, cushion_model="stronge")
HIT, WALL = (
    carom.impacts(v_a=(1.0, 0.0, 0.0), r_b=(0.05715, 0.0, 0.0)),
    carom.cushion_impacts(v=(0.0, 1.0, 0.0)),
)
MADE = carom.tracks.synthetic(2, seed=1)
SIZE, RADIUS = (2.84, 1.42), 0.03075
POOL = carom.pool.Pool()
RULING = carom.referee(TABLE, RACK, CUE, rules="nineball")
COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda it: pickle.loads(pickle.dumps(it)),
}
ARRAYS = {
    "array": np.array,
    "fields": lambda it: it[list(it.dtype.names)],
    "reshaped": lambda it: it[..., np.newaxis][..., 0],
}
STROKE = carom.cue(speed=1.5, phi=80.8)


def two(**how):
    return carom.simulate(TABLE, TWO, STROKE, **how)


def match():
    match = carom.Match("potting", TABLE, balls=TWO)
    match.stroke(STROKE)
    return match


def fitted(recordings=MADE.recordings):
    return carom.fit.fit(recordings, SIZE, RADIUS, constants=MADE.constants, free="none")


def planned(**how):
    return carom.plan(TABLE, TWO, rules="potting", shots=100, best=1, **how)


# A name, what makes an object, and below it what a call reads of `it`.
ROWS = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8")
OBJECTS = {name: rest for name, *rest in re.findall(r"^(\w.*?): (.*)\n +(.*)$", ROWS, re.M)}
assert 2 * len(OBJECTS) == len(ROWS.splitlines())


def bits(value):
    """Of what a call gives."""
    return (
        tuple(map(bits, value))
        if isinstance(value, tuple)
        else value.tobytes()
        if isinstance(value, np.ndarray)
        else value
    )


def holes(dtype, where):
    if dtype.base.names is None:
        return []
    fields = [(name, *dtype.base.fields[name][:2]) for name in dtype.base.names]
    covered = sum(field.itemsize for _, field, _ in fields) == dtype.base.itemsize
    return [inner for name, field, _ in fields for inner in holes(field, f"{where}.{name}")] + (
        [] if covered else [where]
    )


def test_no_dtype_has_a_hole():
    """NumPy copies fields, and leaves what is between them as the memory was."""
    dtypes = {
        f"{module.__name__}.{name}": value
        for module in (carom.dtypes, carom.tracks, carom.fit)
        for name, value in vars(module).items()
        if isinstance(value, np.dtype)
    }
    of_c = {
        name: ffi.sizeof(f"carom_{name}")
        for name in vars(carom.dtypes)
        if isinstance(getattr(carom.dtypes, name), np.dtype)
    }
    of_c["python_stroke"], dtypes["carom.dtypes.python_stroke"] = (
        ffi.sizeof("carom_python_stroke"),
        potting._STROKE,
    )
    assert {name: dtypes[f"carom.dtypes.{name}"].itemsize for name in of_c} == of_c
    assert (
        len(dtypes) > 20
        and [hole for name, dtype in dtypes.items() for hole in holes(dtype, name)] == []
    )


@pytest.mark.parametrize("name", OBJECTS)
def test_calls_take_copies(name):
    make, read = OBJECTS[name]

    def use(it):
        return bits(eval(read, {**globals(), "it": it}))

    original = eval(make, globals())
    expected = use(eval(make, globals()))
    for kind, copied in {**COPIES, **(ARRAYS if isinstance(original, np.ndarray) else {})}.items():
        dirty = [np.full(size, 1.5) for size in (4, 12, 26, 60) for _ in range(500)]
        del dirty
        assert use(copied(original)) == expected, kind
