"""The whole way, measured as briefly as can be, by the programs of the build in $CAROM_BUILD. Figures are not looked at here."""

import os
import shutil

from lab.report.contents import BREAK, DATA, FIGURES_OF_THE_PAGE, Measured
from lab.report.sheet import Sheet


def test_measured(make):
    """Operations are counted in the code that was timed, whatever compiler made it: nothing is missing where valgrind is there."""
    made = make("all", "--build", os.environ.get("CAROM_BUILD", "build"), "--budget", "1")
    counted = shutil.which("valgrind") is not None
    assert made.code == (0 if counted else 1), made.complaints
    said = [line.split(": ") for line in made.out.splitlines() if ".csv: " in line]
    assert [(name.removesuffix(".csv"), command.split()[:2]) for name, command in said] == [
        (row.name, row.command.split()[:2]) for row in DATA if isinstance(row, Measured)
    ]
    for row in DATA:
        if counted or row.name not in ("bounds", "performance"):
            assert Sheet(row.name, made.folder / f"{row.name}.csv").rows, row.name
    accuracy = Sheet("accuracy.csv", made.folder / "accuracy.csv")
    assert accuracy.first(kernel="exact", isa="scalar", precision="double", steps="0")
    assert [row for row in accuracy.rows if row["kernel"] == "exact" and row["isa"] != "scalar" and row["precision"] == "single"]
    assert sorted(made.ids("figure")) == sorted(f"figure-{figure.name}" for figure in [BREAK, *FIGURES_OF_THE_PAGE])
    assert made.missing() == [] or not counted
    assert "speedup over base" in made.out
