"""The judge against machines that contradict the paper: it must say so.

A table of claims that calls a kernel fast on a machine where none is, or on one where each is twice
as fast as the paper says, does not judge anything.
"""

import sys
from pathlib import Path

import pytest

STORED = Path(__file__).resolve().parent
sys.path[:0] = [str(STORED.parents[2]), str(STORED)]
from made_machine import COUNTS, NOVEC, SPEEDUPS, machine  # noqa: E402
from study import paper  # noqa: E402

KERNELS = [kernel for kernel in SPEEDUPS if kernel != "base" and "_lanes" not in kernel]
SIZES = {"fastest"} | {
    f"speedup-{kernel}" for kernel in ("rsqrt", "recmass", "reorder", "double", "float")
}
CLAIMS = paper.read_claims()
# Claims that compare the times of two kernels.
ORDERS = {
    claim["id"]
    for claim in CLAIMS
    if claim["measure"].split()[0] in ("faster", "slower", "lead_of")
}
# Claims that compare the counts of two kernels, of which one must have fewer.
OF_COUNTS = {
    "rsqrt-roots",
    "rsqrt-fma",
    "recmass-fma",
    "reorder-operations",
    "sepwhile-instructions",
    "double-operations",
    "float-conversions",
    "float-memory",
    "vec-memory",
    "vec-shuffles",
}


def verdicts(folder):
    return {row["id"]: row["verdict"] for row in paper.judge(folder)}


def scaled(factor):
    """The paper's machine with every kernel so many times as fast, compared with base."""
    return {kernel: factor * SPEEDUPS[kernel] for kernel in KERNELS}


def test_no_kernel_is_faster_than_base(tmp_path):
    """No speedup is there, and no order of two kernels."""
    alike = dict.fromkeys(KERNELS, 1.0)
    found = verdicts(machine(tmp_path / "null", dict.fromkeys(NOVEC, 1.0), 1.0, **alike))
    assert {found[name] for name in SIZES} == {paper.FAILS}
    assert found["double-vec"] == paper.FAILS
    assert {found[name] for name in ORDERS - {"double-vec"}} == {paper.INDISTINGUISHABLE}


@pytest.mark.parametrize("factor", [2.0, 0.5])
def test_all_are_faster_or_slower(tmp_path, factor):
    """Speedups that are twice or half of the paper's are not the paper's."""
    novec = {kernel: factor * speedup for kernel, speedup in NOVEC.items()}
    found = verdicts(machine(tmp_path / "scaled", novec, factor * 1.93, **scaled(factor)))
    assert {found[name] for name in SIZES} == {paper.FAILS}
    assert {found[f"cycles-{kernel}"] for kernel in ("double",)} == {paper.FAILS}
    assert found["share-double"] == paper.FAILS


def test_each_speedup_by_itself(tmp_path):
    """One kernel that is a sixth faster or slower than the paper's makes its claim fail or weaker."""
    for kernel in ("rsqrt", "recmass", "reorder", "double", "float"):
        for factor, wanted in ((1.17, paper.FAILS), (0.84, paper.WEAKER)):
            speed = {kernel: factor * SPEEDUPS[kernel]}
            found = verdicts(machine(tmp_path / f"{kernel}-{factor}", **speed))
            assert found[f"speedup-{kernel}"] == wanted, (kernel, factor)


def test_all_have_one_kernels_counts(tmp_path):
    """Times of base, and the counts of one kernel for all: nothing executes less than another."""
    alike = dict.fromkeys(KERNELS, 1.0)
    counts = dict.fromkeys(COUNTS, COUNTS["base"] | {"conversions": "1000"})
    novec = dict.fromkeys(NOVEC, 1.0)
    found = verdicts(machine(tmp_path / "same", novec, 1.0, counts, **alike))
    failed = SIZES | OF_COUNTS | {"double-vec"}
    failed |= {"operations-double", "bound-double", "cycles-double"}
    assert {found[name] for name in failed} == {paper.FAILS}, {
        name: found[name] for name in failed if found[name] != paper.FAILS
    }
    assert not [name for name in ORDERS if found[name] == paper.HOLDS]
