# Whole shots: what is written reads back to the same shots, whatever the threads; a bad line costs itself.
carom shoot -o once.jsonl "$DATA/break-nineball.jsonl"
echo "exit $?"
carom shoot --threads 3 -o again.jsonl once.jsonl
cmp once.jsonl again.jsonl && echo "the same again"
grep -c '"status": "ok"' once.jsonl
carom shoot --threads 1 -o one.jsonl "$DATA/shots-pooltool.jsonl"
carom shoot --threads 4 -o four.jsonl "$DATA/shots-pooltool.jsonl"
cmp one.jsonl four.jsonl && echo "the same with any number of threads"
grep -o '"kind": "[a-z]*"' one.jsonl | sort | uniq -c | tr -s ' '
carom shoot --models pooltool --events brief "$DATA/shots-pooltool.jsonl" | grep -o '"n_events": [0-9]*' | tr -d ' ' > ours
tr -d ' ' < "$DATA/shots-pooltool.jsonl" | grep -o '"n_events":[0-9]*' | cmp - ours && echo "as many events as recorded"
carom shoot --models pooltool --events brief "$DATA/shots-pooltool.jsonl" | grep public-017 | sed 's/\[\([0-9.]*\), "/["/g; s/"final".*//; s/.*"events"/"events"/'
echo "--- a picture"
carom shoot --events none --plot break.svg "$DATA/break-nineball.jsonl" > none.jsonl
grep -c events none.jsonl
grep -c '<path fill' break.svg
tail -n 1 break.svg
carom shoot --plot break.svg --id nosuch "$DATA/break-nineball.jsonl" > /dev/null || echo "exit $?"
echo "--- bad lines"
ball='{"id": "cue", "state": [0, 0.3, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}'
{
  echo "{\"kind\": \"shot\", \"id\": \"good\", \"cue\": {\"ball\": \"cue\", \"V0\": 1}, \"balls\": [$ball]}"
  echo 'no JSON'
  echo '{"id": 1}'
  echo '{"kind": "shot", "id": "no balls"}'
  echo '{"kind": "shot", "id": "text for a number", "cue": {"V0": "fast"}, "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "no such ball", "cue": {"ball": "8"}, "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "no such table", "table": "attic", "balls": ['"$ball"']}'
  echo '{"kind": "shot", "id": "short state", "balls": [{"id": "cue", "state": [0, 1]}]}'
  echo '{"kind": "shot", "id": "twins", "balls": ['"$ball, $ball"']}'
  echo '{"kind": "shot", "id": "overlap", "balls": ['"$ball"', {"id": "2", "state": [0, 0.31, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}]}'
  echo '{"kind": "shot", "id": "no mass", "balls": [{"id": "cue", "params": {"m": 0}, "state": [0, 0.3, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}]}'
  echo '{"kind": "shot", "id": "miscue", "cue": {"a": 0.8, "b": 0.8}, "balls": ['"$ball"']}'
  echo '{"kind": "table", "id": "bad", "linear": [{"id": "1", "p1": [0, 0, 0.03]}]}'
  echo '{"kind": "other", "is": "ignored"}'
  echo "{\"kind\": \"shot\", \"id\": \"default cue\", \"unknown\": [], \"balls\": [$ball]}"
} > bad.jsonl
carom shoot -o bad.out bad.jsonl || echo "exit $?"
sed 's/"table".*"final"/.../; s/"t": .*}, "pockets"/.../' bad.out
echo "--- a byte-order mark"
{ printf '\357\273\277'; cat "$DATA/break-nineball.jsonl"; } > mark.jsonl
carom shoot mark.jsonl | cmp - once.jsonl && echo "the same with one"
{ printf '\357\273\277'; grep -m 1 '"kind": "table"' "$DATA/shots-pooltool.jsonl"; } > mark.jsonl
carom shoot mark.jsonl | head -c 15 && echo
echo "--- bounds"
try carom shoot --events-most 5 --events none - < "$DATA/break-nineball.jsonl" > bounds.out
grep -o '"status": "[a-z_]*"' bounds.out
echo "--- usage"
try carom shoot
try carom shoot nosuch.jsonl
try carom shoot --models other "$DATA/break-nineball.jsonl"
try carom shoot --plot break.txt "$DATA/break-nineball.jsonl"
