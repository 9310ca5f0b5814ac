# --cushion: impacts of a ball on a cushion, resolved, followed, swept.
cat > impacts.csv <<END
id,vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e
side,0.5,1.2,0,0,0,30,0.028,0.17,0.036,0.2,0.2,0.85
high,0.5,1,0,0,0,0,0.028,0.17,0.06,0.2,0.2,0.9
word,x,1,0,0,0,0,0.028,0.17,0.036,0.2,0.2,0.9
away,1,-1,0,0,0,0,0.028,0.17,0.036,0.2,0.2,0.9
END
echo "--- resolve"
try carom resolve --cushion -o after.csv impacts.csv
cut -d, -f1,8 after.csv
{ printf '\357\273\277'; cat impacts.csv; } | carom resolve --cushion - 2> /dev/null | cmp - after.csv && echo "the same with a byte-order mark"
for model in stronge han mirror euler; do
  carom resolve --cushion --model $model impacts.csv 2> /dev/null | awk -F, -v model=$model '$1 == "side" { printf "%s %.4f %.4f %.3f\n", model, $2, $3, $7 }'
done
row=",1,1,0,0,0,0,0.028,-1,0.036,0.2,0.2,0.9"
{
  head -n 1 impacts.csv
  printf '\033[2J\302\233id%s\n' "$row"
  printf "%60s$row\n%61s$row\n%300s$row\n" . . . | tr ' ' _
} > ids.csv
carom resolve --cushion ids.csv 2>&1 > ids.out | LC_ALL=C sed 's/[^ -~]/<a byte>/g'
cut -d, -f1 ids.csv > ids
cut -d, -f1 ids.out | cmp - ids && echo "the ids are whole"
echo "--- what collisions have: --derived, --summary, --strict, --precision, arrays"
carom resolve --cushion --derived -o derived.csv impacts.csv 2> /dev/null || echo "exit $?"
python - <<'PYTHON'
import csv, math
before = {row["id"]: row for row in csv.DictReader(open("impacts.csv"))}
after = {row["id"]: row for row in csv.DictReader(open("derived.csv"))}
a, b = ({k: float(x) for k, x in row["side"].items() if k not in ("id", "status")} for row in (before, after))
R = a["R"]
roll = [(5 * b["vx"] + 2 * R * b["wy"]) / 7, (5 * b["vy"] - 2 * R * b["wx"]) / 7]
energy = lambda m: sum(m["v" + k] ** 2 + 0.4 * R * R * m["w" + k] ** 2 for k in "xyz")
from_normal = lambda x, y: math.degrees(math.atan2(-x, abs(y)))
expected = [from_normal(a["vx"], a["vy"]), from_normal(b["vx"], b["vy"]), from_normal(*roll), *roll, 1 - energy(b) / energy(a)]
print([name for name in b][6:], all(abs(x - y) < 1e-9 for x, y in zip(expected, list(b.values())[6:])))
print({name: {row[k] for k in list(row)[8:]} for name, row in after.items() if row["status"] != "ok"})
PYTHON
try carom resolve --cushion --summary --model han -o /dev/null "$DATA/cushion-stronge.csv" 2>&1 | sed 's/;.*//'
# Millimetres and grams, and a ball that no cue can drive so fast.
awk -F, -v OFS=, '$1 == "side" { $8 *= 1000; $9 *= 1000; $10 *= 1000; print; $8 /= 1000; $9 /= 1000; $10 /= 1000; $1 = "fast"; $3 = 60; print; $3 = 1; $9 *= 1000; $1 = "heavy"; print; next } NR == 1' impacts.csv > units.csv
try carom resolve --cushion -o /dev/null units.csv
try carom resolve --cushion --strict units.csv
python - <<'PYTHON'
import csv, numpy as np
names = "vx vy vz wx wy wz nx ny h R M mu_s mu_w e rho".split()
rows = list(csv.DictReader(open("impacts.csv")))
a = np.array([[float(row.get(name, {"ny": 1}.get(name, 0))) for name in names] for row in rows if row["id"] != "word"])
np.save("y.npy", a), np.save("y4.npy", a.astype("f4")), np.save("narrow.npy", a[:, :14]), np.save("many.npy", np.tile(a.astype("f4"), (700, 1)))
PYTHON
try carom resolve --cushion -o out.npy y.npy
try carom resolve --cushion -o single.npy y4.npy 2> /dev/null
try carom resolve --cushion --precision single -o rounded.npy y.npy 2> /dev/null
try carom resolve --cushion --precision double -o wide.npy y4.npy 2> /dev/null
try carom resolve --cushion -o out.npy narrow.npy
carom resolve --cushion -o many_out.npy many.npy 2> /dev/null || echo "exit $?"
python - <<'PYTHON'
import csv, numpy as np
out, single, rounded, wide = (np.load(name + ".npy") for name in ("out", "single", "rounded", "wide"))
text = np.array([[float(x) for x in row[1:7]] for row in list(csv.reader(open("after.csv")))[1:] if row[0] != "word"])
print(out.dtype, out.shape, "same as CSV" if out.tobytes() == text.tobytes() else "differs", np.isnan(out).all(axis=1))
print("each of many as alone:", np.array_equal(np.load("many_out.npy"), np.tile(single, (700, 1)), equal_nan=True))
print(rounded.dtype, np.array_equal(rounded, single, equal_nan=True), wide.dtype, np.array_equal(single, wide.astype("f4"), equal_nan=True))
PYTHON
carom trace --cushion --id 1 --points 2 y.npy | tail -n 1 | awk -F, '{ printf "%s %.9f %.9f %s\n", $1, $2, $3, $4 }'
echo "--- pooltool's records, largest difference"
for name in stronge mathavan2010; do
  model=stronge; [ $name = stronge ] || model=euler
  carom resolve --cushion --model $model --convention pooltool --least-step 0.001 "$DATA/cushion-$name.csv" > now.csv
  cut -d, -f17-22 "$DATA/cushion-$name.csv" | paste -d, now.csv - | awk -F, -v name=$name 'NR > 1 { worst = 0
    for (k = 2; k <= 7; k++) { d = $k - $(k + 7); if (d < 0) d = -d; if (k > 4) d *= 0.03; if (d > worst) worst = d }
    if (worst < 1e-9) near++ } END { print name, near " of " NR - 1 " within 1e-9" }'
