"""What a run has measured, for the claims of the seed paper and for their causes.

`Run` reads the CSV files of the report's folder. MEASURES, at the end, has the functions that the
tables claims.csv and causes.csv name: a cell "faster double double_fisr1" is the function `faster`
with these two words. A kernel is named as in kernels.def, with @ and a configuration where it is
not the one that the run is judged in: "float@archnative", "base@gcc-o3".

A function returns a `Value`, and raises `Missing` with the reason where a file, a compiler or a
counter is missing.
"""

import math
import re
from pathlib import Path

from study.report.data import FIVE, SCALAR
from study.report.sheets import Sheet, number

RUNGS = SCALAR.split(",")  # the paper's scalar kernels
IN_DOUBLE = [rung for rung in RUNGS if rung not in ("base", "float")]
PAPER_CONFIGS = ("default", "archnative", "novec", "o3")
COUNTED = "zen2"  # the configuration whose operations are counted
# Of time ratios in one run, and of times, between runs (docs/study/measuring.md).
REPEATS_OF_RATIOS, REPEATS_OF_TIMES = 0.005, 0.028
# Twice the 1 % by which measured latencies, such as 1.99 cycles of an addition, miss integers.
OF_LATENCIES = 0.02
# The standard error of a median, in median absolute deviations over sqrt(n).
OF_MEDIAN = 1.4826 * 1.2533
# Cycles without a free entry for an instruction of floating-point arithmetic (AMD, as in the paper)
# or for any instruction (Intel), and cycles that wait to retire (AMD).
STALLS = {"dispatch": ("stalls_fp_scheduler", "stalls_resources"), "retire": ("stalls_retire",)}
PEAK = 6.0  # operations per cycle of Zen 2, by the paper
PAPER_STEPS = 1000.0
LEAST_STEPS = 100.0  # fewer steps miss the accuracy of 1 % that the paper demands
FAMILY_OF_ZEN2, FIRST_MODEL_OF_ZEN2 = 23, 0x30


class Missing(Exception):
    """Why something was not measured."""


class Value(float):
    """A number with its uncertainty, in the same unit."""

    def __new__(cls, value, uncertainty=0.0):
        number_with_uncertainty = super().__new__(cls, value)
        number_with_uncertainty.uncertainty = uncertainty
        return number_with_uncertainty

    @property
    def least(self):
        return float(self) - self.uncertainty

    @property
    def most(self):
        return float(self) + self.uncertainty

    @property
    def relative(self):
        return self.uncertainty / float(self)


def with_relative(value, relative):
    return Value(value, abs(value) * relative)


def ratio(one, other):
    return with_relative(one / other, math.hypot(one.relative, other.relative))


