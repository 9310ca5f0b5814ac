"""What the study measures: a CSV file for each command."""

from study.report.fingerprints import stamp
from study.report.sheets import run

STEPS = "10,20,50,100,200,500,1000,2000,5000,10000"
SCALAR = "base,rsqrt,recmass,cse,reorder,sepwhile,double,float"
FIVE = "base,double,float,double_vec,float_vec"
SIZES = "1,2,4,8,16,32,64,256,1024,4096,16384,65536,262144"

# NAME.csv: its share of the budget in per cent, 0 for what is computed; the command, to which `-o
# NAME.csv` is added.
DATA = {
    "kernels": (0, "carom-lab kernels --csv"),
    "experiments": (0, "carom-lab experiments --csv"),
    "trace": (0, "carom-lab trace --id pooltool-135"),
    "verify": (0, "carom-lab verify --csv"),
    "growth-5000": (
        0,
        "carom-lab verify --kernel float --config default --steps 5000 --csv",
    ),
    "ladder": (20, "carom-lab bench --csv --spread --counters"),
    "steps": (17, f"carom-lab bench --kernel {FIVE} --steps {STEPS} --csv --spread"),
    "accuracy": (
        17,
        f"carom-lab bench --kernel exact,fast,euler,double,float --isa scalar,best --steps {STEPS},20000,50000 --csv --errors",
    ),
    "configs": (
        18,
        f"carom-lab bench --kernel {SCALAR},double_newton,double_vec,float_vec --config all --csv --spread --counters",
    ),
    "cycles": (
        11,
        f"carom-lab bench --kernel {FIVE} --config zen2 --steps {STEPS} --csv --spread --counters",
    ),
    "bounds": (0, "tools/python -m study.bounds"),
    "operations": (0, f"tools/python -m study.bounds --kernel {SCALAR} --steps 100"),
    "isas": (
        9,
        "carom-lab bench --kernel exact,fast --batch --threads 1 --pairs 4080 --csv --spread",
    ),
    "batch": (
        8,
        f"carom-lab bench --kernel exact --isa scalar,best --threads all --pairs {SIZES} --csv --spread",
    ),
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
