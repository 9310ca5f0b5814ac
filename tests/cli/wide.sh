# ways --cut, --distance: how wide a pot is over places of the cue ball.
CAROM_ISA=plain
export CAROM_ISA
pot="--balls 2d,6d --pocket foot-left --tip 0,0 --speed 3 --friction constant --with u_b=0"
# shellcheck disable=SC2086
{
carom ways $pot --cut=-20,0,40 --distance 30,60cm --errors 0 --csv > wide.csv
carom ways $pot --cut=-20,0,40 --distance 30,60cm --errors 0 --json > wide.jsonl
}
carom shoot --friction constant wide.jsonl > wide.out
python - <<'PYTHON'
import csv, json, math
read = lambda name: [json.loads(line) for line in open(name, encoding="utf-8")]
rows, lines, played = list(csv.DictReader(open("wide.csv"))), read("wide.jsonl"), read("wide.out")
asked = [(cut, distance) for cut in (-20, 0, 40) for distance in (0.3, 0.6)]
assert len(rows) == len(lines) == len(played) == len(asked)
radius, ball, degree = 0.028575, (0.635, 1.905), math.pi / 180
for (cut, distance), row, line, shot in zip(asked, rows, lines, played):
    row = {key: float(value) for key, value in row.items() if key not in ("kind", "ball", "pocket", "way")}
    assert (row["at_cut"], row["distance"]) == (cut, distance)
    # without friction the ball goes along the line of centres, so the cut is that of the place
    assert abs(row["cut"] - cut) < 0.3, row
    # the cue ball comes from there in a straight line, and meets the ball at that cut
    way = row["phi"] * degree
    met = [row["x"] + distance * math.cos(way), row["y"] + distance * math.sin(way)]
    assert abs(math.dist(met, ball) - 2 * radius) < 1e-3 * distance + 1e-4, (row, met)
    # a direction of the cue turns the ball's by distance / (2 R cos(cut)) as much
    turn = 2 * row["margin"] * 2 * radius * math.cos(cut * degree) / distance
    assert 0.5 * turn < row["phi_high"] - row["phi_low"] < 1.6 * turn, (row, turn)
    # the line has the cue ball there, and the ball falls
    state = next(one["state"] for one in line["balls"] if one["id"] == "cue")
    assert state[1:3] == [row["x"], row["y"]] and abs(line["way"]["cut"] - row["cut"]) < 1e-6, (state, row, line["way"])
    assert "1" in shot["final"]["pockets"]["lt"]
    assert row["falls"] == 1 and row["chance"] in (0, 1)
# the window halves where the distance doubles
wide = [float(row["phi_high"]) - float(row["phi_low"]) for row in rows]
print([round(far / near, 1) for near, far in zip(wide[::2], wide[1::2])])
PYTHON
echo "--- curves"
carom ways --balls 2d,6d --pocket foot-left --cut 0:60:20 --distance 0.4,0.8 --speed 2 --plot cut.svg | cut -c 25-36,74-
grep -o '>distance [^<]*<\|>cut (degrees)<\|>how often [^<]*<' cut.svg
carom ways --balls 2d,6d --pocket foot-left --distance 30cm:90cm:30cm --tip 0,0:0.4,0 --speed 2 --quantity window --plot far.svg -o /dev/null
grep -o '>tip [^<]*<\|>distance ([^<]*<\|>window [^<]*<' far.svg
carom ways --balls 2d,6d --pocket foot-left --cut half --speed 1.0,2.0 --tip -0.4..0.4..0.2,0 --quantity chance --plot tip.svg -o /dev/null
grep -o '>speed [^<]*<\|>tip to [^<]*<\|>how often [^<]*<' tip.svg
echo "--- degrees"
carom hit --cut 30° --csv --quantity throw
echo "--- left out and refused"
try carom ways --balls 2d,6d --pocket foot-left --cut 30,89 --distance 0.5,3 --speed 2
try carom ways --cue 1,1 --balls 2d,6d --pocket foot-left --cut 30
try carom ways --balls 2d,6d --cut 30
try carom ways --balls 2d,6d:1d,6d --pocket foot-left --cut 30
try carom ways --balls 2d,6d --pocket foot-left --cut 0:60 --distance 0.1:1.1
try carom ways --balls 2d,6d --pocket foot-left --cut 30 --plot none.svg
try carom ways --table threecushion --balls threecushion --ball red --cut 30
try carom ways --balls 2d,6d --pocket foot-left --cut 20 --distance=-1
