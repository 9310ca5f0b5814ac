# --cushion: impacts of a ball on a cushion.
cat > impacts.csv << END
id,vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e
side,0.5,1.2,0,0,0,30,0.028,0.17,0.036,0.2,0.2,0.85
high,0.5,1,0,0,0,0,0.028,0.17,0.06,0.2,0.2,0.9
word,x,1,0,0,0,0,0.028,0.17,0.036,0.2,0.2,0.9
away,1,-1,0,0,0,0,0.028,0.17,0.036,0.2,0.2,0.9
END
echo "--- resolve"
try carom resolve --cushion -o after.csv impacts.csv
cut -d, -f1,8 after.csv
{
  printf '\357\273\277'
  cat impacts.csv
} | carom resolve --cushion - 2> /dev/null | cmp - after.csv && echo "the same with a byte-order mark"
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
python - << 'PYTHON'
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
python - << 'PYTHON'
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
python - << 'PYTHON'
import csv, numpy as np
out, single, rounded, wide = (np.load(name + ".npy") for name in ("out", "single", "rounded", "wide"))
text = np.array([[float(x) for x in row[1:7]] for row in list(csv.reader(open("after.csv")))[1:] if row[0] != "word"])
print(out.dtype, out.shape, "same as CSV" if out.tobytes() == text.tobytes() else "differs", np.isnan(out).all(axis=1))
print("each of many as alone:", np.array_equal(np.load("many_out.npy"), np.tile(single, (700, 1)), equal_nan=True))
print(rounded.dtype, np.array_equal(rounded, single, equal_nan=True), wide.dtype, np.array_equal(single, wide.astype("f4"), equal_nan=True))
PYTHON
echo "--- pooltool's records, largest difference"
for name in stronge mathavan2010; do
  model=stronge
  [ $name = stronge ] || model=euler
  carom resolve --cushion --model $model --convention pooltool --least-step 0.001 "$DATA/cushion-$name.csv" > now.csv
  cut -d, -f17-22 "$DATA/cushion-$name.csv" | paste -d, now.csv - | awk -F, -v name=$name 'NR > 1 { worst = 0
    for (k = 2; k <= 7; k++) { d = $k - $(k + 7); if (d < 0) d = -d; if (k > 4) d *= 0.03; if (d > worst) worst = d }
    if (worst < 1e-9) near++ } END { print name, near " of " NR - 1 " within 1e-9" }'
done
echo "--- the normal, and a jaw"
printf 'vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e,nx,ny,rho\n1.2,-0.5,0,0,0,30,0.028,0.17,0.036,0.2,0.2,0.85,7,0,0.02\n' | carom resolve --cushion - |
  awk -F, 'NR > 1 { printf "%s %.9f %.9f\n", $1, $2, $3 }'
awk -F, '$1 == "side" { printf "%s %.9f %.9f\n", $1, $3, -$2 }' after.csv
echo "--- usage"
try_rows "cushion, usage"
printf 'vx,vy,vz,wx,wy,wz,R,M,h,mu_s,nx\n' > short.csv
try carom resolve --cushion short.csv