done
echo "--- the normal, and a jaw"
printf 'vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e,nx,ny,rho\n1.2,-0.5,0,0,0,30,0.028,0.17,0.036,0.2,0.2,0.85,7,0,0.02\n' | carom resolve --cushion - |
  awk -F, 'NR > 1 { printf "%s %.9f %.9f\n", $1, $2, $3 }'
awk -F, '$1 == "side" { printf "%s %.9f %.9f\n", $1, $3, -$2 }' after.csv
echo "--- trace"
carom trace --cushion --id side --points 101 impacts.csv > noted.csv
grep '^#' noted.csv
grep -v '^#' noted.csv > trace.csv
head -n 1 trace.csv
awk -F, 'NR > 1 && ($12 != $14 || $13 != $15) { print "not in the axes of the cushion" }' trace.csv
tail -n 1 trace.csv | cut -d, -f14-19 > end
awk -F, '$1 == "side"' after.csv | cut -d, -f2-7 | paste -d, end - | awk -F, '{ for (k = 1; k <= 6; k++) { d = $k - $(k + 6); if (d * d > 1e-12) print k, d } print "ends at the result" }'
awk -F, 'NR > 1 { n[$4]++; stuck += $5 } END { print n["compression"], n["restitution"], stuck " stuck" }' trace.csv
try carom trace --cushion --id side --model han impacts.csv
try carom trace --cushion --id high impacts.csv
try carom trace --cushion --id none impacts.csv
carom trace --cushion --id away --points 2 impacts.csv 2>&1 | grep -v '^#' | cut -d, -f1-4
echo "--- pictures"
carom trace --cushion --id side --points 101 --plot side.svg impacts.csv
python - <<'PYTHON'
import csv, xml.etree.ElementTree as tree
page = tree.parse("side.svg").getroot()
texts = ["".join(e.itertext()).strip() for e in page.iter("{http://www.w3.org/2000/svg}text")]
print([t for t in texts if t.startswith(("Impact", "side:", "0.2 with", "The exact", "slip", "velocity", "work", "it sticks")) or t in ("along", "into it", "upwards")])
from curves import curves, shows
rows = list(csv.DictReader(line for line in open("noted.csv") if not line.startswith("#")))
column = lambda name: [float(row[name]) for row in rows]
names = ["s_x_m_s", "s_t_m_s", "c_x_m_s", "c_y_m_s", "v_x_m_s", "v_y_m_s", "work_J"]
print([shows(points, column("impulse_N_s"), column(name)) for (_, points), name in zip(curves("side.svg"), names, strict=True)])
PYTHON
carom trace --cushion --id side --model euler --plot side.png -o side.csv impacts.csv && head -c 4 side.png | tail -c 3 && echo && grep -c -v '^#' side.csv
(PATH=/nowhere && try "$CAROM" trace --cushion --id side --plot none.svg -o kept.csv impacts.csv)
ls none.svg kept.csv 2>&1 | sed 's/^ls: [^:]*none.svg.*/no none.svg/'
try carom trace --cushion --id away --plot none.svg impacts.csv
echo "--- sweep"
for model in mathavan euler; do
  carom sweep --cushion --id side --model $model --over wz --from -60 --to 60 impacts.csv | grep -v '^#' |
    awk -F, -v model=$model 'NR > 3 && $3 != "nan" && $3 > jump { jump = $3 } END { print model, NR - 1, (jump < 1e-6 ? "smooth" : jump > 1e-5 ? "jumps" : "so so") }'
