# trace: a reference collision against impulse, by the exact solver and by Euler's method.
lab trace --id pooltool-135 --points 101 > both.csv
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
echo "--- usage"
try_rows "trace, usage"
