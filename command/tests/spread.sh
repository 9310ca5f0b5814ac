# What a player's error makes of a shot: numbers and bands beside 2,000 shots with such errors, what is told, what is refused.
error=1%,0.05,0.01,0.02
small=0.2%,0.01,0.002,0.004
bank="--table threecushion --cue 0.4,0.6 --aim 60 --ball-speed 2.5 --tip 0.3,0.2"
hit="--cue 0.6,0.8 --balls 0.75,1.6 --at-ball 1 --cut 40 --tip 0,0.1 --ball-speed 2.0"
hop="--table threecushion --cue 0.4,0.6 --aim 60 --speed 1.8 --tip 0,0 --elevation 30 --tip-time 0.0006 --tip-restitution 1"
echo "--- in words"
# shellcheck disable=SC2086
carom shoot $bank --spread $error --plot bank.svg
# shellcheck disable=SC2086
carom shoot $hit --spread $error --plot hit.svg
# shellcheck disable=SC2086
carom shoot $hop --spread $small
carom shoot $bank --json > bank.jsonl
carom shoot $hit --json > hit.jsonl
carom shoot $hop --json > hop.jsonl
echo "--- beside sampled shots"
python - << 'PYTHON'
import json
import os
import subprocess

import numpy as np

from drawn import band_widths

SD = {"V0": 0.01, "phi": 0.05, "a": 0.01, "b": 0.02}
random = np.random.default_rng(1)


def play(lines, *options):
    done = subprocess.run([os.environ["CAROM"], "shoot", "--events", "none", *options, "-"], input="".join(lines), text=True, stdout=subprocess.PIPE, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def places(shots, name):
    return np.array([shot["final"]["balls"][name][1:3] for shot in shots])


lines = {}
for name, scale in (("bank", 1.0), ("hit", 1.0), ("hop", 0.2)):
    shot = json.loads(open(f"{name}.jsonl", encoding="utf-8").read())
    lines[name] = []
    for _ in range(2000):
        cue = dict(shot["cue"])
        for key, x in zip(SD, random.normal(size=4)):
            cue[key] += scale * x * SD[key] * (cue["V0"] if key == "V0" else 1.0)
        lines[name].append(json.dumps({**shot, "cue": cue}) + "\n")
    # standard deviations along both axes of the ellipses at the end, as sampled over as told
    for models in ([], ["--cushion", "mathavan"]):
        middle = play([json.dumps(shot) + "\n"], "--spread", ",".join(f"{scale * x:g}" for x in (1.0, 0.05, 0.01, 0.02)), *models)[0]
        sampled = play(lines[name], *models)
        for ball, (xx, xy, yy) in middle["spread"]["covariance"].items():
            values, axes = np.linalg.eigh([[xx, xy], [xy, yy]])
            seen, told = np.sqrt(np.diag(axes.T @ np.cov(places(sampled, ball).T) @ axes)), np.sqrt(values)
            # across a long ellipse the bend of what is sampled counts too
            good = (abs(seen - told) < 0.08 * told + 0.03 * told.max()).all()
            print(name, *models, ball, "ends as sampled" if good else f"ends otherwise: {seen}, not {told}")
# the bands across the paths at some times, not so soon after a contact that some shots are before it
for name, ball, time in (("bank", "cue", 0.3), ("bank", "cue", 0.9), ("bank", "cue", 1.7), ("bank", "cue", 3.1), ("hit", "cue", 0.3), ("hit", "cue", 0.9),
                         ("hit", "1", 0.8), ("hit", "1", 1.1), ("hit", "1", 2.5)):
    shot = json.loads(open(f"{name}.jsonl", encoding="utf-8").read())
    state = play([json.dumps(shot) + "\n"], "--time-most", str(time))[0]["final"]["balls"][ball]
    r, v = np.array(state[1:3]), np.array(state[4:6])
    n = np.array([-v[1], v[0]]) / np.hypot(*v)
    across = np.std((places(play(lines[name], "--time-most", str(time)), ball) - r) @ n)
    widths = band_widths(f"{name}.svg", shot, ball, r, n)
    good = len(widths) == 2 and np.allclose(widths, across, rtol=0.06, atol=3e-4)
    print(f"{name} {ball} after {time} s:", "the band is as sampled" if good else f"{widths}, not {across}")
PYTHON
echo "--- beyond reach, and beyond 0.3 m"
carom shoot --table threecushion --cue 0.3,0.5 --balls 0.9,2.3:1.1,0.4 --aim 60 --ball-speed 4 --tip 0.4,0.2 --spread 1%,0.05,0.01 --plot far.svg --animate far.html
grep -c 'class="band"' far.html
for file in bank.svg far.svg; do
  echo "$file: $(grep -c '<path class="band"' $file) bands, $(grep -c 'class="band".*dasharray' $file) dashed, $(grep -c '<ellipse' $file) ends"
done
carom shoot --table threecushion --cue 0.3,0.5 --balls 0.9,2.3:1.1,0.4 --aim 60 --ball-speed 4 --tip 0.4,0.2 --json > far.jsonl
carom shoot --events none --spread 1%,0.05,0.01 -o far.out far.jsonl
python - << 'PYTHON'
# Before `until` no standard deviation is beyond reach, and from then on one is.
import json
import os
import subprocess

whole = json.loads(open("far.out", encoding="utf-8").read())["spread"]
for later in (-1e-9, 1e-9):
    words = [os.environ["CAROM"], "shoot", "--events", "none", "--spread", "1%,0.05,0.01", "--time-most", repr(whole["until"] + later), "far.jsonl"]
    part = json.loads(subprocess.run(words, text=True, stdout=subprocess.PIPE, check=True).stdout)["spread"]
    print("within" if part["until"] is None else part["until"] == whole["until"], part["together"] < 1)
PYTHON
echo "--- a file"
carom shoot --spread 1%,0.05,0.01 --events none --plot file.svg bank.jsonl | grep -o '"spread".*' | sed 's/\(\.[0-9]\{5\}\)[0-9]*/\1/g'
grep -c '<path class="band"' file.svg
grep -o '>spread.*<' file.svg
echo "--- units: a tip is 13 mm wide, also in radii of its ball"
carom shoot --spread 0%,0,0.5tip,0 --events none bank.jsonl | grep -o '"error": {[^}]*}'
carom shoot --spread 2,0.1deg,0.02R --events none hit.jsonl | grep -o '"error": {[^}]*}'
echo "--- what is refused"
for wrong in "" 1% 1%,0.05 1%,0.05,0.01,0.01,0.01 -1%,0.05,0.01 1%,x,0.01 1m/s,0.05,0.01 1%,0.05,1kg 0,0,0 nan,0,0; do
  try carom shoot --spread "$wrong" bank.jsonl
done
try carom shoot --spread 1%,0.05,0.01 --world pooltool -o refused.out bank.jsonl
try carom shoot --spread 1%,0.05,0.01 --ball-model euler -o refused.out bank.jsonl
ls refused.out 2> /dev/null || echo "nothing written"
echo "--- a shot that is stopped by an error has no spread"
try carom shoot --ball-speed 2 --tip 0,0 --spread 1%,0.05,0.01 --events-most 3 --plot stopped.svg
grep 'class="band"' stopped.svg || echo "no band"
try carom shoot --events none --spread 1%,0.05,0.01 --events-most 3 -o two.out bank.jsonl
grep -o '"spread": null.*' two.out