class Run:
    """The files of a run. It is judged in the configuration that bench compares with, such as
    clang-default, and its counts are of the same compiler.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self.sheets = {}

    # ---- Files

    def sheet(self, name):
        if name not in self.sheets:
            self.sheets[name] = Sheet(self.folder / f"{name}.csv")
        if not self.sheets[name].rows:
            raise Missing(f"there is no {name}.csv in this run")
        return self.sheets[name]

    def row(self, sheet, **conditions):
        found = self.sheet(sheet).first(**conditions)
        if not found:
            words = ", ".join(f"{name} {value}" for name, value in conditions.items())
            raise Missing(f"{sheet}.csv has no row of {words}")
        return found

    def number(self, sheet, column, **conditions):
        text = self.row(sheet, **conditions).get(column)
        value = number(text)
        if math.isnan(value):
            raise Missing(f"{column} of {sheet}.csv is {text}")
        return value

    # ---- Builds

    def reference(self):
        """The configuration of base that speedups are relative to."""
        note = self.sheet("configs").notes.get("reference kernel", "")
        if not note.startswith("base, "):
            raise Missing("this build has no kernels of the ladder")
        return note.split(", ")[1]

    def compiler(self):
        return self.reference().split("-")[0]

    def build(self, kernel):
        """The kernel's name and its build, such as clang-default."""
        name, _, config = kernel.partition("@")
        if not config:
            config = self.reference()
        elif "-" not in config:
            config = f"{self.compiler()}-{config}"
        return name, config

    def builds(self):
        """Rows of the scalar kernels in the paper's configurations by the compiler, fastest first."""
        configs = [f"{self.compiler()}-{name}" for name in PAPER_CONFIGS]
        rows = [
            row
            for row in self.sheet("configs").rows
            if row["kernel"] in RUNGS and row["config"] in configs
        ]
        if not rows:
            raise Missing(f"configs.csv has no rows of {self.compiler()}")
        return sorted(rows, key=lambda row: -number(row["speedup"]))

    def best_build(self):
        """The fastest build, "kernel@config"."""
        best = self.builds()[0]
        return f"{best['kernel']}@{best['config']}"

    # ---- Times

    def scatter(self, sheet, spread):
        """Twice the standard error of a median whose relative deviation is `spread`."""
        rounds = float(self.sheet(sheet).notes.get("rounds", "1").split(";")[0])
        return 2.0 * OF_MEDIAN * spread / math.sqrt(rounds)

    def speedup_of_row(self, sheet, row):
        """Over base in the reference configuration, with its uncertainty."""
        spread = number(row["speedup_spread"]) / number(row["speedup"])
        relative = math.hypot(self.scatter(sheet, spread), REPEATS_OF_RATIOS)
        return with_relative(number(row["speedup"]), relative)

    def speedup(self, kernel):
        name, config = self.build(kernel)
        # The reference configuration is timed by itself too, in more rounds.
        sheet = "ladder" if config == self.reference() else "configs"
        return self.speedup_of_row(sheet, self.row(sheet, kernel=name, config=config))

    def time_of_a_step(self, kernel, row):
        spread = number(row["ns_spread"]) / number(row["ns_median"])
        relative = math.hypot(self.scatter("steps", spread), REPEATS_OF_RATIOS)
        return with_relative(number(row["ns_median"]) / float(row["steps"]), relative)

    # ---- Counts

    def counts(self, sheet, kernel):
        """The row of a kernel in bounds.csv or operations.csv."""
        return self.row(sheet, kernel=kernel, config=f"{self.compiler()}-{COUNTED}")

    def count(self, sheet, kernel, column):
        value = number(self.counts(sheet, kernel).get(column))
        if math.isnan(value):
            raise Missing(f"{sheet}.csv has no {column} of {kernel}")
        return value

    def compare_modules(self, config):
        """What was timed must be what was counted."""
        what = f"module {config}"
        timed, counted = (self.sheet(name).notes.get(what) for name in ("cycles", "bounds"))
        if timed is None or timed != counted:
            raise Missing(f"{config} was timed and counted in different builds")

    def cycles_of_row(self, row, repeats):
        """Of a collision, by the processor's counter or else by the clock and an addition."""
        cycles = number(row.get("cycles"))
        if math.isnan(cycles):
            cycles = number(row.get("core_cycles"))
        if math.isnan(cycles):
            raise Missing("neither the processor nor a chain of additions counts its cycles")
        spread = number(row["ns_spread"]) / number(row["ns_median"])
        return with_relative(cycles, math.hypot(self.scatter("cycles", spread), repeats))

    def steps_of_operations(self):
        steps = re.search(r"N = (\d+)", self.sheet("operations").notes.get("cases", ""))
        if not steps:
            raise Missing("operations.csv does not say for how many steps it counts")
        return float(steps[1])


# ---- Times


def speedup(run, kernel):
    """Over base in the reference configuration, as in the paper."""
    return run.speedup(kernel)


def speedup_in(run, config, kernel):
    """Over base in another configuration, for kernel and base alike."""
    return faster(run, f"{kernel}@{config}", f"base@{config}")


def faster(run, kernel, second):
    """How many times as fast as the other kernel."""
    return ratio(run.speedup(kernel), run.speedup(second))


def slower(run, kernel, second):
    return faster(run, second, kernel)


def more_registers(run, kernel):
    """The kernel with the 32 registers of AVX-512 over the same with the 16 of AVX2."""
    if not any(row["isa"] == "avx512" for row in run.sheet("ladder").rows):
        raise Missing("this processor has no AVX-512, so all configurations have 16 registers")
    compiler = run.compiler()
    return faster(run, f"{kernel}@{compiler}-default", f"{kernel}@{compiler}-zen2")


def speedup_of_best_build(run):
    return speedup(run, run.best_build())


