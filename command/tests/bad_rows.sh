# Each bad row costs itself only: its own status, line and field; the good rows have their results.
header=id,r1x,r1y,r1z,v1x,v1y,v1z,w1x,w1y,w1z,r2x,r2y,r2z,v2x,v2y,v2z,w2x,w2y,w2z,R,M,u_s1,u_s2,u_b,e_b
good="0,0,0.03,0.3,1,0,-33,10,0,0,0.06,0.03,0,0,0,0,0,0,0.03,0.17,0.2,0.2,0.05,0.95"
usual=0,0,0.03,0,1,0,0,0,0,0,0.06,0.03,0,0,0,0,0,0,0.03,0.17,0.2,0.2,0.05,0.95
{
  printf '%s\n' "$header" "good1,$good" "long,$good,7" "short,0,0,0.03,0,1" "good2,$good"
  # the name of a row, and what stands in which of its columns instead
  for row in nan:4=nan inf:17=-Infinity coincident:11=0 equal_velocities:14=1 radius:19=-1 mass:20=0 cloth:22=-0.2 friction:23=-0.05 restitution:24=1.5 \
    heights:12=0.04 slow:14=0.9999999999999998 empty:1= word:4=fast 'comma:4="0,3"'; do
    echo "$usual" | awk -F, -v OFS=, -v row="$row" '{ split(row, part, /[:=]/); $part[2] = part[3]; print part[1], $0 }'
  done
  echo "good3,$good"
} > in.csv
try carom resolve --solver euler -o out.csv in.csv
cut -d, -f1,2,3,14 out.csv
grep ^good out.csv | cut -d, -f2- | sort -u | wc -l
# Messages show an id of up to 60 characters whole, and nothing of a file that a terminal would obey.
strange() { "$@" 2>&1 > /dev/null | LC_ALL=C sed 's/[^ -~]/<a byte>/g'; }
bad="0,0,0.03,0,1,0,0,0,0,0,0.06,0.03,0,0,0,0,0,0,0.03,0,0.2,0.2,0.05,0.95"
{
  echo "$header"
  for size in 60 61 63 64 65 68 69 300; do printf "%${size}s,%s\n" "$size" "$bad" | tr ' ' _; done
  printf '\033[2J\007\tid \302\233\302\240\177,%s\nw,\033[31m%s\n' "$bad" "$bad"
} > ids.csv
strange carom resolve ids.csv
strange carom resolve "$(printf 'no\nfile\033')"
printf '{"kind": "shot", "table": "\\u001b[2J", "balls": [{"id": "c", "state": [0, 1, 1, 0, 0, 0, 0, 0, 0, 0]}]}\n' > id.jsonl
strange carom shoot id.jsonl
