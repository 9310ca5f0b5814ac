"""Mutation testing: changes one token of the sources at a time, and asks whether the quick tests notice.

    tools/python tools/mutants.py [--rooms src/shot,src/impact] [--count 20] [--seed 1] [-o mutants.csv]

Each room gets --count mutants, drawn with the seed from all places where one can be made. A mutant is built in a copy of the tree and tested
by ctest with the labels of --tests, the quickest first, until one fails; Python is tested by pytest with the package of the copy. The table
has a line a mutant: killed (by what), survived, or stillborn (it does not compile); a run goes on where an earlier one with the same -o stopped.
The programs are optimised as in a release, so a mutant that compiles to the same object files is counted as equivalent and not tested.
"""

import argparse
import csv
import hashlib
import random
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ["src/platform", "src/impact", "src/ball_ball", "src/cushion", "src/shot", "cli", "python/src/carom"]
FIELDS = ["room", "file", "line", "column", "was", "now", "outcome", "by", "seconds"]

# What stands for what, in C and in Python: each place gives one mutant for each right side.
SWAPS = {
    "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "<": ["<=", ">"], "<=": ["<", ">"], ">": [">=", "<"], ">=": [">", "<"],
    "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"], "+=": ["-="], "-=": ["+="], "*=": ["/="], "&": ["|"], "|": ["&"],
    "++": ["--"], "true": ["false"], "false": ["true"], "!": [""], "break": ["continue"],
    "and": ["or"], "or": ["and"], "not": [""], "True": ["False"], "False": ["True"], "is": ["is not"],
}  # fmt: skip
TOKEN = re.compile(
    r"""(?P<skip>/\*.*?\*/|//[^\n]*|^[ \t]*\#[^\n]*(?:\\\n[^\n]*)*|\"\"\".*?\"\"\"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')
    |(?P<number>(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[fuUlL]*(?![\w.]))
    |(?P<word>[A-Za-z_]\w*)
    |(?P<mark>->|\+\+|--|<<=|>>=|<<|>>|[-+*/<>=!&|^%]=|&&|\|\||[-+*/<>!&|=])""",
    re.S | re.M | re.X,
)


def numbers(text: str) -> list[str]:
    """What a literal becomes: 0 becomes 1, others become 0 or twice as much."""
    digits = text.rstrip("fuUlL")
    suffix = text[len(digits) :]
    value = float(digits)
    if value == 0.0:
        return ["1" + ("." if "." in digits else "") + suffix]
    twice = repr(2.0 * value) if "." in digits or "e" in digits.lower() else str(2 * int(value))
    zero = "0.0" if "." in digits or "e" in digits.lower() else "0"
    return [zero + suffix, twice + suffix]


def mutants_of(path: Path) -> list[tuple[int, int, str, str]]:
    """Places (offset, length), what stands there and what is to stand there."""
    text = path.read_text()
    if path.suffix == ".py":  # a hash begins a comment, not a directive
        text = re.sub(r"#[^\n]*", lambda m: " " * len(m.group()), text)
    found = []
    before = ""
    for match in TOKEN.finditer(text):
        token = match.group()
        if match.lastgroup == "number" and token[:2].lower() != "0x":
            found += [(match.start(), len(token), token, now) for now in numbers(token)]
        elif match.lastgroup in ("word", "mark") and token in SWAPS:
            # a pointer's star and ampersand, a type's, and signs stay
            apart = text[match.end() : match.end() + 1].isspace() and text[match.start() - 1 : match.start()].isspace()
            if token not in "+-*/&|<>" or apart:
                if not (token == "*" and before.endswith(("const", "_t"))):
                    found += [(match.start(), len(token), token, now) for now in SWAPS[token]]
        before = token
    return found