def lead_of(run, kernel):
    """The time of the fastest other build over that of this one."""
    build = run.build(kernel)
    others = [row for row in run.builds() if (row["kernel"], row["config"]) != build]
    if not others:
        raise Missing("configs.csv has no other build of this compiler")
    return faster(run, kernel, f"{others[0]['kernel']}@{others[0]['config']}")


def share_slower_with(run, compiler):
    """The fraction of kernels and configurations that are slower with the other compiler.

    Pairs within the uncertainty count half, and the uncertainty of the share is that half.
    """
    if compiler == run.compiler():
        raise Missing(f"it compares another compiler with {compiler}")
    ratios = []
    for row in run.builds():
        kernel, config = row["kernel"], row["config"].split("-", 1)[1]
        ratios.append(faster(run, f"{kernel}@{row['config']}", f"{kernel}@{compiler}-{config}"))
    slower_ones = sum(value.least > 1.0 for value in ratios) / len(ratios)
    faster_ones = sum(value.most < 1.0 for value in ratios) / len(ratios)
    undecided = 1.0 - slower_ones - faster_ones
    return Value(slower_ones + undecided / 2.0, undecided / 2.0)


def solver_over(run, solver, kernel):
    """How many times as fast as the kernel a solver of the library is, in single calls."""
    row = run.row("ladder", kernel=solver, isa="scalar")
    return ratio(run.speedup_of_row("ladder", row), run.speedup(kernel))


def lanes_over(run, kernel):
    """The same for the fastest rung in lanes across collisions."""
    rows = [row for row in run.sheet("ladder").rows if "_lanes" in row["kernel"]]
    if not rows:
        raise Missing("this build has no rungs in lanes, or the processor no AVX2")
    best = max(rows, key=lambda row: number(row["speedup"]))
    return ratio(run.speedup_of_row("ladder", best), run.speedup(kernel))


def time_of_a_step_over_steps(run):
    """The largest time of a step over the least, from N = 1000 on, for the kernel where it is most."""
    found = []
    for kernel in FIVE.split(","):
        times = [
            run.time_of_a_step(kernel, row)
            for row in run.sheet("steps").rows
            if row["kernel"] == kernel and float(row["steps"]) >= PAPER_STEPS
        ]
        if len(times) > 1:
            found.append(ratio(max(times), min(times)))
    if not found:
        raise Missing("no kernel was timed with several numbers of steps")
    return max(found)


# ---- Accuracy


def cases_over(run, kernel, column):
    """The cases of the kernel in which a component is off; strict_1e2 is the paper's 1 %."""
    name, config = run.build(kernel)
    return Value(run.number("verify", column, kernel=name, config=config))


def most_cases_over(run, column):
    """The same for the worst of the kernels in double precision, in all their builds."""
    rows = [row for row in run.sheet("verify").rows if row["kernel"] in IN_DOUBLE]
    return Value(max(number(row[column]) for row in rows))


def largest_error(run, *kernels):
    """Of these kernels in all builds, in per cent of the pair's fastest speed."""
    rows = [row for row in run.sheet("verify").rows if row["kernel"] in kernels]
    if not rows:
        raise Missing(f"verify.csv has no rows of {', '.join(kernels)}")
    return Value(100.0 * max(number(row["max"]) for row in rows))


def cases_more_at(run, steps):
    """Cases of `float` that are off by 0.1 % with so many steps, less those with 1000."""
    more = run.number(f"growth-{steps}", "strict_1e3", kernel="float")
    return Value(more - cases_over(run, "float", "strict_1e3"))


def model_error(run):
    """The largest difference between measured and computed speeds and angles, in per cent."""
    shots = {}
    for row in run.sheet("experiments").rows:
        shots.setdefault(row["shot"], {})[row["source"]] = row
    differences = []
    for shot in shots.values():
        for column in ("v_cue", "v_object", "angle_cue_deg", "angle_object_deg"):
            measured = float(shot["measured"][column])
            differences.append(abs(float(shot["euler"][column]) / measured - 1.0))
    return Value(100.0 * max(differences))


def bits_of_estimate(run):
    """-log2 of the largest relative error of the instruction, over all arguments."""
    found = number(run.sheet("bounds").notes.get("estimate", "").split(" ")[0])
    if math.isnan(found):
        raise Missing("the estimate of this processor was not measured")
    return Value(found)


# ---- Operations and bounds, of the module that was timed


def counted(run, kernel, column):
    return Value(run.count("bounds", kernel, column))


