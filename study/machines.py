"""The recorded runs of the study: `carom-lab paper --record NAME` writes them.

A *run* is one measurement of one compiler and target on one machine. Its id, such as
xeon207-clang22-native, is what tables and sentences cite. Four files in study/ hold the runs:

    machines.csv   a run a row: id, machine, processor, compiler, target, date, commit, source, and
                   the speedup of each kernel over the run's own `base` by default. The paper is the
                   first row. `float@archnative` is the build that the paper found to be the fastest.
                   A cell is empty where nobody has measured, and has words where the paper has words
    verdicts.csv   a claim of a run a row: the paper's value, the run's, and the verdict
    chains.csv     a kernel of a run a row: the counts of its machine code, by study/bounds; and the
                   same for `ordered`, which does not regroup sums and products
    measured.csv   the other numbers of the page, one in a row; study/measured.py explains them

Recording a run again replaces its rows. docs/study/paper.md and README.md show the files between
comments; study/tests/report/test_machines.py compares them. `tools/python -m study.machines` writes
the pages anew, and with DIR NAME records the run whose files are in DIR.
"""

import argparse
import csv
import re
import sys
import textwrap
from collections import Counter
from pathlib import Path

from study import measured
from study.report.sheets import ROOT, Sheet, number

MACHINES = ROOT / "study" / "machines.csv"
PAGE = ROOT / "docs" / "study" / "paper.md"
README = ROOT / "README.md"
ABOUT = ["run", "machine", "processor", "compiler", "target", "date", "commit", "source"]
CHAINS = ["run", "kernel", "set", "chain_cycles_zen2", "chain_cycles_registers"]
CHAINS += ["loads_per_step", "stores_per_step", "shuffles_per_step", "speedup"]
BEST = "float@archnative"
FIGURES = ("speedup", "steps", "performance")  # of docs/study/paper.md, by their data
PAGE_WIDTH = 120  # of a line of the docs
# In the order in which they are counted: the words after a number of claims.
VERDICTS_COUNTED = {
    "holds": "hold",
    "indistinguishable": "indistinguishable",
    "weaker": "weaker",
    "does not hold here": "do not hold here",
    "not measurable here": "not measurable here",
}
NOTES = ("processor", "processor family", "commit", "date")
VERDICTS_SHOWN = {"holds": "holds", "does not hold here": "**fails**", "not measurable here": "–"}
BLOCK = re.compile(
    r"(<!-- (runs|verdicts|chains|figures|sentence|errors|steps|operations|configurations)"
    r" -->\n).*?(<!-- end of \2 -->\n)",
    re.S,
)
VERDICT_NOTES = ["claim", "section", "id", "unit", "paper", "here", "uncertainty", "verdict"]


class Refusal(Exception):
    """Why a run is not recorded."""


# ---- The files


def read_rows(path):
    """The comment at the head of a file, and its rows."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True) if path.is_file() else []
    comment = "".join(line for line in lines if line.startswith("#"))
    return comment, list(csv.DictReader(line for line in lines if not line.startswith("#")))


def read_machines(path=MACHINES):
    return read_rows(path)


def beside(path, name):
    """verdicts.csv and chains.csv are next to machines.csv."""
    return path.with_name(f"{name}.csv")


def write_rows(path, comment, rows):
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(comment)
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


# ---- A run


def id_of(machine, compiler, target):
    """xeon207-clang22-native: the major version decides."""
    name, _, version = compiler.partition(" ")
    slug = re.sub(r"[^a-z0-9]+", "", machine.lower())
    return f"{slug}-{name}{version.partition('.')[0]}-{target}"


def reference_of(sheet):
    """The module whose `base` the speedups are relative to."""
    note = sheet.notes.get("reference kernel", "none")
    if not note.startswith("base, "):
        raise Refusal(f"speedups are relative to {note}; a run needs the kernels of the ladder")
    return note.split(", ")[1]


def speedups_of(sheet, reference):
    """Each kernel's speedup in the default configuration, and that of the paper's best build."""
    found = {
        row["kernel"]: row["speedup"]
        for row in sheet.rows
        if row["config"] == reference and row["kernel"] != "base"
    }
    best = sheet.first(kernel="float", config=f"{reference.split('-')[0]}-archnative")
    if best:
        found[BEST] = best["speedup"]
    return {kernel: f"{float(speedup):.2f}" for kernel, speedup in found.items()}


def compiler_of(sheet):
    """ "clang 22.1.8", by the reference module's note."""
    reference = reference_of(sheet)
    version = re.search(r"\d+(\.\d+)+", sheet.notes.get(reference, ""))
    name = reference.split("-")[0]
    return f"{name} {version[0]}" if version else name


