"""figures.py SOURCE BUILD: docs/figures/made.csv says of every figure of the docs what makes it, and
the figures that `carom` or a program in C draws have the numbers that it draws today.

Numbers are compared, not pixels or bytes: those of the file, and of a plot by matplotlib those of
the curves. Others compare the rest: study/tests/report the kinds study (by fingerprints) and lab (by
bytes), docs/conventions the kind docs (by bytes), python/examples the kinds python and notebook, and
web/package the kinds node and page. `measured DATE` and `hand` are compared by none. UPDATE=1 draws
the figures anew.
"""

import csv
import os
import re
import shlex
import subprocess
import sys
import tempfile
from fnmatch import fnmatchcase
from pathlib import Path

COMPARED = {"carom", "docs", "study", "lab", "python", "notebook", "node", "page", "hand"}
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")


def made(source):
    """Figure (a pattern), what makes it, and the command, of each row of the table."""
    with Path(source, "docs/figures/made.csv").open(encoding="utf-8") as rows:
        return [(row["figure"], row["by"], row["command"]) for row in csv.DictReader(rows)]


def numbers(path):
    """The numbers that a picture draws; of matplotlib those of curves and marks in the axes."""
    text = Path(path).read_text(encoding="utf-8")
    if "matplotlib" not in text:
        return [float(number) for number in NUMBER.findall(re.sub(r"#[0-9a-f]{3,6}\b", "", text))]
    inside = re.findall(r'<path d="([^"]*)" clip-path=', text)
    return [float(number) for path in inside for number in NUMBER.findall(path)]


def difference(path, kept, off):
    """What differs between two pictures whose numbers may be `off` points apart, or None."""
    came, stored = numbers(path), numbers(kept)
    if not came:
        return f"{Path(path).name} has no numbers"
    if len(came) != len(stored):
        return f"{Path(kept).name} has {len(stored)} numbers, not {len(came)}"
    worst = max(abs(a - b) for a, b in zip(came, stored))
    return f"{Path(kept).name}: a number is {worst:.3g} off" if worst > off else None


def check_table(source, rows):
    """That each file has one row, and each row a file and a maker."""
    files = [file.name for file in Path(source, "docs/figures").iterdir() if file.is_file()]
    for file in files:
        count = sum(fnmatchcase(file, pattern) for pattern, _, _ in rows)
        assert file == "made.csv" or count == 1, f"made.csv has {count} rows for {file}"
    for pattern, by, command in rows:
        assert any(fnmatchcase(file, pattern) for file in files), f"made.csv: there is no {pattern}"
        assert by in COMPARED or re.fullmatch(r"measured \d{4}-\d\d-\d\d", by), f"made.csv: {by}"
        assert command, f"made.csv: {pattern} has no command"


def draw(source, build, command, out):
    words = [word.format(out) for word in shlex.split(command)]
    program = Path(build, words[0])
    done = subprocess.run(
        [program, *words[1:]], cwd=source, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    )
    assert done.returncode == 0, f"{command}\n{done.stderr.decode()}"


def main(source, build):
    rows, wrong, count = made(source), [], 0
    with tempfile.TemporaryDirectory() as work:
        for name, by, command in rows:
            if by != "carom":
                continue
            kept, out = Path(source, "docs/figures", name), Path(work, name)
            update = os.environ.get("UPDATE") == "1"
            draw(source, build, command, kept if update else out)
            found = None if update else difference(out, kept, 2e-3)
            wrong += [f"{found}: {command}"] if found else []
            count += 1
        # That a stale figure is found: one number of it changed.
        one = Path(work, "one.svg")
        one.write_text(re.sub(r"\d+\.\d+", "7777.7", kept.read_text(), count=1))
        assert difference(one, kept, 2e-3), "a changed number is not found"
    check_table(source, rows)
    if wrong:
        sys.exit("\n".join([*wrong, "UPDATE=1 draws them anew: look at them"]))
    print(f"{count} figures drawn and compared, {len(rows)} rows")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
