"""The report's data: every row of contents.DATA becomes a CSV in its folder and a sheet in memory.

What cannot be had leaves an empty sheet, which says why.
"""

import shlex
import shutil
import subprocess
import sys

from .contents import DATA, ROOT, Derived
from .derive import FUNCTIONS
from .sheet import Missing, Sheet


def run(words, options, target=None):
    """Runs a program of the build, or a module of Python, in the tree's root; False if it wrote nothing."""
    command = [options.build / words[0]] if not words[0].startswith("lab.") else [sys.executable, "-m", words[0], "--build", options.build]
    done = subprocess.run([*command, *words[1:]], cwd=ROOT)
    return done.returncode in (0, 1) and (target is None or target.is_file())


def measure(row, options, target, kernels):
    """False if the command wrote nothing. {solvers} becomes the kernels that are not of the ladder."""
    solvers = ",".join(one["kernel"] for one in kernels.rows if not one["parent"]) or "exact,euler"
    words = shlex.split(row.command.replace("{solvers}", solvers))
    if row.share:
        words += ["--budget", f"{options.budget * row.share / 100.0:.4g}"]
    print(f"{row.name}.csv: {' '.join(words)}", flush=True)
    if options.data and row.on_data:
        words += ["--data", options.data]
    return run([*words, "--output", target], options, target)


def copy(source, target):
    """False if there is nothing to copy."""
    if source.is_file() and not (target.exists() and target.samefile(source)):
        shutil.copyfile(source, target)
    return source.is_file()


def obtain(row, options, data):
    """NAME.csv in the report's folder, as a sheet."""
    name, kernels = f"{row.name}.csv", data.get("kernels", Sheet("kernels.csv"))
    target = options.folder / name
    try:
        if isinstance(row, Derived):
            target.write_text("\n".join(list(FUNCTIONS[row.name](data))) + "\n", encoding="utf-8")
        elif options.source is not None:
            if not copy(options.source / name, target):
                raise Missing(f"there is no {name}")
        elif not measure(row, options, target, kernels):
            raise Missing(f"{name} could not be measured")
    except Missing as why:
        if options.source != options.folder or isinstance(row, Derived):
            target.unlink(missing_ok=True)  # an earlier report's
        sheet = Sheet(name)
        sheet.problems.append(str(why) if not isinstance(row, Derived) else f"{name} cannot be made: {why}")
        return sheet
    return Sheet(name, target)


def collect(options):
    """{name: sheet}"""
    data = {}
    for row in DATA:
        data[row.name] = obtain(row, options, data)
    return data