def row_of_run(folder, name):
    """The row of a run, from its configs.csv."""
    path = Path(folder) / "configs.csv"
    sheet = Sheet(path)
    if not sheet.rows:
        raise Refusal(f"{path} is not there or has no rows; `carom-lab paper` measures it")
    try:
        reference = reference_of(sheet)
    except Refusal as why:
        raise Refusal(f"{path}: {why}") from None
    absent = [note for note in (*NOTES, reference) if note not in sheet.notes]
    if absent:
        raise Refusal(f"{path}: no line '# {absent[0]}: ...', which `carom-lab bench` writes")
    commit = sheet.notes["commit"]
    if not re.fullmatch(r"[0-9a-f]{7,40}", commit):
        raise Refusal(
            f"{path} was measured at commit '{commit}'; a run is recorded at a commit without "
            "changes, so commit them, build and measure again"
        )
    target = sheet.notes.get("target of the column", "native")
    about = {
        "run": id_of(name, compiler_of(sheet), target),
        "machine": name,
        "processor": f"{sheet.notes['processor']}, family {sheet.notes['processor family']}",
        "compiler": compiler_of(sheet),
        "target": target,
        "date": sheet.notes["date"][:10],
        "commit": commit,
        "source": f"{sheet.notes.get('rounds', 'unknown').split(';')[0]} rounds",
    }
    # The default configuration is timed by itself too, with every rung and in more rounds.
    ladder = Sheet(Path(folder) / "ladder.csv")
    return about | speedups_of(sheet, reference) | speedups_of(ladder, reference)


def chains_of(folder, run):
    """The counts of the run's kernels, and of the same kernels without regrouping. Both targets of
    a compiler share the counts; the run of the counted target has them.
    """
    rows, timed = [], Sheet(Path(folder) / "ordered.csv")
    for sheet in (Sheet(Path(folder) / "bounds.csv"), Sheet(Path(folder) / "bounds@ordered.csv")):
        if sheet.notes.get("target of the column") == "native":
            continue
        steps = re.search(r"N = (\d+)", sheet.notes.get("cases", ""))
        for row in sheet.rows:
            found = {"run": run, "kernel": row["kernel"], "set": row["config"].split("-")[1]}
            found |= {column: row[column] for column in CHAINS[3:] if column in row}
            if steps and "shuffles" in row:
                found["shuffles_per_step"] = f"{number(row['shuffles']) / float(steps[1]):.1f}"
            time = timed.first(kernel=row["kernel"], config=row["config"])
            if time:
                found["speedup"] = f"{number(time['speedup']):.2f}"
            rows.append(found)
    return rows


