# Whole shots: what is written reads back to the same shots, whatever the threads; a bad line costs itself.
ln -s "$DATA/shots-pooltool.jsonl" recorded.jsonl
carom shoot -o once.jsonl "$DATA/break-nineball.jsonl"
echo "exit $?"
carom shoot --threads 3 -o again.jsonl once.jsonl
cmp once.jsonl again.jsonl && echo "the same again"
grep -c '"status": "ok"' once.jsonl
carom shoot --threads 1 -o one.jsonl recorded.jsonl
carom shoot --threads 4 -o four.jsonl recorded.jsonl
cmp one.jsonl four.jsonl && echo "the same with any number of threads"
grep -o '"kind": "[a-z]*"' one.jsonl | sort | uniq -c | tr -s ' '
carom shoot --world pooltool --events brief recorded.jsonl | grep -o '"n_events": [0-9]*' | tr -d ' ' > ours
tr -d ' ' < recorded.jsonl | grep -o '"n_events":[0-9]*' | cmp - ours && echo "as many events as recorded"
carom shoot --world pooltool --events brief recorded.jsonl | grep public-017 | sed 's/\[\([0-9.]*\), "/["/g; s/"final".*//; s/.*"events"/"events"/'
echo "--- what is written of shots that pooltool recorded"
carom shoot --world pooltool recorded.jsonl > shots-pooltool
for file in shots-mathavan shots-racks; do
  ln -s "$DATA/$file.jsonl" .
  carom shoot --world pooltool --ball-model euler $file.jsonl > $file
done
# a pocket of others, and a time that is later
sed 's/"ball_pocket", \["2"/"ball_pocket", ["3"/; s/\(0\.19[0-9]*\)7/\18/' recorded.jsonl > changed.jsonl
python - << 'PYTHON'
import json, os

def shots(name):
    return {line["id"]: line for line in map(json.loads, open(name, encoding="utf-8")) if line["kind"] == "shot"}

def differ(ours, theirs, allowed):
    """States: a label and nine numbers, of which spins count times 0.03 m."""
    return len(ours) != len(theirs) or any(
        len(a) != 10 or a[0] != b[0] or any(abs(x - y) * (0.03 if k > 5 else 1) > allowed for k, (x, y) in enumerate(zip(a[1:], b[1:])))
        for a, b in zip(ours, theirs)
    )

def compare(written, recorded):
    """How many events were compared, how many shots to their end, and what differs: more than 5e-13 of what
    a start moved by 1e-13 moves, up to where that changes the events."""
    written, recorded = shots(written), shots(recorded)
    wrong, compared, whole = [], 0, 0
    for name, theirs in recorded.items():
        ours, same = written[name], theirs["sens"]["same_events"]
        wrong += [(name, key) for key in ("family", "table", "cue", "balls") if ours[key] != theirs[key]]
        for k, (one, other) in enumerate(zip(ours["events"][:same], theirs["events"][:same], strict=True)):
            # pooltool may name a pair in the other order.
            order = slice(None, None, -1 if one[2] != other[2] else 1)
            grown = max(theirs["sens"]["state"][max(k - 1, 0) : k + 1] + [1.0])
            late = 1e-12 + 5e-13 * max(theirs["sens"]["t"][k], 1.0)
            bad = one[1] != other[1] or one[2][order] != other[2] or abs(one[0] - other[0]) > late
            bad |= any(differ(one[side][order], other[side], 1e-12 + 5e-13 * grown) for side in (3, 4))
            wrong += [(name, k, one, other)] if bad else []
            compared += 1
        if same == len(theirs["events"]):
            whole += 1
            final, balls = ours["final"], list(theirs["final"]["balls"])
            grown = 1e-12 + 1e-11 * max(theirs["sens"]["state"] + [1.0])
            own = [final["balls"][b] for b in balls]
            bad = len(ours["events"]) != same
            bad |= differ(own, list(theirs["final"]["balls"].values()), grown)
            bad |= len(final["balls"]) != len(balls) or abs(final["t"] - theirs["final"]["t"]) > grown
            pocketed = {p: b for p, b in final["pockets"].items() if b}
            bad |= pocketed != theirs["final"].get("pockets", pocketed)
            wrong += [(name, "final")] if bad else []
    return compared, whole, wrong

