"""carom.numba: the bits of carom.collide and carom.cushion from compiled loops, also from the cache in another process."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from conftest import columns

import carom

pytest.importorskip("numba", reason="Numba is not installed")
from numba import njit, prange  # noqa: E402
from numba.core.errors import TypingError  # noqa: E402

from carom.numba import collide, cushion, mu_ball  # noqa: E402

CUSHION = "vx vy vz wx wy wz nx ny h R M mu_s mu_w e rho"
SLIP = "pooltool"

# A program with what a user would have cached; it prints bits, the cache's hits and misses, and where the function of C lies.
PROGRAM = """
import json, sys
import numpy as np
from numba import njit
import carom
from carom._carom import ffi, lib
from carom.numba import collide

@njit(cache=True)
def resolve(impacts, motion):
    worst = 0
    for k in range(len(impacts)):
        worst = min(worst, collide(impacts[k], motion[k]))
    return worst

impacts = np.load(sys.argv[1])
motion = np.empty((len(impacts), 12))
worst = resolve(impacts, motion)
stats = resolve.stats
address = int(ffi.cast("uintptr_t", ffi.addressof(lib, "carom_python_collide")))
counts = sum(stats.cache_hits.values()), sum(stats.cache_misses.values())
print(json.dumps([motion.tobytes().hex(), worst, *counts, address]))
"""


@njit
def loop(impacts, motion, status):
    for k in range(len(impacts)):
        status[k] = collide(impacts[k], motion[k])


@njit(parallel=True, nogil=True)
def parallel_loop(impacts, motion, status):
    for k in prange(len(impacts)):
        status[k] = collide(impacts[k], motion[k], "euler", slip=SLIP, steps=100)


@njit
def cushion_loop(impacts, motion, status):
    for k in range(len(impacts)):
        status[k] = cushion(impacts[k], motion[k], model="mathavan")


@njit(parallel=True)
def stronge_loop(impacts, motion, status):
    for k in prange(len(impacts)):
        status[k] = cushion(impacts[k], motion[k], "stronge", convention="pooltool", omega_ratio=1.7)


@njit
def friction_loop(impacts, mu):
    for k in range(len(impacts)):
        mu[k] = mu_ball(impacts[k])


def both(compiled, width, impacts):
    """Motion and status by a compiled loop."""
    motion, status = np.empty((len(impacts), width)), np.full(len(impacts), 99, np.int8)
    compiled(impacts, motion, status)
    return motion, status


def agree(got, expected):
    np.testing.assert_array_equal(got[0], expected[0])
    np.testing.assert_array_equal(got[1], expected[1])


def test_bits_of_collide(impacts):
    bad = impacts.copy()
    bad[5, 10], bad[6, 3:6] = -1.0, [-1.0, 0.0, 0.0]
    expected = carom.collide(bad)
    assert expected.status[5] == carom.Status.ERROR_MASS and expected.status[6] == carom.Status.SEPARATING
    agree(both(loop, 12, bad), expected)
    agree(both(loop.py_func, 12, bad), expected)


def test_bits_of_collide_in_parallel(impacts):
    many = np.tile(impacts, (20, 1))
    agree(both(parallel_loop, 12, many), carom.collide(many, solver="euler", slip="pooltool", steps=100))


def test_bits_of_cushion():
    impacts = columns("cushion-stronge.csv", CUSHION)
    agree(both(cushion_loop, 6, impacts), carom.cushion(impacts))
    agree(both(stronge_loop, 6, impacts), carom.cushion(impacts, model="stronge", convention="pooltool", omega_ratio=1.7))


def test_bits_of_mu_ball(impacts):
    mu = np.empty(len(impacts))
    friction_loop(impacts, mu)
    np.testing.assert_array_equal(mu, carom.mu_ball(impacts))
    np.testing.assert_array_equal([mu_ball(row, 0.1, 0.0, 1.0) for row in impacts[:3]], [0.1] * 3)


def test_the_cache_serves_another_process(tmp_path, impacts):
    """The second process compiles nothing, and finds the function though it lies elsewhere: its address is not in the cache."""
    (tmp_path / "program.py").write_text(PROGRAM)
    np.save(tmp_path / "impacts.npy", impacts)
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    runs = []
    for _ in range(2):
        command = [sys.executable, str(tmp_path / "program.py"), str(tmp_path / "impacts.npy")]
        done = subprocess.run(command, env=environment, cwd=tmp_path, check=True, capture_output=True, text=True)
        runs.append(json.loads(done.stdout))
    assert [run[2:4] for run in runs] == [[0, 1], [1, 0]]
    assert [run[:2] for run in runs] == [[carom.collide(impacts).motion.tobytes().hex(), 0]] * 2
    cached = b"".join(path.read_bytes() for path in (tmp_path / "cache").rglob("*.nb*"))
    assert b"carom_python_collide" in cached
    for *_, address in runs:
        assert address.to_bytes(8, sys.byteorder) not in cached


def test_what_is_refused(impacts):
    motion, status = np.empty((204, 12)), np.empty(204, np.int8)

    @njit
    def misnamed(row, out):
        return collide(row, out, solver="exakt")

    @njit
    def unnamed(row, out, solver):
        return collide(row, out, solver)

    @njit
    def plain(row, out):
        return collide(row, out)

    with pytest.raises(TypingError, match="solver: must be one of 'exact', 'euler', not 'exakt'"):
        misnamed(impacts[0], motion[0])
    with pytest.raises(TypingError, match="solver: compiled code must name it by a literal"):
        unnamed(impacts[0], motion[0], "exact")
    with pytest.raises(TypingError, match="impact: a one-dimensional array of float64"):
        plain(impacts[0].astype(np.float32), motion[0])
    with pytest.raises(ValueError, match="impact must have 26 numbers"):
        plain(impacts[0, :25].copy(), motion[0])
    # What is raised in a parallel loop comes out of Numba as the cause of an error of its own.
    with pytest.raises((ValueError, SystemError)):
        parallel_loop(impacts[:, :25].copy(), motion, status)
    with pytest.raises(ValueError, match=r"impact: .* of shape \(26,\)"):
        collide(impacts[0, :25].copy(), motion[0])


def test_without_numba():
    """Importing the module where there is no Numba says what is needed."""
    blocked = "import sys; sys.modules['numba'] = None; import carom.numba"
    done = subprocess.run([sys.executable, "-c", blocked], capture_output=True, text=True)
    assert done.returncode == 1 and "ImportError: carom.numba needs Numba" in done.stderr and "pip install numba" in done.stderr
