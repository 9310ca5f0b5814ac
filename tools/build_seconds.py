"""Measures how long the compiler takes for each file of the library and the command.

tools/build_seconds.py BUILD compiles every file again, by the commands that BUILD has for it, and
compares the processor time with the table tools/build_seconds.csv. It reports each file that takes
20 % longer than in the table, and the sum of all files if it does. UPDATE=1 writes the table.

Machines differ, so the table has units: the time for a reference text that this program writes and
that never changes. The reference is compiled between the files, so that a busy machine slows down
both. A file that seems too slow is compiled four times again, alternately with the reference, and
its least time counts.

BUILD has to be a Release build by gcc, of the version that wrote the table. For another one the
program exits with 77, the code of a skipped test.
"""

import csv
import json
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

TABLE = Path(__file__).with_suffix(".csv")
SKIPPED = 77
# The targets of the library and the command. Their names are stable, unlike the folders they are in.
TARGETS = re.compile(
    r"CMakeFiles/(carom_(?:objects|tangents|plan_objects|cli|cli_parts|(?:lanes|one|impact)_\w+))\.dir/(.+)\.o$"
)
MOST = 1.2  # of the time that the table says
# Time below which nothing is reported, in units. It takes longer to start the compiler.
LEAST_EXCESS = 0.1
TRIES = 4
FILES_TO_A_REFERENCE = 25
REFERENCE = ("reference", "")


class Job(NamedTuple):
    """A file of a target, and how it is compiled."""

    target: str
    file: str
    command: list[str]
    folder: str

    @property
    def key(self):
        return (self.target, self.file)


def jobs_of(build):
    """The files of the library and the command, by the commands of a build."""
    found = []
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        words = shlex.split(entry["command"])
        output = words[words.index("-o") + 1]
        if match := TARGETS.search(output):
            found.append(Job(match[1], match[2], words, entry["directory"]))
    return found


def reference_text():
    """A C program of loops and branches in double precision, such as carom consists of."""
    functions = [
        f"""
double function_{k}(const double *x, double *y, int n) {{
  double sum = {k}.5;
  for (int i = 1; i < n; i++) {{
    const double slope = (x[i] - x[i - 1]) * {k + 1}.25, root = __builtin_sqrt(x[i] * x[i] + sum);
    if (slope > {k}.125)
      sum += root / (1.0 + slope);
    else
      for (int k = 0; k < 8; k++)
        sum = sum * 0.5 + x[i] * y[k] - slope * {k + 2}.75;
    y[i] = sum < 0.0 ? -sum : sum + root;
  }}
  return sum;
}}
"""
        for k in range(60)
    ]
    return "".join(functions)


def reference_job(compiler, folder):
    source = Path(folder, "reference.c")
    source.write_text(reference_text(), encoding="utf-8")
    command = [compiler, "-std=c17", "-O3", "-c", str(source), "-o", "reference.o"]
    return Job(*REFERENCE, command, str(folder))


def seconds_of(job, folder):
    """The time of the processor, of the program and the system, for compiling a file once."""
    with tempfile.NamedTemporaryFile(dir=folder, suffix=".o") as output:
        command = list(job.command)
        command[command.index("-o") + 1] = output.name
        process = subprocess.Popen(command, cwd=job.folder)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"tools/build_seconds.py: this command failed: {shlex.join(job.command)}")
    return used.ru_utime + used.ru_stime


def measured(jobs, reference, folder):
    """The seconds of every file, and of the reference, which is compiled between them."""
    order = []
    for number, job in enumerate(jobs):
        if number % FILES_TO_A_REFERENCE == 0:
            order.append(reference)
        order.append(job)
    order.append(reference)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        times = list(pool.map(lambda job: seconds_of(job, folder), order))
    references = [t for job, t in zip(order, times) if job is reference]
    return {job.key: t for job, t in zip(order, times) if job is not reference}, references


def compiler_of(job):
    version = subprocess.run(
        [job.command[0], "-dumpfullversion"], stdout=subprocess.PIPE, text=True, check=True
    ).stdout.strip()
    return f"gcc {version}"


