# Pairs that do not approach come back unchanged, and that is no error.
try carom resolve -o out.csv "$DATA/separating-20.csv"
tail -n +2 out.csv | cut -d, -f14 | sort | uniq -c | sed 's/^ *//'
tail -n +2 "$DATA/separating-20.csv" | cut -d, -f1,6-11,15-20 > before
tail -n +2 out.csv | cut -d, -f1-13 > after
same_doubles after before && echo unchanged
