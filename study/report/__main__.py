"""The report: `tools/python -m study.report DIR` measures to CSV files, draws a figure of each by
gnuplot, and writes one page.

A file that cannot be had leaves its figures and tables out; the page says so in their place, and
the exit code is 1.
"""

import argparse
import csv
import hashlib
import json
import math
import os
import re
import shlex
import shutil
import subprocess
import sys
from html import escape
from pathlib import Path

import jinja2
import markupsafe

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
STEPS = "10,20,50,100,200,500,1000,2000,5000,10000"
SCALAR = "base,rsqrt,recmass,cse,reorder,sepwhile,double,float"
FIVE = "base,double,float,double_vec,float_vec"
SIZES = "1,2,4,8,16,32,64,256,1024,4096,16384,65536,262144"

# NAME.csv: its share of the budget in per cent, 0 for what is computed; the command, to which `-o
# NAME.csv` is added.
DATA = {
    "kernels": (0, "carom-lab kernels --csv"),
    "experiments": (0, "carom-lab experiments --csv"),
    "trace": (0, "carom-lab trace --id pooltool-135"),
    "verify": (0, "carom-lab verify --csv"),
    "growth-5000": (
        0,
        "carom-lab verify --kernel float --config default --steps 5000 --csv",
    ),
    "ladder": (20, "carom-lab bench --csv --spread --counters"),
    "steps": (17, f"carom-lab bench --kernel {FIVE} --steps {STEPS} --csv --spread"),
    "accuracy": (
        17,
        f"carom-lab bench --kernel exact,euler,double,float --isa scalar,best --steps {STEPS},20000,50000 --csv --errors",
    ),
    "configs": (18, "carom-lab bench --config all --csv --spread --counters"),
    "cycles": (
        11,
        f"carom-lab bench --kernel {FIVE} --config zen2 --steps {STEPS} --csv --spread --counters",
    ),
    "bounds": (0, "tools/python -m study.bounds"),
    "operations": (0, f"tools/python -m study.bounds --kernel {SCALAR} --steps 100"),
    "isas": (
        9,
        "carom-lab bench --kernel exact,fast,euler --batch --threads 1 --pairs 4080 --csv --spread",
    ),
    "batch": (
        8,
        f"carom-lab bench --kernel exact --isa scalar,best --threads all --pairs {SIZES} --csv --spread",
    ),
}
# NAME.svg: its CSV and its title. Captions are in page.html.
FIGURES = {
    "accuracy": ("accuracy", "Error against time"),
    "speedup": ("speedup", "Cumulative speedup of the scalar kernels"),
    "runtime": ("steps", "Run time over the number of steps"),
    "performance": ("performance", "Floating point operations per cycle"),
    "trace": ("trace", "The course of one collision"),
    "isas": ("isas", "Batches by instruction set and precision"),
    "batch": ("batch", "Throughput of the exact solver over batch size and threads"),
    "cushion": ("cushion", "A ball and a cushion: rebound, a fine sweep, jumps"),
    "hops": ("hops", "How high the cue ball hops, by the elevation of the butt"),
}
# Pictures that `carom` draws by itself.
DRAWN = {
    "break": "carom shoot --plot {} -o /dev/null data/break-nineball.jsonl",
    "rule-30": "carom hit --cut 1:0.02ball --spin follow,stun --quantity rolling-deflection --plot {}",
    "throw": "carom hit --cut 0:80 --speed 1,3,7mph --plot {}",
    "rebound": "carom rail --model mathavan --angle 0:75 --side -50,0,50% --friction 0.3 --plot {}",
    "corner-five": "carom shoot --table threecushion --cue 0.1,0.1 --to 4d,7d:4d,6d:4d,5d:4d,4d --tip=-0.3,0.2 --speed 3.5 --time-most 2.2 --plot {} -o /dev/null",
    "english": "carom rail --model mathavan --angle 30,45,60 --side -100:100% --quantity rolling-rebound --plot {}",
    "cuts": "carom shoot --cue 0.6,0.8 --balls 0.5,1.6 --at-ball 1 --cut 10,25,40 --tip 0.2,-0.3 --plot {} -o /dev/null",
}
# What the docs show, in docs/figures, with the CSV files beside them in docs/figures/data.
OF_DOCS = ("accuracy", "runtime", "isas", "batch", "cushion", "hops")
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
# What must not depend on the machine is computed with instructions that all have.
PLAIN = {**os.environ, "CAROM_ISA": "plain"}
# The seed paper's section 4.3, at N = 1000: operations, the bound in cycles, cycles as measured.
PAPER_BOUNDS = {"base": (77796, 77000, 85300), "double": (43829, 44000, 50200)}


def complain(message):
    print(f"report: {message}", file=sys.stderr, flush=True)