def is_complete_release_by_gcc(build):
    """Whether a build has the flags, and the files, that the table is for."""
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    words = dict(re.findall(r"^(\w+):\w+=(.*)$", cache, re.M))
    said = subprocess.run(
        [words["CMAKE_C_COMPILER"], "--version"], stdout=subprocess.PIPE, text=True, check=True
    ).stdout
    return (
        words["CMAKE_BUILD_TYPE"] == "Release"
        and words["CAROM_ISAS"] == "all"
        and words.get("CAROM_CLI") == "ON"
        and words.get("CAROM_SANITIZE", "OFF") == "OFF"
        and "Free Software Foundation" in said
    )


def read_table():
    with TABLE.open(encoding="utf-8", newline="") as lines:
        compiler = next(lines).removeprefix("# ").split(":")[0]
        rows = {(row["target"], row["file"]): float(row["units"]) for row in csv.DictReader(lines)}
    return compiler, rows


def write_table(compiler, units, reference):
    with TABLE.open("w", encoding="utf-8", newline="") as out:
        out.write(
            f"# {compiler}: processor time of each file, in units of tools/build_seconds.py; "
            f"a unit was {reference:.2f} s\n"
        )
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["target", "file", "units"])
        for key, value in sorted(units.items(), key=lambda one: (-round(one[1], 2), one[0])):
            writer.writerow([*key, f"{value:.2f}"])


def least_in_units(job, reference, folder):
    """The least time of several tries, in units of the least time of the reference."""
    times, references = [], []
    for _ in range(TRIES):
        times.append(seconds_of(job, folder))
        references.append(seconds_of(reference, folder))
    return min(times) / min(references)


def compare(jobs, reference, folder):
    """The sentences about files that have become too slow."""
    _, table = read_table()
    seconds, references = measured(jobs, reference, folder)
    unit = statistics.median(references)
    units = {key: t / unit for key, t in seconds.items()}
    known = {key: value for key, value in units.items() if key in table}
    if not known:
        return [f"no file of the build is in {TABLE.name}: UPDATE=1 writes the table anew"]
    # This machine may take other times for carom than for the reference.
    scale = statistics.median(
        value / table[key] for key, value in known.items() if table[key] > LEAST_EXCESS
    )
    print(
        f"{len(units)} files take {sum(seconds.values()):.0f} s of the processor, "
        f"{sum(units.values()):.0f} units; {sum(table.values()):.0f} in the table"
    )
    complaints = []
    by_key = {job.key: job for job in jobs}
    for key, value in units.items():
        limit = scale * MOST * table.get(key, 0.0) + LEAST_EXCESS
        if key not in table:
            limit = 10 * LEAST_EXCESS
        if value <= limit:
            continue
        value = min(value, least_in_units(by_key[key], reference, folder))
        if value > limit and key in table:
            complaints.append(
                f"{key[1]} in {key[0]} takes {value:.2f} units, and the table says {table[key]:.2f}"
            )
        elif value > limit:
            complaints.append(
                f"{key[1]} in {key[0]} takes {value:.2f} units and is not in the table"
            )
    for key in sorted(table.keys() - units.keys()):
        complaints.append(f"{key[1]} in {key[0]} is in the table, but not in the build")
    before = sum(table[key] for key in known)
    if sum(known.values()) > MOST * before:
        complaints.append(
            f"all files take {sum(known.values()):.0f} units, and the table says {before:.0f}"
        )
    return complaints


def main():
    if len(sys.argv) != 2:
        raise SystemExit("usage: tools/build_seconds.py BUILD")
    build = Path(sys.argv[1])
    jobs = jobs_of(build)
    if not jobs:
        raise SystemExit(f"tools/build_seconds.py: {build} compiles no file of the library")
    compiler = compiler_of(jobs[0])
    if not is_complete_release_by_gcc(build):
        print(
            f"skipped: the table of seconds is for Release builds by gcc of all sets, unlike {build}"
        )
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        reference = reference_job(jobs[0].command[0], folder)
        if os.environ.get("UPDATE"):
            seconds, references = measured(jobs, reference, folder)
            unit = statistics.median(references)
            units = {key: t / unit for key, t in seconds.items()}
            write_table(compiler, units, unit)
            return 0
        if compiler != read_table()[0]:
            print(f"skipped: the table of seconds is for {read_table()[0]}, and this is {compiler}")
            return SKIPPED
        complaints = compare(jobs, reference, folder)
    for sentence in complaints:
        print(f"tools/build_seconds.py: {sentence}")
    if complaints:
        print("If that is meant, UPDATE=1 tools/build_seconds.py BUILD writes the table anew.")
    return 1 if complaints else 0


sys.exit(main())
