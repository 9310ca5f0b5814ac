"""The claims of the seed paper, judged by a run: `carom-lab paper`, or `tools/python -m study.paper`.

claims.csv has a claim a row. Its value and its measure are expressions of Python over the functions
of `Run`, which read the CSV files of the report; its rule says when the claim holds:

    gain        a speedup or another factor above 1. It holds if nine tenths of the gain are there,
                and is weaker if there is a gain at all
    more        a factor that is above 1 by more than the times scatter; weaker if it is not below 1
                by more than that
    little      the same, and not above 1.1
    near P      within P per cent of the value
    at most, at least, equals    compared with the value

The uncertainty of a time is twice the standard error of its median, and half a per cent, by which
speedups differ between runs. Where a file, a compiler or a counter is missing the claim is not
measurable here, and the reason stands in place of the cause.
"""

import argparse
import contextlib
import csv
import math
import re
import shutil
import sys
import tempfile
import textwrap
from collections import Counter
from pathlib import Path

from study import machines, matrix
from study.report.data import DATA, SCALAR as SCALAR_NAMES, measure
from study.report.sheets import ROOT, Sheet, number

HERE = Path(__file__).resolve().parent
HOLDS, WEAKER, FAILS, UNMEASURED = (
    "holds",
    "weaker",
    "does not hold here",
    "not measurable here",
)
SCALAR = SCALAR_NAMES.replace(",", " ")
REPEATS = 0.005  # by which speedups differ between runs, relative
CLAIM_WIDTH = 58
NORMAL = 1.4826 * 1.2533  # standard error of a median, in median absolute deviations over sqrt(n)


NEEDED = [
    "kernels",
    "experiments",
    "verify",
    "growth-5000",
    "ladder",
    "steps",
    "configs",
    "cycles",
    "bounds",
    "operations",
]


class Missing(Exception):
    """Why something was not measured."""


class Value(float):
    """A number with its uncertainty, which is relative."""

    def __new__(cls, number, uncertainty=0.0):
        value = super().__new__(cls, number)
        value.uncertainty = uncertainty
        return value


