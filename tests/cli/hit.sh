# hit: one collision from speed, cut and spin, in words, as a row, as a picture; and what textbooks say of such collisions.
try carom hit
try carom hit --spin draw,20 --cut -40 --side gearing --speed 3 --friction 0.05
try carom hit --cut 0 --spin stun --restitution 1 --friction 0
echo "the row is what resolve reads:"
carom hit --spin stun,follow,roll,draw,-7.5 --csv > rows.csv
carom resolve --derived rows.csv > out.csv
python - <<'PYTHON'
import csv
rows = {row["id"]: row for row in csv.DictReader(open("out.csv"))}
print(list(rows), {row["status"] for row in rows.values()})
rows["follow"].pop("id"), rows["roll"].pop("id")
print(rows["follow"] == rows["roll"])
print(f"{-float(rows['stun']['throw_deg']):.2f} {-float(rows['stun']['deflection_deg']):.2f} {100 * float(rows['stun']['energy_lost']):.2f}")
PYTHON
try carom hit --csv --spin draw -o row.csv --plot row.svg
python - <<'PYTHON'
import xml.etree.ElementTree as tree
page = tree.parse("row.svg").getroot()
texts = [e.text for e in page.iter("{http://www.w3.org/2000/svg}text")]
circles, paths = ([e for e in page.iter("{http://www.w3.org/2000/svg}" + name)] for name in ("circle", "path"))
print(len(circles), "circles", len(paths), "paths", "tangent line" in texts, any(t.startswith("cue ball") for t in texts))
curve = next(p.get("d") for p in paths if p.get("stroke-width") == "4")
points = [tuple(map(float, p.split())) for p in curve[1:].split("L")]
(x0, y0), (x1, y1), (x2, y2) = points[0], points[1], points[-1]
# a draw shot bends back: the last of the path lies to the left of its first direction's end
print("bends back:", (x1 - x0) > 0 and (x2 - x0) / abs(y2 - y0) < (x1 - x0) / abs(y1 - y0))
PYTHON
echo "textbooks:"
cat > textbooks.py <<'PYTHON'
import csv, math, os, subprocess
carom, rad = os.environ["CAROM"], math.radians
R = 0.028575
def hit(*words):
    row = subprocess.run([carom, "hit", "--csv", *map(str, words)], capture_output=True, text=True, check=True).stdout
    out = subprocess.run([carom, "resolve", "--derived", "-"], input=row, capture_output=True, text=True, check=True).stdout
    return {name: float(x) for name, x in next(csv.DictReader(out.splitlines())).items() if name not in ("id", "status")}
# Throw by D. Alciatore, TP A-14: friction by the speed of the slip, and at most what ends it. The cloth has no part in it. It lets
# friction lift the balls, which the model here keeps on the table: without follow both say the same, with it nearly.
def throw(v, cut, follow, side):
    x, z, n = v * math.sin(cut) - R * side, R * follow * math.cos(cut), v * math.cos(cut)
    slip = math.hypot(x, z)
    mu = 0.009951 + 0.108 * math.exp(-1.088 * slip)
    return math.degrees(math.atan(min(mu * n / slip, 1 / 7) * x / n))
worst = {False: 0, True: 0}
for v in (0.447, 1.34, 3.13, 6.7): # 1 to 15 miles an hour
    for cut in (5, 15, 30, 45, 60, 75):
        for follow in (0, v / R, -v / R, 0.4 * v / R):
            for side in (0, 0.25 * v / R, -0.5 * v / R):
                if (cut + follow + side) % 3 < 1.5: # some half of them
                    continue
                seen = -hit("--speed", v, "--cut", cut, "--spin", follow, "--side", side, "--restitution", 1, "--cloth", 0)["throw_deg"]
                worst[follow != 0] = max(worst[follow != 0], abs(seen - throw(v, rad(cut), follow, side)))
