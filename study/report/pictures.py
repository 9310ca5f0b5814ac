"""Pictures of CSV files, by gnuplot."""

import re
import subprocess
from html import escape

from study.report.sheets import Sheet, complain


def draw(folder, name, source, title, script):
    """NAME.svg of the folder, by a gnuplot script from SOURCE.csv next to it, with ids of its own,
    so that many can be in one page. Without rows there is no picture.
    """
    target = folder / f"{name}.svg"
    target.unlink(missing_ok=True)
    if not Sheet(folder / f"{source}.csv").rows:
        return
    done = subprocess.run(
        ["gnuplot", "-c", script, f"{source}.csv", target.name, title],
        cwd=folder,
        capture_output=True,
        text=True,
    )
    svg = target.read_text(encoding="utf-8") if target.is_file() else ""
    if done.returncode or "</svg>" not in svg:
        complain(f"gnuplot could not draw {name}: {done.stderr.strip()}")
        target.unlink(missing_ok=True)
        return
    svg = re.sub(r"""( id=['"]|url\(#|href=['"]#)""", rf"\1{name}-", svg)
    svg = re.sub(
        r"<title>Gnuplot</title>\s*<desc>.*?</desc>",
        lambda _: f"<title>{escape(title)}</title>",
        svg,
        count=1,
        flags=re.S,
    )
    target.write_text(svg, encoding="utf-8")