class Run:
    """What one run has measured, from the CSV files of the report's folder.

    A kernel is named as in kernels.def, with @ and a configuration where it is not the default of
    the first compiler: "float@archnative", "base@gcc-o3".
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self.sheets = {}

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

    # ---- Times

    def reference(self):
        """The configuration of `base` that speedups are relative to."""
        note = self.sheet("configs").notes.get("reference kernel", "")
        if not note.startswith("base, "):
            raise Missing("this build has no kernels of the ladder")
        return note.split(", ")[1]

    def build(self, kernel):
        """The kernel's name and its build, such as clang-default."""
        name, _, config = kernel.partition("@")
        compiler = self.reference().split("-")[0]
        if not config:
            config = self.reference()
        elif "-" not in config:
            config = f"{compiler}-{config}"
        return name, config

    def uncertainty(self, row, sheet):
        rounds = float(self.sheet(sheet).notes.get("rounds", "1").split(";")[0])
        scatter = number(row["speedup_spread"]) / number(row["speedup"])
        return math.hypot(2.0 * NORMAL * scatter / math.sqrt(rounds), REPEATS)

    def speedup(self, kernel):
        """Over base in the first compiler's default configuration, as in the paper."""
        name, config = self.build(kernel)
        # The default configuration is timed by itself too, in more rounds.
        sheet = "ladder" if config == self.reference() else "configs"
        row = self.row(sheet, kernel=name, config=config)
        return Value(number(row["speedup"]), self.uncertainty(row, sheet))

    def faster(self, kernel, second):
        """How many times as fast as the other kernel."""
        first_speedup, second_speedup = self.speedup(kernel), self.speedup(second)
        return Value(
            first_speedup / second_speedup,
            math.hypot(first_speedup.uncertainty, second_speedup.uncertainty),
        )

    def slower(self, kernel, second):
        return self.faster(second, kernel)

    def builds(self, rungs):
        """Rows of these kernels in the paper's configurations by the first compiler, fastest first."""
        compiler = self.reference().split("-")[0]
        rows = [
            row
            for row in self.sheet("configs").rows
            if row["kernel"] in rungs.split()
            and row["config"].startswith(f"{compiler}-")
            and not row["config"].endswith("-zen2")
        ]
        return sorted(rows, key=lambda row: -number(row["speedup"]))

    def best_build(self, rungs):
        """The fastest build, "kernel@config"."""
        best = self.builds(rungs)[0]
        return f"{best['kernel']}@{best['config']}"

    def rank(self, kernel, rungs):
        """Its place among the builds of these kernels, by time: 1 is the fastest."""
        name, config = self.build(kernel)
        for place, row in enumerate(self.builds(rungs)):
            if (row["kernel"], row["config"]) == (name, config):
                return place + 1
        raise Missing(f"{kernel} was not timed")

    def slower_with(self, compiler, rungs):
        """The share of kernels and configurations that are slower with this compiler."""
        pairs = []
        for row in self.sheet("configs").rows:
            mine, config = row["config"].split("-", 1)
            if row["kernel"] in rungs.split() and mine == "clang" and config != "zen2":
                partner = self.row("configs", kernel=row["kernel"], config=f"{compiler}-{config}")
                pairs.append(number(row["speedup"]) > number(partner["speedup"]))
        if not pairs:
            raise Missing("it needs clang and gcc")
        return sum(pairs) / len(pairs)

    def speed(self, kernel):
        """Over base, from the table of the default configuration, which has the solvers too."""
        row = self.row("ladder", kernel=kernel)
        return Value(number(row["speedup"]), self.uncertainty(row, "ladder"))

    def best_lanes(self):
        """The fastest rung in lanes across collisions."""
        rows = [row for row in self.sheet("ladder").rows if "_lanes" in row["kernel"]]
        if not rows:
            raise Missing("this build has no rungs in lanes, or the processor no AVX2")
        return max(rows, key=lambda row: number(row["speedup"]))["kernel"]

    def over_steps(self, kernel, column, least, most):
        """The largest and the least of a column divided by the steps, over N from least to most."""
        rows = [
            row
            for row in self.sheet("steps").rows
            if row["kernel"] == kernel and least <= float(row["steps"]) <= most
        ]
        if not rows:
            raise Missing(f"{kernel} was not timed with several numbers of steps")
        values = [number(row[column]) / float(row["steps"]) for row in rows]
        return max(values) / min(values)

    # ---- Accuracy

    def paper(self, kernel, column="paper"):
        """The paper's speedup of a kernel, or one of its counts of cases, as kernels.def has it."""
        return self.number("kernels" if column == "paper" else "verify", column, kernel=kernel)

    def cases(self):
        return self.number("verify", "cases", kernel="base", config=self.reference())

    def over(self, kernel, column):
        """The cases of the kernel in which a component is off; strict_1e2 is the paper's 1 %."""
        name, config = self.build(kernel)
        return self.number("verify", column, kernel=name, config=config)

    def most_over(self, rungs, column):
        """The same for the worst of several kernels, in all their builds."""
        rows = [row for row in self.sheet("verify").rows if row["kernel"] in rungs.split()]
        return max(number(row[column]) for row in rows)

    def over_at(self, steps, column):
        """The cases of `float` with so many steps."""
        return self.number(f"growth-{steps}", column, kernel="float")

    def model_error(self):
        """The largest relative difference between measured and computed speeds and angles."""
        shots = {}
        for row in self.sheet("experiments").rows:
            shots.setdefault(row["shot"], {})[row["source"]] = row
        differences = []
        for shot in shots.values():
            for column in ("v_cue", "v_object", "angle_cue_deg"):
                measured = float(shot["measured"][column])
                differences.append(abs(float(shot["euler"][column]) / measured - 1.0))
        return max(differences)

    # ---- Operations and bounds, of the module that was timed

    def counted(self, kernel, column):
        return self.number("bounds", column, kernel=kernel)

    def a_step(self, kernel, column):
        """Counts over N, of the rungs that the bounds leave out too, with fewer steps."""
        steps = re.search(r"N = (\d+)", self.sheet("operations").notes.get("cases", ""))
        if not steps:
            raise Missing("operations.csv does not say for how many steps it counts")
        return self.number("operations", column, kernel=kernel) / float(steps[1])

    def latency(self, row):
        """Cycles of this processor, measured by a chain of such instructions."""
        note = self.sheet("bounds").notes.get(f"latency {row}", "")
        cycles = number(note.split(" ")[0])
        if math.isnan(cycles):
            raise Missing(f"the latency {row} of this processor was not measured")
        return cycles

    def cycles(self, kernel):
        """Of a collision of 1000 steps, in the module whose operations are counted."""
        config = self.row("bounds", kernel=kernel)["config"]
        row = self.row("cycles", kernel=kernel, config=config, steps="1000")
        self.compare_modules(config)
        counted = number(row.get("cycles"))
        cycles = number(row.get("core_cycles")) if math.isnan(counted) else counted
        if math.isnan(cycles):
            raise Missing("neither the processor nor a chain of additions counts its cycles")
        return Value(cycles, number(row["ns_spread"]) / number(row["ns_median"]))

    def compare_modules(self, config):
        """What was timed must be what was counted."""
        what = f"module {config}"
        timed, counted = (self.sheet(name).notes.get(what) for name in ("cycles", "bounds"))
        if timed is None or timed != counted:
            raise Missing(f"{config} was timed and counted in different builds")

    def share_of_bound(self, kernel):
        return self.counted(kernel, "chain_cycles_native") / self.cycles(kernel)

    # ---- Counters of the processor

    def stalls(self, kernel):
        """Cycles in which nothing could be dispatched for want of a place in a floating-point
        scheduler (AMD, as in the paper), or in which nothing was executed (Intel).
        """
        name, config = self.build(kernel)
        row = self.row("configs", kernel=name, config=config)
        for column in ("stalls_fp_scheduler", "stalls_execution"):
            counted = number(row.get(column))
            if not math.isnan(counted):
                return counted
        raise Missing(self.sheet("configs").notes.get("counters", "it needs hardware counters"))

    # ---- pooltool's shots

    def motive(self, column, system):
        try:
            return self.number("motive", column, system=system)
        except Missing:
            raise Missing("it needs pooltool: docs/study/paper.md says how to measure it") from None

    def names(self):
        """What expressions may use."""
        functions = {
            name: getattr(self, name)
            for name in dir(self)
            if not name.startswith("_") and callable(getattr(self, name))
        }
        return functions | {"SCALAR": SCALAR}


