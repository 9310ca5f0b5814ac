"""The report's data: every row of contents.DATA becomes a CSV in its folder and a sheet in memory.

What cannot be had leaves an empty sheet, which says why.
"""

import shlex
import shutil
import subprocess

from .contents import DATA, Derived, Measured
from .derive import FUNCTIONS
from .sheet import Missing, Sheet


def words_of(command, kernels):
    """The command's words; {solvers} becomes the kernels that are no rung of the ladder."""
    solvers = ",".join(row["kernel"] for row in kernels.rows if not row["parent"]) or "exact,euler"
    return shlex.split(command.replace("{solvers}", solvers))


def measure(row, options, target, kernels):
    """Runs the command; False if it wrote nothing."""
    program, *words = words_of(row.command, kernels)
    if row.share:
        words += ["--budget", f"{options.budget * row.share / 100.0:.4g}"]
    print(f"{row.name}.csv: {program} {' '.join(words)}", flush=True)
    if options.data and row.on_data:
        words += ["--data", options.data]
    return subprocess.run([options.build / program, *words, "--output", target]).returncode in (0, 1)


def copy(source, target):
    """False if there is nothing to copy."""
    if not source.is_file():
        return False
    if not (target.exists() and target.samefile(source)):
        shutil.copyfile(source, target)
    return True


def derive(row, target, data):
    """Writes the lines; Missing where they cannot be made."""
    lines = list(FUNCTIONS[row.name](data))
    target.write_text("\n".join(lines) + "\n", encoding="utf-8")


def obtain(row, options, data):
    """NAME.csv in the report's folder, as a sheet."""
    name, kernels = f"{row.name}.csv", data.get("kernels", Sheet("kernels.csv"))
    target = options.folder / name
    try:
        if isinstance(row, Derived):
            derive(row, target, data)
        elif options.source is not None or not isinstance(row, Measured):
            if not copy(options.source / name if options.source else row.path, target):
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
