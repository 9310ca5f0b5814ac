"""covered.py SOURCE: the calls of C that the layers without pointers cover, in C++, C# and Rust,
are those of bindings/covered.txt, a line for each function of the headers. UPDATE=1 in the
environment writes it; what a layer loses or gains is seen in its changes.
"""

import os
import re
import sys
from pathlib import Path

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "bindings"))

from api import describe  # noqa: E402

LAYERS = {
    "C++": ("include/carom*.hpp", r"\b(carom_\w+)\("),
    "C#": ("bindings/csharp/Runtime/*.cs", r"\bNative\.(carom_\w+)\("),
    "Rust": ("bindings/rust/carom/src/*.rs", r"\bsys::(carom_\w+)\("),
}
functions = sorted(one["name"] for one in describe(SOURCE / "include")["functions"])
called = {}
for language, (paths, pattern) in LAYERS.items():
    text = "\n".join(path.read_text(encoding="utf-8") for path in sorted(SOURCE.glob(paths)))
    called[language] = set(
        re.findall(pattern, re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S))
    ) & set(functions)
    if not called[language]:
        sys.exit(f"{paths}: no call of the library was found")
lines = "".join(
    f"{name}: {', '.join(one for one in LAYERS if name in called[one]) or '-'}\n"
    for name in functions
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
