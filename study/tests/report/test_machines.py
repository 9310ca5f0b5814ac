"""The recorded runs: the pages show what the files have, a run is recorded once, and the commit of
each run is in the history.

UPDATE=1 writes the pages.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

STORED = Path(__file__).resolve().parent
ROOT = STORED.parents[2]
sys.path.insert(0, str(ROOT))
from study import machines, paper  # noqa: E402
from study.report.sheets import Sheet  # noqa: E402

JUDGED = [
    {"section": "3", "claim": "speedup of double", "unit": "x", "paper": "1.65", "here": "1.68"}
    | {"uncertainty": "0.01", "verdict": "holds", "cause": ""},
    {"section": "4", "claim": "float_vec is slower", "unit": "x", "paper": "", "here": "0.98"}
    | {"uncertainty": "0.02", "verdict": "does not hold here", "cause": "why"},
]


def copied(tmp_path):
    return Path(shutil.copy(machines.MACHINES, tmp_path / "machines.csv"))


def run_with(folder, change=lambda text: text):
    """A folder of a run: the stored configs.csv, changed."""
    folder.mkdir(exist_ok=True)
    text = (STORED / "configs.csv").read_text(encoding="utf-8")
    (folder / "configs.csv").write_text(change(text), encoding="utf-8")
    return folder


@pytest.mark.parametrize("page", machines.PAGES, ids=lambda page: page.name)
def test_pages(page):
    text = page.read_text(encoding="utf-8")
    wanted = machines.page_with(text, machines.MACHINES, machines.PAGES[page])
    if os.environ.get("UPDATE") == "1":
        page.write_text(wanted, encoding="utf-8")
    shown = page.read_text(encoding="utf-8")
    assert shown == wanted, "UPDATE=1 writes the tables, and so does tools/python -m study.machines"


def test_page_without_its_comments():
    with pytest.raises(machines.Refusal, match="lacks the lines"):
        machines.page_with("# The paper\n")


def test_columns_are_kernels():
    """A column that names no kernel and no solver would never be filled."""
    ladder = (ROOT / "study/ladder/kernels.def").read_text(encoding="utf-8")
    for column in machines.read_machines()[1][0]:
        if column not in machines.ABOUT:
            assert f"\nRUNG({column.partition('@')[0]}, " in ladder, column


def test_each_run_has_one_id():
    ids = [row["run"] for row in machines.read_machines()[1]]
    assert len(set(ids)) == len(ids)
    for name in ("verdicts", "chains"):
        rows = machines.read_rows(machines.beside(machines.MACHINES, name))[1]
        assert {row["run"] for row in rows} <= set(ids), name


def test_verdicts_are_of_the_claims():
    """A recorded run has been judged by the claims that there are; otherwise record it again."""
    wanted = {machines.key_of(claim) for claim in paper.read_table("claims.csv")}
    rows = machines.read_rows(machines.beside(machines.MACHINES, "verdicts"))[1]
    for run in {row["run"] for row in rows}:
        assert {machines.key_of(row) for row in rows if row["run"] == run} == wanted, run


def git(*words):
    return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True)


def unknown(commits):
    """Those that are no ancestors of today's commit."""
    return [
        commit
        for commit in commits
        if git("merge-base", "--is-ancestor", commit, "HEAD").returncode != 0
    ]


@pytest.mark.skipif(
    git("rev-parse", "--is-shallow-repository").stdout.strip() != "false",
    reason="this tree has no git history, or not all of it",
)
def test_commits_are_in_the_history():
    """What was measured at a commit that is gone can be measured by nobody: drop such a run, and
    draw such a figure again.
    """
    commits = {row["commit"] for row in machines.read_machines()[1]} - {""}
    for figure in (ROOT / "docs/figures/data").glob("*.csv"):
        commit = Sheet(figure).notes.get("commit")
        commits |= {commit.removesuffix("-dirty")} if commit else set()
    assert commits and not unknown(commits)
    assert unknown(["0123456789ab"]) == ["0123456789ab"]


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
        for run in Sheet(STORED / f"{name}.csv").rows:
            if run["config"] == "clang-default" and run["kernel"] != "base":
                wanted[run["kernel"]] = f"{float(run['speedup']):.2f}"
    assert wanted and {kernel: row[kernel] for kernel in wanted} == wanted
    assert row["processor"] == "AMD EPYC, family 26, model 2"
    assert (row["compiler"], row["date"]) == ("clang 19.1.7", "2026-11-20")
    assert (row["commit"], row["run"]) == ("60390f11549d", "stored-clang19-native")


def test_verdicts_of_a_run(tmp_path):
    """The table has a claim a row and a run a column, with numbers of verdicts at its end."""
    path = copied(tmp_path)
    machines.record([(STORED, "One", JUDGED), (STORED, "Two", JUDGED[:1])], path)
    table = machines.table_of_verdicts(path)
    assert "| claim | paper | `one-clang19-native` | `two-clang19-native` |" in table
    assert "| speedup of double | 1.65 | 1.68 holds | 1.68 holds |" in table
    assert "| float_vec is slower | | 0.98 **fails** | |" in table
    assert "| number: holds | | 1 | 1 |" in table
    assert machines.summary(path) == [
        "recorded run one-clang19-native: 1 hold, 1 do not hold here",
        "recorded run two-clang19-native: 1 hold",
    ]


