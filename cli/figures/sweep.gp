# Throw, or the angle of rebound from a cushion, over what is swept, a curve for each row and solver, from the CSV of `carom sweep`.
width = 920; height = 560; tall = 620
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/style.gp" ARG1 ARG2 ARG3 ARG4

over = note("over")
rail = strlen(note("impact")) > 0
column_of = rail ? "model" : "solver"
angle = rail ? "rebound_deg" : "throw_deg"
swept = over eq "angle" ? "cushion turned by (degrees)" : over eq "cut" ? "line of centres turned by (degrees)" : over eq "w1z" ? "side spin of ball 1 (rad/s)" : \
  over eq "speed" ? "velocities and spins, times" : over
ids = words_of("id")
solvers = words_of(column_of)
of(id, solver, x) = strcol("id") eq id && strcol(column_of) eq solver ? x : NaN
name(id, solver) = words(solvers) > 1 ? id.", ".solver : id
set xlabel swept offset 0,0.3
set ylabel rail ? "angle after from the normal (degrees)" : "throw of ball 2 (degrees, to the left)" offset 0.5,0
set key outside right top vertical Left reverse noenhanced
if (narrow) set key below
set lmargin at screen (narrow ? 0.19 : 0.1); set bmargin at screen (narrow ? 0.3 : 0.13)
set xzeroaxis lc rgb grey lw 1
set offsets 0, 0, graph 0.04, graph 0.04
n = words(solvers)
plot for [k=0:words(ids)*n-1] data using "value":(of(word(ids, k/n + 1), word(solvers, k%n + 1), column(angle))) \
  with lines linetype k + 1 lw 2.2 title name(word(ids, k/n + 1), word(solvers, k%n + 1))
