# plan: the best shots in words and as rows, the same for any number of threads; pictures, games, and what is refused.
carom shoot --cue 0.4,0.9 --balls 0.3,1.9:0.9,1.7:0.7,0.5 --aim 90 --json > layout.jsonl
carom shoot --cue 0.4,0.9 --balls 0.3,1.9:0.9,1.7:0.7,0.5 --aim 90 --json | sed 's/"id": "2"/"id": "8"/' > eight.jsonl
echo "--- words"
CAROM_ISA=plain
export CAROM_ISA
try carom plan --rules potting --shots 300 layout.jsonl | cut -c 1-60 | grep -v chances
try carom plan --rules nineball --shots 300 --plot best.svg layout.jsonl | sed -n 1p
try carom plan --rules nineball --shots 300 --plot best.png layout.jsonl | sed -n 1p
dd if=best.png bs=1 skip=1 count=3 2> dd.log
echo
grep -c "<svg" best.svg
grep -c "M" best.svg | awk '{ print ($1 > 40) }'
sed -n 's/.*\(Of 500 strokes with errors\) [0-9]* \(play on\).*/\1 \2/p' best.svg
echo "balls that are down, beside the table:"
carom plan --rules nineball --shots 300 --cue 0.4,0.9 --balls 1=0.3,1.9:9=0.9,1.7 --plot down.svg > down.txt
sed -n '/Down:/,/class="band\|The best/p' down.svg | grep -o '>[0-9]<' | tr -d '<>' | tr '\n' ' '
grep -c 'class="ball"' down.svg
for cushion in "" "--cushion mirror"; do carom plan --rules potting --shots 300 --csv $cushion layout.jsonl; done | sort | uniq -u | grep -q . && echo "models count"
echo "--- push-outs and passes"
carom shoot --cue 0.5,1.5 --balls 0.9,1.7:0.9574,1.7:0.9287,1.74971:0.8713,1.74971:0.8426,1.7:0.8713,1.65029:0.9287,1.65029 --aim 90 --json > hidden.jsonl
for may in shoot push-out pass; do carom plan --rules nineball --shots 300 --may $may --csv hidden.jsonl | cut -d , -f 2 | sed -n 2p; done
echo "--- the break"
for game in eightball nineball; do carom shoot --balls $game --aim 90 --json | carom plan --rules $game --opening --in-hand --shots 300 --csv - | cut -d , -f 2,3,6 | sed -n 2p; done
try carom plan --rules potting --opening layout.jsonl
carom shoot --balls nineball --aim 90 --json | carom plan --rules nineball --opening --shots 300 - | sed -n 1p
echo "--- chances of strokes, and of a layout"
for speed in 1 2 3; do carom shoot --cue 0.4,0.9 --balls 0.3,1.9:0.9,1.7:0.7,0.5 --aim 94.618 --speed $speed --json; done > strokes.jsonl
carom plan --rules potting --try --shots 600 strokes.jsonl | sed -n 1,2p
carom plan --rules potting --try --shots 600 --csv --plot tried.svg strokes.jsonl | cut -d , -f 1-4,7,8,17
carom plan --rules potting --try --shots 600 --csv strokes.jsonl | awk -F , 'NR == 2 { slow = $12 } NR == 4 { print slow > $12 + 0.02 }'
grep -c "The best: ball 1 into the foot-left pocket" tried.svg
carom plan --rules potting --value layout.jsonl | sed 's/[0-9.]* %/P %/'
for hand in "" --in-hand; do carom plan --rules nineball --value --csv $hand layout.jsonl | sed -n 2p; done | awk 'NR == 1 { lies = $1 } END { print 0 < lies, lies <= $1, $1 <= 1 }'
carom shoot --cue 0.5,0.9 --balls 0.3,1.9:0.9,1.7:0.7,0.5 --aim 90 --json | cat strokes.jsonl - > other.jsonl
try carom plan --rules potting --try other.jsonl
try carom plan --rules potting --try --value layout.jsonl
try carom plan --rules potting --value --plot value.svg layout.jsonl
echo "--- why"
carom plan --rules potting --why --shots 300 layout.jsonl | sed -n 3,7p | sed 's/[0-9][0-9.]*/N/g'
# the last ball, by a straight pot: errors cost little, whoever plays; a kick is aimed at cushions; a game of one has no other
carom plan --rules nineball --why --cue 0.4,0.4 --balls 9=0.25,0.25 --shots 300 | sed -n 3,7p | sed 's/[0-9][0-9.]*/N/g'
for y in 0.3 0.6 0.9 1.2; do carom plan --rules nineball --why --cue 0.5,$y --balls 9=0.2,2.1 --shots 100; done > lone.txt
awk '/which ball|balls fall/ { lucky++ } /errors  / { n++; cost = $3 - $8 - $13 - $19 - $25; bad += cost > 0.26 || cost < -0.26 }
END { printf "costs that do not add up: %d, more than one ball: %d, enough: %d\n", bad, lucky, (n > 4) }' lone.txt
carom plan --rules nineball --why --cue 0.4,0.4 --balls 1=0.9,2.4:2=0.45,0.47:3=0.5,0.43:9=0.37,0.5 --shots 300 | grep -c "aim          off the"
# a cue ball in the D is in hand; a push-out is played as often as the others; a straight ball is no cut of 0 degrees
carom shoot --table snooker --balls snooker --aim 90 --json | carom plan --rules snooker --in-hand --why --shots 100 - > hand.txt
sed -n 's/.*and the other then wins \([0-9]*\) %.*/\1/p' hand.txt | awk '{ print ($1 > 40) }' | sort -u
carom plan --rules nineball --may push-out --why --shots 300 hidden.jsonl | grep -A 2 "a push-out" | grep -o "played [0-9]* times"
carom plan --rules nineball --why --cue 0.4,0.4 --balls 9=0.25,0.25 --shots 300 | grep "cut of [01] degrees" || echo straight
echo "--- to run out, a turn that ends is worth nothing"
carom shoot --cue 0.4,0.4 --balls 0.2,2.3:0.7,1.27:1.1,0.3:0.6,2.2:0.9,1.9 --aim 90 --json > five.jsonl
for out in "" --run-out; do carom plan --rules nineball --shots 300 $out --csv five.jsonl | sed -n 2p | cut -d , -f 12; done | awk 'NR == 1 { wins = $1 } END { print ($1 < wins - 0.02) }'
echo "--- the run-out as a whole"
run="--cue 0.3,0.8 --balls 2=0.35,2.1:3=0.8,0.5:5=0.9,1.6:9=0.6,1.9 --rules nineball --sequence --shots 300"
carom plan $run --plays 40 --plot run.svg > run.txt
grep -o "^[0-9].*\|^   [a-z ]*  \|^The run-out.*that" run.txt | sed 's/[0-9]* %\|(error [0-9]*)/N/g'
grep -c 'class="zone"' run.svg
carom plan $run --plays 0 --json > run.jsonl
carom shoot run.jsonl | grep -o "\"ball_pocket\"" | wc -l
grep -o '"zone_share": [0-9.]*' run.jsonl | awk '{ good += $2 > 0.5 } END { print good }'
for options in --csv "--only safeties" "--table threecushion --rules threecushion"; do try carom plan $run $options; done
echo "--- leaves, and safeties alone"
eight="--rules eightball --group solids --shots 600 --cue 0.3,0.8 --balls 1=0.9,1.6:2=0.35,2.1:3=0.8,0.5:8=0.6,1.9:9=0.9,1.1:10=0.4,1.3"
for goal in snooker:9 near:0.6,0.6 near:foot-spot,1d apart:1,9; do carom plan $eight --leave $goal --csv | sed -n 2p | awk -F , '{ print $2, $3, ($12 > 0.5) }'; done
carom plan $eight --only safeties --csv | sed 1d | cut -d , -f 2,3 | sort | uniq -c | sed 's/^ *[2-5] /many /'
carom plan $eight --leave snooker:9 | sed -n 3p | sed 's/[0-9.]* %.*//'
for goal in nearby near:3,3 apart:1,12 hidden:1 snooker; do try carom plan $eight --leave $goal; done
try carom plan --rules potting --leave hidden layout.jsonl
try carom plan $eight --leave hidden --why
echo "--- balls that are down are not on the table"
carom plan --rules nineball --shots 300 --plot few.svg --cue 0.4,0.4 --balls 7=0.9,1.4:9=0.25,0.25 > few.txt
grep -c 'class="ball"' few.svg
carom plan --rules threecushion --shots 300 --plot three.svg --table threecushion --cue 0.4,0.9 --balls 0.3,1.9:1.1,2.2 > three.txt
grep -o "Of 500 strokes with errors [0-9]* score" three.svg | sed 's/ [0-9]* score/ N score/'
for options in "--why --csv" "--why --value"; do try carom plan --rules potting $options layout.jsonl; done
echo "--- three-cushion"
carom shoot --table threecushion --cue 0.4,0.9 --balls 0.3,1.9:1.1,2.2 --aim 90 --json > three.jsonl
carom plan --rules threecushion --shots 600 three.jsonl | sed 's/[0-9]*[.][0-9]*/N/g' | sed -n 1,3p
carom plan --rules threecushion --shots 600 --csv three.jsonl | awk -F , '
  NR > 1 { print ($12 <= $14), ($2 ~ /^(carom|kick|rail first|safety)$/), $4 == "" }' | sort | uniq