# ---- The rules


def rule_gain(measured, value):
    gained, expected = measured - 1.0, value - 1.0
    if gained >= 0.9 * expected:
        return HOLDS
    return WEAKER if gained > measured * measured.uncertainty else FAILS


def rule_more(measured, _):
    if measured - 1.0 > measured.uncertainty:
        return HOLDS
    return WEAKER if measured - 1.0 >= -measured.uncertainty else FAILS


def rule_little(measured, _):
    if measured > 1.1:
        return FAILS
    return rule_more(measured, None)


def rule_near(measured, value, per_cent):
    return HOLDS if abs(measured / value - 1.0) <= float(per_cent) / 100.0 else FAILS


def rule_at(measured, value, direction):
    if direction == "most":
        return HOLDS if measured <= value else FAILS
    return HOLDS if measured >= value else FAILS


def rule_equals(measured, value):
    return HOLDS if measured == value else FAILS


RULES = {
    "gain": rule_gain,
    "more": rule_more,
    "little": rule_little,
    "near": rule_near,
    "at": rule_at,
    "equals": rule_equals,
}


# ---- Judging


def read_claims(path=HERE / "claims.csv"):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def evaluate(expression, names):
    result = eval(expression, {"__builtins__": {}}, names)  # noqa: S307 our own data
    return result if isinstance(result, Value) else Value(result)


