"""What all calls share: bits, which arrays they take, errors that travel between processes, Ctrl-C."""

import concurrent.futures
import functools
import importlib
import inspect
import json
import multiprocessing
import os
import pickle
import pkgutil
import pydoc
import re
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import run_python, same_bits
from numpy.testing import assert_array_equal

import carom

GOOD = carom.impacts(v_a=(1.0, 0.0, 0.0), r_b=(0.05715, 0.0, 0.0))
BAD = carom.impacts(v_a=(1.0, 0.0, 0.0), r_b=(0.05715, 0.0, 0.0), mass=-1.0)


# ---- Bits
# --------------------------------------------------------------------------------------------------------------

PLAYS = """
import json
import sys

import numpy as np
import carom

plain, fast = json.loads(sys.argv[1])
angles = np.linspace(-1.2, 1.2, 101)
pairs = carom.impacts(v_a=(1.5, 0, 0), w_a=(3.0, 10.0, 5.0), r_b=np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=-1))
into = carom.cushion_impacts(v=np.stack([np.sin(angles), np.cos(angles), 0 * angles], axis=-1), w=(3.0, 10.0, 5.0))
table = carom.tables.pool_9ft()
rack, cues = carom.racks.nineball(table), carom.cue(speed=8.0, phi=np.linspace(89.0, 91.0, 5))
bits = {
    "batch": carom.collide(pairs, **plain).motion,
    "one": carom.collide(pairs[3], **plain).motion,
    "fast": carom.collide(pairs, solver="fast", **plain).motion,
    "trace": carom.trace(pairs[3], 5, **plain)["state"],
    "cushions": carom.cushion(into, **plain).motion,
    "cushion trace": carom.cushion_trace(into[3], 5, **plain)["state"],
    "shot": carom.simulate(table, rack, cues[0], **fast).final,
    "shots": carom.simulate_batch(table, rack, cues, **fast).final,
    "later": carom.resume(carom.simulate(table, rack, cues[0], t_final=1.0, **fast)).final,
}
bits = {name: array.tobytes().hex() for name, array in bits.items()}
"""


def test_plain_has_the_bits_of_a_process_limited_to_plain():
    def bits(plain, isa):
        program = PLAYS + "print(json.dumps(bits))"
        return json.loads(run_python("-c", program, json.dumps(plain), CAROM_ISA=isa).stdout)

    limited, request = (
        bits(({}, {"fast": True}), "plain"),
        bits(({"plain": True}, {}), None),
    )
    assert request == limited and limited["shot"] == limited["shots"][: len(limited["shot"])]
    # Collisions by the solver exact, and shots whose cushion is the smooth one, have one set of bits
    # anyway; the solver fast and a cushion alone have other bits with wide registers.
    if carom.isa_in_force() not in ("plain", "sse2"):
        unlimited = bits(({}, {"fast": True}), None)
        assert {name for name in limited if unlimited[name] != limited[name]} == {
            "fast",
            "cushions",
            "cushion trace",
        }


# ---- Errors
# ------------------------------------------------------------------------------------------------------------


def stopped():
    """The error of a shot that a bound stopped."""
    table = carom.tables.pool_9ft()
    with pytest.raises(carom.CaromError) as caught:
        carom.simulate(table, carom.racks.nineball(table), carom.cue(speed=8.0), events_most=7)
    return caught.value


def test_errors_can_be_pickled():
    with pytest.raises(carom.CaromError) as caught:
        carom.collide(BAD)
    others = carom.CaromError(carom.Status.ERROR_TABLE), carom.CaromError(-80, "cue", text="odd")
    assert stopped().status is carom.Status.ERROR_TOO_MANY_EVENTS and "than events_most" in str(
        stopped()
    )
    shot = stopped().shot
    assert same_bits(shot.states(shot.time), shot.final)
    with pytest.raises(carom.CaromError, match="time"):
        shot.states([0.0, shot.time + 1.0])
    for error in (caught.value, stopped(), *others):
        error.note = "kept"
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
            copy = pickle.loads(pickle.dumps(error, protocol))
            assert (
                type(copy) is carom.CaromError and str(copy) == str(error) and copy.note == "kept"
            )
            assert (copy.status, copy.field, copy.value) == (
                error.status,
                error.field,
                error.value,
            )
            if error.shot is not None:
                assert copy.shot.count == error.shot.count == 14  # the break is one cluster
                assert_array_equal(
                    copy.shot.positions([0.0, 0.1]), error.shot.positions([0.0, 0.1])
                )


