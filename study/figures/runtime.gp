# Run time over N: as the paper draws it, and per step, where the kernels come apart.
width = 1000; height = 500
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/study.gp" ARG1 ARG2 ARG3
unset title

kernels = words_of("kernel")
of(name, x) = strcol("kernel") eq name ? x : NaN

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen 0.945 center font large textcolor rgb ink
set logscale x
set xlabel "steps N"
set format x "%.0f"
set tmargin at screen 0.88
set bmargin at screen 0.235

set lmargin at screen 0.095; set rmargin at screen 0.48
set logscale y
set format y "%g"
set ylabel "time of a collision (µs)" offset -0.5,0
set key bottom right noenhanced Left reverse
plot for [k=1:words(kernels)] data using "steps":(of(word(kernels, k), column("ns_median") / 1000)) with linespoints lt line_of(word(kernels, k), k) title word(kernels, k)

unset key; unset label 1; unset label 1001; unset label 1002
set tmargin at screen 0.88
set bmargin at screen 0.235
set lmargin at screen 0.585; set rmargin at screen 0.965
unset logscale y
set yrange [0:*]
set ylabel "time of a collision / N (ns)" offset 0,0
plot for [k=1:words(kernels)] data using "steps":(of(word(kernels, k), column("ns_median") / column("steps"))) with linespoints lt line_of(word(kernels, k), k)
unset multiplot
