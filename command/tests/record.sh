# Recordings: what is recorded is played again with the same bits; what is forged, damaged, cut off or of another revision is told.
try_rows "record, usage"
try carom verify - < game.jsonl
sed 's/"revision":[0-9]*/"revision":N/; s/:{.*\("status":[0-9]*,"events":[0-9]*\).*/:...\1/' game.jsonl | head -n 7 | cut -c 1-100
echo "--- replayed: the end of each shot, on any instruction set"
carom replay game.jsonl | sed 's/,[0-9a-f]\{16\},/,HASH,/'
carom replay full.jsonl > one.csv
CAROM_ISA=plain carom replay full.jsonl | cmp - one.csv && tail -n +2 one.csv | cut -d , -f 7 | sort | uniq -c | tr -s ' '
echo "--- the models are recorded"
carom record --world pooltool "$DATA/shots-pooltool.jsonl" > pooltool.jsonl
grep -o '"options":.*' pooltool.jsonl
carom verify pooltool.jsonl | sed 's/(.*//'
echo "--- forged"
forged() {
  sed "$1" game.jsonl > forged.jsonl
  cmp -s game.jsonl forged.jsonl && echo "nothing was changed"
  try carom verify forged.jsonl
}
forged '0,/"speed":9/ s//"speed":9.000001/'
forged '3 s/"length":2.54/"length":0.54/'
forged '3 s/"radius":0.00795/"radius":0.0795/'
forged '2 s/{}}/{"steps":1}}/'
forged '7 s/"time":"0x1\.77c/"time":"0x1.77d/'
forged '8 s/"a":[0-9]*/"a":31/'
forged '/"shot"/ s/"events":[0-9]*/"events":2/'
forged '$ s/"hash":"./"hash":"x/'
forged '/"shot"/ s/"hash":"\(.\)\(.\)/"hash":"\2\1/'
echo "--- another revision, damaged, cut off"
forged 's/"revision":[0-9]*/"revision":1/' 2>&1 | sed 's/has revision [0-9]*/has revision N/'
forged '1 s/"format":2/"format":1/'
forged 's/"phi"/"phy"/'
forged '$ d'
try carom replay -o rows.csv forged.jsonl
ls rows.csv 2> /dev/null || echo "nothing was written"
head -c 900 game.jsonl > cut.jsonl
try carom verify cut.jsonl
try carom verify /dev/null
ln -s "$DATA/break-nineball.jsonl" shots.jsonl
try carom verify shots.jsonl
try carom verify missing.jsonl
echo "--- shots that cannot be recorded"
printf '%s\n' '{"kind": "shot", "id": 1, "table": "9ft", "balls": [{"id": "c", "state": [0, 0.5, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}], "cue": {"V0": -1, "b": 0}}' \
  '{"kind": "shot"}' | try carom record -o none.jsonl -
carom verify none.jsonl | sed 's/(.*//'
