"""Mutation testing: changes one token of the sources at a time, and asks whether the quick tests notice.

    tools/python tools/mutants.py [--rooms src/shot,src/impact] [--count 20] [--seed 1] [--minutes 60] [-o mutants.csv]
    tools/python tools/mutants.py --again -o mutants.csv          # the survivors of the table once more, after new tests

Each room gets --count mutants, drawn with the seed from all places where one can be made: a longer run begins with the mutants of a shorter
one. A mutant is made in a copy of the tree, as last committed, with two vector instruction sets beside plain. The tests of --tests run until
one fails: those with the most kills a second so far, and nearest to the room by name, first. A test whose program has the same bytes as
without the mutant is left out. Python files are replaced where the package is installed, and tested by the package's own tests.

The table has a line a mutant: killed (by what), survived, equivalent (the same object files or bytecode), unbuilt (for another instruction
set or system), or stillborn (it does not compile). A run continues where an earlier one with the same -o stopped. Whoever finds a survivor
equivalent writes that into the table. A test has a limit of processor time, ten times what it needs: a busy machine kills no mutant.
"""

import argparse
import ast
import csv
import hashlib
import json
import os
import random
import re
import resource
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROOMS = ["src/platform", "src/impact", "src/ball_ball", "src/cushion", "src/cluster", "src/table", "src/motion", "src/shot", "cli", "python/src/carom"]
FIELDS = ["room", "file", "line", "column", "was", "now", "outcome", "by", "seconds", "text"]
KEY = FIELDS[:6]
# Exit codes of a test that passes: also of one that is skipped, by ctest or by pytest.
GOOD = (0, 77, 5)
# What all programs are linked from; main.c is in no library.
LINKED = ["libcarom.a", "cli/libcarom_cli_parts.a", "carom"]
# Tests of the package that take long: of what is beside the package, and of the files with this in their names alone.
PYTHON_LEFT_OUT, PYTHON_ALONE = ["test_examples.py"], "pooltool"

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

Place = tuple[int, int, str, str]


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


def blank(text: str, start: int, end: int) -> str:
    return text[:start] + " " * (end - start) + text[end:]


def without_annotations(text: str) -> str:
    """Python with spaces for comments and for annotations of types, which do nothing when it runs."""
    lines = [0]
    for line in text.splitlines(keepends=True):
        lines.append(lines[-1] + len(line))
    for node in ast.walk(ast.parse(text)):
        for note in (getattr(node, "annotation", None), getattr(node, "returns", None)):
            if note is not None:
                text = blank(text, lines[note.lineno - 1] + note.col_offset, lines[note.end_lineno - 1] + note.end_col_offset)
    return re.sub(r"#[^\n]*", lambda m: " " * len(m.group()), text)


def mutants_of(path: Path) -> list[Place]:
    """Places (offset, length), what stands there and what is to stand there."""
    text = path.read_text()
    if path.suffix == ".py":
        text = without_annotations(text)
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


def replaced(text: str, place: Place, now: str) -> str:
    return text[: place[0]] + now + text[place[0] + place[1] :]


@dataclass
class Test:
    """A command that fails if a mutant is wrong."""

    name: str
    command: list[str]
    folder: str
    room: str  # "python" for the tests of the package
    environment: dict[str, str] = field(default_factory=dict)
    targets: list[str] = field(default_factory=list)  # programs of the build that it runs
    seconds: float = 0.0  # of processor time


