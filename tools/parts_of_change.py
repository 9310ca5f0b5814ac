"""The parts whose tests a change can affect: parts_of_change.py [REVISION] | --check

Prints the parts, for `./test --changed`, of the files that differ between REVISION (default: HEAD)
and the working tree. A file that no row names affects every part. Rows name leaves only: the core,
the build and shared data affect everything. --check fails if a row names no file, or if a part is
unknown.
"""

import re
import subprocess
import sys

PARTS = (
    "core",
    "games",
    "command",
    "study",
    "python",
    "web",
    "bindings",
    "packaging",
    "docs",
    "tools",
    "examples",
)
USERS_OF_THE_LIBRARY = (
    "command",
    "study",
    "python",
    "web",
    "bindings",
    "packaging",
    "docs",
    "examples",
)
# The first pattern that matches a file has it.
ROWS = [
    (r"core/tests/(unit|agree|physics|shots|fuzz|platforms)/", ("core", "games", "packaging")),
    (r"core/tests/", ("core", "games", "command", "study")),
    (r"core/reference/", ("core", "study")),
    (r"games/tests/", ("games",)),
    (r"games/", ("core", "games", *USERS_OF_THE_LIBRARY)),
    (r"command/tests/", ("command", "study")),
    (r"command/", ("command", "study", "web", "bindings", "packaging", "docs")),
    (r"study/tests/", ("study",)),
    (r"study/", ("study", "docs")),
    (r"python/tests/", ("python",)),
    (r"python/", ("python", "bindings", "docs")),
    (r"web/player/", ("command", "study", "web", "docs", "packaging", "python")),
    (r"web/", ("web", "bindings", "docs")),
    (r"bindings/tests/", ("bindings",)),
    (r"bindings/", ("core", "python", "web", "bindings", "packaging", "docs", "study")),
    (r"examples/", ("examples", "bindings", "docs")),
    (r"packaging/", ("packaging", "docs", "bindings")),
    (r"docs/tests/", ("docs", "packaging", "python")),
    (r"docs/|[A-Z_]+\.md$|CITATION\.cff$", ("docs", "packaging", "python")),
    (r"\.github/|LICENSE$|NOTICE$|ruff\.toml$", ("docs", "packaging")),
    (r"tools/(prepare\.sh|python|test_names)$", PARTS),
    (r"tools/", ("tools", "docs", "packaging", "python")),
]


def git(*arguments):
    done = subprocess.run(["git", *arguments], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"tools/parts_of_change.py: git {' '.join(arguments)}: {done.stderr.strip()}")
    return done.stdout.split("\0")[:-1]


def parts_of(name):
    return next((parts for pattern, parts in ROWS if re.match(pattern, name)), PARTS)


def check():
    files = git("ls-files", "-z")
    faults = [
        f"the row {pattern} names no file"
        for pattern, _ in ROWS
        if not any(re.match(pattern, name) for name in files)
    ]
    unknown = {part for _, parts in ROWS for part in parts} - set(PARTS)
    faults += [f"{part} is not a part" for part in sorted(unknown)]
    return faults


if sys.argv[1:] == ["--check"]:
    FAULTS = check()
    print("\n".join(FAULTS))
    sys.exit(bool(FAULTS))
REVISION = sys.argv[1] if len(sys.argv) > 1 else "HEAD"
CHANGED = git("diff", "-z", "--name-only", REVISION)
CHANGED += git("ls-files", "-z", "--others", "--exclude-standard")
AFFECTED = {part for name in CHANGED for part in parts_of(name)}
print(*(part for part in PARTS if part in AFFECTED))
