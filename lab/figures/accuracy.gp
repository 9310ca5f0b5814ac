# Error against time: a line for each kernel that was swept over N, a mark with its name for each that takes no steps. Marks stand at
# the largest error of the cases; dotted is the way down to the median, for the library's kernels.
width = 1000; height = 620
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/style.gp" ARG1 ARG2 ARG3

kernels = words_of("kernel")
of(name, x) = strcol("kernel") eq name ? x : NaN
# Kernels with several rows and, of these, the library's; kernels with one.
rows_where(condition) = system("awk -F, '!/^#/ { n[$1]++; c[$1] = $2; if (n[$1] == 1) name[++m] = $1 } ".\
  "END { for (k = 2; k <= m; k++) if (".condition.") printf \"%s \", name[k] }' '".data."'")
swept = rows_where("n[name[k]] > 1 && c[name[k]] == \"library\"")
single = rows_where("n[name[k]] == 1")
colour(name) = colour_of(name, place_in(kernels, name))
# N beside the marks: its powers of ten.
labelled(name) = strcol("kernel") eq name && abs(log10(column("steps")) - floor(log10(column("steps")) + 0.5)) < 1e-9 ? 1.0 : NaN

set logscale xy
set yrange [*:1]
set xlabel "time of a collision (µs)"
set ylabel "pair error against the exact solution" offset -0.5,0
set format x "%g"
set format y "10^{%T}"
set lmargin at screen 0.11; set rmargin at screen 0.79
set bmargin at screen 0.195
set key at screen 0.815, graph 1 left top vertical maxrows 16 noenhanced Left reverse
plot for [k=1:words(kernels)] data using (of(word(kernels, k), column("ns_median") / 1000)):"error_exact_max" \
       with linespoints lt line_of(word(kernels, k), k) title word(kernels, k), \
     for [k=1:words(swept)] data using (of(word(swept, k), column("ns_median") / 1000)):"error_exact_median" \
       with linespoints lc rgb colour(word(swept, k)) lw 2 dt (1,4) pt 7 ps 0.3 title word(swept, k).", median", \
     for [k=1:words(swept)] data using (labelled(word(swept, k)) * column("ns_median") / 1000):"error_exact_max":(sprintf("N = %.0f", column("steps"))) \
       with labels left offset 0.9,0.5 font ",12" textcolor rgb grey notitle, \
     for [k=1:words(single)] data using (of(word(single, k), column("ns_median") / 1000)):"error_exact_max":(strcol("kernel")) \
       with labels left offset 1.1,0.2 font ",14" textcolor rgb ink noenhanced notitle, \
     for [k=1:words(single)] data using (of(word(single, k), column("ns_median") / 1000)):"error_exact_max":(0):(column("error_exact_median") - column("error_exact_max")) \
       with vectors nohead lc rgb colour(word(single, k)) lw 2 dt (1,4) notitle
