"""The CSV files of the study: how a program of the build writes one, and how it is read."""

import csv
import math
import os
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
# What must not depend on the machine is computed with instructions that all have.
PLAIN = {**os.environ, "CAROM_ISA": "plain"}


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
        if str(text) in ("None", "NA", "nan")
        else str(text)
        if x != x
        else f"{x:,.0f}"
        if abs(x) >= 1000
        else f"{x:.4g}"
    )


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