def fill(cause, names):
    """The cause with its expressions in braces, "{latency('div.d'):.0f}", replaced."""

    def value(match):
        expression, _, form = match[1].partition(":")
        return format(float(evaluate(expression, names)), form or ".3g")

    try:
        return re.sub(r"\{([^}]*)\}", value, cause)
    except Missing as why:
        return f"the cause needs what was not measured: {why}"


def judge_claim(claim, names):
    row = {name: claim[name] for name in ("section", "claim", "unit")}
    row |= {"paper": "", "here": "", "uncertainty": "", "verdict": UNMEASURED, "cause": ""}
    try:
        if claim["value"]:
            value = evaluate(claim["value"], names)
            row["paper"] = f"{value:.6g}"
        else:
            value = None
        measured = evaluate(claim["measure"], names)
    except Missing as why:
        return row | {"cause": str(why)}
    name, *more = claim["rule"].split()
    row |= {"here": f"{measured:.6g}", "verdict": RULES[name](measured, value, *more)}
    if measured.uncertainty:
        row["uncertainty"] = f"{measured * measured.uncertainty:.2g}"
    if row["verdict"] != HOLDS:
        row["cause"] = fill(claim["cause"], names)
    return row


def judge(folder):
    """A row for each claim, in the order of the paper's sections."""
    names = Run(folder).names()
    return [judge_claim(claim, names) for claim in read_claims()]


# ---- What is printed


def conclude(folder, rows):
    """Sentences that compare the paper's result with this run's."""
    run = Run(folder)
    counts = Counter(row["verdict"] for row in rows)
    findings = [
        machines.compilers_of(Sheet(folder / "configs.csv")),
        f"claims of the paper: {len(rows)}; "
        + ", ".join(
            f"{counts[verdict]} {verdict}" for verdict in (HOLDS, WEAKER, FAILS, UNMEASURED)
        ),
    ]
    try:
        best = run.best_build(SCALAR)
        kernel, config = run.build(best)
        findings.append(
            f"paper: 1.93 x (float, clang-archnative, Zen 2); here {run.speedup('float@archnative'):.2f} x "
            f"(float, {run.build('float@archnative')[1]}); fastest of these kernels here: "
            f"{run.speedup(best):.2f} x ({kernel}, {config})"
        )
        exact = run.row("ladder", kernel="exact", isa="scalar")
        single = run.row("ladder", kernel="float", config=run.reference())
        findings.append(
            f"exact, the solver without steps: {number(exact['speedup']):.0f} x at an error of "
            f"{number(exact['pair_error_max']):.1e} from the limit of infinitely many steps; "
            f"float is {number(single['pair_error_max']):.1e} from pooltool's 1000 steps"
        )
    except Missing as why:
        findings.append(f"no speedup to conclude from: {why}")
    return findings


def print_row(row, out):
    """The claim in as many lines as it needs, numbers and verdict in the last, the cause below."""
    *first, last = textwrap.wrap(row["claim"], CLAIM_WIDTH)
    for line in first:
        print(f"  {line}", file=out)
    paper, measured = (row[name] and f"{float(row[name]):.5g}" for name in ("paper", "here"))
    if row["uncertainty"]:
        measured += f" ± {row['uncertainty']}"
    numbers = f"{paper or '-':>8} {measured or '-':>15} {row['unit']:<10}"
    print(f"  {last:<{CLAIM_WIDTH}} {numbers} {row['verdict']}", file=out)
    for line in textwrap.wrap(row["cause"], CLAIM_WIDTH + 34):
        print(f"      {line}", file=out)


