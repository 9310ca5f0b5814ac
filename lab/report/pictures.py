"""The pictures: gnuplot draws each figure from its CSV by its script; `carom` draws the break. What makes an SVG depend on more than
the data, or keeps it from standing beside others in one page, is put right here.

gnuplot works in a temporary folder, on the rows that the sheet has taken; a picture appears in the report's folder whole or not
at all. What it says on stderr is shown only if it fails: it also warns of every part of a plot that a CSV has no rows for, and
those are optional.
"""

import re
import shlex
import shutil
import subprocess
import tempfile
from html import escape
from pathlib import Path

from .collect import copy, run
from .contents import BREAK
from .sheet import Missing

NO_GNUPLOT = "gnuplot is not installed (Debian: gnuplot-nox)"
PATIENCE = 120  # s for one picture


def run_gnuplot(figure, sheet, ending, narrow, work):
    """The picture's file, or Missing."""
    sheet.write_for_gnuplot(work / sheet.name)
    command = ["gnuplot", "-c", figure.script, sheet.name, f"picture{ending}", figure.title] + ["narrow"] * narrow
    try:
        done = subprocess.run(command, cwd=work, capture_output=True, text=True, errors="replace", timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        raise Missing(f"gnuplot took longer than {PATIENCE} s on {figure.script.name}") from None
    picture = work / f"picture{ending}"
    if done.returncode or not picture.is_file() or not picture.stat().st_size:
        said = [line.strip() for line in done.stderr.splitlines() if line.strip() and not set(line.strip()) <= set("^ ")]
        raise Missing(f"gnuplot failed on {figure.script.name}" + (f" ({said[-1]})" if said else ""))
    return picture


def finished(figure, name, svg):
    """gnuplot's SVG with ids of its own, so that many can stand in one page, and with a title and a description for those who do
    not see it, in place of gnuplot's name and version."""
    svg = re.sub(r"""( id=['"]|url\(#|href=['"]#)""", rf"\1{name}-", svg)
    svg = svg.replace("<title>Gnuplot</title>", f"<title>{escape(figure.title, quote=False)}</title>", 1)
    return re.sub(r"<desc>.*?</desc>", lambda _: f"<desc>{escape(figure.sentence, quote=False)}</desc>", svg, count=1, flags=re.S)


def draw_one(figure, sheet, target, narrow):
    with tempfile.TemporaryDirectory() as work:
        picture = run_gnuplot(figure, sheet, target.suffix, narrow, Path(work))
        if target.suffix == ".svg":
            svg = picture.read_text(encoding="utf-8")
            if "</svg>" not in svg:
                raise Missing(f"gnuplot's picture by {figure.script.name} is cut off")
            target.write_text(finished(figure, target.stem, svg), encoding="utf-8")
        else:
            shutil.copyfile(picture, target)


def draw(figure, sheet, folder, png):
    """Draws FOLDER/NAME.svg and NAME-narrow.svg, and NAME.png if that is wanted; raises Missing, and leaves none of them, where one
    cannot be drawn."""
    targets = [folder / f"{figure.name}{ending}" for ending in (".svg", "-narrow.svg", ".png")]
    for target in targets:
        target.unlink(missing_ok=True)
    sheet.needs_numbers(*figure.needs)
    if not shutil.which("gnuplot"):
        raise Missing(NO_GNUPLOT)
    try:
        for target in targets[: 3 if png else 2]:
            draw_one(figure, sheet, target, target.stem.endswith("-narrow"))
    except Missing:
        for target in targets:
            target.unlink(missing_ok=True)
        raise


def draw_break(options):
    """FOLDER/break.svg, by `carom` or from an earlier report."""
    target = options.folder / f"{BREAK.name}.svg"
    if options.source is not None:
        there = copy(options.source / target.name, target)
    else:
        there = run(shlex.split(BREAK.command.replace("{picture}", shlex.quote(str(target)))), options, target)
    if not there:
        target.unlink(missing_ok=True)
        raise Missing(f"there is no {target.name}")
