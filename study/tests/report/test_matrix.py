"""The matrix of compilers and targets, on a small made-up measurement of three compilers."""

import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT))
from study import machines, matrix, measures, paper  # noqa: E402
from study.report.data import DATA  # noqa: E402
from study.report.sheets import Sheet  # noqa: E402

COMPILERS = {"clang": "22.1.8", "gcc": "12.2.0", "clang14": "14.0.6"}
SETS = ("default", "novec", "o3", "archnative", "zen2", "archzen2", "ordered")
MODULES = [f"{compiler}-{name}" for compiler in COMPILERS for name in SETS]
# Speedups over clang's base by default, of `base` and of the kernels over the base of their set.
BASE = {"clang": 1.0, "gcc": 0.5, "clang14": 0.8}
OVER_BASE = {"base": 1.0, "double": 1.6, "double_vec": 1.2, "float": 1.9}
NOTES = {
    "processor": "AMD EPYC",
    "processor family": "26, model 2",
    "commit": "60390f11549d",
    "date": "2026-11-20T04:16:08Z",
    "reference kernel": "base, clang-default, with as many steps",
    "rounds": "65",
}


def speedup(module, kernel):
    """znver2 makes everything a tenth slower but for `double_vec` by clang14."""
    compiler, name = module.split("-")
    target = 0.9 if "zen2" in name else 1.0
    if (module, kernel) == ("clang14-zen2", "double_vec"):
        target = 1.8
    return BASE[compiler] * OVER_BASE[kernel] * target


def write(path, rows, notes):
    with open(path, "w", encoding="utf-8", newline="") as out:
        out.writelines(f"# {what}: {text}\n" for what, text in notes.items())
        table = csv.DictWriter(out, list(rows[0]))
        table.writeheader()
        table.writerows(rows)


def timed(kernel, module, steps="1000"):
    ratio = speedup(module, kernel)
    spread = 0.0 if (kernel, module) == ("base", "clang-default") else ratio / 1000
    return {"kernel": kernel, "config": module, "isa": "scalar", "steps": steps} | {
        "ns_median": f"{26000 / ratio:g}",
        "speedup": f"{ratio:g}",
        "speedup_spread": f"{spread:g}",
    }


@pytest.fixture
def folder(tmp_path):
    """What `measure` writes."""
    notes = dict(NOTES)
    for place, module in enumerate(MODULES):
        name = module.split("-")[0]
        notes[module] = f"{name}, version {COMPILERS[name]}, -O3"
        notes[f"module {module}"] = f"print {place}"
    for name in ("configs", "ladder"):
        rows = [timed(kernel, module) for module in MODULES for kernel in OVER_BASE]
        if name == "ladder":
            rows.append(timed("base", "clang-default") | {"kernel": "exact", "config": "library"})
        write(tmp_path / f"{name}.csv", rows, notes)
    cycles = [
        timed(k, f"{c}-zen2", n) for c in COMPILERS for k in OVER_BASE for n in ("10", "1000")
    ]
    write(tmp_path / "cycles.csv", cycles, notes)
    for place, compiler in enumerate(COMPILERS):
        for name in ("zen2", "ordered"):
            module = f"{compiler}-{name}"
            chain = 50000 + 1000 * place - (7000 if name == "ordered" else 0)
            row = {"kernel": "double_vec", "config": module, "chain_cycles_zen2": str(chain)}
            row["chain_cycles_registers"] = str(chain - 14000)
            counted = {"cases": "204, N = 1000", f"module {module}": notes[f"module {module}"]}
            write(tmp_path / f"bounds@{module}.csv", [row | {"shuffles": "9000"}], counted)
    write(tmp_path / "kernels.csv", [{"kernel": "double", "paper": "1.65"}], {})
    shutil.copy(Path(__file__).with_name("experiments.csv"), tmp_path)  # a sheet without kernels
    return tmp_path


def test_a_column_for_each_compiler_and_target(folder):
    found = matrix.columns(folder)
    assert set(found) == {(c, t) for c in COMPILERS for t in ("native", "znver2")}
    for path in found.values():
        assert (path / "kernels.csv").is_file() and (path / "experiments.csv").is_file()


def test_speedups_are_over_the_columns_base(folder):
    """clang14 for znver2: base is 0.72 of the first compiler's, and double_vec 2 times as fast."""
    found = matrix.columns(folder)
    for column, kernel, wanted in (
        (("clang", "native"), "double", 1.6),
        (("clang14", "native"), "double_vec", 1.2),
        (("clang14", "znver2"), "double_vec", 2.4),
        (("clang14", "znver2"), "double", 1.6),
    ):
        run = paper.Run(found[column])
        assert run.reference() == "clang-default"
        assert measures.speedup(run, kernel) == pytest.approx(wanted, rel=1e-4)
        assert measures.speedup(run, kernel).uncertainty > 0.0
    # The first compiler's base is exact in its rounds; another one's scatters too.
    spreads = []
    for compiler in ("clang", "clang14"):
        sheet = Sheet(found[compiler, "native"] / "configs.csv")
        row = sheet.first(kernel="double", config="clang-default")
        spreads.append(float(row["speedup_spread"]))
    assert spreads[1] == pytest.approx(spreads[0] * 2**0.5, rel=0.02)


