# ways: the ways to pot a ball, and to score; each stroke does what its row says, played by itself.
CAROM_ISA=plain
export CAROM_ISA
layout="--cue 0.6,0.8 --balls 0.3,1.9:0.9,1.7"
# shellcheck disable=SC2086
{
  carom ways $layout --ball 1 --pocket foot-left --speed 1.5 --rails 1
  carom ways $layout --speed 1.5,2.5 --tip 0,0.2:0,-0.3 --rails 1 --scan 20000 --json > ways.jsonl
  carom ways $layout --speed 1.5,2.5 --tip 0,0.2:0,-0.3 --rails 1 --scan 20000 --csv --threads 1 -o ways.csv --plot ways.svg
  carom ways --table threecushion --balls threecushion --speed 3.0,5.0 --scan 10000 --json > points.jsonl
  carom ways --table threecushion --balls threecushion --speed 3.0,5.0 --scan 10000 > points.txt
}
# the cue ball ends where it shall: without errors the chance is 1 or 0
carom ways --cue 0.6,0.8 --balls 0.3,1.9 --ball 1 --pocket foot-left --rails 0 --leave 2d,4.5d,20cm --errors 0 --json > leave.jsonl
carom ways --cue 1d,2d --leave 0.2,0.3,0.2 --rails 1 --errors 0 --scan 8000 --json > place.jsonl
for name in leave place; do carom shoot $name.jsonl > $name.out; done
carom shoot ways.jsonl > ways.out
carom shoot points.jsonl > points.out
python - << 'PYTHON'
import csv, json
read = lambda name: [json.loads(line) for line in open(name, encoding="utf-8")]
rows, ways, played = list(csv.DictReader(open("ways.csv"))), read("ways.jsonl"), read("ways.out")
assert len(rows) == len(ways) == len(played) and [float(row["chance"]) for row in rows] == sorted((float(row["chance"]) for row in rows), reverse=True)
ids = {"lb": "head-left", "lc": "side-left", "lt": "foot-left", "rb": "head-right", "rc": "side-right", "rt": "foot-right"}
kinds = {}
for row, way, shot in zip(rows, ways, played):
    kinds[row["kind"]] = kinds.get(row["kind"], 0) + 1
    assert way["id"].startswith(f"{row['ball']} to {ids[row['pocket']]}, {row['kind']}")
    assert row["ball"] in shot["final"]["pockets"][row["pocket"]], way["id"]
    if row["kind"] not in ("kick", "rail first"):
        assert float(row["phi_low"]) <= float(row["phi"]) <= float(row["phi_high"]), way["id"]
    # the balls met first are those of the way
    met = next(event[2] for event in shot["events"] if event[1] == "ball_ball" and "cue" in event[2])
    first = next((part for part in row["way"].split(", ") if part.isdigit()), row["ball"]) if row["kind"] in ("combination", "carom") else row["ball"]
    assert set(met) == {"cue", first}, (way["id"], met)
print({kind: kinds[kind] > 0 for kind in sorted(kinds)})

for name, (x, y), many in (("leave", (0.635, 1.42875), 1), ("place", (0.2, 0.3), 3)):
    found = list(zip(read(f"{name}.jsonl"), read(f"{name}.out"), strict=True))
    assert len(found) >= many and all(way["way"]["chance"] == 1 for way, _ in found), name
    for way, shot in found:
        end = shot["final"]["balls"]["cue"]
        assert ((end[1] - x) ** 2 + (end[2] - y) ** 2) ** 0.5 <= 0.2, (name, way["id"], end)
        assert name == "place" or "1" in shot["final"]["pockets"]["lt"]

# a point: rails and balls that the cue ball meets, in their order, up to the second ball
sides = {"3": "left", "12": "right", "9": "foot", "18": "head"}
named = {name: side for name, side in sides.items()}
for way, shot in zip(read("points.jsonl"), read("points.out")):
    seen, last = [], {}
    for time, kind, who, *_ in shot["events"]:
        if "white" not in who or kind not in ("ball_ball", "ball_linear_cushion"):
            continue
        other = next(part for part in who if part != "white")
        part = other if kind == "ball_ball" else ("rail", other)
        hop, last[other] = time - last.get(other, -1) < 0.1 and seen[-1] == part, time
        if not hop and part not in [one for one in seen if isinstance(one, str)]:
            seen.append(part)
        if sum(isinstance(one, str) for one in seen) == 2:
            break
    by = way["way"]["by"].split(", ")
    assert [part for part in seen if isinstance(part, str)] == [part for part in by if part in ("yellow", "red")], (by, seen)
    assert len(seen) == len(by) and sum(isinstance(one, tuple) for one in seen) >= 3, (by, seen)
