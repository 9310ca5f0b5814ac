"""claims.py SOURCE BUILD: the numbers that sentences of the pages give are those of a run.

claims.csv has a row for each sentence: its page, its words with {} for each number, and a command of
the shell that prints these numbers, with `carom`, `carom-lab` and data/ at hand. A number is right to
the digits that the page shows. UPDATE=1 writes the numbers that came into the pages. A time in ns, us
or ms has the date and the machine of its measurement in the same section, or a row here.
"""

import csv
import os
import re
import subprocess
import sys
from pathlib import Path

from blocks import NUMBER, pages

A_TIME = re.compile(r"\b(?:takes?|took|costs?|saves?|in) (?:about )?[\d.,]+ (?:ns|us|µs)\b")
DATE = re.compile(r"20\d\d-\d\d-\d\d")


def pattern(words):
    """The words of a page, on any lines, with a group for each number."""
    parts = [r"\s+".join(map(re.escape, part.split(" "))) for part in words.split("{}")]
    return re.compile(rf"({NUMBER.pattern})".join(parts))


def is_shown(shown, came):
    """Whether a number of a page is the one that came, to its digits."""
    mantissa, _, exponent = shown.partition("e")
    step = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(float(shown) - float(came)) <= (0.5 + 1e-6) * step


def as_shown(shown, came):
    """The number that came, with as many digits as the one on the page."""
    mantissa, _, exponent = shown.partition("e")
    places = len(mantissa.partition(".")[2])
    return f"{float(came):.{places}e}" if exponent else f"{float(came):.{places}f}"


def check(text, words, came):
    """What is wrong with a sentence, and the text with the numbers that came."""
    found = pattern(words).search(text)
    if not found:
        return f"the page does not say '{words}'", text
    if len(found.groups()) != len(came):
        return f"'{words}': {came} came", text
    wrong = [pair for pair in zip(found.groups(), came) if not is_shown(*pair)]
    for k in range(len(came), 0, -1):
        start, end = found.span(k)
        text = text[:start] + as_shown(found[k], came[k - 1]) + text[end:]
    return "; ".join(f"'{words}': {a} is shown, {b} came" for a, b in wrong), text


def undated(text):
    """Measured times without the date of the measurement in their section."""
    bare = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    return [
        f"'{found[0]}' has no date of its measurement in its section"
        for section in re.split(r"^(?=#+ )", bare, flags=re.M)
        for found in A_TIME.finditer(" ".join(section.split()))
        if not DATE.search(section)
    ]


assert check("is 3.1\nm", "is {} m", ["3.14"]) == ("", "is 3.1\nm")
assert check("is 3.2 m", "is {} m", ["3.14"])[1] == "is 3.1 m" and undated("It takes 3 us.")

source, build = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
environment = {**os.environ, "PATH": f"{build}:{os.environ['PATH']}"}
faults = []
with Path(__file__).with_name("claims.csv").open(encoding="utf-8") as rows:
    claims = list(csv.DictReader(rows))
for claim in claims:
    path = source / claim["page"]
    done = subprocess.run(
        ["sh", "-c", claim["command"]], cwd=source, env=environment, capture_output=True, text=True
    )
    came = NUMBER.findall(done.stdout)
    fault, text = check(path.read_text(encoding="utf-8"), claim["words"], came)
    if fault and os.environ.get("UPDATE") == "1":
        path.write_text(text, encoding="utf-8")
    elif fault:
        faults.append(f"{claim['page']}: {fault} ({claim['command']})\n{done.stderr}")
for page in pages(source):
    faults += [f"{page}: {fault}" for fault in undated((source / page).read_text(encoding="utf-8"))]
if faults:
    sys.exit("\n".join(faults))
print(f"{len(claims)} sentences have the numbers of a run")
