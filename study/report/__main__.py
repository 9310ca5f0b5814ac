"""The report: `tools/python -m study.report DIR` measures to CSV files, draws a figure of each by
gnuplot, and writes one page.

A file that cannot be had leaves its figures and tables out; the page says so in their place, and
the exit code is 1.
"""

import argparse
import math
import shutil
import sys
from pathlib import Path

import jinja2
import markupsafe

from study import paper
from study.report.data import DATA, measure
from study.report.pictures import draw
from study.report.sheets import ROOT, Sheet, complain, number, shown, write

HERE = Path(__file__).resolve().parent
# What is on the page, in its order. Of a figure: its CSV, its title, and whether the docs show
# it, in docs/figures, with its CSV in docs/figures/data.
CONTENTS = Sheet(HERE / "contents.csv").rows
FIGURES = {
    row["name"]: (row["source"], row["title"]) for row in CONTENTS if row["kind"] == "figure"
}
OF_DOCS = [row["name"] for row in CONTENTS if row["docs"] == "yes"]
# Files that are derived from others.
MADE_OF = {"speedup": ("kernels", "ladder"), "performance": ("cycles", "bounds")}
MACHINE = (
    "processor",
    "cores",
    "system",
    "core cycle",
    "counters",
    "pinning",
    "load before",
    "commit",
    "compiler",
    "flags",
    "date",
)
# Heads of columns where the name in the CSV would not be understood; of others the name.
HEADS = {
    "ns_median": "ns",
    "ns_spread": "± ns",
    "speedup_spread": "± speedup",
    "paper_text": "paper",
    "ours_over_paper": "here / paper",
    "max": "largest error",
    "over_1e3": "> 0.1 %, with floor",
    "strict_1e3": "> 0.1 %",
    "paper_1e3": "paper: > 0.1 %",
    "over_1e2": "> 1 %, with floor",
    "strict_1e2": "> 1 %",
    "paper_1e2": "paper: > 1 %",
    "paper_verdict": "by the paper's rule",
    "flops_add": "additions",
    "flops_mul": "products",
    "flops_div": "divisions",
    "flops_sqrt": "square roots",
    "flops_fma": "fused",
    "rsqrt": "estimates",
    "flops_amd": "AMD's sum",
    "paper_flops": "paper: sum",
    "chain_cycles_zen2": "longest chain, Zen 2",
    "paper_bound": "paper: longest chain",
    "mean_chain_cycles_zen2": "mean chain, Zen 2",
    "mean_chain_cycles_native": "mean chain, here",
    "share": "share %, Zen 2",
    "share_here": "share %, here",
    "paper_share": "paper: share %",
    "error_exact_median": "median error",
    "error_exact_max": "largest error",
}
# The seed paper's section 4.3, at N = 1000: operations, the bound in cycles, cycles as measured.
PAPER_BOUNDS = {"base": (77796, 77000, 85300), "double": (43829, 44000, 50200)}


# ---- Data


def derive_speedup(options, data):
    """The ladder's kernels in the configuration that bench notes: "reference kernel: base,
    clang-default, with as many steps". `paper` has the paper's number or NA, `paper_text` what it
    says.
    """
    ladder, names = data["ladder"], ["ns_spread", "speedup", "speedup_spread"]
    config = ladder.notes.get("reference kernel", ",?").split(",")[1].strip()
    rows = []
    for kernel in data["kernels"].rows:
        timed = ladder.first(kernel=kernel["kernel"], config=config) if kernel["parent"] else {}
        if timed:
            paper = number(kernel["paper"])
            rows.append(
                {name: kernel[name] for name in ("kernel", "parent", "needs")}
                | {"ns": timed["ns_median"]}
                | {name: timed[name] for name in names}
                | {"paper": kernel["paper"] if paper == paper else "NA"}
                | {
                    "paper_text": kernel["paper"],
                    "ours_over_paper": f"{number(timed['speedup']) / paper:.4g}",
                }
                | {"config": config, "idea": kernel["idea"]}
            )
    return write(options, "speedup", ladder.notes, rows)


def same_module(data, config):
    """Whether the counts are of the file that was timed; if not, the report says why it prints no
    fraction of the bound.
    """
    what = f"module {config}"
    timed, counted = (data[name].notes.get(what) for name in ("cycles", "bounds"))
    if timed is not None and timed == counted:
        return True
    complain(
        f"no share of the bound of {config}: bench timed the module "
        f"{timed or 'unknown'}, and the bounds are of {counted or 'unknown'}"
    )
    return False


