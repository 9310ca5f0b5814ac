"""The command: `tools/python -m lab.report DIR`, from the root of the tree."""

import argparse
import sys
from pathlib import Path

from .collect import collect
from .contents import BREAK, FIGURES_OF_THE_PAGE, ROOT
from .page import summary, write_page
from .pictures import NO_GNUPLOT, draw, draw_break
from .sheet import Missing

ABOUT = """Verifies and times the kernels, and writes to DIR (made if it is not there): the CSV files, the figures as SVG, and
index.html, one page with the figures and tables and the seed paper's values beside ours. Figures are drawn by gnuplot; without
it the CSV files and the tables come all the same. docs/study/report.md says which command makes which file, and how to add a figure."""

AFTER = """exit code: 0 if all is there, 1 if data or figures are missing (the page says which), 2 for bad usage or if DIR cannot be
written

example:
  tools/python -m lab.report --budget 55 build/results/report"""


def complain(message):
    print(f"report: {message}", file=sys.stderr)


def seconds(text):
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value <= 86400.0:
        raise argparse.ArgumentTypeError(f"is a number of seconds above 0, up to 86400, not '{text}'")
    return value


def arguments(words):
    parser = argparse.ArgumentParser(
        prog="report", description=ABOUT, epilog=AFTER, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", metavar="DIR", help="where the report goes")
    parser.add_argument("--budget", type=seconds, default=110.0, metavar="SECONDS", help="how long to measure in all (default 110)")
    parser.add_argument("--from", dest="source", metavar="DIR2", help="measure nothing: take an earlier report's CSV files from DIR2")
    parser.add_argument("--png", action="store_true", help="the figures as PNG too")
    parser.add_argument("--data", metavar="DIR3", help="folder of the cases and references (default: the programs' own)")
    parser.add_argument("--build", default=ROOT / "build", metavar="DIR4", type=Path, help="folder of the programs (default build)")
    options = parser.parse_args(words)
    if not options.folder:
        parser.error("the name of the folder is empty")
    options.folder = Path(options.folder).resolve()
    options.build = options.build.resolve()
    options.data = Path(options.data).resolve() if options.data else None
    if options.source is not None:
        options.source = Path(options.source).resolve()
        if not options.source.is_dir():
            parser.error(f"--from: there is no folder {options.source}")
    for program in ("carom", "carom-lab"):
        if options.source is None and not (options.build / program).is_file():
            parser.error(f"there is no program {options.build / program}; build it, or say with --build where it is")
    return options


def draw_all(options, data):
    """{name of a figure: why it could not be drawn}"""
    missing = {}
    try:
        draw_break(options)
    except Missing as why:
        missing[BREAK.name] = str(why)
        complain(str(why))
    for figure in FIGURES_OF_THE_PAGE:
        try:
            draw(figure, data[figure.csv], options.folder, options.png)
            print(f"{figure.name}: {figure.title}", flush=True)
        except Missing as why:
            missing[figure.name] = str(why)
            if str(why) != NO_GNUPLOT:
                complain(f"no figure {figure.name}: {why}")
    if NO_GNUPLOT in missing.values():
        complain(f"no figures: {NO_GNUPLOT}; the CSV files and the page's tables come all the same")
    return missing


def main(words):
    options = arguments(words)
    try:
        options.folder.mkdir(parents=True, exist_ok=True)
        data = collect(options)
        problems = [problem for sheet in data.values() for problem in sheet.problems]
        for problem in problems:
            complain(problem)
        missing = draw_all(options, data)
        for line in ["", *summary(data), ""]:
            print(line)
        print(f"report: {write_page(options.folder, data, missing, problems)}")
    except OSError as error:
        complain(f"cannot write the report: {error}")
        return 2
    return 1 if missing or problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
