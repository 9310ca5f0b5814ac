"""The whole way, measured as briefly as can be, by the programs of the build in $CAROM_BUILD. Figures are not looked at here."""

import os

from lab.report.contents import DATA, Measured
from lab.report.sheet import Sheet


def test_measured(make):
    made = make("all", "--build", os.environ.get("CAROM_BUILD", "build"), "--budget", "1")
    assert made.code in (0, 1), made.complaints
    said = [line.split(": ") for line in made.out.splitlines() if ".csv: " in line]
    assert [(name.removesuffix(".csv"), command.split()[:2]) for name, command in said] == [
        (row.name, row.command.split()[:2]) for row in DATA if isinstance(row, Measured)
    ]
    for row in DATA:
        if row.name != "performance":  # there is none where the counts are of another processor
            assert Sheet(row.name, made.folder / f"{row.name}.csv").rows, row.name
    accuracy = Sheet("accuracy.csv", made.folder / "accuracy.csv")
    assert accuracy.first(kernel="exact", isa="scalar", precision="double", steps="0")
    assert [row for row in accuracy.rows if row["kernel"] == "exact" and row["isa"] != "scalar" and row["precision"] == "single"]
    assert len(made.ids("figure")) == 11
    assert "speedup over base" in made.out
