"""Writes DIST/RELEASE.md, the text of a release page: a table of all files in DIST, the purpose of
each, and the command that installs it.

release_page.py DIST VERSION [CHECKED] fails where DIST contains a file that this program does not
know, and where a file of a release is missing. CHECKED is the table that packaging/tests/wheels
prints, which the page repeats. Paths in the commands are relative to the folder of the downloads.
"""

import sys
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple

# What this release lists, but what is no package.
OWN = {"RELEASE.md", "SHA256SUMS"}


class Kind(NamedTuple):
    """The files of one kind; FILE in `install` is the name of the file, VERSION the release's."""

    pattern: str
    purpose: str
    install: str


PIP = "`pip install ./FILE`"
KINDS = [
    Kind(
        "carom-*manylinux*_x86_64.whl",
        "Python 3.10 or later on Linux, x86-64, glibc 2.17 or later",
        PIP,
    ),
    Kind(
        "carom-*manylinux*_aarch64.whl",
        "Python 3.10 or later on Linux, arm64, glibc 2.17 or later",
        PIP,
    ),
    Kind("carom-*macosx*_x86_64.whl", "Python 3.10 or later on macOS 11 or later, Intel", PIP),
    Kind(
        "carom-*macosx*_arm64.whl", "Python 3.10 or later on macOS 11 or later, Apple silicon", PIP
    ),
    Kind("carom-*win_amd64.whl", "Python 3.10 or later on Windows 10 or later, x86-64", PIP),
    Kind(
        "carom-VERSION.tar.gz",
        "Python on other systems: pip compiles the library, which requires a C compiler",
        PIP,
    ),
    Kind(
        "carom-VERSION.tgz",
        "JavaScript and TypeScript, in Node and browsers",
        "`npm install ./FILE`",
    ),
    Kind(
        "carom-VERSION-page.zip",
        "the page on which you play in a browser, without a network",
        "unpack it and open `index.html`",
    ),
    Kind(
        "libcarom[0-9]*.deb",
        "the C library, on Debian 12 or later, x86-64",
        "`apt install ./FILE`",
    ),
    Kind(
        "libcarom-dev_*.deb",
        "the headers of the C library",
        "`apt install ./libcarom*.deb`",
    ),
    Kind("carom_*.deb", "the command `carom`", "`apt install ./libcarom[0-9]*.deb ./FILE`"),
    Kind("carom-doc_*.deb", "the documentation and the examples", "`apt install ./FILE`"),
    Kind(
        "carom-VERSION-one-file.zip",
        "the C library as one file, for any build system",
        "unpack it; `cc -O2 app.c carom.c -lm`",
    ),
    Kind(
        "Carom.Billiards.VERSION.nupkg",
        "C# on .NET: sources, and the library for Linux and Windows on x86-64",
        "`dotnet add PROJECT package --source . Carom.Billiards`",
    ),
    Kind(
        "org.carom.billiards-VERSION.tgz",
        "C# in Unity",
        "Package Manager, *Add package from tarball*",
    ),
    Kind(
        "carom-VERSION.crate",
        "Rust",
        "unpack both crates; `cargo add --path carom-VERSION`",
    ),
    Kind(
        "carom-sys-VERSION.crate",
        "Rust: the declarations of the C library and its source, which the crate above requires",
        '`[patch.crates-io]` `carom-sys = { path = "carom-sys-VERSION" }` in Cargo.toml',
    ),
    Kind(
        "carom-VERSION-recipes.tar.gz",
        "recipes for Conan, vcpkg, Homebrew and NuGet",
        "unpack it; `conan create carom-VERSION-recipes/conan/carom/all --version VERSION`",
    ),
    Kind(
        "carom-VERSION-source.tar.gz",
        "the sources of everything",
        "unpack it; `cmake -B b && cmake --build b && cmake --install b`",
    ),
    Kind(
        "carom-VERSION-site.tar.gz",
        "the documentation as a site",
        "unpack it; `python3 -m http.server -d site`",
    ),
    Kind(
        "carom-VERSION-api.json",
        "the C interface as JSON, for authors of bindings",
        "nothing to install",
    ),
    Kind(
        "carom-VERSION.cdx.json",
        "the bill of materials (CycloneDX)",
        "nothing to install",
    ),
]


def rows_of(names: list[str], version: str) -> list[tuple[str, Kind]]:
    """Each file with its kind, in the order of KINDS. A ValueError names each file of no kind, and
    each kind without a file.
    """
    found = [
        (name, kind)
        for kind in KINDS
        for name in names
        if fnmatchcase(name, kind.pattern.replace("VERSION", version))
    ]
    known = [name for name, _ in found]
    wrong = [f"{name}: no row of KINDS describes this file" for name in names if name not in known]
    wrong += [
        f"{name}: two rows of KINDS describe this file"
        for name in set(known)
        if known.count(name) > 1
    ]
    wrong += [
        f"{kind.pattern}: no file of this kind was made"
        for kind in KINDS
        if all(kind != of for _, of in found)
    ]
    if wrong:
        raise ValueError("\n".join(wrong))
    return found


def size_text(size: int) -> str:
    """A number of bytes as people read it."""
    return f"{size / 1e6:.1f} MB" if size >= 1e6 else f"{max(1, round(size / 1e3))} kB"


def page_of(folder: Path, version: str, checked: str) -> str:
    """The text of the page for the files of a folder."""
    names = sorted(path.name for path in folder.iterdir() if path.name not in OWN)
    lines = [
        f"# carom {version}",
        "",
        "Download the files that you need into one folder. `sha256sum --ignore-missing -c SHA256SUMS` checks",
        "them. CHANGELOG.md in the sources lists the changes.",
        "",
        "| file | size | purpose | installation |",
        "|---|--:|---|---|",
    ]
    for name, kind in rows_of(names, version):
        install = kind.install.replace("FILE", name).replace("VERSION", version)
        size = size_text((folder / name).stat().st_size)
        lines.append(f"| `{name}` | {size} | {kind.purpose} | {install} |")
    if checked:
        lines += [
            "",
            "Each wheel was installed into a clean environment for its system, where a break and 201 collisions",
            "had the same bits:",
            "",
            "```",
            *checked.splitlines(),
            "```",
        ]
    return "\n".join(lines) + "\n"


def main() -> None:
    folder, version = Path(sys.argv[1]), sys.argv[2]
    checked = Path(sys.argv[3]).read_text(encoding="utf-8") if len(sys.argv) > 3 else ""
    try:
        text = page_of(folder, version, checked)
    except ValueError as wrong:
        sys.exit(f"tools/release_page.py: {folder}:\n{wrong}")
    (folder / "RELEASE.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
