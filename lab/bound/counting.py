"""One rung: built for Zen 2, executed under callgrind, its operations counted and its hot loops bounded.

The counts of an execution are joined with the disassembly of the program that was executed (callgrind.py); the loops are the
paths that it takes most (loops.py), and their bounds come from dataflow.py and mca.py.
"""

import re
import time
from collections import Counter
from pathlib import Path

from . import callgrind, dataflow, loops, machine_code, mca
from .tools import native_latencies, output_of, runs_here, say

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SET = "-std=gnu17 -fPIC -fvisibility=hidden"  # as lab/CMakeLists.txt compiles the ladder

COUNTED = ["add", "mul", "div", "sqrt", "fma"]
OTHERS = {"rsqrt": "rsqrt", "rcp": "rcp", "convert": "conversions", "compare": "compares", "minmax": "minmax"}


def build(compiler, rung, ladder, flags, folder):
    """The driver with one rung; the names of the rung's functions; its disassembly."""
    includes = [f"-I{ladder}", f"-I{ROOT / 'src'}", f"-I{ROOT / 'include'}", f"-I{HERE}"]
    common = [compiler, *SET.split(), *flags.split(), *includes]
    kernel, driver, program = folder / f"{rung}.o", folder / f"{rung}-driver.o", folder / f"{rung}-driver"
    text = folder / f"{rung}.s"
    output_of([*common, "-S", ladder / f"{rung}.c", "-o", text])
    text.write_text(for_valgrind(text.read_text()))
    output_of([*common, "-c", text, "-o", kernel])
    output_of([*common, f"-DCHOSEN_RUNG=carom_rung_{rung}", "-c", HERE / "driver.c", "-o", driver])
    output_of([compiler, "-no-pie", kernel, driver, "-lm", "-o", program])
    return program, functions_of(output_of(["objdump", "-t", kernel]))


def for_valgrind(assembly):
    """valgrind 3.19 does not know one encoding of vmovq between vector registers: the other one is asked for."""
    return re.sub(r"^(\s*)(vmovq\s+%xmm\d+,\s*%xmm\d+)", r"\1{vex3} \2", assembly, flags=re.M)


def functions_of(symbols):
    return [line.split()[-1] for line in symbols.splitlines() if re.search(r"\sF\s+\.text", line)]


def code_of(program, functions):
    """The instructions of these functions of a program."""
    text = output_of(["objdump", "-d", "--no-show-raw-insn", program])
    blocks = re.split(r"^[0-9a-f]+ <([^>]+)>:$", text, flags=re.M)
    return machine_code.parse_disassembly(
        "".join(body for name, body in zip(blocks[1::2], blocks[2::2]) if name in functions)
    )


def execute(program, steps, cases, folder):
    """(counts, taken) of a run under callgrind."""
    out = folder / "callgrind.out"
    output_of(
        ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--collect-jumps=yes", "--compress-pos=no"]
        + ["--compress-strings=no", f"--callgrind-out-file={out}", program, str(steps)],
        input=cases,
    )
    return callgrind.parse_callgrind(out.read_text())


def nanoseconds_per_step(program, options):
    """Least time of the same program run directly on the bounded case, without what does not grow with N: is the bound one?"""
    least = {2: 1e9, 8: 1e9}
    for _ in range(30):
        for multiple in least:
            begin = time.perf_counter()
            output_of([program, str(multiple * options.steps)], input=options.case_text * 100, timeout=60)
            least[multiple] = min(least[multiple], time.perf_counter() - begin)
    return 1e9 * (least[8] - least[2]) / (6 * options.steps * 100)


def per_collision(total, cases):
    return Counter({kind: count / cases for kind, count in total.items()})


def counts_row(one, two, steps):
    """Columns of the counts: per collision at N, and per step from the difference of 2 N and N."""
    step = Counter({kind: (two[kind] - one[kind]) / steps for kind in two})
    row = {f"flops_{kind}": one[kind] for kind in COUNTED}
    row |= {name: one[kind] for kind, name in OTHERS.items()}
    row |= {"flops_total": callgrind.flops(one), "flops_amd": callgrind.flops(one, fma=2)}
    row |= {"shuffles": one["shuffle_instructions"], "instructions": one["instructions"]}
    row |= {f"per_step_{kind}": step[kind] for kind in COUNTED}
    row |= {f"per_step_{name}": step[kind] for kind, name in OTHERS.items()}
    row |= {"per_step_flops": callgrind.flops(step), "per_step_flops_amd": callgrind.flops(step, fma=2)}
    row["per_step_instructions"] = step["instructions"]
    return row


def bounds_row(hot, tools, classifier, latencies, describe):
    """Columns of the bounds, per collision: the sum over the hot loops of executions times cycles per iteration."""
    row = Counter()
    row["steps_total"] = sum(executions for executions, _ in hot)
    for executions, path in hot:
        for column, machine in (("zen2", "zen2"), ("native", native_latencies())):
            if machine:
                pace, steps = dataflow.chain(dataflow.operations_of(path, classifier, latencies[machine]))
                row[f"chain_cycles_{column}"] += executions * pace
                describe(f"loop of {executions} iterations, {len(path)} instructions; {machine}: {pace:g} cycles each")
                for label, cycles in steps:
                    describe(f"    {cycles:4g}  {label}")
        for column, machine in (("zen2", "znver2"), ("native", tools["native"])):
            if tools["mca"] and machine:
                cycles, throughput = mca.cycles_per_iteration(tools["mca"], path, machine)
                row[f"mca_cycles_{column}"] += executions * cycles
                row[f"throughput_cycles_{column}"] += executions * throughput
    return dict(row)


def measure(rung, isa, compiler, options, tools, folder, describe):
    """The rows of a rung: {kernel: {column: value}}, with the way into the frame and out of it as kernel `frame`."""
    program, functions = build(compiler, rung, options.ladder, options.flags, folder)
    rows = {rung: {}}
    if runs_here(isa):
        rows[rung]["measured_ns_per_step"] = nanoseconds_per_step(program, options)
    if not tools["valgrind"]:
        return rows
    if isa == "AVX512":
        say(f"{rung} needs AVX-512, which valgrind does not execute: no counts for it")
        return rows
    classifier, latencies = machine_code.Classifier(), dataflow.read_latencies()
    frame = {"frame_in", "frame_out"}
    code, frame_code = code_of(program, functions), code_of(program, frame)
    totals, frames = [], []
    for steps in (options.steps, 2 * options.steps):
        counts, _ = execute(program, steps, options.cases_text, folder)
        totals.append(per_collision(callgrind.join(code, counts, classifier), options.cases_count))
        frames.append(per_collision(callgrind.join(frame_code, counts, classifier), options.cases_count))
    rows[rung] |= counts_row(*totals, options.steps)
    rows["frame"] = counts_row(*frames, options.steps)
    counts, taken = execute(program, options.steps, options.case_text, folder)
    hot = loops.hot_loops(code, counts, taken, options.steps / 10)
    rows[rung] |= bounds_row(hot, tools, classifier, latencies, describe)
    if options.dump:
        Path(options.dump).mkdir(parents=True, exist_ok=True)
        for number, (executions, path) in enumerate(hot):
            name = f"{rung}-{Path(compiler).name}-loop{number + 1}.s"
            (Path(options.dump) / name).write_text(f"# {executions} iterations\n" + mca.assembly(path))
    return rows