def test_errors_reach_the_process_that_asked():
    """An exception that cannot be unpickled leaves a pool waiting for ever, so each call has its
    time.
    """
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        assert pool.map_async(carom.collide, [GOOD]).get(timeout=120)[0].status == 0
        with pytest.raises(
            carom.CaromError, match=r"a\.mass = -1\.0: a mass must be positive"
        ) as caught:
            pool.map_async(carom.collide, [GOOD, BAD]).get(timeout=120)
        assert caught.value.field == "a.mass" and caught.value.status is carom.Status.ERROR_MASS
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=context) as executor:
        with pytest.raises(carom.CaromError, match="mass"):
            executor.submit(carom.collide, BAD).result(timeout=120)
        assert executor.submit(carom.collide, GOOD).result(timeout=120).status == 0


def test_tab_completion_shows_what_a_module_offers():
    found = (
        module.name
        for module in pkgutil.walk_packages(carom.__path__, "carom.", onerror=lambda name: None)
    )
    for name in ("carom", *(name for name in found if "._" not in name)):
        try:
            module = importlib.import_module(name)
        except ImportError:
            continue
        shown = {name for name in dir(module) if name[0] != "_"}
        assert shown and not shown & {
            "np",
            "npt",
            "ffi",
            "lib",
            "annotations",
            "Any",
            "Literal",
            "dataclass",
            "Array",
            "pointer",
        }, module
        assert set(getattr(module, "__all__", ())) <= shown | {"__version__"}, module


def test_the_package_shows_what_it_offers_and_short_signatures():
    """help() of the package names all in a page or two; that of a call has its options by name,
    without the usual ones.
    """
    assert (
        dir(carom) == sorted(carom._OFFERED)
        and pydoc.render_doc(carom).count("\n") < 100
        and set(carom._OFFERED) <= set(re.findall(r"\w+", carom.__doc__))
    )
    assert "options: 'Options' = Options(), **changes" in str(inspect.signature(carom.simulate))
    usual = carom.Options()
    assert (
        repr(usual) == "Options()"
        and repr(carom.Options("pooltool", stop_at=("contact",)))
        == "Options(world='pooltool', stop_at=('contact',))"
    )
    assert eval(repr(usual), {"Options": carom.Options}) == usual


def test_racks_and_tables_are_those_of_the_library():
    from carom._carom import ffi, lib
    from carom._rows import numbered, worded

    assert dir(carom.racks) == sorted(worded("RACK"))
    for kind, name in enumerate(worded("RACK")):
        table = carom.tables.snooker() if name == "snooker" else carom.tables.pool_9ft()
        rack, text = (
            getattr(carom.racks, name),
            ffi.string(lib.carom_word_text(lib.CAROM_WORDS_RACK, kind)).decode(),
        )
        assert rack.__doc__ == f"{len(rack(table))} balls: {text}."
    assert dir(carom.tables) == sorted([*numbered("carom_table_kind"), "measures", "polygon"])
    for name in numbered("carom_table_kind"):
        rack = getattr(carom.tables, name)
        assert f"{rack().width:.4g} x {rack().length:.5g} m" in rack.__doc__


@pytest.mark.parametrize(
    ("module", "use"),
    [("jax", "import carom.jax"), ("pyarrow", "import carom; carom.simulate_arrow(0, 0)")],
)
def test_what_is_not_installed_is_asked_for(module, use):
    absent = f"import sys; sys.modules['{module}'] = None"
    done = run_python("-c", f"{absent}; {use}", status=1)
    assert f" needs {module}, which is not installed: pip install {module}" in done.stderr


def test_objects_are_made_of_plain_classes_alone():
    """Zeros are no dict, no type and no exception."""
    from carom._objects import make

    class Plain:
        pass

    class Dict(dict):
        pass

    class Own:
        def __new__(cls):
            return super().__new__(cls)

    assert [found.a for found in make(Plain, 2, ("a",), ([1, 2],))] == [1, 2]
    for kind in (type, dict, int, Exception, Dict, Own):
        with pytest.raises(TypeError, match="no __new__"):
            make(kind, 1, (), ())
    with pytest.raises(ValueError, match="negative"):
        make(Plain, -1, (), ())