class Copy:
    """A copy of the tree, with its build and the installed package."""

    def __init__(self, folder: Path, labels: str, isas: str, rooms: list[str]) -> None:
        self.folder, self.build = folder, folder / "build"
        self.log = folder.parent / (folder.name + ".log")
        folder.parent.mkdir(parents=True, exist_ok=True)
        if not folder.exists():
            self.must(["git", "clone", "--quiet", str(ROOT), str(folder)], ROOT)
        self.must(["git", "fetch", "--quiet", str(ROOT), "HEAD"])
        self.must(["git", "reset", "--quiet", "--hard", "FETCH_HEAD"])
        self.must(["cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCAROM_TESTS=ON", "-DCAROM_CLI=ON",
                   "-DCAROM_LAB=ON", "-DCAROM_LADDER=OFF", "-DCAROM_INSTALL=ON", f"-DCAROM_ISAS={isas}"])  # fmt: skip
        self.must(["sh", "tools/python", "--version"], environment={
            "CAROM_PYTHON_ENVIRONMENT": str(self.build / "python"), "CAROM_PYTHON_MODULES": "jinja2 numpy pycparser pytest"})  # fmt: skip
        # What each kind of room needs. CTest knows the command of a test once its program is built.
        self.must(["ninja", "-C", "build"])
        python = [room for room in rooms if room.startswith("python")]
        self.tests = self.tests_of_ctest(labels) if len(python) < len(rooms) else []
        built = [*LINKED, *{target for test in self.tests for target in test.targets}]
        self.programs = {name: self.hash(name) for name in built}
        self.package = self.install() if python else None
        if python:
            self.tests += self.tests_of_package()
        self.measure()

    def must(self, command: list[str], folder: Path | None = None, environment: dict[str, str] | None = None, skipped: bool = False) -> None:
        if self.run(command, folder or self.folder, environment=environment) not in ((0, 77) if skipped else (0,)):
            sys.exit(f"{' '.join(command[:3])} ... failed: see {self.log}")

    def run(self, command: list[str], folder: str | Path, limit: float = 0.0, environment: dict[str, str] | None = None) -> int:
        """The command's exit code, or minus the signal that ended it. The limit is of processor time; by the clock, a command that
        waits for something has much longer, and a second time before it is said to hang."""

        def prepare() -> None:
            for number in (signal.SIGHUP, signal.SIGINT, signal.SIGQUIT):  # a run in the background ignores them; tests send them
                signal.signal(number, signal.SIG_DFL)
            if limit:
                resource.setrlimit(resource.RLIMIT_CPU, (int(limit) + 1, int(limit) + 2))
                resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, resource.RLIM_INFINITY))
                resource.setrlimit(resource.RLIMIT_AS, (1 << 34, resource.RLIM_INFINITY))

        for patience in (60 + 10 * limit, 300 + 30 * limit):
            with open(self.log, "w") as log:
                process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                                           start_new_session=True, preexec_fn=prepare, env=os.environ | (environment or {}))  # fmt: skip
                try:
                    return process.wait(patience if limit else None)
                except subprocess.TimeoutExpired:
                    pass
                finally:
                    try:
                        os.killpg(process.pid, signal.SIGKILL)
                    except ProcessLookupError:
                        pass
                    process.wait()
        return -signal.SIGALRM

    def tests_of_ctest(self, labels: str) -> list[Test]:
        shown = subprocess.run(["ctest", "--test-dir", "build", "-L", labels, "-E", "^(python|lab)/|^fuzz/targets", "--show-only=json-v1"],
                               cwd=self.folder, capture_output=True, check=True).stdout  # fmt: skip
        found = []
        for test in json.loads(shown)["tests"]:
            properties = {item["name"]: item["value"] for item in test["properties"]}
            if "LABELS" not in properties:
                continue
            command = test["command"]
            targets = [str(Path(word).relative_to(self.build)) for word in command if word.startswith(f"{self.build}/tests/")]
            if test["name"].startswith("cli/"):
                script = next(word for word in command if word.endswith(".sh"))
                targets = ["carom"] + (["carom-lab"] if re.search(r"^\s*(try )?lab |\$LAB", Path(script).read_text(), re.M) else [])
            environment = dict(item.split("=", 1) for item in properties.get("ENVIRONMENT", []))
            found.append(Test(test["name"], command, properties["WORKING_DIRECTORY"], "", environment, targets))
        return found

    def install(self) -> Path:
        """Where the package is installed: by its own test, once for each state of its sources."""
        self.python = self.build / "python-package/environment/bin/python3"
        mark = self.build / "python-package/mutants"
        state = subprocess.run(["git", "rev-parse", "HEAD:include", "HEAD:src", "HEAD:python/src"],
                               cwd=self.folder, capture_output=True, text=True, check=True).stdout  # fmt: skip
        if not mark.exists() or mark.read_text() != state:
            for name in ("package", "jax", "pooltool"):
                self.must(["sh", f"tests/python/{name}", str(self.folder), str(self.build)], skipped=name != "package")
            mark.write_text(state)
        where = subprocess.run([self.python, "-c", "import carom; print(carom.__path__[0])"], cwd="/", capture_output=True, text=True, check=True)
        package = Path(where.stdout.strip())
        for file in (self.folder / "python/src/carom").glob("*.py"):
            if file.read_text() != (package / file.name).read_text():
                (package / file.name).write_text(file.read_text())
        return package

    def tests_of_package(self) -> list[Test]:
        environment = {"PYTHONDONTWRITEBYTECODE": "1", "JAX_PLATFORMS": "cpu", "CAROM_BUILD": str(self.build)}
        command = [str(self.python), "-m", "pytest", "-q", "-x", "-c", f"{self.folder}/python/pyproject.toml", "--rootdir", str(self.build)]
        files = sorted((self.folder / "python/tests").glob("test_*.py"))
        return [Test(f"python/{file.stem}", [*command, str(file)], str(self.build / "python-package"), "python", environment)
                for file in files if file.name not in PYTHON_LEFT_OUT]  # fmt: skip

    def measure(self) -> None:
        """The processor time of each test on the tree as it is, kept for each state of its programs and of the tests."""
        path = self.folder.parent / (self.folder.name + ".json")
        known = json.loads(path.read_text()) if path.exists() else {}
        for test in self.tests:
            files = [Path(word) for word in test.command if Path(word).is_file() and word.startswith(str(self.folder / "tests"))]
            files += [file.with_suffix(".expected") for file in files if file.suffix == ".sh"]
            if test.room == "python":
                files = [Path(test.command[-1]), *sorted(self.package.glob("*.py")), *sorted(self.package.glob("*.so"))]
            state = hashlib.sha256("".join(self.programs[target] for target in test.targets).encode())
            for file in files:
                state.update(file.read_bytes())
            key = f"{test.name} {state.hexdigest()}"
            if key not in known:
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                if self.run(test.command, test.folder, environment=test.environment) not in GOOD:
                    sys.exit(f"{test.name} fails without a mutant: see {self.log}")
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                known[key] = round(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 2)
                path.write_text(json.dumps(known, indent=0))
            test.seconds = known[key]
        print(f"{len(self.tests)} tests, {sum(test.seconds for test in self.tests):.0f} s of processor time", flush=True)

    def make(self, targets: list[str]) -> bool:
        return self.run(["ninja", "-C", "build", *targets], self.folder) == 0

    def hash(self, name: str) -> str:
        return hashlib.sha256((self.build / name).read_bytes()).hexdigest()

    def changed(self, name: str) -> bool:
        return self.hash(name) != self.programs[name]

    def killer(self, room: str, file: str, kills: dict[tuple[str, str], int]) -> str:
        """The test that fails, or an empty name."""

        def worth(test: Test) -> float:
            own, others = re.findall(r"[a-z]{4,}", f"{room} {file}".lower()), re.findall(r"[a-z]{4,}", test.name)
            near = sum(len(os.path.commonprefix([one, other])) > 3 for one in own for other in others if other != "python")
            return (kills.get((room, test.name), 0) + near + 0.1) / (test.seconds + 0.3)

        for test in sorted(self.tests, key=worth, reverse=True):
            of_python = test.room == "python"
            if of_python != room.startswith("python") or (of_python and PYTHON_ALONE in test.name and PYTHON_ALONE not in file):
                continue
            if test.targets and (not self.make(test.targets) or not any(self.changed(target) for target in test.targets)):
                continue
            if self.run(test.command, test.folder, 10 + 10 * test.seconds, test.environment) not in GOOD:
                return test.name
        return ""


