"""What the report is made of: its data in the order in which they are obtained, and its figures.

Measured  a command that writes NAME.csv; the report adds `-o`, and `--budget` with its share (in per cent) of the report's
          budget unless the share is 0, and its own `--data` if the command works `on_data`. {solvers} stands for all of the
          library's kernels, as kernels.csv names them.
Derived   made by that function of derive.py from those above
Drawn     a picture that a command draws by itself
Figure    drawn from a CSV by `gnuplot -c SCRIPT DATA.csv PICTURE TITLE`; `number` is that of the figure in the seed paper, or of
          the section it belongs to, `needs` the columns without whose numbers there is nothing to draw
"""

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FIGURES = ROOT / "lab" / "figures"
FIGURES_OF_CAROM = ROOT / "cli" / "figures"  # which `carom trace --plot` draws too


@dataclass(frozen=True)
class Measured:
    name: str
    share: int
    command: str
    on_data: bool = True


@dataclass(frozen=True)
class Derived:
    name: str


@dataclass(frozen=True)
class Drawn:
    name: str
    command: str
    title: str
    sentence: str
    number: str = ""


@dataclass(frozen=True)
class Figure:
    name: str
    csv: str
    needs: tuple
    title: str
    sentence: str
    number: str = ""
    folder: Path = FIGURES

    @property
    def script(self):
        return self.folder / f"{self.name}.gp"


STEPS = "10,20,50,100,200,500,1000,2000,5000,10000"
FIVE = "base,double,float,double_vec,float_vec"
TURNING = "--id pooltool-135 --over w1z --from -60 --to 60 --solver exact,euler"

DATA = [
    Measured("kernels", 0, "carom-lab kernels --csv", on_data=False),
    Measured("experiments", 0, "carom-lab experiments --csv"),
    Measured("trace", 0, "carom trace --id pooltool-135 --solver exact,euler"),
    Measured("sweep", 0, f"carom sweep {TURNING} --brief"),
    Measured("verify", 0, "carom-lab verify --csv"),
    Measured("ladder", 20, "carom-lab bench --csv --spread"),
    Measured("steps", 17, f"carom-lab bench --kernel {FIVE} --steps {STEPS} --csv --spread"),
    Measured(
        "accuracy",
        17,
        f"carom-lab bench --kernel {{solvers}},double,float --isa scalar,best --steps {STEPS},20000,50000 --csv --errors",
    ),
    Measured("configs", 18, "carom-lab bench --config all --csv --spread"),
    Measured("cycles", 11, f"carom-lab bench --kernel {FIVE} --config zen2 --steps {STEPS} --csv --spread --counters"),
    Measured("isas", 9, "carom-lab bench --batch --threads 1 --pairs 4080 --csv --spread"),
    Measured(
        "batch",
        8,
        "carom-lab bench --kernel exact --isa scalar,best --threads all "
        "--pairs 1,2,4,8,16,32,64,256,1024,4096,16384,65536,262144 --csv --spread",
    ),
    Measured("bounds", 0, "lab.bound"),
    Derived("speedup"),
    Derived("performance"),
]

BREAK = Drawn(
    "break",
    "carom shoot --plot {picture} -o /dev/null data/break-nineball.jsonl",
    "A nine-ball break",
    "Every ball's path, from the break until all balls are at rest, computed from the positions in data/break-nineball.jsonl.",
)

