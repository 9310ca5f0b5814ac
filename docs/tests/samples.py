"""samples.py SOURCE LIBRARY CC CXX: the samples of C in README, docs and the public headers,
compiled as pasted, as C17, C++17 and C++20, without a warning, linked with the static library and
run; and those of C++. What a program prints is what the page shows behind it, in a block `output`.

A block `c` or `cpp` is a program. The blocks `c piece` of a page are together the main() of one, and so
are the samples of headers, which are the indented paragraphs of their comments: a sample that
declares a status begins a program, the others continue it.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from blocks import ROUNDING, blocks, difference, matches, outputs, pages

SOURCE, LIBRARY, CC, CXX = Path(sys.argv[1]), *sys.argv[2:5]
HEADERS = ("carom.h", "carom_shot.h", "carom_tangent.h", "carom_record.h")
C = [(CC, "-std=c17"), (CXX, "-std=c++17"), (CXX, "-std=c++20")]
WARNINGS = ["-Wall", "-Wextra", "-pedantic", "-Werror"]


def program(pieces, end="return 0;"):
    return f"#include <carom_match.h>\n#include <carom_record.h>\n#include <carom_tangent.h>\n#include <stdio.h>\n\nint main(void) {{\n{''.join(pieces)}{end}\n}}\n"


def header_programs():
    """The pieces of each program of the headers."""
    found = []
    for header in HEADERS:
        text = (
            (SOURCE / "core/include" / header)
            .read_text(encoding="utf-8")
            .replace(" */\n", "\n *\n")
        )
        for sample in re.findall(r"^ \*\n((?: \*     .*\n)+)", text, flags=re.M):
            piece = re.sub(r"^ \*     ", "", sample, flags=re.M)
            if "carom_status status =" in piece:
                found.append([])
            found[-1].append(piece)
    return found


# Name, compilers, text, what it has to print, and by which share numbers may differ.
programs = [
    (f"headers, program {k}", C, program(pieces, "return status != CAROM_OK;"), ["..."], ROUNDING)
    for k, pieces in enumerate(header_programs(), 1)
]
assert sum(map(len, header_programs())) >= 6, "a sample of the headers was not found"
for page in pages(SOURCE):
    found = blocks(SOURCE, page)
    shown = list(outputs(found))
    pieces = [number for number, (kind, _) in enumerate(found) if kind == "c piece"]
    own = [
        ([number], C if kind == "c" else C[1:], text)
        for number, (kind, text) in enumerate(found)
        if kind in ("c", "cpp")
    ]
    if pieces:
        own.append((pieces, C, program(found[number][1] for number in pieces)))
    for numbers, compilers, text in own:
        lines = [line for number, lines, _ in shown if number in numbers for line in lines]
        share = max((share for number, _, share in shown if number in numbers), default=0)
        name = f"{page}, block {numbers[0] + 1}"
        assert lines or not re.search(r"(^|; )printf\(|std::cout", text, flags=re.M), (
            f"{name}: a program that prints has a block `output` behind it"
        )
        programs.append((name, compilers, text, lines, share))
assert len(programs) >= 7, programs

with tempfile.TemporaryDirectory() as work:
    for number, (name, compilers, text, shown, share) in enumerate(programs):
        for compiler, standard in compilers:
            # The name of the file says which language it has, as a user's does.
            file = Path(work, f"{number}.{'cpp' if '++' in standard else 'c'}")
            file.write_text(text, encoding="utf-8")
            built = subprocess.run(
                [
                    compiler,
                    standard,
                    *WARNINGS,
                    f"-I{SOURCE}/core/include",
                    f"-I{SOURCE}/games/include",
                    f"-I{SOURCE}/bindings/cpp",
                    file,
                    LIBRARY,
                    "-lm",
                    "-pthread",
                    "-o",
                    file.with_suffix(""),
                ],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
            )
            assert built.returncode == 0, f"{name}, {compiler} {standard}:\n{built.stdout}"
            said = subprocess.run(
                [file.with_suffix("")], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
            )
            printed = said.stdout.splitlines()
            assert said.returncode == 0 and matches(shown, printed, share), difference(
                f"{name}, {standard}: exit {said.returncode}", shown, printed
            )
print(f"{len(programs)} programs")
