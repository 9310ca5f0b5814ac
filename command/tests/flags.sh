# shoot by options: the line that they make, what is told of it, pictures of several shots, and the page that plays them.
shot="--cue 0.6,0.8 --balls 0.5,1.6:8=0.9,1.2 --at-ball 1"
# shellcheck disable=SC2086
try carom shoot $shot --cut 20 --speed 2
try carom shoot --cue 0.6,0.8 --aim 35 --speed 3 --tip 0.2,-0.3
cat > flags.py << 'PYTHON'
import csv, io, json, math, os, re, subprocess
import xml.etree.ElementTree as tree
from drawn import SVG
carom, R = os.environ["CAROM"], 0.028575

def run(*words, **given):
    return subprocess.run([carom, "shoot", *map(str, words)], capture_output=True, text=True, check=True, **given).stdout

def shots(*words):
    lines = run(*words, "--json")
    return [(json.loads(line), json.loads(played)) for line, played in zip(lines.splitlines(), run("-", input=lines).splitlines(), strict=True)]

balls = ("--cue", "0.6,0.8", "--balls", "0.5,1.6:8=0.9,1.2")
worst = 0.0
for tip in ("0,0", "0.4,0.1", "-0.3,-0.4", "-1tip,0.5tip"):
    for given, played in shots(*balls, "--at-ball", 8, "--cut", "-35,0,half", "--speed", "7mph", "--tip", tip, "--elevation", "0,3"):
        strike = next(event for event in played["events"] if event[1] == "stick_ball")
        v, w = strike[4][0][4:6], strike[4][0][7:10]
        right = float(tip.split(",")[0].removesuffix("tip"))
        # Right of the centre: a < 0 in the line, and a spin counterclockwise from above.
        assert right == 0 and given["cue"]["a"] == 0 or right * given["cue"]["a"] < 0 < right * w[2], (tip, given["cue"], w)
        assert abs(given["cue"]["V0"] - 7 * 0.44704) < 1e-15
        contact = next(event for event in played["events"] if event[1] == "ball_ball")
        sign = 1 if contact[2] == ["cue", "8"] else -1
        a, b = contact[3][::sign]
        x, y, vx, vy = b[1] - a[1], b[2] - a[2], *a[4:6]
        cut = math.degrees(math.atan2(vx * y - vy * x, vx * x + vy * y))
        worst = max(worst, min(abs(cut - asked) for asked in (-35, 0, 30)))
        assert f"cut {'30' if cut > 10 else '-35' if cut < -10 else '0'} deg" in given["id"].replace("half", "30 deg"), (cut, given["id"])
    # A level cue gives the ball the speed that was asked for instead.
    [(given, played)] = shots(*balls, "--ball-speed", "7mph", "--tip", tip)
    assert abs(math.hypot(*next(event for event in played["events"] if event[1] == "stick_ball")[4][0][4:6]) - 7 * 0.44704) < 1e-12
# A tip of phenolic resin gives the ball more speed than one of leather, the default, and one without loss more still: in proportion to 1 + e.
speeds = [float(run("--cue", "0.6,0.8", "--speed", 3, *more).split("cue ball at ")[1].split()[0]) for more in ((), ("--tip-restitution", 0.85), ("--tip-restitution", 1))]
print("tips:", [round(speed * 1.73 / speeds[0], 2) for speed in speeds])
# What is not said is what carom_cue_of() says: docs/reference/files.md.
[(given, _)] = shots("--cue", "0.6,0.8")
assert {key: given["cue"][key] for key in ("V0", "phi", "theta", "a", "b")} == {"V0": 2, "phi": 90, "theta": 0, "a": 0, "b": 0.25}
print("cuts are what was asked for:", worst < 1e-6)
# Options and the line that they make are one shot, with the constants of every model of the cushion.
for model in ("han", "mathavan", "smooth"):
    asked = ("--cue", "0.5,0.5", "--aim", "60", "--speed", "3", "--with", "mass=170g", "--cue-ball", "radius=29mm")
    by_options = run(*asked, "--cushion", model, "--events", "full")
    assert by_options == run("--cushion", model, "-", input=run(*asked, "--json")), model