FIGURES_OF_THE_PAGE = [
    Figure(
        "accuracy",
        "accuracy",
        ("steps", "ns_median", "error_exact_max", "error_exact_median"),
        "Error against time",
        "The time of a collision, and its largest error over the 204 cases against the exact solution, N → ∞. A dotted line drops from "
        "the largest error to the median; the digits at batches are numbers of threads. "
        "Towards the lower left is better. Euler's error falls as 1/N and its time grows as N; single precision buys "
        "time at the same error until its rounding, or the step that it can no longer resolve, ends it. The exact solver takes no "
        "steps: it is a point for single calls, and for batches one for each number of threads.",
    ),
    Figure(
        "speedup",
        "speedup",
        ("speedup", "paper"),
        "Cumulative speedup of the scalar kernels",
        "Each kernel is the one to its left with one more idea. The paper gives no number for cse and sepwhile, only that they "
        "gain a little.",
        number="figure 3",
    ),
    Figure(
        "runtime",
        "steps",
        ("steps", "ns_median"),
        "Run time over the number of steps",
        "Time grows in proportion to N, as it does in the paper: every step does the same work on the same few numbers, all of it "
        "in registers and the first cache. The second half divides by N, so that the kernels come apart: what is left at small N is "
        "the cost of everything around the loop.",
        number="figure 2",
    ),
    Figure(
        "configs",
        "configs",
        ("speedup",),
        "Compilers and configurations",
        "Speedup over base in the first configuration, for every kernel in every build; framed is the best of all. zen2 is not among the "
        "paper's configurations: it is the default for the paper's processor by name, the code whose operations are counted.",
        number="section 4.4",
    ),
    Figure(
        "performance",
        "performance",
        ("steps", "flops_per_cycle"),
        "Floating point operations per cycle",
        "Operations are counted exactly, as AMD's counter counts them (a fused multiply-add is two), by running the same code for "
        "Zen 2 under callgrind. The dashed lines are the bounds: the operations of a step over the length of its longest chain of "
        "dependent operations, in a collision where friction acts in every step; where it rests in some, as in a few of the cases, a "
        "kernel can come out a little above. Kernels do different amounts of work, so a higher line is not a faster kernel.",
        number="figure 4",
    ),
    Figure(
        "experiments",
        "experiments",
        ("v_cue", "v_object", "angle_cue_deg", "angle_object_deg"),
        "The 2014 paper's experiments",
        "Five shots of Mathavan, Jackson and Parkin, a rolling cue ball on a resting ball: speeds and angles once both balls roll, as "
        "measured, as the paper predicts them, and as computed here. What separates prediction and measurement is the model, or "
        "the camera; what separates the solvers and the prediction is not to be seen. The measured angle of the object ball is the "
        "cut angle itself, and so no check.",
    ),
    Figure(
        "trace",
        "trace",
        ("impulse_N_s", "work_J", "u_x_m_s", "u_z_m_s", "d_x_m_s", "d_y_m_s", "b_x_m_s", "b_y_m_s")
        + ("v1_x_m_s", "v1_y_m_s", "v2_x_m_s", "v2_y_m_s"),
        "One collision on its way",
        "A rolling carom ball meets another: slips, velocities and work over the normal impulse. Friction brings the slip between the "
        "balls to an end; from there on they stick to each other, and as nothing presses either into the cloth any more, that rubs no "
        "longer. Euler's method follows the same way.",
        folder=FIGURES_OF_CAROM,
    ),
    Figure(
        "smooth",
        "sweep",
        ("value", "throw_deg", "jump"),
        "A fine sweep of the side spin",
        "The same collision with 10,001 values of the first ball's side spin. Where the balls come to stick, Euler's method goes on with "
        "a friction that changes its sign from step to step, and where it ends is a matter of chance; elsewhere it jumps wherever it "
        "takes a step more or less. The exact solution leaves a smooth curve by less than a millionth of the largest speed.",
    ),
    Figure(
        "isas",
        "isas",
        ("steps", "ns_median", "speedup", "pairs"),
        "Batches by instruction set and precision",
        "Every solver in lanes, one collision in each, one thread. Speedup is over base, one call each, at N = 1000. A step of Euler's "
        "method in double precision has the same bits in all of them. The numbers in grey are nanoseconds for a collision.",
    ),
    Figure(
        "batch",
        "batch",
        ("threads", "steps", "ns_median", "pairs"),
        "Throughput of the exact solver over batch size and threads",
        "First: collisions per second over the number of pairs in a call; dashed, as many single calls. A few pairs leave lanes empty. "
        "Threads are started only where each has some thousand pairs, so their curve leaves that of one thread there. Second: the largest "
        "batch that is at least 65,536 pairs over the number of threads, with the gain over one; dotted is a gain of as many.",
    ),
    Figure(
        "floor",
        "batch",
        ("threads", "ns_median", "pairs"),
        "How near the floor",
        "The time of a pair in batches of the exact solver, one thread, over the bytes that a batch reads and writes, and below it the "
        "time of a copy that moves the same bytes and computes nothing: no solver can be faster. Dashed lines are the sizes of the "
        "caches. Where the band between them, shaded for double precision, is narrow, memory is the limit; where it is wide, "
        "arithmetic is.",
    ),
]