def try_python(copy: Copy, original: str, mutated: str, name: str) -> str | None:
    """An outcome that needs no test, or None."""
    try:
        same = ast.dump(ast.parse(mutated)) == ast.dump(ast.parse(original))
    except SyntaxError:
        return "stillborn"
    return "equivalent" if same else None


def try_c(copy: Copy, path: Path, original: str, place: Place) -> str | None:
    """The same for C."""
    if not copy.make(LINKED):
        return "stillborn"
    if any(copy.changed(name) for name in LINKED):
        return None
    # No compiler reads the place if rubbish in it does no harm.
    path.write_text(replaced(original, place, " @ "))
    return "unbuilt" if copy.make(LINKED) else "equivalent"


def try_one(copy: Copy, room: str, path: Path, place: Place, kills: dict[tuple[str, str], int]) -> tuple[str, str]:
    original = path.read_text()
    mutated = replaced(original, place, place[3])
    try:
        path.write_text(mutated)
        outcome = try_python(copy, original, mutated, path.name) if path.suffix == ".py" else try_c(copy, path, original, place)
        if outcome:
            return outcome, ""
        killer = copy.killer(room, path.name, kills)
        return ("killed", killer) if killer else ("survived", "")
    finally:
        path.write_text(original)


def row_of(room: str, path: Path, place: Place) -> dict[str, str]:
    text = path.read_text()
    start = text.rfind("\n", 0, place[0]) + 1
    line = text.count("\n", 0, place[0]) + 1
    seen = " ".join(text[start : text.find("\n", start)].split())
    return dict(zip(FIELDS, (room, path.name, str(line), str(place[0] - start + 1), place[2], place[3], "", "", "", seen)))


def sources(copy: Copy, room: str) -> list[Path]:
    folder = copy.package if room.startswith("python") else copy.folder / room
    return sorted(p for p in folder.iterdir() if p.suffix in (".c", ".h", ".py") and "windows" not in p.name)


