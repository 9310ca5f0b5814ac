# Ladder kernels by --kernel and --config, and what is refused.
lab resolve --kernel base --config o3 --slip pooltool "$DATA/collisions-204.csv" > base.csv
lab resolve --kernel euler --slip pooltool "$DATA/collisions-204.csv" > euler.csv
cmp base.csv euler.csv && echo "the direct port is euler"
lab resolve --kernel cse --slip pooltool "$DATA/collisions-204.csv" > cse.csv
lab resolve --kernel cse --config default --slip pooltool "$DATA/collisions-204.csv" | cmp - cse.csv && echo "default is the default"
try lab resolve --kernel euler --config o3 "$DATA/collisions-204.csv"
try lab resolve --kernel cse --config o4 "$DATA/collisions-204.csv" 2>&1 | sed 's/there are .*/there are .../'
try lab verify --config o4 2>&1 | sed 's/there are .*/there are .../'
try lab resolve --kernel base --precision single x.csv
lab verify --kernel double --config o3 | cut -d' ' -f1
lab verify | sed -n '/^ladder/s/[0-9][0-9.]*\(e-[0-9]*\)\{0,1\}/N/gp'
mkdir data
cp "$DATA"/*.csv data
sed '2s/,-0.008/,-0.009/' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
lab verify --kernel double --config o3 --data data | tail -n 2 | sed 's/most [0-9]* of/most N of/' # the estimate differs between processors
echo "--- a small component that is off by 2 %: within our bound, not within the seed paper's 1 %"
python - "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv << 'PYTHON'
import sys
lines = open(sys.argv[1]).read().splitlines()
row = lines[1].split(",")
sizes = [abs(float(x)) for x in row[1:13]]
least = min((x, k) for k, x in enumerate(sizes) if x > 1e-9 * max(sizes))[1] + 1
row[least] = repr(float(row[least]) * 1.02)
print("\n".join([lines[0], ",".join(row), *lines[2:]]))
PYTHON
lab verify --kernel base --config o3 --data data --csv | cut -d, -f1,2,14-21 | sed 's/clang-\|gcc-//'
echo "--- other steps: against Euler's method with as many; what single precision does not resolve is left out"
for steps in 100 1000 2000 5000; do
  lab verify --kernel float --config default --steps $steps --csv | awk -F, 'NR > 1 { print $1, $4, $5, $6 + $7, $17, $19, $20, ($7 > 0 ? "refused" : "all") }'
done
lab verify --kernel base --config o3 --steps 777 --csv | awk -F, 'NR > 1 { print $1, $4, $8, $12 }'
lab verify --kernel exact --steps 10 --csv | wc -l
try lab verify --steps none
{
  sed '1s/,M,/,M1,M2,/; 1q' "$DATA/collisions-204.csv"
  echo unequal,hand,0,0,0,0,1,0,0,0,0,0,0.06,0,0,0,0,0,0,0,0.03,0.17,0.16,0.2,0.2,0.05,0.95
  echo slow,hand,0,0,0,0,1e-18,0,0,0,0,0,0.06,0,0,0,0,0,0,0,0.03,0.17,0.17,0.2,0.2,0.05,0.95
  echo good,hand,0,0,0,0,1,0,0,0,0,0,0.06,0,0,0,0,0,0,0,0.03,0.17,0.17,0.2,0.2,0.05,0.95
} > mixed.csv
try lab resolve --kernel float mixed.csv -o out.csv
sed 's/,.*,/ /' out.csv
