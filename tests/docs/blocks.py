"""The code blocks of README and docs, and what runs each kind.

Every block is of one of these kinds, so that none goes untested.

sh            run by readme.py (README's, with `carom` on the path) or pages.py (with the tree and
              its build beside)
sh install    README's: installed by readme.py
sh started    takes minutes: pages.py starts each line, sees that it is not refused, and ends it
sh conan, sh wheel   docs/using/building.md's and python.md's: run by the tests install/conan and
                     python/sdist
console       commands and what they print: run and compared by shown.py
sh elsewhere, python elsewhere   not run here but by others: ./test by who reads this, pip by the
                                 test python/installed, cmake by every build, the scripts of
                                 python/examples by the test of that name; a cluster of many
                                 machines by who has one
sh program    README's and docs/using/building.md's: compile README's block of C in readme.py,
              against what has been installed
c             README's, a program: built by readme.py, and by samples.py
c piece       of one program, whose main() the blocks of a page are: built and run by samples.py, as
              C and as C++
cpp           a program in C++: likewise
cmake fetch, cmake package    docs/using/building.md's: built by readme.py
cmake windows    docs/using/building.md's: built and run by the test platforms/windows
js            a page is a session, run in Node by the test web/package
csharp, rust  docs/using/languages.md's: built and run by tests/bindings/game
python        a page is a session, in the environment of the test python/installed; its kinds
              pooltool, jax, torch, gymnasium, pettingzoo, scale, sb3 and sampling need those
              packages
output        what the program of the block before prints
"""

import re
from pathlib import Path

KINDS = {
    "sh",
    "sh install",
    "sh started",
    "sh program",
    "sh conan",
    "sh wheel",
    "console",
    "sh elsewhere",
    "c",
    "c piece",
    "cpp",
    "cmake fetch",
    "cmake package",
    "cmake windows",
    "js",
    "csharp",
    "rust",
    "python",
    "output",
}
KINDS |= {
    f"python {need}"
    for need in (
        "pooltool",
        "jax",
        "torch",
        "gymnasium",
        "pettingzoo",
        "scale",
        "sb3",
        "sampling",
        "elsewhere",
    )
}

# Blocks that no test of docs/ runs, by page: a new one needs a good reason and a line here.
ELSEWHERE = {
    "docs/using/examples.md": 1,
    "docs/using/building.md": 2,
    "docs/using/calibrate.md": 1,
    "docs/using/derivatives.md": 1,
    "docs/using/pooltool.md": 1,
    "docs/using/python.md": 1,
    "docs/understanding/reality.md": 1,
    "docs/using/tracks.md": 1,
    "python/README.md": 1,
    "study/README.md": 1,
    "docs/start/c.md": 3,
    "docs/start/javascript.md": 3,
    "docs/start/player.md": 2,
    "docs/start/python.md": 1,
}

# What may be indented instead: formulas and what programs print, but no line that one would paste.
PASTED = re.compile(
    r" {4}(\./|build/|tools/|pip3? |cmake |ctest |gnuplot |carom(-lab)? |python3? |git |sudo |import |from \w+ import|#include)"
)


def pages(source):
    """The names of all pages."""
    return [
        "README.md",
        *sorted(str(page.relative_to(source)) for page in Path(source, "docs").glob("*/*.md")),
        "examples/README.md",
        "python/README.md",
        "study/README.md",
        "web/README.md",
        "web/npm/README.md",
    ]


def blocks(source, page):
    """Kind and text of each block of a page."""
    text = Path(source, page).read_text(encoding="utf-8")
    found = re.findall(r"^```([^\n]*)\n(.*?)^```$", text, flags=re.M | re.S)
    rest = re.sub(r"^```[^\n]*\n.*?^```$", "", text, flags=re.M | re.S)
    assert "```" not in rest, (
        f"{page}: a fence that is not closed, or not at the beginning of its line"
    )
    for line in rest.splitlines():
        assert not PASTED.match(line), (
            f"{page}: '{line.strip()}' is code: it belongs between fences, with one of the kinds of tests/docs/blocks.py"
        )
    for kind, _ in found:
        assert kind in KINDS, f"{page}: no test runs blocks of the kind '{kind}'"
    elsewhere = sum(kind.endswith(" elsewhere") for kind, _ in found)
    assert elsewhere == ELSEWHERE.get(page, 0), (
        f"{page}: {elsewhere} blocks are run elsewhere, not {ELSEWHERE.get(page, 0)}"
    )
    return found
