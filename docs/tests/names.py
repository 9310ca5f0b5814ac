"""Files and functions that comments of the sources name exist: python3 names.py SOURCE"""

import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
ROOMS = (
    "bindings",
    "cmake",
    "command",
    "core",
    "docs/tests",
    "examples",
    "games",
    "packaging/tests",
    "python",
    "study",
    "tools",
    "web/npm/src",
    "web/npm/test",
    "web/page/src",
    "web/page/test",
    "web/player",
)
# Functions of the C library, of compilers and of the sources of papers and other programs that
# comments may name.
ELSEWHERE = {
    "fmin",
    "fmax",
    "memcpy",
    "strtod",
    "exp",
    "cos",
    "sin",
    "atan2",
    "pow",
    "sqrt",
    "printf",
    "fopen",
    "dup",
    "any",
    "abort",
    "mkstemp",
}
SOURCES = {
    path
    for room in ROOMS
    for path in (ROOT / room).rglob("*")
    if path.is_file() and "node_modules" not in path.parts
}
NAMES = {path.name for path in SOURCES}
code, comments = [], []
for path in sorted(SOURCES):
    if path.suffix not in (".c", ".h", ".cpp", ".def"):
        continue
    text = path.read_text(encoding="utf-8")
    found = re.findall(r"/\*.*?\*/|//[^\n]*", text, re.S)
    comments += [(path.relative_to(ROOT), comment) for comment in found]
    code.append(re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S))
words = set(re.findall(r"\w+", "\n".join(code)))
faults = []
for path, comment in comments:
    if path.parts[0] not in ("core", "games", "command") or "tests" in path.parts:
        continue
    for name in re.findall(
        r"(?<![\w*<])((?:[\w-]+/)*[\w-]+\.(?:c|h|cpp|py|sh|expected))\b", comment
    ):
        if "NAME" in name:
            continue
        there = (
            (ROOT / name).exists() or (ROOT / "core/src" / name).exists()
            if "/" in name
            else name in NAMES
        )
        if not there:
            faults.append(f"{path}: a comment names the file {name}, which does not exist")
    for name in re.findall(r"\b([a-z_]\w+)\(\)", comment):
        if name not in words and name not in ELSEWHERE:
            faults.append(f"{path}: a comment names the function {name}(), which does not exist")
assert len(comments) > 1000, f"only {len(comments)} comments in {ROOT}"
print("\n".join(sorted(set(faults))))
sys.exit(bool(faults))
