# A file of a million rows, most of them quick to refuse, in less than 64 MiB of memory, and a good row at the end.
rows=1000000
{
  head -n 2 "$DATA/collisions-204.csv"
  yes "x,,,,,,,,,,,,,,,,,,,,,,,,,1" | head -n $((rows - 2))
  sed -n 2p "$DATA/collisions-204.csv"
} > big.csv
# The limit is on address space, of which the sanitizers need terabytes: with them only the result is tested.
limit="ulimit -v 65536"
(eval "$limit"; carom --version > /dev/null 2>&1) || limit=:
(eval "$limit"; try carom resolve --solver euler -o out.csv big.csv 2> /dev/null)
wc -l < out.csv
sed -n '2p;$p' out.csv | cut -d, -f14
