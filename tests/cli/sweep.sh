# sweep is resolve row by row: with a law of friction, which depends on what is varied, and over velocities and spins.
export CAROM_ISA=plain # for digits that are the same everywhere
cat > rows.py <<'PYTHON'
import csv, math, sys
# rows.py FILE ID OVER FROM TO POINTS: the collisions that a sweep resolves, one a row.
file, name, over, low, high, points = sys.argv[1], sys.argv[2], sys.argv[3], float(sys.argv[4]), float(sys.argv[5]), int(sys.argv[6])
reader = csv.DictReader(open(file))
row = next(row for row in reader if row["id"] == name)
out = csv.DictWriter(sys.stdout, reader.fieldnames, extrasaction="ignore", lineterminator="\n")
out.writeheader()
for k in range(points):
    value, one = low + (high - low) * (k / (points - 1)), dict(row, id=k)
    number = lambda name: float(row[name])
    if over == "cut":
        angle, x, y = value * (math.pi / 180), number("r2x") - number("r1x"), number("r2y") - number("r1y")
        one["r2x"] = repr(number("r1x") + x * math.cos(angle) - y * math.sin(angle))
        one["r2y"] = repr(number("r1y") + x * math.sin(angle) + y * math.cos(angle))
    elif over == "speed":
        share = value / math.hypot(number("v1x"), number("v1y"))
        one.update({a + b + c: repr(number(a + b + c) * share) for a in "vw" for b in "12" for c in "xyz"})
    elif over == "u_s":
        one.update(u_s1=repr(value), u_s2=repr(value))
    else:
        one[over] = repr(value)
    out.writerow(one)
PYTHON
# compare OVER FROM TO ARGUMENTS...
compare() {
  over=$1 from=$2 to=$3
  shift 3
  python rows.py "$DATA/collisions-204.csv" pooltool-135 "$over" "$from" "$to" 41 > rows.csv
  carom resolve "$@" rows.csv 2> /dev/null | tail -n +2 | cut -d, -f2-14 > resolved.csv
  carom sweep --id pooltool-135 --over "$over" --from "$from" --to "$to" --points 41 "$@" > swept.csv
  grep -v '^#' swept.csv | tail -n +2 | cut -d, -f6-18 | cmp - resolved.csv && echo "same: $over $*"
}
compare cut -40 40 --friction alciatore
compare speed 0.1 4 --friction alciatore
compare w1z -60 60 --friction alciatore
compare speed 0.1 4
compare u_s 0 0.5
compare e_b 0.1 1 --slip pooltool
compare v2x -0.5 0.5 --solver euler --steps 100
carom sweep --id pooltool-135 --over speed --from 0.1 --to 4 --points 41 --friction alciatore --brief |
  awk -F, '/^exact/ { n++; falls += n == 1 || $(NF - 1) < last; last = $(NF - 1) } END { print n, falls, "the friction falls with the speed" }'
try carom sweep --id pooltool-135 --over u_b --from 0 --to 1 --friction alciatore
echo "speed is in m/s, the rows swept are what resolve reads, and notes can be left out:"
carom hit --csv > hit.csv
carom sweep --id stun --over speed --from 0.5 --to 3 --points 3 --brief --no-comments --friction alciatore hit.csv > swept
carom sweep --id stun --over speed --from 0.5 --to 3 --points 3 --rows --friction alciatore hit.csv | carom resolve --derived - > derived
paste -d ' ' swept derived | awk 'NR > 1 { split($1, a, ","); split($2, b, ","); print a[2], b[1], a[3] == b[15] }'
for speed in 0.5 3; do carom hit --speed $speed --csv | carom resolve --derived - | tail -n 1 | cut -d, -f15; done
cut -d, -f3 swept | sed -n '2p;4p'
carom sweep --id stun --over speed --from 1 --to 2 --points 2 --brief hit.csv -o /dev/null
sed 's/,1.5,/,0,/' hit.csv > rests.csv
try carom sweep --id stun --over speed --from 1 --to 2 rests.csv
carom trace --id stun --points 2 --no-comments hit.csv | head -n 1 | cut -d, -f1
# What it writes is no table of rows, unless by --rows.
carom sweep --id stun --over cut --from 0 --to 10 --points 3 --friction alciatore hit.csv > swept.csv
try carom resolve swept.csv
carom sweep --rows --id stun --over cut --from 0 --to 10 --points 3 --friction alciatore hit.csv | carom resolve --derived - > derived.csv
python - <<'PYTHON'
import csv
swept = list(csv.DictReader(line for line in open("swept.csv") if line[0] != "#"))
derived = list(csv.DictReader(open("derived.csv")))
print([abs(float(a["throw_deg"]) - float(b["throw_deg"])) < 1e-9 for a, b in zip(swept, derived, strict=True)])
PYTHON
# The jump by its definition, from the results that are written: how far a step is outside of those before and after it.
cat > jumps.py <<'PYTHON'
import csv, sys
radius, numbers = float(sys.argv[1]), sys.argv[2].split()
curves, worst, most = {}, 0.0, 0.0
for row in csv.DictReader(line for line in open("swept.csv") if line[0] != "#"):
    curves.setdefault(next(iter(row.values())), []).append(row)
for rows in curves.values():
    points = [[float(row[name]) * (radius if name[0] == "w" else 1.0) for name in numbers] for row in rows]
    for k in range(1, len(points) - 2):
        one, two, three = ([b - a for a, b in zip(points[n], points[n + 1])] for n in (k - 1, k, k + 1))
        outside = max(0.0, *(max(y - max(x, z), min(x, z) - y) for x, y, z in zip(one, two, three)))
        jump = outside / max(map(abs, points[k]))
        worst, most = max(worst, abs(jump - float(rows[k]["jump"]))), max(most, jump)
print(len(curves), "curves,", "the jumps are those of the results" if worst < 1e-12 < most else (worst, most))
PYTHON
pair=$(for ball in 1 2; do for name in v w; do for axis in x y z; do printf '%s ' $name$ball$axis; done; done; done)
for over in w1x w2y; do
  carom sweep --id pooltool-135 --over $over --from -60 --to 60 --points 41 --solver exact,euler > swept.csv 2> /dev/null
  python jumps.py 0.03075 "$pair"
done
carom sweep --cushion --id public-000:16 --over wx --from -60 --to 60 --points 41 "$DATA/cushion-stronge.csv" > swept.csv
python jumps.py 0.028575 "vx vy vz wx wy wz"
