"""terms.py SOURCE: docs/using/glossary.md has each term of games/rules/pot_kind.c with the meaning that stands there.

UPDATE=1 in the environment writes the meanings of the terms that the page has; a new term is put on the page by hand, where it belongs.
"""

import os
import re
import sys
from pathlib import Path

SOURCE = Path(sys.argv[1])
PAGE = SOURCE / "docs/using/glossary.md"
WIDTH = 118
STRING = r'"(?:[^"\\]|\\.)*"'


def terms() -> dict[str, str]:
    """The names and meanings of the table in C; a value without a meaning is no term."""
    text = (SOURCE / "games/rules/pot_kind.c").read_text(encoding="utf-8")
    table = text[text.index("static const carom_term terms[TERMS] = {") :].partition("\n")[2]
    table = table[: table.index("\n};")]
    rows = re.findall(rf"\[\w+\] = \{{\s*({STRING}),\s*((?:{STRING}\s*)+)\}}", table)
    if len(rows) != len(re.findall(r"\[\w+\] =", table)):
        sys.exit("games/rules/pot_kind.c has a row of another form than [TERM] = {NAME, MEANING}")
    found = {
        name[1:-1]: "".join(part[1:-1] for part in re.findall(STRING, meaning))
        for name, meaning in rows
    }
    return {name: meaning for name, meaning in found.items() if meaning}


def wrapped(words: list[str]) -> str:
    """A list item in lines of at most WIDTH characters."""
    lines = ["-"]
    for word in words:
        if len(lines[-1]) + 1 + len(word) > WIDTH:
            lines.append(" ")
        lines[-1] += " " + word
    return "\n".join(lines) + "\n"


page = PAGE.read_text(encoding="utf-8")
faults = []
for name, meaning in terms().items():
    item = wrapped(f"**{name.capitalize()}**: {meaning}".split())
    found = re.search(rf"^- \*\*{re.escape(name.capitalize())}\*\*:.*\n(?:  .*\n)*", page, re.M)
    if found is None:
        faults.append(f"{name} is missing")
    elif os.environ.get("UPDATE"):
        page = page[: found.start()] + item + page[found.end() :]
    elif found[0].split() != item.split():
        faults.append(f"{name} is not as in games/rules/pot_kind.c")
if os.environ.get("UPDATE"):
    PAGE.write_text(page, encoding="utf-8")
if faults:
    sys.exit("docs/using/glossary.md: " + "; ".join(faults) + "; UPDATE=1 writes meanings")
print(f"{len(terms())} terms of the library are in the glossary")
