"""The code blocks of README and docs, and what runs each kind.

Every block is of one of these kinds, so that none goes untested.

sh            run by readme.py (README's, with `carom` on the path) or pages.py (with the tree and
              its build beside)
sh install    README's: installed by readme.py
sh started    takes minutes: pages.py starts each line, sees that it is not refused, and ends it
sh conan, sh wheel   docs/using/building.md's and python.md's: run by the tests packaging/conan and
                     python/sdist
console       commands and what they print: run and compared by shown.py
output        what the program in the last block before it prints; `output within 1e-3` lets its
              numbers differ by that share. samples.py compares it for C and C++, sessions.py for
              Python
measured on MACHINE, DATE   times of a machine, which tools/outputs.py writes anew
sh elsewhere, python elsewhere   not run here but by others: ./test by who reads this, pip by the
                                 test python/installed, cmake and ctest by every build, the scripts of
                                 python/examples by the test of that name; a cluster of many
                                 machines by who has one
sh program    README's and docs/using/building.md's: compile README's block of C in readme.py,
              against what has been installed
c             README's, a program: built by readme.py, and by samples.py
c piece       of one program, whose main() the blocks of a page are: built and run by samples.py, as
              C and as C++
cpp           a program in C++: likewise
cmake fetch, cmake package    docs/using/building.md's: built by readme.py
cmake windows    docs/using/building.md's: built and run by the test core/platforms/windows
js            a page is a session, run in Node by the test web/package
csharp, rust  docs/using/languages.md's: built and run by bindings/tests/game
python        a page is a session, in the environment of the test python/installed; its kinds
              pooltool, jax, torch, gymnasium, pettingzoo, scale and sb3 need those packages
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
    "measured",
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
    for need in ["pooltool", "jax", "torch", "gymnasium", "pettingzoo", "scale", "sb3", "elsewhere"]
}

# Blocks that no test of docs/ runs, by page: a new one needs a good reason and a line here.
ELSEWHERE = {
    "docs/study/measuring.md": 1,
    "README.md": 1,
    "docs/using/examples.md": 1,
    "docs/using/building.md": 2,
    "docs/using/fit.md": 1,
    "docs/using/derivatives.md": 1,
    "docs/using/pooltool.md": 1,
    "docs/using/python.md": 1,
    "docs/understanding/reality.md": 1,
    "python/README.md": 1,
    "study/README.md": 1,
    "docs/start/c.md": 3,
    "docs/start/javascript.md": 3,
    "docs/start/player.md": 2,
    "docs/start/python.md": 2,
    "docs/contributing/extending.md": 1,
    "examples/server/README.md": 1,
}

# The programs whose output a test compares.
PRINTING = re.compile(r"c|c piece|cpp|python( \w+)?")
MEASURED = re.compile(r"measured on \S.*, \d{4}-\d\d-\d\d")
WITHIN = re.compile(r"output within (\d\S*)")
ROUNDING = 1e-6  # by this share numbers differ between instruction sets
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?")


def pages(source):
    """The names of all pages."""
    return [
        "README.md",
        "docs/README.md",
        *sorted(str(page.relative_to(source)) for page in Path(source, "docs").glob("*/*.md")),
        "examples/README.md",
        "examples/server/README.md",
        "python/README.md",
        "study/README.md",
        "web/README.md",
        "web/npm/README.md",
    ]


def indented(text):
    """The first paragraph of a text that is indented without being part of a list, or None."""
    in_list = False
    for paragraph in re.split(r"\n\n+", text):
        in_list = re.match(r" *([-*]|\d+\.) ", paragraph) or (
            in_list and paragraph.startswith("  ")
        )
        if paragraph.startswith("    ") and not in_list:
            return paragraph.strip()
    return None


def equal(shown, printed, within=ROUNDING):
    """Whether two lines have the same words, and the same numbers but for rounding."""
    words = [NUMBER.sub("#", line).split() for line in (shown, printed)]
    numbers = [[float(number) for number in NUMBER.findall(line)] for line in (shown, printed)]
    close = all(abs(a - b) <= within * max(1, abs(a)) for a, b in zip(*numbers))
    return words[0] == words[1] and len(numbers[0]) == len(numbers[1]) and close


def matches(shown, printed, within=ROUNDING):
    """Whether lines match, where a line `...` stands for any number of lines."""
    if not shown:
        return not printed
    if shown[0] == "...":
        return any(matches(shown[1:], printed[skip:], within) for skip in range(len(printed) + 1))
    return (
        bool(printed)
        and equal(shown[0], printed[0], within)
        and matches(shown[1:], printed[1:], within)
    )


def difference(where, shown, printed):
    return "\n".join([where, "shown:", *shown, "printed:", *printed])


def within(kind):
    """By which share of themselves the numbers of a block of output may differ."""
    named = WITHIN.fullmatch(kind)
    return float(named[1]) if named else ROUNDING


def outputs(found):
    """The output that a page shows of its programs: number of the program's block, lines, and by
    which share numbers may differ.
    """
    program = None
    for number, (kind, text) in enumerate(found):
        if PRINTING.fullmatch(kind):
            program = number
        elif kind.startswith("output"):
            yield program, text.splitlines(), within(kind)


def blocks(source, page):
    """Kind and text of each block of a page."""
    text = Path(source, page).read_text(encoding="utf-8")
    found = re.findall(r"^```([^\n]*)\n(.*?)^```$", text, flags=re.M | re.S)
    rest = re.sub(r"^```[^\n]*\n.*?^```$", "", text, flags=re.M | re.S)
    assert "```" not in rest, (
        f"{page}: a fence that is not closed, or not at the beginning of its line"
    )
    assert not indented(rest), (
        f"{page}: '{indented(rest)}' is indented: code and output belong between fences, with one of "
        "the kinds of docs/tests/blocks.py, and formulas between $$"
    )
    program = ""
    for kind, _ in found:
        base = (
            "output" if WITHIN.fullmatch(kind) else "measured" if MEASURED.fullmatch(kind) else kind
        )
        assert base in KINDS, f"{page}: no test runs blocks of the kind '{kind}'"
        if base != "output":
            program = program if kind == "sh elsewhere" else kind
        else:
            assert PRINTING.fullmatch(program), (
                f"{page}: no test compares the output of a block '{program}'"
            )
    elsewhere = sum(kind.endswith(" elsewhere") for kind, _ in found)
    assert elsewhere == ELSEWHERE.get(page, 0), (
        f"{page}: {elsewhere} blocks are run elsewhere, not {ELSEWHERE.get(page, 0)}"
    )
    return found