# ---- Arrays
# ------------------------------------------------------------------------------------------------------------


def test_plain_takes_records_of_doubles_alone():
    for name in ("impact", "result", "motion", "cushion_impact", "ball_kind", "jaw", "pocket"):
        records = np.zeros((2, 3), getattr(carom.dtypes, name))
        assert carom.dtypes.plain(records).shape == (2, 3, records.dtype.itemsize // 8)


def test_memory_that_overlaps_is_refused(impacts):
    n = len(impacts)
    memory, status = np.zeros(40 * n), np.zeros(n, np.int8)
    inside = memory[: 26 * n].reshape(n, 26)
    inside[:] = impacts
    neighbor = memory[26 * n : 38 * n].reshape(n, 12)

    def bytes_from(place):
        return memory[place:].view(np.int8)[:n]

    for out, what in (
        ((memory[: 12 * n].reshape(n, 12), status), r"out\[0\]: .* impacts"),
        ((memory[26 * n - 1 : 38 * n - 1].reshape(n, 12), status), r"out\[0\]: .* impacts"),
        ((neighbor, bytes_from(26 * n - 1)), r"out\[1\]: .* impacts"),
        ((neighbor, bytes_from(38 * n - 1)), r"out\[1\]: .* out\[0\]"),
    ):
        with pytest.raises(ValueError, match=what):
            carom.collide(inside, out=out)
    assert_array_equal(inside, impacts)
    # Side by side in one block is as good as apart; and an input that is copied first may be
    # written over.
    expected = carom.collide(impacts).motion
    assert_array_equal(carom.collide(inside, out=(neighbor, bytes_from(38 * n))).motion, expected)
    turned = np.asfortranarray(impacts)
    over = turned.T.reshape(-1)[: 12 * n].reshape(n, 12)
    assert np.may_share_memory(turned, over)
    assert_array_equal(carom.collide(turned, out=(over, status)).motion, expected)
    with pytest.raises(ValueError, match=r"out\[0\]: .* impacts"):
        carom.cushion(
            memory[: 15 * n].reshape(n, 15), out=(memory[10 * n : 16 * n].reshape(n, 6), status)
        )
    table, rack, cues = shots_of(2)
    shots = carom.simulate_batch(table, rack, cues)
    shots.status = shots.record.view(np.int8)[:2]
    with pytest.raises(ValueError, match=r"out\.record: .* out\.status"):
        carom.simulate_batch(table, rack, cues, out=shots)


# ---- Chunks and Ctrl-C
# -------------------------------------------------------------------------------------------------


@functools.cache
def hard():
    """Collisions under strong friction, which take the exact solver a hundred times as long as
    those of play.
    """
    rng = np.random.default_rng(1)
    n = 100_000
    angle = rng.uniform(0, 1.2, n)
    return carom.impacts(
        v_a=rng.uniform(0.1, 3, (n, 1)) * [1, 0, 0],
        w_a=rng.uniform(-80, 80, (n, 3)),
        mass_b=2.0,
        mu_slide=1.0,
        mu_ball=1.0,
        r_b=np.stack([np.cos(angle), np.sin(angle), np.zeros(n)], axis=-1),
        restitution=0.1,
    )


def shots_of(n):
    table = carom.tables.pool_9ft()
    return table, carom.racks.nineball(table), carom.cue(speed=np.linspace(4.0, 9.0, n))


@functools.cache
def long_calls():
    """Each takes half a second or more."""
    easy = np.tile(hard()[:1], 1_000_000)
    cushions = np.tile(carom.cushion_impacts(v=(0.5, 1.0, 0.0), w=(0.0, 20.0, 60.0)), 400_000)
    table, rack, cues = shots_of(30_000)
    shot = carom.simulate(*shots_of(1)[:2], carom.cue(speed=9.0))
    return {
        "exact": lambda: carom.collide(hard()),
        "euler, threads": lambda: carom.collide(easy, solver="euler", threads=-1, steps=2000),
        "cushion": lambda: carom.cushion(cushions),
        "shots, threads": lambda: carom.simulate_batch(table, rack, cues, threads=2),
        "states": lambda: shot.states(np.linspace(0, shot.time, 2_000_000)),
    }


def after_ctrl_c(call, delay):
    """The seconds from a Ctrl-C to the end of the call, or None where the call was over before."""
    sent, over = [], False

    def interrupt():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(delay, interrupt)
    timer.start()
    try:
        call()
        over = True
        timer.join()
        time.sleep(1.0)
    except KeyboardInterrupt:
        return None if over else time.monotonic() - sent[0]
    return pytest.fail("Ctrl-C did nothing")


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("name", list(long_calls()))
def test_ctrl_c_ends_a_long_call(name):
    took, delay = None, 0.5
    while took is None:  # a fast machine is interrupted earlier
        assert delay > 0.001
        took = after_ctrl_c(long_calls()[name], delay)
        delay /= 4
    print(f"{name}: {took:.3f} s")
    assert took < 10.0  # half a second, and room for a machine that has much other work


def test_chunks_have_the_bits_of_one_call(impacts, monkeypatch):
    from carom import _impacts, _rows, collisions, results, shots

    def calls():
        many = np.tile(impacts, (70, 1))
        many[12345, 10] = -1.0
        walls = carom.cushion_impacts(
            v=np.linspace(0.1, 2, 3000)[:, None] * [0.3, 1, 0], w=(0, 0, 30)
        )
        table, rack, cues = shots_of(200)
        several = carom.simulate_batch(table, np.tile(rack, (200, 1)), cues, room=20, threads=2)
        single = carom.simulate(table, rack, cues[-1])
        yield from carom.collide(many)
        yield from carom.collide(many, threads=2, solver="euler", steps=50)
        yield from carom.collide(many.astype(np.float32))
        yield from carom.cushion(walls)
        yield from (several.final, several.events["time"], several.status, several.count)
        yield from (
            carom.mu_ball(np.tile(many, (4, 1))),
            single.states(np.linspace(0, single.time, 5000)),
        )

    seen = [array.tobytes() for array in calls()]
    for module in (_impacts, collisions, results, shots):
        assert module.in_chunks is _rows.in_chunks
        monkeypatch.setattr(module, "in_chunks", lambda n, seconds, threads, call: call(0, n))
    assert seen == [array.tobytes() for array in calls()]


def test_chunks_cover_every_row_once(monkeypatch):
    """However long they take."""
    from carom import _rows

    for pace in (1e-9, 1e-6, 1e-3, 1.0):
        ends, seen = [0.0], []

        def call(begin, count):
            ends[0] += count * pace
            seen.append((begin, count))
            return -7 if begin == 0 else -8

        monkeypatch.setattr(_rows.time, "perf_counter", lambda: ends[0])
        for threads in (0, 2):
            for n in (0, 1, 63, 64, 1000, 5001, 100_000):
                seen.clear()
                assert _rows.in_chunks(n, 2e-7, threads, call) == -7
                assert [begin for begin, _ in seen] == list(
                    np.cumsum([0, *(count for _, count in seen[:-1])])
                )
                assert sum(count for _, count in seen) == n and all(
                    count > 0 for _, count in seen
                ) == (n > 0)


# ---- The manual
# ---------------------------------------------------------------------------------------------------------


def test_a_dtype_is_called_as_its_struct():
    """docs/using/python.md says so: a header has the fields of each, with their units."""
    headers = "".join(
        header.read_text(encoding="utf-8")
        for room in ("core/include", "games/include")
        for header in (Path(__file__).parents[3] / room).glob("*.h")
    )
    for name, record in vars(carom.dtypes).items():
        if isinstance(record, np.dtype):
            found = re.search(
                rf"^typedef struct (?:carom_\w+ )?\{{([^}}]*)\}} carom_{name};", headers, flags=re.M
            )
            assert found and set(record.names) <= set(re.findall(r"\w+", found[1])), name


def test_what_to_cite():
    """BibTeX of carom first, then of the sources of the models."""
    assert carom.cite().startswith("@software{carom,") and "{mathavan2010," not in carom.cite()
    assert "{mathavan2010," in carom.cite(cushion_model="mathavan")
    assert "{kiefl2024," in carom.cite(options=carom.Options(world="pooltool"))


def test_the_revision_of_the_physics():
    golden = (
        Path(__file__).parents[3]
        / "core/tests/platforms"
        / f"bits-{carom.physics_revision()}.expected"
    )
    assert golden.is_file()
