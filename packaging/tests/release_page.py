"""release_page.py SOURCE: the page of a release has a row for every file, with the command that
installs it. A file that no row describes, and a file that is missing, are refused by name.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(sys.argv[1])
VERSION = "1.2.3"
FILES = [
    "carom-1.2.3-cp310-abi3-manylinux2014_x86_64.whl",
    "carom-1.2.3-cp310-abi3-manylinux2014_aarch64.manylinux_2_17_aarch64.whl",
    "carom-1.2.3-cp310-abi3-macosx_11_0_x86_64.whl",
    "carom-1.2.3-cp310-abi3-macosx_11_0_arm64.whl",
    "carom-1.2.3-cp310-abi3-win_amd64.whl",
    "carom-1.2.3.tar.gz",
    "carom-1.2.3.tgz",
    "carom-1.2.3-page.zip",
    "libcarom1.2_1.2.3_amd64.deb",
    "libcarom-dev_1.2.3_amd64.deb",
    "carom_1.2.3_amd64.deb",
    "carom-doc_1.2.3_all.deb",
    "carom-1.2.3-one-file.zip",
    "Carom.Billiards.1.2.3.nupkg",
    "org.carom.billiards-1.2.3.tgz",
    "carom-1.2.3.crate",
    "carom-sys-1.2.3.crate",
    "carom-1.2.3-recipes.tar.gz",
    "carom-1.2.3-source.tar.gz",
    "carom-1.2.3-site.tar.gz",
    "carom-1.2.3-api.json",
    "carom-1.2.3.cdx.json",
]


def written(folder, *arguments):
    """The program's exit code, what it says, and the page."""
    page = folder / "RELEASE.md"
    page.unlink(missing_ok=True)
    done = subprocess.run(
        [sys.executable, SOURCE / "tools/release_page.py", folder, VERSION, *arguments],
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stderr, page.read_text(encoding="utf-8") if page.exists() else ""


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    dist = folder / "dist"
    dist.mkdir()
    for file in FILES:
        (dist / file).write_bytes(b"x" * 1500)
    (folder / "checked").write_text("Linux, x86_64  the same bits\n", encoding="utf-8")
    code, errors, page = written(dist, folder / "checked")
    assert code == 0, errors
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith("| `")]
    assert sorted(row[0].strip("|` ") for row in rows) == sorted(FILES), page
    assert all(len(row) == 4 and all(row) for row in rows), page
    assert "`pip install ./carom-1.2.3-cp310-abi3-win_amd64.whl`" in page
    assert "Linux, x86_64  the same bits" in page

    (dist / "carom-1.2.3.rpm").write_bytes(b"")
    code, errors, page = written(dist)
    assert code == 1 and page == "" and "carom-1.2.3.rpm: no row" in errors, errors
    (dist / "carom-1.2.3.rpm").unlink()
    (dist / "carom-1.2.3.tgz").unlink()
    code, errors, page = written(dist)
    assert code == 1 and page == "" and "carom-VERSION.tgz: no file" in errors, errors
print(f"{len(FILES)} files, each with its purpose and its installation")
