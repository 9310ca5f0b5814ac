"""bounds: operation counts of the ladder's kernels and lower bounds on their cycles, as CSV.

The module that `carom-lab bench --config zen2` times is run under callgrind on the reference
collisions; valgrind does not execute AVX-512, hence Zen 2. `valgrind --tool=callgrind
--dump-instr=yes` reports how often the instruction at each address was executed, and its `jcnd=`
lines how often a conditional jump was taken. Joined with the module's disassembly these are
operations by kind, and the path through the loop that one collision takes in almost every step.

Columns: flops_*, rsqrt, rcp, conversions, compares, minmax are executed operations per collision at N, the mean of all cases;
flops_total is add + mul + div + sqrt + fma, flops_amd counts an fma twice, as AMD's counter does; shuffles and instructions are
instructions. per_step_flops_amd is the difference between N and N/4, divided by the steps between.

mean_steps and mean_chain_cycles_* are of the same cases: the iterations of the hot loops of a
collision, and their cycles by the longest chain of each case, with the latencies of Zen 2 and with
those of this processor. `carom-lab bench` times these cases, so the fraction of the bound is
mean_chain_cycles_* over its cycles. In some cases less friction acts, and their chain is shorter.

The others belong to one case, in which friction acts at the cloth in every step, as in the bound of the seed paper. loads_per_step and
stores_per_step are data accesses of the kernel, by callgrind's cache simulation, the difference between N and N/4 divided by the steps
between. steps_total, chain_cycles_* and mca_cycles_* are per collision at N: the iterations of its hot loops, their cycles by the longest
chain, and their cycles by llvm-mca's models of both processors; NA where llvm-mca is missing or has no model.
chain_cycles_registers is the chain with the latencies of Zen 2 if what a step stores cost nothing to load: the difference is what
the compiler keeps in memory on the chain.

The note "module CONFIG: FINGERPRINT" is of the module's file, as `carom-lab bench` writes it: counts belong to times only if both
are the same.
"""

import argparse
import csv
import datetime
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from . import machine_code

ROOT = Path(__file__).resolve().parent.parent.parent


def fields_of_ball(ball):
    """The columns of a ball's motion and constants."""
    motion = [f"{vector}{ball}{axis}" for vector in "rvw" for axis in "xyz"]
    return [*motion, "R", "M", f"u_s{ball}"]


# carom_impact, as data/README.md names its numbers
FIELDS = [*fields_of_ball(1), *fields_of_ball(2), "u_b", "e_b"]
CASE = "pooltool-002"  # friction at the cloth in every step: the case whose path through the loop is bounded
FIVE = ["base", "double", "float", "double_vec", "float_vec"]  # the kernels of the paper's figures
MODELS = {"zen2": "znver2", "native": "native"}  # what llvm-mca calls them
COUNTED = ["add", "mul", "div", "sqrt", "fma"]
OTHERS = {
    "rsqrt": "rsqrt",
    "rcp": "rcp",
    "convert": "conversions",
    "compare": "compares",
    "minmax": "minmax",
}
COLUMNS = [f"flops_{kind}" for kind in COUNTED] + [*OTHERS.values(), "flops_total", "flops_amd", "shuffles", "instructions"] + [
    "per_step_flops_amd", "mean_steps", "mean_chain_cycles_zen2", "mean_chain_cycles_native", "loads_per_step", "stores_per_step", "steps_total", "chain_cycles_zen2", "chain_cycles_native",
    "chain_cycles_registers", "mca_cycles_zen2", "mca_cycles_native"
]  # fmt: skip


def say(message):
    print(f"bounds: {message}", file=sys.stderr, flush=True)


def fail(message):
    say(message)
    sys.exit(2)