def record(runs, path=MACHINES):
    """Writes runs, (folder, name, verdicts) each, into the files; returns their ids. A kernel that
    is new in a run becomes a column.
    """
    comment, rows = read_machines(path)
    new, verdicts, chains, numbers = [], [], [], []
    for folder, name, judged in runs:
        row = row_of_run(folder, name)
        new.append(row)
        for claim in judged:
            known = {column: claim[column] for column in VERDICT_NOTES if column in claim}
            verdicts.append({"run": row["run"]} | known)
        chains += chains_of(folder, row["run"])
        numbers += measured.rows_of(folder, row["run"])
    ids = [row["run"] for row in new]
    write_rows(path, comment, [row for row in rows if row["run"] not in ids] + new)
    for name, added in (("verdicts", verdicts), ("chains", chains), ("measured", numbers)):
        head, remaining = read_rows(beside(path, name))
        remaining = [row for row in remaining if row["run"] not in ids]
        if remaining or added:
            write_rows(beside(path, name), head, remaining + added)
    return ids


# ---- What the pages show


def markdown(lines):
    head, *rest = lines
    all_lines = [head, ["---"] * len(head), *rest]
    return "".join(re.sub(r" +\|", " |", f"| {' | '.join(line)} |\n") for line in all_lines)


def table_of_runs(path):
    """A run a column, a kernel a row."""
    rows = read_machines(path)[1]
    lines = [["", *(f"`{row['run']}`" for row in rows)]]
    for column in list(rows[0])[1:]:
        head = column if column in ABOUT else f"`{column}`"
        lines.append([head, *(row[column] or "" for row in rows)])
    return markdown(lines)


def key_of(claim):
    """What names a claim: its id, or else its section and words."""
    return claim.get("id") or (claim["section"], claim["claim"])


def table_of_verdicts(path):
    """A claim a row, a run a column: the run's value and the verdict."""
    rows = read_rows(beside(path, "verdicts"))[1]
    if not rows:
        return "No run with verdicts is recorded yet.\n"
    runs = list(dict.fromkeys(row["run"] for row in rows))
    by_claim = {}
    for row in rows:
        by_claim.setdefault(key_of(row), {})[row["run"]] = row
    lines = [["claim", "paper", *(f"`{run}`" for run in runs)]]
    section = None
    for found in by_claim.values():
        first = next(iter(found.values()))
        if first["section"] != section:
            section = first["section"]
            lines.append([f"**{section}**", "", *([""] * len(runs))])
        lines.append(
            [first["claim"], shown(first["paper"]), *(cell(found.get(run)) for run in runs)]
        )
    counts = [Counter(row["verdict"] for row in rows if row["run"] == run) for run in runs]
    for verdict in dict.fromkeys(row["verdict"] for row in rows):
        lines.append([f"number: {verdict}", "", *(str(count[verdict]) for count in counts)])
    return markdown(lines)


def shown(text):
    return f"{float(text):.4g}" if text else ""


def cell(row):
    if row is None:
        return ""
    verdict = VERDICTS_SHOWN.get(row["verdict"], row["verdict"])
    return f"{shown(row['here'])} {verdict}".strip()


def table_of_chains(path):
    """The longest chain by compiler, with and without regrouping."""
    rows = read_rows(beside(path, "chains"))[1]
    about = {row["run"]: row for row in read_machines(path)[1]}
    heads = ["compiler", "kernel", "chain", "in registers", "chain, ordered", "speedup"]
    lines = [[*heads, "speedup, ordered", "loads", "stores", "lane moves"]]
    first = {}
    for row in rows:
        run = about.get(row["run"], {})
        first.setdefault((run.get("compiler", ""), row["kernel"]), {}).setdefault(row["set"], row)
    for (compiler, kernel), sets in first.items():
        usual, ordered = sets.get("zen2"), sets.get("ordered", {})
        if usual:
            lines.append(
                [
                    compiler,
                    f"`{kernel}`",
                    a_step(usual["chain_cycles_zen2"]),
                    a_step(usual.get("chain_cycles_registers")),
                    a_step(ordered.get("chain_cycles_zen2")),
                    usual.get("speedup", ""),
                    ordered.get("speedup", ""),
                    tenths(usual.get("loads_per_step")),
                    tenths(usual.get("stores_per_step")),
                    usual.get("shuffles_per_step", ""),
                ]
            )
    return markdown(lines) if len(lines) > 1 else "No run with counts is recorded yet.\n"


