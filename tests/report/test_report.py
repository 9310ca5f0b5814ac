"""The report: from stored rows, the same page every time; the figures of the docs; and the whole way, measured as briefly as can be."""

import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree as tree
from pathlib import Path

import pytest

STORED = Path(__file__).resolve().parent
ROOT = STORED.parent.parent
BUILD = Path(os.environ.get("CAROM_BUILD", ROOT / "build"))
DOCS = ROOT / "docs" / "figures"
sys.path.insert(0, str(ROOT))
from lab.report import __main__ as report


def page_of(folder):
    page = folder / "index.html"
    return tree.fromstring(page.read_text(encoding="utf-8")) if page.is_file() else None


def make(folder, *words):
    done = subprocess.run([sys.executable, "-m", "lab.report", *map(str, words), str(folder)], capture_output=True, text=True, cwd=ROOT)
    return done, page_of(folder)


def missing(page):
    return [e for e in page.iter("p") if e.get("class") == "missing"]


def table(page, name):
    """The rows of the table under that heading, as texts."""
    elements = list(page.iter())
    place = next(k for k, e in enumerate(elements) if e.get("id") == f"table-{name}")
    found = next(e for e in elements[place:] if e.tag == "table")
    return [["".join(cell.itertext()) for cell in row] for row in found.iter("tr")]


def test_stored(tmp_path):
    """Whole, well-formed, without names that occur twice, and of the same bytes each time."""
    (one, page), (two, _) = make(tmp_path / "one", "--from", STORED), make(tmp_path / "two", "--from", STORED)
    assert (one.returncode, one.stderr) == (0, "") and missing(page) == []
    figures = [e.get("id") for e in page.iter("figure")]
    assert figures[:3] == ["figure-accuracy", "figure-speedup", "figure-break"]
    assert sorted(figures) == sorted(f"figure-{name}" for name in (*report.FIGURES, "break"))
    ids = [e.get("id") for e in page.iter() if e.get("id")]
    assert len(ids) == len(set(ids))
    for path in sorted((tmp_path / "one").iterdir()):
        assert path.read_bytes() == (tmp_path / "two" / path.name).read_bytes(), path.name
    assert one.stdout.replace(str(tmp_path / "one"), "") == two.stdout.replace(str(tmp_path / "two"), "")


def test_tables(tmp_path):
    """Cells beside the rows they come from."""
    _, page = make(tmp_path / "one", "--from", STORED)
    bounds = report.Sheet(STORED / "bounds.csv").first(kernel="base")
    base = next(row for row in table(page, "operations") if row[0] == "base")
    assert base[8:12] == [f"{float(bounds['flops_amd']):,.0f}", "77,796", f"{float(bounds['chain_cycles_zen2']):,.0f}", "77,000"]
    configs = report.Sheet(STORED / "configs.csv")
    crossed = table(page, "configurations")
    for row in crossed[1:]:
        for config, cell in zip(crossed[0][1:], row[1:]):
            assert cell == report.shown(configs.first(kernel=row[0], config=config).get("speedup")), (row[0], config)
    errors = {(row[0], row[1]): row for row in table(page, "errors")[1:]}
    for row in report.Sheet(STORED / "verify.csv").rows:
        assert float(errors[row["kernel"], row["reference"]][4]) >= 0.999 * float(row["max"])
    operations = report.Sheet(tmp_path / "one" / "performance.csv").first(kernel="base", steps="1000")
    assert float(operations["flops_per_cycle"]) == pytest.approx(float(operations["flops"]) / float(operations["cycles"]), rel=1e-3)


def test_what_is_not_there_is_named(tmp_path):
    shutil.copytree(STORED, tmp_path / "some", ignore=shutil.ignore_patterns("bounds.csv", "break.svg"))
    done, page = make(tmp_path / "one", "--from", tmp_path / "some")
    assert done.returncode == 1 and len(missing(page)) == 3  # the performance, its table, the break
    assert "not there: performance, break, operations" in done.stderr


def test_bad_usage(tmp_path):
    assert make(tmp_path / "one", "--from", tmp_path / "nowhere")[0].returncode == 2
    assert "--budget" in make(tmp_path / "one", "--budget", "0")[0].stderr


@pytest.mark.skipif(not (DOCS / "data").is_dir(), reason="the figures of the docs were not made with their data yet")
def test_figures_of_the_docs(tmp_path):
    """Each figure is what gnuplot draws from the CSV beside it, all were measured by one build on one machine, and the solver that
    they show computes the same bits as this one."""
    make(tmp_path / "one", "--from", DOCS / "data")
    sheets = {name: report.Sheet(DOCS / "data" / f"{report.FIGURES[name][0]}.csv") for name in report.OF_DOCS}
    for name in report.OF_DOCS:
        assert (tmp_path / "one" / f"{name}.svg").read_bytes() == (DOCS / f"{name}.svg").read_bytes(), f"{name}.svg: {AGAIN}"
    for what in ("processor", "compiler", "commit"):
        assert len({sheet.notes[what] for sheet in sheets.values()}) == 1, f"{what}: {AGAIN}"
    options = report.arguments([str(tmp_path / "two"), "--build", str(BUILD)])
    options.folder.mkdir()
    assert sheets["cushion"].notes["solver"] == report.solver_bits(options), f"the solver has changed: {AGAIN}"
    report.derive_cushion(options, sheets["accuracy"].notes)
    assert (options.folder / "cushion.csv").read_bytes() == (DOCS / "data" / "cushion.csv").read_bytes(), AGAIN
    for name, command in report.DRAWN.items():
        report.run(command.format(options.folder / f"{name}.svg"), options, environment=report.PLAIN)
        assert (options.folder / f"{name}.svg").read_bytes() == (DOCS / f"{name}.svg").read_bytes(), f"{name}.svg: {AGAIN}"


AGAIN = "make the figures anew: cmake --build build --target figures"


def test_measured(tmp_path, monkeypatch, capsys):
    """Nothing is missing but, without valgrind, the counts. Few numbers of steps are timed, and operations of one kernel counted."""
    for name, (share, command) in report.DATA.items():
        few = command.replace(report.STEPS, "100,1000").replace(",20000,50000", "")
        monkeypatch.setitem(report.DATA, name, (share, few + " --kernel base" if name == "bounds" else few))
    code = report.main([str(tmp_path / "one"), "--build", str(BUILD), "--budget", "1"])
    counted = shutil.which("valgrind") is not None
    assert code == (0 if counted else 1)
    for name in report.DATA:
        assert counted or name != "bounds" or not report.Sheet(tmp_path / "one" / f"{name}.csv").rows
        assert name == "bounds" or report.Sheet(tmp_path / "one" / f"{name}.csv").rows, name
    assert missing(page_of(tmp_path / "one")) == [] or not counted
    assert "speedup over base" in capsys.readouterr().out
