# Bad usage and unreadable input: exit 2, a message that says what would be right, and nothing written.
header=id,r1x,r1y,r1z,v1x,v1y,v1z,w1x,w1y,w1z,r2x,r2y,r2z,v2x,v2y,v2z,w2x,w2y,w2z,R,M,u_s1,u_s2,u_b,e_b
try carom > said 2>&1
sed -n '1p;$p' said
rm said
try_rows "usage, bad usage"
try carom resolve ""
carom help hit | head -n 1
: > empty.csv
try carom resolve -o out.csv empty.csv
echo "$header" | sed 's/,R,/,/; s/,v1y,/,/' > lacking.csv
try carom resolve -o out.csv lacking.csv
echo "$header,M" > doubled.csv
try carom resolve -o out.csv doubled.csv
echo "$header,M1,M2" > both.csv
try carom resolve -o out.csv both.csv
echo "$header" | sed 's/,M,/,M1,/' > half.csv
try carom resolve -o out.csv half.csv
try carom resolve -o nowhere/out.csv "$DATA/collisions-204.csv"
ls out.csv* 2> /dev/null || echo "no output"
try env CAROM_ISA=avx3 "$CAROM" resolve -o out.csv "$DATA/collisions-204.csv"
try env CAROM_ISA= "$CAROM" resolve -o /dev/null "$DATA/collisions-204.csv"
ls out.csv* 2> /dev/null || echo "no output"
# Every option that does not take any text says what it takes, and options of the same name the same.
for command in resolve hit rail shoot ways break; do
  for option in $(carom $command --help | sed -n 's/^  \(-., \)\{0,1\}--\([a-z-]*\) [^ ].*/\2/p'); do
    case $option in output | id) continue ;; esac
    try carom $command "--$option" "no such" > said 2>&1
    grep -qx "exit 2" said || echo "$command --$option takes any text"
    grep -v "^exit 2" said
  done
done | awk '!seen[$0]++'
rm said
try carom resolve --sovler exact x.csv
# What is nearly a word gets it as a suggestion; what is none, or the beginning of several, gets none.
{
  head -n 1 "$DATA/collisions-204.csv"
  sed -n 2p "$DATA/collisions-204.csv"
} > row.csv
cue='{"kind": "shot", "cue": {"V0": 2, "b": 0, "phii": 90}, "balls": [{"id": "cue", "state": [0, 0.6, 0.6, 0.03, 0, 0, 0, 0, 0, 0]}]}'
for words in shot resolv re Hit --verison frobnicate "hit --sped 3" "hit --sped=3" "hit --sp 3" "hit --xyz" "hit --spin folow" "hit --spin 20rads" "hit --speed 7mhp" "hit --cut hlaf" "hit --quantity trow" \
  "hit --friction alciator" "rail --model strong" "shoot --balls ninebal" "shoot --balls pyramid" "shoot --table snoker" "shoot --balls target=0.5,1.6 --at-ball tarqet" "shoot --models pooltol -" "shoot --cushion math -" "resolve --solver exat row.csv" \
  "shoot --events none -"; do
  # shellcheck disable=SC2086
  echo "$cue" | carom $words 2>&1 > /dev/null | grep -o "did you mean.*" || echo "none: $words"
done
