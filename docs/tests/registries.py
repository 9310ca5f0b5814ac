"""registries.py SOURCE: no file tells a reader to install carom from a registry that does not have it.

packaging/project.toml lists the registries that have a release (`registries`). As long as npm, PyPI,
crates.io, NuGet, Homebrew, Debian or vcpkg is not among them, its command of the kind `npm install`
with the name carom fails here, in pages, sources, help and tests alike. A path (`pip install
./python`) is not the name.
"""

import re
import sys
import tomllib
from pathlib import Path

SOURCE = Path(sys.argv[1])
FLAGS = r"(?:-\S+\s+)*[\"']?"
END = r"(?![\w/-])"
# How a program names carom in each registry.
COMMANDS = {
    "npm": rf"\b(?:npm|pnpm|yarn|bun)\s+(?:i|install|add)\s+{FLAGS}carom{END}"
    r"|\bnpx\s+carom\b|\b(?:unpkg\.com|cdn\.jsdelivr\.net/npm|esm\.sh)/carom\b",
    "PyPI": rf"\b(?:pip3?|pipx|uv|uv pip|poetry|conda|mamba)\s+(?:install|add)\s+{FLAGS}carom{END}",
    "crates.io": rf"\bcargo\s+(?:add|install)\s+{FLAGS}carom(?:-sys)?{END}",
    "NuGet": rf"\bdotnet\s+add\s+(?:\S+\s+)?package\s+{FLAGS}carom|\bInstall-Package\s+carom"
    r"|<PackageReference\s+Include=\"carom",
    "Homebrew": rf"\bbrew\s+install\s+{FLAGS}carom{END}",
    "Debian": rf"\bapt(?:-get)?\s+install\s+{FLAGS}(?:lib)?carom",
    "vcpkg": rf"\bvcpkg\s+install\s+{FLAGS}carom{END}",
}
SKIPPED = {"build", "dist", ".git", "__pycache__", "node_modules"}


def told(text, registries):
    """The commands in a text that install carom from another registry than these."""
    lines = [line for line in text.splitlines() if "carom" in line.lower()]
    return [
        found[0]
        for registry, command in COMMANDS.items()
        if registry not in registries
        for found in re.finditer(command, "\n".join(lines), flags=re.I)
    ]


def files(source):
    for path in sorted(source.rglob("*")):
        parts = path.relative_to(source).parts
        if not any(part in SKIPPED or part.startswith("build-") for part in parts):
            if path.is_file() and path.name != "registries.py":
                yield path


for wrong in (
    "npm install carom",
    "pnpm add --save carom@1",
    'pip install "carom[jax]"',
    "cargo add carom-sys",
    "dotnet add package Carom.Billiards",
    "apt install libcarom0.4",
):
    assert len(told(wrong, [])) == 1, wrong
for right in ("npm install ../carom/web/npm", "pip install ./python", "apt install ./OUT/*.deb"):
    assert not told(right, []), right
assert not told("npm install carom", ["npm"])

project = tomllib.loads((SOURCE / "packaging/project.toml").read_text(encoding="utf-8"))
unknown = set(project["registries"]) - set(COMMANDS)
assert not unknown, f"packaging/project.toml: no registry {unknown}; known are {list(COMMANDS)}"
faults, count = [], 0
for path in files(SOURCE):
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        continue
    count += 1
    found = told(text, project["registries"])
    faults += [f"{path.relative_to(SOURCE)}: '{command}'" for command in found]
if faults:
    sys.exit("\n".join([*faults, "no registry has carom there yet: say how to build it"]))
print(f"{count} files, none of which installs carom from a registry that lacks it")
