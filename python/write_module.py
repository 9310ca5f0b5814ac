"""Writes the C source of the extension module carom._carom from the public headers: write_module.py OUT HEADER...

The declarations that cffi needs are the headers without what its parser does not take: comments, preprocessor lines,
the braces of extern "C", the export mark. So the module can never differ from the headers.
"""

import re
import sys
from pathlib import Path

from cffi import FFI


def declarations(header: str) -> str:
    """The plain declarations of a header."""
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    text = re.sub(r"#ifdef __cplusplus\n.*?#endif\n", "", text, flags=re.DOTALL)
    text = re.sub(r"^#.*$", "", text, flags=re.MULTILINE)
    return text.replace("CAROM_API", "")


def main() -> None:
    out, *headers = map(Path, sys.argv[1:])
    loops = Path(__file__).with_name("loops.h")
    ffi = FFI()
    for path in (*headers, loops):
        ffi.cdef(declarations(path.read_text(encoding="utf-8")))
    ffi.set_source("carom._carom", '#include <carom_shot.h>\n#include "loops.h"\n', py_limited_api=True)
    ffi.emit_c_code(str(out))


main()
