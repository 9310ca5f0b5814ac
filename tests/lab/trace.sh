# trace: one collision against impulse; sweep: one input varied.
carom trace --id pooltool-135 --solver exact,euler --points 101 > both.csv
grep '^#' both.csv
awk -F, '!/^#/ && $1 != "solver" { rows[$1]++; if (rows[$1] > 1 && $2 <= before) print "impulse does not rise"; before = $2
  sticks[$1] += $5; phase[$1] = phase[$1] substr($4, 1, 1) }
  END { for (k in rows) { n = gsub("c", "", phase[k]); print k, rows[k] " points, " n " in compression, " sticks[k] " stuck" } }' both.csv | sort
echo "--- ends at the result"
awk -F, '/^id,|^pooltool-135,/' "$DATA/collisions-204.csv" > one.csv
for kernel in exact euler; do
  carom resolve --solver $kernel one.csv | tail -n 1 | cut -d, -f2-13 > end
  awk -F, -v kernel=$kernel '$1 == kernel { last = $0 } END { print last }' both.csv | cut -d, -f17-28 > seen
  paste -d, end seen | awk -F, -v kernel=$kernel '{ for (k = 1; k <= 12; k++) { d = $k - $(k + 12); if (d < 0) d = -d; if (d > 1e-5) print kernel, k, d } }
    END { print kernel, "does" }'
done
carom trace --id pooltool-135 --points 101 -o own.csv one.csv
grep -v '^euler' both.csv | cmp - own.csv && echo "from a file and from the reference cases"
carom trace --id 1 --solver exact --points 2 - < one.csv > /dev/null 2>&1 || echo "ids come before numbers of rows"
cut -d, -f2- one.csv | carom trace --id 1 --points 101 - | grep -v '^# collision' | head -n 20 > unnamed
grep -v '^# collision' own.csv | head -n 20 | cmp - unnamed && echo "without ids the number of the row is one"
carom trace --id pooltool-135 --friction alciatore --points 2 | grep 'between the balls'
echo "--- pictures"
carom trace --id pooltool-135 --solver exact,euler --plot both.svg && grep -c '</svg>' both.svg
carom trace --id pooltool-003 --solver euler --plot one.png -o one_plot.csv && head -c 4 one.png | tail -c 3 && echo && wc -l < one_plot.csv
(PATH=/nowhere && try "$CAROM" trace --id pooltool-135 --plot none.svg -o kept.csv)
ls none.svg kept.csv 2>&1 | sed 's/^ls: [^:]*none.svg.*/no none.svg/'
try carom trace --id pooltool-135 --plot none.pdf
echo "--- separating and in error"
head -n 2 "$DATA/separating-20.csv" | carom trace --id "$(sed -n 2p "$DATA/separating-20.csv" | cut -d, -f1)" --points 3 - 2>&1 | cut -d, -f1-5 | grep -v '^#'
awk -F, -v OFS=, 'NR > 1 { $22 = -1 } 1' one.csv > bad.csv
try carom trace --id pooltool-135 bad.csv
echo "--- usage"
head -n 4 "$DATA/collisions-204.csv" > three.csv
try carom trace --id nothing three.csv
try carom trace --id nothing "$DATA/collisions-204.csv" 2>&1 | sed 's/^.*\/coll/coll/'
head -n 1 three.csv > none.csv
try carom trace --id nothing none.csv
try carom trace
try carom trace --id 1 a.csv b.csv
try carom trace --id 1 missing.csv
try carom trace --id pooltool-135 --solver base
try carom trace --id pooltool-135 --solver ""
try carom trace --id pooltool-135 --points 1
try carom trace --id pooltool-135 -o no/where.csv
echo "--- sweep"
carom sweep --id pooltool-135 --over w1z --from -60 --to 60 --solver exact,euler > sweep.csv
awk -F, '!/^#/ && $1 != "solver" { rows[$1]++; if ($5 != "nan" && $5 + 0 > jump[$1] + 0) jump[$1] = $5; if ($4 != "nan") stick[$1]++ }
  END { for (k in rows) print k, rows[k] " values, " stick[k] + 0 " stick, " (jump[k] < 2e-6 ? "smooth" : jump[k] > 1e-4 ? "jumps" : "so so") }' sweep.csv | sort
for input in cut speed u_b e_b M1; do
  carom sweep --id pooltool-003 --over $input --from 0.1 --to 0.9 --points 3 --brief | tail -n 3 | cut -d, -f1,2,6
done
try carom sweep --id pooltool-003 --over e_b --from 0.5 --to 1.5 --points 5 -o errors.csv
cut -d, -f2,18 errors.csv | tail -n 5
try carom sweep --id pooltool-003 --over e --from 0 --to 1
try carom sweep --id pooltool-003 --over e_b --from zero --to 1
try carom sweep --id pooltool-003 --over e_b --from 0
try carom sweep --over e_b --from 0 --to 1
