"""Fingerprints of the code that made the series of a figure.

A series is a kernel in one instruction set and precision. Its fingerprint is a hash of its name and
of the text of the files that compute it, without comments and white space. These are the files that
SOLVERS or the ladder name, and all of ours that they include; for the ladder also the flags of its
configurations. So the fingerprint is the same on every machine, and changes where the code changes.
A measured CSV file notes the fingerprints of its series; a figure whose
notes differ from the tree is stale.
"""

import hashlib
import re
from functools import cache

from study.report.sheets import ROOT, Sheet

# The sources of each solver of the library, those that its calls are linked with; what these files
# include belongs to it too.
SHARED = [
    "core/src/ball_ball/arguments.c",
    "core/src/ball_ball/batch.c",
    "core/src/ball_ball/collide.c",
    "core/src/ball_ball/kernels.c",
    "core/src/platform/elementary.c",
    "core/src/platform/threads.c",
]
COLLOCATION = (
    *SHARED,
    "core/src/ball_ball/collocate.c",
    "core/src/ball_ball/rows.c",
    "core/src/contact_law/advance.c",
    "core/src/contact_law/impact.c",
)
SOLVERS = {
    "exact": COLLOCATION,
    "fast": COLLOCATION,
    "euler": (*SHARED, "core/src/ball_ball/euler.c"),
}
FOLDERS = [ROOT / folder for folder in ("core/src", "study/ladder")]
# Tables of names and of citations, which decide nothing that is measured. Neither do the public
# headers, which change with every new function.
TABLES = {
    ROOT / "study/ladder/kernels.def",
    ROOT / "core/src/schema/numbers.h",
    ROOT / "core/src/schema/sources.h",
}
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*|^# [^\n]*", re.S | re.M)


def roots(kernel):
    """The files in which the kernel begins."""
    if kernel in SOLVERS:
        return [ROOT / name for name in SOLVERS[kernel]]
    ladder = ROOT / "study/ladder"
    return [ladder / f"{kernel}.c", ladder / "resolve.c", ROOT / "study/configs.cmake"]


@cache
def text_of(path):
    """The code of a file, in one line."""
    return " ".join(COMMENT.sub(" ", path.read_text(encoding="utf-8")).split())


@cache
def included(path):
    """The files of FOLDERS that a file includes."""
    found = []
    for name in re.findall(r'^\s*#\s*include\s+"([^"]+)"', path.read_text(encoding="utf-8"), re.M):
        places = [folder / name for folder in (path.parent, *FOLDERS)]
        found += [place.resolve() for place in places if place.is_file()][:1]
    return [path for path in found if path not in TABLES]


def files_of(kernel):
    """All files of a kernel, in the order of their names."""
    reached, waiting = set(), roots(kernel)
    while waiting:
        path = waiting.pop()
        if path not in reached:
            reached.add(path)
            waiting += included(path)
    return sorted(reached)


def fingerprint(kernel, isa, precision):
    digest = hashlib.sha256(f"{kernel} {isa} {precision}".encode())
    for path in files_of(kernel):
        digest.update(f"\n{path.relative_to(ROOT)} {text_of(path)}".encode())
    return digest.hexdigest()[:16]


def stamp(path):
    """Notes the fingerprints of its series in a CSV file that was just measured."""
    names = ("kernel", "isa", "precision")
    series = dict.fromkeys(tuple(row[name] for name in names) for row in Sheet(path).rows)
    notes = "".join(f"# series {', '.join(one)}: {fingerprint(*one)}\n" for one in series)
    path.write_text(notes + path.read_text(encoding="utf-8"), encoding="utf-8")


def stale(path):
    """The series of a CSV file, or of one derived from it, whose code has changed since they were
    measured; and kernels without a fingerprint.
    """
    sheet, found, kernels = Sheet(path), [], set()
    for what, noted in sheet.notes.items():
        if what.startswith("series "):
            one = what.removeprefix("series ").split(", ")
            kernels.add(one[0])
            try:
                today = fingerprint(*one)
            except FileNotFoundError:
                today = "gone"
            if today != noted:
                found.append(", ".join(one))
    return found + sorted({row["kernel"] for row in sheet.rows} - kernels)
