# One collision against normal impulse: slips, velocities and work, from the CSV of `carom-lab trace`. Lines are the exact limit, circles
# Euler's method.
width = 760; height = 1120; tall = 1120
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/../../../command/figures/style.gp" ARG1 ARG2 ARG3 ARG4
unset title

# The panels, and from where the balls stick (NaN: never).
array labels[4] = ["slip of ball 1 on ball 2 (m/s)", "slip over the cloth (m/s)", "velocity (m/s)", "work of the normal force (J)"]
array columns[4] = ["u_x_m_s u_z_m_s", "d_x_m_s d_y_m_s b_x_m_s b_y_m_s", "v1_x_m_s v1_y_m_s v2_x_m_s v2_y_m_s", "work_J"]
array names[4] = ["u_x u_z", "'ball 1, x' 'ball 1, y' 'ball 2, x' 'ball 2, y'", "", "work"]
names[3] = names[2]
at = strlen(note("the balls stick")) > 0 ? real(note("the balls stick")) : NaN

# What is shown, below the panels.
of(name, x) = strcol("solver") eq name ? x : NaN
set label 1001 note("collision").": friction ".note("friction between the balls")." between the balls,\n".\
  note("friction of the cloth")." with the cloth; restitution ".note("restitution")."; slip: ".note("slip").".\n".\
  "Lines: the exact limit. Circles: Euler's method, N = ".note("steps")."." at screen 0.012, screen px(48) textcolor rgb grey noenhanced

set multiplot
if (strlen(heading) > 0) set label 1 heading at screen 0.5, screen 1 - px(16) center font large textcolor rgb ink noenhanced
turn = real(note("compression ends"))
last = system("awk -F, '!/^#/ && $2 + 0 > m { m = $2 + 0 } END { print m }' '".data."'") + 0
set xrange [0:last]
set xlabel "normal impulse (N s)" offset 0,0.3
set key at graph 1.0, graph 1 left top Left reverse noenhanced samplen 1.6 spacing 1.35
set object 1 rectangle from graph 0, graph 0 to first turn, graph 1 behind fillcolor rgb "#eef4f8" fillstyle solid noborder
set label 2 "compression" at first turn/2, graph 1.035 center textcolor rgb grey
set label 3 "restitution" at first (turn + last)/2, graph 1.035 center textcolor rgb grey
array tints[4] = [blue, vermilion, green, orange]
circles = 20
every_n = ceil(system("grep -c -v -e '^#' -e '^solver' '".data."'") / 2.0 / circles)

# The curves of panel p, and its place.
series = "plot for [k=1:words(names[p])] data using \"impulse_N_s\":(of('exact', column(word(columns[p], k)))) \
  with lines lc rgb tints[k] lw 2.2 title word(names[p], k), \
  for [k=1:words(names[p])] data every every_n using \"impulse_N_s\":(of('euler', column(word(columns[p], k)))) \
  with points pt 6 ps 0.9 lw 1.3 lc rgb tints[k] notitle"
left = narrow ? 0.19 : 0.12; right = narrow ? 0.75 : 0.84

do for [p=1:4] {
  set lmargin at screen left; set rmargin at screen right
  set tmargin at screen upper(p, 4, 60, 125, 60); set bmargin at screen lower(p, 4, 60, 125, 60)
  if (p < 4) { unset xlabel } else { set xlabel "normal impulse (N s)" offset 0,0.3 }
  set ylabel labels[p] offset 0.3,0
  if (p < 4) { set offsets 0, 0, graph 0.04, graph 0.04 } else { set offsets 0, 0, graph 0.04, 0 }
  if (p == 4) { set yrange [0:*]; unset key }
  # From where the balls stick, if they do.
  unset arrow 1; unset label 4
  if (at == at && at >= 0) {
    set arrow 1 from first at, graph 0 to first at, graph 1 nohead back lc rgb purple lw 1.5 dt (6,4)
    if (p == 1) {
      if (at > 0.4*last) { set label 4 "they stick" at first at, graph 0.94 right offset -0.6,0 textcolor rgb purple } \
      else { set label 4 "they stick" at first at, graph 0.94 left offset 0.6,0 textcolor rgb purple }
    }
  }
  eval(series)
  unset label 1; unset label 1001
}
unset multiplot
