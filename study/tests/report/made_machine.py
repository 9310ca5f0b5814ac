"""The files of a run by a made-up machine, for tests of the judge.

machine.csv has a kernel a row, its speedup and its counts, as the paper gives them; where the paper
gives an order only, they are such that the order holds.
"""

import csv
import shutil
from pathlib import Path

STORED = Path(__file__).resolve().parent
MODULE = "sha256 0123"
BASE_CYCLES, CYCLE_NS = 85300.0, 0.34
STEPS = (100, 1000, 10000)
LATENCIES = {"div.d": 13, "sqrt.d": 20, "mul": 3, "rsqrt": 5, "convert": 3}
NOVEC = {"recmass": 1.7, "cse": 1.6}
BEST = 1.93  # float with archnative


def rows_of(name):
    with open(STORED / f"{name}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


MACHINE = rows_of("machine")
SPEEDUPS = {row["kernel"]: float(row["speedup"]) for row in MACHINE}
# The counts of the kernels that are counted: {kernel: {column: text}}.
COUNTS = {
    row["kernel"]: {name: text for name, text in row.items() if name not in ("kernel", "speedup")}
    for row in MACHINE
    if row["instructions"]
}


def write(path, rows, **notes):
    with open(path, "w", encoding="utf-8", newline="") as out:
        out.writelines(f"# {what.replace('_', ' ')}: {text}\n" for what, text in notes.items())
        table = csv.DictWriter(out, list(rows[0]))
        table.writeheader()
        table.writerows(rows)


def timed(kernel, config, speedup, steps=1000):
    """The row of a kernel, by `carom-lab bench`."""
    cycles = BASE_CYCLES * steps / 1000.0 / speedup
    ns = cycles * CYCLE_NS
    return {
        "kernel": kernel,
        "config": config,
        "isa": "scalar",
        "steps": steps,
        "ns_median": ns,
        "ns_min": ns,
        "ns_spread": ns / 1000.0,
        "core_cycles": cycles,
        "speedup": speedup,
        "speedup_spread": speedup / 1000.0,
        "pair_error_max": 1e-3,
    }


def timed_builds(speedups, novec, best):
    """Rows of every kernel in the configurations of two compilers; gcc is slower."""
    rows = []
    for compiler, slowed in (("clang", 1.0), ("gcc", 0.9)):
        for config in ("default", "archnative", "novec", "o3", "zen2"):
            of_config = dict(speedups)
            if config == "novec":
                of_config |= novec
            if (compiler, config) == ("clang", "archnative"):
                of_config["float"] = best
            rows += [
                timed(kernel, f"{compiler}-{config}", slowed * speedup)
                for kernel, speedup in of_config.items()
            ]
    return rows


def machine(folder, novec=NOVEC, best=BEST, counts=COUNTS, **changed):
    """The files of a run, by a machine on which the kernels are as fast as the paper's but for
    those that are `changed`.

    `novec` are speedups in that configuration, `best` is that of float with archnative.
    """
    folder.mkdir()
    for name in ("kernels", "verify", "growth-5000", "experiments"):
        shutil.copy(STORED / f"{name}.csv", folder)
    notes = {
        "processor": "AMD EPYC 7302",
        "processor_family": "23, model 49",
        "reference_kernel": "base, clang-default, with as many steps",
        "rounds": 100,
    }
    module = {"module clang-zen2": MODULE}
    speedups = SPEEDUPS | changed
    write(folder / "configs.csv", timed_builds(speedups, novec, best), **notes)
    ladder = [timed(kernel, "clang-default", speed) for kernel, speed in speedups.items()]
    write(folder / "ladder.csv", [*ladder, timed("exact", "library", 50.0)], **notes)
    steps = [timed(kernel, "clang-default", 1.0, n) for kernel in ("base", "float") for n in STEPS]
    write(folder / "steps.csv", steps, **notes)
    cycles = [timed(kernel, "clang-zen2", speedups[kernel], n) for kernel in counts for n in STEPS]
    write(folder / "cycles.csv", cycles, **notes, **module)
    counted = [
        {"kernel": kernel, "config": "clang-zen2", "steps_total": 1002}
        | {"per_step_flops_amd": float(columns["flops_amd"]) / 1000.0}
        | columns
        for kernel, columns in counts.items()
    ]
    said = {f"latency {row}": f"{cycles} cycles" for row, cycles in LATENCIES.items()}
    said |= {"estimate": "12 bits, largest relative error 0.000244"}
    write(folder / "bounds.csv", counted, **module, **said)
    write(folder / "operations.csv", counted, cases="204, N = 1000")
    return folder
