"""pack.py OUT FOLDER [PREFIX]: packs a folder into OUT, a .tar.gz, .tgz, .zip or .nupkg, under
PREFIX/. The same files give the same bytes: in the order of their names, of nobody, at the time
SOURCE_DATE_EPOCH.
"""

import gzip
import io
import os
import sys
import tarfile
import time
import zipfile
from pathlib import Path

out, folder = Path(sys.argv[1]), Path(sys.argv[2])
prefix = f"{sys.argv[3]}/" if len(sys.argv) > 3 else ""
when = int(os.environ["SOURCE_DATE_EPOCH"])
files = [
    (prefix + str(path.relative_to(folder)), path)
    for path in sorted(folder.rglob("*"))
    if path.is_file()
]
assert files, f"nothing in {folder}"
if out.suffix in (".zip", ".nupkg"):
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for name, path in files:
            entry = zipfile.ZipInfo(name, time.gmtime(when)[:6])
            entry.external_attr, entry.create_system, entry.compress_type = (
                0o100644 << 16,
                3,
                zipfile.ZIP_DEFLATED,
            )
            packed.writestr(entry, path.read_bytes())
else:
    tar = io.BytesIO()
    with tarfile.open(fileobj=tar, mode="w", format=tarfile.GNU_FORMAT) as packed:
        for name, path in files:
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime = path.stat().st_size, when
            entry.mode = 0o755 if os.access(path, os.X_OK) else 0o644
            with path.open("rb") as source:
                packed.addfile(entry, source)
    out.write_bytes(gzip.compress(tar.getvalue(), 9, mtime=0))
