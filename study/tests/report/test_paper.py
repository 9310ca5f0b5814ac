"""The claims of the seed paper: each can be judged, each rule draws its border where it says, and
another machine gets another verdict.
"""

import csv
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

STORED = Path(__file__).resolve().parent
ROOT = STORED.parents[2]
sys.path.insert(0, str(ROOT))
from study import paper  # noqa: E402

VERDICTS = {paper.HOLDS, paper.WEAKER, paper.FAILS, paper.UNMEASURED}
MODULE = "sha256 0123"


def rows_of(name):
    with open(STORED / f"{name}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


# Each kernel's speedup on the machine of the paper, and its counts where they are known.
MACHINE = rows_of("machine")


def write(path, rows, **notes):
    with open(path, "w", encoding="utf-8", newline="") as out:
        out.writelines(f"# {what.replace('_', ' ')}: {text}\n" for what, text in notes.items())
        table = csv.DictWriter(out, list(rows[0]))
        table.writeheader()
        table.writerows(rows)


def timed(kernel, config, speedup, steps=1000):
    """A row of the kernel, of whose collisions base takes 26,000 ns."""
    ns = 26000.0 * steps / 1000.0 / speedup
    return {
        "kernel": kernel,
        "config": config,
        "isa": "scalar",
        "steps": steps,
        "ns_median": ns,
        "ns_min": ns,
        "ns_spread": ns / 1000.0,
        "core_cycles": ns / 0.34,
        "speedup": speedup,
        "speedup_spread": speedup / 1000.0,
        "pair_error_max": 1e-3,
    }


CONFIGS = {
    f"{compiler}-{config}": factor * slowed
    for compiler, slowed in (("clang", 1.0), ("gcc", 0.9))
    for config, factor in (("default", 1.0), ("archnative", 1.0), ("novec", 0.95))
}


def machine(folder, **changed):
    """The files of a run, by a machine on which the kernels are as fast as the paper's but for
    those that are `changed`.
    """
    folder.mkdir()
    for name in ("kernels", "verify", "growth-5000", "experiments"):
        shutil.copy(STORED / f"{name}.csv", folder)
    notes = {"reference_kernel": "base, clang-default, with as many steps", "rounds": 100}
    speedups = {row["kernel"]: float(row["speedup"]) for row in MACHINE} | changed
    rows = []
    for config, factor in CONFIGS.items():
        rows += [timed(kernel, config, factor * speed) for kernel, speed in speedups.items()]
    for row in rows:
        if (row["kernel"], row["config"]) == ("float", "clang-archnative"):
            row["speedup"] = 1.93
        if (row["kernel"], row["config"]) == ("recmass", "clang-novec"):
            row["speedup"] = 1.66
    write(folder / "configs.csv", rows, **notes)
    ladder = [timed(kernel, "clang-default", speed) for kernel, speed in speedups.items()]
    write(folder / "ladder.csv", [*ladder, timed("exact", "library", 50.0)], **notes)
    steps = [
        timed(kernel, "clang-default", 1.0, n)
        for kernel in ("base", "float")
        for n in (1000, 10000)
    ]
    write(folder / "steps.csv", steps, **notes)
    cycles = [timed(kernel, "clang-zen2", speed) for kernel, speed in speedups.items()]
    write(folder / "cycles.csv", cycles, **{"module clang-zen2": MODULE})
    counts = [
        row | {"config": "clang-zen2", "steps_total": 1002, "stores_per_step": 2}
        for row in MACHINE
        if row["instructions"]
    ]
    latencies = {"div.d": 13, "sqrt.d": 20, "mul": 3, "rsqrt": 5, "convert": 3}
    said = {f"latency {row}": f"{cycles} cycles" for row, cycles in latencies.items()}
    write(folder / "bounds.csv", counts, **{"module clang-zen2": MODULE}, **said)
    write(folder / "operations.csv", counts, cases="204, N = 1000")
    return folder


def verdicts(folder):
    return {(row["section"], row["claim"]): row for row in paper.judge(folder)}


def of(rows, words):
    """The one row whose claim begins so."""
    found = [row for (_, claim), row in rows.items() if claim.startswith(words)]
    assert len(found) == 1, (words, [row["claim"] for row in found])
    return found[0]


def test_claims_are_whole():
    """At least 30 claims in the order of the sections, each named once in its section, with a rule
    that there is; and a row is refused whose rule or measure there is not.
    """
    claims = paper.read_claims()
    assert len(claims) >= 30
    sections = [claim["section"] for claim in claims]
    assert sections == sorted(sections)
    assert len({(claim["section"], claim["claim"]) for claim in claims}) == len(claims)
    for claim in claims:
        assert claim["rule"].split()[0] in paper.RULES and claim["measure"], claim
    names = paper.Run(STORED).names()
    with pytest.raises(KeyError):
        paper.judge_claim(claims[0] | {"measure": "1.0", "value": "1", "rule": "about"}, names)
    with pytest.raises(NameError):
        paper.judge_claim(claims[0] | {"measure": "guess('float')"}, names)


def test_all_are_measured(tmp_path):
    """On a machine with all files only counters and pooltool are missing, and the row says so."""
    rows = verdicts(machine(tmp_path / "one"))
    missing = [row for row in rows.values() if row["verdict"] == paper.UNMEASURED]
    assert {row["verdict"] for row in rows.values()} <= VERDICTS
    assert all(re.search("counters|pooltool", row["cause"]) for row in missing), missing
    assert len(missing) == 2
    for row in rows.values():
        assert row["verdict"] in (paper.HOLDS, paper.UNMEASURED) or row["cause"], row


def test_machines_differ(tmp_path):
    """The same claim holds on one machine, is weaker on a second and does not hold on a third."""
    for speed, verdict in ((1.65, paper.HOLDS), (1.3, paper.WEAKER), (0.9, paper.FAILS)):
        rows = verdicts(machine(tmp_path / verdict, double=speed))
        assert of(rows, "speedup of double")["verdict"] == verdict
        assert float(of(rows, "speedup of double")["here"]) == speed
    rows = verdicts(machine(tmp_path / "vectors", double_vec=2.0))
    assert of(rows, "double_vec is slower than double (")["verdict"] == paper.FAILS
    assert (
        of(verdicts(tmp_path / paper.HOLDS), "double_vec is slower than double (")["verdict"]
        == paper.HOLDS
    )


def test_shares_need_one_module(tmp_path):
    """No share of a bound where another build was counted than was timed."""
    folder = machine(tmp_path / "one")
    share = "share of the bound that base reaches"
    here = of(verdicts(folder), share)
    assert float(here["here"]) == pytest.approx(100 * 60000 / (26000 / 0.34), rel=1e-5)
    bounds = folder / "bounds.csv"
    bounds.write_text(bounds.read_text().replace(MODULE, "sha256 4567"))
    here = of(verdicts(folder), share)
    assert here["verdict"] == paper.UNMEASURED and "different builds" in here["cause"]


def test_nothing_measured(tmp_path):
    """An empty folder: every claim is there, none is judged, and each says what is missing."""
    rows = verdicts(tmp_path)
    assert {row["verdict"] for row in rows.values()} == {paper.UNMEASURED}
    assert all(row["cause"] for row in rows.values())


@pytest.mark.parametrize("row", rows_of("rules"), ids=lambda row: f"{row['rule']} {row['here']}")
def test_rules(row):
    name, *more = row["rule"].split()
    value = float(row["value"]) if row["value"] else None
    here = paper.Value(float(row["here"]), 0.01)
    assert paper.RULES[name](here, value, *more) == row["verdict"]


def test_command(tmp_path):
    """It prints every claim with its verdict and ends with the conclusion."""
    folder = machine(tmp_path / "one")
    run = [sys.executable, "-m", "study.paper", "--from", str(folder)]
    said = subprocess.run(run, capture_output=True, text=True, cwd=ROOT, check=True).stdout
    assert "paper: 1.93 x (float, clang-archnative, Zen 2); here 1.93 x" in said
    assert said.count(paper.HOLDS) >= 20 and "exact" in said.splitlines()[-1]
    table = subprocess.run([*run, "--csv"], capture_output=True, text=True, cwd=ROOT, check=True)
    assert len(list(csv.DictReader(table.stdout.splitlines()))) == len(paper.read_claims())
    run[-1] = str(tmp_path / "nowhere")
    done = subprocess.run(run, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode and "there is no folder" in done.stderr
