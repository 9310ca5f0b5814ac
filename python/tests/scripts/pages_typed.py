"""pages_typed.py SOURCE WORK: pyright over python/tests/scripts/typed.py, strictly, and over the Python programs
of README and docs, each page as one program.

Runs in an environment that has the package. npm gets pyright into WORK; without it the exit code is
77, the sign of a test that was skipped. What pages leave to other packages is not looked at: their
unknown types, and what is not installed.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

VERSION = "1.1.414"
# What pyright says that is not carom's to mend: page, part of the message, and why.
KNOWN = [
    (
        "docs_contributing_extending",
        "overrides class",
        "methods with ... stand for those of the reader",
    ),
    ("docs_using_scale", '"from_array"', "Dask does not declare that chunks may be a tuple"),
    ("docs_using_fit", 'parameter "game"', "a fit's constants are unpacked, and name no game"),
    ("docs_using_fit", 'parameter "cushion_model"', "the same"),
    ("docs_using_fit", 'parameter "conditions"', "the same"),
    ("docs_using_python", '"backward"', "PyTorch is not installed"),
]
source, work = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(source / "docs/tests"))
from blocks import blocks, pages  # noqa: E402


def get_pyright():
    program = work / "node_modules/.bin/pyright"
    package = work / "node_modules/pyright/package.json"
    if not package.exists() or json.loads(package.read_text())["version"] != VERSION:
        work.mkdir(parents=True, exist_ok=True)
        (work / "package.json").write_text('{ "private": true }\n')
        npm = shutil.which("npm")
        got = npm and subprocess.run(
            [npm, "install", "--no-audit", "--no-fund", f"pyright@{VERSION}"],
            cwd=work,
            capture_output=True,
        )
        if not got or got.returncode:
            print("skipped: npm could not get pyright")
            sys.exit(77)
    return program


def check(program, folder, mode):
    """The errors in the programs of a folder, each as file, line and message."""
    settings = {
        "typeCheckingMode": mode,
        "reportMissingImports": False,
        "reportMissingModuleSource": False,
        "extraPaths": [path for path in sys.path if path],
    }
    (folder / "pyrightconfig.json").write_text(json.dumps(settings))
    done = subprocess.run(
        [program, "--project", str(folder), "--outputjson"], capture_output=True, text=True
    )
    found = json.loads(done.stdout)
    count = found["summary"]["filesAnalyzed"]
    assert count == len(list(folder.glob("*.py"))), f"pyright read {count} files of {folder}"
    return [
        (
            Path(diagnostic["file"]).stem,
            diagnostic["range"]["start"]["line"] + 1,
            diagnostic["message"],
        )
        for diagnostic in found["generalDiagnostics"]
        if diagnostic["severity"] == "error"
    ]


pyright = get_pyright()
programs, strict = work / "pages", work / "strict"
for folder in (programs, strict):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
shutil.copy(source / "python/tests/scripts/typed.py", strict)
for page in pages(str(source)):
    sources = [
        text
        for kind, text in blocks(str(source), page)
        if kind.startswith("python") and kind != "python elsewhere"
    ]
    if sources:
        name = page.removesuffix(".md").replace("/", "_")
        (programs / f"{name}.py").write_text("\n".join(sources), encoding="utf-8")
files = sorted(programs.glob("*.py"))
assert len(files) >= 6, files
errors = check(pyright, strict, "strict")
errors += [
    (name, line, message)
    for name, line, message in check(pyright, programs, "standard")
    if not any(name == page and part in message for page, part, _ in KNOWN)
]
for name, line, message in errors:
    print(f"{name}, line {line}: {message}")
print(f"pyright {VERSION}: {len(errors)} errors in {len(files) + 1} programs")
sys.exit(bool(errors))