def test_names_are_those_of_a_plain_run(folder):
    """A column has its compiler's sets of one target, and the other family's."""
    sheet = Sheet(matrix.columns(folder)["clang14", "znver2"] / "configs.csv")
    names = {row["config"] for row in sheet.rows}
    plain = ("default", "archnative", "novec", "o3")
    assert names == {f"{name}-{config}" for name in ("clang", "gcc") for config in plain}
    assert "14.0.6" in sheet.notes["clang-default"]
    assert sheet.notes["module clang-default"] == f"print {MODULES.index('clang14-zen2')}"
    assert machines.compilers_of(sheet).endswith("over base by clang 14.0.6, target znver2")
    alone = Sheet(matrix.columns(folder)["clang14", "znver2"] / "ladder.csv")
    assert {row["config"] for row in alone.rows} == {"clang-default", "library"}
    gcc = paper.Run(matrix.columns(folder)["gcc", "native"])
    assert gcc.reference() == "gcc-default"
    assert gcc.compiler() == "gcc"


def test_counts_are_of_the_compiler(folder):
    """Both targets have the counts and cycles of the set that valgrind runs."""
    found = matrix.columns(folder)
    for target in matrix.SETS:
        run = paper.Run(found["clang14", target])
        assert measures.counted(run, "double_vec", "chain_cycles_zen2") == 52000
        assert run.row("cycles", kernel="double_vec", steps="10")["config"] == "clang-zen2"
        run.compare_modules("clang-zen2")


def test_every_claim_is_judged(folder):
    """As many claims as there are, whatever their number."""
    claims = paper.read_table("claims.csv")
    for path in matrix.columns(folder).values():
        assert len(paper.judge(path)) == len(claims)


def test_recorded(folder, tmp_path):
    """A run for each column; the chains have both sets, from the run of the counted target."""
    path = tmp_path / "recorded" / "machines.csv"
    path.parent.mkdir()
    path.write_text(machines.MACHINES.read_text(encoding="utf-8"), encoding="utf-8")
    found = matrix.columns(folder)
    ids = machines.record([(one, "EPYC 9", paper.judge(one)) for one in found.values()], path)
    assert ids[:2] == ["epyc9-clang22-native", "epyc9-clang22-znver2"]
    assert "epyc9-clang14-znver2" in ids and "epyc9-gcc12-native" in ids
    rows = {row["run"]: row for row in machines.read_machines(path)[1]}
    assert rows["epyc9-clang14-znver2"]["double_vec"] == "2.40"
    chains = machines.table_of_chains(path)
    assert "| clang 14.0.6 | `double_vec` | 52 | 38 | 45 | 2.40 |" in chains
    assert chains.count("clang 14.0.6") == 1
    heads = machines.table_of_verdicts(path).splitlines()[0]
    assert all(f"`{one}`" in heads for one in ids)


def test_commands_measure_all_compilers():
    """Each command of a plain run, with the modules of the matrix."""
    for name in paper.NEEDED:
        assert matrix.commands(name, MODULES, ["base", "exact"]), name
    configs = matrix.commands("configs", MODULES, [])["configs"]
    assert f"--config {','.join(MODULES)}" in configs
    ladder = matrix.commands("ladder", MODULES, ["base", "exact"])["ladder"]
    assert "clang-default,clang-zen2,gcc-default,gcc-zen2,clang14-default,clang14-zen2" in ladder
    assert "--kernel base,exact" in ladder
    counts = matrix.commands("bounds", MODULES, [])
    assert list(counts)[:2] == ["bounds@clang-zen2", "bounds@gcc-zen2"]
    assert counts["bounds@clang14-zen2"] == f"{DATA['bounds'][1]} --config clang14-zen2"
    assert "--config" not in matrix.commands("growth-5000", MODULES, [])["growth-5000"]


def test_a_compiler_without_all_sets_has_no_column():
    assert matrix.compilers_of([*MODULES, "clang15-default"]) == list(COMPILERS)


def test_printed(folder):
    """`carom-lab paper --matrix --from`: a claim a line, the verdicts of each column at the end."""
    words = [sys.executable, "-m", "study.paper", "--matrix", "--from", str(folder)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, env=environment)
    assert done.returncode == 0, done.stderr
    assert "1: clang native" in done.stdout and "clang14 znver2: " in done.stdout
    done = subprocess.run([*words, "--csv"], capture_output=True, text=True, cwd=ROOT)
    rows = list(csv.DictReader(done.stdout.splitlines()))
    assert len(rows) == len(paper.read_table("claims.csv")) * 2 * len(COMPILERS)


def test_nothing_to_judge(tmp_path):
    words = [sys.executable, "-m", "study.paper", "--matrix", "--from", str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 2 and "has no measured matrix" in done.stderr
