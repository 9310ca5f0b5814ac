# A build without CAROM_LADDER: what needs a kernel of the ladder says so; the library's own are verified and timed all the same.
try_rows "without a ladder"
lab kernels | tail -n 1
lab verify --kernel exact | sed -n 's/^\(exact, .*\):.*/\1/p'
echo "--- times: Euler's method of the library is the reference"
rows() { grep -v '^#' "$1"; }
lab bench --kernel exact --steps 10,50 --isa scalar --budget 0.2 --csv --spread --errors -o calls.csv
rows calls.csv | cut -d, -f1-6 | LC_ALL=C sort
lab bench --batch --kernel exact,euler --isa plain --threads 2 --pairs 64 --steps 20 --budget 0.2 --csv -o batches.csv
rows batches.csv | cut -d, -f1-6,12 | LC_ALL=C sort # rows come by time
