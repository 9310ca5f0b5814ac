# bench: the CSV's columns, its rows for kernels, configurations and steps, and what is refused. Times are not looked at.
rows() { grep -v '^#' "$1"; }
labels() { rows "$1" | cut -d, -f1,3-6; }
try carom bench --kernel euler --budget 1 --csv -o two.csv
rows two.csv | head -n 1
labels two.csv
rows two.csv | awk -F, 'NR > 1 && !($8 > 0 && $8 <= $7 && $7 <= $9 && $10 > 0 && $11 < 1e-6) { print "not as it should be: " $0 }'
echo "--- what stands before the figures"
sed -n 's/^# \([a-z ]*\): .*/\1/p' two.csv | grep -x -e processor -e pinning -e counters -e compiler -e flags -e commit -e date -e rounds | sort
grep -c -e '^# counters: NA: .' -e '^# counters: .*available' two.csv
echo "--- steps"
carom bench --kernel euler --steps 10,50 --steps 100 --budget 0.3 --csv -o steps.csv
labels steps.csv
echo "--- more columns"
carom bench --kernel euler --budget 0.3 --csv --spread --errors --counters -o more.csv
rows more.csv | head -n 1
rows more.csv | awk -F, 'NR > 1 { for (k = 1; k <= NF; k++) if ($k == "" || $k == "0" && k > 19) print "column " k " is bare"; print NF, $16 }'
echo "--- the table"
carom bench --kernel euler --budget 0.3 > table
grep -A1 '^kernel' table | sed 's/  */ /g' | head -n 1
grep -v '^#' table | awk 'NR > 2 { print $1, $4, $5 }'
echo "--- what differs from its reference is not timed"
mkdir data
cp "$DATA"/*.csv data
sed '2s/,-0.008/,-0.0081/' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
try carom bench --kernel euler --data data --budget 0.3 --csv -o refused.csv 2>&1 | sed 's/is [0-9.e-]* off/is ... off/' | grep -e euler -e exit
labels refused.csv
sed '2s/,-0.008/,-0.8/' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
try carom bench --kernel euler --data data --budget 0.3 --csv -o none.csv 2> none
ls none.csv 2>/dev/null || echo "nothing to time, no output"
echo "--- usage"
try carom bench now
try carom bench --kernel fast
try carom bench --kernel euler,fast
try carom bench --steps 0
try carom bench --steps 10,many
try carom bench --budget never
try carom bench --budget 0
try carom bench --counters
try carom bench --data nowhere
try carom bench --kernel base --config o4 2>&1 | sed 's/there are .*/there are .../'
try carom bench --kernel euler --budget 0.1 -o nowhere/out.csv
