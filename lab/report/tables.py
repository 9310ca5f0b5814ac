"""The tables of the page: what stands in their cells, and the numbers that their captions quote.

A function makes a table from the sheets, by their names in contents.py, or raises Missing. Captions are in templates/page.html,
which takes the quoted numbers from `facts`. Cells are texts with a class of the page's style: "t" is text, "wrap" text that may
break, "paper" the seed paper's value, "" a number.
"""

import math
import re
from dataclasses import dataclass, field

from . import text
from .derive import default_config
from .sheet import Missing, number_of

# What the paper says in its section 4.3, at N = 1000: operations, the bound in cycles, cycles as measured; and its best speedup.
PAPER_BOUNDS = {"base": (77796.0, 77000.0, 85300.0), "double": (43829.0, 44000.0, 50200.0)}
PAPER_BEST = 1.93


@dataclass
class Table:
    heads: list  # (text, class)
    rows: list = field(default_factory=list)  # of lists of (text, class)
    facts: dict = field(default_factory=dict)


def heads(*names):
    """Head cells: "t:" before a name aligns it left, "p:" marks the paper's column."""
    kinds = {"t:": "t", "p:": "paper"}
    return [(name[2:], kinds[name[:2]]) if name[:2] in kinds else (name, "") for name in names]


def cells(*texts, **classes):
    """Cells by position; wrap=(1, 7) gives the class wrap to the second and the eighth."""
    kind = {place: name for name, places in classes.items() for place in places}
    return [(text, kind.get(place, "")) for place, text in enumerate(texts)]


def plain(s):
    """A count of the paper's, or nothing where it gives none."""
    return "" if s == "NA" else s


def crossed(sheet, down, across):
    """The values of two columns, whose every pair has a row, or nearly every one; else there is no table of them."""
    rows, columns = ([value for (value,) in sheet.groups(name)] for name in (down, across))
    if len(rows) * len(columns) > 4 * len(sheet.rows):
        raise Missing(f"{sheet.name} has {len(rows)} of {down} and {len(columns)} of {across}, but rows for few of their pairs")
    return rows, columns


# ---- Experiments


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
    given = {"measured", "predicted"}
    table = Table([("shot", "t"), ("outcome", "t")] + [(name, "paper" if name in given else "") for name in sources])
    for column, title, format in OUTCOMES:
        for shot in shots:
            row = [(shot, "t"), (title, "t")]
            for source in sources:
                here = sheet.first(shot=shot, source=source)
                number = here.number(column) if here else math.nan
                row.append((text.of(format, number), "paper" if source in given else ""))
            table.rows.append(row)
    return table


# ---- Verification


def largest(numbers):
    """The largest; NaN where one is NaN."""
    return max(numbers, key=lambda x: (math.isnan(x), x))


def verification(data):
    """One row for each kernel and reference: the worst of its builds."""
    sheet = data["verify"]
    sheet.needs("kernel", "reference", "cases", "identical", "max", "bound", "over_1e3", "over_1e2", "verdict")
    passed = sum(row["verdict"] == "pass" for row in sheet.rows)
    table = Table(
        heads("t:kernel", "t:reference", "builds", "identical", "largest error", "bound")
        + heads("> 0.1 %", "p:paper", "> 1 %", "p:paper", "t:"),
        facts={"passed": passed, "comparisons": len(sheet.rows)},
    )
    for (kernel, reference), rows in sheet.groups("kernel", "reference").items():
        worst = {name: largest([row.number(name) for row in rows]) for name in ("max", "over_1e3", "over_1e2")}
        identical = min(row.number("identical") for row in rows)
        good = all(row["verdict"] == "pass" for row in rows)
        table.rows.append(
            cells(
                *(kernel, reference, str(len(rows)), f"{text.count(identical)} of {rows[0]['cases']}"),
                *(text.general(worst["max"], 2), rows[0]["bound"]),
                *(text.count(worst["over_1e3"]), plain(rows[0]["paper_1e3"])),
                *(text.count(worst["over_1e2"]), plain(rows[0]["paper_1e2"]), "pass" if good else "fail"),
                **{"t": (0, 1, 10) if good else (0, 1), "paper": (7, 9), "t fail": () if good else (10,)},
            )
        )
    return table


# ---- Batches


