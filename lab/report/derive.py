"""Data made of other data: speedups beside the paper's, and operations per cycle with their bounds.

Each function gives the lines of a CSV from the other sheets, by their names in contents.py, or raises Missing.
"""

import math
import re

from .sheet import Missing, number_of

COUNTED_STEPS = 1000.0  # bounds.csv counts at this N


def notes_of(sheet):
    return [f"# {what}: {text}" if what else f"# {text}" for what, text in sheet.notes]


def default_config(ladder):
    """The build of the ladder's default configuration: bench notes "yardstick: base, clang-default, with as many steps"."""
    parts = (ladder.note("yardstick") or "").split(", ")
    return parts[1] if len(parts) > 1 else "default"


def speedup(data):
    """The kernels of the ladder in the default configuration. What the paper says of the speedup is a number or words: `paper` has the
    number or NA, `paper_text` what it says."""
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


def noted_number(sheet, what, pattern):
    match = re.search(pattern, sheet.note(what) or "")
    return number_of(match[1]) if match else math.nan


def ratio(above, below):
    return above / below if below else math.nan


def general(x, digits):
    return "NA" if math.isnan(x) else f"{x:.{digits}g}"


def performance(data):
    """Operations over N are those at N = 1000 and, for every step more or less, those of a step. Where the machine counts core
    cycles they are used, else reference cycles. The bound is of a step's operations over its longest chain, which is a number of
    core cycles: on a machine that shows only reference cycles these are converted by the lengths of both, as measured. Times and
    counts must be of the same code."""
    cycles, bounds = data["cycles"], data["bounds"]
    cycles.needs("kernel", "config", "steps", "ref_cycles")
    bounds.needs("kernel", "config", "flops_amd", "per_step_flops_amd", "chain_cycles_native")
    config = bounds.rows[0]["config"]
    if cycles.note(config) != bounds.note(config):
        raise Missing(f"{config} was timed as built by '{cycles.note(config)}', but its operations were counted in '{bounds.note(config)}'")
    core = math.isfinite(cycles.rows[0].number("cycles"))
    rate = noted_number(cycles, "reference cycles", r", ([0-9.]+) per ns")  # "time stamp counter, fenced, 2.5961 per ns"
    unit = 1.0 if core else rate * noted_number(bounds, "cycle", r"([0-9.]+) ns")
    yield from notes_of(cycles)
    yield f"# cycle: {'core' if core else 'reference'} cycles"
    yield f"# ticks per ns: {general(rate, 4)}"
    yield "kernel,config,steps,flops,cycles,flops_per_cycle,bound_flops_per_cycle,share_of_bound"
    for row in cycles.rows:
        count = bounds.first(kernel=row["kernel"], config=row["config"])
        if count is None or not math.isfinite(count.number("flops_amd")):
            continue
        steps, a_step = row.number("steps"), count.number("per_step_flops_amd")
        flops = count.number("flops_amd") + (steps - COUNTED_STEPS) * a_step
        taken = row.number("cycles" if core else "ref_cycles")
        pace, bound = ratio(flops, taken), ratio(COUNTED_STEPS * a_step, count.number("chain_cycles_native") * unit)
        numbers = [general(steps, 9), general(flops, 6), general(taken, 6), general(pace, 4), general(bound, 4)]
        yield ",".join([row["kernel"], row["config"], *numbers, general(ratio(pace, bound), 4)])


FUNCTIONS = {"speedup": speedup, "performance": performance}