def drawn(copy: Copy, rooms: list[str], count: int, seed: int) -> list[tuple[str, Path, Place]]:
    """The mutants of a run: one of each room in turn, so that a run that is stopped has as many of each."""
    of_rooms = []
    for room in rooms:
        places = [(room, path, place) for path in sources(copy, room) for place in mutants_of(path)]
        random.Random(f"{seed} {room}").shuffle(places)
        of_rooms.append(places[:count])
    return [places[k] for k in range(count) for places in of_rooms if k < len(places)]


def survivors(copy: Copy, rooms: list[str], rows: list[dict[str, str]]) -> list[tuple[str, Path, Place]]:
    """The survivors of a table, each at the nearest line with the same text."""
    found = []
    for row in rows:
        if row["outcome"] != "survived" or row["room"] not in rooms:
            continue
        path = next((path for path in sources(copy, row["room"]) if path.name == row["file"]), None)
        same = []
        for place in mutants_of(path) if path else []:
            other = row_of(row["room"], path, place)
            if all(other[name] == row[name] for name in ("column", "was", "now", "text")):
                same.append((abs(int(other["line"]) - int(row["line"])), place))
        if same:
            row["line"] = row_of(row["room"], path, min(same)[1])["line"]
            found.append((row["room"], path, min(same)[1]))
        else:
            print(f"{row['file']}:{row['line']} is no longer there: {row['text']}")
    return found


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--rooms", default=",".join(ROOMS), help="folders, with a comma between")
    options.add_argument("--count", type=int, default=20, help="mutants of each room")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--minutes", type=float, default=1e9, help="begin no mutant after this time")
    options.add_argument("--again", action="store_true", help="only the survivors of the table")
    options.add_argument("--tests", default="unit|agree|physics|cli|fuzz", help="labels of tests, a regular expression")
    options.add_argument("--slowest", type=float, default=1e9, help="leave out tests that need more processor time, s; --again without it")
    options.add_argument("--isas", default="avx2;avx512", help="instruction sets beside plain; tests of rows need the best of the processor")
    options.add_argument("--folder", type=Path, default=ROOT / "build" / "mutants", help="where the copy of the tree is")
    options.add_argument("-o", dest="out", type=Path, default=Path("mutants.csv"))
    asked = options.parse_args()

    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that the source is restored and no test stays behind
    rooms = asked.rooms.split(",")
    started = time.monotonic()
    copy = Copy(asked.folder.resolve(), asked.tests, asked.isas, rooms)
    copy.tests = [test for test in copy.tests if test.seconds <= asked.slowest]
    rows = []
    if asked.out.exists():
        with open(asked.out, newline="") as file:
            rows = list(csv.DictReader(file))
    kills: dict[tuple[str, str], int] = {}
    for row in rows:
        kills[row["room"], row["by"]] = kills.get((row["room"], row["by"]), 0) + (row["outcome"] == "killed")
    mutants = survivors(copy, rooms, rows) if asked.again else drawn(copy, rooms, asked.count, asked.seed)
    for room, path, place in mutants:
        row = row_of(room, path, place)
        old = next((other for other in rows if all(other[name] == row[name] for name in KEY)), None)
        if old and not asked.again:
            continue
        if time.monotonic() - started > 60.0 * asked.minutes:
            break
        began = time.monotonic()
        row["outcome"], row["by"] = try_one(copy, room, path, place, kills)
        row["seconds"] = f"{time.monotonic() - began:.0f}"
        kills[room, row["by"]] = kills.get((room, row["by"]), 0) + (row["outcome"] == "killed")
        if old:
            old.update(row)
        else:
            rows.append(row)
        with open(asked.out, "w", newline="") as file:
            table = csv.DictWriter(file, FIELDS)
            table.writeheader()
            table.writerows(rows)
        print(*(row[name] for name in FIELDS), sep="  ", flush=True)
    summarise(rows)


def summarise(rows: list[dict[str, str]]) -> None:
    """The rate by room: killed of those that compile and are not known to be equivalent."""
    for room in dict.fromkeys(row["room"] for row in rows):
        outcomes = [row["outcome"] for row in rows if row["room"] == room]
        killed, survived = outcomes.count("killed"), outcomes.count("survived")
        if killed + survived:
            others = ", ".join(f"{outcomes.count(kind)} {kind}" for kind in ("equivalent", "unbuilt", "stillborn"))
            print(f"{room}: {killed} of {killed + survived} killed, {100 * killed / (killed + survived):.0f} %; {others}")


if __name__ == "__main__":
    main()
