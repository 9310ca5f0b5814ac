# Curves: x, y and the number of each point's curve, and what they are in notes. From `carom hit`, `carom rail` and `carom ways`.
width = 760; height = 560; tall = 640
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/style.gp" ARG1 ARG2 ARG3 ARG4

n = words(words_of("curve"))
name(k) = note(sprintf("curve %d", k))
of(k, x) = column("curve") == k ? x : NaN
footer = system("sed -n 's/^# footer: //p' '".data."'")
lines = strlen(footer) > 0 ? 1 + strlen(system("sed -n 's/^# footer: .*/x/p' '".data."' | tr -d '\\n'")) : 0
named = strlen(name(1)) > 0
across = narrow || (named && strlen(name(n)) > 20) ? 1 : 2 # names beside each other
rows = named ? ceil(n / (1.0*across)) : 0
below = 19*lines + 12 # pixels of the footer, and of the key above it
set label 1 footer at screen 0.012, screen px(below - 10) textcolor rgb grey noenhanced
set xlabel note("x") offset 0,0.3 noenhanced
set ylabel note("y") offset 0.5,0 noenhanced
if (named) {
  set key at screen 0.1, screen px(below + 24*rows) left top horizontal Left reverse noenhanced maxcols across width 2
} else { unset key }
set lmargin at screen (narrow ? 0.19 : 0.12); set rmargin at screen 0.97; set bmargin at screen px(below + 24*rows + 62)
set xzeroaxis lc rgb grey lw 1
set offsets 0, 0, graph 0.04, graph 0.04
plot for [k=1:n] data using "x":(of(k, column("y"))) with lines linetype k lw 2.2 title name(k)
