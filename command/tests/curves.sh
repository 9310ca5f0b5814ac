# hit and rail over lists and ranges: questions of players and students, a line each, beside what is published.
export CAROM_ISA=plain # for digits that are the same everywhere
cat > questions.py << 'PYTHON'
import csv, math, os, subprocess
from curves import curves, shows
carom, R = os.environ["CAROM"], 0.028575

def run(*words):
    return subprocess.run([carom, *map(str, words)], capture_output=True, text=True, check=True).stdout

def table(*words):
    return list(csv.reader(run(*words, "--csv").splitlines()))[1:]

def numbers(*words):
    return [[float(x) for x in row] for row in table(*words)]

# D. Alciatore, TP A-14, for stun: friction by the speed of the slip, and at most what ends it (e = 1).
def throw(v, cut, side=0.0):
    slip = abs(v * math.sin(math.radians(cut)) - R * side)
    mu = 0.009951 + 0.108 * math.exp(-1.088 * slip)
    n = v * math.cos(math.radians(cut))
    return math.degrees(math.atan(min(mu, slip / n / 7)))

mph = 0.44704
seen = numbers("hit", "--cut", "half", "--speed", "1,3,7mph", "--quantity", "throw", "--csv", "--restitution", 1)
print("throw at half ball, 1, 3, 7 mph:", *(f"{x:.2f}" for _, x in seen), all(abs(x - throw(v * mph, 30)) < 0.01 for v, x in seen))
seen = numbers("hit", "--cut", "0:80:1", "--speed", "3mph", "--quantity", "throw", "--restitution", 1)
most = max(seen, key=lambda point: point[1])
print(f"most throw at 3 mph: {most[1]:.2f} at {most[0]:.0f} degrees", all(abs(x - throw(3 * mph, cut)) < 0.01 for cut, x in seen))
seen = numbers("hit", "--cut", "full", "--speed", "3mph", "--side", "10,25,50,100%", "--quantity", "throw", "--csv", "--restitution", 1)
print("throw by spin, 10, 25, 50, 100 %:", *(f"{x:.2f}" for _, x in seen), all(abs(x - throw(3 * mph, 0, -0.0125 * side * 3 * mph / R)) < 0.01 for side, x in seen))
# TP A-4: the curve of the 30-degree rule.
smooth = ("--friction", 0, "--restitution", 1)
rule = lambda cut: math.degrees(math.atan2(math.sin(cut) * math.cos(cut), math.sin(cut) ** 2 + 0.4))
seen = numbers("hit", "--cut", "1:0.1ball", "--spin", "roll", "--quantity", "rolling-deflection", *smooth)
print(len(seen), "points of its curve:", all(abs(x - rule(math.asin(1 - part))) < 1e-3 for part, x in seen if part < 0.999))
[[known]] = numbers("hit", "--cut", "half", "--quantity", "angle-between", "--csv", *smooth)
print(f"after stun: {known:.1f} degrees")
# Off a cushion: left and right are mirrors; running english lengthens, reverse shortens.
angles = numbers("rail", "--angle", "30,45", "--side", "-50,0,50%", "--friction", 0.3, "--quantity", "rolling-rebound", "--csv")
mirrored = numbers("rail", "--angle", "-30,-45", "--side", "50,0,-50%", "--friction", 0.3, "--quantity", "rolling-rebound", "--csv")
print("mirrored:", all(a[-1] == -b[-1] for a, b in zip(angles, mirrored)))
print("reverse, none, running:", *("{:.1f}".format(x) for *_, x in angles))
# Units: the same said otherwise.
same = lambda a, b: run("hit", "--csv", *a.split()).splitlines()[1].split(",")[1:] == run("hit", "--csv", *b.split()).splitlines()[1].split(",")[1:]
print("units:", same("--cut half", "--cut 30°"), same("--radius 28.575mm", "--radius 0.028575"), same("--side 50%", "--side 32.808398950131235rad/s"),
      same("--spin 100%", "--spin roll"), same("--mass 170g", "--mass 0.17"), same("--speed 3.6km/h", "--speed 1"), same("--side 1tip", f"--side {2.5 * 0.013 / R ** 2 * 1.5}rad/s"))
# Rows are what resolve reads, and say what the table says; curves show it.
rows = run("hit", "--cut", "0:60:20", "--spin", "stun,draw", "--csv")
open("rows.csv", "w").write(rows)
derived = list(csv.DictReader(run("resolve", "--derived", "rows.csv").splitlines()))
said = table("hit", "--cut", "0:60:20", "--spin", "stun,draw", "--quantity", "throw")
print(len(derived), all(abs(float(a["throw_deg"]) + float(b[-1])) < 1e-9 for a, b in zip(derived, said)))
impacts = run("rail", "--angle", "10:60:10", "--side", "-50,50%", "--csv")
open("impacts.csv", "w").write(impacts)
derived = list(csv.DictReader(run("resolve", "--cushion", "--model", "han", "--derived", "impacts.csv").splitlines()))
said = table("rail", "--angle", "10:60:10", "--side", "-50,50%", "--quantity", "rebound")
print(len(derived), all(abs(float(a["angle_out_deg"]) + float(b[-1])) < 1e-9 for a, b in zip(derived, said)))
run("hit", "--cut", "0:80", "--speed", "1,3,7mph", "--plot", "throw.svg")
points = numbers("hit", "--cut", "0:80", "--speed", "1,3,7mph", "--quantity", "throw")
drawn = curves("throw.svg")
print([name for name, _ in drawn], [shows(shown, *zip(*[(cut, y) for speed, cut, y in points if f"speed {speed:g} mph" == name])) for name, shown in drawn])
run("hit", "--spin", "0:100%:50%", "--quantity", "throw", "--plot", "spin.svg")
print(len(curves("spin.svg")), "curve over spin")
PYTHON
python questions.py
echo "in words:"
try carom rail
try carom rail --angle 20 --side -50% --spin draw --model stronge
echo "a table of all:"
carom rail --angle 0:60:30 --side 0,50%
carom hit --cut half --side 0:50:25% | cut -d, -f1-3
echo "pictures:"
for end in svg png pdf; do
  try carom hit --cut 0:80 --plot curve.$end
  command -v rsvg-convert > /dev/null || [ $end = svg ] || {
    echo "exit 0"
    continue
  }
  try carom rail --plot rail.$end -o /dev/null
done
head -c 4 curve.pdf
echo
grep -c "at once\|normal<" rail.svg
echo "refused:"
for words in "--angle 90" "--angle 0:95" "--side 0.5" "--spin quick" "--restitution 2" "--height 0" "--quantity throw" "--speed 1:2 --angle 0:10"; do
  # shellcheck disable=SC2086
  try carom rail -o refused.txt $words
done
ls refused.txt 2> /dev/null || echo "nothing written"
