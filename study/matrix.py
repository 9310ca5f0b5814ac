"""The matrix: the claims of the paper for each compiler and target on one machine.

A *column* is a compiler, such as clang14, and a target, native or znver2. study/matrix.cmake
builds the modules, `measure` times all of them in one folder, in turns, and `columns` writes from
it a folder for each column. There the modules have the names of a plain run, such as clang-default,
and speedups are over the column's own `base`; so study/paper.py judges a column like any other run.
"""

import csv
import math
import re
import shlex
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

from study.machines import counted
from study.report.data import DATA
from study.report.fingerprints import stamp
from study.report.sheets import Sheet, number, run

# The sets of a target, by their names in a plain run.
SETS = {
    "native": {
        "default": "default",
        "archnative": "archnative",
        "novec": "novec",
        "o3": "o3",
        "zen2": "zen2",  # as in a plain run: a cause may be that the target differs
    },
    "znver2": {"zen2": "default", "archzen2": "archnative", "novec": "novec", "o3": "o3"},
}
COUNTED = "zen2"  # the set whose operations are counted, for both targets
ORDERED = "ordered"  # the same without regrouping
OVER_BASE = ("speedup", "speedup_min", "speedup_max")
MODULE = re.compile(r"(?<![\w-])((?:clang|gcc)\d*)-(\w+)(?![\w-])")


class NotBuilt(Exception):
    """Why there is no matrix."""


def modules_of(build):
    """The names of the modules that the build has, such as clang14-zen2."""
    answer = subprocess.run(
        [build / "carom-lab", "kernels"], capture_output=True, text=True, check=True
    ).stdout
    return re.search(r"configurations of the ladder: *(.*)", answer)[1].split()


def kernels_of(build):
    """The kernels that run on this machine."""
    answer = subprocess.run(
        [build / "carom-lab", "kernels"], capture_output=True, text=True, check=True
    ).stdout
    return [
        line.split()[0] for line in answer.partition("\n\n")[0].splitlines()[1:] if line.strip()
    ]


def family(compiler):
    """clang14 is a clang."""
    return compiler.rstrip("0123456789")


def compilers_of(modules):
    """The compilers that have every set of the matrix, in the order of the build."""
    compilers = dict.fromkeys(module.split("-")[0] for module in modules)
    sets = {name for target in SETS.values() for name in target}
    return [c for c in compilers if all(f"{c}-{name}" in modules for name in sets)]


# ---- Building and measuring


