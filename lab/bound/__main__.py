"""bound: operation counts of the ladder's rungs and lower bounds on their cycles, as CSV. README.md explains the columns.

Each rung is compiled for Zen 2, run under callgrind on the reference collisions, and its counts are joined with its
disassembly. What is not installed costs the columns that need it (NA, and a line on stderr), not the rest.
"""

import argparse
import csv
import datetime
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from . import dataflow, machine_code, mca
from .counting import COUNTED, OTHERS, ROOT, measure
from .tools import compilers_found, fail, find_tools, first_line, native_latencies, output_of, processor_name, say

HERE = Path(__file__).resolve().parent
MODELS = HERE / "models"

# The seed paper's default configuration, but for Zen 2 by name, so that the counts do not depend on the machine at hand.
FLAGS = "-O3 -march=znver2 -ffast-math -fno-finite-math-only"
BALL = "r{0}x r{0}y r{0}z v{0}x v{0}y v{0}z w{0}x w{0}y w{0}z R M u_s{0}"
FIELDS = (BALL.format(1) + " " + BALL.format(2) + " u_b e_b").split()  # carom_impact, as data/README.md names its numbers

COLUMNS = (
    ["kernel", "compiler"]
    + [f"flops_{kind}" for kind in COUNTED]
    + list(OTHERS.values())
    + ["flops_total", "flops_amd", "shuffles", "instructions", "steps_total"]
    + [f"per_step_{kind}" for kind in COUNTED]
    + [f"per_step_{name}" for name in OTHERS.values()]
    + ["per_step_flops", "per_step_flops_amd", "per_step_instructions"]
    + ["chain_cycles_zen2", "chain_cycles_native", "mca_cycles_zen2", "mca_cycles_native"]
    + ["throughput_cycles_zen2", "throughput_cycles_native", "measured_ns_per_step"]
)


def rungs_of(ladder):
    """The rungs in the order of kernels.def: {name: isa}."""
    table = ladder / "kernels.def"
    if not table.is_file():
        fail(f"no table of rungs at {table}: say with --ladder where the ladder is")
    found = re.findall(r"^RUNG\((\w+),\s*\w+,\s*\w+,\s*(\w+),", table.read_text(), re.M)
    return dict(found)


