# The main job: pooltool's own results, double for double, to a file, to stdout and from stdin.
try carom resolve --solver euler --slip pooltool -o out.csv "$DATA/collisions-204.csv"
cut -d, -f1-13 "$DATA/reference-pooltool-n1000.csv" > expected.csv
cut -d, -f1-13 out.csv > seen.csv
same_doubles seen.csv expected.csv && echo "same doubles"
python - << 'PYTHON'
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
echo "--- --friction replaces the column u_b by the speed law; the cases of pooltool were made with it"
carom resolve --solver euler --slip pooltool --friction alciatore "$DATA/collisions-204.csv" > law.csv
python - << 'PYTHON'
import csv
near = lambda a, b: all(abs(float(x) - float(y)) < 1e-9 * (1 + abs(float(x))) for x, y in zip(a[1:13], b[1:13]))
rows = list(zip(list(csv.reader(open("out.csv")))[1:], list(csv.reader(open("law.csv")))[1:]))
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
echo "--- pairs that do not approach come back unchanged, and that is no error"
try carom resolve -o apart.csv "$DATA/separating-20.csv"
tail -n +2 apart.csv | cut -d, -f14 | sort | uniq -c | sed 's/^ *//'
tail -n +2 "$DATA/separating-20.csv" | cut -d, -f1,6-11,15-20 > before
tail -n +2 apart.csv | cut -d, -f1-13 > after
same_doubles after before && echo unchanged
echo "--- a million rows, most of them quick to refuse, in less than 64 MiB of memory, and a good row at the end"
rows=1000000
{
  head -n 2 "$DATA/collisions-204.csv"
  yes "x,,,,,,,,,,,,,,,,,,,,,,,,,1" | head -n $((rows - 2))
  sed -n 2p "$DATA/collisions-204.csv"
} > big.csv
# The limit is on address space, of which the sanitizers need terabytes: with them only the result is tested.
limit="ulimit -v 65536"
(
  eval "$limit"
  carom --version > /dev/null 2>&1
) || limit=:
(
  eval "$limit"
  try carom resolve --solver euler -o big_out.csv big.csv 2> /dev/null
)
wc -l < big_out.csv
sed -n '2p;$p' big_out.csv | cut -d, -f14
echo "--- the time that the solver took is within the time of the whole command, and so many times that of a row"
python - << 'PYTHON'
import os, re, subprocess, time
rows = open(os.environ["DATA"] + "/collisions-204.csv").read().splitlines()
with open("timed.csv", "w") as file:
    file.write("\n".join(rows[:1] + 50 * rows[1:]) + "\n")
command = [os.environ["CAROM"], "resolve", "--summary", "--solver", "euler", "-o", "timed_out.csv", "timed.csv"]
begin = time.monotonic()
said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
whole = time.monotonic() - begin
count, took, each = map(float, re.search(r"(\d+) ok.* took (\S+) s, (\S+) us", said).groups())
# On several processors rows are solved at once, but this is time that passes, of three digits.
print("within it" if 0.01 <= took <= 1.01 * whole else said)
print("that of a row" if abs(1e6 * took / count - each) <= 0.01 * each else said)
PYTHON
