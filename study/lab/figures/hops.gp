# Hops: the height of the cue ball over the speed of the cue, a line for each elevation, with its name at its
# end, or where it leaves the plot: heights go by the square of the speed.
width = 760; height = 480
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/../../../command/figures/style.gp" ARG1 ARG2 ARG3

names = words_of("elevation")
set xlabel "speed of the cue (m/s)"; set ylabel "height of the hop (mm)"
set tmargin at screen 0.88; set bmargin at screen 0.17; set rmargin at screen 0.82
set label 1 "a ball" at 0.1, 59.5 textcolor rgb grey; set label 2 "half a ball" at 0.1, 31 textcolor rgb grey; set label 3 "a coin" at 10.11, 1.75 textcolor rgb grey
set arrow 1 from 0, 57.15 to 10, 57.15 nohead dt (3,3) lc rgb grey; set arrow 2 from 0, 28.575 to 10, 28.575 nohead dt (3,3) lc rgb grey
set arrow 3 from 0, 1.75 to 10, 1.75 nohead dt (3,3) lc rgb grey
called(k) = strcol("elevation") eq word(names, k)
ends(k, above) = called(k) && column("speed") == 10 && (column("hop") > 100) == above
beside(k) = ends(k, 0) ? column("hop") : NaN
leaves(k) = ends(k, 1) ? 10 * sqrt(100 / column("hop")) : NaN
unset key
plot [0:10] [0:100] for [k=1:words(names)] data using "speed":(called(k) ? column("hop") : NaN) with lines lt k, \
  for [k=1:words(names)] data using "speed":(beside(k)):(word(names, k)."°") with labels left offset 0.6,0 textcolor rgb word(colours, k), \
  for [k=1:words(names)] data using (leaves(k)):(100):(word(names, k)."°") with labels center offset 0,0.7 textcolor rgb word(colours, k)
