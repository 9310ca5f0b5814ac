"""The page: index.html, which needs no other file, from templates/page.html and what has been measured, derived and drawn."""

import os
from pathlib import Path

import jinja2
import markupsafe

from .contents import DATA, FIGURES_OF_THE_PAGE, Measured
from .sheet import Missing
from .tables import TABLES

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


def tables_of(data):
    """(tables, {name: why there is none})"""
    tables, missing = {}, {}
    for name, make in TABLES.items():
        try:
            tables[name] = make(data)
        except Missing as why:
            missing[name] = str(why)
    return tables, missing


def write_page(folder, data, missing_figures, problems):
    """Writes FOLDER/index.html; returns its path."""
    tables, missing_tables = tables_of(data)
    ladder = data["ladder"]
    figures = {figure.name: figure for figure in FIGURES_OF_THE_PAGE}
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    page = environment.get_template("page.html").render(
        figures=figures,
        pictures={name: svg_of(folder, name) for name in figures if name not in missing_figures},
        narrow={name: svg_of(folder, f"{name}-narrow") for name in figures if name not in missing_figures},
        missing_figures=missing_figures,
        tables=tables,
        missing_tables=missing_tables,
        problems=problems,
        machine=[(what, ladder.note(what)) for what in MACHINE if ladder.note(what)],
        commands=[(row.name, row.command) for row in DATA if isinstance(row, Measured)],
    )
    target = folder / "index.html"
    beside = folder / f"index.html.{os.getpid()}"
    beside.write_text(page, encoding="utf-8")
    os.replace(beside, target)
    return target
