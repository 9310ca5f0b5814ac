"""project.py SOURCE BUILD CC: the files of the tree are as packaging/project.toml says, and a copy
of which it is filled has every field.

The command is linked once more with the citation of the copy, by which CITATION.cff is made there.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

SOURCE, BUILD, CC = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
FIELDS = {
    "address": "https://example.org/carom.git",
    "tracker": "https://example.org/carom/issues",
    "contact": "Zoë Kö <zoe@example.org>",
    "copyright": "The Example Society",
    "authors": ["Kö, Zoë", "Doe, Jo"],
    "year": "2031",
}


def run(*command, code=0, **more):
    done = subprocess.run(
        [str(word) for word in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        **more,
    )
    assert done.returncode == code, f"{command}\n{done.stdout}"
    return done.stdout


def toml(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


run(sys.executable, SOURCE / "tools/project.py", "--check")
with tempfile.TemporaryDirectory() as work:
    work = Path(work)
    for part in [
        "CMakeLists.txt",
        "LICENSE",
        "NOTICE",
        "README.md",
        "CHANGELOG.md",
        "SECURITY.md",
        "CITATION.cff",
        "cmake",
        "core",
        "games",
        "command",
        "data",
        "packaging",
        "tools",
    ]:
        (shutil.copytree if (SOURCE / part).is_dir() else shutil.copy)(SOURCE / part, work / part)
    for part in [
        "python/pyproject.toml",
        "web/npm/package.json",
        "web/page/package.json",
        "web/package-lock.json",
        "docs/using/building.md",
        "docs/reference/compatibility.md",
        "packaging/tests/plain",
        "packaging/tests/consumer-cmake/CMakeLists.txt",
        "packaging/tests/consumer-cmake/consumer.c",
        "bindings/csharp/package.json",
        "bindings/rust/carom/Cargo.toml",
        "bindings/rust/carom-sys/Cargo.toml",
    ]:
        (work / part).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(SOURCE / part, work / part)
    shutil.copytree(SOURCE / "web/player", work / "web/player")
    tool = [sys.executable, work / "tools/project.py"]
    before = {path: path.read_bytes() for path in work.rglob("*") if path.is_file()}

    def fill(fields):
        text = (SOURCE / "packaging/project.toml").read_text(encoding="utf-8")
        for name, value in fields.items():
            text, found = re.subn(
                rf'^{name} = ("[^"]*"|\[[^]]*\])',
                lambda match: f"{name} = {json.dumps(value, ensure_ascii=False)}",
                text,
                flags=re.M,
            )
            assert found == 1, f"packaging/project.toml has no {name}"
        (work / "packaging/project.toml").write_text(text, encoding="utf-8")

    # What is missing is told by name.
    fill({**FIELDS, "tracker": ""})
    assert run(*tool, "--missing", code=1).strip() == "packaging/project.toml lacks tracker"
    fill(FIELDS)
    assert not run(*tool, "--missing")
    assert "not as packaging/project.toml says: python/pyproject.toml" in run(
        *tool, "--check", code=1
    )
    run(*tool)
    run(*tool, "--check")

    python = toml(work / "python/pyproject.toml")["project"]
    assert python["authors"] == [{"name": "Zoë Kö"}, {"name": "Jo Doe"}] and python[
        "maintainers"
    ] == [{"name": "Zoë Kö", "email": "zoe@example.org"}]
    assert python["urls"] == {"Repository": FIELDS["address"], "Issues": FIELDS["tracker"]}
    for crate in ("carom", "carom-sys"):
        rust = toml(work / f"bindings/rust/{crate}/Cargo.toml")["package"]
        assert rust["authors"] == ["Zoë Kö", "Jo Doe"] and rust["repository"] == FIELDS["address"]
    npm, csharp = (
        json.loads((work / part).read_text(encoding="utf-8"))
        for part in ("web/npm/package.json", "bindings/csharp/package.json")
    )
    assert (
        npm["author"] == csharp["author"]["name"] == "Zoë Kö, Jo Doe"
        and npm["bugs"] == FIELDS["tracker"]
    )
    assert (
        npm["repository"]["url"] == "git+" + FIELDS["address"]
        and csharp["documentationUrl"] == FIELDS["address"]
    )
    assert "Copyright 2031 The Example Society\n" in (work / "NOTICE").read_text(encoding="utf-8")
    assert "repository (`git clone https://example.org/carom.git carom`). They take" in (
        work / "README.md"
    ).read_text(encoding="utf-8")
    assert "Report a weakness to Zoë Kö <zoe@example.org>, not" in (work / "SECURITY.md").read_text(
        encoding="utf-8"
    )
    conan = (work / "packaging/conan/conanfile.py").read_text(encoding="utf-8")
    assert '    author = "Zoë Kö, Jo Doe"\n    url = "https://example.org/carom.git"\n' in conan

    # The recipes of a release: filled, and without what is empty.
    def recipes(name):
        dist, out = work / name, work / name / "recipes"
        dist.mkdir()
        (dist / f"carom-{toml_version}-source.tar.gz").write_bytes(b"an archive")
        run(sys.executable, work / "tools/recipes.py", dist, out)
        texts = {
            str(path.relative_to(out)): path.read_text(encoding="utf-8")
            for path in out.rglob("*")
            if path.is_file()
        }
        assert not any(re.search(r"@[A-Z0-9]+@", text) for text in texts.values())
        return (
            texts,
            json.loads(texts["vcpkg/vcpkg.json"]),
            json.loads((dist / f"carom-{toml_version}.cdx.json").read_text(encoding="utf-8")),
        )

    toml_version = run(*tool, "--get", "version").strip()
    texts, manifest, bill = recipes("filled")
    assert manifest["homepage"] == "https://example.org/carom" and len(bill["components"]) >= 8
    # vcpkg takes & and | together between parentheses only.
    assert all(not ({"&", "|"} <= set(part)) for part in re.split(r"[()]", manifest["supports"])), (
        manifest["supports"]
    )
    for name, words in {
        "nuget/Carom.Billiards.nuspec": '<repository type="git" url="https://example.org/carom.git" />',
        "homebrew/carom.rb": 'homepage "https://example.org/carom"',
        "conan/carom/all/conandata.yml": f"/releases/download/{toml_version}/carom-{toml_version}-source.tar.gz",
        "conan/carom/config.yml": "folder: all",
        "conan/carom/all/test_package/CMakeLists.txt": "find_package(carom",
        "conan/carom/all/conanfile.py": 'author = "Zoë Kö, Jo Doe"',
    }.items():
        assert words in texts[name], f"{name}: no {words}"
    assert (
        "<authors>Zoë Kö, Jo Doe</authors>\n    <copyright>2031 The Example Society</copyright>"
        in texts["nuget/Carom.Billiards.nuspec"]
    )

    # The command, and the citation that is made of what it says.
    run(
        CC,
        "-std=c17",
        "-Icore/include",
        "-Icore/src",
        "-c",
        "core/src/shot/cite.c",
        "-o",
        "cite.o",
        cwd=work,
    )
    (work / "b").mkdir()
    libraries = [
        BUILD / "command/libcarom_cli_parts.a",
        BUILD / "libcarom.a",
        *os.environ.get("LDLIBS", "-lcsv -ljansson").split(),
        "-lm",
        "-pthread",
    ]
    run(
        CC,
        "-Icore/include",
        "-Icommand",
        "command/main.c",
        "cite.o",
        *libraries,
        "-o",
        "b/carom",
        cwd=work,
    )
    said = run("b/carom", "--cite", cwd=work)
    assert (
        "author = {Kö, Zoë and Doe, Jo},\n  url = {https://example.org/carom.git},\n  year = {2031},\n"
        in said
    ), said
    run(
        "cmake",
        "-S",
        work,
        "-B",
        work / "c",
        "-G",
        "Ninja",
        f"-DCMAKE_C_COMPILER={CC}",
        "-DCAROM_CLI=ON",
        "-DCAROM_ISAS=none",
    )
    compiled = json.loads((work / "c/compile_commands.json").read_text(encoding="utf-8"))
    assert any(
        f'CAROM_TRACKER=\\"{FIELDS["tracker"]}\\"' in entry["command"]
        for entry in compiled
        if entry["file"].endswith("report.c")
    )
    run(
        sys.executable,
        SOURCE / "docs/tests/cite.py",
        work,
        work / "b",
        env={**os.environ, "UPDATE": "1"},
    )
    cff = (work / "CITATION.cff").read_text(encoding="utf-8")
    people = "".join(
        f"  - family-names: {last}\n    given-names: {first}\n"
        for last, first in (("Kö", "Zoë"), ("Doe", "Jo"))
    )
    assert f"\nauthors:\n{people}repository-code: {FIELDS['address']}\n" in cff, cff

    # So does the version.
    header = work / "core/include/carom.h"
    header.write_text(
        re.sub(r"(VERSION_MINOR) \d+", r"\1 77", header.read_text(encoding="utf-8")),
        encoding="utf-8",
    )
    run(*tool)
    for part, text in (
        ("web/npm/package.json", '"0.77.0"'),
        ("web/package-lock.json", '"0.77.0"'),
        ("docs/using/building.md", "carom/0.77.0`"),
        ("docs/using/building.md", "`libcarom0.77`"),
        ("docs/reference/compatibility.md", "libcarom.so.0.77`"),
        ("packaging/tests/plain", "(carom 0.77 "),
    ):
        assert text in (work / part).read_text(encoding="utf-8"), part
    header.write_bytes(before[header])
    # With the fields of the tree again, the files are those of before.
    fill({})
    run(*tool)
    texts, manifest, _ = recipes("empty")
    assert "homepage" not in manifest and not re.search(
        "repository|copyright|projectUrl", texts["nuget/Carom.Billiards.nuspec"]
    )
    changed = [
        str(path.relative_to(work)) for path, text in before.items() if path.read_bytes() != text
    ]
    assert changed == ["CITATION.cff"], changed
print("every field is in packages, citation and pages")