def bytes_of(sheet, precision):
    """Bytes that a solver reads and writes for a pair, from bench's note "a pair is 208 bytes in and 96 out in double ..."."""
    match = re.search(r"(\d+) bytes in and (\d+) out in double", sheet.note("bytes") or "")
    whole = float(match[1]) + float(match[2]) if match else math.nan
    return whole / 2.0 if precision == "single" else whole


def batches(data):
    sheet, isas = data["ladder"], data["isas"]
    sheet.needs("kernel", "isa", "precision", "threads", "ns_median", "ns_spread", "speedup", "pair_error_max")
    table = Table(
        heads("t:kernel", "t:isa", "t:precision", "threads", "ns", "±", "speedup", "largest error", "GB/s", "times the copy"),
        facts={"what": sheet.note("batches") or "the cases over and over"},
    )
    shown = [(sheet, row) for row in sheet.rows] + [(isas, row) for row in isas.rows if row["steps"] != "0"]
    for source, row in shown:
        if row["isa"] == "scalar" or row["kernel"] == "copy":
            continue
        # Beside it the copy of as many bytes by as many threads; bench prints the one in the cache behind it.
        copy = source.first(kernel="copy", precision=row["precision"], threads=row["threads"])
        ns, floor = row.number("ns_median"), copy.number("ns_median") if copy else math.nan
        times = ns / floor if floor else math.nan
        rate = bytes_of(source, row["precision"]) / ns if ns else math.nan
        table.rows.append(
            cells(
                *(row["kernel"], row["isa"], row["precision"], row["threads"], text.nanoseconds(ns)),
                *(text.spread(row.number("ns_spread")), text.ratio(row.number("speedup"))),
                "the same bits" if row["pair_error_max"] == "0" else row["pair_error_max"],
                *(text.general(rate, 3), text.of("%.1f" if times < 10.0 else "%.0f", times)),
                t=(0, 1, 2),
            )
        )
    return table


# ---- Speedups


def compared(says, paper, ours, parent, parent_name):
    """How far our ratio is from the paper's, in words; "" if it gives neither number nor word. `parent` is the speedup of the
    kernel that this one improves on."""
    more, step = 100.0 * (ours / paper - 1.0) if paper else math.nan, 100.0 * (ours / parent - 1.0) if parent else math.nan
    if abs(more) < 2.5:
        within = 0.1 if abs(more) < 0.05 else math.ceil(10.0 * abs(more)) / 10.0
        return f"as in the paper, within {within:.1f} %"
    if not math.isnan(more):
        return f"{abs(more):.0f} % {'more' if more > 0.0 else 'less'} than the paper's"
    if math.isnan(step):
        return ""
    if says == "a little more":
        if step > 0.5:
            return f"gains {step:.1f} % on {parent_name}, as the paper says in words"
        changes = "changes nothing here" if step > -0.5 else "loses here"
        return f"{changes} ({step:+.1f} % on {parent_name}); the paper saw a little gain"
    if says.startswith("slower"):
        if ours < parent:
            return f"{100.0 * (parent / ours - 1.0) if ours else math.nan:.0f} % slower than {parent_name}, as the paper says in words"
        return f"{abs(100.0 * (parent / ours - 1.0)):.0f} % faster than {parent_name} here; the paper saw it slower"
    return ""


def improved_on(sheet, row):
    """The row of the parent or, for what the paper calls slower, of the scalar kernel that the vector kernels began from."""
    parent, seen = sheet.first(kernel=row["parent"]), set()
    while parent and row["paper_text"].startswith("slower") and parent["needs"] != "scalar" and parent["kernel"] not in seen:
        seen.add(parent["kernel"])
        parent = sheet.first(kernel=parent["parent"])
    return parent


def library_calls(ladder):
    return [row for row in ladder.rows if row["config"] == "library" and row["isa"] == "scalar"]