same = lambda a, b: run(*a, "--json") == run(*b, "--json")
print("units:", same(["--cue", "1,2ft"], ["--cue", "0.3048,0.6096"]), same(["--speed", "3.6km/h"], ["--speed", 1]), same(["--tip", "1,0tip"], ["--tip", f"{0.013 / R!r},0"]), same(["--speed", "15ft/s"], ["--speed", 15 * 0.3048]), same(["--tip", "12mm,1.5tips"], ["--tip", f"{0.012 / R!r},{1.5 * 0.013 / R!r}"]),
      same(["--with", "mass=6oz,radius=34mm,end_mass=4g,tip_time=2ms"], ["--with", f"mass={6 * 0.028349523125!r},radius=0.034,end_mass=0.004,tip_time=0.002"]), same(["--table", "12ft"], ["--table", "snooker"]), same(["--table", "10ft,width=4ft"], ["--table", "threecushion,width=4ft"]))
for rack, count in (("nineball", 10), ("eightball", 16), ("tenball", 11)):
    [(given, _)] = shots("--balls", rack, "--speed", 8)
    assert [ball["id"] for ball in given["balls"]] == ["cue", *map(str, range(1, count))]
    # The first ball of a rack is met, though the others are hit at the same instant.
    head = min(given["balls"][1:], key=lambda ball: ball["state"][2])["id"]
    [(_, played)] = shots("--balls", rack, "--at-ball", head, "--cut", 5, "--speed", 8)
    assert next(event for event in played["events"] if event[1] == "ball_ball")[2] == ["cue", head]
[(given, _)] = shots("--balls", "snooker", "--table", "snooker", "--speed", 1)
print([ball["id"] for ball in given["balls"]][::5], given["balls"][0]["params"])

# Sent to a place, the ball leaves towards it, whatever its tip; in diamonds of the table.
for x, y in ((4, 6), (0, 3)):
    sent = ("--table", "threecushion", "--cue", "0.5,0.7", "--tip", "0.4,0.1", "--to", f"{x}d,{y}d")
    leaves = next(csv.DictReader(io.StringIO(run(*sent, "--csv"))))
    way = math.degrees(math.atan2(y * 2.84 / 8 - 0.7, x * 1.42 / 4 - 0.5))
    ((given, _),) = shots(*sent)
    assert leaves["what"] == "leaves" and abs(float(leaves["direction_deg"]) - way) < 1e-9 and abs(given["cue"]["phi"] - way) > 0.3, (leaves, way)
print([line["id"] for line, _ in shots("--to", "4d,6d:foot-right")])

# Balls that touch: a rail, or the one before it in a direction; the cue ball also one that comes after it.
(given, _), = shots("--cue", "frozen-9,20", "--balls", "frozen-left,4d:frozen-foot,1d:9=frozen-1,30:frozen-9,-90:frozen-right,1:frozen-head,2d", "--aim", 200)
at = {ball["id"]: ball["state"][1:3] for ball in given["balls"]}
for name, x, y in (("1", R, 1.27), ("2", 0.3175, 2.54 - R), ("5", 1.27 - R, 1), ("6", 0.635, R)):
    assert math.dist(at[name], (x, y)) < 1e-15, (name, at)
for name, other, degrees in (("9", "1", 30), ("4", "9", -90), ("cue", "9", 20)):
    x, y = (a - b for a, b in zip(at[name], at[other], strict=True))
    assert abs(math.hypot(x, y) - 2 * R) < 1e-15 and math.cos(math.atan2(y, x) - math.radians(degrees)) > 1 - 1e-15, (name, at)

# Several values of numbers, of all balls, the cue and the cue ball alone, which may be larger.
other = shots("--balls", "0.635,1.5", "--with", "end_mass=3g,7g,radius=28mm:30mm:2mm", "--cue-ball", "mass=6.5oz,0.2,radius=30mm")
print([line["id"] for line, _ in other[::3]])
for line, _ in other:
    cue, ball = line["balls"]
    assert cue["params"]["R"] == cue["state"][3] == 0.03 and ball["state"][3] == ball["params"]["R"] and "m" not in ball["params"] and str(cue["params"]["m"])[:4] in line["id"]
# A cue that turns by the squirt about the bridge for back-hand english puts its tip where it was.
for end_mass, a in ((0.003, 0.5), (0.007, -0.3)):
    squirt, bridge = re.search(r"squirt ([\d.]+) .* is (\d+) mm", run("--tip", f"{a},0", "--with", f"end_mass={end_mass}")).groups()
    assert abs(math.sin(math.radians(float(squirt))) * float(bridge) - 1e3 * abs(a) * R) < 0.15, (squirt, bridge)
