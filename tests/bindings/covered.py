"""covered.py SOURCE: bindings/covered.txt lists each public function with its header and the languages
whose layer without pointers calls it. The functions are those of the headers, and those that
tests/install/abi-MINOR.expected says that the library exports. UPDATE=1 in the environment writes the
list; what a layer loses or gains is seen in its changes.
"""

import os
import re
import sys
from pathlib import Path

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "bindings"))

from api import describe  # noqa: E402
from match import Python, TypeScript  # noqa: E402
from write import CSharp, Rust, called_by  # noqa: E402

api = describe(SOURCE / "include")
HEADER = (SOURCE / "include/carom.h").read_text()
VERSION = ".".join(re.findall(r"^#define CAROM_VERSION_(?:MAJOR|MINOR) (\d+)$", HEADER, re.M))
functions = {one["name"]: one["header"] for one in api["functions"]}
called = {
    "C++": called_by("include/carom*.hpp", r"\b(carom_\w+)\("),
    "C#": CSharp(api).called(),
    "Rust": Rust(api).called(),
    "Python": Python(api).called(),
    "npm": TypeScript(api).called(),
}
exported = {
    line.removeprefix("exported: ")
    for line in (SOURCE / f"tests/install/abi-{VERSION}.expected").read_text().splitlines()
    if line.startswith("exported: ")
}
if exported != set(functions):
    sys.exit(f"only in the headers or only exported: {sorted(exported ^ set(functions))}")
for language, names in called.items():
    names &= set(functions)
    if not names:
        sys.exit(f"{language}: no call of the library was found")
lines = "".join(
    f"{name}  {functions[name]}  {', '.join(one for one in called if name in called[one]) or '-'}\n"
    for name in sorted(functions)
)

kept = SOURCE / "bindings/covered.txt"
if os.environ.get("UPDATE"):
    kept.write_text(lines, encoding="utf-8")
if kept.read_text(encoding="utf-8") != lines:
    sys.exit("bindings/covered.txt is not what the layers call; UPDATE=1 writes it")
print(
    f"{len(functions)} functions: "
    + ", ".join(f"{language} {len(names)}" for language, names in called.items())
)
