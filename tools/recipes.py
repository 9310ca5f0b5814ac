"""recipes.py DIST: the recipes of Conan, vcpkg, Homebrew and NuGet for the source archive in DIST, into DIST/recipes, and DIST/carom-VERSION.cdx.json,
what carom is made of (CycloneDX). The text @NAME@ of packaging/ stands for what is known of the release.
"""

import hashlib
import json
import re
import shutil
import sys
from pathlib import Path
from xml.sax.saxutils import escape

ROOT, DIST = Path(__file__).resolve().parents[1], Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "tools"))

from project import read  # noqa: E402

project = read(ROOT)
version = project["version"]
archive = (DIST / f"carom-{version}.tar.gz").read_bytes()
home = project["address"].removesuffix(".git") or "https://carom.invalid"
known = {"VERSION": version, "HOMEPAGE": home, "ARCHIVE": f"{home}/releases/download/{version}/carom-{version}.tar.gz", "HOLDER": project["holder"],
         "SHA256": hashlib.sha256(archive).hexdigest(), "SHA512": hashlib.sha512(archive).hexdigest()}  # fmt: skip
for kind in ("conan", "vcpkg", "homebrew", "nuget"):
    shutil.copytree(ROOT / "packaging" / kind, DIST / "recipes" / kind, ignore=shutil.ignore_patterns("test_package"))
for path in (DIST / "recipes").rglob("*"):
    if path.is_file():
        safe = escape if path.suffix == ".nuspec" else str
        path.write_text(re.sub(r"@([A-Z0-9]+)@", lambda match: safe(known[match[1]]), path.read_text(encoding="utf-8")), encoding="utf-8")
sources = f'sources:\n  "{version}":\n    url: "{known["ARCHIVE"]}"\n    sha256: "{known["SHA256"]}"\n'
(DIST / "recipes/conan/conandata.yml").write_text(sources, encoding="utf-8")

npm = json.loads((ROOT / "web/package.json").read_text(encoding="utf-8"))["devDependencies"]
PARTS = [  # what is inside packages, and what packages ask for
    ("uplot", npm["uplot"], "MIT", "required", "in the page and in the site's explorer"),
    ("three", npm["three"], "MIT", "required", "in the page and in the site's explorer: the view from behind the cue"),
    ("musl", None, "MIT", "required", "functions in the WebAssembly of the npm package, the page and the site"),
    ("emscripten", None, "MIT", "required", "functions in the WebAssembly of the npm package, the page and the site"),
    ("mkdocs-material", None, "MIT", "required", "style and search of the site"),
    ("libcsv", None, "LGPL-2.1-or-later", "optional", "the command asks for it as a shared library"),
    ("jansson", None, "MIT", "optional", "the command asks for it as a shared library"),
    ("numpy", None, "BSD-3-Clause", "optional", "the Python package asks for it"),
    ("cffi", None, "MIT", "optional", "the Python package asks for it"),
]
parts = [{"type": "library", "name": name, **({"version": number} if number else {}), "scope": scope, "description": use,
          "licenses": [{"license": {"id": licence}}]} for name, number, licence, scope, use in PARTS]  # fmt: skip
carom = {"type": "library", "name": "carom", "version": version, "licenses": [{"license": {"id": project["license"]}}],
         "hashes": [{"alg": "SHA-256", "content": known["SHA256"]}]}  # fmt: skip
bill = {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1, "metadata": {"component": carom}, "components": parts}
(DIST / f"carom-{version}.cdx.json").write_text(json.dumps(bill, indent=1) + "\n", encoding="utf-8")
