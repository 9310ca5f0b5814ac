"""No circle of includes, calls or imports, no arrow against the direction of arrows.txt, and no
source of the library without platform/arithmetic.h, which its bits need: python3 arrows.py SOURCE
"""

import ast
import re
import sys
from collections import defaultdict
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
ROWS = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8")
PARTS = {part: others.split() for part, others in re.findall(r"^part (\w+):(.*)$", ROWS, re.M)}
ALLOWED = {room: others.split() for room, others in re.findall(r"^(\w\S*):(.*)$", ROWS, re.M)}
# These two list the whole interface. A build without the games leaves the functions of games out.
OF_ALL_PARTS = {"core/tests/platforms/bits.c", "core/tests/unit/functions.h"}
# Of a room that has a header for the others, they may include that alone; except the text of
# derivatives, which includes copies of sources in dual/.
HEADER, TEXT = {"core/src/shot": "shot.h"}, "core/src/tangent/text.h"
faults = []


def no_circle(what, arrows):
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as circle:
        faults.append(f"{what} form a circle: {' <- '.join(circle.args[1])}")


def reach(found, arrows):
    reached = set()
    while found:
        reached |= found
        found = set().union(*(arrows.get(one, ()) for one in found)) - reached
    return reached


def is_of_library(file):
    return file.is_relative_to(ROOT / "core/src") or (
        part_of(file) == "games" and room_of(file) in ALLOWED
    )


def room_of(file):
    return str(file.parent.relative_to(ROOT))


# Words of games, which no name of the physics has, except statuses, that all parts share.
OF_GAMES = re.compile(
    r"\b(?!ERROR_|CAROM_ERROR_)(?:\w+_)?(?:standings?|rulings?|scores?|fouls?|winner|innings?|kitchen|referee)(?:_\w+)?\b"
    r"|\bcarom_(?:plan|match|leave|act|may|choice|rules_(?:kind|state|about))\b",
    re.I,
)


def searched(file):
    """The folders that a compiler of this file searches."""
    part = part_of(file)
    rooms = [room for room in ALLOWED if part in ("games", "study") and room.startswith("games/")]
    tests = ["core/tests"] if is_test(file) else []
    return [*rooms, "core/src", "core/include", "games/include", "command", *tests]


def part_of(file):
    return file.relative_to(ROOT).parts[0]


def is_test(file):
    return bool({"test", "tests"} & set(file.relative_to(ROOT).parts))


def may_use(file, found):
    """Whether the part of `file` may use that of `found`; tests may use those of the core."""
    part, other = part_of(file), part_of(found)
    if part == other or str(file.relative_to(ROOT)) in OF_ALL_PARTS:
        return is_test(file) or not is_test(found)
    return other in PARTS[part] and (is_test(file) or not is_test(found))


# C: a source and its header are one unit.
files = [
    file
    for part in PARTS
    for kind in ("h", "hpp", "c", "cpp", "def")
    for file in (ROOT / part).rglob(f"*.{kind}")
    if "node_modules" not in file.parts
]
named = {
    file.name: file for file in reversed(files)
}  # of two with one name that of the earlier room
includes, units, rooms = defaultdict(set), defaultdict(set), defaultdict(set)
for file in files:
    for name in re.findall(
        r'^\s*#\s*include\s+"(?:dual/)?([^"]+)"', file.read_text(encoding="utf-8"), re.M
    ):
        beside = [
            folder / name for folder in (file.parent, *(ROOT / folder for folder in searched(file)))
        ]
        found = next((path for path in beside if path.is_file()), named.get(Path(name).name))
        if found is None:
            continue  # of another package, or made by the build
        includes[file].add(found)
        if found.with_suffix("") != file.with_suffix(""):
            units[str(file.with_suffix("").relative_to(ROOT))].add(
                str(found.with_suffix("").relative_to(ROOT))
            )
        if not may_use(file, found):
            faults.append(
                f"{file.relative_to(ROOT)} includes {found.relative_to(ROOT)}, which is not below it"
            )
        here, there = room_of(file), room_of(found)
        if here != there:
            rooms[here].add(there)
            if there not in ALLOWED.get(here, (there,)):
                faults.append(
                    f"{file.relative_to(ROOT)} includes {found.relative_to(ROOT)}: '{here}' must not know '{there}'"
                )
            if (
                found.name != HEADER.get(there, found.name)
                and file != ROOT / TEXT
                and not is_test(file)
            ):
                faults.append(
                    f"{file.relative_to(ROOT)} includes {found.relative_to(ROOT)}: other rooms include {HEADER[there]} of '{there}'"
                )
for file in files:
    if (
        file.suffix in (".c", ".cpp")
        and is_of_library(file)
        and ROOT / "core/src/platform/arithmetic.h" not in reach({file}, includes)
    ):
        faults.append(
            f"{file.relative_to(ROOT)} does not include platform/arithmetic.h, which its bits need"
        )
