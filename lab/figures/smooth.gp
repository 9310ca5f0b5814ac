# A fine sweep of one input: the curve, a small stretch of it enlarged, and how far neighbouring results leave a smooth curve. From
# the CSV of `carom sweep --solver exact,euler`.
width = 1080; height = 760
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/../../cli/figures/style.gp" ARG1 ARG2 ARG3
unset title

over = note("over")
swept = over eq "w1z" ? "side spin of ball 1 (rad/s)" : over eq "cut" ? "turn of the line of centres (degrees)" : over
set label 1001 note("collision").": friction ".note("friction between the balls")." between the balls,".\
  " ".note("friction of the cloth")." with the cloth; restitution ".note("restitution")."; slip: ".note("slip").\
  ".  Euler's method: N = ".note("steps")."." at screen 0.012, screen 0.022 font ",11" textcolor rgb grey noenhanced
solvers = words_of("solver")
colour(name) = name eq "exact" ? sky : vermilion
full(name) = name eq "exact" ? "exact" : "Euler, N = ".note("steps")

# awk thins the sweep, so that the pictures stay small: a header, then rows of solver,x,y.
rows = "< awk -F, -v OFS=, '/^#/ { next } !at { for (k = 1; k <= NF; k++) name[$k] = k; at = 1; print \"solver,x,y\"; next } "
ends = system("awk -F, '!/^#/ && $1 != \"solver\" && !n++ { low = high = $2 + 0 } n { if ($2 + 0 < low) low = $2 + 0; if ($2 + 0 > high) high = $2 + 0 } END { print low, high }' '".data."'")
low = real(word(ends, 1)); high = real(word(ends, 2))
stuck = system("awk -F, '!/^#/ && $1 == \"exact\" && $4 != \"nan\" { if (!n++) low = $2; high = $2 } END { if (n) print low, high }' '".data."'")
sticks = words(stuck) == 2
zoom_low = (sticks ? real(word(stuck, 2)) : 0.5*(low + high)) - 0.006*(high - low); zoom_high = zoom_low + 0.01*(high - low)
thin = rows."n[$1]++ % 25 == 0 { print $1, $2, $3 }' '".data."'"
near = rows."$2 + 0 >= ".sprintf("%.9g", zoom_low)." && $2 + 0 <= ".sprintf("%.9g", zoom_high)." { print $1, $2, $3 }' '".data."'"
most = rows."$5 != \"nan\" { k = $1 OFS int(($2 - ".sprintf("%.9g", low).")/".sprintf("%.9g", (high - low)/300).\
  "); if (!(k in m)) { m[k] = 1e-12; x[k] = $2; order[++count] = k } if ($5 + 0 > m[k]) m[k] = $5 + 0 } "."END { for (i = 1; i <= count; i++) { k = order[i]; split(k, part, OFS); print part[1], x[k], m[k] } }' '".data."'"
# The enlarged stretch, which begins where the balls still stick, is drawn less the chord of the exact curve.
chord = system("awk -F, '!/^#/ && $1 == \"exact\" && $2 + 0 >= ".sprintf("%.9g", zoom_low)." && $2 + 0 <= ".sprintf("%.9g", zoom_high).\
  " { if (!n++) { a = $2; b = $3 } c = $2; d = $3 } END { if (n > 1) print a, b, (d - b)/(c - a); else print 0, 0, 0 }' '".data."'")
off_chord(x, y) = 1000*(y - real(word(chord, 2)) - real(word(chord, 3))*(x - real(word(chord, 1))))
of(name, x) = strcol("solver") eq name ? x : NaN

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen 0.967 center font large textcolor rgb ink noenhanced
high(p) = p < 3 ? 0.9 : 0.415
low(p) = p < 3 ? 0.55 : 0.14
left(p) = p == 2 ? 0.6 : 0.085
right(p) = p == 1 ? 0.5 : 0.975
place = "set lmargin at screen left(p); set rmargin at screen right(p); set tmargin at screen high(p); set bmargin at screen low(p)"
set key top left Left reverse samplen 2

p = 1; eval(place)
set xrange [low:high]
set xlabel swept offset 0,0.3
set ylabel "throw of ball 2 (degrees)" offset 0.5,0
if (sticks) set object 1 rectangle from first real(word(stuck, 1)), graph 0 to first real(word(stuck, 2)), graph 1 behind \
  fillcolor rgb "#f3edf4" fillstyle solid noborder
if (sticks) set label 2 "the balls come to stick" at first 0.5*(real(word(stuck, 1)) + real(word(stuck, 2))), graph 1.04 center \
  font ",11" textcolor rgb grey
set arrow 2 from first zoom_low, graph 0.12 to first zoom_low, graph 0.01 lc rgb grey lw 1.2
set label 3 "enlarged" at first zoom_low, graph 0.16 center font ",11" textcolor rgb grey
plot for [k=1:words(solvers)] thin using "x":(of(word(solvers, k), column("y"))) with lines lc rgb colour(word(solvers, k)) \
  lw (k == 1 ? 5 : 1.4) title full(word(solvers, k))
unset label 1; unset label 1001; unset label 2; unset label 3; unset arrow 2; unset object 1

p = 2; eval(place)
set xrange [zoom_low:zoom_high]
set ylabel "throw, less a straight line (0.001 degrees)" offset 0.5,0
set label 2 "a hundredth of it" at graph 0.5, graph 1.04 center font ",11" textcolor rgb grey
unset key
plot for [k=1:words(solvers)] near using "x":(of(word(solvers, k), off_chord(column("x"), column("y")))) with linespoints \
  lc rgb colour(word(solvers, k)) lw (k == 1 ? 3 : 1.2) pt 7 ps (k == 1 ? 0.35 : 0.3)
unset label 2

p = 3; eval(place)
set xrange [low:high]
set logscale y; set format y "10^{%T}"
set yrange [1e-12:1]; set mytics 1
set ytics 1e-12, 100; set ytics add ("1" 1)
set ylabel "jump, over the scale" offset 1,0
if (sticks) set object 1 rectangle from first real(word(stuck, 1)), graph 0 to first real(word(stuck, 2)), graph 1 behind \
  fillcolor rgb "#f3edf4" fillstyle solid noborder
set label 2 "largest jump of any of the twelve results between neighbouring values" at graph 0.5, graph 1.05 center font ",11" \
  textcolor rgb grey
set arrow 3 from graph 0, first 1e-6 to graph 1, first 1e-6 nohead lc rgb grey lw 1.2 dt (6,4)
set label 3 "10^{-6}" at graph 0.995, first 2.2e-6 right font ",11" textcolor rgb grey
set key top right horizontal samplen 2
plot for [k=1:words(solvers)] most using "x":(of(word(solvers, k), column("y"))) with lines lc rgb colour(word(solvers, k)) \
  lw (k == 1 ? 2.4 : 1.4) title full(word(solvers, k))
unset multiplot
