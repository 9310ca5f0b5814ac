"""reference.py SOURCE: the site's reference has every function of C, every method of npm's class,
and every public call of C# and Rust. (tools/site.py looks for the names of Python.)
"""

import re
import sys
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "tools"))

from reference import pages  # noqa: E402

text = {name: page for name, _, page in pages(SOURCE) if name != "Python"}
listed = {name: set(re.findall(r"^### (.*)$", page, flags=re.M)) for name, page in text.items()}
headers = "".join(
    path.read_text(encoding="utf-8")
    for room in ("core/include", "games/include")
    for path in (SOURCE / room).glob("*.h")
)
methods = re.findall(
    r"^  (?:get )?([a-z]\w*)\([^;]*\{$",
    (SOURCE / "web/npm/src/carom.ts").read_text(encoding="utf-8").split("export class Carom {")[1],
    flags=re.M,
)


def calls(pattern, wanted):
    return set(
        re.findall(
            wanted,
            "".join(path.read_text(encoding="utf-8") for path in sorted(SOURCE.glob(pattern))),
            flags=re.M,
        )
    )


csharp = calls(
    "bindings/csharp/Runtime/*.cs",
    r"^    (?:public|protected) (?!override)[\w\[\]<>. ]+ (\w+)(?:\(|[^;\n]*\{ get)",
) - {"Dispose"}
rust = calls("bindings/rust/carom/src/*.rs", r"^ *pub fn (\w+)")
wanted = {
    "C": set(re.findall(r"^CAROM_API [^;(]*?(carom_\w+)\(", headers, flags=re.M)),
    "npm": {f"Carom.{name}" for name in methods if name not in ("constructor",)},
    "C#": csharp,
    "Rust": rust,
}
for name in ("C#", "Rust"):  # without the class
    listed[name] |= {re.split(r"\.|::", one)[-1] for one in listed[name]}
for name, least in {"C": 80, "npm": 25, "C#": 35, "Rust": 30}.items():
    missing = sorted(wanted[name] - listed[name])
    assert not missing and len(wanted[name]) >= least, (
        f"{name}: the reference lacks {missing} of {len(wanted[name])}"
    )
print(", ".join(f"{name} {len(found)}" for name, found in listed.items()), "names")
