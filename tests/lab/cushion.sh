# The cushion in the study's program: verified, timed.
try lab verify --cushion --draws 40 --csv -o verified.csv
cut -d, -f1,2,5,9,10 verified.csv
awk -F, '$1 == "mathavan" { print $3 " compared, " $4 " left out" }' verified.csv
try lab verify --cushion --draws 40 --seed 7 --csv -o other.csv
cmp -s verified.csv other.csv || echo "another seed, other impacts"
mkdir data
cp "$DATA"/*.csv data
awk -F, -v OFS=, 'NR == 2 { $17 += 0.001 } 1' "$DATA/cushion-stronge.csv" > data/cushion-stronge.csv
try lab verify --cushion --draws 5 --data data | grep -c FAIL
echo 'id,vx' > data/cushion-stronge.csv
echo '1,2' >> data/cushion-stronge.csv
try lab verify --cushion --draws 5 --data data -o none 2>&1 | sed 's/^.*data\//data\//'
ls none 2>&1 | sed 's/^.*none.*/no none/'
echo "--- bench"
lab bench --cushion --budget 0.5 --csv | grep -v '^#' | awk -F, 'NR == 1 || NF == 11 { print (NR == 1 ? $0 : $1 " " $6 " " ($7 > 0 && $10 >= 1 ? "timed" : "not timed")) }'
