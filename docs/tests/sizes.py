"""sizes.py SOURCE native BUILD | installed PREFIX | web BUILD...: every size that README, the pages
and the headers tell is that of what has been built.

native: structs, the stack and the shared library of an optimised build by gcc. installed: the
library that docs/tests/readme.py has installed. web: the package, whose builds are simd and plain.
A figure in bytes that stands in no row of sizes.txt fails. UPDATE=1 writes the measured figures.
"""

import gzip
import math
import os
import re
import subprocess
import sys
from pathlib import Path

from blocks import pages

MOST = "most"
UNITS = {"bytes": 1, "kB of 10": 100, "kB": 1000, "KiB": 1024, "MB": 1000000}


def figures():
    """Of each page the rows (words, unit in bytes, what is measured, how far off) of sizes.txt."""
    found, page = {}, None
    row = re.compile(rf"  (\S+) +({'|'.join(UNITS)}) +(\S+(?: \S+)*)  +(\S.*)")
    for line in Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").splitlines():
        if match := row.fullmatch(line):
            off, unit, what, words = match.groups()
            off = MOST if off == MOST else float(off.replace("exact", "0"))
            found[page].append((words, UNITS[unit], what, off))
        elif not line.startswith("#"):
            page = line
            found[page] = []
    return found


# Figures in bytes that are no size of anything that is built: the promise of core/unit/stack, a double,
# and what follows from other figures.
OTHERS = [
    "30 bytes",
    "31 bytes",
    "8192 bytes",
    "255 bytes",
    "76 KiB",
    "8 bytes, or text",
    "92 MB/s",
]
A_SIZE = re.compile(r"[\d.]+ (?:bytes|kB|KiB|MB|MiB)\b")


def native(source, build):
    """Sizes of structs, by packaging/tests/abi; bytes of stack, by core/tests/unit/stack; and of the
    library.
    """
    header = Path(source, "core/include/carom.h").read_text(encoding="utf-8")
    version = ".".join(re.findall(r"^#define CAROM_VERSION_(?:MAJOR|MINOR) (\d+)$", header, re.M))
    expected = Path(source, f"packaging/tests/abi-{version}.expected").read_text(encoding="utf-8")
    found = {
        name: int(size) for name, size in re.findall(r"^(\w+): (\d+) bytes", expected, flags=re.M)
    }
    said = subprocess.run(
        [Path(build, "core/tests/test_stack")], stdout=subprocess.PIPE, text=True, check=True
    ).stdout
    for name, threads, used in re.findall(
        r"^  (carom_\w+) with (\d) threads: (\d+)$", said, flags=re.M
    ):
        name = ("threads " if threads != "0" else "stack ") + name.replace("batch_f32", "batch")
        found[name] = max(found.get(name, 0), int(used))
    return {**found, "library": Path(build, "libcarom.so").stat().st_size}


def installed(_, prefix):
    return {"library with none": next(Path(prefix).glob("lib*/**/libcarom.so")).stat().st_size}


def web(source, *builds):
    def compressed(*files):
        return len(gzip.compress(b"".join(file.read_bytes() for file in files), 9))

    dist = Path(source, "web/npm/dist")
    common = [*sorted(dist.glob("*.js")), dist / "generated/layout.js"]
    return {
        f"package {build}": compressed(*common, dist / f"generated/{build}.js") for build in builds
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
            for room in ("core/include", "games/include")
            for header in sorted(Path(source, room).glob("*.h"))
        ),
    ]:
        text, covered = Path(source, name).read_text(encoding="utf-8"), set()
        for words, unit, what, off in figures().get(name, []):
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
                wrong.append(f"{name}: '{size[0]}' stands in no row of docs/tests/sizes.txt")
    assert count >= {"native": 21, "installed": 1, "web": len(where)}[mode], count
    if wrong and os.environ.get("UPDATE") != "1":
        sys.exit("\n".join(wrong) + "\nUPDATE=1 writes the measured figures")
    print(f"{count} sizes")


if __name__ == "__main__":
    check(*sys.argv[1:])