class Sheet:
    """A measured CSV: notes {what: text} of its lines "# what: text", and rows, a dictionary each."""

    def __init__(self, path):
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        notes = [line[1:].strip().partition(": ") for line in lines if line.startswith("#")]
        self.notes = {what: text for what, _, text in reversed(notes)}
        self.rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))

    def first(self, **wanted):
        return next(
            (
                row
                for row in self.rows
                if all(row.get(name) == value for name, value in wanted.items())
            ),
            {},
        )


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return math.nan


def shown(text):
    """A number with four digits, from 1000 on whole and grouped; nothing for NA; other text as it
    is.
    """
    x = number(text)
    return (
        ""
        if text in (None, "NA", "nan")
        else str(text)
        if x != x
        else f"{x:,.0f}"
        if abs(x) >= 1000
        else f"{x:.4g}"
    )


# ---- Data


def run(command, options, *more, environment=None):
    """Runs a program of the build, or a Python module of the tree on that build."""
    program, *words = shlex.split(command)
    start = [options.build / program]
    if program == "tools/python":
        start = [sys.executable]
        words += ["--build", options.build]
    return subprocess.run(
        [*start, *words, *more],
        cwd=ROOT,
        stdout=subprocess.DEVNULL,
        env=environment,
    ).returncode in (0, 1)


def measure(options, names):
    whole = sum(DATA[name][0] for name in names)
    for name in names:
        share, command = DATA[name]
        target = options.folder / f"{name}.csv"
        budget = ["--budget", f"{options.budget * share / whole:.4g}"] if share else []
        print(f"{target.name}: {command}", flush=True)
        if not run(command, options, *budget, "--output", target):
            target.unlink(missing_ok=True)


