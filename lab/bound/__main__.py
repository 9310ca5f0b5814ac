"""bound: operation counts of the ladder's kernels and lower bounds on their cycles, as CSV. README.md explains the columns.

The module that `carom-lab bench --config zen2` times is run under callgrind on the reference collisions.
"""

import argparse
import csv
import datetime
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from . import dataflow, machine_code
from .counting import COUNTED, OTHERS, measure, output_of

ROOT = Path(__file__).resolve().parent.parent.parent
BALL = "r{0}x r{0}y r{0}z v{0}x v{0}y v{0}z w{0}x w{0}y w{0}z R M u_s{0}"
FIELDS = (BALL.format(1) + " " + BALL.format(2) + " u_b e_b").split()  # carom_impact, as data/README.md names its numbers

COLUMNS = (
    ["kernel", "config"]
    + [f"flops_{kind}" for kind in COUNTED]
    + [*OTHERS.values(), "flops_total", "flops_amd", "shuffles", "instructions", "steps_total"]
    + [f"per_step_{name}" for name in [*COUNTED, *OTHERS.values(), "flops", "flops_amd", "instructions"]]
    + ["chain_cycles_zen2", "chain_cycles_native"]
)


def say(message):
    print(f"bound: {message}", file=sys.stderr, flush=True)


def fail(message):
    say(message)
    sys.exit(2)


def module_of(options):
    """The module to count, and its configuration's name."""
    configs = [options.config] if options.config else ["clang-zen2", "gcc-zen2"]
    for config in configs:
        module = options.build / "lab" / f"ladder-{config}.so"
        if module.is_file():
            return module, config
    fail(f"there is no module {module}: build with -DCAROM_LADDER=ON; configurations zen2 need a processor with AVX2 and FMA")


def kernels_of(wanted):
    """The kernels to count, in the order of kernels.def: {name: what it needs of the processor}."""
    text = (ROOT / "lab" / "ladder" / "kernels.def").read_text()
    found = dict(re.findall(r"^RUNG\((\w+),\s*\w+,\s*\w+,\s*(\w+),", text, re.M))
    for name in wanted or []:
        if name not in found:
            fail(f"no kernel '{name}' in kernels.def; there are {', '.join(found)}")
    return {name: needs for name, needs in found.items() if not wanted or name in wanted}


def read_cases(path):
    """{id: the numbers of a case as a line}"""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    try:
        return {row["id"]: " ".join(row[field] for field in FIELDS) + "\n" for row in rows}
    except (KeyError, TypeError) as error:
        fail(f"{path} has no column {error}")


def measured_latencies(build):
    """(latencies of this processor by row, ns of a core cycle); ({}, None) where they cannot be measured."""
    done = subprocess.run([build / "lab" / "bound" / "bound_latency"], capture_output=True, text=True)
    rows = list(csv.DictReader(done.stdout.splitlines())) if done.returncode == 0 else []
    if not rows:
        say(f"the latencies of this processor are unknown, and so is its bound: {done.stderr.strip()}")
        return {}, None
    return {row["row"]: float(row["cycles"]) for row in rows}, float(rows[0]["ns"])


def table(options, out):
    module, config = module_of(options)
    kernels, cases = kernels_of(options.kernel), read_cases(options.data / "collisions-204.csv")
    if options.case not in cases:
        fail(f"no case '{options.case}' in {options.data / 'collisions-204.csv'}")
    for tool in ("valgrind", "objdump"):
        if not shutil.which(tool):
            fail(f"{tool} is not installed (Debian: {'binutils' if tool == 'objdump' else tool}); it counts the operations")
    driver = options.build / "lab" / "bound" / "bound_driver"
    zen2 = dataflow.read_latencies()
    native, cycle = measured_latencies(options.build)
    latencies = {"zen2": zen2} | ({"native": zen2 | native} if native else {})
    print(f"# date: {datetime.date.today().isoformat()}", file=out)
    print(f"# {output_of([driver, module]).strip()}", file=out)
    print(f"# counts: {output_of(['valgrind', '--version']).strip()}", file=out)
    print(f"# cycle: {cycle:.4f} ns" if cycle else "# cycle: NA", file=out)
    print(f"# cases: {len(cases)}, N = {options.steps}; bounds: case {options.case}, cycles per collision", file=out)
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)

    def count(kernel):
        told = [kernel] if options.chain else None
        describe = told.append if options.chain else lambda line: None
        if kernels[kernel] == "AVX512":
            return {}, "needs AVX-512, which valgrind does not execute", told
        try:
            return measure(driver, module, kernel, options.steps, list(cases.values()), cases[options.case], latencies, describe), "", told
        except (RuntimeError, ValueError, machine_code.UnknownInstruction) as error:
            return {}, str(error), told

    code = 0
    with ThreadPoolExecutor() as pool:
        for kernel, (row, why, told) in zip(kernels, pool.map(count, kernels)):
            if why:
                say(f"no counts of {kernel}: {why}")
                code |= kernels[kernel] != "AVX512"
            for line in told or []:
                print(line, file=sys.stderr)
            writer.writerow([kernel, config] + [f"{row[name]:.10g}" if name in row else "NA" for name in COLUMNS[2:]])
            out.flush()
    return code


def main():
    parser = argparse.ArgumentParser(prog="lab.bound", description="operation counts and lower bounds of the ladder's kernels")
    parser.add_argument("--kernel", action="append", help="this kernel only (may be repeated; default all)")
    parser.add_argument("--config", help="the build of it, default clang-zen2, or gcc-zen2 where there is no clang")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="folder of the modules, default build")
    parser.add_argument("--data", type=Path, default=ROOT / "data", help="folder of the cases, default data")
    parser.add_argument("--case", default="pooltool-002", help="the case whose path through the loop is bounded")
    parser.add_argument("--steps", type=int, default=1000, help="N, default %(default)s; counts also run with N/4")
    parser.add_argument("--chain", action="store_true", help="print the longest dependency chains on stderr")
    parser.add_argument("-o", "--output", help="write the table there, default stdout")
    options = parser.parse_args()
    if options.steps < 10:
        fail("--steps must be at least 10")
    if not options.output:
        return table(options, sys.stdout)
    with open(options.output, "w", newline="") as out:
        return table(options, out)


if __name__ == "__main__":
    sys.exit(main())
