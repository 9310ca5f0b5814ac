"""reference.py SOURCE: the site's reference has every function of C, every documented name of Python's package, every method of npm's class, and the
public functions of C# and Rust."""

import ast
import re
import sys
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "tools"))

from reference import pages  # noqa: E402

text = {name: page for name, _, page in pages(SOURCE)}
listed = {name: set(re.findall(r"^### (.*)$", page, flags=re.M)) for name, page in text.items()}
headers = "".join(path.read_text(encoding="utf-8") for path in (SOURCE / "include").glob("*.h"))
package = ast.parse((SOURCE / "python/src/carom/__init__.py").read_text(encoding="utf-8"))
names = next(node.value for node in package.body if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
defined = {node.name for path in (SOURCE / "python/src/carom").glob("[a-z]*.py") for node in ast.parse(path.read_text(encoding="utf-8")).body
           if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and ast.get_docstring(node)}  # fmt: skip
methods = re.findall(r"^  (?:get )?([a-z]\w*)\([^;]*\{$", (SOURCE / "web/src/carom.ts").read_text(encoding="utf-8").split("export class Carom {")[1], flags=re.M)
csharp = re.findall(r"^    public static [\w\[\]]+ (\w+)\(", (SOURCE / "bindings/csharp/Runtime/Billiards.cs").read_text(encoding="utf-8"), flags=re.M)
rust = re.findall(r"^ *pub fn (\w+)", (SOURCE / "bindings/rust/carom/src/lib.rs").read_text(encoding="utf-8"), flags=re.M)
wanted = {
    "C": set(re.findall(r"^CAROM_API [^;(]*?(carom_\w+)\(", headers, flags=re.M)),
    "Python": {name for name in ast.literal_eval(names) if name in defined},
    "npm": {f"Carom.{name}" for name in methods if name not in ("constructor",)},
    "C#": {f"Billiards.{name}" for name in csharp},
    "Rust": set(rust),
}
for name, least in {"C": 80, "Python": 30, "npm": 25, "C#": 4, "Rust": 14}.items():
    missing = sorted(wanted[name] - listed[name])
    assert not missing and len(wanted[name]) >= least, f"{name}: the reference lacks {missing} of {len(wanted[name])}"
print(", ".join(f"{name} {len(found)}" for name, found in listed.items()), "names")
