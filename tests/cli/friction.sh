# --friction replaces the column u_b by the speed law; the cases of pooltool were made with it.
carom resolve --solver euler --slip pooltool "$DATA/collisions-204.csv" > column.csv
carom resolve --solver euler --slip pooltool --friction alciatore "$DATA/collisions-204.csv" > law.csv
python - <<'PYTHON'
import csv
near = lambda a, b: all(abs(float(x) - float(y)) < 1e-9 * (1 + abs(float(x))) for x, y in zip(a[1:13], b[1:13]))
rows = list(zip(list(csv.reader(open("column.csv")))[1:], list(csv.reader(open("law.csv")))[1:]))
print(sum(near(a, b) for a, b in rows), "of", len(rows), "agree;", sum(near(a, b) for a, b in rows if a[0].startswith("pooltool")), "of pooltool's")
PYTHON
cut -d, -f1-24,26 "$DATA/collisions-204.csv" > without.csv
carom resolve --solver euler --slip pooltool --friction alciatore without.csv | cmp - law.csv && echo "the column may be missing"
try carom resolve --solver euler without.csv
carom resolve --solver euler --friction alciatore=0.05,0,1 "$DATA/collisions-204.csv" > constant.csv
awk -F, -v OFS=, 'NR > 1 { $25 = 0.05 } 1' "$DATA/collisions-204.csv" | carom resolve --solver euler - | cmp - constant.csv && echo "constants are taken"
try carom resolve --friction marlow x.csv
try carom resolve --friction alciatore=1,2 x.csv
try carom resolve --friction alciatore=2,0,0 "$DATA/collisions-204.csv" 2>&1 | tail -n 2 | cut -c 1-30,150-
