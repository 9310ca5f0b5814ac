# The main job: pooltool's own results, double for double, to a file, to stdout and from stdin.
try carom resolve --solver euler --slip pooltool -o out.csv "$DATA/collisions-204.csv"
cut -d, -f1-13 "$DATA/reference-pooltool-n1000.csv" > expected.csv
cut -d, -f1-13 out.csv > seen.csv
same_doubles seen.csv expected.csv && echo "same doubles"
python - <<'PYTHON'
import csv
texts = [text for row in list(csv.reader(open("seen.csv")))[1:] for text in row[1:]]
digits = lambda text: len(text.split("e")[0].replace(".", "").replace("-", "").strip("0"))
print(sum(digits(text) <= digits(repr(float(text))) for text in texts), "of", len(texts), "numbers have the fewest digits")
PYTHON
tail -n +2 out.csv | cut -d, -f14 | sort | uniq -c | sed 's/^ *//'
carom resolve --solver euler --slip pooltool "$DATA/collisions-204.csv" | cmp - out.csv && echo "same on stdout"
carom resolve --solver euler --slip pooltool - < "$DATA/collisions-204.csv" | cmp - out.csv && echo "same from stdin"
LC_ALL=de_DE.UTF-8 carom resolve --solver euler --slip pooltool "$DATA/collisions-204.csv" | cmp - out.csv && echo "same in German"
carom resolve --solver euler --slip pooltool --steps 999 "$DATA/collisions-204.csv" | cmp -s - out.csv || echo "steps matter"
carom resolve --solver euler "$DATA/collisions-204.csv" | cmp -s - out.csv || echo "slip matters"