for file in files:
    of_record = file.name == "carom_record.h"  # it has members for lines of games
    if file.is_relative_to(ROOT / "core/src") or (
        file.parent == ROOT / "core/include" and not of_record
    ):
        # The names of sets of words are in the core, because carom_word() finds all words; the words
        # of games are rows of games.
        code = re.sub(
            r'/\*.*?\*/|//[^\n]*|\bCAROM_WORDS_\w+|"(?:\\.|[^"\\\n])*"',
            " ",
            file.read_text(encoding="utf-8"),
            flags=re.S,
        )
        faults += [
            f"{file.relative_to(ROOT)}: '{name}' is a word of games, of which the physics knows nothing"
            for name in sorted(set(OF_GAMES.findall(code)))
        ]
no_circle("units", units)
no_circle("rooms", rooms)

# Calls in the library: an arrow from a source to that in which a function stands that it names,
# itself or in an inline function of a header.
stands, through, bodies, calls = {}, {}, {}, {}


def words(text):
    return set(re.findall(r"\bcarom_\w+", text))


for file in (file for file in files if is_of_library(file)):
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", file.read_text(encoding="utf-8"), flags=re.S)
    found = re.findall(
        r"^(static inline )?[a-z_][^\n;{}=]*?\b(carom_\w+)\([^;{}]*\) ?\{(.*?)^\}",
        text,
        re.M | re.S,
    )
    if file.suffix in (".c", ".cpp"):
        stands |= {name: file for _, name, _ in found}
        bodies[file] = words("".join(re.findall(r"\{$.*?^\}", text, re.M | re.S)))
    else:
        through |= {name: words(body) for inline, name, body in found if inline}
for file, found in bodies.items():
    reached = reach(found, through)
    calls[str(file.relative_to(ROOT))] = {
        str(stands[name].relative_to(ROOT)) for name in reached if stands.get(name, file) != file
    }
assert len(stands) > 200 and sum(map(len, calls.values())) > 100, (
    f"only {len(stands)} functions, {sum(map(len, calls.values()))} calls found"
)
no_circle("calls", calls)

# Of the sources that share the state of a search, a header stands for its source: what a unit
# includes and what it calls are one order, so no two units take each other's types and calls.
STATE = "games/search/search_state"
search = {unit for unit, others in units.items() if STATE in others}
assert len(search) >= 7, f"only {sorted(search)} include {STATE}.h"
both = {unit: set(units[unit]) for unit in search}
for file, others in calls.items():
    unit = str(Path(file).with_suffix(""))
    if unit in search:
        both[unit] |= {str(Path(other).with_suffix("")) for other in others}
no_circle("units and calls of the search", both)

# Python: every import, at the top, in a function or for annotations alone.
PACKAGE = ROOT / "python" / "src"
modules = {
    ".".join(path.relative_to(PACKAGE).with_suffix("").parts).removesuffix(".__init__"): path
    for path in PACKAGE.rglob("*.py")
}
imports = defaultdict(set)


def find_imports(module, node):
    for child in ast.iter_child_nodes(node):
        names = [name.name for name in child.names] if isinstance(child, ast.Import) else []
        if isinstance(child, ast.ImportFrom):
            assert child.level == 0, f"{module}: imports are absolute"
            names = [
                name
                for alias in child.names
                for name in (f"{child.module}.{alias.name}", child.module)
            ]
            names = names[:1] if names[0] in modules else names
        imports[module].update(name for name in names if name in modules and name != module)
        find_imports(module, child)


for module, path in modules.items():
    find_imports(module, ast.parse(path.read_text(encoding="utf-8")))
no_circle("modules of python", imports)
# What a folder of the package may import of the others. The core may none, but carom names those
# of games for type checkers.
FOLDERS = {
    "carom.tracks": (),
    "carom.film": ("carom.tracks",),
    "carom.games": (),
    "carom.pooltool": ("carom.games",),
}


def folder_of(module):
    return next((folder for folder in FOLDERS if f"{module}.".startswith(f"{folder}.")), "the core")


def is_short_name(module):
    """Whether it gives all that the module of its name in a folder offers, and nothing else."""
    name = module.removeprefix("carom.")
    text = modules[module].read_text(encoding="utf-8")
    return any(f"\nfrom {folder}.{name} import *\n" in text for folder in FOLDERS)


for module, names in imports.items():
    if is_short_name(module):
        continue
    may = ("carom.games",) if module == "carom" else FOLDERS.get(folder_of(module), ())
    there = {folder_of(name) for name in names} - {folder_of(module), "the core", *may}
    faults += [
        f"{module} imports {folder}, which {folder_of(module)} must not know"
        for folder in sorted(there)
    ]
assert len(files) > 100 and len(imports) > 10, (
    f"only {len(files)} files, {len(imports)} modules found in {ROOT}"
)
print("\n".join(faults))
sys.exit(bool(faults))
