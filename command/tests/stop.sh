# --stop: the speed with which a ball rests at a position, or after a distance. A shot at that speed rests there.
cat > stop.py << 'PYTHON'
import csv, io, math, os, re, subprocess

carom = os.environ["CAROM"]

def shoot(*words):
    return subprocess.run([carom, "shoot", *words], capture_output=True, text=True, check=True).stdout

def rest(ball, *words):
    rows = csv.DictReader(io.StringIO(shoot(*words, "--csv")))
    return next((float(row["x_m"]), float(row["y_m"])) for row in rows if row["ball"] == ball and row["what"] == "rests")

cue = ("--cue", "0.6,0.8")
for ball, place, target, words in (
    ("cue", (0.6, 1.5), "0.6,1.5", (*cue, "--to", "0.6,2.2")),
    ("cue", (0.6, 0.3), "0.6,0.3,20cm", (*cue, "--to", "0.6,2.2", "--tip", "low")),
    ("1", (0.6, 1.9), "1=0.6,1.9", (*cue, "--balls", "0.6,1.2", "--at-ball", "1")),
):
    said = shoot(*words, "--stop", target)
    low, high = map(float, re.search(r"with ([\d.]+) to ([\d.]+) m/s", said).groups())
    radius = float(re.search(r"within ([\d.]+) m of it", said)[1])
    line = shoot(*words, "--stop", target, "--json")
    speed = float(re.search(r'"V0": ([\d.]+)', line)[1])
    away = math.dist(rest(ball, *words, "--speed", repr(speed)), place)
    edges = [math.dist(rest(ball, *words, "--speed", str(edge)), place) for edge in (low, high)]
    print(target, away < 1e-3, low < speed < high, [abs(edge - radius) < 2e-3 for edge in edges])
# The length of a path: along a straight line it is the distance between its ends.
speed = float(re.search(r'"V0": ([\d.]+)', shoot(*cue, "--to", "0.6,2.2", "--stop", "1.25m", "--json"))[1])
print("distance:", round(rest("cue", *cue, "--to", "0.6,2.2", "--speed", repr(speed))[1] - 0.8, 3))
PYTHON
python stop.py
carom shoot --cue 0.6,0.8 --to 0.6,2.2 --stop 3m | tail -n 2
echo "--- nowhere near, and refused"
carom shoot --cue 0.6,0.8 --balls 0.8,1.9 --pocket 1:foot-right --stop 1.1,0.2,1cm | tail -n 2
try_rows "stop, refused"
