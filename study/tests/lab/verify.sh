# verify passes on the real references and fails when a reference is wrong.
lab verify > table
echo "exit $?"
grep -c '^euler *library  .*pass' table
grep -c '^euler *library-plain .*pass' table
awk 'NF > 1 && $(NF - 1) == "fail"' table | wc -l
mkdir data
cp "$DATA"/*.csv data
sed '2s/,-0.008/,-0.009/' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
lab verify --kernel euler --data data > table || echo "exit $?"
grep -c '^euler *library  .*fail  *[a-z]*$' table
CAROM_DATA=data lab verify --kernel euler > table || echo "exit $?"
sed '3d' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
lab verify --kernel euler --data data > table || echo "exit $?"
echo "--- as CSV"
lab verify --kernel euler --csv -o table.csv
grep -v ',library-' table.csv | cut -d, -f1-8,13,20,21
lab verify --kernel exact --csv | awk -F, 'NR > 1 { rows++; if ($10 > 5e-9 || $12 > 1e-6 || $6 != 204) print "not as it should be: " $0 } END { print (rows >= 4 ? "exact" : "too few rows") }'
echo "--- in sentences"
lab verify --kernel euler | grep '^euler[:,]'
