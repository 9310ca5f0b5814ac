# How to play the three banks, what readings tell, the file for --with, the picture, and bad input.
try carom calibrate
try carom calibrate --table 7ft
try carom calibrate --read 4.7,5.6,5.6 -o my.json
cat my.json
try carom calibrate --read 4.7,5.6,5.6 --plot banks.svg
grep -c "<path" banks.svg
carom shoot --cue 0.6,0.8 --aim 20 --speed 3 --with my.json --csv > mine.csv
carom shoot --cue 0.6,0.8 --aim 20 --speed 3 --csv > usual.csv
cmp -s mine.csv usual.csv || echo "another table"
try carom calibrate --read 3,6.5,5.6
try carom calibrate --read 4.7,5.6
try carom calibrate --read 4.7,5.6,8
try carom calibrate -o my.json
echo "--- conditions of a table"
for with in slow_cloth medium_cloth fast_cloth old_cushion new_cushion humid_cushion fast_cloth,new_cushion; do
  carom shoot --cue 0.6,0.8 --aim 62 --speed 2 --with $with --csv > $with.csv
done
carom shoot --cue 0.6,0.8 --aim 62 --speed 2 --csv | cmp - medium_cloth.csv && echo "medium is the usual cloth"
cat ./*_*.csv | grep '^1,' | sort -u | wc -l
try carom shoot --cue 0.6,0.8 --with fast_felt
carom models old_cushion
try carom rail --angle 45 --with old_cushion
try carom rail --angle 45 --with my.json
try carom rail --with fast_cloth
try carom shoot --cue 0.6,0.8 --with slow_cloth,old_cushion,fast_cloth
try carom rail --game snooker --with old_cushion
carom rail --game fourball | sed -n 2p
try carom shoot --table threecushion --cue 0.6,0.8 --with fast_cloth
try carom shoot --table my.json --cue 0.6,0.8
