"""published.py LIBRARY MEASURED.csv [csv], which `carom-lab published` runs: values that others
measured or stated, compared with those that carom computes.

The column `computed` of a row is a call of a function of study/lab/computed/ with numbers and texts
in quotes, which yields carom's value, or a pair with its error; "-" where nothing of carom can be
compared, which the conditions explain; empty where the row is not printed. Bounds that a row lacks
are two of its errors either way. A row without bounds and error is printed and not judged. The
verdict that is wanted is the column `verdict`.
"""

import ast
import csv
import sys
from math import inf, isnan, sqrt
from statistics import median

from study.lab.computed import breaks, constants, pockets, rails, strikes, systems, two_balls

HEADS = [
    "subject",
    "quantity",
    "published",
    "low",
    "high",
    "unit",
    "carom",
    "error",
    "deviation",
    "verdict",
    "conditions",
    "source",
]
LINE = "{:<8.8} {:<42.42} {:>9} {:>7} {:>7} {:>9} {:<7} {:>6} {:<7} {}"


def functions():
    found = {}
    for module in (breaks, constants, pockets, rails, strikes, systems, two_balls):
        for name, value in vars(module).items():
            if getattr(value, "__module__", None) == module.__name__:
                found[name] = value
    return found


FUNCTIONS = functions()


def computed(text):
    """carom's value and its error."""
    call = ast.parse(text, mode="eval").body
    if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Name) or call.keywords:
        raise ValueError(text)
    value = FUNCTIONS[call.func.id](*map(ast.literal_eval, call.args))
    value, error = value if isinstance(value, tuple) else (value, 0)
    if isnan(value):
        raise ValueError(text)
    return value, error


def bounds_of(row):
    """The bounds of a row, of which either may be infinite, and its error; None if it has none."""
    low, high = float(row["low"] or -inf), float(row["high"] or inf)
    error = float(row["error"]) if row["error"] else None
    if error is not None and low == -inf and high == inf:
        low, high = float(row["value"]) - 2 * error, float(row["value"]) + 2 * error
    if error is None and low > -inf and high < inf:
        error = 0.25 * (high - low)
    return low, high, error


def verdict_of(value, error, low, high):
    """An error of carom's own value counts: a range of conditions that the source leaves open."""
    if low == -inf and high == inf:
        return "-"
    if value + error < low:
        return "low"
    if value - error > high:
        return "high"
    return "ok"


def judged(row):
    """carom's value, its error, the deviation in errors of the source, and the verdict."""
    if row["computed"] == "-":
        return None, 0, None, "-"
    value, error = computed(row["computed"])
    low, high, unit = bounds_of(row)
    deviation = None
    if unit:
        middle = 0.5 * (low + high)
        if row["error"]:
            middle = float(row["value"])
        deviation = (value - middle) / unit
    return value, error, deviation, verdict_of(value, error, low, high)


def cells_of(row, value, error, deviation, verdict):
    return [
        row["subject"],
        row["quantity"],
        row["value"],
        row["low"],
        row["high"],
        row["unit"],
        "-" if value is None else f"{value:.4g}",
        f"{error:.2g}" if error else "",
        "" if deviation is None else f"{deviation:+.1f}",
        verdict,
        row["conditions"],
        row["source"],
    ]


def print_row(cells):
    subject, quantity, published, low, high, unit, value, _, deviation, verdict, conditions, _ = (
        cells
    )
    print(
        LINE.format(
            subject, quantity, published, low, high, value, unit, deviation, verdict, conditions
        )
    )


def print_summary(rows):
    """Of each subject: rows, how many are judged and within their bounds, and the deviations in
    errors: rms, and the median of their sizes.
    """
    print()
    print("subject    rows  judged  within     rms  median")
    for subject in dict.fromkeys(row[0] for row in rows):
        of_subject = [row for row in rows if row[0] == subject and row[2] != "-"]
        within = sum(verdict == "ok" for _, _, verdict in of_subject)
        sizes = [abs(deviation) for _, deviation, _ in of_subject if deviation is not None] or [0]
        rms = sqrt(sum(size * size for size in sizes) / len(sizes))
        count = sum(row[0] == subject for row in rows)
        print(
            f"{subject:<8} {count:>6} {len(of_subject):>7} {within:>7} {rms:>7.1f} {median(sizes):>7.1f}"
        )


def main(path, as_csv):
    out, code, summary = csv.writer(sys.stdout, lineterminator="\n"), 0, []
    if as_csv:
        out.writerow(HEADS)
    else:
        print(LINE.format(*HEADS[:5], "carom", "unit", "errors", "verdict", "conditions"))
    with open(path, encoding="utf-8", newline="") as file:
        for row in (rows := csv.DictReader(file)):
            if row["computed"] == "":
                continue
            try:
                value, error, deviation, verdict = judged(row)
            except (ValueError, TypeError, KeyError, SyntaxError):
                print(
                    f"carom-lab: {path}:{rows.line_num}: not a row of {len(rows.fieldnames)} columns with bounds and a function",
                    file=sys.stderr,
                )
                return 2
            code |= row["verdict"] == "ok" != verdict
            summary.append((row["subject"], deviation, verdict))
            cells = cells_of(row, value, error, deviation, verdict)
            if as_csv:
                out.writerow(cells)
            else:
                print_row(cells)
    if not as_csv and summary:
        print_summary(summary)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[2], "csv" in sys.argv[3:]))
