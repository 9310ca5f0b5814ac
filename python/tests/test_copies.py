"""Every object of the package has copies of all kinds, which its calls take for the original."""

import copy
import pickle

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


# A name, what makes an object, and what a call reads of it.
OBJECTS = {
    "impact": (lambda: HIT, lambda it: carom.collide(it).motion),
    "cushion impact": (lambda: WALL, lambda it: carom.cushion(it).motion),
    "trace": (lambda: carom.trace(HIT, 5), lambda it: it),
    "cushion trace": (lambda: carom.cushion_trace(WALL, 5), lambda it: it),
    "cue": (lambda: CUE, lambda it: carom.simulate(TABLE, RACK, it).final),
    "balls": (lambda: RACK, lambda it: carom.simulate(TABLE, it, CUE).final),
    "kinds": (
        lambda: RACK["kind"],
        lambda it: carom.simulate_batch(TABLE, RACK["state"], CUE, kinds=it).final,
    ),
    "states": (
        lambda: RACK["state"],
        lambda it: carom.simulate_batch(TABLE, it, CUE, kinds=RACK["kind"]).final,
    ),
    "table": (lambda: TABLE, lambda it: carom.simulate(it, RACK, CUE).final),
    "record of a table": (
        lambda: TABLE.record,
        lambda it: carom.simulate(carom.Table.from_record(it), RACK, CUE).final,
    ),
    "parts of a table": (
        lambda: (TABLE.rails, TABLE.jaws, TABLE.pockets),
        lambda it: carom.simulate(
            carom.Table(1.27, 2.54, rails=it[0], jaws=it[1], pockets=it[2]), TWO, STROKE
        ).final,
    ),
    "options": (
        lambda: carom.Options(cushion_model="stronge"),
        lambda it: carom.simulate(TABLE, OF_STRONGE, STROKE, options=it).final,
    ),
    "shot": (
        lambda: two(t_final=1.0),
        lambda it: (
            carom.resume(it).final,
            carom.tangents(it, ["cue.phi"]).states,
            it.positions(0.5),
        ),
    ),
    "shots": (
        lambda: carom.simulate_batch(
            TABLE, TWO, STROKE[np.newaxis], features=True, room=64, records="brief"
        ),
        lambda it: (it.events, it.features.contact, it.positions(0.5)),
    ),
    "shot of a batch": (
        lambda: carom.simulate_batch(TABLE, TWO, STROKE[np.newaxis], room=64)[0],
        lambda it: carom.tangents(it, ["cue.phi"]).states,
    ),
    "tangents": (lambda: carom.tangents(two(), ["cue.phi"]), lambda it: it.states),
    "match": (match, lambda it: it.end()),
    "player": (
        lambda: carom.player(),
        lambda it: (planned(player=it, opponent=it), carom.with_errors(CUE, it, 1)),
    ),
    "choices": (lambda: planned(), lambda it: it),
    "ruling": (
        lambda: RULING,
        lambda it: (
            carom.referee(TABLE, it.balls, CUE, rules="nineball", state=it.state).balls,
            it.facts.foul({1}),
        ),
    ),
    "position": (lambda: POOL.begin(1), lambda it: POOL.play(it, np.zeros(6))[0].balls),
    "game": (lambda: POOL, lambda it: it.play(it.begin(1), np.zeros(6))[0].balls),
    "potting": (
        lambda: carom.potting.Potting(noise=(0.1, 0.1, 0.1)),
        lambda it: it.cues(np.zeros(4), np.ones((), np.uint64)),
    ),
    "recordings": (lambda: MADE.recordings, lambda it: fitted(it).strikes),
    "fit": (lambda: fitted(), lambda it: (it.positions(0, 0.5), it.kicks().rmse)),
}


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
        return bits(read(it))

    original = make()
    expected = use(make())
    for kind, copied in {**COPIES, **(ARRAYS if isinstance(original, np.ndarray) else {})}.items():
        dirty = [np.full(size, 1.5) for size in (4, 12, 26, 60) for _ in range(500)]
        del dirty
        assert use(copied(original)) == expected, kind