# A jump: as high as the speed upwards of its event carries it, and as far as to its landing.
jump = ("--cue", "0.6,0.8", "--elevation", 40, "--tip", "0,0", "--tip-time", "0.8ms", "--speed", 3.5)
[(_, played)] = shots(*jump)
flights = [(a[4][0], b[4][0]) for a, b in zip(played["events"], played["events"][1:]) if b[1] == "slate"]
flies, lands = ([row for row in csv.DictReader(io.StringIO(run(*jump, "--csv"))) if row["what"] == what] for what in ("flies", "lands"))
for (a, b), up, down in zip(flights, flies, lands):
    assert abs(float(up["height_mm"]) - 1e3 * (a[3] - R + a[6] ** 2 / 2 / 9.81)) < 1e-9 and abs(float(down["flight_m"]) - math.dist(a[1:3], b[1:3])) < 1e-12, (up, down)
print("flights:", len(flies), *re.findall("flies .* high|lands .* on", run(*jump)), re.search("flies[^;]*", run(*jump[:-1], "3.5,2")).group())

# What balls do, as rows: contacts are those of the events, ends those of the shot; a ball that lies 5 mm beside a straight path is passed.
rows = lambda *words: list(csv.DictReader(io.StringIO(run(*words, "--csv"))))
told = rows(*balls, "--at-ball", 1, "--cut", "10,-20", "--ball-speed", 3)
for number, (_, played) in enumerate(shots(*balls, "--at-ball", 1, "--cut", "10,-20", "--ball-speed", 3), 1):
    for ball, state in played["final"]["balls"].items():
        of = [row for row in told if row["shot"] == str(number) and row["ball"] == ball]
        met = sorted({event[0] for event in played["events"] if event[1] == "ball_ball" and ball in event[2]})
        assert [float(row["time_s"]) for row in of if row["what"] == "meets"] == met, (ball, met)
        rolls = [event for event in played["events"] if event[1] == "sliding_rolling" and event[2] == [ball]]
        assert [[float(row[key]) for key in ("time_s", "x_m", "y_m")] for row in of if row["what"] == "rolls"] == [[event[0], *event[4][0][1:3]] for event in rolls]
        if of and of[-1]["what"] == "rests":
            assert [float(of[-1]["x_m"]), float(of[-1]["y_m"])] == state[1:3]
[past] = [row for row in rows("--cue", "0.6,0.8", "--balls", f"{0.6 + 2 * R + 0.005!r},1.3", "--aim", 90) if row["what"] == "passes"]
print("passes by", round(float(past["gap_mm"]), 6), "mm at y =", round(float(past["y_m"]), 4))
# One that flies over a ball, by the parabola of its launch, passes it between two samples of a long shot.
jump = ("--cue", "0.6,0.8", "--balls", "0.6,1.1", "--elevation", 40, "--tip", "0,0", "--tip-time", 0.0006, "--tip-restitution", 1, "--speed", 3.2, "--time-most", 0.3)
[over] = [row for row in rows(*jump) if row["what"] == "passes"]
[(_, flown)] = shots(*jump)
[*_, strike] = [event for event in flown["events"] if event[1] == "stick_ball"]
along, up = strike[4][0][5:7]
least = min(math.hypot(along * t - 0.3, up * t - 4.905 * t * t) for t in (k * 1e-6 for k in range(200000))) - 2 * R
print("passes over:", abs(float(over["gap_mm"]) - 1e3 * least) < 0.01, round(1e3 * least, 1))
[rail] = [row for row in rows("--cue", "0.6,0.8", "--aim", 180, "--speed", 1) if row["what"] == "rail"][:1]
print(rail["with"], round(float(rail["diamonds"]), 6), round(8 * 0.8 / 2.54, 6), run("--cue", "0.3,0.3", "--aim", 225, "--speed", 2).splitlines()[-1].strip())