def counted_ratio(run, kernel, second, column):
    return Value(counted(run, kernel, column) / counted(run, second, column))


def chain_ratio(run, kernel, second, latencies):
    """The longest chains of two kernels with the latencies of "zen2" or of this processor."""
    return counted_ratio(run, kernel, second, f"chain_cycles_{latencies}")


def memory_a_step(run, kernel):
    loads = counted(run, kernel, "loads_per_step")
    return Value(loads + counted(run, kernel, "stores_per_step"))


def memory_ratio(run, kernel, second):
    return Value(memory_a_step(run, kernel) / memory_a_step(run, second))


def a_step(run, kernel, column):
    """Counts over N, of the rungs that the bounds leave out too, with fewer steps."""
    return Value(run.count("operations", kernel, column) / run.steps_of_operations())


def operations_ratio(run, kernel, second, column):
    return Value(a_step(run, kernel, column) / a_step(run, second, column))


def roots_and_divisions(run, kernel):
    return a_step(run, kernel, "flops_div") + a_step(run, kernel, "flops_sqrt")


def roots_and_divisions_left(run, kernel, second):
    return Value(roots_and_divisions(run, kernel) / roots_and_divisions(run, second))


def divisions_saved(run, kernel, second):
    return Value(a_step(run, second, "flops_div") - a_step(run, kernel, "flops_div"))


def counted_by_processor(run, kernel):
    """The processor's count of operations over that of the machine code."""
    processor = run.sheet("cycles").notes.get("processor", "unknown")
    if not processor.startswith("AMD"):
        raise Missing(f"the counter of {processor} counts other operations than AMD's")
    config = run.counts("bounds", kernel)["config"]
    row = run.row("cycles", kernel=kernel, config=config, steps="1000")
    flops = number(row.get("flops"))
    if math.isnan(flops):
        raise Missing(run.sheet("cycles").notes.get("counters", "it needs hardware counters"))
    run.compare_modules(config)
    return Value(flops / counted(run, kernel, "flops_amd"))


def cycles(run, kernel):
    """Of a collision of 1000 steps, in the module whose operations are counted."""
    config = run.counts("bounds", kernel)["config"]
    row = run.row("cycles", kernel=kernel, config=config, steps="1000")
    run.compare_modules(config)
    return run.cycles_of_row(row, REPEATS_OF_TIMES)


def chain_of_cases(run, kernel, latencies):
    """The longest chain as the mean over the cases that are timed; of one case, where bounds.csv
    has no mean.
    """
    mean = f"mean_chain_cycles_{latencies}"
    has_mean = mean in run.counts("bounds", kernel)
    return counted(run, kernel, mean if has_mean else f"chain_cycles_{latencies}")


def share_of_bound(run, kernel):
    """In per cent, with this processor's latencies."""
    return ratio(Value(100.0 * chain_of_cases(run, kernel, "native")), cycles(run, kernel))


def share_of_peak(run, kernel):
    """In per cent."""
    operations = counted(run, kernel, "flops_amd")
    return ratio(Value(100.0 * operations / PEAK), cycles(run, kernel))


def performance_at_bound(run, kernel):
    """Operations per cycle, if a collision took only the cycles of its longest chain."""
    chain = chain_of_cases(run, kernel, "zen2")
    return Value(counted(run, kernel, "flops_amd") / chain)


def performance(run, counts, row):
    """Operations per cycle of a row of cycles.csv, with the counts of that kernel."""
    more_steps = float(row["steps"]) - PAPER_STEPS
    operations = number(counts["flops_amd"]) + more_steps * number(counts["per_step_flops_amd"])
    return ratio(Value(operations), run.cycles_of_row(row, REPEATS_OF_RATIOS))


def performance_over_steps(run):
    """The largest operations per cycle over the least, over N, for the kernel where it is most."""
    config = f"{run.compiler()}-{COUNTED}"
    run.compare_modules(config)
    timed = [
        row
        for row in run.sheet("cycles").rows
        if row["config"] == config and float(row["steps"]) >= LEAST_STEPS
    ]
    found = []
    for kernel in dict.fromkeys(row["kernel"] for row in timed if row["kernel"] in FIVE.split(",")):
        counts = run.counts("bounds", kernel)
        values = [performance(run, counts, row) for row in timed if row["kernel"] == kernel]
        if len(values) > 1:
            found.append(ratio(max(values), min(values)))
    if not found:
        raise Missing("cycles.csv has each kernel with one number of steps")
    return max(found)


