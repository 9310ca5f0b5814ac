"""The ladder by machine: `tools/python -m study.machines DIR NAME` appends a run's row.

machines.csv has a machine a row: its name, processor, compiler, the run's date and commit, the
source of the numbers, and for each kernel the speedup over base in clang's default configuration.
`float@archnative` is the build that the paper found to be the fastest. A cell is empty where
nobody has measured, and has words where the paper gives words. docs/study/paper.md shows the file
as a table, and study/tests/report/test_machines.py compares the two.
"""

import argparse
import csv
import re
import sys
from pathlib import Path

from study.report.sheets import ROOT, Sheet

MACHINES = ROOT / "study" / "machines.csv"
PAGE = ROOT / "docs" / "study" / "paper.md"
BEGIN, END = "<!-- machines.csv, as a table -->\n", "<!-- end of the table -->\n"
ABOUT = ["machine", "processor", "compiler", "date", "commit", "source"]
CONFIG = "clang-default"
BEST = "float@archnative"
NOTES = ("processor", "processor family", "commit", "date", CONFIG)


class Refusal(Exception):
    """Why a run gives no row."""


def read_machines(path=MACHINES):
    """The comment at the head of the file, and its rows."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    comment = "".join(line for line in lines if line.startswith("#"))
    return comment, list(csv.DictReader(line for line in lines if not line.startswith("#")))


def speedups_of(sheet):
    """Each kernel's speedup in clang's default configuration, and that of the paper's best build."""
    found = {
        row["kernel"]: row["speedup"]
        for row in sheet.rows
        if row["config"] == CONFIG and row["kernel"] != "base"
    }
    best = sheet.first(kernel="float", config="clang-archnative")
    if best:
        found[BEST] = best["speedup"]
    return {kernel: f"{float(speedup):.2f}" for kernel, speedup in found.items()}


def row_of_run(folder, name):
    """The row of a run, from its configs.csv."""
    path = Path(folder) / "configs.csv"
    sheet = Sheet(path)
    if not sheet.rows:
        raise Refusal(f"{path} is not there or has no rows; `carom-lab paper` measures it")
    reference = sheet.notes.get("reference kernel", "none")
    if not reference.startswith(f"base, {CONFIG}"):
        raise Refusal(
            f"{path}: speedups are relative to {reference}; the table needs base, {CONFIG}, "
            "so build the ladder with clang"
        )
    absent = [note for note in NOTES if note not in sheet.notes]
    if absent:
        raise Refusal(f"{path}: no line '# {absent[0]}: ...', which `carom-lab bench` writes")
    version = re.search(r"\d+(\.\d+)+", sheet.notes[CONFIG])
    about = {
        "machine": name,
        "processor": f"{sheet.notes['processor']}, family {sheet.notes['processor family']}",
        "compiler": f"clang {version[0]}" if version else "clang",
        "date": sheet.notes["date"][:10],
        "commit": sheet.notes["commit"],
        "source": f"a run of {sheet.notes.get('rounds', 'unknown')} rounds",
    }
    # The default configuration is timed by itself too, with every rung and in more rounds.
    return about | speedups_of(sheet) | speedups_of(Sheet(Path(folder) / "ladder.csv"))


def record(folder, name, path=MACHINES):
    """Appends the run's row. A kernel that is new in the run becomes a column."""
    comment, rows = read_machines(path)
    row = row_of_run(folder, name)
    for other in rows:
        if all(other[key] == row[key] for key in ("machine", "compiler", "commit")):
            raise Refusal(
                f"{path} has {name} with {row['compiler']} at commit {row['commit']} already; "
                "remove that row, or choose another name"
            )
    columns = list(dict.fromkeys([*rows[0], *row]))
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(comment)
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows([*rows, row])
    return row


def table(rows):
    """The rows as Markdown: a machine a column, a kernel a row."""
    names = [row["machine"] for row in rows]
    lines = [f"| | {' | '.join(names)} |", f"|---{'|---' * len(rows)}|"]
    for column in list(rows[0])[1:]:
        head = column if column in ABOUT else f"`{column}`"
        lines.append(f"| {head} | {' | '.join(row[column] for row in rows)} |")
    return "\n".join(re.sub(r" +\|", " |", line) for line in lines) + "\n"


def page_with(rows, text):
    """The page's text with the table of these rows between its two comments."""
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise Refusal(f"the page lacks the lines '{BEGIN.strip()}' and '{END.strip()}'")
    return f"{before}{BEGIN}\n{table(rows)}\n{END}{after}"


def record_and_show(folder, name, path=MACHINES):
    """Appends the run's row, and writes the page's table where the file is the page's own."""
    row = record(folder, name, path)
    said = f"{path} has the row of {row['machine']}, {row['compiler']}, commit {row['commit']}"
    if path != MACHINES:
        return said
    page = page_with(read_machines()[1], PAGE.read_text(encoding="utf-8"))
    PAGE.write_text(page, encoding="utf-8")
    return f"{said}, and {PAGE.relative_to(ROOT)} the new table"


def main(words):
    parser = argparse.ArgumentParser(prog="study.machines", description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path, metavar="DIR", help="a run's folder, with configs.csv")
    parser.add_argument("name", metavar="NAME", help="what the table calls the machine")
    parser.add_argument("--to", type=Path, default=MACHINES, help="the file that gets the row")
    options = parser.parse_args(words)
    try:
        print(record_and_show(options.folder, options.name, options.to))
    except Refusal as why:
        parser.error(str(why))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