def output_of(command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        lines = [
            line
            for line in (done.stderr + done.stdout).splitlines()
            if re.search("error|nrecogni[sz]ed|unhandled", line)
        ]
        raise RuntimeError(
            f"'{Path(command[0]).name}' failed: {(lines or [done.stderr.strip()])[0]}"
        )
    return done.stdout


# ---- Counting


def code_of(module, kernel):
    """The instructions of a kernel: {address: Instruction}."""
    blocks = re.split(
        r"^[0-9a-f]+ <([^>]+)>:$",
        output_of(["objdump", "-d", "--no-show-raw-insn", module]),
        flags=re.M,
    )
    return machine_code.parse_disassembly(
        dict(zip(blocks[1::2], blocks[2::2])).get(f"carom_rung_{kernel}", "")
    )


def parse_callgrind(text):
    """(counts, jump_counts): executions by address, and how often the conditional jump at an address was taken. The line after `calls=`
    is the cost of what was called, and not counted here."""
    counts, jump_counts = Counter(), Counter()
    skip, jump = False, None
    if "positions: instr" not in text:
        raise ValueError(
            "no instruction addresses in the callgrind file: run it with --dump-instr=yes"
        )
    for line in text.splitlines():
        if line.startswith("calls="):
            skip = True
        elif line.startswith(("jcnd=", "jump=")):
            jump = int(line[5:].split("/")[0]) if line.startswith("jcnd=") else 0
        elif line.startswith("0x"):
            words = line.split()
            address = int(words[0], 16)
            if jump is not None:
                jump_counts[address] += jump
                jump = None
            elif skip:
                skip = False
            elif len(words) > 2:
                counts[address] += int(words[2])
    return counts, jump_counts


def data_accesses(text, code):
    """(loads, stores) by the instructions of `code`, of a callgrind file with the events Dr and Dw. A line leaves out trailing zeros."""
    events = re.search(r"^events: (.*)$", text, re.M)[1].split()
    sums, skip = Counter(), False
    for line in text.splitlines():
        words = line.split()
        if line.startswith("calls="):
            skip = True
        elif line.startswith("0x"):
            if not skip and int(words[0], 16) in code:
                sums.update({event: int(count) for event, count in zip(events, words[2:])})
            skip = False
    return sums["Dr"], sums["Dw"]


def lines_of_object(text, path):
    """A callgrind file without the lines of other objects, since each object has its own addresses."""
    kept, here = [], True
    for line in text.splitlines(keepends=True):
        if line.startswith("ob="):
            here = line[3:].strip() == str(path)
        if here:
            kept.append(line)
    return "".join(kept)


def execute(driver, module, kernel, steps, cases, *more):
    """The files of a run under callgrind: one, or with --dump-before one more for each call of that function."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        words = [
            "--tool=callgrind",
            "--dump-instr=yes",
            "--collect-jumps=yes",
            "--compress-pos=no",
            "--compress-strings=no",
        ]
        output_of(
            [
                "valgrind",
                *words,
                *more,
                f"--callgrind-out-file={out}",
                driver,
                module,
                kernel,
                str(steps),
            ],
            input=cases,
        )
        return [
            lines_of_object(file.read_text(), Path(module).resolve())
            for file in Path(folder).iterdir()
        ]


def join(code, counts):
    """Operations and instructions by kind: {kind: executed operations} with '<kind>_instructions'
    next to each."""
    total = Counter()
    for address, instruction in code.items():
        executed = counts.get(address, 0)
        for name, operations in machine_code.operations(instruction).items() if executed else ():
            total[name] += executed * operations
        if executed:
            total[machine_code.kind(instruction) + "_instructions"] += executed
            total["instructions"] += executed
    return total


def flops(total, fma=1):
    """Add, mul, div, sqrt and fma, as the seed paper counts; AMD's counter counts a fused multiply-add as fma=2."""
    return sum(total[kind] for kind in ("add", "mul", "div", "sqrt")) + fma * total["fma"]


def hot_loops(code, counts, jump_counts, threshold):
    """[(executions, [Instruction, ...])], most executed first: the instructions of one iteration on the path that is taken most.

    Beginning with the instruction executed most often, the path follows every jump in the direction taken more often until it comes
    back; then the same for the next instruction not yet seen, while it runs `threshold` times at least.
    The executions are those of its least executed instruction, since more could not take the whole path: a bound must not be above."""
    addresses = sorted(code)
    following = dict(zip(addresses, addresses[1:]))
    loops, seen = [], set()
    for start in sorted(
        (a for a in addresses if counts[a] >= threshold), key=lambda a: (-counts[a], a)
    ):
        path, address = {}, start
        while start not in seen and address in code and address not in path and counts[address] > 0:
            path[address] = instruction = code[address]
            jumps = (
                instruction.mnemonic == "jmp"
                or instruction.target is not None
                and 2 * jump_counts[address] > counts[address]
            )
            address = instruction.target if jumps else following.get(address)
        seen.update(path)
        if path and address == start:
            first = list(path).index(min(path))
            loops.append(
                (
                    min(counts[a] for a in path),
                    list(path.values())[first:] + list(path.values())[:first],
                )
            )
    return loops


def split_into_loops(code, counts, jump_counts, threshold):
    """The same where an iteration takes one path in some steps and another in others: each loop is found in what the loops before it
    leave of the executions."""
    counts, jump_counts = Counter(counts), Counter(jump_counts)
    found = []
    while loops := hot_loops(code, counts, jump_counts, threshold):
        executions, path = loops[0]
        found.append(loops[0])
        for instruction, following in zip(path, [*path[1:], path[0]]):
            counts[instruction.address] -= executions
            if instruction.target == following.address:
                jump_counts[instruction.address] -= executions
    return found


def bound_of(code, text, steps, latencies, chains):
    """(iterations, {machine: cycles}) of the hot loops of a collision. `chains` keeps the cycles of paths that other cases took too."""
    total, cycles = 0, Counter()
    for executions, path in split_into_loops(code, *parse_callgrind(text), steps / 100):
        total += executions
        for machine, cycles_of in latencies.items():
            key = (machine, *(instruction.address for instruction in path))
            if key not in chains:
                chains[key] = machine_code.chain(machine_code.steps_of(path, cycles_of))
            cycles[machine] += executions * chains[key]
    return total, cycles


def means_of_bounds(code, texts, steps, count, latencies):
    """The columns mean_*: the bounds of all cases, of which callgrind wrote a file each."""
    total, sums, chains = 0, Counter(), {}
    for text in texts:
        iterations, cycles = bound_of(code, text, steps, latencies, chains)
        total += iterations
        sums.update(cycles)
    return {"mean_steps": total / count} | {
        f"mean_chain_cycles_{machine}": sums[machine] / count for machine in latencies
    }


def measure(driver, module, kernel, steps, cases, case, latencies):
    """{column: value}: operations as the mean over `cases`, texts of a line each, and bounds of the one `case`, the sum over its hot
    loops of executions times cycles per iteration."""
    code, totals = code_of(module, kernel), []
    for n in (steps // 4, steps):
        (text,) = execute(driver, module, kernel, n, "".join(cases))
        counts, _ = parse_callgrind(text)
        totals.append(
            Counter({kind: count / len(cases) for kind, count in join(code, counts).items()})
        )
    few, many = totals
    every_call = f"--dump-before=carom_rung_{kernel}"
    texts = execute(driver, module, kernel, steps, "".join(cases), every_call)
    row = means_of_bounds(code, texts, steps, len(cases), latencies)
    row |= {f"flops_{kind}": many[kind] for kind in COUNTED} | {
        name: many[kind] for kind, name in OTHERS.items()
    }
    row |= {
        "flops_total": flops(many),
        "flops_amd": flops(many, fma=2),
        "shuffles": many["shuffle_instructions"],
    }
    row |= {
        "instructions": many["instructions"],
        "per_step_flops_amd": (flops(many, 2) - flops(few, 2)) / (steps - steps // 4),
    }
    short, long = (
        execute(driver, module, kernel, n, case, "--cache-sim=yes")[0] for n in (steps // 4, steps)
    )
    for name, low, high in zip(
        ("loads", "stores"), data_accesses(short, code), data_accesses(long, code)
    ):
        row[f"{name}_per_step"] = (high - low) / (steps - steps // 4)
    row["steps_total"], cycles = bound_of(code, long, steps, latencies, {})
    row |= {f"chain_cycles_{machine}": cycles[machine] for machine in latencies}
    for executions, path in hot_loops(code, *parse_callgrind(long), steps / 10):
        for machine, model in MODELS.items():
            cycles = mca_cycles(path, model)
            if cycles is not None:
                row[f"mca_cycles_{machine}"] = (
                    row.get(f"mca_cycles_{machine}", 0) + executions * cycles
                )
    return row


def mca():
    """The newest llvm-mca of the path, or None."""
    names = [*(f"llvm-mca-{version}" for version in range(30, 13, -1)), "llvm-mca"]
    return next(filter(None, map(shutil.which, names)), None)


def mca_cycles(path, model, iterations=100):
    """Cycles an iteration of a loop by llvm-mca; None where it is missing or does not know the model. Jumps of the path are
    branches to one label, since llvm-mca follows none."""
    program = mca()
    lines = [
        f"{instruction.mnemonic} loop" if instruction.target is not None else instruction.text
        for instruction in path
    ]
    if program is None:
        return None
    words = [
        program,
        "-mtriple=x86_64",
        f"-mcpu={model}",
        f"-iterations={iterations}",
        "-instruction-info=0",
        "-resource-pressure=0",
    ]
    done = subprocess.run(words, input="\n".join(lines) + "\n", capture_output=True, text=True)
    total = re.search(r"^Total Cycles:\s+(\d+)", done.stdout, re.M)
    if done.returncode or not total:
        say(
            f"no cycles of {Path(program).name} -mcpu={model}: {(done.stderr.strip().splitlines() or ['no total'])[0]}"
        )
        return None
    return int(total[1]) / iterations


# ---- The command


def module_of(options):
    """The module to count, and its configuration's name."""
    configs = [options.config] if options.config else ["clang-zen2", "gcc-zen2"]
    for config in configs:
        module = options.build / "study" / f"ladder-{config}.so"
        if module.is_file():
            return module, config
    fail(
        f"there is no module {module}: build with -DCAROM_LADDER=ON; configurations zen2 need a processor with AVX2 and FMA"
    )


def kernels_of(choice):
    """The kernels to count, in the order of kernels.def: {name: what it needs of the processor}."""
    text = (ROOT / "study" / "ladder" / "kernels.def").read_text()
    found = dict(re.findall(r"^RUNG\((\w+),\s*\w+,\s*\w+,\s*(\w+),", text, re.M))
    names = list(found) if choice == "all" else choice.split(",")
    for name in names:
        if name not in found:
            fail(f"no kernel '{name}' in kernels.def; there are {', '.join(found)}, or all")
    return {name: found[name] for name in names}


def read_cases():
    """{id: the numbers of a case as a line}"""
    with open(ROOT / "data" / "collisions-204.csv", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {row["id"]: " ".join(row[field] for field in FIELDS) + "\n" for row in rows}


def table(options, out):
    kernels, cases = kernels_of(options.kernel), read_cases()
    module, config = module_of(options)
    for tool in ("valgrind", "objdump"):
        if not shutil.which(tool):
            fail(
                f"{tool} is not installed (Debian: {'binutils' if tool == 'objdump' else tool}); it counts the operations"
            )
    driver = options.build / "study" / "bounds" / "bounds_driver"
    latencies = {"zen2": machine_code.read_latencies()}
    latencies["registers"] = latencies["zen2"] | {"load": 0.0}
    programs = options.build / "study" / "bounds"
    measured = subprocess.run([programs / "bounds_latency"], capture_output=True, text=True)
    estimate = subprocess.run([programs / "bounds_estimate"], capture_output=True, text=True)
    native = {
        row["row"]: float(row["cycles"]) for row in csv.DictReader(measured.stdout.splitlines())
    }
    if native:
        latencies["native"] = latencies["zen2"] | native
    else:
        say(
            f"the latencies of this processor are unknown, and so is its bound: {measured.stderr.strip()}"
        )
    print(f"# date: {datetime.date.today().isoformat()}", file=out)
    for line in output_of([driver, module]).splitlines():
        print(f"# {line}", file=out)
    for row, cycles in native.items():
        print(f"# latency {row}: {cycles:g} cycles", file=out)
    for row in csv.DictReader(estimate.stdout.splitlines()):
        print(f"# estimate: {row['bits']} bits, largest relative error {row['error']}", file=out)
    print(f"# counts: {output_of(['valgrind', '--version']).strip()}", file=out)
    print(f"# model: {Path(mca()).name if mca() else 'NA (no llvm-mca: package llvm)'}", file=out)
    print(
        f"# cases: {len(cases)}, N = {options.steps}; columns from loads_per_step on: case {CASE}",
        file=out,
    )
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["kernel", "config", *COLUMNS])

    def count(kernel):
        if kernels[kernel] == "AVX512":
            return {}, "needs AVX-512, which valgrind does not execute"
        try:
            return measure(
                driver, module, kernel, options.steps, list(cases.values()), cases[CASE], latencies
            ), ""
        except (RuntimeError, ValueError, machine_code.UnknownInstruction) as error:
            return {}, str(error)

    code = 0
    with ThreadPoolExecutor() as pool:
        for kernel, (row, why) in zip(kernels, pool.map(count, kernels)):
            if why:
                say(f"no counts of {kernel}: {why}")
                code |= kernels[kernel] != "AVX512"
            writer.writerow(
                [kernel, config]
                + [f"{row[name]:.10g}" if name in row else "NA" for name in COLUMNS]
            )
            out.flush()
    return code


def main():
    parser = argparse.ArgumentParser(
        prog="study.bounds",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--kernel", default=",".join(FIVE), help="these kernels, or all (default %(default)s)"
    )
    parser.add_argument(
        "--config", help="the build of it, default clang-zen2, or gcc-zen2 where there is no clang"
    )
    parser.add_argument(
        "--build", type=Path, default=ROOT / "build", help="folder of the modules, default build"
    )
    parser.add_argument(
        "--steps", type=int, default=1000, help="N, default %(default)s; counts also run with N/4"
    )
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
