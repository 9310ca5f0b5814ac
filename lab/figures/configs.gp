# Speedup of every kernel in every build: the darker, the faster.
width = 1000; height = 620
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/study.gp" ARG1 ARG2 ARG3

kernels = words_of("kernel")
builds = words_of("config")
x(dummy) = place_in(builds, strcol("config"))
y(dummy) = place_in(kernels, strcol("kernel"))
cut(name) = name[1:strstrt(name, "-")-1]."\n".name[strstrt(name, "-")+1:]

stats data using "speedup" name "s" nooutput
middle = s_min + 0.58 * (s_max - s_min)
set palette defined (0 "#f7fbff", 0.35 "#9ecae1", 0.7 "#3182bd", 1 "#08306b")
set cbrange [s_min:s_max]
set cblabel "speedup over base, ".word(builds, 1) offset 0.5,0 noenhanced
set colorbox user origin screen 0.895, screen 0.11 size screen 0.022, screen 0.715
set format cb "%.1f"

version(compiler) = system("sed -n 's/^# ".compiler."-[a-z0-9]*: \\([^-]*\\), -.*/\\1/p' '".data."' | head -n 1")
compilers = system("sed -n 's/^# \\([a-z0-9]*\\)-[a-z0-9]*: .*/\\1/p' '".data."' | sort -u | tr '\\n' ' '")
versions = ""
do for [k=1:words(compilers)] { versions = versions.(k > 1 ? "; " : "").version(word(compilers, k)) }
set label 1002 versions

unset border; unset grid; unset key
set tics scale 0
set lmargin at screen 0.14; set rmargin at screen 0.88
set tmargin at screen 0.825; set bmargin at screen 0.11
set xrange [0.5:words(builds)+0.5]
set yrange [words(kernels)+0.5:0.5] noreverse
set x2range [0.5:words(builds)+0.5]
unset xtics
set x2tics () noenhanced
set ytics () noenhanced
do for [k=1:words(builds)] { set x2tics add (cut(word(builds, k)) k) }
do for [k=1:words(kernels)] { set ytics add (word(kernels, k) k) }
set title offset 0,1.6
cell = ",14"
number(from, to) = column("speedup") >= from && column("speedup") < to ? sprintf("%.2f", column("speedup")) : ""
plot data using (x(0)):(y(0)):(0.48):(0.47):"speedup" with boxxyerror fs solid 1 noborder lc palette, \
     data using (x(0)):(y(0)):(number(0, middle)) with labels font cell textcolor rgb ink, \
     data using (x(0)):(y(0)):(number(middle, s_max)) with labels font cell textcolor rgb "white", \
     data using (x(0)):(y(0)):(number(s_max, 1e9)) with labels font ",15:Bold" textcolor rgb "white", \
     data using (column("speedup") == s_max ? x(0) : NaN):(y(0)):(0.48):(0.47) with boxxyerror lc rgb orange lw 3 dt 1 fs empty
