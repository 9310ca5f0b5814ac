"""sizes.py SOURCE native BUILD | installed PREFIX | web: every size that README, the pages and the
headers tell is that of what has been built.

native: structs, the stack and the shared library of an optimised build by gcc. installed: the
library that tests/docs/readme.py has installed. web: the package. A figure in bytes
that stands in no row below fails. UPDATE=1 writes the measured figures.
"""

import gzip
import math
import os
import re
import subprocess
import sys
from pathlib import Path

from blocks import pages

MOST, EXACT = (
    "most",
    0.0,
)  # a bound of what is measured; and else by which share of itself a figure may be off
KB, KIB, MB = 1000, 1024, 1000000

# Page, the words around the figure, its unit in bytes, what is measured, how far off.
FIGURES = [
    ("include/carom.h", r"single call takes at most (\d+) KiB", KIB, "stack carom_collide", MOST),
    ("include/carom.h", r"a trace (\d+), a batch", KIB, "stack carom_trace", MOST),
    ("include/carom.h", r"a trace \d+, a batch (\d+), and", KIB, "stack carom_collide_batch", MOST),
    (
        "include/carom.h",
        r"a batch with threads (\d+) in the",
        KIB,
        "threads carom_collide_batch",
        MOST,
    ),
    ("include/carom_shot.h", r"Stack: (\d+) KiB; a batch", KIB, "stack carom_shot_continue", MOST),
    ("include/carom_shot.h", r"KiB; a batch (\d+), with", KIB, "stack carom_shoot_batch", MOST),
    (
        "include/carom_shot.h",
        r"a batch \d+, with threads (\d+)\.",
        KIB,
        "threads carom_shoot_batch",
        MOST,
    ),
    (
        "include/carom_shot.h",
        r"Instead of `balls`, with (\d+) bytes a ball",
        1,
        "carom_shot_ball",
        EXACT,
    ),
    (
        "include/carom_shot.h",
        r"and `states`, with (\d+) bytes a ball",
        1,
        "carom_ball_state",
        EXACT,
    ),
    (
        "include/carom_tangent.h",
        r"Stack: (\d+) KiB; a batch",
        KIB,
        "stack carom_shot_tangent",
        MOST,
    ),
    (
        "include/carom_tangent.h",
        r"KiB; a batch (\d+)\.",
        KIB,
        "threads carom_shot_tangent_batch",
        MOST,
    ),
    (
        "docs/using/shots.md",
        r"takes about (\d+) KiB of stack",
        KIB,
        "stack carom_shot_continue",
        MOST,
    ),
    ("docs/using/games.md", r"`shot\.brief`, (\d+) bytes each", 1, "carom_brief_event", EXACT),
    ("docs/using/games.md", r"bytes each instead of (\d+)\)", 1, "carom_event", EXACT),
    ("docs/using/games.md", r"of `states` takes (\d+) bytes", 1, "carom_ball_state", EXACT),
    ("docs/using/games.md", r"bytes for each ball, not (\d+)\.", 1, "carom_shot_ball", EXACT),
    ("docs/using/games.md", r"(\d+) KiB: all that the shot needs", KIB, "carom_shot_state", EXACT),
    ("docs/using/python.md", r"an event is (\d+) bytes", 1, "carom_brief_event", EXACT),
    ("docs/using/python.md", r"only states: (\d+) bytes a ball", 1, "carom_ball_state", EXACT),
    ("docs/using/python.md", r"bytes a ball\s+instead of (\d+)\.", 1, "carom_shot_ball", EXACT),
    (
        "docs/using/scale.md",
        r"layout of 10 balls\s+has ([\d.]+) kB",
        KB / 10,
        "carom_shot_ball",
        0.02,
    ),
    ("docs/using/scale.md", r"its final states ([\d.]+) kB", KB / 10, "carom_ball_state", 0.02),
    ("docs/using/building.md", r"library takes ([\d.]+) MB with all", MB, "library", 0.15),
    ("docs/using/building.md", r"([\d.]+) MB with `none`", MB, "library with none", 0.15),
    ("docs/using/javascript.md", r"loads one of them: (\d+) kB", KB, "package simd", 0.05),
    ("docs/using/javascript.md", r"with vectors, (\d+) kB", KB, "package plain", 0.05),
]
# Figures in bytes that are no size of anything that is built: the promise of unit/stack, a double,
# and what follows from other figures.
OTHERS = ["72 KiB", "8 bytes, or text", "92 MB/s"]
A_SIZE = re.compile(r"[\d.]+ (?:bytes|kB|KiB|MB|MiB)\b")


