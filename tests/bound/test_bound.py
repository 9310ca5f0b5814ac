"""Tests of lab/bound: the classifier on made-up lines, the join on a few lines, the chains on small loops, the command.

With the argument `live` the one test that runs a kernel of the build in $CAROM_BUILD under callgrind; it exits with 77 where that
cannot be.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT))
from lab.bound import __main__ as bound
from lab.bound import machine_code

COMMAND = [sys.executable, "-m", "lab.bound"]


def code(*lines):
    return machine_code.parse_disassembly("".join(f"  {4 * k:x}:\t{line}\n" for k, line in enumerate(lines)))


def one(line):
    (instruction,) = code(line).values()
    return instruction


class Classifying(unittest.TestCase):
    def test_operations(self):
        """Scalar instructions are one operation, packed ones as many as lanes, conversions as many as elements; the rest is none."""
        for line, expected in {
            "vaddsd %xmm1,%xmm2,%xmm3": {"add": 1}, "mulss  0x10(%rsp,%rax,4),%xmm0": {"mul": 1}, "vfnmadd231sd %xmm1,%xmm2,%xmm3": {"fma": 1},
            "vdivsd %xmm1,%xmm2,%xmm3": {"div": 1}, "vsqrtsd %xmm1,%xmm1,%xmm3": {"sqrt": 1}, "vucomisd %xmm1,%xmm2": {"compare": 1},
            "vsubpd %xmm1,%xmm2,%xmm3": {"add": 2}, "vaddpd 0x20(%rsp),%ymm2,%ymm3": {"add": 4}, "vmulps %ymm1,%ymm2,%ymm3": {"mul": 8},
            "vrsqrtps %xmm1,%xmm2": {"rsqrt": 4}, "vminpd %zmm1,%zmm2,%zmm3": {"minmax": 8}, "vcmpltpd %ymm1,%ymm2,%ymm3": {"compare": 4},
            "vdpps $0x71,%xmm1,%xmm2,%xmm3": {"mul": 4, "add": 3}, "vcvtsd2ss %xmm1,%xmm1,%xmm1": {"convert": 1},
            "vcvtpd2ps %ymm1,%xmm1": {"convert": 4}, "vcvtps2pd %xmm1,%ymm1": {"convert": 4}, "vcvtpd2psy (%rax),%xmm1": {"convert": 4},
            "vmovapd %xmm1,%xmm2": {}, "vxorpd %xmm1,%xmm1,%xmm1": {}, "vshufpd $0x1,%xmm1,%xmm1,%xmm2": {}, "ja 1d0 <f+0x1d0>": {},
        }.items():  # fmt: skip
            self.assertEqual(machine_code.operations(one(line)), expected, line)
        with self.assertRaisesRegex(machine_code.UnknownInstruction, "vfrobpd"):  # not guessed
            machine_code.operations(one("vfrobpd %xmm1,%xmm2"))

    def test_latencies(self):
        """Division and root know their precision, and every row exists."""
        self.assertEqual(machine_code.latency_row(one("vdivss %xmm1,%xmm2,%xmm3")), "div.s")
        self.assertEqual(machine_code.latency_row(one("vsqrtpd %xmm1,%xmm2")), "sqrt.d")
        rows = set(machine_code.read_latencies())
        for _, row, _ in machine_code.INSTRUCTIONS:
            self.assertTrue(row in rows or row + ".d" in rows and row + ".s" in rows, row)


class Joining(unittest.TestCase):
    def test_executions_count_operations(self):
        """Lines as callgrind writes them: an address, a line of the source, a count; what is called costs nothing here."""
        text = "positions: instr line\n0x0 1 7\ncalls=1 0x40 0\n0x4 1 90\njcnd=5/7 0x0\n0x8 1\n0x8 1 7\n"
        counts, taken = bound.parse_callgrind(text)
        self.assertEqual((counts, taken), (Counter({0: 7, 8: 7}), Counter({8: 5})))
        total = bound.join(code("vaddpd %ymm1,%ymm2,%ymm3", "call 40", "jne 0"), counts)
        self.assertEqual((total["add"], total["instructions"], bound.flops(total)), (28, 14, 28))
        self.assertEqual(bound.flops(Counter({"fma": 3, "mul": 1}), fma=2), 7)

    def test_without_addresses_it_says_so(self):
        with self.assertRaisesRegex(ValueError, "--dump-instr=yes"):
            bound.parse_callgrind("positions: line\nfn=f\n1 2\n")


class Paths(unittest.TestCase):
    def test_the_path_follows_what_is_taken_more(self):
        lines = code("vaddsd %xmm0,%xmm1,%xmm1", "jne c", "vdivsd %xmm0,%xmm1,%xmm1", "vmulsd %xmm0,%xmm1,%xmm1", "jb 0", "ret")
        counts, taken = Counter({0: 100, 4: 100, 8: 3, 12: 100, 16: 100, 20: 1}), Counter({4: 97, 16: 99})
        ((executions, path),) = bound.hot_loops(lines, counts, taken, 10)
        self.assertEqual([executions] + [i.address for i in path], [100, 0, 4, 12, 16])


class Chains(unittest.TestCase):
    def test_pace(self):
        """Carried by a register; not by independent work; by memory; broken by a zero; an fma reads its target."""
        for pace, *lines in (
            (6, "vaddsd %xmm1,%xmm0,%xmm0", "vmulsd %xmm2,%xmm0,%xmm0"), (3, "vaddsd %xmm1,%xmm0,%xmm0", "vdivsd %xmm2,%xmm3,%xmm4"),
            (3 + 7, "vaddsd 0x8(%rsp),%xmm1,%xmm0", "vmovsd %xmm0,0x8(%rsp)"), (0, "vaddsd 0x8(%rsp),%xmm1,%xmm0", "vmovsd %xmm0,0x10(%rsp)"),
            (3 + 7, "vaddsd 0x8(%rsp),%xmm1,%xmm0", "vmovapd %xmm0,(%rsp)"), (0, "vxorpd %xmm0,%xmm0,%xmm0", "vdivsd %xmm1,%xmm0,%xmm0"),
            (5, "vfmadd231sd %xmm1,%xmm2,%xmm0"),
        ):  # fmt: skip
            self.assertEqual(machine_code.chain(machine_code.steps_of(code(*lines).values(), machine_code.read_latencies())), pace, lines)


class Command(unittest.TestCase):
    def run_bound(self, *words, **more):
        return subprocess.run([*COMMAND, *map(str, words)], capture_output=True, text=True, cwd=ROOT, **more)

    def test_errors_say_what_would_be_right(self):
        done = self.run_bound("--kernel", "nonsense")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there are base, rsqrt", done.stderr)
        self.assertEqual(self.run_bound("--build", "nowhere").returncode, 2)
        self.assertIn("-DCAROM_LADDER=ON", self.run_bound("--build", "nowhere").stderr)

    def test_without_valgrind(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "lab").mkdir()
            (Path(folder) / "lab" / "ladder-gcc-zen2.so").touch()
            done = self.run_bound("--build", folder, env={"PATH": folder})
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("valgrind is not installed (Debian: valgrind)", done.stderr)


def live():
    """One kernel, as it is timed: the square roots of base tell the steps, whatever the compiler."""
    build = Path(os.environ.get("CAROM_BUILD", ROOT / "build"))
    missing = [tool for tool in ("valgrind", "objdump") if not shutil.which(tool)]
    if missing or not list(build.glob("lab/ladder-*-zen2.so")):
        print(f"skipped: {missing[0]} is not installed" if missing else "skipped: there is no module of the configuration zen2")
        return 77
    command = [*COMMAND, "--build", build, "--kernel", "base", "--steps", "100"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    notes = [line for line in done.stdout.splitlines() if line.startswith("#")]
    lines = [line.split(",") for line in done.stdout.splitlines() if not line.startswith("#")]
    row = dict(zip(lines[0], lines[1]))
    assert any(line.startswith(f"# {row['config']}: ") and "-march=znver2" in line for line in notes), notes
    assert abs(float(row["flops_sqrt"]) / 100 - 3) < 0.2, row
    assert 95 < float(row["steps_total"]) < 110, row  # the hot loop is found
    assert float(row["chain_cycles_zen2"]) > 33 * float(row["steps_total"]), row
    # A square root and two divisions lie on the chain: no processor does a step of it in 20 cycles, or needs 200.
    assert row["chain_cycles_native"] == "NA" or 20 < float(row["chain_cycles_native"]) / float(row["steps_total"]) < 200, row
    print(f"base, N = 100: {row['flops_total']} operations, {row['chain_cycles_zen2']} cycles at least")
    return 0


if __name__ == "__main__":
    sys.exit(live() if sys.argv[1:] == ["live"] else unittest.main())