def build_matrix(build):
    """Builds every module of the matrix in a build that exists."""
    print("building the ladder by every clang from 14 on and by gcc", file=sys.stderr, flush=True)
    for words in (
        ["cmake", "-DCAROM_LADDER=ON", "-DCAROM_LADDER_MATRIX=ON", "-DCAROM_LADDER_CONFIGS=all"],
        ["cmake", "--build"],
    ):
        command = [*words, str(build)]
        if "--build" in words:
            command += ["--target", "carom_lab", "ladder_modules", "bounds_driver"]
            command += ["bounds_latency", "bounds_estimate"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise NotBuilt(f"'{shlex.join(command)}' failed:\n{done.stdout[-2000:]}{done.stderr}")
        for line in done.stdout.splitlines():
            if "The ladder by" in line:
                print(line.removeprefix("-- "), file=sys.stderr, flush=True)


def without(words, option):
    """The words of a command without an option and its value."""
    if option not in words:
        return words
    place = words.index(option)
    return words[:place] + words[place + 2 :]


def commands(name, modules, kernels):
    """What measures a sheet of the matrix: {file: command}. It is the command of a plain run, with
    the modules of all compilers.
    """
    words = shlex.split(DATA[name][1])
    compilers = compilers_of(modules)
    if words[:2] == ["carom-lab", "verify"]:
        return {name: shlex.join(without(words, "--config"))}
    if "study.bounds" in words:
        sets = [f"{compiler}-{COUNTED}" for compiler in compilers]
        if name == "bounds":
            sets += [f"{c}-{ORDERED}" for c in compilers if f"{c}-{ORDERED}" in modules]
        words = without(words, "--config")
        return {f"{name}@{module}": shlex.join([*words, "--config", module]) for module in sets}
    if words[:2] != ["carom-lab", "bench"]:
        return {name: shlex.join(words)}
    config = words[words.index("--config") + 1] if "--config" in words else "default"
    # Both targets of the default configuration are timed where a plain run times one.
    sets = {"all": None, "default": ["default", COUNTED]}.get(config, [config])
    chosen = [
        module
        for module in modules
        if module.split("-")[0] in compilers and (not sets or module.split("-")[1] in sets)
    ]
    words = [*without(words, "--config"), "--config", ",".join(chosen)]
    if "--kernel" not in words:
        words += ["--kernel", ",".join(kernels)]
    return {name: shlex.join(words)}


def measure(options, names):
    """Measures the sheets `names` of the whole matrix into options.folder; `options.budget` is for
    each column. Returns the files that could not be measured.
    """
    modules, kernels = modules_of(options.build), kernels_of(options.build)
    compilers = compilers_of(modules)
    if not compilers:
        raise NotBuilt(
            f"{options.build} lacks the sets of the matrix; it has {' '.join(modules) or 'none'}"
        )
    budget = options.budget * len(compilers) * len(SETS)
    whole = sum(DATA[name][0] for name in names) or 1
    missing = []
    for name in names:
        for file, command in commands(name, modules, kernels).items():
            target = options.folder / f"{file}.csv"
            share = DATA[name][0]
            more = ["--budget", f"{budget * share / whole:.4g}"] if share else []
            print(f"{target.name}: {command}", flush=True)
            if not run(command, options, *more, "--output", target):
                target.unlink(missing_ok=True)
                missing.append(file)
            elif " bench " in command:
                stamp(target)
    return missing


# ---- A folder for each column


def scope_of(name):
    """What a plain run has in a sheet: `all` sets of two compilers, the `default` of one, or the
    `counted` set of one.
    """
    words = shlex.split(DATA[name][1]) if name in DATA else []
    config = words[words.index("--config") + 1] if "--config" in words else None
    if config == "all" or ("verify" in words and not config):
        return "all"
    return "counted" if config == COUNTED or "study.bounds" in words else "default"


def names_in_column(compiler, target, partner, scope):
    """The modules of a column, {name: name in a plain run}, its own first. Counts are of one set for
    both targets, and keep its name.
    """
    sets = SETS[target]
    if scope == "counted":
        sets = {COUNTED: COUNTED}
    elif scope == "default":
        sets = {name: plain for name, plain in sets.items() if plain == "default"}
    return {
        f"{one}-{name}": f"{family(one)}-{plain}"
        for one in (compiler, partner if scope == "all" else None)
        if one
        for name, plain in sets.items()
    }


def notes_of(text, names):
    """The lines of notes that are of this column, in its names."""
    kept = []
    for line in text.splitlines():
        if not line.startswith("#"):
            continue
        named = {f"{one}-{name}" for one, name in MODULE.findall(line)}
        if line.startswith("# reference kernel: ") or not named:
            kept.append(line)
        elif named <= names.keys():
            kept.append(MODULE.sub(lambda match: names[match[0]], line))
    return kept


def over_own_base(rows, reference):
    """The rows with speedups over the column's `base`, with as many steps. Both speedups are medians
    over the same rounds, so their scatter adds up.
    """
    bases = {
        row.get("steps"): row
        for row in rows
        if row.get("kernel") == "base" and row.get("config") == reference
    }
    found = []
    for row in rows:
        base = bases.get(row.get("steps"))
        if "speedup" not in row or base is None:
            found.append(row)
            continue
        changed, factor = dict(row), number(base["speedup"])
        for column in OVER_BASE:
            if column in row:
                changed[column] = f"{number(row[column]) / factor:.5g}"
        if "speedup_spread" in row:
            parts = [
                number(one["speedup_spread"]) / number(one["speedup"])
                for one in (row, base)
                if one["speedup"] != "1"
            ]
            spread = 0.0 if row is base else math.hypot(*parts) * number(changed["speedup"])
            changed["speedup_spread"] = f"{spread:.3g}"
        found.append(changed)
    return found


def write_column(source, target_file, names, reference, compiler, target):
    """A sheet of the column, from one of the matrix."""
    text = source.read_text(encoding="utf-8")
    rows = []
    for row in Sheet(source).rows:
        config = row.get("config")
        if config is None or config.startswith("library"):
            rows.append(row)
        elif config in names:
            rows.append(row | {"config": names[config]})
    if not rows:
        return
    # A plain run begins with its first compiler.
    own = family(compiler)
    rows.sort(key=lambda row: not row.get("config", own).startswith((own, "library")))
    notes = notes_of(text, names)
    if any(line.startswith("# reference kernel: ") for line in notes):
        notes = [line for line in notes if not line.startswith("# reference kernel: ")]
        notes.append(f"# reference kernel: base, {reference}, with as many steps")
    notes += [f"# compiler of the column: {compiler}", f"# target of the column: {target}"]
    with open(target_file, "w", encoding="utf-8", newline="") as out:
        out.writelines(f"{line}\n" for line in notes)
        table = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(over_own_base(rows, reference))


def columns(folder):
    """Writes a folder for each column below `folder`; returns {(compiler, target): its folder}."""
    folder = Path(folder)
    timed = Sheet(folder / "configs.csv")
    modules = list(dict.fromkeys(row["config"] for row in timed.rows))
    found = {}
    for compiler in compilers_of(modules):
        # The comparison of clang and gcc takes the first compiler of the other family.
        partner = next((c for c in compilers_of(modules) if family(c) != family(compiler)), None)
        for target in SETS:
            column = folder / f"{compiler}-{target}"
            shutil.rmtree(column, ignore_errors=True)
            column.mkdir()
            for source in sorted(folder.glob("*.csv")):
                # Counts have a file for each module, such as bounds@clang14-zen2.csv.
                name, _, module = source.stem.partition("@")
                if module and module != f"{compiler}-{COUNTED}":
                    continue
                scope = scope_of(name)
                names = names_in_column(compiler, target, partner, scope)
                reference = f"{family(compiler)}-{COUNTED if scope == 'counted' else 'default'}"
                where = column / f"{name}.csv"
                write_column(source, where, names, reference, compiler, target)
            if target == "znver2" and f"{compiler}-{ORDERED}" in modules:
                write_ordered(folder, column, compiler)
            found[compiler, target] = column
    return found


def write_ordered(folder, column, compiler):
    """The counts and times of the set without regrouping, compared with those of the column: it is no
    configuration of the paper's, so the sheets that are judged do not have it.
    """
    first = family(compiler)
    names = {f"{compiler}-{name}": f"{first}-{name}" for name in (COUNTED, ORDERED)}
    for source, target in (
        ("configs", "ordered"),
        (f"bounds@{compiler}-{ORDERED}", "bounds@ordered"),
    ):
        path = folder / f"{source}.csv"
        if path.is_file():
            reference = f"{first}-{COUNTED}"
            write_column(path, column / f"{target}.csv", names, reference, compiler, "znver2")


# ---- What is printed


def print_matrix(judged, out):
    """A claim a line, a column for each compiler and target: its value, and the verdict by its
    first letter.
    """
    names = [f"{compiler} {target}" for compiler, target in judged]
    for place, name in enumerate(names):
        print(f"{place + 1}: {name}", file=out)
    rows = list(zip(*judged.values()))
    verdicts = dict.fromkeys(row["verdict"] for line in rows for row in line)
    print(", ".join(f"{verdict[0]}: {verdict}" for verdict in verdicts), file=out)
    heads = "".join(f"{place + 1:>10} " for place in range(len(names)))
    print(f"\n{'claim of the paper':<60} {'paper':>7} {heads}", file=out)
    for line in rows:
        first = line[0]
        cells = "".join(f" {short(row['here']):>8} {row['verdict'][0]}" for row in line)
        *begin, last = textwrap.wrap(first["claim"], 60)
        for part in begin:
            print(part, file=out)
        print(f"{last:<60} {short(first['paper']):>7}{cells}", file=out)
    print(file=out)
    for name, line in zip(names, judged.values()):
        print(f"{name}: {counted(row['verdict'] for row in line)}", file=out)


def short(text):
    return f"{float(text):.4g}" if text else "-"


def print_csv(judged, out):
    writer = None
    for (compiler, target), rows in judged.items():
        for row in rows:
            found = {"compiler": compiler, "target": target} | row
            if writer is None:
                writer = csv.DictWriter(out, list(found), lineterminator="\n")
                writer.writeheader()
            writer.writerow(found)
