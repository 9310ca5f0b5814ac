# verify passes on the real references and fails when a reference is wrong.
carom verify > table
echo "exit $?"
grep -c '^euler .*pass' table
grep -c FAIL table || true
mkdir data
cp "$DATA"/*.csv data
sed '2s/,-0.008/,-0.009/' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
carom verify --data data > table || echo "exit $?"
grep -c '^euler .*FAIL' table
CAROM_DATA=data carom verify > table || echo "exit $?"
sed '3d' "$DATA/reference-pooltool-n1000.csv" > data/reference-pooltool-n1000.csv
carom verify --data data > table || echo "exit $?"
echo "--- as CSV"
carom verify --kernel euler --csv -o table.csv
cut -d, -f1-7,12,17 table.csv
