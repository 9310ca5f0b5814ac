# Time of a pair over the bytes of a batch, the solver's and below it that of a copy; the caches' sizes.
width = 1000; height = 560
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/study.gp" ARG1 ARG2 ARG3

# From 32 pairs on: below, calls and empty lanes hide what is to be seen.
least = 32
bytes(p) = column("pairs") * (p eq "double" ? 304 : 152)
is(kind, p) = column("threads") == 1 && strcol("isa") ne "scalar" && strcol("precision") eq p && column("pairs") >= least && \
  (strcol("kernel") eq "copy") == (kind eq "copy")
at(kind, p) = is(kind, p) ? bytes(p) : NaN
isa = system("awk -F, '/^#/ { next } n++ && $3 != \"scalar\" { print $3; exit }' '".data."'")
# The band between both needs them in a row.
band(p) = "< awk -F, '/^#/ { next } !at { for (k = 1; k <= NF; k++) if ($k == \"pairs\") at = k; next } ".\
  "$5 == 1 && $4 == \"".p."\" && $3 != \"scalar\" && $at >= ".least." { if ($1 == \"copy\") c[$at] = $7; else { n[++m] = $at; s[$at] = $7 } } ".\
  "END { print \"bytes,solver,copy\"; for (k = 1; k <= m; k++) print n[k] * ".(p eq "double" ? "304" : "152")." \",\" s[n[k]] \",\" c[n[k]] }' '".data."'"

last(p) = band(p)." | awk 'NR == 1 { print } { l = $0 } END { print l }'"

set logscale x 2
set logscale y
set format y "%g"
set xtics ("1 KiB" 2**10, "4 KiB" 2**12, "16 KiB" 2**14, "64 KiB" 2**16, "256 KiB" 2**18, "1 MiB" 2**20, "4 MiB" 2**22, "16 MiB" 2**24, "64 MiB" 2**26, "256 MiB" 2**28)
set xlabel "bytes read and written by a batch"
set ylabel "time of a pair (ns)" offset 0.5,0
set lmargin at screen 0.085; set rmargin at screen 0.765
set key at screen 0.785, graph 1 left top Left reverse noenhanced samplen 3
stats data using (at("solver", "single")) name "x" nooutput
set xrange [0.8 * x_min:2**28]
caches = note("caches")
do for [level=1:4] {
  mark = strstrt(caches, sprintf("L%d ", level))
  size = mark > 0 ? 1024.0 * real(caches[mark+3:]) : 0
  if (size > 0.8 * x_min && size < 2**28) {
    set arrow level from first size, graph 0 to first size, graph 1 nohead lc rgb grey lw 1 dt (6,4) back
    set label 10+level sprintf("L%d", level) at first size, graph 0.965 right offset -0.6,0 font ",13" textcolor rgb grey
  }
}
plot band("double") using "bytes":"solver":"copy" with filledcurves fs transparent solid 0.13 noborder lc rgb blue notitle, \
     data using (at("solver", "double")):"ns_median" with linespoints lc rgb blue lw 2 dt 1 pt 7 ps 1 title "exact, double, ".isa, \
     data using (at("solver", "single")):"ns_median" with linespoints lc rgb vermilion lw 2 dt (12,4) pt 9 ps 1.1 title "exact, single, ".isa, \
     data using (at("copy", "double")):"ns_median" with linespoints lc rgb blue lw 2 dt 1 pt 6 ps 1 title "copy, double", \
     data using (at("copy", "single")):"ns_median" with linespoints lc rgb vermilion lw 2 dt (12,4) pt 8 ps 1.1 title "copy, single", \
     for [p in "double single"] last(p) using "bytes":"solver":(sprintf((column("solver") < 10 * column("copy") ? "%.1f ×" : "%.0f ×")." the copy", column("solver") / column("copy"))) \
       with labels left offset 0.9,0 font ",12" textcolor rgb ink notitle
