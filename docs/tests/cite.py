"""cite.py SOURCE BUILD: CITATION.cff has what `carom --cite` tells, with the sources of all models.
UPDATE=1 writes it.
"""

import os
import re
import subprocess
import sys
import unicodedata
from pathlib import Path

SOURCE, CAROM = Path(sys.argv[1]), Path(sys.argv[2], "carom")
CUSHIONS = re.findall(
    r'^  X\(\w+, "(\w+)"',
    (SOURCE / "core/src/cushion/list.h").read_text(encoding="utf-8"),
    flags=re.M,
)
assert len(CUSHIONS) >= 6, CUSHIONS
MODELS = [[], *(["--cushion", model] for model in CUSHIONS), ["--world", "pooltool"]]
KINDS = {"article": "article", "book": "book", "misc": "generic", "software": "software"}
ACCENT = re.compile(r'\{?\\"([A-Za-z])\}?')


def entries(bibtex):
    """Key, kind and fields of each entry."""
    for kind, key, body in re.findall(r"^@(\w+)\{([\w-]+),\n(.*?)^\}$", bibtex, flags=re.M | re.S):
        fields = dict(re.findall(r"^  (\w+) = \{(.*)\},?$", body, flags=re.M))
        plain = {
            name: ACCENT.sub(lambda m: m[1] + "\u0308", text).replace("{", "").replace("}", "")
            for name, text in fields.items()
        }
        yield key, kind, {name: unicodedata.normalize("NFC", text) for name, text in plain.items()}


def people(names):
    parts = [name.partition(", ") for name in names.split(" and ")]
    return "".join(
        f"      - family-names: {last}\n        given-names: {first}\n"
        if first
        else f"      - name: {last}\n"
        for last, _, first in parts
    )


found = {}
for models in MODELS:
    said = subprocess.run(
        [CAROM, "--cite", *models], stdout=subprocess.PIPE, text=True, check=True
    ).stdout
    assert len(list(entries(said))) == said.count("@"), said
    found.update({key: (kind, fields) for key, kind, fields in entries(said)})
own = found.pop("carom")[1]
url = f"repository-code: {own['url']}\n" if "url" in own else ""
released = re.search(
    rf"^## {re.escape(own['version'])}, (\d{{4}}-\d\d-\d\d)$",
    (SOURCE / "CHANGELOG.md").read_text(encoding="utf-8"),
    flags=re.M,
)
date = f"date-released: {released[1]}\n" if released else ""
text = f"""# Written by UPDATE=1 ctest -R docs/cite, from core/src/shot/cite.c.
cff-version: 1.2.0
message: If you use carom, please cite it, and the sources of the models that you used (carom --cite).
title: "{own["title"]}"
type: software
version: {own["version"]}
license: Apache-2.0
authors:
{re.sub("^    ", "", people(own["author"]), flags=re.M)}{url}{date}references:
"""
for kind, fields in found.values():
    text += f'  - type: {KINDS[kind]}\n    title: "{fields["title"]}"\n    authors:\n{people(fields["author"])}'
    for name, cff in (
        ("journal", "journal"),
        ("volume", "volume"),
        ("year", "year"),
        ("doi", "doi"),
        ("url", "url"),
        ("note", "notes"),
    ):
        text += f"    {cff}: {fields[name]}\n" if name in fields else ""
    for end, number in zip(("start", "end"), fields.get("pages", "").split("--")):
        text += f"    {end}: {number}\n" if number else ""
page = SOURCE / "CITATION.cff"
if os.environ.get("UPDATE") == "1":
    page.write_text(text, encoding="utf-8")
assert len(found) >= 12, sorted(found)
if not page.is_file() or page.read_text(encoding="utf-8") != text:
    sys.exit("CITATION.cff is not what carom --cite tells; UPDATE=1 writes it")
print(f"{len(found)} sources")