print("TP A-14:", worst[False] < 1e-5, worst[True] < 0.15)
smooth = ("--friction", 0, "--restitution", 1)
# The 90-degree rule: after stun the balls part at right angles. The 30-degree rule: a rolling cue ball, hitting between a quarter
# and three quarters of a ball, goes off by some 30 degrees, 33.7 at a half-ball hit.
print("90 degrees:", all(abs(-hit("--cut", cut, *smooth)["deflection_deg"] - (90 - cut)) < 1e-4 for cut in (10, 30, 60)))
for share in (0.25, 0.5, 0.75):
    cut = math.asin(1 - share)
    seen = -hit("--cut", math.degrees(cut), "--spin", "roll", *smooth)["deflection_rolling_deg"]
    known = math.degrees(math.atan2(math.sin(cut) * math.cos(cut), math.sin(cut) ** 2 + 0.4))
    print(f"{share} of a ball: {seen:.1f} degrees", abs(seen - known) < 1e-4)
# Gearing: outside english that lets the balls roll on each other throws nothing and transfers nothing.
gearing = [hit("--cut", cut, "--side", "gearing") for cut in (10, 30, 50)]
print("gearing:", all(abs(g["throw_deg"]) < 1e-6 and abs(g["spin_transfer"]) < 1e-6 for g in gearing))
# A ball hit full that does not spin takes (1 + e) / 2 of the speed.
print("full hit:", abs(hit("--cut", 0, "--restitution", 0.9, "--speed", 1)["v2x"] - 0.95) < 1e-6)
PYTHON
python textbooks.py
echo "a picture of several curves:"
carom hit --spin stun,follow,draw --cut 0 --csv > three.csv
try carom sweep --id stun,follow,draw --over cut --from 0 --to 80 --friction alciatore --plot throw.svg - < three.csv
grep -o '>\(stun\|follow\|draw\)<' throw.svg
try carom sweep --id draw,stun --over cut --from 0 --to 80 --points 3 --brief --friction alciatore three.csv > swept.csv
grep -v '^#' swept.csv | cut -d, -f1,2,6,8
try carom sweep --id stun,lag --over cut --from 0 --to 80 three.csv
echo "several speeds, and each spin at each speed:"
carom hit --spin stun,draw --speed 1,2,4.5 --cut 0 --csv > six.csv
cut -d, -f1,5,9 six.csv
carom sweep --id stun-1,stun-2,stun-4.5,draw-1,draw-2,draw-4.5 --over cut --from 0 --to 80 --points 361 --friction alciatore --plot six.svg -o six.out six.csv
python - <<'PYTHON'
import csv, os, subprocess
from curves import curves, shows
rows = {}
for row in csv.DictReader(line for line in open("six.out") if not line.startswith("#")):
    rows.setdefault(row["id"], []).append((float(row["value"]), float(row["throw_deg"])))
drawn = curves("six.svg")
print([name for name, _ in drawn] == list(rows), [shows(points, *zip(*rows[name])) for name, points in drawn])
# One by one the same.
for spin, speed in (("stun", "2"), ("draw", "4.5")):
    one = subprocess.run([os.environ["CAROM"], "hit", "--spin", spin, "--speed", speed, "--cut", "0", "--csv"], capture_output=True, text=True).stdout
    rows = {line.split(",")[0]: line.split(",", 1)[1] for line in open("six.csv")}
    print(rows[f"{spin}-{speed}"] == one.splitlines(True)[1].split(",", 1)[1])
PYTHON
echo "refused:"
for words in "--speed 1,,x" "--speed ," "--speed 1,2,3,4 --spin 1,2,3,4,5" "--spin spinny" "--spin nan" "--spin ,"  "--side much" "--cut 90" "--speed 0" "--speed -1" "--radius 0" "--cloth 2" "--friction 2" "--restitution -1" "--plot hit.png" "extra" "--strict --speed 60"; do
  # shellcheck disable=SC2086
  try carom hit -o refused.txt $words
done
ls refused.txt 2> /dev/null || echo "nothing written"
try carom resolve --derived -o out.npy rows.csv
echo "numbers too large for words:"
try carom hit --speed 1e300 2> /dev/null
