"""readme.py SOURCE BUILD CMAKE CC: runs the code blocks of README.md as a reader would who pastes them, in an empty folder.

Blocks of sh run with `carom` on the path; the one that installs is built with one instruction set, to be quick. The C programs are built
by the CMake files of docs/using/building.md and by pkg-config, against what has been installed. blocks.py says what runs the others.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from blocks import blocks

SOURCE, BUILD, CMAKE, CC = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3], sys.argv[4]
QUICK = "-DCAROM_ISAS=none"


def run(command, folder, **more):
    """What it prints; the test fails where the command does."""
    environment = {**os.environ, "CMAKE_BUILD_PARALLEL_LEVEL": "2", "CC": CC, **more}
    done = subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f"{command}\n{done.stdout}exit {done.returncode}")
    return done.stdout


def shell(text, folder, **more):
    return run(["sh", "-eu", "-c", text], folder, **more)


readme, building = blocks(SOURCE, "README.md"), blocks(SOURCE, "docs/using/building.md")
kinds = [kind for kind, _ in readme + building]
assert all(kinds.count(kind) == 1 for kind in ("c", "cmake fetch", "cmake package", "sh install")), kinds
of = dict(readme + building)

with tempfile.TemporaryDirectory() as work:
    work = Path(work)
    reader, clone, home = work / "reader", work / "clone", work / "home"
    for folder in (reader, clone, home):
        folder.mkdir()

    # The shell's blocks share a folder, and leave the pictures that they speak of.
    (reader / "data").symlink_to(SOURCE / "data")
    for kind, text in readme:
        if kind == "sh" and "build/" not in text:
            shell(text, reader, PATH=f"{BUILD}:{os.environ['PATH']}")
    for picture in ("hit", "throw", "shot", "break"):
        assert (reader / f"{picture}.svg").read_text(encoding="utf-8").rstrip().endswith("</svg>"), picture

    # Installing, from a copy of what a clone has.
    for part in ("CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md", "cmake", "cli", "data", "docs", "examples", "include", "src"):
        (clone / part).symlink_to(SOURCE / part)
    assert "cmake -B b " in of["sh install"]
    shell(of["sh install"].replace("cmake -B b ", f"cmake -B b {QUICK} "), clone, HOME=str(home))
    prefix = home / ".local"
    assert "carom 0." in run([prefix / "bin/carom", "--version"], reader)

    # The program, built in each of the three ways.
    said = set()
    for way, more in (("fetch", [QUICK]), ("package", [f"-DCMAKE_PREFIX_PATH={prefix}"])):
        folder = work / way
        folder.mkdir(exist_ok=True)
        if not (folder / "carom").exists():
            (folder / "carom").symlink_to(SOURCE)
        (folder / "main.c").write_text(of["c"], encoding="utf-8")
        (folder / "CMakeLists.txt").write_text(of[f"cmake {way}"], encoding="utf-8")
        run([CMAKE, "-B", "b", *more], folder)
        run([CMAKE, "--build", "b"], folder)
        said.add(run([folder / "b/game"], folder))
    library = next(prefix.glob("lib*/**/libcarom.so")).parent
    shell('"$CC" main.c $(pkg-config --cflags --libs carom) -o game', folder, PKG_CONFIG_PATH=str(library / "pkgconfig"))
    said.add(run(["./game"], folder, LD_LIBRARY_PATH=str(library), CAROM_ISA="plain"))
    assert said == {"ok: ball 1 is hit after 0.111 s\nok: the object ball leaves with 1.103, 0.615 m/s\n"}, said
print("README.md: pasted, installed and built in three ways")
