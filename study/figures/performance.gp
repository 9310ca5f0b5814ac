# Operations per cycle over N, and for each kernel the bounds by its longest chain, with the latencies of Zen 2 and of this processor.
width = 1000; height = 560
build = system("awk -F, '/^#/ { next } n++ { print $2; exit }' '".ARG1."'")
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/study.gp" ARG1 ARG2 ARG3

kernels = words_of("kernel")
of(name, x) = strcol("kernel") eq name ? x : NaN
stats data using "steps" name "n" nooutput
of_last(name, x) = x == n_max ? of(name, x) : NaN # a bound has its kernel's mark at its end
set logscale x
set format x "%.0f"
set xlabel "steps N"
set yrange [0:*]
set ylabel "floating point operations per core cycle" offset 0.5,0
set lmargin at screen 0.085; set rmargin at screen 0.635
set bmargin at screen 0.24
set key at screen 0.65, graph 1 left top vertical maxrows 12 noenhanced Left reverse
set label 1003 "operations: ".note("operations")."; cycles: ".note("cycles") at screen 0.012, screen 0.022 font ",10" textcolor rgb grey
set label 1002 at screen 0.012, screen 0.050
set label 1001 at screen 0.012, screen 0.078
share(name) = system("awk -F, '/^#/ { next } $1 == \"".name."\" { s = $10 } END { print s }' '".data."'")
entry(name) = sprintf("%s, %.0f %% of its bound here", name, 100 * real(share(name)))
set offsets 0, 0, graph 0.08, 0
plot for [k=1:words(kernels)] data using "steps":(of(word(kernels, k), column("flops_per_cycle"))) \
       with linespoints lt line_of(word(kernels, k), k) dt 1 title entry(word(kernels, k)), \
     for [k=1:words(kernels)] data using "steps":(of(word(kernels, k), column("bound_flops_per_cycle"))) \
       with lines lc rgb colour_of(word(kernels, k), k) lw 2 dt (8,5) notitle, \
     for [k=1:words(kernels)] data using "steps":(of(word(kernels, k), column("bound_here_flops_per_cycle"))) \
       with lines lc rgb colour_of(word(kernels, k), k) lw 2 dt (2,4) notitle, \
     for [k=1:words(kernels)] data using (of_last(word(kernels, k), column("steps"))):"bound_flops_per_cycle" \
       with points lt line_of(word(kernels, k), k) ps 0.9 notitle, \
     for [k=1:words(kernels)] data using (of_last(word(kernels, k), column("steps"))):"bound_here_flops_per_cycle" \
       with points lt line_of(word(kernels, k), k) ps 0.9 notitle, \
     keyentry with lines lc rgb grey lw 2 dt (8,5) title "bounds of Zen 2", \
     keyentry with lines lc rgb grey lw 2 dt (2,4) title "bounds of this processor"
