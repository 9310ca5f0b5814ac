# Bars: the speedup of the scalar kernels but the bit tricks, and the paper's beside it where it gives a number.
width = 920; height = 520
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/study.gp" ARG1 ARG2 ARG3

scalar(x) = strcol("needs") eq "scalar" && strstrt(strcol("kernel"), "fisr") == 0 ? x : NaN
kernels = system("awk -F, '!/^#/ && $3 == \"scalar\" && $1 !~ /fisr/ { printf \"%s \", $1 }' '".data."'")
at(dummy) = place_in(kernels, strcol("kernel"))
paper(dummy) = strcol("paper") eq "NA" ? NaN : column("paper")

stats data using (scalar(column("speedup"))) name "s" nooutput
set xrange [0.45:words(kernels)+0.55]
set yrange [0:s_max > 2 ? 1.15 * s_max : 2.3]
set ylabel "speedup over base" offset 0.5,0
set format y "%.1f"
set xtics () scale 0 noenhanced
do for [k=1:words(kernels)] { set xtics add (word(kernels, k) k) }
unset grid
set grid ytics lc rgb faint lt 1 lw 1 dt 1
set lmargin at screen 0.085; set rmargin at screen 0.98
set bmargin at screen 0.165
small = ",13"
set key top left horizontal Left reverse noenhanced samplen 1.5
plot data using (scalar(at(0)) - 0.2):"speedup":(0.36) with boxes fs solid 1 lc rgb blue dt 1 title "here", \
     data using (scalar(at(0)) + 0.2):(paper(0)):(0.36) with boxes fs pattern 4 lc rgb vermilion dt 1 title "seed paper (Zen 2)", \
     data using (scalar(at(0)) - 0.2):"speedup":(sprintf("%.2f", column("speedup"))) \
       with labels offset 0,0.7 font small textcolor rgb ink notitle, \
     data using (scalar(at(0)) + 0.2):(paper(0)):(sprintf("%.2f", column("paper"))) with labels offset 0,0.7 font small textcolor rgb ink notitle, \
     data using (scalar(at(0)) + 0.2):(strcol("paper") eq "NA" ? 0 : NaN):(strcol("paper_text")) \
       with labels left rotate by 90 offset 0,0.8 font ",12" textcolor rgb grey notitle