def print_table(rows, out):
    head = f"{'paper':>8} {'here':>15} {'':<10} verdict"
    print(f"{'claim of the paper':<{CLAIM_WIDTH + 2}} {head}", file=out)
    section = None
    for row in rows:
        if row["section"] != section:
            section = row["section"]
            print(f"\n{section}", file=out)
        print_row(row, out)


def print_csv(rows, out):
    writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)


def arguments(words):
    parser = argparse.ArgumentParser(prog="study.paper", description=__doc__.partition("\n")[0])
    parser.add_argument(
        "--from", dest="source", type=Path, help="judge the CSV files of this folder"
    )
    parser.add_argument("--budget", type=float, default=60.0, help="seconds to measure otherwise")
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--csv", action="store_true", help="write the claims as CSV")
    parser.add_argument(
        "--record", metavar="NAME", help="add this machine to machines.csv under that name"
    )
    parser.add_argument(
        "--matrix",
        action="store_true",
        help="judge the claims for each compiler and target; the budget is for each",
    )
    options = parser.parse_args(words)
    if options.source and not options.source.is_dir():
        print(f"carom-lab paper: --from: there is no folder {options.source}", file=sys.stderr)
        sys.exit(2)
    return options


def measure_needed(folder, options):
    """The files that the claims are judged by."""
    of_report = argparse.Namespace(
        folder=folder, build=options.build.resolve(), budget=options.budget
    )
    with contextlib.redirect_stdout(sys.stderr):
        measure(of_report, [name for name in DATA if name in NEEDED])
    return [name for name in NEEDED if not (folder / f"{name}.csv").is_file()]


def main_of_matrix(options):
    """Builds, measures and judges the matrix; --from takes the files of one that was measured."""
    folder, missing = options.source, []
    if not folder:
        folder = options.build / "results" / "matrix"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        of_matrix = argparse.Namespace(
            folder=folder.resolve(), build=options.build.resolve(), budget=options.budget
        )
        with contextlib.redirect_stdout(sys.stderr):
            matrix.build_matrix(of_matrix.build)
            missing = matrix.measure(of_matrix, [name for name in DATA if name in NEEDED])
    folders = matrix.columns(folder)
    if not folders:
        raise matrix.NotBuilt(f"{folder} has no measured matrix")
    judged = {column: judge(folders[column]) for column in folders}
    if options.record:
        runs = [(folders[column], options.record, judged[column]) for column in folders]
        print(machines.record_and_show(runs), file=sys.stderr)
    (matrix.print_csv if options.csv else matrix.print_matrix)(judged, sys.stdout)
    if not options.source:
        print(f"carom-lab paper: the measurements are in {folder}", file=sys.stderr)
    if missing:
        print(f"carom-lab paper: not measured: {', '.join(missing)}", file=sys.stderr)
    return 1 if missing else 0


def main(words):
    options, missing = arguments(words), []
    if options.matrix:
        try:
            return main_of_matrix(options)
        except (matrix.NotBuilt, machines.Refusal) as why:
            print(f"carom-lab paper: --matrix: {why}", file=sys.stderr)
            return 2
    with tempfile.TemporaryDirectory() as work:
        folder = options.source or Path(work)
        if not options.source:
            missing = measure_needed(folder, options)
        rows = judge(folder)
        if options.record:
            try:
                print(machines.record_and_show([(folder, options.record, rows)]), file=sys.stderr)
            except machines.Refusal as why:
                print(f"carom-lab paper: --record: {why}", file=sys.stderr)
                return 2
        (print_csv if options.csv else print_table)(rows, sys.stdout)
        if not options.csv:
            print("", *conclude(folder, rows), *machines.summary(), sep="\n")
    if missing:
        print(f"carom-lab paper: not measured: {', '.join(missing)}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