def derive_performance(options, data):
    """Operations at N are those at N = 1000 and, for every step more or less, those of a step; the
    bound is a step's operations over the cycles of its longest chain, the mean over the cases that
    were timed. A cycle is a core cycle as bench measures it. Where the processor counted operations
    or cycles, its counts are used instead; the notes say which.
    """
    cycles, rows = data["cycles"], []
    same = {
        config: same_module(data, config)
        for config in sorted(
            {row["config"] for row in cycles.rows} & {row["config"] for row in data["bounds"].rows}
        )
    }
    counted = {
        name: bool(cycles.rows) and all(number(row.get(name)) > 0 for row in cycles.rows)
        for name in ("flops", "cycles")
    }
    notes = {
        "operations": "counted by the processor"
        if counted["flops"]
        else "of the machine code that was timed",
        "cycles": "counted by the processor"
        if counted["cycles"]
        else "processor time over that of an addition just before each sample",
    }
    for row in cycles.rows:
        count = data["bounds"].first(kernel=row["kernel"], config=row["config"])
        if not same.get(row["config"], False):
            continue
        steps, a_step = number(row["steps"]), number(count.get("per_step_flops_amd"))
        flops, cycle_count = (
            number(count.get("flops_amd")) + (steps - 1000) * a_step,
            number(row.get("core_cycles")),
        )
        bound, local_bound = (
            1000 * a_step / number(count.get(f"mean_chain_cycles_{machine}"))
            for machine in ("zen2", "native")
        )
        if counted["flops"]:
            flops = number(row["flops"])
        if counted["cycles"]:
            cycle_count = number(row["cycles"])
        named = {
            "flops": flops,
            "cycles": cycle_count,
            "flops_per_cycle": flops / cycle_count,
            "bound_flops_per_cycle": bound,
            "share_of_bound": flops / cycle_count / bound,
            "bound_here_flops_per_cycle": local_bound,
            "share_of_bound_here": flops / cycle_count / local_bound,
        }
        if bound == bound and flops == flops:
            rows.append(
                {name: row[name] for name in ("kernel", "config", "steps")}
                | {name: f"{x:.5g}" for name, x in named.items()}
            )
    return write(options, "performance", cycles.notes | notes, rows)


def operations(data):
    """The counts in the configuration that was timed, next to the paper's and the fraction of the
    bound at N = 1000, in per cent.
    """
    rows = []
    for row in data["bounds"].rows:
        flops, bound, paper_cycles = PAPER_BOUNDS.get(row["kernel"], (math.nan,) * 3)
        timed = data["performance"].first(kernel=row["kernel"], config=row["config"], steps="1000")
        rows.append(
            {
                **row,
                "paper_flops": flops,
                "paper_bound": bound,
                "share": 100 * number(timed.get("share_of_bound")) if timed else "NA",
                "share_here": 100 * number(timed.get("share_of_bound_here")) if timed else "NA",
                "paper_share": 100 * bound / paper_cycles,
            }
        )
    return [
        row for row in rows if row["config"] in {timed["config"] for timed in data["cycles"].rows}
    ]


def worst_of_builds(rows):
    worst = {}
    for row in rows:
        reference = row["reference"].removeprefix("reference-").removesuffix(".csv")
        row = {**row, "reference": reference}
        group = worst.setdefault((row["kernel"], row["reference"]), {**row, "builds": 0})
        group["builds"] += 1
        group["identical"] = min(group["identical"], row["identical"], key=number)
        for name in ("max", "over_1e3", "over_1e2", "strict_1e3", "strict_1e2"):
            group[name] = max(group[name], row[name], key=number)
        for name in ("verdict", "paper_verdict"):
            group[name] = min(group[name], row[name])  # fail before pass
    return list(worst.values())


def solvers(ladder):
    """Single calls with both slips, and collisions in lanes: what takes another way than a step
    after the other of one collision. The slowest first.
    """
    rows = [
        row
        for row in ladder.rows
        if row["kernel"] in ("base", "float", "exact", "fast") and row["isa"] == "scalar"
    ]
    rows += [row for row in ladder.rows if "_lanes" in row["kernel"]]
    return sorted(rows, key=lambda row: number(row["speedup"]))


def crossed(sheet, down, across, value):
    """A row for each value of one column, a column for each of another."""
    heads = dict.fromkeys(row[across] for row in sheet.rows)
    return [
        {down: name}
        | {head: sheet.first(**{down: name, across: head}).get(value) for head in heads}
        for name in dict.fromkeys(row[down] for row in sheet.rows)
    ]


# ---- The page