# Aims at pockets, by banks and combinations too: the ball falls there by the way that was asked for, with the aims and speeds that are told, and not
# beyond them.
fell = 0
rail_names = {"3": "left", "6": "left", "15": "right", "12": "right", "18": "foot", "9": "head"}
for places, ball, pocket, words in (
    ("0.4,1.7", "1", "foot-left", "--tip 0.4,0"), ("0.7,1.9", "1", "foot-right", "--tip -0.3,0.2 --speed 3"), ("1.0,1.15", "1", "side-right", "--speed 1.5"), ("0.3,0.5", "1", "lb", "--tip 0,-0.3"),
    ("0.9,1.7", "1", "foot-left", "--via right --speed 3"), ("0.9,1.7", "1", "foot-left", "--via right --speed 3 --cushion mathavan"), ("0.8,1.4", "1", "foot-right", "--via right,left --speed 4"), ("0.55,1.3:8=0.4,1.8", "8", "foot-left", "--via 1"), ("0.6,1.3:8=0.4,1.8", "8", "foot-right", "--via 1,left --speed 3"),
    ("1.0,2.2", "1", "foot-left", "--via right,1 --speed 3"),
):
    asked = ("--cue", "0.6,0.9" if "via" not in words else "0.6,0.8", "--balls", places, "--pocket", f"{ball}:{pocket}", *words.split())
    models = [word for word in words.split() if word in ("--cushion", "mathavan")]
    [given] = map(json.loads, run(*asked, "--json").splitlines())
    play = lambda **cue: json.loads(run("-", *models, input=json.dumps(given | {"cue": given["cue"] | cue})))
    played, id = play(), {"foot-left": "lt", "foot-right": "rt", "side-right": "rc"}.get(pocket, pocket)
    assert ball in played["final"]["pockets"][id], (pocket, played["final"])
    # The way: what the balls meet, in its order.
    fall = next(k for k, event in enumerate(played["events"]) if event[1] == "ball_pocket" and event[2][0] == ball)
    met = [event for event in played["events"][:fall] if ball in event[2] and (event[1] == "ball_ball" or event[1] == "ball_linear_cushion" and event[2][1] in rail_names)]
    by = [rail_names[event[2][1]] if event[1] == "ball_linear_cushion" else next(name for name in event[2] if name != ball) for event in met]
    via = words.split("--via ")[1].split()[0].split(",") if "via" in words else []
    kick = ball in via
    assert by == (["cue"] if kick else ([] if via[:1] == ["1"] else ["cue"]) + via), (by, via)
    assert not kick or next(rail_names[event[2][1]] for event in played["events"] if event[1] == "ball_linear_cushion") == via[0]
    said = run(*asked)
    cut, side, margin, low, high, least, most = re.search(r"cut ([\d.]+) degrees to the (\w+); the ball has ([\d.]+) degrees.*?aims of ([\d.]+) to ([\d.]+) degrees.*?with ([\d.]+) to ([\d.]+) m/s", said, re.S).groups()
    a, b = next(event for event in played["events"] if event[1] == "ball_ball")[3]
    turn = a[4] * (b[2] - a[2]) - a[5] * (b[1] - a[1])
    assert 0.3 < float(margin) and any(abs(float(told) - float(cut)) < 0.11 for told in re.findall(r"at a cut of ([\d.]+)", said)) and (turn > 0) == (side == "left"), (said, turn)
    assert float(low) - 0.005 <= given["cue"]["phi"] <= float(high) + 0.005
    for cue, falls in (({"V0": float(least) * 1.02}, True), ({"V0": float(least) * 0.98}, False), ({"V0": float(most) * 0.98}, True), ({"phi": float(low) + 0.006}, True), ({"phi": float(high) - 0.006}, True), ({"phi": float(low) - 0.006}, False), ({"phi": float(high) + 0.006}, False)):
        assert (ball in play(**cue)["final"]["pockets"][id]) == falls, (asked, cue, falls)
        fell += falls
print("aimed at pockets:", fell)

for table in ("snooker", "9ft", "9ft,corner=4.25in,corner_cut=142", "9ft,corner=0.10795,corner_cut=142deg"):
    print(table, [line.split("; ")[1] for line in run("--table", table, "--cue", "0.5,0.8", "--balls", "0.3,2", "--pocket", "1:foot-left", "--speed", 1.2).splitlines() if line.startswith("aim")])

# Each option alone is a shot by options, though it may lack another one.
alone = "--table snooker,--at-ball 1,--pocket 1:lt,--via left,--json,--cue 0.6_0.8,--balls 0.5_1.6,--balls nineball,--tip 0.1_0,--speed 1,--ball-speed 1,--aim 10,--cut 10,--elevation 5,--tip-time 0.001,--tip-restitution 0.85"
told = lambda words: subprocess.run([carom, "shoot", *words.replace("_", ",").split()], capture_output=True, text=True).stderr
print("by options:", [words for words in alone.split(",") if "needs the name of a file" in told(words)])