def a_step(cycles):
    """Cycles of a step from those of a collision with 1000 steps."""
    return f"{number(cycles) / 1000:.0f}" if cycles else ""


def tenths(text):
    return f"{number(text):.1f}" if text else ""


def main_run(path=MACHINES):
    """The run that README cites: of the latest date the first, which is the first compiler's for
    the machine at hand.
    """
    judged = {row["run"] for row in read_rows(beside(path, "verdicts"))[1]}
    rows = [row for row in read_machines(path)[1] if row["run"] in judged]
    latest = max((row["date"] for row in rows), default=None)
    return next((row for row in rows if row["date"] == latest), None)


def sentence(path=MACHINES):
    """What README says of the paper's claims."""
    run = main_run(path)
    if run is None:
        return "No run is recorded yet.\n"
    kernels = {name: float(run[name]) for name in ("double", "float", BEST) if run.get(name)}
    best = max(kernels.values())
    text = (
        f"On the {run['machine']} with {run['compiler']}, the paper's fastest kernel reaches "
        f"{best:.2f} x (run `{run['run']}`, {run['date']}, commit {run['commit'][:8]})."
    )
    verdicts = [row for row in read_rows(beside(path, "verdicts"))[1] if row["run"] == run["run"]]
    if verdicts:
        count = Counter(row["verdict"] for row in verdicts)
        text += f" Of the paper's {len(verdicts)} claims, {count['holds']} hold in this run."
    known = measured.lookup(read_rows(beside(path, "measured"))[1], run["run"])
    if ("time_slip", "exact", "") in known:
        error = f"{float(known['error_slip', 'exact', '']):.1e}".replace("e-0", "e-")
        text += (
            " `base` uses pooltool's slip, and the solvers use the paper's. With pooltool's slip, "
            f"a call of `exact` takes {known['time_slip', 'exact', '']} times as long, and its "
            f"error is at most {error}."
        )
    return textwrap.fill(text, PAGE_WIDTH, break_on_hyphens=False) + "\n"


def table_of(table, target):
    """A table of study/measured.py, of the main run's machine and compiler for a target."""

    def shown(path=MACHINES):
        run = main_run(path)
        if run is None:
            return "No run is recorded yet.\n"
        name = f"{run['run'].rpartition('-')[0]}-{target}"
        lines = table(read_rows(beside(path, "measured"))[1], name)
        return f"Run `{name}`:\n\n{markdown(lines)}"

    return shown


def figures(_path=MACHINES):
    """Where and when the page's figures were measured, by the notes of their data."""
    sentences = {}
    for name in FIGURES:
        notes = Sheet(ROOT / "docs" / "figures" / "data" / f"{name}.csv").notes
        about = (
            f"{notes.get('processor', 'unknown')}, family {notes.get('processor family', 'unknown')}"
            f", {compiler_of_figure(notes)}, commit {notes.get('commit', 'unknown')[:8]}"
            f", {notes.get('date', 'unknown')[:10]}"
        )
        sentences.setdefault(about, []).append(name)
    lines = [
        f"Data of the figures {', '.join(names)}: {about}." for about, names in sentences.items()
    ]
    return textwrap.fill(" ".join(lines), PAGE_WIDTH, break_on_hyphens=False) + "\n"


def compiler_of_figure(notes):
    version = re.search(r"\d+(\.\d+)+", notes.get("clang-default", notes.get("gcc-default", "")))
    return (
        f"{'clang' if 'clang-default' in notes else 'gcc'} {version[0] if version else ''}".strip()
    )


SHOWN = {
    "figures": figures,
    "runs": table_of_runs,
    "verdicts": table_of_verdicts,
    "chains": table_of_chains,
    "sentence": sentence,
    "errors": table_of(measured.table_of_errors, "native"),
    "steps": table_of(measured.table_of_steps, "znver2"),
    "operations": table_of(measured.table_of_operations, "znver2"),
    "configurations": table_of(measured.table_of_configurations, "native"),
}


