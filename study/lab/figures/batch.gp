# Throughput over batch size, and over threads.
width = 1000; height = 520
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/../../figures/study.gp" ARG1 ARG2 ARG3
unset title

number(program) = real(system("awk -F, '/^#/ { next } !at { for (k = 1; k <= NF; k++) if ($k == \"pairs\") at = k; next } ".program."' '".data."'"))
batch = "$1 != \"copy\" && $3 != \"scalar\" && $5 > t { t = $5 } END { print t }"
threads = number(batch)
# The batch whose threads are compared: the smallest of at least 65,536 pairs, or the largest there is.
size = number("$3 != \"scalar\" && $at > m { m = $at } $3 != \"scalar\" && $at >= 65536 && (!s || $at < s) { s = $at } END { print s ? s : m }")
single = number("$3 == \"scalar\" && $6 == 0 { print $7; exit }")
alone(p) = number("$1 != \"copy\" && $3 != \"scalar\" && $4 == \"".p."\" && $5 == 1 && $at == ".sprintf("%.0f", size)." { print $7; exit }")
alone_double = alone("double"); alone_single = alone("single")
isa = system("awk -F, '/^#/ { next } n++ && $3 != \"scalar\" { print $3; exit }' '".data."'")
is(p) = strcol("kernel") ne "copy" && strcol("isa") ne "scalar" && strcol("precision") eq p
with_threads(p, t) = is(p) && column("threads") == t ? column("pairs") : NaN
of_size(p) = is(p) && column("pairs") == size ? column("threads") : NaN
rate(dummy) = 1000 / column("ns_median")

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen 0.945 center font large textcolor rgb ink
set tmargin at screen 0.88
set bmargin at screen 0.225
set lmargin at screen 0.085; set rmargin at screen 0.60
set logscale xy
set xrange [0.8:4e5]
set format x "%.0f"
set xtics (1, "" 2, "" 4, 8, "" 16, "" 32, 64, "" 128, "" 256, 512, "" 1024, "" 2048, "4,096" 4096, "" 8192, "" 16384, "32,768" 32768, "" 65536, "" 131072, "262,144" 262144)
set format y "%g"
set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000)
set xlabel "pairs in a batch"
set ylabel "million collisions in a second" offset 0.5,0
set key bottom right Left reverse noenhanced
stats data using (strcol("kernel") ne "copy" && column("steps") == 0 ? rate(0) : NaN) name "r" nooutput
# The key stands below the line of single calls.
top = 1.5 * r_max
room = single > 0 ? 10**((log10(1000 / single) - 0.45 * log10(top)) / 0.55) : r_min
set yrange [0.6 * r_min < room ? 0.6 * r_min : room:top]
plot data using (with_threads("single", 1)):(rate(0)) with linespoints lc rgb vermilion lw 2 dt (12,4) pt 9 ps 1 title isa.", single", \
     data using (with_threads("double", 1)):(rate(0)) with linespoints lc rgb blue lw 2 dt 1 pt 7 ps 0.9 title isa.", double", \
     for [k=1:threads>1] data using (with_threads("single", threads)):(column("pairs") < 4096 ? NaN : rate(0)) \
       with linespoints lc rgb vermilion lw 2 dt (3,3) pt 8 ps 1.2 title sprintf("%s, single, %d threads", isa, threads), \
     for [k=1:threads>1] data using (with_threads("double", threads)):(column("pairs") < 4096 ? NaN : rate(0)) \
       with linespoints lc rgb blue lw 2 dt (3,3) pt 6 ps 1.1 title sprintf("%s, double, %d threads", isa, threads), \
     for [k=1:single>0] 1000 / single with lines lc rgb ink lw 2 dt (8,5) title "single calls, double"

unset label 1; unset label 1001; unset label 1002; unset logscale
set tmargin at screen 0.88
set bmargin at screen 0.225
set lmargin at screen 0.72; set rmargin at screen 0.98
set xrange [0.5:threads+0.7]
set yrange [0:*]
set xtics autofreq 1
set ytics autofreq
if (threads > 8) set xtics autofreq ceil(threads / 8.0)
set xlabel sprintf("threads, %.0f,%03.0f pairs", floor(size / 1000), size - 1000 * floor(size / 1000))
set key top left Left reverse
gain(p, ns) = sprintf("%.2f ×", ns / column("ns_median"))
plot 1000 * x / alone_single with lines lc rgb vermilion lw 1 dt (1,4) notitle, \
     1000 * x / alone_double with lines lc rgb blue lw 1 dt (1,4) notitle, \
     data using (of_size("single")):(rate(0)) with linespoints lc rgb vermilion lw 2 dt (12,4) pt 9 ps 1.2 title "single", \
     data using (of_size("double")):(rate(0)) with linespoints lc rgb blue lw 2 dt 1 pt 7 ps 1.1 title "double", \
     data using (column("threads") > 1 ? of_size("single") : NaN):(rate(0)):(gain("single", alone_single)) \
       with labels left offset 0.6,-0.9 font ",12" textcolor rgb ink notitle, \
     data using (column("threads") > 1 ? of_size("double") : NaN):(rate(0)):(gain("double", alone_double)) \
       with labels left offset 0.6,-0.9 font ",12" textcolor rgb ink notitle
unset multiplot
