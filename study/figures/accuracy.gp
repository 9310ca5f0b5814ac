# Error against time: a line for each kernel that was swept over N, dashed for those across collisions; marks for solvers that take no
# steps: one for single calls, and for batches one for each number of threads. Marks stand at the largest error of the cases; a dotted
# line drops from the largest error to the median, for the library's solvers. Digits are numbers of threads.
width = 1000; height = 640
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/study.gp" ARG1 ARG2 ARG3

# Names: 1 kernel, 2 config, 3 isa, 4 precision, 6 steps.
select(what, condition) = system("awk -F, '/^#/ { next } n++ && (".condition.") && !seen[".what."]++ { printf \"%s \", ".what." }' '".data."'")
kernels = select("$1", "$3 == \"scalar\" && $6 > 0")
swept = select("$1", "$3 == \"scalar\" && $6 > 0 && $2 == \"library\"")
single = select("$1", "$3 == \"scalar\" && $6 == 0")
across = select("$1", "$3 != \"scalar\" && $6 > 0 && $2 != \"library\"")
lanes = select("$1 \":\" $3 \":\" $4", "$3 != \"scalar\" && $1 != \"copy\" && $2 == \"library\"")
of(name, x) = strcol("isa") eq "scalar" && strcol("kernel") eq name ? x : NaN
over(name, x) = strcol("isa") ne "scalar" && strcol("kernel") eq name ? x : NaN
# Across collisions: the colour of the kernel whose steps they take, and open marks.
single_precision(name) = strstrt(name, "float") == 1
in(lane, x) = strcol("kernel").":".strcol("isa").":".strcol("precision") eq lane ? x : NaN
part(lane, k) = system("echo '".lane."' | cut -d: -f".k)
colour(name) = colour_of(name, place_in(kernels, name))
us(dummy) = column("ns_median") / 1000
down(dummy) = column("error_exact_median") - column("error_exact_max")
# N beside the marks: its powers of ten.
labelled(name) = strcol("isa") eq "scalar" && strcol("kernel") eq name && \
  abs(log10(column("steps")) - floor(log10(column("steps")) + 0.5)) < 1e-9 ? 1.0 : NaN

stats data using (strcol("kernel") ne "copy" ? us(0) : NaN) name "s" nooutput
set logscale xy
set yrange [*:1]
set xrange [0.6 * s_min:3 * s_max]
set xlabel "time of a collision"
set ylabel "pair error against the exact solution" offset -0.5,0
set xtics ("1 ns" 0.001, "10 ns" 0.01, "100 ns" 0.1, "1 µs" 1, "10 µs" 10, "100 µs" 100, "1 ms" 1000, "10 ms" 10000)
do for [decade=-3:4] { do for [digit=2:9] { set xtics add ("" digit * 10.0**decade 1) } }
set ytics 10
set mytics 10
set format y "10^{%T}"
set lmargin at screen 0.10; set rmargin at screen 0.745
set bmargin at screen 0.19
set key at screen 0.76, graph 1 left top vertical maxrows 20 noenhanced Left reverse samplen 2.5
set label 1003 "Lines: over the steps N.\nDashed: a collision in each lane.\nMarks: the largest error.\nDotted: down to the median.\nDigits: threads of a batch." \
  at screen 0.768, screen 0.30 font ",11" textcolor rgb grey
mark(k) = 7 + 2 * ((k - 1) / 2) % 8 + (k % 2 ? 2 : 1)
plot for [k=1:words(kernels)] data using (of(word(kernels, k), us(0))):"error_exact_max" smooth unique \
       with linespoints lt line_of(word(kernels, k), k) title word(kernels, k), \
     for [k=1:words(across)] data using (over(word(across, k), us(0))):"error_exact_max" smooth unique \
       with linespoints lc rgb (single_precision(word(across, k)) ? vermilion : blue) lw 2 dt (6,4) \
       pt (single_precision(word(across, k)) ? 8 : 6) ps 1.0 title word(across, k), \
     for [k=1:words(swept)] data using (of(word(swept, k), us(0))):"error_exact_median" \
       with linespoints lc rgb colour(word(swept, k)) lw 2 dt (1,4) pt 7 ps 0.3 title word(swept, k).", median", \
     for [k=1:words(swept)] data using (labelled(word(swept, k)) * us(0)):"error_exact_max":(sprintf("N = %.0f", column("steps"))) \
       with labels left offset 0.9,0.5 font ",12" textcolor rgb grey notitle, \
     for [k=1:words(single)] data using (of(word(single, k), us(0))):"error_exact_max":(0):(down(0)) \
       with vectors nohead lc rgb colour(word(single, k)) lw 2 dt (1,4) notitle, \
     for [k=1:words(lanes)] data using (in(word(lanes, k), us(0))):"error_exact_max":(0):(down(0)) \
       with vectors nohead lc rgb colour(part(word(lanes, k), 1)) lw 2 dt (1,4) notitle, \
     for [k=1:words(single)] data using (of(word(single, k), us(0))):"error_exact_max" \
       with points lc rgb colour(word(single, k)) lw 2 pt (k == 1 ? 7 : 5) ps 1.2 title word(single, k).", single calls", \
     for [k=1:words(lanes)] data using (in(word(lanes, k), us(0))):"error_exact_max" \
       with linespoints lc rgb colour(part(word(lanes, k), 1)) lw 2 dt 1 pt mark(k) ps 1.3 \
       title part(word(lanes, k), 1).", ".part(word(lanes, k), 3).", ".part(word(lanes, k), 2), \
     for [k=1:words(lanes)] data using (in(word(lanes, k), us(0))):"error_exact_max":(sprintf("%d", column("threads"))) \
       with labels center offset -0.9,(part(word(lanes, k), 1) eq "fast" ? -0.8 : 0.8) font ",12" textcolor rgb grey notitle
