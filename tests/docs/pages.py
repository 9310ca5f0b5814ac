"""pages.py SOURCE BUILD PYTHON-ENVIRONMENT: runs the shell blocks of the docs, and those of README
that speak of the study, as a reader would who has run ./run: in a folder with the tree's own
folders and its build.

The report's blocks find measured CSV files in DIR. Blocks that take minutes are started, line by
line, and ended after half a second: they must not end in error before.
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from blocks import blocks, pages

SOURCE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
ENVIRONMENT = {
    **os.environ,
    "CAROM_PYTHON_ENVIRONMENT": sys.argv[3],
    "PYTHONDONTWRITEBYTECODE": "1",
}
START = 0.5  # seconds


def start(line, folder):
    """Fails where the command ends in error within that time; then ends it, with all that it has
    started.
    """
    job = subprocess.Popen(
        ["sh", "-c", line],
        cwd=folder,
        env=ENVIRONMENT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        said, code = job.communicate(timeout=START)[1], job.returncode
    except subprocess.TimeoutExpired:
        said, code = "", 0
        os.killpg(job.pid, signal.SIGKILL)
        job.communicate()
    return f"{line}\n{said}exit {code}" if code else None


run = started = 0
with tempfile.TemporaryDirectory() as work:
    folder = Path(work)
    for part in ["bindings", "data", "tools", "docs", "cli", "lab"]:
        (folder / part).symlink_to(SOURCE / part)
    shutil.copytree(
        SOURCE / "study", folder / "study"
    )  # whose report looks for the build from where it lies
    (folder / "build").symlink_to(BUILD)
    (folder / "DIR").mkdir()
    for measured in [
        *Path(SOURCE, "docs/figures/data").glob("*.csv"),
        *Path(SOURCE, "tests/report").glob("*.csv"),
        Path(SOURCE, "docs/figures/break.svg"),
    ]:
        shutil.copy(measured, folder / "DIR")
    shutil.copy(folder / "DIR/steps.csv", folder)
    # The stored times and counts are of two modules, which the report would not divide.
    for name in ("cycles.csv", "bounds.csv"):
        rows = (folder / "DIR" / name).read_text(encoding="utf-8").splitlines(keepends=True)
        kept = "".join(row for row in rows if not row.startswith("# module "))
        (folder / "DIR" / name).write_text(f"# module clang-zen2: 1111\n{kept}", encoding="utf-8")
    for page in pages(SOURCE):
        for kind, text in blocks(SOURCE, page):
            if kind == "sh started":
                failures = [start(line, folder) for line in text.splitlines() if line]
                started += len(failures)
                if any(failures):
                    sys.exit(f"{page}: " + "\n".join(filter(None, failures)))
            elif kind == "sh" and (page != "README.md" or "build/" in text):
                done = subprocess.run(
                    ["sh", "-eu", "-c", text],
                    cwd=folder,
                    env=ENVIRONMENT,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                    text=True,
                )
                if done.returncode:
                    sys.exit(f"{page}:\n{text}{done.stdout[-4000:]}exit {done.returncode}")
                run += 1
    # What they leave, where they leave something.
    for name in ("OTHER/index.html", "runtime.svg"):
        assert (folder / name).stat().st_size > 1000, name
assert run >= 3 and started >= 12, (run, started)
print(f"{run} blocks run, {started} lines started")
