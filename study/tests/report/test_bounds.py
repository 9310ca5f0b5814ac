"""Tests of study/bounds: the classifier on made-up lines, the join on a few lines, the chains on small loops, the command."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(ROOT))
from study.bounds import __main__ as bounds  # noqa: E402
from study.bounds import machine_code  # noqa: E402

COMMAND = [sys.executable, "-m", "study.bounds"]


def code(*lines):
    return machine_code.parse_disassembly(
        "".join(f"  {4 * k:x}:\t{line}\n" for k, line in enumerate(lines))
    )


def one(line):
    (instruction,) = code(line).values()
    return instruction


class Classifying(unittest.TestCase):
    def test_operations(self):
        """Scalar instructions are one operation, packed ones as many as lanes, conversions as many as elements; the rest is none."""
        rows = (HERE / "operations.txt").read_text()
        for told, line in re.findall(r"^(none|\w+ \d(?:, \w+ \d)*) +(\S.*)$", rows, re.M):
            expected = {name: int(count) for name, count in re.findall(r"(\w+) (\d)", told)}
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
    def test_lines_of_another_object(self):
        """Two objects may have the same addresses."""
        text = "events: Ir\nob=/lib/loader.so\n0x10 0 5\nob=/build/kernels.so\n0x10 0 7\n"
        kept = bounds.lines_of_object(text, Path("/build/kernels.so"))
        self.assertEqual(kept, "events: Ir\nob=/build/kernels.so\n0x10 0 7\n")

    def test_executions_count_operations(self):
        """Lines as callgrind writes them: an address, a line of the source, a count; what is called costs nothing here."""
        text = "positions: instr line\n0x0 1 7\ncalls=1 0x40 0\n0x4 1 90\njcnd=5/7 0x0\n0x8 1\n0x8 1 7\n"
        counts, taken = bounds.parse_callgrind(text)
        self.assertEqual((counts, taken), (Counter({0: 7, 8: 7}), Counter({8: 5})))
        total = bounds.join(code("vaddpd %ymm1,%ymm2,%ymm3", "call 40", "jne 0"), counts)
        self.assertEqual((total["add"], total["instructions"], bounds.flops(total)), (28, 14, 28))
        self.assertEqual(bounds.flops(Counter({"fma": 3, "mul": 1}), fma=2), 7)

    def test_without_addresses_it_says_so(self):
        with self.assertRaisesRegex(ValueError, "--dump-instr=yes"):
            bounds.parse_callgrind("positions: line\nfn=f\n1 2\n")


class Paths(unittest.TestCase):
    def test_the_path_follows_what_is_taken_more(self):
        lines = code(
            "vaddsd %xmm0,%xmm1,%xmm1",
            "jne c",
            "vdivsd %xmm0,%xmm1,%xmm1",
            "vmulsd %xmm0,%xmm1,%xmm1",
            "jb 0",
            "ret",
        )
        counts, taken = (
            Counter({0: 100, 4: 100, 8: 3, 12: 100, 16: 125, 20: 1}),
            Counter({4: 97, 16: 99}),
        )
        ((executions, path),) = bounds.hot_loops(lines, counts, taken, 10)
        self.assertEqual([executions] + [i.address for i in path], [100, 0, 4, 12, 16])

    def test_two_paths_of_a_loop(self):
        """60 of 100 iterations divide, and the others jump over it: each path is a loop, and no iteration is in two."""
        lines = code(
            "vaddsd %xmm0,%xmm1,%xmm1",
            "jne c",
            "vdivsd %xmm0,%xmm1,%xmm1",
            "vmulsd %xmm0,%xmm1,%xmm1",
            "jb 0",
            "ret",
        )
        counts = Counter({0: 100, 4: 100, 8: 60, 12: 100, 16: 100, 20: 1})
        taken = Counter({4: 40, 16: 99})
        loops = bounds.split_into_loops(lines, counts, taken, 10)
        self.assertEqual(
            [(executions, [i.address for i in path]) for executions, path in loops],
            [(60, [0, 4, 8, 12, 16]), (40, [0, 4, 12, 16])],
        )
        self.assertEqual(sum(bounds.split_into_loops(lines, counts, taken, 50)[0][:1]), 60)


class Chains(unittest.TestCase):
    def test_pace(self):
        """Carried by a register; not by independent work; by memory; broken by a zero; an fma reads its target."""
        for pace, *lines in (
            (6, "vaddsd %xmm1,%xmm0,%xmm0", "vmulsd %xmm2,%xmm0,%xmm0"), (3, "vaddsd %xmm1,%xmm0,%xmm0", "vdivsd %xmm2,%xmm3,%xmm4"),
            (3 + 7, "vaddsd 0x8(%rsp),%xmm1,%xmm0", "vmovsd %xmm0,0x8(%rsp)"), (0, "vaddsd 0x8(%rsp),%xmm1,%xmm0", "vmovsd %xmm0,0x10(%rsp)"),
            (3 + 7, "vaddsd 0x8(%rsp),%xmm1,%xmm0", "vmovapd %xmm0,(%rsp)"), (0, "vxorpd %xmm0,%xmm0,%xmm0", "vdivsd %xmm1,%xmm0,%xmm0"),
            (5, "vfmadd231sd %xmm1,%xmm2,%xmm0"),
        ):  # fmt: skip
            self.assertEqual(
                machine_code.chain(
                    machine_code.steps_of(code(*lines).values(), machine_code.read_latencies())
                ),
                pace,
                lines,
            )


class Command(unittest.TestCase):
    def run_command(self, *words, **more):
        return subprocess.run(
            [*COMMAND, *map(str, words)], capture_output=True, text=True, cwd=ROOT, **more
        )

    def test_errors_say_what_would_be_right(self):
        done = self.run_command("--kernel", "nonsense")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there are base, rsqrt", done.stderr)
        self.assertEqual(self.run_command("--build", "nowhere").returncode, 2)
        self.assertIn("-DCAROM_LADDER=ON", self.run_command("--build", "nowhere").stderr)

    def test_without_valgrind(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "study").mkdir()
            (Path(folder) / "study" / "ladder-gcc-zen2.so").touch()
            done = self.run_command("--build", folder, env={"PATH": folder})
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("valgrind is not installed (Debian: valgrind)", done.stderr)


def build_folder():
    """The build, if it and this machine can count; otherwise the test is skipped."""
    build = Path(os.environ.get("CAROM_BUILD", ROOT / "build"))
    missing = [tool for tool in ("valgrind", "objdump") if not shutil.which(tool)]
    if missing:
        raise unittest.SkipTest(f"{missing[0]} is not installed")
    if not list(build.glob("study/ladder-*-zen2.so")):
        raise unittest.SkipTest("there is no module of the configuration zen2")
    return build


class Live(unittest.TestCase):
    """The kernel base of the build, N = 100."""

    @classmethod
    def setUpClass(cls):
        cls.build = build_folder()
        done = subprocess.run(
            [*COMMAND, "--build", cls.build, "--kernel", "base", "--steps", "100"],
            capture_output=True,
            text=True,
            cwd=ROOT,
        )
        assert done.returncode == 0, done.stderr
        lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
        cls.notes = [line for line in done.stdout.splitlines() if line.startswith("#")]
        cls.row = dict(zip(lines[0].split(","), lines[1].split(",")))
        cls.module = cls.build / "study" / f"ladder-{cls.row['config']}.so"

    def test_steps_and_chain(self):
        """The square roots of base give its steps; a root and two divisions lie on its chain."""
        self.assertLess(abs(float(self.row["flops_sqrt"]) / 100 - 3), 0.2)
        steps = float(self.row["steps_total"])
        self.assertTrue(95 < steps < 110, steps)
        self.assertGreater(float(self.row["chain_cycles_zen2"]), 33 * steps)
        self.assertTrue(95 < float(self.row["mean_steps"]) < 110, self.row["mean_steps"])
        self.assertGreater(float(self.row["mean_chain_cycles_zen2"]), 33 * steps)
        self.assertLess(
            float(self.row["mean_chain_cycles_zen2"]), 1.05 * float(self.row["chain_cycles_zen2"])
        )

    def test_fingerprint(self):
        """FNV-1a of the module's file, computed anew."""
        fingerprint = 0xCBF29CE484222325
        for byte in self.module.read_bytes():
            fingerprint = (fingerprint ^ byte) * 0x100000001B3 % 2**64
        self.assertIn(f"# module {self.row['config']}: {fingerprint:016x}", self.notes)

    def test_independent_count(self):
        """The counts equal those of a table by hand, a disassembly and a callgrind file read anew."""
        text = subprocess.run(
            ["objdump", "-d", "--no-show-raw-insn", "--disassemble=carom_rung_base", self.module],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            driver = self.build / "study" / "bounds" / "bounds_driver"
            words = ["--tool=callgrind", "--dump-instr=yes", "--compress-pos=no"]
            cases = bounds.read_cases()
            subprocess.run(
                ["valgrind", *words, f"--callgrind-out-file={out}", driver, self.module]
                + ["base", "100"],
                input="".join(cases.values()),
                capture_output=True,
                text=True,
                check=True,
            )
            # A line of three words is an address, a source line and its executions; the line after
            # calls= is what the call cost.
            costs = re.sub(r"^calls=.*\n.*\n", "", out.read_text(), flags=re.M)
        executed = Counter()
        for address, times in re.findall(r"^0x([0-9a-f]+) \d+ (\d+)$", costs, re.M):
            executed[int(address, 16)] += int(times)
        table = {"add": "add|sub", "mul": "mul", "div": "div", "sqrt": "sqrt"}
        table["fma"] = r"fn?m(?:add|sub)\d+"
        total = Counter()
        for address, mnemonic, operands in re.findall(r"^ *([0-9a-f]+):\t(\S+) *(.*)$", text, re.M):
            for kind, names in table.items():
                found = re.fullmatch(f"v?(?:{names})([sp])d", mnemonic)
                if found:
                    width = 4 if "%ymm" in operands else 2
                    lanes = width if found[1] == "p" else 1
                    total[kind] += lanes * executed[int(address, 16)]
        for kind in table:
            self.assertAlmostEqual(
                total[kind] / len(cases), float(self.row[f"flops_{kind}"]), delta=1e-3, msg=kind
            )


if __name__ == "__main__":
    unittest.main()
