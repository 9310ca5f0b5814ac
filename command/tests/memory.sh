# Memory is refused, at each allocation of a run in turn: that one and all that follow, or that one alone. Each time there is a message and the
# code of an error, and no output, whole or in part, that a run without an error would have made; nothing is left beside it.
python - << 'PYTHON'
import os, subprocess, sys
from pathlib import Path

data = Path(os.environ["DATA"])
library = Path(os.environ["CAROM"]).parent / "command/tests/refuse.so"
# The allocator of a sanitizer cannot be replaced, so such a build lacks the library.
cache = (library.parents[2] / "CMakeCache.txt").read_text()
if "CAROM_SANITIZE:BOOL=OFF\n" not in cache:
    print("runs of each command: told of every refusal")
    sys.exit()
Path("five.csv").write_text("".join(open(data / "collisions-204.csv").readlines()[:6]))
Path("shot.jsonl").write_text(open(data / "shots-layouts.jsonl").readline())
Path("ball.jsonl").write_text('{"kind": "shot", "cue": {"V0": 1, "b": 0}, "balls": [{"id": "1", "state": [0, 0.3, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}]}\n')
runs = [
    "resolve -o out.csv five.csv",
    "resolve --threads 2 -o out.npy five.csv",
    "shoot -o out.jsonl shot.jsonl",
    "shoot --spread 1%,0.05,0.01 --events none --plot out.svg -o out.jsonl ball.jsonl",
    "shoot --speed 1 --spread 1%,0.05,0.01 --plot out.svg",
    "hit --speed 2m/s --cut 30 --plot out.svg",
    "rail --speed 2m/s --angle 30",
    "hit --cut 0:60 -o out.csv",
]
inputs = {"five.csv", "shot.jsonl", "ball.jsonl"}
for run in runs:
    for one in ("", "1"):
        refused = 0
        while True:
            environment = {**os.environ, "LD_PRELOAD": str(library), "CAROM_REFUSE": str(refused + 1), "CAROM_REFUSE_ONE": one}
            end = subprocess.run([os.environ["CAROM"], *run.split()], env=environment, capture_output=True, text=True)
            left = set(os.listdir()) - inputs
            if end.returncode == 0:  # it needs no more, or went on without
                if "refused" not in end.stderr:
                    break
            elif end.returncode not in (1, 2) or "\ncarom: " not in "\n" + end.stderr or (left and end.returncode == 2):
                print(f"{run}: refused {refused + 1}{' alone' if one else ''}: exit {end.returncode}, {left or 'no file'}: {end.stderr}")
                break
            for name in left:
                os.remove(name)
            refused += 1
        for name in set(os.listdir()) - inputs:
            os.remove(name)
        if refused == 0 and "-o" in run:
            print(f"{run}: nothing was refused")
print("runs of each command: told of every refusal")
PYTHON
