# Racks that are played by plans, and the numbers of chances.c that are fitted to them.
numbers() {
  sed 's/-\{0,1\}[0-9][0-9.]*/N/g; s/  */ /g' | tr '\n' ' ' | sed 's/ \*//g; s/  */ /g'
  echo
}
echo "--- what was counted does not depend on threads"
lab plan --racks 2 --shots 100 | sed 's/, [0-9.]* ms a plan//' > one.txt
lab plan --racks 2 --shots 100 --threads 2 | sed 's/, [0-9.]* ms a plan//' > two.txt
cmp one.txt two.txt && numbers < one.txt | cut -d' ' -f1-20
echo "--- games that are played to the end, and end games"
lab plan --rules nineball --games --racks 2 --shots 100 | numbers | cut -d' ' -f1-20
lab plan --games --racks 1 --shots 100 | grep -c "^planned to foul"
for rules in eightball nineball; do lab plan --rules $rules --left 2 --run-out --racks 2 --shots 100 | numbers | cut -d' ' -f1-20; done
echo "--- matches of rated players"
for threads in 1 2; do lab plan --rules threecushion --target 1 --players 800,500 --racks 18 --threads $threads | sed 's/ and [0-9.]* s a match//' > $threads.txt; done
cmp 1.txt 2.txt && numbers < 1.txt
lab plan --told --rules nineball --players 500,500 --racks 2 --shots 100 --seed 1 | grep -E "^game|,all,"
echo "--- games of points"
lab plan --rules straight --target 8 --racks 1 --shots 100 | numbers | cut -d' ' -f1-33
for game in $(sed -n 's/.*--rules \([a-z]*\) --racks.*/\1/p' "$DATA/../games/ratings/learned.h" | sort -u); do
  case $game in *ball | straight) ;; *) lab plan --rules "$game" --games --racks 1 --shots 100 | grep -c "points in" ;; esac
done
echo "--- nor the rows that are fitted, whose form is that of the library's"
lab learn --racks 40 --shots 100 > one.h
lab learn --racks 40 --shots 100 --threads 3 > two.h
cmp one.h two.h
lab learn --racks 40 --shots 100 --seed 1 | cmp -s - one.h || echo "another seed gives other numbers"
numbers < "$DATA/../games/ratings/learned.h" > is.txt
for game in $(sed -n 's/.*--rules \([a-z]*\) --racks.*/\1/p' "$DATA/../games/ratings/learned.h" | sort -u); do grep -qF "$(lab learn --rules $game --racks 40 --shots 100 | numbers | sed 's/ $//')" is.txt && echo "$game: same"; done
grep -o "racks [0-9]*" "$DATA/../games/ratings/learned.h"
echo "--- usage"
try_rows "plan, usage"
