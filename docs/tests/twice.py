"""twice.py SOURCE: no figure stands on two pages, so none is corrected on one and left wrong on the
other.

A figure is a number of three or more significant digits with a unit, or any number of times, in
text and tables. It may stand twice where one of the two sections links to the other's page, as its
source. Blocks between fences, formulas and outputs do not count: tests run them.
"""

import re
import sys
from itertools import combinations
from pathlib import Path

from blocks import pages

UNIT = r"%|times|degrees|ns|us|µs|ms|s|m/s|rad/s|mm|cm|m|bytes|kB|KiB|MB|shots/s"
FIGURE = re.compile(rf"(?<![\w.,/^-])(\d[\d,]*(?:\.\d+)?(?:e-?\d+)?)\s({UNIT})(?![\w/])")


def figures(text):
    """Each figure of a page, with the section in which it stands first."""
    found = {}
    for section in re.split(
        r"^(?=#+ )", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S), flags=re.M
    ):
        for number, unit in FIGURE.findall(re.sub(r"^ {4}.*$", "", section, flags=re.M)):
            digits = re.sub(r"e.*|[^\d]", "", number).lstrip("0")
            if unit == "times" or len(digits if "." in number else digits.rstrip("0")) >= 3:
                found.setdefault((number.replace(",", ""), unit), section)
    return found


def twice(texts):
    """Figures that stand on two pages of which neither names the other as its source."""
    found = {page: figures(text) for page, text in texts.items()}
    return [
        f"{a} and {b}: {number} {unit}"
        for a, b in combinations(found, 2)
        for number, unit in found[a].keys() & found[b].keys()
        if Path(b).name not in found[a][number, unit] and Path(a).name not in found[b][number, unit]
    ]


copied, named = (
    {"a.md": "It takes 12.5 ns.", "b.md": "# B\n| | 12.5 ns |"},
    {"a.md": "12.5 ns", "b.md": "12.5 ns, from [a](a.md#b)"},
)
assert (
    twice(copied) == ["a.md and b.md: 12.5 ns"]
    and not twice(named)
    and twice({"a.md": "9 times", "b.md": "9 times"})
)
texts = {page: Path(sys.argv[1], page).read_text(encoding="utf-8") for page in pages(sys.argv[1])}
wrong = twice(texts)
if wrong:
    sys.exit(
        "\n".join(
            [
                *wrong,
                "one page has the figure; the other links to it, or says it without the figure",
            ]
        )
    )
count = sum(map(len, map(figures, texts.values())))
assert count >= 30, count
print(f"{count} figures on {len(texts)} pages, none copied")