class Copy:
    """A copy of the tree with its build."""

    def __init__(self, folder: Path, labels: str) -> None:
        self.folder, self.build, self.labels = folder, folder / "build", labels
        if not folder.exists():
            subprocess.run(["git", "clone", "--quiet", str(ROOT), str(folder)], check=True)
        self.run(["cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCAROM_TESTS=ON", "-DCAROM_CLI=ON",
                  "-DCAROM_LAB=ON", "-DCAROM_LADDER=OFF", "-DCAROM_WERROR=OFF"], 600)  # fmt: skip
        if self.make():
            sys.exit(f"the tree does not build: {self.log}")
        self.objects = self.hash()
        self.tests = self.order()

    def run(self, command: list[str], limit: float) -> int:
        with open(self.folder / "mutants.log", "w") as log:
            try:
                return subprocess.run(command, cwd=self.folder, stdout=log, stderr=subprocess.STDOUT, timeout=limit).returncode
            except subprocess.TimeoutExpired:
                return 124

    @property
    def log(self) -> Path:
        return self.folder / "mutants.log"

    def make(self) -> int:
        return self.run(["cmake", "--build", "build"], 1800)

    def hash(self) -> str:
        digest = hashlib.sha256()
        for file in sorted(self.build.glob("src/**/*.o")):
            digest.update(file.read_bytes())
        return digest.hexdigest()

    def order(self) -> list[tuple[str, float]]:
        """The tests by the time that each took on the tree as it is."""
        self.run(["ctest", "--test-dir", "build", "-L", self.labels, "-E", "python/"], 3600)
        times = re.findall(r"Test +#\d+: (\S+) \.+ +(\w+) +([\d.]+) sec", self.log.read_text())
        failing = [name for name, outcome, _ in times if outcome != "Passed"]
        if failing:
            sys.exit(f"tests fail without a mutant: {', '.join(failing)}")
        return sorted(((name, float(seconds)) for name, _, seconds in times), key=lambda test: test[1])

    def killer(self) -> str | None:
        """The test that fails, or None."""
        for name, seconds in self.tests:
            if self.run(["ctest", "--test-dir", "build", "-R", f"^{re.escape(name)}$", "-E", "python/"], 20 + 10 * seconds) != 0:
                return name
        return None

    def python_killer(self) -> str | None:
        """The same for the package, which its test builds, installs and tries."""
        code = self.run(["sh", "tests/python/package", str(self.folder), str(self.build)], 1800)
        if code == 77:
            sys.exit(f"the package cannot be tested here: {self.log}")
        return "python/package" if code else None


def try_one(copy: Copy, room: str, path: Path, place: tuple[int, int, str, str]) -> tuple[str, str]:
    offset, length, _, now = place
    original = path.read_text()
    path.write_text(original[:offset] + now + original[offset + length :])
    try:
        if room.startswith("python"):
            killer = copy.python_killer()
        else:
            if copy.make():
                return "stillborn", ""
            if copy.hash() == copy.objects:
                return "equivalent", "same object files"
            killer = copy.killer()
        return ("killed", killer) if killer else ("survived", "")
    finally:
        path.write_text(original)


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--rooms", default=",".join(ROOMS), help="folders, with a comma between")
    options.add_argument("--count", type=int, default=20, help="mutants of each room")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--tests", default="unit|agree|physics|cli", help="labels of tests, a regular expression")
    options.add_argument("--folder", type=Path, default=ROOT / "build" / "mutants", help="where the copy of the tree is")
    options.add_argument("-o", dest="out", type=Path, default=Path("mutants.csv"))
    asked = options.parse_args()

    copy = Copy(asked.folder.resolve(), asked.tests)
    done = {}
    if asked.out.exists():
        with open(asked.out) as file:
            done = {tuple(row[name] for name in FIELDS[:6]): row["outcome"] for row in csv.DictReader(file)}
    new = not asked.out.exists()
    with open(asked.out, "a", newline="") as file:
        table = csv.DictWriter(file, FIELDS)
        if new:
            table.writeheader()
        for room in asked.rooms.split(","):
            files = sorted(p for p in (copy.folder / room).iterdir() if p.suffix in (".c", ".h", ".py") and "windows" not in p.name)
            places = [(path, place) for path in files for place in mutants_of(path)]
            drawn = random.Random(f"{asked.seed} {room}").sample(places, min(asked.count, len(places)))
            for path, place in drawn:
                text = path.read_text()
                line = text.count("\n", 0, place[0]) + 1
                column = place[0] - text.rfind("\n", 0, place[0])
                key = (room, path.name, str(line), str(column), place[2], place[3])
                if key in done:
                    continue
                started = time.monotonic()
                outcome, by = try_one(copy, room, path, place)
                row = dict(zip(FIELDS, (*key, outcome, by, f"{time.monotonic() - started:.0f}")))
                table.writerow(row)
                file.flush()
                print(*(row[name] for name in FIELDS), sep="  ", flush=True)
    summarise(asked.out)


def summarise(path: Path) -> None:
    """The rate by room: killed of those that compile and are not known to be equivalent."""
    with open(path) as file:
        rows = list(csv.DictReader(file))
    for room in dict.fromkeys(row["room"] for row in rows):
        outcomes = [row["outcome"] for row in rows if row["room"] == room]
        killed, survived = outcomes.count("killed"), outcomes.count("survived")
        if killed + survived:
            print(f"{room}: {killed} of {killed + survived} killed, {100 * killed / (killed + survived):.0f} %; "
                  f"{outcomes.count('equivalent')} equivalent, {outcomes.count('stillborn')} do not compile")  # fmt: skip


if __name__ == "__main__":
    main()
