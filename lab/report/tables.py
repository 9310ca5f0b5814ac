"""The tables of the page: what stands in their cells, and the numbers that their captions quote.

A function makes a table from the sheets, by their names in contents.py, or raises Missing. Captions are in templates/page.html,
which takes the quoted numbers from `facts`. A cell is a text with a class of the page's style: "t" is text, "wrap" text that may
break, "paper" the seed paper's value, "" a number. NA is what is not known.
"""

import math
import re

from .derive import default_config, ratio
from .sheet import Missing

# What the paper says in its section 4.3, at N = 1000: operations, the bound in cycles, cycles as measured; and its best speedup.
PAPER_BOUNDS = {"base": (77796.0, 77000.0, 85300.0), "double": (43829.0, 44000.0, 50200.0)}
PAPER_BEST = 1.93


def number(format, x):
    return "NA" if math.isnan(x) else format % x


def count(x):
    """Whole, grouped by thousands."""
    return "NA" if math.isnan(x) else f"{x:,.0f}"


def time(x, digits=4):
    """With so many digits, or whole and grouped by thousands."""
    return count(x) if x >= min(1000.0, 10.0**digits) else number(f"%.{digits}g", x)


def percent(x):
    """A share; nothing where there is none."""
    return "" if math.isnan(x) else f"{100.0 * x:.1f} %"


def known(s):
    """A count of the paper's, or nothing where it gives none."""
    return "" if s == "NA" else s


def table(columns, rows, **facts):
    """Of columns (head, class, text of a row)."""
    cells = [[(text(row), kind) for _, kind, text in columns] for row in rows]
    return {"heads": [(head, kind) for head, kind, _ in columns], "rows": cells, "facts": facts}


def crossed(sheet, down, across):
    """The values of two columns, whose every pair has a row, or nearly every one; else there is no table of them."""
    rows, columns = ([value for (value,) in sheet.groups(name)] for name in (down, across))
    if len(rows) * len(columns) > 4 * len(sheet.rows):
        raise Missing(f"{sheet.name} has {len(rows)} of {down} and {len(columns)} of {across}, but rows for few of their pairs")
    return rows, columns


def at(sheet, column, **place):
    row = sheet.first(**place)
    return row.number(column) if row else math.nan


OUTCOMES = [
    ("v_cue", "cue ball, m/s", "%.3f"),
    ("v_object", "object ball, m/s", "%.3f"),
    ("angle_cue_deg", "cue ball, degrees", "%.2f"),
    ("angle_object_deg", "object ball, degrees", "%.2f"),
]


def experiments(data):
    sheet = data["experiments"]
    sheet.needs("shot", "source", *(column for column, _, _ in OUTCOMES))
    shots, sources = crossed(sheet, "shot", "source")
    columns = [("shot", "t", lambda row: row[0]), ("outcome", "t", lambda row: row[2])]
    for source in sources:
        kind = "paper" if source in ("measured", "predicted") else ""
        columns.append((source, kind, lambda row, source=source: number(row[3], at(sheet, row[1], shot=row[0], source=source))))
    return table(columns, [(shot, *outcome) for outcome in OUTCOMES for shot in shots])


def largest(rows, name):
    """The largest; NaN where one is NaN."""
    return max((row.number(name) for row in rows), key=lambda x: (math.isnan(x), x))


def verification(data):
    """One row for each kernel and reference: the worst of its builds."""
    sheet = data["verify"]
    sheet.needs("kernel", "reference", "cases", "identical", "max", "bound", "over_1e3", "over_1e2", "verdict")
    columns = [
        ("kernel", "t", lambda rows: rows[0]["kernel"]),
        ("reference", "t", lambda rows: rows[0]["reference"]),
        ("builds", "", lambda rows: str(len(rows))),
        ("identical", "", lambda rows: f"{count(min(row.number('identical') for row in rows))} of {rows[0]['cases']}"),
        ("largest error", "", lambda rows: number("%.2g", largest(rows, "max"))),
        ("bound", "", lambda rows: rows[0]["bound"]),
        ("> 0.1 %", "", lambda rows: count(largest(rows, "over_1e3"))),
        ("paper", "paper", lambda rows: known(rows[0]["paper_1e3"])),
        ("> 1 %", "", lambda rows: count(largest(rows, "over_1e2"))),
        ("paper", "paper", lambda rows: known(rows[0]["paper_1e2"])),
        ("", "t", lambda rows: "pass" if all(row["verdict"] == "pass" for row in rows) else "FAIL"),
    ]
    passed = sum(row["verdict"] == "pass" for row in sheet.rows)
    return table(columns, sheet.groups("kernel", "reference").values(), passed=passed, comparisons=len(sheet.rows))


