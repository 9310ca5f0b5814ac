"""What a recorded run measured beyond the speedups of its ladder: study/measured.csv.

A row is one number: the run, what it is (`about`), the kernel, the configuration where the run has
several, and the value.

    speedup            over the run's `base` by default, in each of the paper's configurations
    time_slip          the time of a call of `exact` with pooltool's slip, which `base` has, over
                       the time with the paper's slip
    error_slip         the largest error of `exact` with pooltool's slip
    instructions, conversions, lane_moves, chain, chain_here
                       a step of restitution and compression, of the counted set; `chain` with the
                       latencies of Zen 2, `chain_here` with those of the run's processor
    cycles             of a step, from processor time
    operations, operations_amd, loads, stores, least_cycles
                       of a collision with 1000 steps, of the counted set (loads and stores: a step)
    cases_1e3, cases_1e2, error_median, error_largest
                       of 204 cases against pooltool: those with a component that is off by more
                       than 0.1 and 1 % of itself, and the error of the pair

Both targets of a compiler share the counted set, so a znver2 run has its counts and the cycles of the
same code. study/machines.py records the rows and writes the tables of docs/study/paper.md from them.
"""

import math
from pathlib import Path

from study.report.sheets import Sheet, number

SCALAR = ("base", "rsqrt", "recmass", "cse", "reorder", "sepwhile", "double", "float")
PAPER_CONFIGS = ("default", "archnative", "novec", "o3")
COLUMNS = ["run", "about", "kernel", "config", "value"]

# What the paper's table of operations and bounds has, for the page.
PAPER_OPERATIONS = {"base": ("77,796", "77,000"), "double": ("43,829", "44,000")}

A_STEP = {
    "instructions": "instructions",
    "conversions": "conversions",
    "lane_moves": "shuffles",
    "chain": "mean_chain_cycles_zen2",
    "chain_here": "mean_chain_cycles_native",
}
A_COLLISION = {
    "operations": "flops_total",
    "operations_amd": "flops_amd",
    "loads": "loads_per_step",
    "stores": "stores_per_step",
    "least_cycles": "chain_cycles_zen2",
}
ERRORS = {
    "cases_1e3": "strict_1e3",
    "cases_1e2": "strict_1e2",
    "error_median": "median",
    "error_largest": "max",
}


# ---- The rows of a run


def rows_of(folder, run):
    """All rows of the run whose sheets are in `folder`."""
    folder = Path(folder)
    found = [*speedups(folder), *counts(folder), *errors(folder)]
    return [
        {"run": run, "about": about, "kernel": kernel, "config": config, "value": value}
        for about, kernel, config, value in found
    ]


def speedups(folder):
    for row in Sheet(folder / "configs.csv").rows:
        config = row["config"].partition("-")[2]  # clang-default is a compiler and a configuration
        if row["kernel"] in SCALAR and config in PAPER_CONFIGS:
            yield "speedup", row["kernel"], row["config"], f"{number(row['speedup']):.2f}"
    ladder = Sheet(folder / "ladder.csv")
    with_paper, with_pooltool = (
        ladder.first(kernel="exact", isa="scalar", slip=slip) for slip in ("paper", "pooltool")
    )
    if with_paper and with_pooltool:
        ratio = number(with_pooltool["ns_median"]) / number(with_paper["ns_median"])
        yield "time_slip", "exact", "", f"{ratio:.2f}"
        yield "error_slip", "exact", "", with_pooltool["error_exact_max"]


def known(row, columns):
    """(about, value) of the columns that the run has measured."""
    for about, column in columns.items():
        value = number(row.get(column, ""))
        if not math.isnan(value):
            yield about, value


def counts(folder):
    """Of a znver2 run; a native one has the same counts, but other code is timed."""
    of_steps, of_collisions = Sheet(folder / "operations.csv"), Sheet(folder / "bounds.csv")
    if of_collisions.notes.get("target of the column") == "native":
        return
    for row in of_steps.rows:
        steps = number(row.get("mean_steps", ""))
        for about, value in known(row, A_STEP):
            yield about, row["kernel"], "", f"{value / steps:.1f}"
    for row in of_collisions.rows:
        for about, value in known(row, A_COLLISION):
            yield about, row["kernel"], "", f"{value:.6g}"
    for row in Sheet(folder / "ladder.csv").rows:
        if row["kernel"] in SCALAR and row.get("steps") == "1000":
            for about, value in known(row, {"cycles": "core_cycles"}):
                yield about, row["kernel"], "", f"{value / 1000:.0f}"


def errors(folder):
    for row in Sheet(folder / "verify.csv").rows:
        default = row["config"].endswith("-default")
        if row["kernel"] in ("double", "float") and default and row["steps"] == "1000":
            for about, column in ERRORS.items():
                yield about, row["kernel"], "", row[column]


# ---- Tables of the page


def lookup(rows, run):
    return {
        (row["about"], row["kernel"], row["config"]): row["value"]
        for row in rows
        if row["run"] == run
    }


def table_of_steps(rows, run):
    heads = ["kernel", "instructions", "conversions", "lane moves", "chain", "chain here"]
    found, lines = lookup(rows, run), []
    for kernel in SCALAR:
        cells = [found.get((about, kernel, ""), "") for about in (*A_STEP, "cycles")]
        if any(cells):
            lines.append([f"`{kernel}`", *cells])
    return [[*heads, "cycles here"], *lines]


def table_of_operations(rows, run):
    heads = ["kernel", "operations", "AMD's sum", "paper", "loads a step", "stores a step"]
    found = lookup(rows, run)
    lines = []
    for kernel in dict.fromkeys(kernel for about, kernel, _ in found if about == "operations"):
        operations, amd, loads, stores, cycles = (
            number(found.get((about, kernel, ""), "")) for about in A_COLLISION
        )
        paper = PAPER_OPERATIONS.get(kernel, ("", ""))
        lines.append(
            [f"`{kernel}`", f"{operations:,.0f}", f"{amd:,.0f}", paper[0], f"{loads:.1f}"]
            + [f"{stores:.1f}", f"{cycles:,.0f}", paper[1]]
        )
    return [[*heads, "cycles on Zen 2", "paper"], *lines]


def table_of_configurations(rows, run):
    found = lookup(rows, run)
    configs = list(dict.fromkeys(config for about, _, config in found if about == "speedup"))
    order = {name: place for place, name in enumerate(PAPER_CONFIGS)}
    first = configs[0].partition("-")[0] if configs else ""
    configs.sort(key=lambda config: (not config.startswith(first), order[config.partition("-")[2]]))
    lines = [["kernel", *(config.replace("-", " ") for config in configs)]]
    for kernel in SCALAR:
        lines.append([f"`{kernel}`"] + [found.get(("speedup", kernel, c), "") for c in configs])
    return lines


PAPER_CASES = {
    ("double", "cases_1e3"): "0 (`rsqrt`)",
    ("double", "cases_1e2"): "0",
    ("float", "cases_1e3"): "26",
    ("float", "cases_1e2"): "1",
}
ERROR_NAMES = {
    "cases_1e3": "a component off by more than 0.1 %",
    "cases_1e2": "more than 1 %",
    "error_median": "median error of the pair",
    "error_largest": "largest error of the pair",
}


def table_of_errors(rows, run):
    found = lookup(rows, run)
    lines = [["cases of 204", "paper", f"`{run}`"]]
    for kernel in ("double", "float"):
        for about, name in ERROR_NAMES.items():
            paper = PAPER_CASES.get((kernel, about), "")
            lines.append([f"`{kernel}`: {name}", paper, found.get((about, kernel, ""), "")])
    return lines
