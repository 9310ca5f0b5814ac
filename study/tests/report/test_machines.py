"""The ladder by machine: the page's table is what machines.csv has, and a run gives a row.

UPDATE=1 writes the page's table.
"""

import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

STORED = Path(__file__).resolve().parent
ROOT = STORED.parents[2]
sys.path.insert(0, str(ROOT))
from study import machines  # noqa: E402


def copied(tmp_path):
    return Path(shutil.copy(machines.MACHINES, tmp_path / "machines.csv"))


def run_with(tmp_path, change=lambda text: text):
    """A folder of a run: the stored configs.csv, changed."""
    text = (STORED / "configs.csv").read_text(encoding="utf-8")
    (tmp_path / "configs.csv").write_text(change(text), encoding="utf-8")
    return tmp_path


def test_page():
    text = machines.PAGE.read_text(encoding="utf-8")
    wanted = machines.page_with(machines.read_machines()[1], text)
    if os.environ.get("UPDATE") == "1":
        machines.PAGE.write_text(wanted, encoding="utf-8")
    assert machines.PAGE.read_text(encoding="utf-8") == wanted, "UPDATE=1 writes the table"


def test_page_without_its_comments():
    with pytest.raises(machines.Refusal, match="lacks the lines"):
        machines.page_with(machines.read_machines()[1], "# The paper\n")


def test_kernels_are_those_of_the_ladder():
    """A column that names no kernel would never be filled."""
    ladder = (ROOT / "study/ladder/kernels.def").read_text(encoding="utf-8")
    for column in machines.read_machines()[1][0]:
        if column not in machines.ABOUT:
            assert f"\nRUNG({column.partition('@')[0]}, " in ladder, column


def test_row_of_a_run(tmp_path):
    """The row has the run's speedups, and the other rows stay as they were."""
    path, before = copied(tmp_path), machines.read_machines()[1]
    done = subprocess.run(
        [sys.executable, "-m", "study.machines", "--to", path, STORED, "Stored"],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert (done.returncode, done.stderr) == (0, "")
    *others, row = machines.read_machines(path)[1]
    assert others == before
    wanted = {}  # ladder.csv has the default configuration in more rounds
    for name in ("configs", "ladder"):
        with open(STORED / f"{name}.csv", encoding="utf-8", newline="") as file:
            for run in csv.DictReader(line for line in file if not line.startswith("#")):
                if run["config"] == "clang-default" and run["kernel"] != "base":
                    wanted[run["kernel"]] = f"{float(run['speedup']):.2f}"
    assert wanted and {kernel: row[kernel] for kernel in wanted} == wanted
    assert row["processor"] == "AMD EPYC, family 26, model 2"
    assert (row["compiler"], row["date"]) == ("clang 19.1.7", "2026-11-20")
    assert row["commit"] == "60390f11549d"


def test_new_kernel_becomes_a_column(tmp_path):
    run = run_with(
        tmp_path, lambda text: text.replace("\ndouble,clang-default", "\nnew,clang-default")
    )
    path, (first, *_) = copied(tmp_path), machines.read_machines()[1]
    machines.record(run, "Another", path)
    rows = machines.read_machines(path)[1]
    assert list(rows[0]) == [*first, "new"]
    assert rows[0]["new"] == "" and rows[-1]["new"] and rows[-1]["double"] == ""


@pytest.mark.parametrize(
    "change, why",
    [
        (lambda text: "", "has no rows"),
        (lambda text: text.replace("kernel: base, clang", "kernel: base, gcc"), "with clang"),
        (
            lambda text: text.replace("# processor family", "# family"),
            "no line '# processor family",
        ),
    ],
)
def test_refused_runs(tmp_path, change, why):
    run, path = run_with(tmp_path, change), copied(tmp_path)
    before = path.read_bytes()
    with pytest.raises(machines.Refusal, match=why):
        machines.record(run, "Another", path)
    assert path.read_bytes() == before


def test_the_same_run_twice(tmp_path):
    path = copied(tmp_path)
    machines.record(STORED, "Stored", path)
    with pytest.raises(machines.Refusal, match="already"):
        machines.record(STORED, "Stored", path)


def test_refusal_of_carom_lab_paper(tmp_path):
    """`carom-lab paper --record` ends with the reason where the run has no times."""
    before = machines.MACHINES.read_bytes()
    done = subprocess.run(
        [sys.executable, "-m", "study.paper", "--from", tmp_path, "--record", "Another"],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert done.returncode == 2 and "carom-lab paper: --record: " in done.stderr, done.stderr
    assert machines.MACHINES.read_bytes() == before
