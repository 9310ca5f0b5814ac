"""The claims of the seed paper, judged by a run: `carom-lab paper`, or `tools/python -m study.paper`.

claims.csv has a claim a row:

    paper        the paper's number; empty where it gives an order or a word only
    measure      what this run has for it: a function of measures.py and its words
    low, high    the limits between which the claim holds, a border itself included; empty: none
    reason       where the limits come from
    direction    of a claim such as "1.65 times as fast", the number beyond which it is true at all

The limits were fixed before the run, by the same reason for all claims of a kind: the last digit
that the paper gives where a number belongs to the processor; 13 %, by which rewrites of one kernel
differ, where it depends on how the kernel is written; the border between two orders, where the
paper gives the order only. A verdict compares them with the measured interval, which is the
measured number and its uncertainty to both sides:

    holds                  the interval is between the limits
    indistinguishable      a limit is within the interval
    weaker                 the claim has a direction, the interval has it, and is short of the limits
    does not hold here     the interval is outside of the limits in another way
    not measurable here    a file, a compiler or a counter is missing

The uncertainty of a ratio of times is twice the standard error of its median, and half a per cent,
by which such ratios differ between runs. Counts have none.

causes.csv has what can explain that a claim does not hold: the claim, a predicate over the same
run, and a text. A predicate compares measures: "here < low and latency convert < 2.5", where
`here` is the measured number. A cause is printed where its predicate is true beyond the
uncertainty, otherwise the cause is unknown.

related.csv has the claims of other studies of the same algorithm, in the same columns. They are a
second table, and are not counted with the paper's.
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
from pathlib import Path

from study import machines, matrix
from study.measures import Missing, Run, Value, measure, speedup
from study.report.data import DATA
from study.report.data import measure as measure_files
from study.report.sheets import ROOT, Sheet, number

HERE = Path(__file__).resolve().parent
HOLDS, INDISTINGUISHABLE, WEAKER, FAILS, UNMEASURED = machines.VERDICTS_COUNTED
UNKNOWN = "cause unknown"
CLAIM_WIDTH = 58

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


# ---- The rule


def limit(text, without):
    """A limit of claims.csv, or `without` where the cell is empty."""
    return float(text) if text else without


def verdict_of(measured, low, high, direction):
    """The verdict on a measured Value; `direction` is nan where the claim has none."""
    if low <= measured.least and measured.most <= high:
        return HOLDS
    if measured.least <= low <= measured.most or measured.least <= high <= measured.most:
        return INDISTINGUISHABLE
    is_short = direction < measured.least and measured.most < low
    return WEAKER if is_short else FAILS


# ---- Causes


def value_of(term, run, known):
    """A number, one of `known`, or a measure of the run."""
    if term in known:
        return known[term]
    value = number(term)
    return measure(run, term) if math.isnan(value) else Value(value)


def is_true(predicate, run, known):
    """Whether each comparison is true beyond the uncertainty; not where something is missing."""
    for comparison in predicate.split(" and "):
        first, sign, second = re.fullmatch(r"(.+) ([<>]) (.+)", comparison).groups()
        try:
            values = [value_of(term, run, known) for term in (first, second)]
        except Missing:
            return False
        smaller, larger = values if sign == "<" else reversed(values)
        if not smaller.most < larger.least:
            return False
    return True


def fill(text, run, known):
    """The text with its measures in braces, "{latency div.d:.0f}", replaced."""

    def shown(match):
        term, _, form = match[1].partition(":")
        return format(float(value_of(term, run, known)), form)

    return re.sub(r"\{([^}]*)\}", shown, text)


def causes_of(claim, run, known, causes):
    """The texts of the claim's causes that are true in this run."""
    found = [
        fill(cause["text"], run, known)
        for cause in causes
        if cause["claim"] == claim["id"] and is_true(cause["predicate"], run, known)
    ]
    return "; ".join(found) or UNKNOWN


# ---- Judging


def read_table(name):
    """The rows of a CSV of this folder without its comments."""
    with open(HERE / name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def read_claims(name="claims.csv"):
    return read_table(name)


def read_causes():
    return read_table("causes.csv")


def judge_claim(claim, run, causes):
    columns = ("id", "section", "claim", "paper", "unit", "low", "high", "reason")
    row = {name: claim[name] for name in columns}
    row |= {"here": "", "uncertainty": "", "verdict": UNMEASURED, "cause": ""}
    try:
        measured = measure(run, claim["measure"])
    except Missing as why:
        return row | {"cause": str(why)}
    low, high = limit(claim["low"], -math.inf), limit(claim["high"], math.inf)
    verdict = verdict_of(measured, low, high, limit(claim["direction"], math.nan))
    row |= {"here": f"{measured:.6g}", "verdict": verdict}
    if measured.uncertainty:
        row["uncertainty"] = f"{measured.uncertainty:.2g}"
    if verdict in (WEAKER, FAILS):
        known = {"here": measured, "low": Value(low), "high": Value(high)}
        row["cause"] = causes_of(claim, run, known, causes)
    return row


def judge(folder, claims="claims.csv"):
    """A row for each claim, in the order of the paper's sections."""
    run, causes = Run(folder), read_causes()
    return [judge_claim(claim, run, causes) for claim in read_claims(claims)]


# ---- What is printed


def conclude(folder, rows):
    """Sentences that compare the paper's result with this run's."""
    run = Run(folder)
    verdicts = [row["verdict"] for row in rows]
    findings = [
        machines.compilers_of(Sheet(folder / "configs.csv")),
        f"claims of the paper: {len(rows)}; {machines.counted(verdicts)}",
    ]
    try:
        best = run.best_build()
        kernel, config = run.build(best)
        findings.append(
            f"paper: 1.93 x (float, clang-archnative, Zen 2); here {speedup(run, 'float@archnative'):.2f} x "
            f"(float, {run.build('float@archnative')[1]}); fastest of these kernels here: "
            f"{speedup(run, best):.2f} x ({kernel}, {config})"
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


def limits_of(row):
    """The limits as a text."""
    if not row["low"]:
        return f"<= {row['high']}"
    return f"{row['low']} .. {row['high']}" if row["high"] else f">= {row['low']}"


def print_row(row, out):
    """The claim in as many lines as it needs, numbers and verdict in the last, the cause below."""
    *first, last = textwrap.wrap(row["claim"], CLAIM_WIDTH)
    for line in first:
        print(f"  {line}", file=out)
    paper, measured = (row[name] and f"{float(row[name]):.5g}" for name in ("paper", "here"))
    if row["uncertainty"]:
        measured += f" ± {row['uncertainty']}"
    numbers = f"{paper or '-':>8} {limits_of(row):>15} {measured or '-':>15} {row['unit']:<10}"
    print(f"  {last:<{CLAIM_WIDTH}} {numbers} {row['verdict']}", file=out)
    for line in textwrap.wrap(row["cause"], CLAIM_WIDTH + 50):
        print(f"      {line}", file=out)


def print_table(rows, out, title="claim of the paper"):
    head = f"{'paper':>8} {'limits':>15} {'here':>15} {'':<10} verdict"
    print(f"{title:<{CLAIM_WIDTH + 2}} {head}", file=out)
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
        measure_files(of_report, [name for name in DATA if name in NEEDED])
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
            print()
            print_table(judge(folder, claims="related.csv"), sys.stdout, "claim of related work")
            print("", *conclude(folder, rows), *machines.summary(), sep="\n")
    if missing:
        print(f"carom-lab paper: not measured: {', '.join(missing)}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
