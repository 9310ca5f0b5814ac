# break: breaks of racks, counted as the shots say that `carom shoot` plays.
CAROM_ISA=plain
export CAROM_ISA
carom break --rules nineball --speed 9 --racks 100
carom break --speed 8 --tip 0,0 --racks 40 --gap 0,0.3mm --errors 0 --csv --threads 2 --plot break.svg -o rows.csv
carom break --speed 8 --tip 0,0 --racks 40 --gap 0,0.3mm --errors 0 --csv --falls -o falls.csv
carom break --speed 8 --tip 0,0 --racks 40 --gap 0,0.3mm --errors 0 --csv --threads 1 | cmp - rows.csv && echo "the same with any number of threads"
grep -c '<g class="others"' break.svg
# Without errors the stroke is along the table, as the ball in front lies straight ahead but for a quarter of the gap.
for gap in 0 0.3mm; do
  for seed in $(seq 40); do carom shoot --balls eightball --gap $gap --seed "$seed" --speed 8 --tip 0,0 --json; done > racks.jsonl
  python - racks.jsonl > aimed.jsonl << 'PYTHON'
import json, math, sys
for line in open(sys.argv[1]):
    shot = json.loads(line)
    places = [ball["state"][1:3] for ball in shot["balls"]]
    front = min(places[1:], key=lambda place: math.dist(place, places[0]))
    shot["cue"]["phi"] = math.degrees(math.atan2(front[1] - places[0][1], front[0] - places[0][0]))
    print(json.dumps(shot))
PYTHON
  carom shoot aimed.jsonl > "played-$gap.jsonl"
done
python - << 'PYTHON'
import csv, json
falls = list(csv.DictReader(open("falls.csv")))
pocket = {"lb": "head-left", "lc": "side-left", "lt": "foot-left", "rb": "head-right", "rc": "side-right", "rt": "foot-right"}
for row, gap in zip(csv.DictReader(open("rows.csv")), ("0", "0.3mm"), strict=True):
    makes = balls = scratch = wing = on = 0
    ends, fell = [], {}
    for shot in map(json.loads, open(f"played-{gap}.jsonl")):
        down = {ball for fallen in shot["final"]["pockets"].values() for ball in fallen}
        for where, fallen in shot["final"]["pockets"].items():
            for ball in fallen:
                fell[ball, pocket[where]] = fell.get((ball, pocket[where]), 0) + 1
        x = {ball["id"]: abs(ball["state"][1] - 0.635) for ball in shot["balls"] if ball["id"] != "cue"}
        makes += bool(down - {"cue"})
        balls += len(down - {"cue"})
        scratch += "cue" in down
        wing += any(x[ball] > max(x.values()) - 0.014 for ball in down - {"cue"})
        if "cue" not in down:
            ends.append(shot["final"]["balls"]["cue"][1:3])
    mean = [sum(axis) / len(ends) for axis in zip(*ends)]
    spread = (sum((x - mean[0]) ** 2 + (y - mean[1]) ** 2 for x, y in ends) / len(ends)) ** 0.5
    seen = {"makes": makes / 40, "balls": balls / 40, "scratch": scratch / 40, "wing": wing / 40, "x": mean[0], "y": mean[1], "spread": spread}
    print(gap, {name: abs(float(row[name]) - value) < 2e-6 for name, value in seen.items()})
    shares = {(fall["ball"], fall["pocket"]): float(fall["share"]) for fall in falls if fall["gap_mm"] == row["gap_mm"]}
    print(gap, len(shares), "shares by ball and pocket", all(abs(share - fell.get(fall, 0) / 40) < 2e-6 for fall, share in shares.items()), sum(fell.values()) > 0)
PYTHON
echo "--- a cut of the ball in front, and which ball falls where"
for cut in -20 35; do
  carom break --rules nineball --cue 0.3,0.6 --cut "$cut" --racks 1 --errors 0 --csv | sed -n 2p | cut -d , -f 3
  carom shoot --balls nineball --cue 0.3,0.6 --cut "$cut" --speed 9 --json | python -c 'import json; print(json.loads(input())["cue"]["phi"])'
done
carom break --rules nineonspot --cue 0.3,0.6 --elevation 2 --cut 5 --racks 60 --falls
echo "--- the breaks that win most"
carom break --rules nineball --player 700 --racks 100 --best
echo "--- other racks, refused"
carom break --rules tenball --racks 20 --csv | sed -n 2p | cut -d , -f 1,12,13
try_rows "break, bad usage"