points = read("points.jsonl")
said = open("points.txt", encoding="utf-8").read().splitlines()
good, of = int(said[-1].split()[0]), int(said[-1].split()[2])
counted = sum(round(way["way"]["share"] * of) for way in points)
print(len(points) > 20, of, counted == good, 0.5 < 100 * good / of < 10)
PYTHON
grep -c 'class="legend"' ways.svg
echo "--- less error, more chance"
chance() { carom ways --cue 0.6,0.8 --balls 0.3,1.9 --pocket foot-left --rails 0 --speed 2 --csv "$@" | sed -n 2p | cut -d , -f 16; }
awk -v sure="$(chance --errors 0.3)" -v weak="$(chance --errors 4)" -v rated="$(chance --player 700)" -v seen="$(chance --errors 0)" -v blurred="$(chance --errors 0 --eye 3mm)" 'BEGIN { print (sure > weak + 0.3), (rated > weak), (seen == 1), (blurred < 0.9) }'
echo "--- a ball frozen to a rail: along it, and by way of it"
carom ways --cue 2d,3d --balls frozen-left,5d --ball 1 --speed 1.5,4 --rails 1 --pocket foot-left
carom shoot --cue 2d,3d --balls frozen-left,5d --pocket 1:foot-left --speed 1.5 | grep -c "falls with aims of 136"
echo "--- each stroke"
carom ways --cue 0.6,0.8 --balls 0.3,1.9 --ball 1 --pocket foot-left --rails 0 --speed 1:3:1 --tip -0.2..0.2..0.2,0 --each --csv | cut -d , -f 6,9
echo "--- refused"
try_rows "ways, refused"
carom shoot --cue 0.6,0.8 --balls 0.3,1.9 --json > a.jsonl
carom shoot --cue 0.6,0.9 --balls 0.3,1.9 --json > b.jsonl
cat a.jsonl b.jsonl > both.jsonl
try carom ways both.jsonl
# Errors alone are shown.
# shellcheck disable=SC2069
carom ways --table threecushion --balls threecushion --speed 25 --scan 3000 2>&1 > none
try_rows "ways, no way"
carom ways --rails 0 a.jsonl | cut -c 1-30 | head -n 1
echo "--- places in diamonds, ranges of tips"
carom shoot --cue 1d,2d --balls 2,6d --table 8ft --aim 90 --json | grep -o '"state": \[0, [^,]*, [^,]*'
for place in $(carom shoot --help | tr -s ' \n' ' ' | grep -o 'a place: [^(]*At left' | grep -oE '[a-z]+-[a-z]+|centre|yellow|green|brown|blue|pink|black'); do
  printf '%s ' $place
  carom shoot --cue $place --table 8ft --json | grep -o '"state": \[0, [^,]*, [^,]*'
done
carom shoot --cue 1,1 --balls 8=foot-spot:centre --json | grep -o '"id": "[^"]*", "params\|"state": \[0, [^,]*, [^,]*'
try_rows "ways, names"
carom shoot --cue 0.5,0.5 --tip -0.2..0.2..0.2,0..0.4..0.2 --json | sed 's/.*"a": \([^,]*\), "b": \([^,]*\),.*/\1 \2/' | tr '\n' ';'
echo
echo "--- gaps and seeds of a rack"
places() { carom shoot --balls nineball --aim 90 --json "$@" | grep -o '"state": [^]]*' | cksum; }
[ "$(places)" = "$(places --gap 0.1mm --seed 1)" ] && [ "$(places)" != "$(places --seed 2)" ] && [ "$(places)" != "$(places --gap 0)" ] && echo "as asked"
echo "--- a double hit is no way: a ball 5 mm ahead is cut, unless the cue stops"
for follow in 0.03 0; do
  carom shoot --cue 0.34395,2.19605 --balls 0.3,2.24 --aim 135 --speed 1.5 --with follow=$follow --json > a.jsonl
  carom ways a.jsonl --pocket foot-left | grep ', pot$'
done
