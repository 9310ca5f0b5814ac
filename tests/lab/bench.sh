# bench: the CSV's columns, its rows for kernels, configurations and steps, and what is refused. Times are not looked at.
rows() { grep -v '^#' "$1"; }
labels() { rows "$1" | cut -d, -f1,3-6; }
# The batches' labels, with WIDE for any instruction set above plain: which there are depends on the processor.
lanes() { labels "$1" | grep -v -e scalar -e '^kernel' | sed -E 's/,(sse2|neon|avx2|avx512),/,WIDE,/' | sort -u; }
try lab bench --kernel euler --budget 1 --csv -o two.csv
rows two.csv | head -n 1
labels two.csv
rows two.csv | awk -F, 'NR > 1 && !($8 > 0 && $8 <= $7 && $7 <= $9 && $10 > 0 && $11 < 1e-6) { print "not as it should be: " $0 }'
echo "--- what stands before the figures"
sed -n 's/^# \([a-z ]*\): .*/\1/p' two.csv | grep -x -e processor -e pinning -e compiler -e flags -e commit -e date -e rounds | sort
echo "--- steps"
lab bench --kernel euler --steps 10,50 --steps 100 --budget 0.3 --csv -o steps.csv
labels steps.csv
echo "--- more columns"
lab bench --kernel euler --budget 0.3 --csv --spread --errors -o more.csv
rows more.csv | head -n 1
rows more.csv | awk -F, 'NR > 1 { for (k = 1; k <= NF; k++) if ($k == "") print "column " k " is bare"; print NF, $16 }'
echo "--- a kernel without steps: once, beside base with its default, however many are asked for"
lab bench --kernel exact --steps 10,50 --isa scalar --budget 0.2 --csv -o exact.csv
labels exact.csv
rows exact.csv | awk -F, '$1 == "exact" && !($10 > 5 && $11 <= 1e-6) { print "not as it should be: " $0 }'
echo "--- batches"
lab bench --kernel exact --threads 1,2 --budget 0.2 --csv -o batches.csv
rows batches.csv | head -n 1
labels batches.csv | grep scalar
lanes batches.csv
rows batches.csv | awk -F, '$1 == "exact" && !($2 == "library" && $7 > 0 && $10 > 0 && $11 <= ($4 == "double" ? 1e-6 : 2e-5)) { print "not as it should be: " $0 }'
sed -n 's/^# \(batches\): .*, \([0-9]* pairs\).*/\1: \2/p' batches.csv
echo "--- batches of every solver, in few pairs, of one instruction set and precision"
lab bench --batch --isa plain --precision double --threads 1 --pairs 1,7,300 --budget 0.2 --csv -o pairs.csv
rows pairs.csv | cut -d, -f1,3-6,12
rows pairs.csv | awk -F, '$1 == "euler" && $11 != 0 { print "not bit-identical: " $0 }'
lab bench --batch --kernel euler --isa best --precision single --steps 20 --threads 1 --pairs 64 --spread --errors --csv --budget 0.2 -o single.csv
lanes single.csv
rows single.csv | awk -F, '{ print $NF, NF }'
CAROM_ISA=plain "$LAB" bench --batch --kernel exact --precision single --threads 1 --pairs 64 --budget 0.1 --csv -o limited.csv
labels limited.csv
echo "--- the table"
lab bench --kernel euler --budget 0.3 > table
grep -A1 '^kernel' table | sed 's/  */ /g' | head -n 1
grep -v '^#' table | awk 'NR > 2 { print $1, $4, $5, $6 }'
echo "--- what differs from its reference is not timed"
mkdir data
cp "$DATA"/*.csv data
sed '2s/,-0.008/,-0.0081/' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
try lab bench --kernel euler --data data --budget 0.3 --csv -o refused.csv 2>&1 | sed 's/is [0-9.e-]* off/is ... off/' | grep -e euler -e exit
labels refused.csv
sed '2s/,-0.008/,-0.8/' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
try lab bench --kernel euler --data data --budget 0.3 --csv -o none.csv 2> none
ls none.csv 2>/dev/null || echo "nothing to time, no output"
sed '2s/,-0.008/,-0.009/' "$DATA/reference-exact-paper.csv" > data/reference-exact-paper.csv
try lab bench --kernel exact --isa plain --threads 1 --pairs 204 --data data --budget 0.3 --csv -o refused.csv 2>&1 | sed 's/is [0-9.e-]* off/is ... off/'
labels refused.csv 2> /dev/null || echo "nothing to time, no output"
echo "--- usage"
try lab bench --isa mmx 2>&1 | sed 's/best, .*/best, .../'
try env CAROM_ISA=plain "$LAB" bench --isa avx512
try lab bench --isa ,
try env CAROM_ISA=AVX2 "$LAB" bench
try lab bench --batch --kernel base
try lab bench --kernel exact --isa scalar --precision single
try lab bench --precision half
try lab bench --pairs 0
try lab bench --pairs ,
try lab bench --threads 1,none
try lab bench now
try lab bench --kernel fast
try lab bench --kernel euler,fast
try lab bench --steps 0
try lab bench --steps 10,many
try lab bench --budget never
try lab bench --budget 0
try lab bench --spread
try lab bench --shots "$DATA/shots-mathavan.jsonl" --pairs 8
try lab bench --shots nowhere.jsonl
try lab bench --data nowhere
try lab bench --kernel base --config o4 2>&1 | sed 's/there are .*/there are .../'
try lab bench --kernel euler --budget 0.1 -o nowhere/out.csv
