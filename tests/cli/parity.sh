# The main job: pooltool's own results, double for double, to a file, to stdout and from stdin.
try carom resolve --kernel euler --slip pooltool -o out.csv "$DATA/collisions-204.csv"
cut -d, -f1-13 "$DATA/reference-pooltool-n1000.csv" > expected.csv
cut -d, -f1-13 out.csv | cmp - expected.csv && echo "same doubles"
tail -n +2 out.csv | cut -d, -f14 | sort | uniq -c | sed 's/^ *//'
carom resolve --kernel euler --slip pooltool "$DATA/collisions-204.csv" | cmp - out.csv && echo "same on stdout"
carom resolve --kernel euler --slip pooltool - < "$DATA/collisions-204.csv" | cmp - out.csv && echo "same from stdin"
LC_ALL=de_DE.UTF-8 carom resolve --kernel euler --slip pooltool "$DATA/collisions-204.csv" | cmp - out.csv && echo "same in German"
carom resolve --kernel euler --slip pooltool --steps 999 "$DATA/collisions-204.csv" | cmp -s - out.csv || echo "steps matter"
carom resolve --kernel euler "$DATA/collisions-204.csv" | cmp -s - out.csv || echo "slip matters"
