"""recipes.py DIST OUT: the recipes of Conan, vcpkg, Homebrew and NuGet for the source archive in
DIST, into OUT, and DIST/carom-VERSION.cdx.json, what carom is made of (CycloneDX). The text @NAME@
of packaging/ is replaced by what is known of the release; a line with a field that is empty is left
out, but where the recipe must have an address: that is https://carom.invalid then.
"""

import hashlib
import json
import re
import shutil
import sys
from pathlib import Path
from xml.sax.saxutils import escape

ROOT, DIST, OUT = Path(__file__).resolve().parents[1], Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(ROOT / "tools"))

from project import read  # noqa: E402

project = read(ROOT)
version = project["version"]
name = f"carom-{version}-source.tar.gz"
archive = (DIST / name).read_bytes()
home = project["address"].removesuffix(".git")
known = {
    "VERSION": version,
    "HOMEPAGE": home,
    "ADDRESS": project["address"],
    "ARCHIVE": f"{home or 'https://carom.invalid'}/releases/download/{version}/{name}",
    "HOLDER": project["holder"],
    "AUTHORS": ", ".join(project["people"]) or project["holder"],
    "COPYRIGHT": f"{project['year']} {project['copyright']}".strip(),
    "SHA256": hashlib.sha256(archive).hexdigest(),
    "SHA512": hashlib.sha512(archive).hexdigest(),
}
for kind in ("vcpkg", "homebrew", "nuget"):
    shutil.copytree(ROOT / "packaging" / kind, OUT / kind)
# As conan-center has it, with the program of its test next to it.
conan = OUT / "conan/carom"
shutil.copytree(ROOT / "packaging/conan", conan / "all")
shutil.copytree(
    ROOT / "packaging/tests/consumer-cmake", conan / "all/test_package", dirs_exist_ok=True
)
(conan / "config.yml").write_text(f'versions:\n  "{version}":\n    folder: all\n', encoding="utf-8")
(conan / "all/conandata.yml").write_text(
    f'sources:\n  "{version}":\n    url: "{known["ARCHIVE"]}"\n    sha256: "{known["SHA256"]}"\n',
    encoding="utf-8",
)
for path in OUT.rglob("*"):
    if path.is_file():
        safe = escape if path.suffix == ".nuspec" else str
        filled = [
            line
            for line in path.read_text(encoding="utf-8").splitlines(keepends=True)
            if path.suffix == ".rb"
            or not any(f"@{key}@" in line and not value for key, value in known.items())
        ]
        path.write_text(
            re.sub(
                r"@([A-Z0-9]+)@",
                lambda match: safe(known[match[1]] or "https://carom.invalid"),
                "".join(filled),
            ),
            encoding="utf-8",
        )

npm = json.loads((ROOT / "web/page/package.json").read_text(encoding="utf-8"))["devDependencies"]
PARTS = (ROOT / "tools/parts.txt").read_text(encoding="utf-8")
parts = [
    {
        "type": "library",
        "name": name,
        **({"version": npm[name]} if name in npm else {}),
        "scope": scope,
        "description": use,
        "licenses": [{"license": {"id": licence}}],
    }
    for name, licence, scope, use in re.findall(r"^(\w\S*) +(\S+) +(\S+) +(.+)$", PARTS, re.M)
]
carom = {
    "type": "library",
    "name": "carom",
    "version": version,
    "licenses": [{"license": {"id": project["license"]}}],
    "hashes": [{"alg": "SHA-256", "content": known["SHA256"]}],
}
bill = {
    "bomFormat": "CycloneDX",
    "specVersion": "1.5",
    "version": 1,
    "metadata": {"component": carom},
    "components": parts,
}
(DIST / f"carom-{version}.cdx.json").write_text(json.dumps(bill, indent=1) + "\n", encoding="utf-8")