# Pictures of several: a path for each ball and shot that moves, and groups that the page moves.
words = (*balls, "--at-ball", 1, "--cut", "10,-20,45", "--plot", "all.svg", "--animate", "all.html")
told = run(*words)
played = [result for _, result in shots(*balls, "--at-ball", 1, "--cut", "10,-20,45")]
moving = [{name for event in result["events"] for name in event[2] if name in result["final"]["balls"]} for result in played]
page = tree.parse("all.svg").getroot()
groups = [g for g in page.iter(SVG + "g") if g.get("class") == "ball"]
ways = [path for path in page.iter(SVG + "path") if path.get("stroke-width") == "2.2"]
print(len(ways) == sum(map(len, moving)), len(groups) == 3 + sum(map(len, moving[1:])))
numbers = [text.text for g in groups for text in g.iter(SVG + "text")]
print([name for name in numbers if name not in ("1", "8")])
legend = [path.get("stroke") for path in page.iter(SVG + "path") if path.get("class") == "legend"]
dashed = [path.get("stroke") for path in ways if path.get("stroke-dasharray")]
print("legend:", len(set(legend)) == 3, {path.get("stroke") for path in ways} == set(legend), len(dashed) == len(ways) - 3)
print([text.text for text in page.iter(SVG + "text") if text.get("class") == "pocket"])
html = open("all.html", encoding="utf-8").read()
print("needs nothing else:", set(re.findall(r"https?://[^\"' ]*", html)), "src=" in html, "href" in html)
print("the film's colours:", re.findall(r'path: "(#[0-9a-f]{6})"', html)[:3] == legend)
film = json.loads(re.search(r"const film=recorded\((.*?)\);\n", html, re.S)[1])
for part in ("words", "ball", "table", "film", "player"):
    text = open(os.path.join(os.environ["DATA"], f"../web/player/{part}.js"), encoding="utf-8").read()
    assert re.sub(r"\nimport .*", "", text) in html, f"{part}.js of the player is another one"
checked = 0
for result, shot in zip(played, film["shots"], strict=True):
    times = shot["times"]
    assert times[0] == 0 and abs(times[-1] - result["final"]["t"]) < 1e-4 and times == sorted(times) and max(b - a for a, b in zip(times, times[1:])) < 0.026
    assert [event[1] for event in shot["events"]] == [event[1] for event in result["events"] if event[1] != "none"]
    for (name, radius), numbers in zip(film["balls"], shot["poses"], strict=True):
        poses = [numbers[k : k + 10] for k in range(0, len(numbers), 10)]
        assert abs(radius - 0.028575) < 1e-6 and len(poses) == (len(times) if any(name in event[2] for event in result["events"]) else 1)
        assert all(abs(math.hypot(*pose[3:7]) - 1) < 1e-3 for pose in poses)
        # At events and at the end the places are those of the shot.
        states = [(event[0], event[3][event[2].index(name)]) for event in result["events"] if event[1] in ("ball_ball", "ball_linear_cushion") and name in event[2]]
        for time, state in [*states, (times[-1], result["final"]["balls"][name])]:
            at = min(range(len(times)), key=lambda n: abs(times[n] - time))
            assert abs(times[at] - time) < 1e-4 and math.dist(poses[min(at, len(poses) - 1)][:3], state[1:4]) < 2e-4, (name, time, state)
            checked += 1
