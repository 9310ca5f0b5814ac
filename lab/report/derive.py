"""Data made of other data: speedups beside the paper's, and operations per cycle with their bounds.

Each function gives the lines of a CSV from the other sheets, by their names in contents.py, or raises Missing.
"""

import math
import re

from .sheet import Missing, number_of
from .text import general

COUNTED_STEPS = 1000.0  # bounds.csv counts at this N


def notes_of(sheet):
    return [f"# {what}: {text}" if what else f"# {text}" for what, text in sheet.notes]


def default_config(ladder):
    """The build of the ladder's default configuration: bench notes "yardstick: base, clang-default, with as many steps"."""
    parts = (ladder.note("yardstick") or "").split(", ")
    return parts[1] if len(parts) > 1 else "default"


def speedup(data):
    """The rungs in the default configuration. What the paper says of the speedup is a number or, in its place, words: `paper` has
    the number or NA, `paper_text` what it says."""
    ladder, kernels = data["ladder"], data["kernels"]
    kernels.needs("kernel", "parent", "needs", "paper")
    ladder.needs("kernel", "config", "ns_median", "ns_spread", "speedup", "speedup_spread")
    yield from notes_of(ladder)
    yield "kernel,parent,needs,ns,ns_spread,speedup,speedup_spread,paper,paper_text,config"
    for rung in kernels.rows:
        row = ladder.first(kernel=rung["kernel"], config=default_config(ladder)) if rung["parent"] else None
        if row is not None:
            paper = rung["paper"] if math.isfinite(number_of(rung["paper"])) else "NA"
            measured = [row[name] for name in ("ns_median", "ns_spread", "speedup", "speedup_spread")]
            yield ",".join([rung["kernel"], rung["parent"], rung["needs"], *measured, paper, rung["paper"], row["config"]])


def ticks_per_ns(sheet):
    """The rate of the time stamp counter, from bench's note "time stamp counter, fenced, 2.5961 per ns"; NaN without one."""
    match = re.search(r", ([0-9.]+) per ns", sheet.note("reference cycles") or "")
    return number_of(match[1]) if match else math.nan


def same_machine(bench, bound):
    """bench notes "AMD EPYC" and "26, model 2", bound "AMD EPYC, family 26, model 2"."""
    processor, family = bench.note("processor"), bench.note("processor family")
    return None not in (processor, family) and f"{processor}, family {family}" == bound.note("machine")


def counts_by_kernel(bounds):
    """{(kernel, kind of compiler): the first row with counts}, the kind being "clang" of "clang-19"."""
    counts = {}
    for row in bounds.rows:
        if math.isfinite(row.number("flops_amd")):
            counts.setdefault((row["kernel"], row["compiler"].split("-")[0]), row)
    return counts


def compiler_of(text):
    """Version and flags in a note such as "clang, Debian Clang 19.1.7 (3~deb12u1), -O3 -march=znver2": ("19.1.7", "-O3 ...")."""
    version, flags = re.search(r"\d+\.\d+(\.\d+)?", text or ""), re.search(r"(?:^|, )(-.*)", text or "")
    return version[0] if version else "unknown", flags[1].strip() if flags else "unknown"


def built_otherwise(cycles, bounds, config, counted):
    """Why the times of `config` are not of the code whose operations were counted, as a sentence; None where they are."""
    timed = compiler_of(cycles.note(config))
    there = compiler_of(bounds.note(f"compiler {counted}"))[0], compiler_of(bounds.note("flags"))[1]
    if timed == there:
        return None
    return f"{config} was timed as built by version {timed[0]} with {timed[1]}, the operations were counted with {there[0]}, {there[1]}"


def ratio(above, below):
    return above / below if below else math.nan


def performance(data):
    """Operations over N are those at N = 1000 and, for every step more or less, those of a step. Where the machine counts core
    cycles they are used, else reference cycles. The bound is of a step's operations over its longest chain, which is a number of
    core cycles: on a machine that shows only reference cycles these are converted by the lengths of both, as measured. Times and
    counts must be of the same code: of the same version of the compiler with the same flags."""
    cycles, bounds, latency = data["cycles"], data["bounds"], data["latency"]
    cycles.needs("kernel", "config", "steps", "ref_cycles")
    bounds.needs("kernel", "compiler", "flops_amd", "per_step_flops_amd", "chain_cycles_native")
    core = math.isfinite(cycles.rows[0].number("cycles"))
    rate, cycle = ticks_per_ns(cycles), latency.first(row="cycle")
    unit = 1.0 if core else rate * cycle.number("ns") if cycle is not None else math.nan
    counts, here = counts_by_kernel(bounds), same_machine(cycles, bounds)
    other_code = {
        row["config"]: built_otherwise(cycles, bounds, row["config"], counts[row["kernel"], row["config"].partition("-")[0]]["compiler"])
        for row in cycles.rows
        if row["config"].endswith("-zen2") and (row["kernel"], row["config"].partition("-")[0]) in counts
    }
    if other_code and all(other_code.values()):
        raise Missing(next(iter(other_code.values())))
    yield from notes_of(cycles)
    yield from (f"# left out: {reason}" for reason in other_code.values() if reason)
    yield f"# cycle: {'core' if core else 'reference'} cycles"
    yield f"# ticks per ns: {general(rate, 4)}"
    yield "kernel,config,steps,flops,cycles,flops_per_cycle,bound_flops_per_cycle,share_of_bound"
    for row in cycles.rows:
        compiler, _, config = row["config"].partition("-")
        count = counts.get((row["kernel"], compiler))
        if config != "zen2" or count is None or other_code[row["config"]]:
            continue
        steps, a_step = row.number("steps"), count.number("per_step_flops_amd")
        flops = count.number("flops_amd") + (steps - COUNTED_STEPS) * a_step
        taken = row.number("cycles" if core else "ref_cycles")
        chain = count.number("chain_cycles_native") if here else math.nan
        pace, bound = ratio(flops, taken), ratio(COUNTED_STEPS * a_step, chain * unit)
        numbers = [general(steps, 9), general(flops, 6), general(taken, 6), general(pace, 4), general(bound, 4)]
        yield ",".join([row["kernel"], row["config"], *numbers, general(ratio(pace, bound), 4)])


FUNCTIONS = {"speedup": speedup, "performance": performance}