def page_with(text, path=MACHINES, names=("runs",)):
    """The page's text with what the files say between its comments."""
    absent = [name for name in names if f"<!-- {name} -->\n" not in text]
    if absent:
        raise Refusal(
            f"the page lacks the lines '<!-- {absent[0]} -->' and '<!-- end of {absent[0]} -->'"
        )

    def block(found):
        # A table needs an empty line on both sides; a sentence does not.
        edge = "" if found[2] == "sentence" else "\n"
        return f"{found[1]}{edge}{SHOWN[found[2]](path)}{edge}{found[3]}"

    return BLOCK.sub(block, text)


TABLES = ("runs", "verdicts", "chains", "errors", "steps", "operations", "configurations")
PAGES = {PAGE: (*TABLES, "figures"), README: ("sentence",)}


def write_pages():
    for page, names in PAGES.items():
        text = page_with(page.read_text(encoding="utf-8"), MACHINES, names)
        page.write_text(text, encoding="utf-8")


def record_and_show(runs, path=MACHINES):
    """Records the runs, and writes the pages where the file is the pages' own."""
    ids = record(runs, path)
    message = f"recorded in {path.parent}: {', '.join(ids)}"
    if path != MACHINES:
        return message
    write_pages()
    pages = " and ".join(str(page.relative_to(ROOT)) for page in PAGES)
    return f"{message}; {pages} show them"


# ---- What a run prints


def compilers_of(sheet):
    """Which compilers a run compared, in a sentence: the choice is never silent."""
    found = {}
    for what, text in sheet.notes.items():
        name, _, config = what.partition("-")
        if config and re.fullmatch(r"(clang|gcc)\d*", name) and name not in found:
            version = re.search(r"\d+(\.\d+)+", text)
            found[name] = f"{name} {version[0] if version else 'of unknown version'}"
    if not found:
        return "compilers: none; this build has no kernels of the ladder"
    target = sheet.notes.get("target of the column", "native")
    first = sheet.notes.get("reference kernel", "base, ?").split(", ")[1].split("-")[0]
    listed = sorted(found, key=lambda name: name != first)
    return (
        f"compilers: {', '.join(found[name] for name in listed)}; speedups are over base by "
        f"{found.get(first, first)}, target {target}"
    )


def counted(verdicts):
    """ "37 hold, 8 indistinguishable": how many claims have which verdict."""
    count = Counter(verdicts)
    return ", ".join(
        f"{count[verdict]} {words}" for verdict, words in VERDICTS_COUNTED.items() if count[verdict]
    )


def summary(path=MACHINES):
    """A line for each recorded run: how many claims have which verdict."""
    rows = read_rows(beside(path, "verdicts"))[1]
    lines = []
    for run in dict.fromkeys(row["run"] for row in rows):
        counts = counted(row["verdict"] for row in rows if row["run"] == run)
        lines.append(f"recorded run {run}: {counts}")
    return lines


def main(words):
    parser = argparse.ArgumentParser(prog="study.machines", description=__doc__.partition("\n")[0])
    parser.add_argument(
        "folder", type=Path, nargs="?", metavar="DIR", help="a run's folder, with configs.csv"
    )
    parser.add_argument("name", nargs="?", metavar="NAME", help="what the tables call the machine")
    parser.add_argument("--to", type=Path, default=MACHINES, help="the file that gets the row")
    options = parser.parse_args(words)
    if (options.folder is None) != (options.name is None):
        parser.error("a run needs DIR and NAME; without both, only the pages are written")
    try:
        if options.folder is None:
            write_pages()
        else:
            print(record_and_show([(options.folder, options.name, [])], options.to))
    except Refusal as why:
        parser.error(str(why))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