def write_page(options, data):
    """index.html from its template and its contents; returns the figures and tables that they name
    and is not there.
    """
    missing = []

    def picture(name):
        svg = options.folder / f"{name}.svg"
        if not svg.is_file():
            missing.append(name)
            return None
        text = svg.read_text(encoding="utf-8")
        return markupsafe.Markup(text[text.index("<svg") :])

    def cells(name, columns):
        """The heads and the rows of a table, of the columns named, or all."""
        rows = tables[name]
        if not rows:
            missing.append(name)
            return None
        heads = columns.split() if columns else list(rows[0])
        return [heads, *([shown(row.get(head)) for head in heads] for row in rows)]

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    ladder = data["ladder"]
    claims = paper.judge(options.folder)
    tables = {
        "speedups": data["speedup"].rows,
        "errors": worst_of_builds(data["verify"].rows),
        "operations": operations(data),
        "bounds": operations(data),
        "configurations": crossed(data["configs"], "kernel", "config", "speedup"),
        "experiments": data["experiments"].rows,
        "solvers": solvers(ladder),
    }
    page = environment.get_template("page.html").render(
        claims=claims,
        conclusion=paper.conclude(options.folder, claims),
        limits_of=paper.limits_of,
        rounded=rounded,
        picture=picture,
        cells=cells,
        is_number=lambda text: not math.isnan(number(text.replace(",", ""))),
        contents=CONTENTS,
        head_of=lambda name: HEADS.get(name, name.replace("_", " ")),
        machine=[(what, ladder.notes[what]) for what in MACHINE if what in ladder.notes],
        commands=[(f"{name}.csv", command) for name, (_, command) in DATA.items()],
    )
    (options.folder / "index.html").write_text(page, encoding="utf-8")
    return missing


def rounded(text):
    """Four significant digits; of large numbers those before the point."""
    value = number(text)
    if math.isnan(value):
        return text
    return f"{value:,.0f}" if abs(value) >= 1e4 else f"{value:.4g}"


def print_speedups(data):
    ladder = data["ladder"]
    print(
        f"\nspeedup over {ladder.notes.get('reference kernel', 'nothing').rpartition(', ')[0]}, {ladder.notes.get('processor', 'processor unknown')}"
    )
    for row in data["speedup"].rows:
        print(
            f"{row['kernel']:<17} {number(row['ns']):>9.0f} ns {number(row['speedup']):>9.2f}  the paper: {row['paper_text']}"
        )
    for row in ladder.rows:
        if row["config"] == "library" and row["isa"] == "scalar":
            print(
                f"{row['kernel']:<17} {number(row['ns_median']):>9.1f} ns {number(row['speedup']):>9.2f}  the library, slip: {row.get('slip', 'not noted')}"
            )


# ---- The command


def arguments(words):
    parser = argparse.ArgumentParser(
        prog="report", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "folder", metavar="DIR", type=Path, help="where the report goes; made if it is not there"
    )
    parser.add_argument(
        "--budget",
        type=float,
        default=110.0,
        metavar="SECONDS",
        help="how long to measure in all (default 110)",
    )
    parser.add_argument(
        "--from",
        dest="source",
        type=Path,
        metavar="DIR2",
        help="measure nothing: take the CSV files of DIR2",
    )
    parser.add_argument(
        "--build",
        default=ROOT / "build",
        metavar="DIR3",
        type=Path,
        help="folder of the programs (default build)",
    )
    parser.add_argument(
        "--docs",
        type=Path,
        metavar="DIR4",
        help="make the figures of the docs alone, into DIR4 and DIR4/data",
    )
    options = parser.parse_args(words)
    options.folder, options.build = options.folder.resolve(), options.build.resolve()
    if not 0.0 < options.budget <= 86400.0:
        parser.error(
            f"--budget is a number of seconds above 0, up to 86400, not {options.budget:g}"
        )
    if options.source and not options.source.is_dir():
        parser.error(f"--from: there is no folder {options.source}")
    for program in ("carom", "carom-lab"):
        if not options.source and not (options.build / program).is_file():
            parser.error(
                f"there is no program {options.build / program}; build it, or say with --build where it is"
            )
    if not shutil.which("gnuplot"):
        parser.error("gnuplot is not installed (Debian: gnuplot-nox)")
    return options


def main(words):
    options = arguments(words)
    options.folder.mkdir(parents=True, exist_ok=True)
    figures = [name for name in FIGURES if not options.docs or name in OF_DOCS]
    drawn_from = {FIGURES[figure][0] for figure in figures}
    sources = [
        name
        for name in DATA
        if not options.docs or any(name in MADE_OF.get(source, (source,)) for source in drawn_from)
    ]
    if options.source:
        for path in options.source.glob("*.csv"):
            if path.resolve().parent != options.folder:
                shutil.copy(path, options.folder)
    else:
        measure(options, sources)
    data = {name: Sheet(options.folder / f"{name}.csv") for name in DATA}
    data["speedup"], data["performance"] = (
        derive_speedup(options, data),
        derive_performance(options, data),
    )
    for name in figures:
        source, title = FIGURES[name]
        draw(options.folder, name, source, title, HERE.parent / "figures" / f"{name}.gp")
    if options.docs:
        (options.docs / "data").mkdir(exist_ok=True)
        for name in OF_DOCS:
            shutil.copy(options.folder / f"{name}.svg", options.docs)
            shutil.copy(options.folder / f"{FIGURES[name][0]}.csv", options.docs / "data")
        return 0
    missing = write_page(options, data)
    print_speedups(data)
    print(f"\nreport: {options.folder / 'index.html'}")
    if missing:
        complain(f"not there: {', '.join(missing)}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
