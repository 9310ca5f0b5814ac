"""The page: index.html, which needs no other file, from templates/page.html and what has been measured, derived and drawn; and what the
report says on standard output at its end."""

import os
from pathlib import Path

import jinja2
import markupsafe

from .contents import BREAK, DATA, FIGURES_OF_THE_PAGE, Measured
from .derive import default_config
from .sheet import Missing
from .tables import TABLES, library_calls, number

TEMPLATES = Path(__file__).with_name("templates")
MACHINE = ["processor", "processor family", "cores", "system", "reference cycles", "pinning", "load before", "counters"] + [
    "commit",
    "compiler",
    "flags",
    "date",
]


def svg_of(folder, name):
    """The picture without the XML declaration, which only a file of its own may have."""
    svg = (folder / f"{name}.svg").read_text(encoding="utf-8")
    return markupsafe.Markup(svg[svg.index("<svg") :])


def write_page(folder, data, missing_figures, problems):
    """Writes FOLDER/index.html; returns its path."""
    tables, missing_tables = {}, {}
    for name, make in TABLES.items():
        try:
            tables[name] = make(data)
        except Missing as why:
            missing_tables[name] = str(why)
    ladder = data["ladder"]
    figures = {figure.name: figure for figure in [BREAK, *FIGURES_OF_THE_PAGE]}
    shapes = {name: ["", "-narrow"] if figure is not BREAK else [""] for name, figure in figures.items() if name not in missing_figures}
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    page = environment.get_template("page.html").render(
        figures=figures,
        pictures={name: [svg_of(folder, name + shape) for shape in of] for name, of in shapes.items()},
        missing_figures=missing_figures,
        tables=tables,
        missing_tables=missing_tables,
        problems=problems,
        machine=[(what, ladder.note(what)) for what in MACHINE if ladder.note(what)],
        commands=[(f"{row.name}.csv", row.command) for row in DATA if isinstance(row, Measured)],
    )
    target = folder / "index.html"
    beside = folder / f"index.html.{os.getpid()}"
    beside.write_text(page, encoding="utf-8")
    os.replace(beside, target)
    return target


def summary(data):
    """Lines of the speedups: the ladder, the library's single calls, and its batches with the highest instruction set, which comes last."""
    rungs, ladder = data["speedup"], data["ladder"]
    if not rungs.rows:
        return
    shown = [(row, row.number("ns"), row["paper_text"]) for row in rungs.rows]
    shown += [(row, row.number("ns_median"), "the library's") for row in library_calls(ladder)]
    batches = [row for row in ladder.rows if row["config"] == "library" and row["isa"] != "scalar"]
    for row in batches:
        if row["isa"] == batches[-1]["isa"]:
            says = f"in batches, {row['isa']}, {row['precision']}, {row['threads']} thread{'' if row['threads'] == '1' else 's'}"
            shown.append((row, row.number("ns_median"), says))
    yield f"speedup over {rungs.rows[0]['kernel']}, {default_config(ladder)}, N = 1000, {rungs.note('processor') or 'processor unknown'}"
    yield f"{'kernel':<17} {'ns':>9} {'speedup':>9}  paper"
    for row, ns, says in shown:
        speedup = row.number("speedup")
        yield (
            f"{row['kernel']:<17} {number('%.0f' if ns >= 1000.0 else '%.1f', ns):>9} "
            f"{number('%.2f' if speedup < 100.0 else '%.0f', speedup):>9}  {says}"
        )
