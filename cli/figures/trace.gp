# One collision against normal impulse: slips, velocities and work, from the CSV of `carom trace`. Lines are the exact limit, circles
# Euler's method; with one solver only, it has the lines.
width = 1080; height = 780; tall = 1120
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/style.gp" ARG1 ARG2 ARG3 ARG4
unset title

solvers = words_of("solver")
both = words(solvers) > 1
turn = real(note("compression ends"))
stick = real(note("the balls stick"))
sticks = stick == stick && stick >= 0
of(name, x) = strcol("solver") eq name ? x : NaN
euler = "Euler's method, N = ".note("steps")
what = both ? "Lines: the exact limit. Circles: ".euler."." : (solvers[1:5] eq "exact" ? "The exact limit." : euler.".")
set label 1001 note("collision").": friction ".note("friction between the balls")." between the balls,".(narrow ? "\n" : " ").\
  note("friction of the cloth")." with the cloth; restitution ".note("restitution")."; slip: ".note("slip").".".(narrow ? "\n" : "  ").\
  what at screen 0.012, screen (narrow ? px(44) : 0.022) font ",11" textcolor rgb grey noenhanced

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen (narrow ? 1 - px(16) : 0.968) center font large textcolor rgb ink noenhanced
last = system("awk -F, '!/^#/ && $2 + 0 > m { m = $2 + 0 } END { print m }' '".data."'") + 0
set xrange [0:last]
set xlabel "normal impulse (N s)" offset 0,0.3
set key at graph 1.0, graph 1 left top Left reverse samplen 1.6 spacing 1.35
set object 1 rectangle from graph 0, graph 0 to first turn, graph 1 behind fillcolor rgb "#eef4f8" fillstyle solid noborder
if (sticks) set arrow 1 from first stick, graph 0 to first stick, graph 1 nohead back lc rgb purple lw 1.5 dt (6,4)
set label 2 "compression" at first turn/2, graph 1.035 center font ",11" textcolor rgb grey
set label 3 "restitution" at first (turn + last)/2, graph 1.035 center font ",11" textcolor rgb grey
set offsets 0, 0, graph 0.04, graph 0.04
array tints[4] = [blue, vermilion, green, orange]
circles = 20
every_n = ceil(system("grep -c -v -e '^#' -e '^solver' '".data."'") / words(solvers) / real(circles))

# A panel of `columns`, called `names`.
series = "plot for [k=1:words(names)] data using \"impulse_N_s\":(of(word(solvers, 1), column(word(columns, k)))) \
  with lines lc rgb tints[k] lw 2.2 title word(names, k), \
  for [k=1:(both ? words(names) : 0)] data every every_n using \"impulse_N_s\":(of(word(solvers, 2), column(word(columns, k)))) \
  with points pt 6 ps 0.9 lw 1.3 lc rgb tints[k] notitle"
left(p) = narrow ? 0.19 : p % 2 ? 0.092 : 0.585
right(p) = narrow ? 0.75 : p % 2 ? 0.38 : 0.88
high(p) = narrow ? upper(p, 4, 60, 115, 60) : p < 3 ? 0.885 : 0.44
low(p) = narrow ? lower(p, 4, 60, 115, 60) : p < 3 ? 0.585 : 0.14
place = "set lmargin at screen left(p); set rmargin at screen right(p); set tmargin at screen high(p); set bmargin at screen low(p)"

if (narrow) unset xlabel
p = 1; eval(place)
set ylabel "slip of ball 1 on ball 2 (m/s)" offset 0.3,0
late = stick > 0.4*last
if (sticks && late) set label 4 "they stick" at first stick, graph 0.94 right offset -0.6,0
if (sticks && !late) set label 4 "they stick" at first stick, graph 0.94 left offset 0.6,0
if (sticks) set label 4 font ",11" textcolor rgb purple
columns = "u_x_m_s u_z_m_s"; names = "u_x u_z"
eval(series)
unset label 1; unset label 4; unset label 1001

p = 2; eval(place)
set ylabel "slip over the cloth (m/s)" offset 0.3,0
columns = "d_x_m_s d_y_m_s b_x_m_s b_y_m_s"; names = "'ball 1, x' 'ball 1, y' 'ball 2, x' 'ball 2, y'"
eval(series)

p = 3; eval(place)
set ylabel "velocity (m/s)" offset 0.3,0
columns = "v1_x_m_s v1_y_m_s v2_x_m_s v2_y_m_s"; names = "'ball 1, x' 'ball 1, y' 'ball 2, x' 'ball 2, y'"
eval(series)

p = 4; eval(place)
if (narrow) set xlabel "normal impulse (N s)" offset 0,0.3
set ylabel "work of the normal force (J)" offset 0.3,0
set yrange [0:*]; set offsets 0, 0, graph 0.04, 0
unset key
columns = "work_J"; names = "work"
eval(series)
unset multiplot