def read_cases(path, only=None):
    with open(path, newline="") as file:
        rows = [row for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    if only is not None:
        rows = [row for row in rows if row.get("id") == only]
        if not rows:
            fail(f"no case '{only}' in {path}")
    try:
        return "".join(" ".join(row[field] for field in FIELDS) + "\n" for row in rows), len(rows)
    except (KeyError, TypeError) as error:
        fail(f"{path} has no column {error}")


def written(value):
    return "NA" if value is None else f"{value:.10g}" if isinstance(value, (int, float)) else value


def header(options, tools, compilers):
    yield f"machine: {processor_name()}"
    yield f"date: {datetime.date.today().isoformat()}"
    for compiler in compilers:
        yield f"compiler {compiler}: {first_line([compiler, '--version'])}"
    yield f"flags: {options.flags}"
    yield f"counts: {first_line(['valgrind', '--version']) if tools['valgrind'] else 'valgrind is not installed'}"
    if tools["mca"]:
        version = next((line.strip() for line in output_of([tools["mca"], "--version"]).splitlines() if "version" in line), "")
        yield f"llvm-mca: {version}, native is {tools['native'] or 'unknown'}"
    else:
        yield "llvm-mca: not installed"
    yield f"native latencies: {native_latencies() or 'none in latencies.txt for this processor'}"
    yield f"cases: {options.cases_count}, N = {options.steps}; bounds: case {options.case}, cycles per collision"


def table(options):
    """The main job: counts and bounds of every rung, one row a kernel and compiler."""
    tools, compilers, rungs = find_tools(), compilers_found(options.compiler), rungs_of(options.ladder)
    for rung in options.rung or []:
        if rung not in rungs:
            fail(f"no rung '{rung}' in kernels.def; there are {', '.join(rungs)}")
    out = open(options.output, "w", newline="") if options.output else sys.stdout
    for line in header(options, tools, compilers):
        print(f"# {line}", file=out)
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    describe = (lambda line: print(line, file=sys.stderr)) if options.chain else (lambda line: None)
    code = 0
    for compiler in compilers:
        frame_done = False
        for rung in options.rung or rungs:
            if sys.stderr.isatty():
                say(f"{rung}, {compiler}")
            describe(f"{rung}, {compiler}")
            with tempfile.TemporaryDirectory() as folder:
                try:
                    rows = measure(rung, rungs[rung], compiler, options, tools, Path(folder), describe)
                except (RuntimeError, ValueError, subprocess.TimeoutExpired, machine_code.UnknownInstruction, mca.McaFailed) as error:
                    say(f"{rung}, {compiler}: {error}")
                    rows, code = {rung: {}}, 1
            for kernel, row in rows.items():
                if kernel != "frame" or not frame_done:
                    writer.writerow([kernel, compiler] + [written(row.get(column)) for column in COLUMNS[2:]])
                    frame_done |= kernel == "frame"
            out.flush()
    return code


# ---- The models, and measured times beside the bounds ---------------------------------------------------------------------


def models(options):
    """The longest chain of the models, which need no tool at all."""
    print("model,machine,cycles_per_step,cycles_per_collision,chain")
    for machine, latencies in dataflow.read_latencies().items():
        for path in sorted(MODELS.glob("*.txt")):
            pace, steps = dataflow.chain(dataflow.read_model(path.read_text(), latencies))
            names = " -> ".join(f"{label.split('=')[0].strip()} {cycles:g}" for label, cycles in steps)
            print(f"{path.stem},{machine},{pace:g},{pace * options.steps:g},{names}")
    return 0


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def ratio(time, bound):
    return "NA" if bound in ("NA", "", None) else f"{time / float(bound):.3f}"


def compare(options):
    """Times of `carom-lab bench --csv` over the bounds of a table made before."""
    if not options.ghz:
        fail("--ghz is needed with --times: the core's clock while it was measured (bound_latency: 1 / ns of `cycle`)")
    bounds = {(row["kernel"], row["compiler"].split("-")[0]): row for row in rows_of(options.bounds)}
    print("kernel,compiler,ns,cycles,time_over_chain,time_over_mca,flops_per_cycle,share_of_peak")
    for time in rows_of(options.times):
        compiler, _, config = time["config"].partition("-")
        row = bounds.get((time["kernel"], compiler))
        if row is None or config not in ("", "default"):
            continue
        cycles = float(time["ns_median"]) * options.ghz
        over = [ratio(cycles, row[f"{bound}_cycles_native"]) for bound in ("chain", "mca")]
        flops = "NA" if row["flops_amd"] == "NA" else float(row["flops_amd"]) / cycles
        rates = ["NA", "NA"] if flops == "NA" else [f"{flops:.3f}", f"{flops / 6:.3f}"]
        print(",".join([time["kernel"], compiler, time["ns_median"], f"{cycles:.0f}", *over, *rates]))
    return 0


def arguments():
    parser = argparse.ArgumentParser(prog="python3 -m lab.bound", description="operation counts and lower bounds of the ladder's rungs")
    parser.add_argument("--rung", action="append", help="this rung only (may be repeated; default all)")
    parser.add_argument("--compiler", action="append", help="this compiler (may be repeated; default newest clang, and gcc)")
    parser.add_argument("--flags", default=FLAGS, help="compiler flags, default '%(default)s'")
    parser.add_argument("--ladder", type=Path, default=HERE.parent / "ladder", help="folder of the rungs, default lab/ladder")
    parser.add_argument("--cases", type=Path, default=ROOT / "data" / "collisions-204.csv", help="default the 204 cases")
    parser.add_argument("--case", default="pooltool-002", help="the case whose path through the loop is bounded")
    parser.add_argument("--steps", type=int, default=1000, help="N, default %(default)s; counts also run with 2 N")
    parser.add_argument("--chain", action="store_true", help="print the longest dependency chains on stderr")
    parser.add_argument("--dump", metavar="DIR", help="write the hot loops there as assembly")
    parser.add_argument("--models", action="store_true", help="print the chains of models/*.txt instead; needs no tools")
    parser.add_argument("--times", metavar="CSV", help="of `carom-lab bench --csv`: print time over bound instead")
    parser.add_argument("--bounds", metavar="CSV", default=HERE / "results" / "bounds.csv", help="for --times")
    parser.add_argument("--ghz", type=float, help="the core's clock while --times was measured")
    parser.add_argument("-o", "--output", help="write the table there, default stdout")
    options = parser.parse_args()
    if options.steps < 10:
        fail("--steps must be at least 10")
    options.ladder = options.ladder.resolve()
    return options


def main():
    options = arguments()
    if options.models:
        return models(options)
    if options.times:
        return compare(options)
    options.cases_text, options.cases_count = read_cases(options.cases)
    options.case_text, _ = read_cases(options.cases, options.case)
    return table(options)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
