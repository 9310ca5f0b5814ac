# Help, version and the lists of the study's program, as its user sees them.
try lab --help
lab --version | sed 's/[0-9][0-9]*/N/g'
try lab kernels --help
python -m wrapped "$LAB" paper kernels resolve verify bench bounds stress plan learn trace experiments published
echo "--- the table"
try lab kernels | sed 's/  */ /g; /^configurations/s/:.*/:/; / avx512 /d' # what depends on the machine, as the widths of columns do
lab kernels --csv -o kernels.csv
python -c 'import csv; rows = list(csv.DictReader(open("kernels.csv"))); print(len(rows), [k for k in rows[1]], [r["kernel"] for r in rows if not r["parent"]])'
echo "--- the examples do what they show"
cp "$DATA/collisions-204.csv" before.csv
for command in "" kernels resolve verify bench trace experiments; do
  example=$(lab $command --help | sed -n '/^example:$/{n;p;q;}' | sed -n 's/^  carom-lab //p' | sed 's/--budget [0-9]*/--budget 0.1/')
  [ -n "$example" ] && eval "lab $example" > said 2>&1 || {
    echo "the example of '$command' fails:"
    cat said
  }
done
ls