def mca_over_chain(run, kernel):
    """The cycles of llvm-mca's model of this processor over those of the longest chain."""
    return Value(
        counted(run, kernel, "mca_cycles_native") / counted(run, kernel, "chain_cycles_native")
    )


# ---- The processor


def latency(run, name):
    """Cycles of this processor, measured by a chain of such instructions."""
    note = run.sheet("bounds").notes.get(f"latency {name}", "")
    found = number(note.split(" ")[0])
    if math.isnan(found):
        raise Missing(f"the latency {name} of this processor was not measured")
    return with_relative(found, OF_LATENCIES)


def latency_of_root_and_division(run):
    return with_relative(latency(run, "sqrt.d") + latency(run, "div.d"), OF_LATENCIES)


def latency_of_estimate_and_conversions(run):
    return with_relative(latency(run, "rsqrt") + 2.0 * latency(run, "convert"), OF_LATENCIES)


def latency_saved_by_estimate(run):
    root, estimate = latency_of_root_and_division(run), latency_of_estimate_and_conversions(run)
    return Value(root - estimate, math.hypot(root.uncertainty, estimate.uncertainty))


def is_zen2(run):
    """1 on the paper's microarchitecture, 0 on another."""
    note = run.sheet("configs").notes.get("processor family", "")
    found = re.match(r"(\d+), model (\d+)", note)
    if not found:
        raise Missing("configs.csv does not name the family of the processor")
    family, model = int(found[1]), int(found[2])
    return Value(family == FAMILY_OF_ZEN2 and model >= FIRST_MODEL_OF_ZEN2)


def stalls(run, kernel, kind):
    """The cycles of a collision in which the kernel waits, by the processor's counters."""
    name, config = run.build(kernel)
    row = run.row("configs", kernel=name, config=config)
    for column in STALLS[kind]:
        cycle_count = number(row.get(column))
        if not math.isnan(cycle_count):
            return Value(cycle_count)
    raise Missing(run.sheet("configs").notes.get("counters", "it needs hardware counters"))


def stalls_ratio(run, kernel, second, kind):
    waits = stalls(run, kernel, kind) / stalls(run, second, kind)
    return with_relative(waits, REPEATS_OF_TIMES)


# ---- pooltool


def motive(run, column):
    """Of pooltool's eight-ball break, by study/motive.py."""
    try:
        return Value(run.number("motive", column, system="eight-ball break"))
    except Missing:
        raise Missing("it needs pooltool: docs/study/paper.md says how to measure it") from None


def motive_gain_over_scatter(run):
    return Value((motive(run, "with_paper") - 1.0) / motive(run, "spread"))


def on_apple_m1(run):
    raise Missing("it needs an Apple M1, and the kernels are x86 code")


def other_codes(run):
    raise Missing("no run decides it; docs/study/paper.md names other code that has the algorithm")


MEASURES = {
    function.__name__: function
    for function in (
        a_step,
        bits_of_estimate,
        cases_more_at,
        cases_over,
        chain_ratio,
        counted,
        counted_by_processor,
        counted_ratio,
        cycles,
        divisions_saved,
        faster,
        is_zen2,
        lanes_over,
        largest_error,
        latency,
        latency_of_estimate_and_conversions,
        latency_of_root_and_division,
        latency_saved_by_estimate,
        lead_of,
        mca_over_chain,
        memory_a_step,
        memory_ratio,
        model_error,
        more_registers,
        most_cases_over,
        motive,
        motive_gain_over_scatter,
        operations_ratio,
        on_apple_m1,
        other_codes,
        performance_at_bound,
        performance_over_steps,
        roots_and_divisions_left,
        share_of_bound,
        share_of_peak,
        share_slower_with,
        slower,
        solver_over,
        speedup,
        speedup_in,
        speedup_of_best_build,
        stalls_ratio,
        time_of_a_step_over_steps,
    )
}


def measure(run, cell):
    """The value of a cell of claims.csv: a function's name and its words."""
    name, *words = cell.split()
    if name not in MEASURES:
        raise KeyError(f"no measure '{name}' in study/measures.py")
    return MEASURES[name](run, *words)