def native(source, build):
    """Sizes of structs, by tests/install/abi; bytes of stack, by tests/unit/stack; and of the
    library.
    """
    header = Path(source, "include/carom.h").read_text(encoding="utf-8")
    version = ".".join(re.findall(r"^#define CAROM_VERSION_(?:MAJOR|MINOR) (\d+)$", header, re.M))
    expected = Path(source, f"tests/install/abi-{version}.expected").read_text(encoding="utf-8")
    found = {
        name: int(size) for name, size in re.findall(r"^(\w+): (\d+) bytes", expected, flags=re.M)
    }
    said = subprocess.run(
        [Path(build, "tests/test_stack")], stdout=subprocess.PIPE, text=True, check=True
    ).stdout
    for name, threads, used in re.findall(
        r"^  (carom_\w+) with (\d) threads: (\d+)$", said, flags=re.M
    ):
        name = ("threads " if threads != "0" else "stack ") + name.replace("batch_f32", "batch")
        found[name] = max(found.get(name, 0), int(used))
    return {**found, "library": Path(build, "libcarom.so").stat().st_size}


def installed(_, prefix):
    return {"library with none": next(Path(prefix).glob("lib*/**/libcarom.so")).stat().st_size}


def web(source):
    def compressed(*files):
        return len(gzip.compress(b"".join(file.read_bytes() for file in files), 9))

    dist = Path(source, "web/npm/dist")
    common = [*sorted(dist.glob("*.js")), dist / "generated/layout.js"]
    return {
        f"package {build}": compressed(*common, dist / f"generated/{build}.js")
        for build in ("simd", "plain")
    }


def check(source, mode, *where):
    """Ends the program where a figure is wrong; writes the right ones where that is asked for."""
    measured, wrong, count = (
        {"native": native, "installed": installed, "web": web}[mode](source, *where),
        [],
        0,
    )
    for name in [
        *pages(source),
        *(
            f"{room}/{header.name}"
            for room in ("include", "plan/include")
            for header in sorted(Path(source, room).glob("*.h"))
        ),
    ]:
        text, covered = Path(source, name).read_text(encoding="utf-8"), set()
        for words, unit, what, off in [row for page, *row in FIGURES if page == name]:
            match = re.search(words.replace(" ", r"(?: |\n(?: \*)? *)"), text)
            assert match, f"{name} does not tell the size of {what} in the words '{words}'"
            covered.add(match.start(1))
            if what not in measured:
                continue
            count += 1
            told, right = float(match[1]), measured[what] / unit
            if right > told if off == MOST else abs(told - right) > off * right:
                better = (
                    str(math.ceil(right))
                    if off == MOST
                    else f"{right:.{len(match[1].partition('.')[2])}f}"
                )
                wrong.append(f"{name}: '{match[0]}': it is {better} ({measured[what]} bytes)")
                if os.environ.get("UPDATE") == "1":
                    text = text[: match.start(1)] + better + text[match.end(1) :]
                    Path(source, name).write_text(text, encoding="utf-8")
        for size in [] if wrong or name.startswith("docs/study/") else A_SIZE.finditer(text):
            if size.start() not in covered and not any(
                text.startswith(other, size.start()) for other in OTHERS
            ):
                wrong.append(f"{name}: '{size[0]}' stands in no row of tests/docs/sizes.py")
    assert count >= {"native": 21, "installed": 1, "web": 2}[mode], count
    if wrong and os.environ.get("UPDATE") != "1":
        sys.exit("\n".join(wrong) + "\nUPDATE=1 writes the measured figures")
    print(f"{count} sizes")


if __name__ == "__main__":
    check(*sys.argv[1:])
