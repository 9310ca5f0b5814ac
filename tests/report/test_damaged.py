"""Damaged CSV: whatever the files contain, there is a well-formed page, which names what is missing, and the rest is there."""

import os
import random
import shutil
import time

import pytest
from conftest import STORED

from lab.report.contents import FIGURES_OF_THE_PAGE
from lab.report.sheet import Missing, Sheet

SEED = int(os.environ.get("CAROM_TEST_SEED", "20141"))
NAMES = sorted(path.stem for path in STORED.glob("*.csv"))


def lines_of(name):
    return (STORED / f"{name}.csv").read_text(encoding="utf-8").splitlines()


def split(name):
    """(notes, header, rows) of a stored CSV."""
    lines = lines_of(name)
    notes = [line for line in lines if line.startswith("#")]
    header, *rows = lines[len(notes) :]
    return notes, header, rows


def shuffled_bytes(name, source):
    data = bytearray((STORED / f"{name}.csv").read_bytes())
    for _ in range(len(data) // 8):
        data[source.randrange(len(data))] = source.randrange(256)
    return bytes(data)


def damaged(name, kind):
    notes, header, rows = split(name)
    width = header.count(",") + 1
    source = random.Random(f"{SEED} {name} {kind}")
    made = {
        "empty": b"",
        "no header": "\n".join(notes).encode(),
        "header alone": "\n".join(notes + [header]).encode(),
        "other columns": "\n".join(notes + [header.upper()] + rows).encode(),
        "words for numbers": "\n".join(notes + [header] + [",".join(["word"] * width)] * 5).encode(),
        "empty fields": "\n".join(notes + [header] + ["," * (width - 1)] * 5).encode(),
        "extremes": "\n".join(notes + [header] + [",".join([text] * width) for text in ("0", "-1", "nan", "inf", "1e308")]).encode(),
        "cut off": "\n".join(lines_of(name)).encode()[: -len(rows[-1]) // 2 - 1],
        "open quotes": "\n".join(notes + [header] + ['"' + row for row in rows]).encode(),
        "noise": source.randbytes(5000),
        "noise inside": shuffled_bytes(name, source),
    }
    return made[kind]


KINDS = ["empty", "no header", "header alone", "other columns", "words for numbers", "empty fields", "extremes", "cut off"] + [
    "open quotes",
    "noise",
    "noise inside",
]


def copy_of_stored(folder):
    folder.mkdir()
    for name in NAMES:
        shutil.copy(STORED / f"{name}.csv", folder)
    shutil.copy(STORED / "break.svg", folder)
    return folder


@pytest.mark.parametrize("kind", KINDS)
def test_every_file_damaged_alone(kind, make, tmp_path):
    print(f"seed {SEED} (replay with CAROM_TEST_SEED)")
    for name in NAMES:
        source = copy_of_stored(tmp_path / name)
        (source / f"{name}.csv").write_bytes(damaged(name, kind))
        made = make(f"of_{name}", "--from", source, PATH="/nowhere")
        assert made.code == 1 and "Traceback" not in made.complaints, made.complaints
        assert len(made.ids("figure")) == len(FIGURES_OF_THE_PAGE) + 1
        if kind in ("empty", "no header", "open quotes"):
            assert f"{name}.csv" in made.page[made.page.index('<h2 id="missing"') :]


@pytest.mark.parametrize("kind", KINDS)
def test_all_files_damaged_and_drawn(kind, make, tmp_path):
    print(f"seed {SEED} (replay with CAROM_TEST_SEED)")
    source = tmp_path / "source"
    source.mkdir()
    for name in NAMES:
        (source / f"{name}.csv").write_bytes(damaged(name, kind))
    made = make("made", "--from", source)
    assert "Traceback" not in made.complaints, made.complaints
    assert len(made.ids("figure")) == len(FIGURES_OF_THE_PAGE) + 1
    if kind in ("empty", "no header", "header alone", "other columns", "words for numbers", "empty fields", "open quotes", "noise"):
        assert made.code == 1
        assert len([text for text in made.missing() if "could not be drawn" in text]) == len(FIGURES_OF_THE_PAGE) + 1


def test_a_bad_row_costs_that_row(make, tmp_path):
    source = copy_of_stored(tmp_path / "source")
    text = (source / "steps.csv").read_text(encoding="utf-8").rstrip("\n")
    (source / "steps.csv").write_text(text[: text.rindex(",")] + "\n", encoding="utf-8")
    made = make("made", "--from", source)
    number = len(text.splitlines())
    assert made.code == 1
    assert f"report: steps.csv:{number}: 14 fields, but the header has 15: the row is left out" in made.complaints
    assert f"<li>steps.csv:{number}: 14 fields" in made.page
    assert made.missing() == [] and (made.folder / "runtime.svg").exists()


def test_what_is_missing_is_named(make, tmp_path):
    source = copy_of_stored(tmp_path / "source")
    for name, column, other in [("steps", "ns_median", "ns"), ("verify", "verdict", "judgement")]:
        path = source / f"{name}.csv"
        path.write_text(path.read_text(encoding="utf-8").replace(column, other, 1), encoding="utf-8")
    made = make("made", "--from", source)
    assert "report: no figure runtime: steps.csv has no column ns_median" in made.complaints
    assert "There is no table: verify.csv has no column verdict." in made.missing()


def test_a_value_is_no_command(make, tmp_path):
    """The scripts hand names from the CSV to a shell and to awk, cut at blanks."""
    source, trap = copy_of_stored(tmp_path / "source"), tmp_path / "trap"
    touch = f"touch${{IFS}}{trap}"
    for name in NAMES:
        notes, header, rows = split(name)
        for place in range(header.count(",") + 1):
            for evil in (f"';{touch};'", f"$({touch})", f"`{touch}`", f'"+system("{touch}")+"'):
                fields = rows[0].split(",")
                rows.append(",".join(fields[:place] + [evil] + fields[place + 1 :]))
        (source / f"{name}.csv").write_text("\n".join(notes + [header] + rows) + "\n", encoding="utf-8")
    made = make("made", "--from", source)
    assert not trap.exists() and "Traceback" not in made.complaints


@pytest.mark.parametrize("name", NAMES)
def test_time_grows_as_the_rows_do(name, make, tmp_path):
    """100,000 rows of any file: were some step quadratic in Python, this would take hours."""
    notes, header, rows = split(name)
    source = copy_of_stored(tmp_path / "source")
    many = [rows[k % len(rows)] for k in range(100_000)]
    (source / f"{name}.csv").write_text("\n".join(notes + [header] + many) + "\n", encoding="utf-8")
    begun = time.monotonic()
    made = make("made", "--from", source, PATH="/nowhere")
    assert "Traceback" not in made.complaints
    assert time.monotonic() - begun < 60.0


def test_names_without_end_make_no_table_without_end(make, tmp_path):
    """A table of kernels by builds has a cell for each pair: not where every row has names of its own."""
    source = copy_of_stored(tmp_path / "source")
    notes, header, rows = split("configs")
    many = [",".join([f"kernel{k}", f"build{k}"] + rows[k % len(rows)].split(",")[2:]) for k in range(20_000)]
    (source / "configs.csv").write_text("\n".join(notes + [header] + many) + "\n", encoding="utf-8")
    made = make("made", "--from", source, PATH="/nowhere")
    assert "but rows for few of their pairs" in " ".join(made.missing())


def test_a_sheet_is_read_as_it_stands(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b'\xef\xbb\xbf# what: this\r\n# other\nk,n\nx,1\n\ny,"2,5"\nz\n"open,3\nx,\xff\x1b\n')
    sheet = Sheet("a.csv", path)
    assert sheet.note("what") == "this" and sheet.note("other") is None
    assert [row.fields for row in sheet.rows] == [["x", "1"], ["y", "2,5"], ["x", "\ufffd\ufffd"]]
    assert sheet.problems == [
        "a.csv:7: 1 fields, but the header has 2: the row is left out",
        "a.csv:8: not CSV: the row is left out",
    ]
    assert len(sheet.groups("n")) == 3 and sheet.first(n="1")["n"] == "1"
    with pytest.raises(Missing, match="a.csv has no column absent"):
        sheet.needs("n", "absent")


@pytest.mark.parametrize("was, now", [("Clang 19.1.7", "Clang 22.1.0"), ("-O3 -march=znver2", "-O2 -march=znver2")])
def test_times_of_other_code_than_was_counted(make, tmp_path, was, now):
    """Operations that clang 19 emits over the time of what another clang or other flags made would be no figure of either."""
    part = tmp_path / "part"
    part.mkdir()
    for name in ("cycles", "bounds", "kernels"):
        shutil.copy(STORED / f"{name}.csv", part)
    bounds = part / "bounds.csv"
    text = bounds.read_text(encoding="utf-8")
    assert was in text
    bounds.write_text(text.replace(was, now), encoding="utf-8")
    made = make("other", "--from", part)
    assert "performance.csv cannot be made: clang-zen2 was timed as built by 'clang, Debian Clang 19.1.7" in made.complaints
    assert not (made.folder / "performance.csv").exists() and not (made.folder / "performance.svg").exists()
    assert all("%" not in row[13] for row in made.table("operations")[1:])