def test_chains_of_a_run(tmp_path):
    """Counts of the run's kernels are in the table by compiler."""
    path = copied(tmp_path)
    machines.record([(STORED, "One", [])], path)
    counted = Sheet(STORED / "bounds.csv").first(kernel="double")
    cycles = f"{float(counted['chain_cycles_zen2']) / 1000:.0f}"
    assert f"| clang 19.1.7 | `double` | {cycles} |" in machines.table_of_chains(path)


def test_sentence(tmp_path):
    """README cites the latest run with verdicts, says how many claims hold in it, and how the slip
    of `base` differs from the solvers'.
    """
    path = copied(tmp_path)
    ladder = (
        "kernel,config,isa,slip,speedup,ns_median,error_exact_max\n"
        "exact,library,scalar,pooltool,40.1,660,4.11e-08\n"
        "exact,library,scalar,paper,44.6,600,2.82e-08\n"
    )
    folder = run_with(tmp_path / "run", lambda text: text.replace("2026-11-20", "2999-01-01"))
    (folder / "ladder.csv").write_text(ladder, encoding="utf-8")
    machines.record([(folder, "One", JUDGED)], path)
    said = " ".join(machines.sentence(path).split())
    assert "On the One with clang 19.1.7, the paper's fastest kernel reaches 1.95 x" in said
    assert "`one-clang19-native`" in said and "Of the paper's 2 claims, 1 hold" in said
    assert "takes 1.10 times as long" in said and "at most 4.1e-8." in said


def test_tables_of_the_page(tmp_path):
    """The page's tables have the numbers of the sheets that the run was measured into."""
    path = copied(tmp_path)
    stored = Sheet(STORED / "configs.csv")
    machines.record([(STORED, "One", JUDGED)], path)
    rows = machines.read_rows(machines.beside(path, "measured"))[1]
    run = "one-clang19-native"
    heads, *lines = machines.measured.table_of_configurations(rows, run)
    for kernel, *cells in lines:
        for head, shown in zip(heads[1:], cells):
            row = stored.first(kernel=kernel.strip("`"), config=head.replace(" ", "-"))
            assert shown == (f"{float(row['speedup']):.2f}" if row else ""), (kernel, head)
    assert heads[1:3] == ["clang default", "clang archnative"] and heads[-1].startswith("gcc")
    counted = Sheet(STORED / "bounds.csv")
    for line in machines.measured.table_of_operations(rows, run)[1:]:
        row = counted.first(kernel=line[0].strip("`"))
        assert line[2] == f"{float(row['flops_amd']):,.0f}", line
    errors = machines.measured.table_of_errors(rows, run)
    verified = Sheet(STORED / "verify.csv").first(kernel="float", config="clang-default")
    assert [line[2] for line in errors if "`float`" in line[0]] == [
        verified[column] for column in machines.measured.ERRORS.values()
    ]


def test_new_kernel_becomes_a_column(tmp_path):
    run = run_with(
        tmp_path / "run", lambda text: text.replace("\ndouble,clang-default", "\nnew,clang-default")
    )
    path, (first, *_) = copied(tmp_path), machines.read_machines()[1]
    machines.record([(run, "Another", [])], path)
    rows = machines.read_machines(path)[1]
    assert list(rows[0]) == [*first, "new"]
    assert rows[0]["new"] == "" and rows[-1]["new"] and rows[-1]["double"] == ""


@pytest.mark.parametrize(
    "change, why",
    [
        (lambda text: "", "has no rows"),
        (lambda text: text.replace("kernel: base, clang", "kernel: euler, clang"), "of the ladder"),
        (
            lambda text: text.replace("# processor family", "# family"),
            "no line '# processor family",
        ),
        (lambda text: text.replace("60390f11549d", "60390f11549d-dirty"), "without changes"),
    ],
)
def test_refused_runs(tmp_path, change, why):
    run, path = run_with(tmp_path / "run", change), copied(tmp_path)
    before = path.read_bytes()
    with pytest.raises(machines.Refusal, match=why):
        machines.record([(run, "Another", [])], path)
    assert path.read_bytes() == before


def test_the_same_run_twice(tmp_path):
    """A run that is measured again replaces the one before."""
    path = copied(tmp_path)
    for _ in range(2):
        machines.record([(STORED, "Stored", JUDGED)], path)
    rows = machines.read_machines(path)[1]
    assert [row["run"] for row in rows].count("stored-clang19-native") == 1
    assert len(machines.read_rows(machines.beside(path, "verdicts"))[1]) == len(JUDGED)


def test_compilers_are_printed():
    said = machines.compilers_of(Sheet(STORED / "configs.csv"))
    assert re.fullmatch("compilers: clang 19.1.7, gcc 12.2.0; .* clang 19.1.7, target native", said)


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
