# Input that can be resolved but hardly was meant: a warning with a count and a guess, and --strict refuses it.
export CAROM_ISA=plain # for digits that are the same everywhere
head -n 4 "$DATA/collisions-204.csv" > few.csv
# scaled FACTOR COLUMN...: the same with the columns that begin so multiplied
scaled() {
  python - "$@" << 'PYTHON'
import csv, sys
rows = list(csv.DictReader(open("few.csv")))
out = csv.DictWriter(sys.stdout, rows[0], lineterminator="\n")
out.writeheader()
for row in rows:
    out.writerow({k: repr(float(v) * float(sys.argv[1])) if k.startswith(tuple(sys.argv[2:])) else v for k, v in row.items()})
PYTHON
}
for factor in 1 1.009 1.02 0.9 100 1000 0.5 0.01 0.001; do
  scaled $factor r1 r2 > in.csv
  echo "positions times $factor:"
  try carom resolve -o /dev/null in.csv
done
scaled 100 v1 v2 > fast.csv
try carom resolve -o /dev/null fast.csv
scaled 1000 w1 w2 > spin.csv
try carom resolve -o /dev/null spin.csv
echo "one of three, and with --strict:"
scaled 100 r1 r2 | awk 'NR == FNR { if (FNR == 3) line = $0; next } FNR == 3 { $0 = line } 1' - few.csv > one.csv
try carom resolve -o out.csv one.csv
carom resolve few.csv | sed 3d > good.csv
sed 3d out.csv | cmp - good.csv && echo "the others are as they were"
try carom resolve --strict -o out.csv one.csv
sed -n 3p out.csv
sed 3d out.csv | cmp - good.csv && echo "the others are as they were"
try carom resolve --strict fast.csv | cut -d, -f14
try carom resolve --strict --precision single spin.csv | cut -d, -f2,14
echo "tips so far from the centre that they slip off the ball:"
for words in "hit --side 1tip --spin -0.4tip" "hit --side 1tip --spin -0.5tip" "rail --side 0,1,2tip --csv" "shoot --tip 0.3,0.4" "shoot --tip 0,0.51" "shoot --tip 0.2,0.4:0.9,0.1"; do
  # shellcheck disable=SC2086
  try carom $words > /dev/null
  # shellcheck disable=SC2086
  try carom $words --strict > strict.out
  wc -l < strict.out
done
sed '2{s/"b": [-0-9.e]*/"b": 0.6/;s/"a": [-0-9.e]*/"a": 0/}' "$DATA/shots-jumps.jsonl" > tips.jsonl
try carom shoot --strict --events none tips.jsonl | cut -c 1-150
sed -i '2s/"cue": {/&"miscue": 0.7, /' tips.jsonl
try carom shoot --strict --events none tips.jsonl | grep -c '"status": "ok"'
echo "two values that look like one:"
for words in "--speed 1,5" "--speed 1,5mph" "--restitution 0,90" "--radius 28,575mm" "--cut 22,5" "--cut 22,5deg" "--cut 0,40" "--speed 1,5,7" "--cut 20,30" "--cut 5,5.5" "--side 0,50%" "--speed 1.0,5.0" "--speed 1,5:7"; do
  # shellcheck disable=SC2086
  {
    try carom hit $words
    try carom hit --strict $words
  } | grep exit
done
try carom shoot --speed 1,5 --strict
try carom shoot --cue 1,1 --strict | head -n 1
try carom shoot --time-most 0,5 "$DATA/shots-jumps.jsonl"
echo "rows in error are not asked about, and no time is told of work below 10 ms:"
sed '2,$s/^\([^,]*\),[^,]*,[^,]*/\1,,nan/' few.csv > bad.csv
try carom resolve --summary -o /dev/null bad.csv
try carom resolve --summary -o /dev/null few.csv
