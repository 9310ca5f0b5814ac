# Error against time, a line for each kernel that takes steps and a mark for each that does not. Solid: the largest error over the
# cases; dotted: the median, for the library's kernels.
width = 1000; height = 620
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/style.gp" ARG1 ARG2 ARG3

kernels = words_of("kernel")
of(name, x) = strcol("kernel") eq name ? x : NaN
library = system("awk -F, '!/^#/ && $2 == \"library\" && !seen[$1]++ { printf \"%s \", $1 }' '".data."'")
# N beside the marks of the library's kernels.
labelled(name) = strcol("kernel") eq name && strcol("config") eq "library" && column("steps") > 0 && \
  abs(log10(column("steps")) - floor(log10(column("steps")) + 0.5)) < 1e-9 ? 1.0 : NaN

set logscale xy
set yrange [*:1]
set xlabel "time of a collision (µs)"
set ylabel "pair error against the exact solution" offset -0.5,0
set format x "%g"
set format y "10^{%T}"
set lmargin at screen 0.095; set rmargin at screen 0.79
set bmargin at screen 0.195
set key at screen 0.815, graph 1 left top vertical maxrows 12 noenhanced Left reverse
plot for [k=1:words(kernels)] data using (of(word(kernels, k), column("ns_median") / 1000)):"error_exact_max" \
       with linespoints lt line_of(word(kernels, k), k) title word(kernels, k), \
     for [k=1:words(library)] data using (of(word(library, k), column("ns_median") / 1000)):"error_exact_median" \
       with linespoints lc rgb colour_of(word(library, k), place_in(kernels, word(library, k))) lw 2 dt (1,4) pt 7 ps 0.3 \
       title word(library, k).", median", \
     for [k=1:words(library)] data using (labelled(word(library, k)) * column("ns_median") / 1000):"error_exact_max":(sprintf("N = %.0f", column("steps"))) \
       with labels left offset 0.9,0.5 font ",12" textcolor rgb grey notitle
