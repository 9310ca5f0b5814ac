# bench: the CSV's columns, its rows for kernels, configurations and steps, and what is refused. Times are looked at only for their order.
wide='s/,(sse2|neon|avx2|avx512),/,WIDE,/' # any instruction set above plain: which there are depends on the processor
timed() {
  echo "--- $*"
  lab bench --budget 0.2 --csv -o out.csv "$@" 2>&1 | sed 's/is [0-9.e-]* off/is ... off/'
  python - << 'PYTHON' | sed -E "$wide; s/ *$//" | awk '!seen[$0]++'
import csv
try:
    rows = list(csv.DictReader(line for line in open("out.csv") if not line.startswith("#")))
except OSError:
    raise SystemExit("nothing to time, no output")
print("also:", *list(rows[0])[11:])
for row in rows:
    x = {name: float(text) for name, text in row.items() if name.startswith(("ns", "speedup", "pair_error"))}
    bound = 0 if row["kernel"] == "euler" and row["isa"] == "plain" and row["steps"] == "1000" else 2e-5 if row["precision"] == "single" and row["kernel"] in ("exact", "fast") else 1e-6 if row["steps"] in ("0", "1000") and row["precision"] == "double" else 1
    good = 0 < x["ns_min"] <= x["ns_median"] <= x["ns_max"] and x["speedup"] > 0 and (x["pair_error_max"] <= bound or row["kernel"] == "base") and "" not in row.values() and None not in row
    print(",".join(row[name] for name in ("kernel", "isa", "precision", "threads", "steps", "pairs", "slip") if name in row), "" if good else f"not as it should be: {row}")
PYTHON
}
timed --kernel euler
sed -n 's/^# \([a-z ]*\): .*/\1/p' out.csv | grep -x -e processor -e pinning -e compiler -e flags -e commit -e date -e rounds | sort | tr '\n' ' '
timed --kernel euler --steps 10,50 --steps 100
timed --kernel euler --spread --errors
timed --kernel exact --counters --precision double --isa plain --threads 1,2
# a column is a number where the note says that it is counted, else NA; several threads are never counted
python - << 'PYTHON'
import csv, math
lines = open("out.csv").read().splitlines()
(note,) = [line for line in lines if line.startswith("# counters: ")]
counted = note.partition(": ")[2].partition(" counted per collision")[0].split(", ") if " counted per collision" in note else []
for row in csv.DictReader(line for line in lines if not line.startswith("#")):
    for name in list(row)[11:]:
        known = name in counted and row["threads"] == "1"
        if name not in note or (not 0 <= float(row[name]) < math.inf if known else row[name] != "NA"):
            print(f"{name}: {row[name]}, but the note is: {note}")
PYTHON
lab bench --kernel euler --counters --budget 0.1 | grep '^kernel' | tr -s ' '
timed --kernel exact --steps 10,50 --isa scalar
timed --kernel exact --slip pooltool,paper --isa scalar,plain --precision double --threads 1 # base has pooltool's only
timed --kernel exact --threads 1,2
sed -n 's/^# \(batches\): .*, \([0-9]* pairs\).*/\1: \2/p' out.csv
timed --batch --isa plain --precision double --threads 1 --pairs 1,7,300
timed --batch --kernel euler --isa plain,best --precision single --steps 20 --threads 1 --pairs 64 --spread --errors
CAROM_ISA=plain timed --batch --kernel exact --precision single --threads 1 --pairs 64
timed --kernel float --isa scalar --steps 50000 # more than its precision resolves: cases are left out
grep -c "^# left out: float" out.csv
timed --batch --kernel float_lanes_avx2,double_lanes_avx2 --steps 20 --pairs 1,17,4100 # a batch that is no multiple of the lanes
timed --kernel float_lanes_avx2,exact --isa avx2 --precision single --threads 1
sed -n 's/^# \(lanes of the ladder\): .*, \([0-9]* pairs\).*/\1: \2/p' out.csv
timed --kernel float_lanes_avx2 --steps 20000
grep "^# left out: float_lanes" out.csv | sed 's/: [0-9]* of/: N of/'
lab bench --kernel double,double_lanes_avx2,fast,exact,euler --isa scalar,avx2 --precision double --budget 0.3 | grep -v '^#' | awk 'NR > 1 { print $1, $3 }' # the ladder first
lab bench --kernel euler --budget 0.3 | grep -v '^#' | awk '{ print $1, $4, $5, $6 }'
echo "--- cushions"
lab bench --cushions --budget 0.2 --csv | grep -v '^#' | awk -F, 'NR == 1 { print } NR > 1 { print $1, ($2 > 0 && $3 >= 0 && $4 > 0 && ($4 == 1) == ($1 == "han") ? "" : $0) }'
rm out.csv
mkdir data
cp "$DATA"/*.csv data
changed() { sed "2s/,-0.008/,$2/" "$DATA/$1" > "data/$1"; }
changed reference-pooltool-n1000.csv -0.0081
timed --kernel euler --data data
rm out.csv
changed reference-pooltool-n1000.csv -0.8
timed --kernel euler --data data 2> /dev/null | tail -n 1
changed reference-exact-paper.csv -0.009
timed --kernel exact --isa plain --threads 1 --pairs 204 --data data
echo "--- shots that pooltool recorded"
lab bench --shots "$DATA/shots-pooltool.jsonl" --world pooltool | grep -v '^#' | cut -c1-30
lab bench --shots "$DATA/shots-mathavan.jsonl" --threads 2 --budget 0.2 --csv -o shots.csv
grep -v '^#' shots.csv | awk -F, 'NR > 1 { print $1, NF, ($5 > 0 && $6 > 0 && $8 > 1 ? "timed" : "not timed: " $0) }' | tail -n 1
echo "--- usage"
try lab bench --isa mmx 2>&1 | sed 's/best, .*/best, .../'
try env CAROM_ISA=plain "$LAB" bench --isa avx512
try env CAROM_ISA=AVX2 "$LAB" bench
try lab bench --precision half
try lab bench --slip papr
try lab bench --kernel base --slip paper
try lab bench now
for words in "--isa ," "--batch --kernel base" "--kernel exact --isa scalar --precision single" "--pairs 0" "--pairs ," "--threads 1,none" "--kernel euler,faster" "--steps 10,many" \
  "--budget never" "--budget 0" "--budget 1x" "--spread" "--shots $DATA/shots-mathavan.jsonl --pairs 8" "--cushions --shots nowhere.jsonl" "--cushions --threads 2" "--cushions --kernel exact" "--cushions --counters" "--shots nowhere.jsonl" "--data nowhere"; do
  # shellcheck disable=SC2086
  try lab bench $words
done
try lab bench --kernel base --config o4 2>&1 | sed 's/there are .*/there are .../'
try lab bench --kernel euler --budget 0.1 -o nowhere/out.csv
