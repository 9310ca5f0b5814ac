"""What the study measures: a CSV file for each command."""

from study.report.fingerprints import stamp
from study.report.sheets import run

STEPS = "10,20,50,100,200,500,1000,2000,5000,10000"
SCALAR = "base,rsqrt,recmass,cse,reorder,sepwhile,double,float"
FIVE = "base,double,float,double_vec,float_vec"
LANES = "double_lanes_avx2,float_lanes_avx2,double_lanes_avx512,float_lanes_avx512"

# NAME.csv: its fraction of the budget in per cent, 0 for what is computed; the command, to which
# `-o NAME.csv` is added.
DATA = {
    "kernels": (0, "carom-lab kernels --csv"),
    "experiments": (0, "carom-lab experiments --csv"),
    "verify": (0, "carom-lab verify --csv"),
    "growth-5000": (
        0,
        "carom-lab verify --kernel float --config default --steps 5000 --csv",
    ),
    # The library's solvers with base's slip too, to compare like with like.
    "ladder": (
        25,
        "carom-lab bench --slip pooltool,paper --threads 1 --csv --spread --errors --counters",
    ),
    "steps": (20, f"carom-lab bench --kernel {FIVE} --steps {STEPS} --csv --spread"),
    "accuracy": (
        21,
        f"carom-lab bench --kernel exact,fast,euler,double,float,{LANES} --isa scalar,best --steps {STEPS},20000,50000 --csv --errors",
    ),
    "configs": (
        21,
        f"carom-lab bench --kernel {SCALAR},double_newton,double_vec,float_vec --config all --csv --spread --counters",
    ),
    "cycles": (
        13,
        f"carom-lab bench --kernel {FIVE} --config zen2 --steps {STEPS} --csv --spread --counters",
    ),
    "bounds": (0, "tools/python -m study.bounds"),
    "operations": (0, f"tools/python -m study.bounds --kernel {SCALAR} --steps 100"),
}


def measure(options, names):
    whole = sum(DATA[name][0] for name in names)
    for name in names:
        share, command = DATA[name]
        target = options.folder / f"{name}.csv"
        budget = ["--budget", f"{options.budget * share / whole:.4g}"] if share else []
        print(f"{target.name}: {command}", flush=True)
        if not run(command, options, *budget, "--output", target):
            target.unlink(missing_ok=True)
        elif " bench " in command:
            stamp(target)