done
try carom sweep --cushion --id side --over e --from 0.9 --to 1.1 --points 3 -o errors.csv impacts.csv
grep -v '^#' errors.csv | cut -d, -f2,10
carom sweep --cushion --id side,away --over angle --from -10 --to 10 --points 3 --brief impacts.csv | awk -F, '/^[^m]/ || /^model/ { print; next } { printf "%s %s %s %.9f %s\n", $1, $2, $4, $5, $6 }'
# Turning the cushion by an angle is turning the ball the other way.
carom sweep --cushion --id side --over angle --from 30 --to 60 --points 2 impacts.csv | awk -F, '/^mathavan/ { print $2, $11 }' > turned
awk -F, -v OFS=, -v CONVFMT=%.17g '$1 == "side" || NR == 1 { if (NR > 1) { a = -atan2(0, -1) / 6; x = $2 * cos(a) - $3 * sin(a); $3 = $2 * sin(a) + $3 * cos(a); $2 = x } print }' impacts.csv > other.csv
carom resolve --cushion --derived other.csv | awk -F, 'NR == FNR { split($0, seen, " "); if (FNR == 1) first = seen[2]; next } FNR == 2 { d = first - $10; print (d * d < 1e-12 ? "the same angle" : d) }' turned -
carom sweep --cushion --id side --over speed --from 0.5 --to 2 --points 11 --plot swept.svg impacts.csv && grep -c '</svg>' swept.svg
try carom sweep --cushion --id side --over id --from 0 --to 1 impacts.csv
try carom sweep --cushion --id side impacts.csv
echo "--- usage"
try carom resolve --cushion
try carom resolve --cushion --model bumper impacts.csv
try carom resolve --cushion --least-step -1 impacts.csv
try carom resolve --cushion --solver exact impacts.csv
try carom resolve --law han "$DATA/collisions-204.csv"
try carom sweep --cushion --friction 0.1 --id side --over wz --from 0 --to 1 impacts.csv
try carom trace --cushion --id side
try carom resolve --cushion missing.csv
printf 'vx,vy,vz,wx,wy,wz,R,M,h,mu_s,nx\n' > short.csv
try carom resolve --cushion short.csv
