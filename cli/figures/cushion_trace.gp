# One impact on a cushion against normal impulse: slips, velocities and work, from the CSV of `carom trace --cushion`.
width = 1080; height = 780; tall = 1120
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/style.gp" ARG1 ARG2 ARG3 ARG4
unset title

turn = real(note("compression ends"))
from(what) = real(note(what))
what = note("model") eq "euler" ? "Mathavan's model of 2010 in steps, N = ".note("steps")."." : "The exact limit of Mathavan's model of 2010."
set label 1001 note("impact").": friction ".note("friction of the cushion")." with the cushion,".(narrow ? "\n" : " ").\
  note("friction of the cloth")." with the cloth; restitution ".note("restitution").".".(narrow ? "\n" : "  ").\
  what at screen 0.012, screen (narrow ? px(44) : 0.022) font ",11" textcolor rgb grey noenhanced

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen (narrow ? 1 - px(16) : 0.968) center font large textcolor rgb ink noenhanced
last = system("awk -F, '!/^#/ && $2 + 0 > m { m = $2 + 0 } END { print m }' '".data."'") + 0
set xrange [0:last]
set xlabel "normal impulse (N s)" offset 0,0.3
set key at graph 1.0, graph 1 left top Left reverse samplen 1.6 spacing 1.35
set object 1 rectangle from graph 0, graph 0 to first turn, graph 1 behind fillcolor rgb "#eef4f8" fillstyle solid noborder
set label 2 "compression" at first turn/2, graph 1.035 center font ",11" textcolor rgb grey
set label 3 "restitution" at first (turn + last)/2, graph 1.035 center font ",11" textcolor rgb grey
set offsets 0, 0, graph 0.04, graph 0.04
array tints[4] = [blue, vermilion, green, orange]

# A panel of `columns`, called `names`.
series = "plot for [k=1:words(names)] data using \"impulse_N_s\":(column(word(columns, k))) with lines lc rgb tints[k] lw 2.2 title word(names, k)"
left(p) = narrow ? 0.19 : p % 2 ? 0.092 : 0.585
right(p) = narrow ? 0.75 : p % 2 ? 0.38 : 0.88
high(p) = narrow ? upper(p, 4, 60, 115, 60) : p < 3 ? 0.885 : 0.44
low(p) = narrow ? lower(p, 4, 60, 115, 60) : p < 3 ? 0.585 : 0.14
place = "set lmargin at screen left(p); set rmargin at screen right(p); set tmargin at screen high(p); set bmargin at screen low(p)"
# From where the ball sticks in this panel, if it does.
mark = "unset arrow 1; unset label 4; if (at == at && at > 0) { set arrow 1 from first at, graph 0 to first at, graph 1 nohead back lc rgb purple lw 1.5 dt (6,4); \
  if (at > 0.4*last) { set label 4 'it sticks' at first at, graph 0.94 right offset -0.6,0 font ',11' textcolor rgb purple } \
  else { set label 4 'it sticks' at first at, graph 0.94 left offset 0.6,0 font ',11' textcolor rgb purple } }"

if (narrow) unset xlabel
p = 1; eval(place)
at = from("the nose sticks"); eval(mark)
set ylabel "slip on the cushion (m/s)" offset 0.3,0
columns = "s_x_m_s s_t_m_s"; names = "along upwards"
eval(series)
unset label 1; unset label 1001

p = 2; eval(place)
at = from("the cloth sticks"); eval(mark)
set ylabel "slip on the cloth (m/s)" offset 0.3,0
columns = "c_x_m_s c_y_m_s"; names = "along 'into it'"
eval(series)
at = NaN; eval(mark)

p = 3; eval(place)
set ylabel "velocity (m/s)" offset 0.3,0
columns = "v_x_m_s v_y_m_s"; names = "along 'into it'"
eval(series)

p = 4; eval(place)
if (narrow) set xlabel "normal impulse (N s)" offset 0,0.3
set ylabel "work of the normal force (J)" offset 0.3,0
set yrange [0:*]; set offsets 0, 0, graph 0.04, 0
unset key
columns = "work_J"; names = "work"
eval(series)
unset multiplot
