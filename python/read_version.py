"""The version of the package: that of the public header, its one source.

A provider of dynamic metadata for scikit-build-core.
"""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def dynamic_metadata(settings: Mapping[str, Any], project: Mapping[str, Any]) -> dict[str, str]:
    """The field "version", read from carom.h: in library/ in an archive of the sources, else beside
    this folder.
    """
    folder = Path(__file__).parent
    library = folder / "library" if (folder / "library").is_dir() else folder.parent
    header = (library / "core/include/carom.h").read_text(encoding="utf-8")
    numbers = dict(
        re.findall(r"^#define CAROM_VERSION_(MAJOR|MINOR|PATCH) +(\d+)$", header, re.MULTILINE)
    )
    return {"version": "{MAJOR}.{MINOR}.{PATCH}".format(**numbers)}