for file in ("shots-pooltool", "shots-mathavan", "shots-racks"):
    print(file, *compare(file, os.path.join(os.environ["DATA"], file + ".jsonl")))
wrong = compare("shots-pooltool", "changed.jsonl")[2]
print("what was changed", "differs" if len(wrong) > 1 else "is not seen")
PYTHON
echo "--- a picture"
carom shoot --events none --plot break.svg "$DATA/break-nineball.jsonl" > none.jsonl
grep -c events none.jsonl
grep -c '<path fill="none"' break.svg
tail -n 1 break.svg
# The picture of a table that lies along x away from the origin, whose balls have odd names.
rail() { printf '{"id": "%s", "p1": [%s, 0.036], "p2": [%s, 0.036], "direction": %s}' "$@"; }
{
  printf '{"kind": "table", "id": "odd", "w": 2.4, "l": 1.1, "linear": [%s, %s, %s, %s], ' "$(rail left '-0.3, 0.2' '-0.3, 1.3' 0)" \
    "$(rail right '2.1, 0.2' '2.1, 1.3' 1)" "$(rail near '-0.3, 0.2' '2.1, 0.2' 1)" "$(rail far '-0.3, 1.3' '2.1, 1.3' 0)"
  printf '"circular": [{"id": "j", "center": [2.1, 0.2, 0.036], "radius": 0.05}], '
  printf '"pockets": [{"id": "hole", "center": [0.9, 1.33], "radius": 0.07}, {"id": "other", "center": [-0.3, 0.2], "radius": 0.06}]}\n'
  # r, v and spin of balls that slide already; the first two fall into one pocket
  ball() { printf '{"id": "%s", "state": [2, %s, %s, 0.028575, %s, %s, 0, %s, %s, %s]}' "$@"; }
  printf '{"kind": "shot", "id": 7, "table": "odd", "cue": {"ball": "cue"}, "balls": [%s, %s, %s, %s, %s]}\n' \
    "$(ball '<&long name' 0.9 0.96 0 1.5 0 0 0)" "$(ball 12 0.8 0.9 0.2 0.86 0 0 0)" "$(ball cue 0.5 0.4 0.9 -0.1 40 60 90)" "$(ball 3 1.5 0.6 -0.4 0.5 0 0 -50)" \
    '{"id": "5", "state": [0, 1.9, 0.9, 0.028575, 0, 0, 0, 0, 0, 0]}'
} > odd.jsonl
carom shoot -o odd.out --plot odd.svg odd.jsonl
grep -o '"status": "[a-z]*"' odd.out
cat odd.svg
python - << 'PYTHON'
from drawn import labels_on_rails, small_letters
print(small_letters("odd.svg"), labels_on_rails("odd.svg"))
PYTHON
carom shoot --plot break.svg --id nosuch "$DATA/break-nineball.jsonl" > /dev/null || echo "exit $?"
echo "--- balls that fly"
carom shoot --events brief -o jumps.out --plot jump.svg "$DATA/shots-jumps.jsonl"
carom shoot --events brief --space flat -o flat.out --plot flat.svg "$DATA/shots-jumps.jsonl"
for id in jump off draw masse; do # the pictures of the docs
  carom shoot --events none --plot figure.svg --id $id -o figure.out "$DATA/shots-jumps.jsonl"
  cmp figure.svg "$DATA/../docs/figures/shot-$id.svg" && echo "as in the docs: $id"
done
python - << 'PYTHON'
import json
for name in ("jumps.out", "flat.out"):
    for shot in map(json.loads, open(name)):
        kinds = [event[1] for event in shot["events"]]
        met = [event[2] for event in shot["events"] if event[1] == "ball_ball"]
        print(name, shot["id"], shot["status"], kinds.count("slate"), "slate", kinds.count("left_table"), "left", "first hit", met[:1])