def speedups(data):
    sheet, ladder, kernels = data["speedup"], data["ladder"], data["kernels"]
    sheet.needs("kernel", "parent", "ns", "speedup", "paper_text")
    table = Table(
        heads("t:kernel", "t:idea", "ns", "±", "speedup", "±", "p:paper", "t:ours and the paper's"),
        facts={"config": default_config(ladder)},
    )
    for place, row in enumerate(sheet.rows):
        parent, kernel = improved_on(sheet, row), kernels.first(kernel=row["kernel"])
        above = parent.number("speedup") if parent else math.nan
        sentence = compared(
            row["paper_text"], number_of(row["paper"]), row.number("speedup"), above, parent["kernel"] if parent else ""
        )
        table.rows.append(
            cells(
                *(row["kernel"], kernel["idea"] if kernel else "", text.count(row.number("ns")), text.count(row.number("ns_spread"))),
                *(text.of("%.2f", row.number("speedup")), text.of("%.3f", row.number("speedup_spread"))),
                *(row["paper_text"], sentence if place > 0 else ""),
                **{"t": (0,), "wrap": (1, 7), "paper": (6,)},
            )
        )
    for row in library_calls(ladder):
        speedup = row.number("speedup")
        table.rows.append(
            cells(
                *(row["kernel"], f"the library, {row['isa']}, {row['precision']}", text.nanoseconds(row.number("ns_median"))),
                text.spread(row.number("ns_spread")),
                *(text.of("%.2f" if speedup < 100.0 else "%.4g", speedup), text.general(row.number("speedup_spread"), 2), "", ""),
                **{"t": (0,), "wrap": (1, 7), "paper": (6,)},
            )
        )
    return table


# ---- Configurations


def configurations(data):
    sheet = data["configs"]
    sheet.needs_numbers("speedup")
    sheet.needs("kernel", "config")
    kernels, builds = crossed(sheet, "kernel", "config")
    best = max(sheet.rows, key=lambda row: (not math.isnan(row.number("speedup")), row.number("speedup")))
    ours = best.number("speedup")
    flags = [(config, sheet.note(config)) for config in builds if sheet.note(config)]
    table = Table(
        heads("t:kernel", *builds),
        facts={"kernel": best["kernel"], "config": best["config"], "speedup": f"{ours:.2f}", "flags": flags}
        | {"paper": f"{PAPER_BEST:.2f}", "short": ours < PAPER_BEST},
    )
    for kernel in kernels:
        row = [(kernel, "t")]
        for config in builds:
            here = sheet.first(kernel=kernel, config=config)
            number = here.number("speedup") if here else math.nan
            row.append((text.of("%.2f", number), "best" if number == ours else ""))
        table.rows.append(row)
    return table


# ---- Operations and bounds


COUNTS = ["flops_add", "flops_mul", "flops_div", "flops_sqrt", "flops_fma", "rsqrt", "conversions"]


def operations(data):
    bounds, performance, kernels = data["bounds"], data["performance"], data["kernels"]
    bounds.needs("kernel", "compiler", *COUNTS, "flops_amd", "chain_cycles_zen2", "chain_cycles_native")
    compiler = bounds.rows[0]["compiler"]
    table = Table(
        heads("t:kernel", "add", "mul", "div", "sqrt", "fma", "estimates", "conversions", "sum", "p:paper")
        + heads("bound, Zen 2 (cycles)", "p:paper", "bound, measured (cycles)", "share", "p:paper"),
        facts={"compiler": compiler, "machine": bounds.note("machine") or "the processor at hand", "compared": []},
    )
    for row in bounds.rows:
        kernel = kernels.first(kernel=row["kernel"])
        if row["compiler"] != compiler or math.isnan(row.number("flops_amd")) or not (kernel and kernel["parent"]):
            continue
        timed = performance.first(kernel=row["kernel"], steps="1000")
        flops, bound, cycles = PAPER_BOUNDS.get(row["kernel"], (math.nan, math.nan, math.nan))
        known = row["kernel"] in PAPER_BOUNDS
        table.rows.append(
            cells(
                *(row["kernel"], *(text.count(row.number(name)) for name in COUNTS), text.count(row.number("flops_amd"))),
                text.count(flops) if known else "",
                *(text.count(row.number("chain_cycles_zen2")), text.count(bound) if known else ""),
                *(text.count(row.number("chain_cycles_native")), text.percent(timed.number("share_of_bound") if timed else math.nan)),
                text.percent(bound / cycles),
                t=(0,),
                paper=(9, 11, 14),
            )
        )
        if known:
            more = 100.0 * (row.number("flops_amd") / flops - 1.0)
            longer = 100.0 * (row.number("chain_cycles_zen2") / bound - 1.0)
            table.facts["compared"].append(
                (row["kernel"], f"{abs(more):.0f} % {'more' if more > 0.0 else 'fewer'}")
                + (f"{abs(longer):.0f} % {'higher' if longer > 0.0 else 'lower'}",)
            )
    return table


TABLES = {
    "experiments": experiments,
    "verification": verification,
    "batches": batches,
    "speedups": speedups,
    "configurations": configurations,
    "operations": operations,
}