def write(options, name, notes, rows):
    """NAME.csv of rows, dictionaries with the same names; returns the sheet."""
    target = options.folder / f"{name}.csv"
    if rows:
        with open(target, "w", encoding="utf-8", newline="") as out:
            out.writelines(f"# {what}: {text}\n" for what, text in notes.items())
            csv.writer(out, lineterminator="\n").writerows(
                [rows[0].keys(), *(row.values() for row in rows)]
            )
    return Sheet(target)


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
    share of the bound.
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
    bound is a step's operations over the cycles of its longest chain. A cycle is a core cycle as
    bench measures it. Where the processor counted operations or cycles, its counts are used
    instead; the notes say which.
    """
    cycles, rows = data["cycles"], []
    same = {
        config: same_module(data, config)
        for config in sorted(
            {row["config"] for row in cycles.rows} & {row["config"] for row in data["bounds"].rows}
        )
    }
    cycle = number(cycles.notes.get("core cycle", "").split(" ")[0])
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
        else f"time of the clock over {cycles.notes.get('core cycle', 'NA')}, the time of an addition",
    }
    for row in cycles.rows:
        count = data["bounds"].first(kernel=row["kernel"], config=row["config"])
        if not same.get(row["config"], False):
            continue
        steps, a_step = number(row["steps"]), number(count.get("per_step_flops_amd"))
        flops, taken = (
            number(count.get("flops_amd")) + (steps - 1000) * a_step,
            number(row["ns_median"]) / cycle,
        )
        bound, here = (
            1000 * a_step / number(count.get(f"chain_cycles_{machine}"))
            for machine in ("zen2", "native")
        )
        if counted["flops"]:
            flops = number(row["flops"])
        if counted["cycles"]:
            taken = number(row["cycles"])
        named = {
            "flops": flops,
            "cycles": taken,
            "flops_per_cycle": flops / taken,
            "bound_flops_per_cycle": bound,
            "share_of_bound": flops / taken / bound,
            "bound_here_flops_per_cycle": here,
            "share_of_bound_here": flops / taken / here,
        }
        if bound == bound and flops == flops:
            rows.append(
                {name: row[name] for name in ("kernel", "config", "steps")}
                | {name: f"{x:.5g}" for name, x in named.items()}
            )
    return write(options, "performance", cycles.notes | notes, rows)


def operations(data):
    """The counts in the configuration that was timed, beside the paper's and the share of the bound
    at N = 1000, in per cent.
    """
    rows = []
    for row in data["bounds"].rows:
        flops, bound, taken = PAPER_BOUNDS.get(row["kernel"], (math.nan,) * 3)
        timed = data["performance"].first(kernel=row["kernel"], config=row["config"], steps="1000")
        rows.append(
            {
                **row,
                "paper_flops": flops,
                "paper_bound": bound,
                "share": 100 * number(timed.get("share_of_bound")) if timed else "NA",
                "paper_share": 100 * bound / taken,
            }
        )
    return [
        row for row in rows if row["config"] in {timed["config"] for timed in data["cycles"].rows}
    ]


def worst_of_builds(rows):
    worst = {}
    for row in rows:
        group = worst.setdefault((row["kernel"], row["reference"]), {**row, "builds": 0})
        group["builds"] += 1
        group["identical"] = min(group["identical"], row["identical"], key=number)
        for name in ("max", "over_1e3", "over_1e2", "strict_1e3", "strict_1e2"):
            group[name] = max(group[name], row[name], key=number)
        for name in ("verdict", "paper_verdict"):
            group[name] = min(group[name], row[name])  # fail before pass
    return list(worst.values())


def crossed(sheet, down, across, value):
    """A row for each value of one column, a column for each of another."""
    heads = dict.fromkeys(row[across] for row in sheet.rows)
    return [
        {down: name}
        | {head: sheet.first(**{down: name, across: head}).get(value) for head in heads}
        for name in dict.fromkeys(row[down] for row in sheet.rows)
    ]


def derive_cushion(options, measured):
    """Rolling balls straight into a cushion, the ball and the fitted numbers of the 2010 paper; and
    fine sweeps of the side spin of one impact on a pool table's cushion, in the limit and by
    pooltool's steps. Rows: what, x, y.
    """
    head = "id,vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e\n"
    speeds = [0.28 + 0.02 * k for k in range(162)]
    work = options.folder / "cushion-in.csv"

    def rows_of(command, text):
        work.write_text(head + text, encoding="utf-8")
        done = subprocess.run(
            [options.build / "carom", *command.split(), work],
            cwd=ROOT,
            stdout=subprocess.PIPE,
            text=True,
            env=PLAIN,
            check=True,
        )
        return list(
            csv.DictReader(line for line in done.stdout.splitlines() if not line.startswith("#"))
        )

    rolling = "".join(
        f"{v:.2f},0,{v:.2f},0,{-v / 0.02625:.9g},0,0,0.02625,0.1406,0.03675,0.212,0.14,0.98\n"
        for v in speeds
    )
    rows = [
        ["rebound", row["id"], f"{-float(row['vy']):.6g}"]
        for row in rows_of("resolve --cushion", rolling)
    ]
    radius, euler = 0.028575, "--model euler --convention pooltool --least-step 0.001"
    for low, high, what in ((46, 50, "fine"), (-60, 60, "jump")):
        spins = [f"{low + (high - low) * (k / 800):.17g}" for k in range(801)]
        sweep = "".join(
            f"{float(w)!r},0.5,1.2,0,0,0,{w},{radius},0.17,0.036576,0.2,0.2,0.85\n".replace(
                ".0,", ",", 1
            )
            for w in spins
        )
        for model, words in (("exact", ""), ("euler", euler)):
            after = rows_of(f"resolve --cushion {words}", sweep)
            values = (
                [-float(row["vy"]) for row in after] if what == "fine" else jumps(after, radius)
            )
            rows += [
                [f"{what}-{model}", row["id"], f"{y:.6g}"]
                for row, y in zip(after, values)
                if y == y
            ]
    work.unlink()
    notes = {
        what: measured[what]
        for what in ("processor", "compiler", "commit", "date")
        if what in measured
    }
    write(
        options,
        "cushion",
        {**notes, "solver": solver_bits(options)},
        [dict(zip(("what", "x", "y"), row)) for row in rows],
    )


def derive_hops(options, measured):
    """How high a ball of pool hops that the cue of pool, its tip of leather, strikes in the middle,
    mm.
    """
    rows = []
    for elevation in (5, 10, 20, 30, 45):
        words = f"shoot --cue 0.6,0.6 --tip 0,0 --elevation {elevation} --speed 0.625:10:0.625 --events full --time-most 0.001".split()
        for line in subprocess.run(
            [options.build / "carom", *words], capture_output=True, text=True, env=PLAIN, check=True
        ).stdout.splitlines():
            shot = json.loads(line)
            up = shot["events"][1][4][0][6]
            rows.append(
                {
                    "elevation": elevation,
                    "speed": shot["cue"]["V0"],
                    "hop": f"{500 * up * up / 9.81:.5g}",
                }
            )
    write(
        options,
        "hops",
        {
            what: measured[what]
            for what in ("processor", "compiler", "commit", "date")
            if what in measured
        },
        rows,
    )


def jumps(rows, radius):
    """How far the results (radius times spin), over the largest of them, leave a smooth curve
    between a row and the next: the distance of their step from both neighbouring steps and all
    between. A corner is no jump; nan at the ends; at least 1e-12.
    """
    points = [
        [
            float(row[name]) * (radius if name[0] == "w" else 1.0)
            for name in ("vx", "vy", "vz", "wx", "wy", "wz")
        ]
        for row in rows
    ]
    steps = [[b - a for a, b in zip(*pair)] for pair in zip(points, points[1:])]
    most = [
        max(max(y - max(x, z), min(x, z) - y) for x, y, z in zip(*three))
        for three in zip(steps, steps[1:], steps[2:])
    ]
    return [
        math.nan,
        *(max(jump / max(map(abs, at)), 1e-12) for jump, at in zip(most, points[1:])),
        math.nan,
        math.nan,
    ]


def solver_bits(options):
    """A fingerprint of what the solver fast computes, whose times the figures of the docs show. It
    is the same on every machine: the reference collisions with plain instructions.
    """
    text = b""
    for words in (
        ["--solver", "fast", "data/collisions-204.csv"],
        ["--cushion", "data/cushion-stronge.csv"],
    ):
        command = [options.build / "carom", "resolve", *words]
        text += subprocess.run(
            command, cwd=ROOT, stdout=subprocess.PIPE, env=PLAIN, check=True
        ).stdout
    return hashlib.sha256(text).hexdigest()[:16]


# ---- Figures


def draw(name, options):
    """NAME.svg, with ids of its own, so that many can stand in one page."""
    source, title = FIGURES[name]
    target = options.folder / f"{name}.svg"
    target.unlink(missing_ok=True)
    if not Sheet(options.folder / f"{source}.csv").rows:
        return
    script = next(ROOT.glob(f"*/figures/{name}.gp"))
    done = subprocess.run(
        ["gnuplot", "-c", script, f"{source}.csv", target.name, title],
        cwd=options.folder,
        capture_output=True,
        text=True,
    )
    svg = target.read_text(encoding="utf-8") if target.is_file() else ""
    if done.returncode or "</svg>" not in svg:
        complain(f"gnuplot could not draw {name}: {done.stderr.strip()}")
        target.unlink(missing_ok=True)
        return
    svg = re.sub(r"""( id=['"]|url\(#|href=['"]#)""", rf"\1{name}-", svg)
    svg = re.sub(
        r"<title>Gnuplot</title>\s*<desc>.*?</desc>",
        lambda _: f"<title>{escape(title)}</title>",
        svg,
        count=1,
        flags=re.S,
    )
    target.write_text(svg, encoding="utf-8")


# ---- The page


def write_page(options, data):
    """index.html from its template, which names the figures and the tables; returns what it names
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

    def cells(name, rows, columns):
        """The heads and the rows of a table, of the columns named, or all."""
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
    page = environment.get_template("page.html").render(
        picture=picture,
        cells=cells,
        is_number=lambda text: not math.isnan(number(text.replace(",", ""))),
        speedups=data["speedup"].rows,
        errors=worst_of_builds(data["verify"].rows),
        operations=operations(data),
        configurations=crossed(data["configs"], "kernel", "config", "speedup"),
        experiments=data["experiments"].rows,
        batches=[row for row in ladder.rows + data["isas"].rows if row["config"] == "library"],
        machine=[(what, ladder.notes[what]) for what in MACHINE if what in ladder.notes],
        commands=[(f"{name}.csv", command) for name, (_, command) in DATA.items()],
    )
    (options.folder / "index.html").write_text(page, encoding="utf-8")
    return missing


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
        if row["config"] == "library":
            how = f"{row['isa']}, {row['precision']}, {row['threads']} thread(s)"
            print(
                f"{row['kernel']:<17} {number(row['ns_median']):>9.1f} ns {number(row['speedup']):>9.2f}  the library, {how}"
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
    wanted = [name for name in FIGURES if not options.docs or name in OF_DOCS]
    sources = [
        name
        for name in DATA
        if not options.docs or name in {FIGURES[figure][0] for figure in OF_DOCS}
    ]
    if options.source:
        for path in [*options.source.glob("*.csv"), *options.source.glob("break.svg")]:
            if path.resolve().parent != options.folder:
                shutil.copy(path, options.folder)
    else:
        measure(options, sources)
        for derive in (derive_cushion, derive_hops):
            derive(options, Sheet(options.folder / "accuracy.csv").notes)
        for name, command in DRAWN.items():
            run(
                command.format(shlex.quote(str(options.folder / f"{name}.svg"))),
                options,
                environment=PLAIN,
            )
    data = {name: Sheet(options.folder / f"{name}.csv") for name in DATA}
    data["speedup"], data["performance"] = (
        derive_speedup(options, data),
        derive_performance(options, data),
    )
    for name in wanted:
        draw(name, options)
    if options.docs:
        (options.docs / "data").mkdir(exist_ok=True)
        for name in (*OF_DOCS, *DRAWN):
            shutil.copy(options.folder / f"{name}.svg", options.docs)
        for name in OF_DOCS:
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
