# Bars: speedup of the solvers in lanes by instruction set and precision, a panel for each solver.
width = 1000; height = 520
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/../../figures/study.gp" ARG1 ARG2 ARG3
unset title

select(what, condition) = system("awk -F, '/^#/ { next } n++ && (".condition.") && !seen[".what."]++ { printf \"%s \", ".what." }' '".data."'")
batch = "$3 != \"scalar\" && $1 != \"copy\""
solvers = select("$1", batch)
isas = select("$3", batch)
steps(name) = system("awk -F, '$1 == \"".name."\" && $3 != \"scalar\" { print $6; exit }' '".data."'")
height_of(name) = real(system("awk -F, '$1 == \"".name."\" && $3 != \"scalar\" && $10 > m { m = $10 } END { print m }' '".data."'"))
x(name, precision) = strcol("kernel") eq name && strcol("precision") eq precision && strcol("isa") ne "scalar" ? \
  place_in(isas, strcol("isa")) + (precision eq "double" ? -0.2 : 0.2) : NaN
digits(y) = sprintf(y < 9.95 ? "%.2f" : y < 99.5 ? "%.1f" : "%.0f", y)
took(ns) = sprintf(ns < 9.95 ? "%.1f" : "%.0f", ns)

pairs = system("awk -F, '/^#/ { next } !at { for (k = 1; k <= NF; k++) if ($k == \"pairs\") at = k; next } $1 != \"copy\" && $3 != \"scalar\" { print $at; exit }' '".data."'")

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen 0.945 center font large textcolor rgb ink
set label 1003 sprintf("%s pairs in a batch, one thread; in grey: nanoseconds for a collision", pairs) at screen 0.012, screen 0.088 font ",10" textcolor rgb grey noenhanced
set xrange [0.45:words(isas)+0.55]
set xtics () scale 0 noenhanced
do for [k=1:words(isas)] { set xtics add (word(isas, k) k) }
unset grid
set grid ytics lc rgb faint lt 1 lw 1 dt 1
n = words(solvers)
do for [k=1:n] {
  name = word(solvers, k)
  left = 0.085 + (k - 1) * 0.93 / n
  set lmargin at screen left; set rmargin at screen (left + 0.93 / n - 0.075)
  set tmargin at screen 0.80
  set bmargin at screen 0.205
  set label 2 (steps(name) eq "0" ? name : name.", N = ".steps(name)) at graph 0.5, graph 1.06 center font ",15:Bold" textcolor rgb ink noenhanced
  set yrange [0:1.19 * height_of(name)]
  if (k == 1) { set ylabel "speedup over base" offset 0.5,0; set key top left Left reverse samplen 1.5 invert } else { unset ylabel; unset key }
  plot data using (x(name, "single")):"speedup":(0.37) with boxes fs pattern 4 lc rgb vermilion dt 1 title "single", \
       data using (x(name, "double")):"speedup":(0.37) with boxes fs solid 1 lc rgb blue dt 1 title "double", \
       for [p in "double single"] data using (x(name, p)):"speedup":(digits(column("speedup"))) \
         with labels offset 0,1.45 font ",13" textcolor rgb ink notitle, \
       for [p in "double single"] data using (x(name, p)):"speedup":(took(column("ns_median"))) \
         with labels offset 0,0.55 font ",11" textcolor rgb grey notitle
  unset label 1; unset label 1001; unset label 1002; unset label 1003
}
unset multiplot
