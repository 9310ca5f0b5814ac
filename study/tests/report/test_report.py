"""The report: from stored rows, the same page every time; the figures of the docs; and the whole
way, measured as briefly as can be.
"""

import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree as tree
from pathlib import Path
from types import SimpleNamespace

import pytest

STORED = Path(__file__).resolve().parent
ROOT = STORED.parents[2]
BUILD = Path(os.environ.get("CAROM_BUILD", ROOT / "build"))
DOCS = ROOT / "docs" / "figures"
sys.path.insert(0, str(ROOT))
from study.lab.figures import __main__ as lab  # noqa: E402
from study.report import __main__ as report  # noqa: E402
from study.report import data, fingerprints  # noqa: E402
from study.report.pictures import draw  # noqa: E402
from study.report.sheets import Sheet  # noqa: E402


def make(folder, *words):
    done = subprocess.run(
        [sys.executable, "-m", "study.report", *map(str, words), str(folder)],
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    return done, page_of(folder)


def page_of(folder):
    page = folder / "index.html"
    return tree.fromstring(page.read_text(encoding="utf-8")) if page.is_file() else None


def missing(page):
    return [e for e in page.iter("p") if e.get("class") == "missing"]


def table(page, name):
    """The rows of the table under that heading, {head: text} each."""
    elements = list(page.iter())
    place = next(k for k, e in enumerate(elements) if e.get("id") == f"table-{name}")
    found = next(e for e in elements[place:] if e.tag == "table")
    heads, *rows = [["".join(cell.itertext()) for cell in row] for row in found.iter("tr")]
    return [dict(zip(heads, row)) for row in rows]


def note_module(path, fingerprint):
    """Says of which module the stored rows are."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = [line for line in lines if not line.startswith("# module ")]
    path.write_text(f"# module clang-zen2: {fingerprint}\n" + "".join(kept), encoding="utf-8")


def test_share_of_another_module(tmp_path):
    """Counts of one file and times of another give no fraction of the bound; the report says
    why."""
    for path in STORED.glob("*.csv"):
        shutil.copy(path, tmp_path)
    options = SimpleNamespace(folder=tmp_path)
    for timed, counted, rows in (("1111", "1111", True), ("1111", "2222", False)):
        note_module(tmp_path / "cycles.csv", timed)
        note_module(tmp_path / "bounds.csv", counted)
        (tmp_path / "performance.csv").unlink(missing_ok=True)
        data = {name: Sheet(tmp_path / f"{name}.csv") for name in ("cycles", "bounds")}
        data["performance"] = report.derive_performance(options, data)
        assert bool(data["performance"].rows) == rows
        assert all((row["share"] != "NA") == rows for row in report.operations(data))


def test_stored(tmp_path):
    """From stored rows: whole, well-formed, without names that occur twice, of the same bytes each
    time, and with the cells of the rows; what is not there is named.
    """
    stored = tmp_path / "stored"
    stored.mkdir()
    for path in [*(DOCS / "data").glob("*.csv"), *STORED.glob("*.csv")]:
        shutil.copy(path, stored)
    for name in ("cycles", "bounds"):
        note_module(stored / f"{name}.csv", "1111")
    (one, page), (two, _) = (
        make(tmp_path / "one", "--from", stored),
        make(tmp_path / "two", "--from", stored),
    )
    assert (one.returncode, one.stderr) == (0, "") and missing(page) == []
    ids = [e.get("id") for e in page.iter() if e.get("id")]
    assert len(ids) == len(set(ids)) and {f"figure-{name}" for name in report.FIGURES} <= set(ids)
    for path in sorted((tmp_path / "one").iterdir()):
        assert path.read_bytes() == (tmp_path / "two" / path.name).read_bytes(), path.name
    assert one.stdout.replace(str(tmp_path / "one"), "") == two.stdout.replace(
        str(tmp_path / "two"), ""
    )

    bounds = Sheet(stored / "bounds.csv").first(kernel="base", config="clang-zen2")
    cells = table(page, "operations")[0] | table(page, "bounds")[0]
    heads = report.HEADS
    for name, paper in (
        ("flops_amd", "77,796"),
        ("chain_cycles_zen2", "77,000"),
        ("mean_chain_cycles_zen2", None),
    ):
        assert cells[heads[name]] == f"{float(bounds[name]):,.0f}", name
        if paper:
            assert cells[heads[{"flops_amd": "paper_flops"}.get(name, "paper_bound")]] == paper
    slips = [(row["kernel"], row["slip"]) for row in table(page, "solvers")]
    assert {("exact", "paper"), ("exact", "pooltool")} <= set(slips)
    configs = Sheet(stored / "configs.csv")
    for row in table(page, "configurations"):
        for config in list(row)[1:]:
            assert row[config] == report.shown(
                configs.first(kernel=row["kernel"], config=config).get("speedup")
            ), (row, config)
    errors = {(row["kernel"], row["reference"]): row for row in table(page, "errors")}
    for row in Sheet(stored / "verify.csv").rows:
        reference = row["reference"].removeprefix("reference-").removesuffix(".csv")
        worst = errors[row["kernel"], reference][heads["max"]]
        assert float(worst) >= 0.999 * float(row["max"])
    performance = Sheet(tmp_path / "one" / "performance.csv").first(kernel="base", steps="1000")
    assert float(performance["flops_per_cycle"]) == pytest.approx(
        float(performance["flops"]) / float(performance["cycles"]), rel=1e-3
    )

    # where the processor counted, its counts are taken; a column of NA changes nothing
    lines = (stored / "cycles.csv").read_text(encoding="utf-8").splitlines()
    counted = {"flops": "70000", "cycles": "140000"}
    for name in (*counted, None):
        cells = dict.fromkeys(counted, "NA") | ({name: counted[name]} if name else {})
        heads = [",".join([line, *counted]) for line in lines if line.startswith("kernel,")]
        rows = [
            line if line.startswith("#") else ",".join([line, *cells.values()])
            for line in lines
            if not line.startswith("kernel,")
        ]
        first = next(k for k, line in enumerate(rows) if not line.startswith("#"))
        (stored / "cycles.csv").write_text(
            "\n".join([*rows[:first], *heads, *rows[first:], ""]), encoding="utf-8"
        )
        folder = tmp_path / f"counted-{name}"
        make(folder, "--from", stored)
        sheet = Sheet(folder / "performance.csv")
        row = sheet.first(kernel="base", steps="1000")
        for column, note in (("flops", "operations"), ("cycles", "cycles")):
            is_counted = column == name
            assert (sheet.notes[note] == "counted by the processor") == is_counted, (name, note)
            wanted = counted[column] if is_counted else performance[column]
            assert float(row[column]) == float(wanted), (name, column)

    for name in ("cycles.csv", "performance.csv"):
        (stored / name).unlink(missing_ok=True)
    done, page = make(tmp_path / "three", "--from", stored)
    assert done.returncode == 1 and len(missing(page)) == 3
    assert "not there: performance, operations, bounds" in done.stderr
    assert make(tmp_path / "four", "--from", tmp_path / "nowhere")[0].returncode == 2
    assert "--budget" in make(tmp_path / "four", "--budget", "0")[0].stderr


def test_trace_can_be_drawn(tmp_path):
    """The states of a collision, from stored rows."""
    shutil.copy(STORED / "trace.csv", tmp_path)
    draw(tmp_path, "trace", "trace", "The course of one collision", Path(lab.HERE) / "trace.gp")
    assert (tmp_path / "trace.svg").stat().st_size > 10000


AGAIN = "make the figures anew: cmake --build build --target figures"


def test_figures_of_the_docs(tmp_path):
    """Each figure of the study is what gnuplot draws from the CSV next to it, all were measured in
    one run, and the code of every series is today's.
    """
    make(tmp_path / "one", "--from", DOCS / "data")
    sheets = {}
    sources = {name: report.FIGURES[name][0] for name in report.OF_DOCS}
    for name, (title, _) in lab.MEASURED.items():
        draw(tmp_path / "one", name, name, title, Path(lab.HERE) / f"{name}.gp")
        sources[name] = name
    for name, data_of in sources.items():
        source = DOCS / "data" / f"{data_of}.csv"
        sheets[name] = Sheet(source)
        drawn, kept = (folder / f"{name}.svg" for folder in (tmp_path / "one", DOCS))
        assert drawn.read_bytes() == kept.read_bytes(), f"{name}.svg: {AGAIN}"
        stale = fingerprints.stale(source)
        assert not stale, f"{name}.svg shows code that has changed: {'; '.join(stale)}. {AGAIN}"
    for what in ("processor", "compiler", "commit"):
        assert len({sheet.notes[what] for sheet in sheets.values()}) == 1, f"{what}: {AGAIN}"


def test_figures_computed(tmp_path):
    """The figures that do not depend on the machine are those of this build."""
    done = subprocess.run(
        [sys.executable, "-m", "study.lab.figures", "--build", str(BUILD), str(tmp_path)], cwd=ROOT
    )
    assert done.returncode == 0
    for path in sorted(tmp_path.rglob("*.*")):
        kept = DOCS / path.relative_to(tmp_path)
        assert path.read_bytes() == kept.read_bytes(), f"{kept.name}: {AGAIN}"


def test_stale_series(tmp_path, monkeypatch):
    """A changed line of a solver makes its own series stale and no other; a comment none; what is
    gone or was never noted is named.
    """
    rows = "kernel,isa,precision\nexact,avx2,double\neuler,scalar,double\nfloat,scalar,single\n"
    file = tmp_path / "series.csv"
    file.write_text(rows)
    assert fingerprints.stale(file) == ["euler", "exact", "float"]
    fingerprints.stamp(file)
    assert fingerprints.stale(file) == []
    texts = fingerprints.text_of
    for path, change, found in (
        ("core/src/ball_ball/euler.c", " + 1", ["euler, scalar, double"]),
        ("core/src/ball_ball/collocate.c", " + 1", ["exact, avx2, double"]),
        ("core/src/contact_law/impact.c", " + 1", ["exact, avx2, double"]),
        ("study/configs.cmake", " -Os", ["float, scalar, single"]),
        ("study/ladder/float.c", " + 1", ["float, scalar, single"]),
    ):
        changed = ROOT / path
        monkeypatch.setattr(
            fingerprints,
            "text_of",
            lambda path, changed=changed, change=change: texts(path)
            + (change if path == changed else ""),
        )
        assert fingerprints.stale(file) == found
    monkeypatch.undo()
    one = tmp_path / "one.c"
    one.write_text("int a; /* a comment\n of two lines */\n// another\nint  b;\n")
    assert fingerprints.text_of(one) == "int a; int b;"
    file.write_text(file.read_text().replace("float", "no_such_kernel"))
    assert fingerprints.stale(file) == ["no_such_kernel, scalar, single"]


def test_measured(tmp_path, monkeypatch, capsys):
    """Nothing is missing. Few numbers of steps are timed."""
    for name, (share, command) in data.DATA.items():
        monkeypatch.setitem(
            data.DATA,
            name,
            (share, command.replace(data.STEPS, "100,1000").replace(",20000,50000", "")),
        )
    assert report.main([str(tmp_path / "one"), "--build", str(BUILD), "--budget", "1"]) == 0
    for name in data.DATA:
        assert Sheet(tmp_path / "one" / f"{name}.csv").rows, name
    assert missing(page_of(tmp_path / "one")) == []
    assert "speedup over base" in capsys.readouterr().out
