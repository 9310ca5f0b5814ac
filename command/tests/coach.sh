# The words of players: speeds, parts of a ball, english, spots of snooker; the stroke that leaves the cue ball at a place.
cat > words.py << 'PYTHON'
import csv, io, json, math, os, re, subprocess
carom = os.environ["CAROM"]

def run(*words):
    return subprocess.run([carom, *map(str, words)], capture_output=True, text=True, check=True).stdout

def table(*words):
    return list(csv.reader(io.StringIO(run(*words, "--csv"))))[1:]

# A word of speed is that of the ball, by whatever tip; of a range, too.
speeds = {}
for word in "soft slow medium fast power break".split():
    for tip in ("0,0", "0.3,-0.2"):
        [said] = re.findall(r"cue ball at ([\d.]+) m/s", run("shoot", "--speed", word, "--tip", tip))
        assert speeds.setdefault(word, said) == said, (word, tip)
    # The page of the ranges has m/s of mph: soft to 1, slow to 2, medium to 4, fast to 7, power to 10, a break from 25 to 30.
print({word: round(float(speed) / 0.44704, 2) for word, speed in speeds.items()})
told = dict(re.findall(r"(soft|slow|medium|fast|power|break) ([\d.]+)", re.sub(r"\s+", " ", run("shoot", "--help"))))
assert all(abs(float(told[word]) - float(speeds[word])) < 0.051 for word in speeds), (told, speeds)
[first, *_, last] = [row for row in table("shoot", "--speed", "slow:fast:0.5") if row[3] == "leaves"]
print("range:", first[8][:7], last[8][:7])
throw = lambda words: float(table("hit", "--spin", "stun", "--quantity", "throw", *words)[0][0])
same = lambda *pairs: all(abs(throw(a) - throw(b)) < 1e-12 for a, b in pairs)
print("parts of a ball:", same((["--cut", "1/4ball"], ["--cut", "quarter"]), (["--cut", "half-ball"], ["--cut", "half"]), (["--cut", "thin"], ["--cut", "1/8ball"]), (["--cut", "1/2ball"], ["--cut", "30"])))
print("english:", same((["--cut", "30", "--side", "outside"], ["--cut", "30", "--side", "right"]), (["--cut", "-30", "--side", "outside"], ["--cut", "-30", "--side", "left"]), (["--cut", "-30", "--side", "inside"], ["--cut", "-30", "--side", "right"])))
rail = lambda angle, side: float(table("rail", "--model", "mathavan", "--angle", angle, "--side", side, "--quantity", "rebound")[0][0])
print("at a rail:", rail(50, "running") == rail(50, "right") == -rail(-50, "running"), rail(50, "reverse") == rail(50, "left") < rail(50, "none") < rail(50, "running"))
# What the line of english says is the difference of two impacts.
for model in ("han", "mathavan"):
    for angle, side in ((60, "reverse"), (-60, "reverse"), (30, "running"), (45, "20%")):
        once, longer, rolling, more = re.search(r"by english:  ([\d.]+) degrees (\w+) than without it at once, ([\d.]+) (\w+) once rolling", run("rail", "--model", model, "--angle", angle, "--side", side)).groups()
        for name, size, way in (("rebound", once, longer), ("rolling-rebound", rolling, more)):
            at = lambda side: abs(float(table("rail", "--model", model, "--angle", angle, "--side", side, "--quantity", name)[0][0]))
            assert abs(at(side) - at("none") - float(size) * (1 if way == "longer" else -1)) < 0.006, (model, angle, side, name)
# The spots are those of the rack, and name their balls.
rack = json.loads(run("shoot", "--table", "snooker", "--balls", "snooker", "--json"))["balls"]
own = json.loads(run("shoot", "--table", "snooker", "--cue", "0.3,0.3", "--balls", "yellow:green:brown:blue:pink:black:red7=1,1", "--json"))["balls"]
spots = {ball["id"]: ball["state"][1:3] for ball in rack}
assert all(math.dist(ball["state"][1:3], spots[ball["id"]]) < 1e-12 for ball in own[1:7])
print([ball["id"] for ball in own])