PYTHON
grep -c "<circle" jump.svg flat.svg
# the new numbers of a table, a cue and a ball are read: on a rail of 0.5 m the ball falls on its top, without restitution it does not hop
made() { printf '{"kind": "table", "id": "wide", "w": 2, "l": 2, %s "linear": [%s, %s, %s, %s]}\n' "$1" "$(rail left '0, 0' '0, 2' 0)" "$(rail right '2, 0' '2, 2' 1)" \
  "$(rail near '0, 0' '2, 0' 1)" "$(rail far '0, 2' '2, 2' 0)"; }
shot() { printf '{"kind": "shot", "id": "%s", "table": "wide", "cue": {"ball": "cue", "V0": 3, "phi": 90, "theta": 45, "tip_time": -1, "b": 0.3%s}, "balls": [{"id": "cue", "params": {%s}, "state": [0, 1, 1.6, 0.028575, 0, 0, 0, 0, 0, 0]}]}\n' "$1" "$2" "$3"; }
{
  made '"rail_width": 0.5, "ball_radius": 0.028575, "pocket_back": 0.04,'
  shot top '' ''
  shot dead '' '"e_t": -1'
  shot miscue ', "miscue": 0.25' ''
  shot wrong '' '"e_t": 1.5'
} > numbers.jsonl
try carom shoot --events brief -o numbers.out numbers.jsonl
grep '"shot"' numbers.out | sed 's/.*"n_events"/.../; s/"final".*"pockets": {}}/.../' | cut -c 1-400
echo "--- bad lines"
ball='{"id": "cue", "state": [0, 0.3, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}'
{
  echo "{\"kind\": \"shot\", \"id\": \"good\", \"cue\": {\"ball\": \"cue\", \"V0\": 1, \"b\": 0.25}, \"balls\": [$ball]}"
  echo 'no JSON'
  echo '{"id": 1}'
  echo '{"kind": "shot", "id": "no balls"}'
  echo '{"kind": "shot", "id": "text for a number", "cue": {"V0": "fast", "b": 0}, "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "no such ball", "cue": {"ball": "8"}, "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "no b", "cue": {"V0": 1}, "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "unknown key", "cue": {"V0": 1, "b": 0, "speed": 2}, "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "unknown number", "balls": [{"id": "cue", "params": {"u_ss": 0.2}, "state": [0, 1, 1, 0.028575, 0, 0, 0, 0, 0, 0]}]}'
  echo '{"kind": "shot", "id": "soft", "balls": [{"id": "cue", "params": {"modulus": 100000}, "state": [0, 0.5, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}]}'
  echo '{"kind": "shot", "id": "no such table", "table": "attic", "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "short state", "balls": [{"id": "cue", "state": [0, 1]}]}'
  echo '{"kind": "shot", "id": "twins", "balls": ['"$ball, $ball"']}'
  echo '{"kind": "shot", "id": "overlap", "balls": ['"$ball"', {"id": "2", "state": [0, 0.31, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}]}'
  echo '{"kind": "shot", "id": "no mass", "balls": [{"id": "cue", "params": {"m": 0}, "state": [0, 0.3, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}]}'
  echo '{"kind": "shot", "id": "miscue", "cue": {"a": 0.8, "b": 0.8}, "balls": ['"$ball"']}'
  echo '{"kind": "table", "id": "bad", "linear": [{"id": "1", "p1": [0, 0, 0.03]}]}'
  echo '{"kind": "other", "is": "ignored"}'
  echo "{\"kind\": \"shot\", \"id\": \"default cue\", \"unknown\": [], \"balls\": [$ball]}"
  for wrong in '"V0": -1' '"V0": 1001' '"phi": 1e10' '"theta": 91' '"M": 0' '"end_mass": -1' '"tip_restitution": 1.1' '"miscue": 1.1' '"tip_time": 0.02'; do
    echo "{\"kind\": \"shot\", \"id\": ${wrong%%:*}, \"cue\": {\"b\": 0, $wrong}, \"balls\": [$ball]}"
  done
  echo '{"kind": "shot", "id": "out of play", "cue": {"ball": "2"}, "balls": ['"$ball"', {"id": "2", "state": [4, 0, 0, -0.08, 0, 0, 0, 0, 0, 0]}]}'
} > bad.jsonl
carom shoot -o bad.out bad.jsonl || echo "exit $?"
sed 's/"table".*"final"/.../; s/"t": .*}, "pockets"/.../' bad.out
echo "--- a byte-order mark"
{
  printf '\357\273\277'
  cat "$DATA/break-nineball.jsonl"
} > mark.jsonl
carom shoot mark.jsonl | cmp - once.jsonl && echo "the same with one"
{
  printf '\357\273\277'
  grep -m 1 '"kind": "table"' recorded.jsonl
} > mark.jsonl
carom shoot mark.jsonl | head -c 15 && echo
echo "--- bounds"
try carom shoot --events-most 5 --events none - < "$DATA/break-nineball.jsonl" > bounds.out
grep -o '"status": "[a-z_]*"' bounds.out
echo "--- usage"
try_rows "shoot, usage"
echo "--- balls of a game, and what cushions and balls have of their own"
state='"state": [3, 0.7, 1.0, 0.03075, 0.6, 1.2, 0, -39.024390243902438, 19.512195121951219, 0]'
final() { carom shoot --cushion han --events none - | grep -o '"status".*\|"final": {"t": [0-9.]*'; }
shot() { printf '{"kind": "shot", "id": 1, "table": "%s", "balls": [{"id": "1", "params": {%s}, %s}]}\n' "$1" "$2" "$state"; }
shot threecushion '"game": "billiard"' | final
shot threecushion '"game": "billiard", "drag": 0, "roll_loss": 0' | final
shot threecushion '"game": "pooltool_billiard"' | final
shot threecushion '"game": "pooltool_billiard", "drag": 0.0129, "roll_loss": 0.087, "u_sp": 0.004, "law_a": 0.08, "e_c": 0.898, "f_c": 0.22, "u_s": 0.20591233435270132, "u_r": 0.0042609582059123337' | final
shot threecushion '"game": "chess"' | final || true
shot threecushion '"game": 7' | final || true
shot threecushion '"game": "billiard", "drag": 2' | final || true
shot threecushion '"game": "billiard", "nose_height": 0.07' | final || true
shot threecushion '"game": "billiard", "law_b": "x"' | final || true
own() {
  printf '{"kind": "table", "id": "own", "w": 1.42, "l": 2.84, "linear": ['
  printf '{"id": "%s", "p1": [%s, 0.037], "p2": [%s, 0.037], "direction": 1%s}%s' 3 '1.42, 0' '1.42, 2.84' "$1" ', ' 12 '1.42, 2.84' '0, 2.84' "$1" ', ' \
    9 '0, 2.84' '0, 0' "$1" ', ' 18 '0, 0' '1.42, 0' "$1" ']}'
  echo
}
{
  own ''
  shot own '"game": "billiard", "f_c": 0.3, "e_c": 0.7'
} | final
{
  own ', "f_c": 0.3, "e_c": 0.7'
  shot own '"game": "billiard"'
} | final
{
  own ', "f_c": 0.3, "e_c": 7'
  shot own '"game": "billiard"'
} | final || true
echo "--- a layout on each table is read again"
for table in $(carom shoot --complete --table ""); do
  carom shoot --table "$table" --cue 0.5,0.6 --balls 0.5,1.1 --json > layout.jsonl
  carom shoot -o again.jsonl layout.jsonl
  echo "$table: $(grep -o '"game": "[^"]*"' layout.jsonl | sort -u), $(grep -o '"status": "[a-z]*"' again.jsonl)"
done
