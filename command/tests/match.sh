# Matches: played, stopped and gone on with to the same file, told in words, judged; what is not by the rules is told.
try carom match --fargo 650,500 --shots 100 -o whole.jsonl
try carom verify whole.jsonl
carom match --fargo 650,500 --shots 100 --strokes 3 -o saved.jsonl > told
try carom verify saved.jsonl
try carom match --fargo 650,500 --shots 100 -o saved.jsonl saved.jsonl
cmp whole.jsonl saved.jsonl
try carom match --show whole.jsonl
echo "--- cut off behind a shot: the lines that are missing are made"
sed '/^{"shot"/q' whole.jsonl | carom match --fargo 650,500 --shots 100 - | cmp - whole.jsonl
echo "--- notes: told, kept, and judged as lines that no hash covers"
{
  sed '/^{"shot"/q' whole.jsonl
  echo '{"note":{"seat":1,"comment":"a \"good\" break","offer":"draw","seconds":12.5,"x_camera":3}}'
  sed '1,/^{"shot"/d; /^{"end"/i {"note":{"date":"2026-11-30","event":"club evening","answer":"no"}}' whole.jsonl
} > noted.jsonl
try carom verify noted.jsonl
carom match --show noted.jsonl | grep note
carom match --show noted.jsonl | grep -v note > noted
carom match --show whole.jsonl | cmp - noted
sed '/^{"note"/q' noted.jsonl | carom match --fargo 650,500 --shots 100 - > goes-on.jsonl
grep -v '"date"' noted.jsonl | cmp - goes-on.jsonl
sed 's/"seconds":12.5/"secs":12.5/' noted.jsonl > wrong.jsonl
try carom verify wrong.jsonl
try carom match --show -o /dev/null wrong.jsonl
echo "--- other games"
for rules in nineball snooker threecushion; do
  carom match --rules $rules --shots 100 --strokes 4 --breaks 2 -o $rules.jsonl
  carom match --show -o /dev/null $rules.jsonl
done
echo "--- equal innings"
for seed in 1 3 6; do
  carom match --rules straightrail --target 1 --equal-innings --fargo 800,800 --shots 100 --seed $seed -o rail.jsonl
  try carom verify rail.jsonl
done
echo "--- more than two players, and a set"
try carom match --rules killer --players 700,600,500 --shots 100 -o killer.jsonl
try carom verify killer.jsonl
try carom match --rules cutthroat --shots 100 --strokes 3 -o cut.jsonl
try carom match --rules billiards --shots 100 --strokes 3 -o billiards.jsonl
try carom match --rules nineball --players 700,500,400,650 --race 2 --shots 100 -o set.jsonl > /dev/null
try carom verify set.jsonl
carom match --show -o /dev/null set.jsonl
try carom match --race 2 set.jsonl
try carom match --rules cutthroat --players 500,600
echo "--- a game whose rules do not agree"
"${CAROM%/*}/command/tests/forge" > forged.jsonl
try carom verify forged.jsonl
try carom match --show -o /dev/null forged.jsonl
forged() {
  sed "$1" whole.jsonl > forged.jsonl
  cmp -s whole.jsonl forged.jsonl && echo "nothing was changed"
  try carom verify forged.jsonl
  try carom match --show -o /dev/null forged.jsonl
}
forged '/^{"act"/d'
forged '$ i {"act":{"act":3,"player":1,"hash":"0000000000000001"}}'
carom record -o shots.jsonl "$DATA/break-nineball.jsonl"
try carom match --show shots.jsonl
echo "--- odds by ratings, and a rating by results"
carom odds --players 600,500 --race 3,2 --break-points 40 --winner-breaks
carom odds --players 600,500 --race 9,7 --sets 2 --breaks 2 --csv
carom match --rules nineball --players 700,500 --race 2 --shots 100 -o pair.jsonl > /dev/null
printf 'against,won,lost\n500,3,2\n450,9.5,5\n' > results.csv
for words in "pair.jsonl" "--seat 2 pair.jsonl" "results.csv"; do
  # shellcheck disable=SC2086
  carom rating $words
done
carom practice --seat 2 --player 850 --drills 2 whole.jsonl
carom practice --seat 2 --player 850 --csv --drills 1 whole.jsonl
echo 500,3 > wrong.csv
: > none.csv
try_rows "odds and ratings, bad usage"
echo "--- bad usage"
try_rows "match, bad usage"
