"""study/motive.py: its table is whole, and follows from what was timed."""

import csv
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))
motive = pytest.importorskip("study.motive")


def test_table(tmp_path):
    file = tmp_path / "motive.csv"
    assert motive.main(["--repeats", "1", "--output", str(file)]) == 0
    lines = file.read_text(encoding="utf-8").splitlines()
    assert any(line.startswith("# processor: ") for line in lines)
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [row["system"] for row in rows] == [
        "example",
        "three-cushion",
        "nine-ball break",
        "eight-ball break",
    ]
    for row in rows:
        share, collisions = float(row["share"]), int(row["collisions"])
        assert 0.0 < share < 1.0 and 0 < collisions < int(row["events"])
        assert float(row["with_paper"]) == pytest.approx(
            1.0 / (1.0 - share + share / motive.PAPER), rel=2e-3
        )
        assert share == pytest.approx(
            float(row["collision_ms"]) / float(row["pooltool_ms"]), rel=1e-2
        )
        assert float(row["drop_in"]) > 1.0


def test_arguments(capsys, monkeypatch):
    with pytest.raises(SystemExit):
        motive.main(["--repeats", "0"])
    monkeypatch.setitem(motive.NEEDED, "no_such_module", "no-such-package")
    assert motive.main([]) == 2
    assert "pip install no-such-package" in capsys.readouterr().err
