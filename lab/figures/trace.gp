# One collision or one impact on a cushion against normal impulse: slips, velocities and work, from the CSV of `carom trace`. Lines
# are the exact limit, circles Euler's method; with one solver only, it has the lines.
width = 760; height = 1120; tall = 1120
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/style.gp" ARG1 ARG2 ARG3 ARG4
unset title

# What differs by kind: the column of solvers, the panels, and from where each panel's contact sticks (NaN: never, or no such contact).
rail = strlen(note("impact")) > 0
solver = rail ? "model" : "solver"
from(what) = strlen(note(what)) > 0 ? real(note(what)) : NaN
array labels[4]; array columns[4]; array names[4]; array stuck[4]
labels[3] = "velocity (m/s)"; labels[4] = "work of the normal force (J)"
columns[4] = "work_J"; names[4] = "work"
if (rail) {
  labels[1] = "slip on the cushion (m/s)"; columns[1] = "s_x_m_s s_t_m_s"; names[1] = "along upwards"
  labels[2] = "slip on the cloth (m/s)"; columns[2] = "c_x_m_s c_y_m_s"; names[2] = "along 'into it'"
  columns[3] = "v_x_m_s v_y_m_s"; names[3] = "along 'into it'"
  stuck[1] = from("the nose sticks"); stuck[2] = from("the cloth sticks"); stuck[3] = NaN; stuck[4] = NaN
  said = note("impact").": friction ".note("friction of the cushion")." with the cushion,"
} else {
  labels[1] = "slip of ball 1 on ball 2 (m/s)"; columns[1] = "u_x_m_s u_z_m_s"; names[1] = "u_x u_z"
  labels[2] = "slip over the cloth (m/s)"; columns[2] = "d_x_m_s d_y_m_s b_x_m_s b_y_m_s"
  columns[3] = "v1_x_m_s v1_y_m_s v2_x_m_s v2_y_m_s"
  names[2] = "'ball 1, x' 'ball 1, y' 'ball 2, x' 'ball 2, y'"; names[3] = names[2]
  do for [k=1:4] { stuck[k] = from("the balls stick") }
  said = note("collision").": friction ".note("friction between the balls")." between the balls,"
}

# What is shown, below the panels.
solvers = words_of(solver)
both = words(solvers) > 1
of(name, x) = strcol(solver) eq name ? x : NaN
exact = rail ? "the exact limit of Mathavan's model of 2010" : "the exact limit"
euler = rail ? "Mathavan's model of 2010 in steps, N = ".note("steps") : "Euler's method, N = ".note("steps")
what = both ? "Lines: ".exact.". Circles: ".euler."." : solvers[1:5] eq "euler" ? euler."." : "T".exact[2:]."."
set label 1001 said."\n".note("friction of the cloth")." with the cloth; restitution ".note("restitution").\
  (rail ? "." : "; slip: ".note("slip").".")."\n".what at screen 0.012, screen px(48) textcolor rgb grey noenhanced

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen 1 - px(16) center font large textcolor rgb ink noenhanced
turn = from("compression ends")
last = system("awk -F, '!/^#/ && $2 + 0 > m { m = $2 + 0 } END { print m }' '".data."'") + 0
set xrange [0:last]
set xlabel "normal impulse (N s)" offset 0,0.3
set key at graph 1.0, graph 1 left top Left reverse noenhanced samplen 1.6 spacing 1.35
set object 1 rectangle from graph 0, graph 0 to first turn, graph 1 behind fillcolor rgb "#eef4f8" fillstyle solid noborder
set label 2 "compression" at first turn/2, graph 1.035 center textcolor rgb grey
set label 3 "restitution" at first (turn + last)/2, graph 1.035 center textcolor rgb grey
array tints[4] = [blue, vermilion, green, orange]
circles = 20
every_n = ceil(system("grep -c -v -e '^#' -e '^".solver."' '".data."'") / words(solvers) / real(circles))

# The curves of panel p, and its place.
series = "plot for [k=1:words(names[p])] data using \"impulse_N_s\":(of(word(solvers, 1), column(word(columns[p], k)))) \
  with lines lc rgb tints[k] lw 2.2 title word(names[p], k), \
  for [k=1:(both ? words(names[p]) : 0)] data every every_n using \"impulse_N_s\":(of(word(solvers, 2), column(word(columns[p], k)))) \
  with points pt 6 ps 0.9 lw 1.3 lc rgb tints[k] notitle"
left = narrow ? 0.19 : 0.12; right = narrow ? 0.75 : 0.84

do for [p=1:4] {
  set lmargin at screen left; set rmargin at screen right
  set tmargin at screen upper(p, 4, 60, 125, 60); set bmargin at screen lower(p, 4, 60, 125, 60)
  if (p < 4) { unset xlabel } else { set xlabel "normal impulse (N s)" offset 0,0.3 }
  set ylabel labels[p] offset 0.3,0
  if (p < 4) { set offsets 0, 0, graph 0.04, graph 0.04 } else { set offsets 0, 0, graph 0.04, 0 }
  if (p == 4) { set yrange [0:*]; unset key }
  # From where the contact sticks, if it does.
  unset arrow 1; unset label 4
  at = stuck[p]
  if (at == at && at >= 0) {
    set arrow 1 from first at, graph 0 to first at, graph 1 nohead back lc rgb purple lw 1.5 dt (6,4)
    if (p == 1 || rail) {
      stick = rail ? "it sticks" : "they stick"
      if (at > 0.4*last) { set label 4 stick at first at, graph 0.94 right offset -0.6,0 textcolor rgb purple } \
      else { set label 4 stick at first at, graph 0.94 left offset 0.6,0 textcolor rgb purple }
    }
  }
  eval(series)
  unset label 1; unset label 1001
}
unset multiplot