def batches(data):
    ladder, isas = data["ladder"], data["isas"]
    ladder.needs("kernel", "isa", "precision", "threads", "ns_median", "ns_spread", "speedup", "pair_error_max")

    def rate(row):
        """GB/s, from bench's note "a pair is 208 bytes in and 96 out in double ..."."""
        match = re.search(r"(\d+) bytes in and (\d+) out in double", row.sheet.note("bytes") or "")
        whole = float(match[1]) + float(match[2]) if match else math.nan
        return ratio(whole / (2.0 if row["precision"] == "single" else 1.0), row.number("ns_median"))

    def over_copy(row):
        """Beside it the copy of as many bytes by as many threads; bench prints the one in the cache behind it."""
        floor = at(row.sheet, "ns_median", kernel="copy", precision=row["precision"], threads=row["threads"])
        return ratio(row.number("ns_median"), floor)

    columns = [(name, "t", lambda row, name=name: row[name]) for name in ("kernel", "isa", "precision")] + [
        ("threads", "", lambda row: row["threads"]),
        ("ns", "", lambda row: time(row.number("ns_median"))),
        ("±", "", lambda row: time(row.number("ns_spread"), 2)),
        ("speedup", "", lambda row: time(row.number("speedup"))),
        ("largest error", "", lambda row: "the same bits" if row["pair_error_max"] == "0" else row["pair_error_max"]),
        ("GB/s", "", lambda row: number("%.3g", rate(row))),
        ("times the copy", "", lambda row: time(over_copy(row), 3)),
    ]
    shown = ladder.rows + [row for row in isas.rows if row["steps"] != "0"]
    shown = [row for row in shown if row["isa"] != "scalar" and row["kernel"] != "copy"]
    return table(columns, shown, what=ladder.note("batches") or "the cases over and over")


def library_calls(ladder):
    return [row for row in ladder.rows if row["config"] == "library" and row["isa"] == "scalar"]


def speedups(data):
    sheet, ladder, kernels = data["speedup"], data["ladder"], data["kernels"]
    sheet.needs("kernel", "ns", "speedup", "paper", "paper_text")

    def idea(row):
        kernel = kernels.first(kernel=row["kernel"])
        return kernel["idea"] if kernel and row.sheet is sheet else f"the library, {row['isa']}, {row['precision']}"

    columns = [
        ("kernel", "t", lambda row: row["kernel"]),
        ("idea", "wrap", idea),
        ("ns", "", lambda row: time(row.number("ns" if row.sheet is sheet else "ns_median"))),
        ("±", "", lambda row: time(row.number("ns_spread"), 2)),
        ("speedup", "", lambda row: number("%.2f", row.number("speedup"))),
        ("±", "", lambda row: number("%.2g", row.number("speedup_spread"))),
        ("paper", "paper", lambda row: row["paper_text"]),
        ("ours / paper", "", lambda row: known(number("%.2f", ratio(row.number("speedup"), row.number("paper"))))),
    ]
    return table(columns, sheet.rows + library_calls(ladder), config=default_config(ladder))


def configurations(data):
    sheet = data["configs"]
    sheet.needs_numbers("speedup")
    sheet.needs("kernel", "config")
    kernels, builds = crossed(sheet, "kernel", "config")
    best = max(sheet.rows, key=lambda row: (not math.isnan(row.number("speedup")), row.number("speedup")))
    columns = [("kernel", "t", lambda kernel: kernel)]
    for config in builds:
        columns.append((config, "", lambda kernel, config=config: number("%.2f", at(sheet, "speedup", kernel=kernel, config=config))))
    ours = best.number("speedup")
    return table(
        columns, kernels, kernel=best["kernel"], config=best["config"], speedup=f"{ours:.2f}", paper=f"{PAPER_BEST:.2f}",
        flags=[(config, sheet.note(config)) for config in builds if sheet.note(config)],
    )  # fmt: skip


COUNTS = ["add", "mul", "div", "sqrt", "fma"]


def operations(data):
    bounds, performance, kernels = data["bounds"], data["performance"], data["kernels"]
    counts = [(name, f"flops_{name}") for name in COUNTS] + [("estimates", "rsqrt"), ("conversions", "conversions")]
    bounds.needs("kernel", "config", *(column for _, column in counts), "flops_amd", "chain_cycles_zen2", "chain_cycles_native")

    def paper(row, place):
        return PAPER_BOUNDS.get(row["kernel"], (math.nan,) * 3)[place]

    columns = [("kernel", "t", lambda row: row["kernel"])]
    columns += [(head, "", lambda row, column=column: count(row.number(column))) for head, column in counts]
    columns += [
        ("sum", "", lambda row: count(row.number("flops_amd"))),
        ("paper", "paper", lambda row: known(count(paper(row, 0)))),
        ("bound, Zen 2 (cycles)", "", lambda row: count(row.number("chain_cycles_zen2"))),
        ("paper", "paper", lambda row: known(count(paper(row, 1)))),
        ("bound, here (cycles)", "", lambda row: count(row.number("chain_cycles_native"))),
        ("share", "", lambda row: percent(at(performance, "share_of_bound", kernel=row["kernel"], steps="1000"))),
        ("paper", "paper", lambda row: percent(ratio(paper(row, 1), paper(row, 2)))),
    ]

    def of_ladder(row):
        kernel = kernels.first(kernel=row["kernel"])
        return bool(kernel and kernel["parent"]) and not math.isnan(row.number("flops_amd"))

    config = bounds.rows[0]["config"]
    return table(columns, [row for row in bounds.rows if of_ladder(row)], code=bounds.note(config) or config)


TABLES = {
    "experiments": experiments,
    "verification": verification,
    "batches": batches,
    "speedups": speedups,
    "configurations": configurations,
    "operations": operations,
}
