# How to play the three banks, what readings tell, the file for --with, the picture, and bad input.
try_rows "calibrate, how to play"
cat my.json
try carom calibrate --read 4.7,5.6,5.6 --plot banks.svg
grep -c "<path" banks.svg
carom shoot --cue 0.6,0.8 --aim 20 --speed 3 --with my.json --csv > mine.csv
carom shoot --cue 0.6,0.8 --aim 20 --speed 3 --csv > usual.csv
cmp -s mine.csv usual.csv || echo "another table"
try_rows "calibrate, bad readings"
echo "--- conditions of a table"
cushions="old_cushion new_cushion humid_cushion lively_cushion dead_cushion"
for with in slow_cloth medium_cloth fast_cloth $cushions fast_cloth,new_cushion; do
  carom shoot --cue 0.6,0.8 --aim 62 --speed 2 --with $with --csv > $with.csv
done
carom shoot --cue 0.6,0.8 --aim 62 --speed 2 --csv | cmp - medium_cloth.csv && echo "medium is the usual cloth"
cat ./*_*.csv | grep '^1,' | sort -u | wc -l
try carom shoot --cue 0.6,0.8 --with fast_felt
carom models old_cushion
try_rows "calibrate, conditions of a rail"
carom rail --game fourball | sed -n 2p
try carom shoot --table threecushion --cue 0.6,0.8 --with fast_cloth
try carom shoot --table my.json --cue 0.6,0.8
