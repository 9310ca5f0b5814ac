"""A report from the stored run: whole, the same bytes each time, and without what is not there."""

import os
import re
import shutil
import xml.etree.ElementTree as tree

from conftest import STORED

from lab.report.contents import FIGURES_OF_THE_PAGE

OPENING = ["accuracy", "speedup", "break"]
FIGURES = [*OPENING, "runtime", "configs", "performance", "experiments", "trace", "smooth", "isas", "batch", "floor"]
PLOTTED = [name for name in FIGURES if name != "break"]
SECTIONS = ["paper", "table-speedups", "table-verification", "table-configurations", "table-operations", "physics", "table-experiments"] + [
    "batches",
    "table-batches",
    "machine",
    "again",
]
PICTURES = [f"{name}{kind}.svg" for name in PLOTTED for kind in ("", "-narrow")]
GIVEN = sorted(path.name for path in [*STORED.glob("*.csv"), STORED / "break.svg"])


def bytes_of(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def test_it_is_whole(stored):
    assert stored.code == 0, stored.complaints
    assert sorted(GIVEN + ["index.html", "performance.csv", "speedup.csv"] + PICTURES) == sorted(
        bytes_of(stored.folder)
    )
    assert stored.ids("figure") == [f"figure-{name}" for name in FIGURES]
    assert stored.ids("h2", "h3") == SECTIONS
    assert stored.missing() == []
    assert stored.page.count("<svg") == len(PICTURES) + 1


def test_the_page_opens_with_what_carom_is_and_its_best_pictures(stored):
    opening = stored.page[: stored.page.index('<h2 id="paper"')]
    assert "carom computes collisions of billiard balls" in opening
    assert [name for name in FIGURES if f'id="figure-{name}"' in opening] == OPENING
    assert "missing" not in opening[opening.index("<body>") :]


def test_a_title_stands_once(stored):
    """The title of a picture is drawn in it; neither its caption nor a heading repeats it."""
    outside = re.sub(r"<svg.*?</svg>", "", stored.page, flags=re.S)
    for picture in stored.page.split("<svg")[1:]:
        title = re.search("<title>(.*?)</title>", picture)
        assert title is None or title[1] not in outside, title


def test_the_same_bytes_each_time(stored, make):
    assert bytes_of(make("again", "--from", STORED).folder) == bytes_of(stored.folder)
    assert bytes_of(make("own", "--from", stored.folder).folder) == bytes_of(stored.folder)
    before = bytes_of(stored.folder)
    assert make("stored", "--from", stored.folder).code == 0
    assert bytes_of(stored.folder) == before


def test_it_needs_nothing_from_outside(stored):
    for outside in (" src=", "<link", "<script", "@import"):
        assert outside not in stored.page
    for element in stored.elements:
        assert all(value.startswith("#") for name, value in element.attrib.items() if name.endswith("href"))


def test_every_picture_says_what_it_is(stored):
    pictures = [e for e in stored.elements if e.tag == "{http://www.w3.org/2000/svg}svg" and e[0].tag.endswith("title")]
    titles = {figure.name: figure.title for figure in FIGURES_OF_THE_PAGE}
    assert [picture[0].text for picture in pictures] == [titles[name] for name in PLOTTED for _ in ("wide", "narrow")]
    assert all(int(picture.get("width")) == 470 for picture in pictures[1::2])
    assert all(picture[1].tag.endswith("desc") and len(picture[1].text) > 80 for picture in pictures)
    for name in PICTURES:
        assert "Gnuplot" not in (stored.folder / name).read_text(encoding="utf-8")


def test_what_the_tables_say(stored):
    """Every cell of every table, as in tables.expected; UPDATE=1 rewrites it."""
    said = "".join(
        f"{name}\n" + "".join("    " + " | ".join(row) + "\n" for row in stored.table(name))
        for name in [section.removeprefix("table-") for section in SECTIONS if section.startswith("table-")]
    )
    expected = STORED / "tables.expected"
    if os.environ.get("UPDATE"):
        expected.write_text(said, encoding="utf-8")
    assert said == expected.read_text(encoding="utf-8")


def test_what_the_captions_quote(stored):
    for text in [
        "The best is <b>float with clang-archnative, 1.95</b>; in the paper it is float with archnative on clang, 1.93.",
        "counted in the code that was timed: clang, Debian Clang 19.1.7 (3~deb12u1), -O3 -march=znver2",
        "15 of 15 comparisons are within their bounds.",
        "<dt>clang-default</dt><dd>clang, Debian Clang 19.1.7",
        "<dt>processor</dt><dd>AMD EPYC</dd>",
    ]:
        assert text in stored.page, text


def test_the_speedups_as_text(stored):
    said = stored.out.splitlines()
    assert "speedup over base, clang-default, N = 1000, AMD EPYC" in said
    assert "float                  8941      1.93  1.87" in said
    assert "exact                  64.6       266  in batches, avx512, single, 2 threads" in said


def test_png(make):
    made = make("png", "--png", "--from", STORED)
    assert made.code == 0
    for name in PLOTTED:
        assert (made.folder / f"{name}.png").read_bytes()[1:4] == b"PNG"


def test_without_gnuplot(make):
    made = make("bare", "--from", STORED, PATH="/nowhere")
    assert made.code == 1
    assert made.complaints == (
        "report: no figures: gnuplot is not installed (Debian: gnuplot-nox); the CSV files and the page's tables come all the same\n"
    )
    assert made.ids("h2", "h3") == SECTIONS
    assert len(made.missing()) == len(PLOTTED)
    assert all("gnuplot is not installed" in text for text in made.missing())
    assert sorted(bytes_of(made.folder)) == sorted(GIVEN + ["index.html", "performance.csv", "speedup.csv"])


def test_with_a_part_of_the_data(make, tmp_path):
    part = tmp_path / "part"
    part.mkdir()
    for name in ("kernels", "ladder", "steps"):
        shutil.copy(STORED / f"{name}.csv", part)
    made = make("some", "--from", part)
    absent = [name for name in GIVEN if name not in ("kernels.csv", "ladder.csv", "steps.csv")]
    assert made.code == 1
    for name in absent:
        assert f"report: there is no {name}" in made.complaints.splitlines()
    assert "report: performance.csv cannot be made: there are no data in cycles.csv" in made.complaints.splitlines()
    assert sorted(path.stem for path in made.folder.glob("*.svg")) == ["runtime", "runtime-narrow", "speedup", "speedup-narrow"]
    assert "There is no table: there are no data in verify.csv." in made.missing()
    assert made.table("speedups")[1][0] == "base"


def test_an_earlier_report_does_not_show_through(stored, make, tmp_path):
    part = tmp_path / "part"
    part.mkdir()
    shutil.copy(STORED / "kernels.csv", part)
    made = make("stored", "--from", part)
    assert made.code == 1 and list(made.folder.glob("*.svg")) == [] and not (made.folder / "ladder.csv").exists()


def test_usage(make, tmp_path):
    (tmp_path / "file").write_text("")
    for name, words, says in [
        ("one", ["two"], "unrecognized arguments"),
        ("one", ["--budget", "0"], "--budget: is a number of seconds above 0, up to 86400, not '0'"),
        ("one", ["--from", tmp_path / "nowhere"], "there is no folder"),
        ("one", ["--build", tmp_path], "there is no program"),
        ("file", ["--from", STORED], "cannot write the report"),
    ]:
        made = make(name, *words)
        assert made.code == 2 and says in made.complaints, made.complaints
        assert not (tmp_path / "one").exists()
    help = make("one", "--help")
    assert help.code == 0 and "example:\n  tools/python -m lab.report" in help.out


def test_the_foot_names_the_compiler_of_what_is_drawn(stored):
    """The ladder's kernels are clang's here, the library's gcc's; their speedups are over a kernel of the ladder."""
    for name, library, ladder in [("isas", True, True), ("batch", True, True), ("runtime", False, True), ("accuracy", True, True), ("speedup", False, True)]:
        for kind in ("", "-narrow"):
            picture = (stored.folder / f"{name}{kind}.svg").read_text(encoding="utf-8")
            assert ("library: gcc 12.2.0;" in picture) == library, name
            assert ("Debian Clang 19" in picture) == ladder, name
            assert "-ffast-math" in picture, name


def test_nothing_is_written_beyond_the_edges(stored):
    svg = "{http://www.w3.org/2000/svg}"
    for name in PLOTTED:
        for kind in ("", "-narrow"):
            picture = tree.parse(stored.folder / f"{name}{kind}.svg").getroot()
            width, height = map(float, picture.get("viewBox").split()[2:])
            places = [g.get("transform") for g in picture.iter(svg + "g") if g.find(svg + "text") is not None]
            for x, y in (map(float, place[len("translate(") :].split(")")[0].split(",")) for place in places):
                assert 0 <= x <= width and 0 <= y <= height - 2, (name, kind, x, y)
