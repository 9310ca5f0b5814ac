"""readme.py SOURCE BUILD CMAKE CC: runs the code blocks of README.md as a reader would who pastes
them, in an empty folder.

The block that installs is built with one instruction set, to be quick, and what CMake fetches without
optimisation too. The C program is built by the CMake
files of docs/using/building.md and by the blocks `sh program` of both pages, against what has been
installed, with nothing in the environment that the pages do not put there. blocks.py says what runs
the others.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from blocks import blocks
from sizes import check

SOURCE, BUILD, CMAKE, CC = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3], sys.argv[4]
QUICK = "-DCAROM_ISAS=none"
for variable in (
    "PKG_CONFIG_PATH",
    "LD_LIBRARY_PATH",
    "LD_RUN_PATH",
    "CPATH",
    "C_INCLUDE_PATH",
    "LIBRARY_PATH",
    "CMAKE_PREFIX_PATH",
):
    os.environ.pop(variable, None)


def run(command, folder, **more):
    """What it prints; the test fails where the command does."""
    environment = {**os.environ, "CMAKE_BUILD_PARALLEL_LEVEL": "2", "CC": CC, **more}
    done = subprocess.run(
        command,
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if done.returncode:
        sys.exit(f"{command}\n{done.stdout}exit {done.returncode}")
    return done.stdout


def shell(text, folder, **more):
    return run(["sh", "-eu", "-c", text], folder, **more)


readme, building = blocks(SOURCE, "README.md"), blocks(SOURCE, "docs/using/building.md")
kinds = [kind for kind, _ in readme + building]
assert all(
    kinds.count(kind) == 1 for kind in ("c", "cmake fetch", "cmake package", "sh install")
), kinds
of, programs = (
    dict(readme + building),
    [text for kind, text in readme + building if kind == "sh program"],
)
assert len(programs) == 2, programs

# The times of README are those of accuracy.md, rounded; the default solver stands first.
rows = re.findall(
    r"^\|.*\| ([\d,]+) \| \d+ \| ", (SOURCE / "README.md").read_text(encoding="utf-8"), flags=re.M
)
measured = {
    round(float(number))
    for number in re.findall(
        r"\b\d+(?:\.\d+)?\b",
        (SOURCE / "docs/understanding/accuracy.md").read_text(encoding="utf-8"),
    )
}
assert len(rows) >= 6 and all(int(row.replace(",", "")) in measured for row in rows), rows

with tempfile.TemporaryDirectory() as work:
    work = Path(work)
    reader, clone, home = work / "reader", work / "clone", work / "home"
    for folder in (reader, clone, home):
        folder.mkdir()

    # Installing, from a copy of what a clone has.
    for part in (
        "CMakeLists.txt",
        "LICENSE",
        "NOTICE",
        "README.md",
        "CHANGELOG.md",
        "cmake",
        "command",
        "core",
        "data",
        "examples",
        "games",
    ):
        (clone / part).symlink_to(SOURCE / part)
    (clone / "web").symlink_to(SOURCE / "web")
    # Pages are copied: a folder that is a link would be installed as one, and changed in the source.
    shutil.copytree(SOURCE / "docs", clone / "docs")
    pages = [SOURCE / "README.md", SOURCE / "CHANGELOG.md", *(SOURCE / "docs").rglob("*.md")]
    kept = {page: page.read_bytes() for page in pages}
    # Then the program, in the same shell, and in a new one; and by CMake, which finds what is
    # beside a folder of the path.
    assert "cmake -B b " in of["sh install"]
    (reader / "main.c").write_text(of["c"], encoding="utf-8")
    installing = of["sh install"].replace("cmake -B b ", f"cmake -B b {QUICK} ")
    printed = [
        shell(f"{installing}cd {reader}\n{programs[0]}", clone, HOME=str(home)),
        shell(programs[1], reader, HOME=str(home)),
    ]
    said = {text.splitlines()[-1] for text in printed}
    prefix = home / ".local"
    assert "carom 0." in run([prefix / "bin/carom", "--version"], reader)
    # The links of installed pages are made right there, not behind a link in the source.
    changed = [str(page) for page, before in kept.items() if page.read_bytes() != before]
    assert not changed, f"installing changed the source: {changed}"
    check(SOURCE, "installed", prefix)
    for way, more in (("fetch", [QUICK, "-DCMAKE_BUILD_TYPE=None"]), ("package", [])):
        folder = work / way
        folder.mkdir()
        (folder / "carom").symlink_to(SOURCE)
        (folder / "main.c").write_text(of["c"], encoding="utf-8")
        (folder / "CMakeLists.txt").write_text(of[f"cmake {way}"], encoding="utf-8")
        run([CMAKE, "-B", "b", *more], folder, PATH=f"{prefix}/bin:{os.environ['PATH']}")
        run([CMAKE, "--build", "b"], folder)
        said.add(run([folder / "b/game"], folder).strip())
    assert said == {"ok: ball 1 is hit after 0.129 s"}, said
print("README.md: pasted, installed and built in four ways")
