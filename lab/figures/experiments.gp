# The 2014 paper's shots: speeds and angles, measured, predicted, and by each solver.
width = 1000; height = 680
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/study.gp" ARG1 ARG2 ARG3
unset title

shots = words_of("shot")
sources = words_of("source")
solvers = system("echo '".sources."' | sed 's/measured//;s/predicted//'")
n = words(sources)
x(source) = strcol("source") eq source ? place_in(shots, strcol("shot")) + 0.62 * (place_in(sources, source) - 0.5 * (n + 1)) / n : NaN
colour(k) = word(ink." ".vermilion." ".blue." ".orange." ".green." ".purple, k)
mark(k) = int(word("5 6 7 2 9 4", k))
# The largest distance of a solver from the prediction, in the columns from..to.
off(solver, from, to) = real(system("awk -F, '$2 == \"predicted\" { for (k = ".from."; k <= ".to."; k++) p[$1, k] = $k } ".\
  "$2 == \"".solver."\" { for (k = ".from."; k <= ".to."; k++) { d = $k - p[$1, k]; if (d < 0) d = -d; if (d > m) m = d } } END { print m + 0 }' '".data."'"))
said = ""
do for [k=1:words(solvers)] {
  said = said.(k > 1 ? "; " : "farthest from the prediction: ").word(solvers, k).sprintf(" %.4f m/s, %.3f°", off(word(solvers, k), "3", "4"), off(word(solvers, k), "5", "6"))
}

unset label 1001
set label 1002 said
set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen 0.966 center font large textcolor rgb ink
set xrange [0.5:words(shots)+0.5]
set xtics () scale 0 noenhanced
do for [k=1:words(shots)] { set xtics add (word(shots, k)[strstrt(word(shots, k), "-")+1:] k) }
set x2range [0.5:words(shots)+0.5]
unset grid
set grid ytics lc rgb faint lt 1 lw 1 dt 1
do for [k=1:words(shots)-1] { set arrow k from k + 0.5, graph 0 to k + 0.5, graph 1 nohead lc rgb faint lw 1 dt 1 back }
set offsets 0, 0, graph 0.09, graph 0.09
columns = "v_cue v_object angle_cue_deg angle_object_deg"
title(k) = k == 1 ? "cue ball, m/s" : k == 2 ? "object ball, m/s" : k == 3 ? "cue ball, degrees" : "object ball, degrees"
do for [k=1:4] {
  left = k % 2 ? 0.065 : 0.555
  top = k < 3 ? 0.83 : 0.435
  set lmargin at screen left; set rmargin at screen left + 0.42
  set tmargin at screen top; set bmargin at screen top - 0.295
  set label 2 title(k) at graph 0, graph 1.07 left font ",14" textcolor rgb ink
  if (k > 2) { set xlabel "shot" offset 0,0.3 } else { unset xlabel }
  if (k == 1) { set key at screen 0.5, screen 0.91 center horizontal maxrows 1 Left reverse noenhanced samplen 1 width 4 } else { unset key }
  plot for [s=1:n] data using (x(word(sources, s))):(column(word(columns, k))) \
    with points pt mark(s) ps 1.2 lw 2 lc rgb colour(s) title word(sources, s)
  unset label 1; unset label 1002
}
unset multiplot
