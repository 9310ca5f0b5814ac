"""project.py [ROOT]: writes packaging/project.toml into the files of the tree that name address,
tracker, contact, holder, authors and year, and the version of the public header into those that
name it.

A field that is empty is left out. With --check nothing is written: it fails where a file is not as
it would be written, with --missing where a field is empty. With --get NAME it prints a field;
`version` is the public header's.
"""

import json
import re
import sys
import tomllib
from pathlib import Path

NOBODY = "The developers of carom"


def read(root):
    """The fields, with what follows from them."""
    found = tomllib.loads((root / "packaging/project.toml").read_text(encoding="utf-8"))
    header = (root / found["version_in"]).read_text(encoding="utf-8")
    found["version"] = ".".join(
        re.findall(r"^#define CAROM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, flags=re.M)
    )
    found["people"] = [" ".join(reversed(name.split(", ", 1))) for name in found["authors"]]
    found["maintainer"] = found["contact"] or f"{NOBODY} <developers@carom.invalid>"
    found["holder"] = found["copyright"] or NOBODY
    return found


def missing(project):
    return [
        name
        for name in ["address", "tracker", "contact", "copyright", "authors", "year"]
        if not project[name]
    ]


def lines(project):
    """Lines behind the anchor of each file, the first key of which begins an older line: (file,
    anchor, [(key, line)]).
    """
    p, text = project, json.dumps
    name, _, mail = p["contact"].removesuffix(">").partition(" <")
    author = text(", ".join(p["people"]), ensure_ascii=False)
    named = p["people"] or [NOBODY]
    people = ", ".join(f"{{ name = {text(each, ensure_ascii=False)} }}" for each in named)
    urls = ", ".join(
        f"{what} = {text(link)}"
        for what, link in (("Repository", p["address"]), ("Issues", p["tracker"]))
        if link
    )
    yield (
        "python/pyproject.toml",
        "license = ",
        [
            ("authors = ", f"[{people}]"),
            (
                "maintainers = ",
                name and f"[{{ name = {text(name, ensure_ascii=False)}, email = {text(mail)} }}]",
            ),
            ("urls = ", urls and f"{{ {urls} }}"),
        ],
    )
    for crate in ("carom-sys", "carom"):
        yield (
            f"bindings/rust/{crate}/Cargo.toml",
            "license = ",
            [
                ("authors = ", p["authors"] and text(p["people"], ensure_ascii=False)),
                ("repository = ", p["address"] and text(p["address"])),
            ],
        )
    yield (
        "web/npm/package.json",
        '  "license": ',
        [
            ('  "author": ', p["authors"] and f"{author},"),
            (
                '  "repository": ',
                p["address"] and f'{{ "type": "git", "url": {text("git+" + p["address"])} }},',
            ),
            ('  "bugs": ', p["tracker"] and f"{text(p['tracker'])},"),
        ],
    )
    yield (
        "bindings/csharp/package.json",
        '  "license": ',
        [
            ('  "author": ', p["authors"] and f'{{ "name": {author} }},'),
            ('  "documentationUrl": ', p["address"] and f"{text(p['address'])},"),
        ],
    )
    named = ", ".join(
        f"{{ name: {text(each, ensure_ascii=False)}, affiliation: 1 }}" for each in p["people"]
    )
    yield (
        "packaging/paper/paper.md",
        "title: ",
        [
            ("authors: ", named and f"[{named}]"),
            (
                "affiliations: ",
                named and f"[{{ name: {text(p['copyright'], ensure_ascii=False)}, index: 1 }}]",
            ),
        ],
    )
    yield (
        "packaging/conan/conanfile.py",
        "    license = ",
        [
            ("    author = ", p["authors"] and author),
            ("    url = ", p["address"] and text(p["address"])),
        ],
    )


def with_lines(text, anchor, new_lines):
    other_lines = [
        line
        for line in text.splitlines(keepends=True)
        if not line.startswith(tuple(key for key, _ in new_lines))
    ]
    place = next(k for k, line in enumerate(other_lines) if line.startswith(anchor)) + 1
    return "".join(
        [
            *other_lines[:place],
            *(f"{key}{value}\n" for key, value in new_lines if value),
            *other_lines[place:],
        ]
    )


def places(p):
    """What is once or more in the text of a file: (file, pattern of what is before and after,
    what is between).
    """
    minor = p["version"].rpartition(".")[0]
    yield (
        "README.md",
        r"(?m)^(Run these commands in a clone of this repository)(?: \(.*?\))?(\. They take)",
        f" (`git clone {p['address']} carom`)" if p["address"] else "",
    )
    yield (
        "SECURITY.md",
        r"(?m)^(Report a weakness to ).*(, not in public)",
        p["contact"] or "the owner of the repository",
    )
    yield "web/npm/package.json", r'(?m)^(  "version": ")[^"]*(")', p["version"]
    yield "web/package-lock.json", r'("name": "carom",\s+"version": ")[^"]*(")', p["version"]
    yield "docs/using/building.md", r"(`carom/)[\d.]+(`)", p["version"]
    yield "docs/using/building.md", r"(find_package\(carom |`libcarom)[\d.]+( REQUIRED|`)", minor
    yield "docs/reference/compatibility.md", r"(`libcarom\.so\.)[\d.]+(`)", minor
    for test in ("packaging/tests/plain", "packaging/tests/consumer-cmake/CMakeLists.txt"):
        yield test, r"(find_package\(carom )[\d.]+( REQUIRED)", minor


def written(root, p):
    """Each file with the text that it must have."""
    texts = {}

    def text_of(name):
        return texts.get(name) or (root / name).read_text(encoding="utf-8")

    for name, anchor, new_lines in lines(p):
        texts[name] = with_lines(text_of(name), anchor, new_lines)
    for name, pattern, value_text in places(p):
        texts[name] = re.sub(
            pattern,
            lambda match, value_text=value_text: match[1] + value_text + match[2],
            text_of(name),
        )
    holder = (
        f"Copyright {p['year']} {p['copyright']}\n".replace("  ", " ") if p["copyright"] else ""
    )
    texts["NOTICE"] = (
        f"carom: billiards, computed\n{holder}\nLicensed under the Apache License, version 2.0 (LICENSE).\n"
    )
    cited = "".join(
        f"  {key} = {{{value}}},\\n"
        for key, value in (("url", p["address"]), ("year", p["year"]))
        if value
    )
    defined = {
        "AUTHORS": " and ".join(p["authors"]) or f"{{{NOBODY}}}",
        "CITED": cited,
        "TRACKER": p["tracker"],
    }
    macros = "".join(f'#define PROJECT_{key} "{value}"\n' for key, value in defined.items())
    texts["core/src/schema/project.h"] = (
        "/* Written by tools/project.py from packaging/project.toml: authors and lines of the citation as\n"
        " * BibTeX, and for CMake where bugs are reported. */\n#ifndef CAROM_PROJECT_H\n#define CAROM_PROJECT_H\n\n"
        + macros
        + "\n#endif\n"
    )
    return texts


def main():
    flags = [word for word in sys.argv[1:] if word.startswith("--")]
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    if flags == ["--get"]:
        return print(read(Path(__file__).parents[1])[words[0]])
    root = Path(words[0]) if words else Path(__file__).parents[1]
    project, wrong = read(root), []
    if "--missing" in flags:
        empty = missing(project)
        sys.exit(f"packaging/project.toml lacks {', '.join(empty)}" if empty else 0)
    for name, text in written(root, project).items():
        path = root / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            wrong.append(name)
            if "--check" not in flags:
                path.write_text(text, encoding="utf-8")
    if "--check" in flags and wrong:
        sys.exit(
            f"not as packaging/project.toml says: {', '.join(wrong)}; python3 tools/project.py writes them"
        )


if __name__ == "__main__":
    main()
