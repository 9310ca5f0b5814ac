# Every solver agrees with the 2014 paper's own prediction of its five shots within 0.005 m/s and 0.1 degrees, with either slip.
for slip in paper pooltool; do
  lab experiments --csv --slip $slip | awk -F, -v slip=$slip '
    $2 == "predicted" { for (k = 3; k <= 6; k++) predicted[k] = $k }
    NR > 1 && $2 != "predicted" && $2 != "measured" {
      rows[$2]++
      for (k = 3; k <= 6; k++) {
        error = $k - predicted[k]; if (error < 0) error = -error
        if (error > (k < 5 ? 0.005 : 0.1)) print slip, $1, $2, "column", k, "is off by", error
      }
    }
    END { for (name in rows) print slip, rows[name] " shots by " name }' | sort
done
lab experiments | head -n 3
try lab experiments --slip none
try lab experiments now
try lab experiments --data nowhere