# The stroke of --leave: without errors all or none end there, the pot falls, and the range of speeds is as wide as is told.
layout = ("--cue", "0.6,0.8", "--balls", "0.3,1.9")
for way in (("--pocket", "1:foot-left"), ("--at-ball", "1", "--cut", "half"), ("--to", "4d,6d")):
    place, R = {"--pocket": ((0.635, 1.27), 0.2), "--at-ball": ((1.02, 0.1), 0.3), "--to": ((0.635, 1.27), 0.3)}[way[0]]
    asked = ("shoot", *layout[: 4 if way[0] != "--to" else 2], *way, "--leave", f"{place[0]},{place[1]},{R}", "--errors", "0")
    words = run(*asked)
    [(share, low, high)] = re.findall(r"m: ([\d.]+) % of.*\n.* from ([\d.]+) to ([\d.]+) m/s", words)
    shot = json.loads(run(*asked, "--json"))
    cue = shot["cue"]
    ends = lambda speed: [row for row in table("shoot", *layout[: 4 if way[0] != "--to" else 2], *way, "--tip", f"{-cue['a']},{cue['b']}", "--speed", speed)]
    there = lambda speed: [math.dist((float(row[6]), float(row[7])), place) < R for row in ends(speed) if row[2:4] == ["cue", "rests"]] == [True]
    assert share == "100.0" and float(low) <= cue["V0"] <= float(high)
    assert there(low) and there(high) and not there(float(low) - 0.1) and not there(float(high) + 0.1), (way, low, high)
    print(way[0], "falls into" in words)

PYTHON
python words.py
echo "--- a red that moved is named in a picture, and one that is pushed along is met once"
carom shoot --table snooker --balls snooker --pocket black:foot-left --cue 1.22,2.9 --plot reds.svg | grep -c 'meets red12'
grep -o '>red[0-9]*<' reds.svg | sort -u | wc -l
carom shoot --table snooker --cue 1.2,2.9 --balls red3=1,2.6:red4=1.5,0.4 --at-ball red3 --plot reds.svg > reds.txt
grep -o '>red[0-9]*<' reds.svg
carom plan --rules snooker --table snooker --cue 1.2,2.9 --balls black:red3=0.6,2.9 --shots 100 --plot down.svg > down.txt
sed -n '/Down:/,$p' down.svg | grep -c 'fill="#c8102e"/>'
echo "--- refused"
try_rows "coach, refused"
echo "--- of several shots those that cannot be aimed are left out"
try carom shoot --cue 2d,4d --balls foot-spot --pocket 1:foot-left --speed slow,medium,soft,fast | grep -v '^[c1] '
try carom shoot --cue 2d,4d --balls foot-spot --pocket 1:foot-left --speed slow,soft
echo "--- lengths in diamonds, a quantity of a list"
carom shoot --cue 2d,2d --balls 3d,4d --pocket 1:foot-right --leave head-left,1d | grep leave
carom hit --cut half --side inside,outside --quantity throw --csv | awk -F, 'NR == 1 { print; next } { printf "%s %.9f\n", $1, $2 }'
echo "--- the cue over a cushion and a ball"
for elevation in 0 least 20; do
  carom shoot --cue 0.62,0.03 --balls 0.4,2.2 --pocket 1:foot-left --speed 3 --elevation $elevation | grep -E '^(9ft|butt)'
done
try_rows "coach, the cue over a ball"
echo "--- the player of a film"
cat > filmed.json << 'JSON'
{"player": {"rating": {"mean": 500, "low": 460, "high": 540},
  "player": {"speed_share": 0.07, "phi": 0.2, "theta": 0.25, "a": 0.03, "b": 0.03, "growth": 0.25}}}
JSON
echo '{"constants": {}}' > fitted.json
one="plan --cue 0.6,0.8 --balls 0.5,1.6 --rules potting --shots 400 --csv"
# shellcheck disable=SC2086
carom $one --player filmed.json | cut -d, -f 2-4,12 | head -n 2
# shellcheck disable=SC2086
[ "$(carom $one --player filmed.json)" != "$(carom $one --player 500)" ] && echo "its errors count"
for words in "--player fitted.json" "--player none.json" "--player filmed.json --errors 1"; do
  # shellcheck disable=SC2086
  try carom $one $words
done
