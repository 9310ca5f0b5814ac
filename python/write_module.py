"""Writes the C source of the extension module carom._carom from headers: write_module.py OUT
HEADER...

The declarations that cffi needs are the headers without what its parser does not take: comments,
preprocessor lines, the braces of extern "C", the export mark. So the module can never differ from
the headers.
"""

import re
import sys
from pathlib import Path

from cffi import FFI


def declarations(header: str) -> str:
    """The plain declarations of a header."""
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    text = re.sub(r"#ifdef __cplusplus\n.*?#endif\n", "", text, flags=re.DOTALL)
    text = re.sub(r"^#(?:.*\\\n)*.*$", "", text, flags=re.MULTILINE)
    return text.replace("CAROM_API", "")


def main() -> None:
    out, *headers = map(Path, sys.argv[1:])
    ffi = FFI()
    for path in headers:
        ffi.cdef(declarations(path.read_text(encoding="utf-8")))
    includes = "".join(f"#include <{path.name}>\n" for path in headers)
    ffi.set_source("carom._carom", includes, py_limited_api=True)
    ffi.emit_c_code(str(out))


main()
