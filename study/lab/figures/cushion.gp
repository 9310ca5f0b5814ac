# A ball and a cushion: rebound beside what was measured, a fine sweep of the side spin, its jumps. Three panels, one key below them.
width = 1080; height = 470
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/../../../command/figures/style.gp" ARG1 ARG2 ARG3
unset title
of(name, x) = strcol("what") eq name ? x : NaN
left(k) = 0.08 + 0.33 * (k - 1)
panel = "set lmargin at screen left(k); set rmargin at screen left(k) + 0.24; set label 2 panel_title at graph 0.5, graph 1.05 center font ',13' textcolor rgb ink"
set tmargin at screen 0.82; set bmargin at screen 0.30
set multiplot
set label 1 heading at screen 0.5, screen 0.95 center font large textcolor rgb ink
unset key

k = 1; panel_title = "rolling balls, straight into the cushion"; eval(panel)
set xlabel "speed before (m/s)"; set ylabel "speed after (m/s)" offset 0.5,0
set arrow 1 from 2.5, 0 to 2.5, 3.4 nohead dt (3,3) lc rgb grey
set label 3 "measured up to here" at 2.42, 0.25 right font ",11" textcolor rgb grey
plot [0:3.5] [0:3.4] (x < 0.28 ? NaN : -0.0877*x**2 + 1.131*x - 0.0953) with lines lw 2 dt (12,4) lc rgb ink, \
  data using "x":(of("rebound", column("y"))) with lines lw 2 dt 1 lc rgb blue
unset label 1; unset label 3; unset label 1001; unset label 1002; unset arrow 1

k = 2; panel_title = "a fine sweep of the side spin"; eval(panel)
set xlabel "side spin before (rad/s)"; set ylabel "speed after, away from it (m/s)" offset 0.8,0
set format y "%.3f"; set xtics 1
plot [46:50] data using "x":(of("fine-euler", column("y"))) with lines lw 1 dt 1 lc rgb vermilion, \
  data using "x":(of("fine-exact", column("y"))) with lines lw 2 dt 1 lc rgb blue

k = 3; panel_title = "jumps between neighbouring values"; eval(panel)
set format y "10^{%T}"; set logscale y; set xtics 20; set ytics 1e-12, 100; set mytics 1
set ylabel "jump, over the largest speed" offset 0.8,0
plot [-60:60] [1e-12:1e-1] data using "x":(of("jump-euler", column("y"))) with points pt 7 ps 0.15 lc rgb vermilion, \
  data using "x":(of("jump-exact", column("y"))) with points pt 7 ps 0.15 lc rgb blue

# The key, below all three.
unset label 2; unset xlabel; unset ylabel; unset tics; unset border; unset logscale y; unset grid
set lmargin at screen 0.05; set rmargin at screen 0.98; set tmargin at screen 0.11; set bmargin at screen 0.05
set key center center horizontal maxrows 1 Left reverse noenhanced samplen 3
plot [0:1] [0:1] NaN notitle, keyentry with lines lw 2 dt (12,4) lc rgb ink title "measured (2010 paper's fit)", \
  keyentry with lines lw 2 dt 1 lc rgb blue title "exact limit (left: e = 0.98)", \
  keyentry with lines lw 2 dt 1 lc rgb vermilion title "pooltool's steps"
unset multiplot