print(checked > 5, told.count("rests") + told.count("falls") == sum(map(len, moving)))
PYTHON
python flags.py
echo "--- with --events the lines that a file would give, and the same picture"
carom shoot --balls 0.5,1.6 --at-ball 1 --cut 10,20 --json | carom shoot --events brief - > lines
carom shoot --balls 0.5,1.6 --at-ball 1 --cut 10,20 --events brief --plot lines.svg | cmp - lines && grep -c '"ball_ball"' lines
carom shoot --balls 0.5,1.6 --at-ball 1 --cut 10,20 --plot words.svg > words
cmp lines.svg words.svg && try carom shoot --cue 5,5 --events none
echo "--- refused"
for words in "--cue 0.6,0.8 --csv --events brief" "--cue 0.6" "--cue 0.6,0.8:0.1,0.2" "--balls 0.5,1.6;0.7,1" "--cut 20" "--balls 0.5,1.6 --at-ball 7" "--aim 30 --cut 20 --balls 0.5,1.6" "--tip 0.9,0.9" "--speed 0" "--speed 1 --ball-speed 1" "--balls 0.4,1.7 --pocket 1:rb" "--balls 0.4,1.7:0.3,1.9 --pocket 1:lt" "--balls 0.4,1.7:0.503,1.25 --cue 0.6,0.8 --pocket 1:lt" "--balls 0.4,1.7 --pocket 1:lt --speed 0.6" "--balls 0.4,1.7 --pocket 1:fot-right" "--balls 0.4,1.7 --pocket 1:lt --via lft" "--balls 0.4,1.7:0.9,1.5 --pocket 1:lt --via left,2" "--balls 0.4,1.7 --pocket 1:lt --via 1,1" "--balls 0.4,1.7 --pocket 1:lt --via head" "--balls 0.4,1.7 --via left" "--balls 0.9,1.55:0.8,2.0 --cue 0.6,0.8 --speed 3 --pocket 1:lt --via right" "--balls 0.9,1.5 --cue 0.6,0.8 --tip 0.2,0.1 --speed 3 --cushion mathavan --pocket 1:lt --via right" "--balls 0.4,1.7 --pocket 1:lt --aim 90" "--table threecushion --balls 0.4,1.7 --pocket 1:lt" "--ball-speed 1 --elevation 5" "--table attic" "--table 9ft,corne=4in" "--table 9ft,corner=4i" "--table 9ft,corner=2" "--table 9ft,cushion_depth=0.45" "--table 9ft,side=7in,side_hole=1in" \
  "--balls 0.5,1.6:8=0.55,1.2 --cue 0.6,0.8 --at-ball 1" "--balls 0.5,1.6 --cue 0.6,0.8 --at-ball 1 --speed 0.2" "--balls 0.6,1.1 --cue 0.6,0.8 --at-ball 1 --elevation 30 --speed 4 --tip-time 0.0006" \
  "--balls 0.05,0.9 --cue 0.05,0.6 --at-ball 1 --cut -60" "--balls 0.6,1.1 --at-ball 1 --cut 90" "--balls 0.5,0.5,0.5" "--cue 600,800" "--cue 0.6,0.8 --balls 0.61,0.8" "--cue 5,5" "--aim 0:90:1" "--to 4d" "--to frozen-left,4d" "--balls frozen-1" "--balls frozen-2,0:2=0.6,1.2" "--balls frozen-left,40degrees" "--cue frozen-1,0" "--to foot-left --aim 20" "--cue 0.6,0.8 --to 0.6,0.81" "--cue 0.6,0.8 $DATA/break-nineball.jsonl" "--cue 0.6,0.8 --animate a.gif" "--cue 0.6,0.8 --animate nowhere/a.html" "--balls nineball --seed 1.5" "--balls nineball --gap 3cm" "--balls nineball --gap 0:1mm:0.01mm --seed 1:900:1 --speed 1:5:0.01"; do
  # shellcheck disable=SC2086
  try carom shoot -o refused.txt $words
done
echo '{"kind": "shot", "cue": {"V0": 2, "b": 0}, "balls": [{"id": "cue", "state": [0, 0.6, 0.6, 0, 0, 0, 0, 0, 0, 0]}]}' | try carom shoot -o refused.txt -
echo "--- what the shells ask for"
carom hit --complete --side ""
carom shoot --complete --cushion "" | tr '\n' ' '
carom resolve --complete x -- | head -n 3
echo "files: $(carom resolve --complete --derived "")"
echo "--- lists and ranges of racks: the lines of single gaps and seeds, and too many"
carom shoot --balls nineball --gap 0,0.3mm --seed 2:4:2 --speed 1:8:7 --json | sed 's|"id": "[^"]*"||' > together
for rack in "2 --gap 0" "2 --gap 0.3mm" "4 --gap 0" "4 --gap 0.3mm"; do
  # shellcheck disable=SC2086
  carom shoot --balls nineball --seed $rack --speed 1:8:7 --json
done | sed 's|"id": "[^"]*"||' | cmp - together && wc -l < together