try carom plan --rules threecushion layout.jsonl
try carom plan --rules threecushion --value three.jsonl
echo "--- straight pool and snooker"
carom shoot --balls eightball --aim 90 --json > straight.jsonl
carom plan --rules straight --opening --in-hand --shots 300 --csv straight.jsonl | awk -F , 'NR == 2 { print $6 <= 0.635 }'
carom plan --rules straight --score 10,2 --target 12 --shots 300 --csv layout.jsonl | cut -d , -f 2-4 | sed -n 2p
carom shoot --table snooker --balls snooker --aim 90 --json | carom plan --rules snooker --in-hand --shots 300 --csv - | awk -F , 'NR == 2 { print ($5 - 0.889) ^ 2 + ($6 - 0.737) ^ 2 < 0.0853, $6 < 0.7371 }'
carom shoot --table snooker --cue 1.2,1.0 --balls red1=0.3,1.2:yellow=1.4,0.3:black=0.9,3.2 --aim 90 --json > snooker.jsonl
carom plan --rules snooker --colour --shots 1000 snooker.jsonl | sed -n 1p
chance() { carom plan --rules snooker --value --csv "$@" snooker.jsonl | sed -n 2p; }
awk -v behind="$(chance --score 0,20)" -v ahead="$(chance --score 20,0)" 'BEGIN { print (ahead > behind + 0.2) }'
for may in shoot pass free-ball; do carom plan --rules snooker --may $may --score 0,9 --csv snooker.jsonl | cut -d , -f 2 | grep -c pass || true; done
for options in "--rules snooker --score 1" "--rules nineball --score 1,2" "--rules snooker --target 9" "--rules straight --colour" "--rules straight --may free-ball" "--rules snooker --opening"; do try carom plan $options snooker.jsonl; done
echo "--- one-pocket"
carom plan --rules onepocket --in-hand --shots 300 --csv straight.jsonl | awk -F , 'NR == 2 { print $6 <= 0.635 }'
for pocket in foot-left foot-right; do carom plan --rules onepocket --own-pocket $pocket --score 7,5 --shots 600 --csv layout.jsonl | cut -d , -f 4 | sed -n '1d; /./p' | sort -u; done
chance() { carom plan --rules onepocket --value --csv "$@" layout.jsonl | sed -n 2p; }
awk -v ahead="$(chance --score 7,-1)" -v even="$(chance --score 7,0)" -v behind="$(chance --score -1,7)" 'BEGIN { print (ahead > even), (even > behind + 0.3) }'
for options in "--score 7,6" "--own-pocket side-left" "--opening" "--score 3"; do try carom plan --rules onepocket $options layout.jsonl; done
for options in "--rules snooker --score -1,0" "--rules nineball --own-pocket foot-left" "--rules nineball --last-inning"; do try carom plan $options layout.jsonl; done
try carom plan --rules onepocket --table threecushion --cue 0.4,0.9 --balls 1=0.3,1.9
sed 's/"id": "red1"/"id": "rot"/' snooker.jsonl > rot.jsonl
try carom plan --rules snooker rot.jsonl
echo "--- a layout by options"
carom plan --rules potting --shots 300 --csv --cue 0.4,0.9 --balls 0.3,1.9:0.9,1.7:0.7,0.5 > options.csv
carom plan --rules potting --shots 300 --csv layout.jsonl | cmp - options.csv && echo "as of a file"
try carom plan --cue 0.4,0.9 layout.jsonl
echo "--- rows, threads"
for threads in 1 2; do carom plan --rules potting --shots 300 --threads $threads --csv -o rows$threads.csv layout.jsonl; done
cmp rows1.csv rows2.csv && sed -n 1p rows1.csv && wc -l < rows1.csv | tr -d ' '
carom plan --rules potting --in-hand --shots 300 --csv layout.jsonl | cut -d , -f 1-4 | sed -n 2p
echo "--- a weaker player has less"
chance() { carom plan --rules potting --shots 300 --csv "$@" layout.jsonl | sed -n 2p | cut -d , -f 12; }
awk -v sure="$(chance --errors 0.2)" -v weak="$(chance --errors 6)" -v rated="$(chance --player 400)" 'BEGIN { print (sure > weak + 0.1), (sure > rated + 0.1) }'
echo "--- eight-ball by groups"
carom plan --group solids --shots 100 --csv eight.jsonl | cut -d , -f 2,3 | sed -n 2p
echo "--- a player who is advised gets a plan of the usual shots"
for shots in "" "--shots 2000"; do carom plan --rules potting --player 500 $shots --csv layout.jsonl | cksum; done | uniq | wc -l | tr -d ' '
echo "--- refused"
for options in "--player 500 --errors 2" "--rules potting --group solids" "--may pass" "--player 100"; do try carom plan $options layout.jsonl; done
try carom plan --rules eightball layout.jsonl
carom shoot --cue 0.4,0.9 --aim 90 --json > alone.jsonl
for game in eightball nineball potting; do try carom plan --rules $game alone.jsonl; done
carom shoot --table threecushion --cue 0.4,0.9 --balls 0.3,1.9 --aim 90 --json > carom.jsonl
for game in nineball threecushion; do try carom plan --rules $game carom.jsonl; done
try_rows "plan, other games"
sed 's/"id": "2"/"id": "red"/' layout.jsonl > names.jsonl
try carom plan --rules eightball names.jsonl
: > empty.jsonl
try carom plan empty.jsonl
