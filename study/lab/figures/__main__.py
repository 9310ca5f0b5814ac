"""The figures of the docs beyond the study: `tools/python -m study.lab.figures DIR` computes their CSV
files in DIR/data and draws them in DIR. What is computed does not depend on the machine.

Batches are measured, and so only with --budget. What `carom` draws itself is in
docs/figures/made.csv.
"""

import argparse
import csv
import json
import math
import shutil
import subprocess
import sys
from pathlib import Path

from study.report.fingerprints import stamp
from study.report.pictures import draw
from study.report.sheets import PLAIN, ROOT, run, write

HERE = Path(__file__).resolve().parent
# NAME.svg by NAME.gp: its title.
COMPUTED = {
    "cushion": "A ball and a cushion: rebound, a fine sweep, jumps",
    "hops": "How high the cue ball hops, by the elevation of the butt",
}
SIZES = "1,2,4,8,16,32,64,256,1024,4096,16384,65536,262144"
# The same of what is measured, and the command, to which --budget and --output are added.
MEASURED = {
    "isas": (
        "Batches by instruction set and precision",
        "carom-lab bench --kernel exact,fast --batch --threads 1 --pairs 4080 --csv --spread",
    ),
    "batch": (
        "Throughput of the exact solver over batch size and threads",
        f"carom-lab bench --kernel exact --isa scalar,best --threads all --pairs {SIZES} --csv --spread",
    ),
}


def derive_cushion(options):
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
    write(options, "cushion", {}, [dict(zip(("what", "x", "y"), row)) for row in rows])


def derive_hops(options):
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
    write(options, "hops", {}, rows)


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


def measure(options):
    """The CSV files of MEASURED, an equal fraction of the budget for each; False where one
    fails."""
    for name, (_, command) in MEASURED.items():
        target = options.folder / f"{name}.csv"
        share = f"{options.budget / len(MEASURED):.4g}"
        if not run(command, options, "--budget", share, "--output", target):
            return False
        stamp(target)
    return True


def arguments(words):
    parser = argparse.ArgumentParser(
        prog="study.lab.figures", description=__doc__.partition("\n\n")[0]
    )
    parser.add_argument("folder", metavar="DIR", type=Path, help="where the figures go")
    parser.add_argument("--build", default=ROOT / "build", metavar="DIR2", type=Path)
    parser.add_argument(
        "--budget",
        type=float,
        metavar="SECONDS",
        help="measure the figures of batches too, so long in all",
    )
    options = parser.parse_args(words)
    options.docs, options.build = options.folder.resolve(), options.build.resolve()
    options.folder = options.docs / "data"
    if not (options.build / "carom").is_file():
        parser.error(f"there is no program {options.build / 'carom'}; build it first")
    if not shutil.which("gnuplot"):
        parser.error("gnuplot is not installed (Debian: gnuplot-nox)")
    return options


def main(words):
    options = arguments(words)
    options.folder.mkdir(parents=True, exist_ok=True)
    derive_cushion(options)
    derive_hops(options)
    titles = dict(COMPUTED)
    if options.budget:
        if not measure(options):
            return 1
        titles |= {name: title for name, (title, _) in MEASURED.items()}
    for name, title in titles.items():
        draw(options.folder, name, name, title, HERE / f"{name}.gp")
        picture = options.folder / f"{name}.svg"
        if not picture.is_file():
            return 1
        picture.replace(options.docs / picture.name)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
