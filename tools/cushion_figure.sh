#!/bin/sh
# cushion_figure.sh BUILD OUT.svg: the figure of docs/understanding/cushion.md, from what `carom` computes. Needs gnuplot.
set -eu
build=$1
out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# rolling balls straight into the cushion: the ball and the fitted numbers of the 2010 paper
awk 'BEGIN { print "id,vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e"
  for (v = 0.28; v < 3.51; v += 0.02) printf "%.2f,0,%.2f,0,%.9g,0,0,0.02625,0.1406,0.03675,0.212,0.14,0.98\n", v, v, -v/0.02625 }' > "$work/rolling.csv"
"$build/carom" resolve --cushion "$work/rolling.csv" > "$work/rebound.csv"
# a fine sweep of the side spin of one impact on a pool table's cushion, in the limit and by pooltool's steps
printf 'id,vx,vy,vz,wx,wy,wz,R,M,h,mu_s,mu_w,e\none,0.5,1.2,0,0,0,30,0.028575,0.17,0.036576,0.2,0.2,0.85\n' > "$work/one.csv"
for range in "-60 60 801" "46 50 801"; do
  set -- $range
  "$build/carom" sweep --cushion --id one --over wz --from "$1" --to "$2" --points "$3" "$work/one.csv" > "$work/exact-$2.csv"
  "$build/carom" sweep --cushion --id one --over wz --from "$1" --to "$2" --points "$3" --model euler --convention pooltool \
    --least-step 0.001 "$work/one.csv" > "$work/euler-$2.csv"
done
cat > "$work/draw.gp" <<'END'
# Three panels beside each other, one key below them: colours mean the same in all.
width = 1080; height = 440
call style "-" out
unset title
unset key
set tmargin at screen 0.89; set bmargin at screen 0.24
left(k) = 0.065 + 0.34 * (k - 1)
panel = "set lmargin at screen left(k); set rmargin at screen left(k) + 0.24"
set multiplot
k = 1; @panel
set title "Rolling balls, straight into the cushion" font ",15"
set xlabel "speed before, m/s"; set ylabel "speed after, m/s" offset 0.5,0
set arrow 1 from 2.5, 0 to 2.5, 3.4 nohead dt (3,3) lc rgb grey
set label 1 "measured up to here" at 2.45, 3.2 right font ",12" textcolor rgb grey
plot [0:3.5] [0:3.4] (x < 0.28 ? NaN : -0.0877*x**2 + 1.131*x - 0.0953) with lines lw 2 dt (12,4) lc rgb ink, \
  folder."/rebound.csv" using 1:(-$3) with lines lw 2 dt 1 lc rgb blue
unset arrow 1; unset label 1
k = 2; @panel
set title "A fine sweep of the side spin" font ",15"
set xlabel "side spin before, rad/s"; set ylabel "speed away from the cushion after, m/s" offset 0.8,0
set format y "%.3f"; set xtics 1
plot [46:50] folder."/euler-50.csv" using 2:(-$5) with lines lw 1 dt 1 lc rgb vermilion, \
  folder."/exact-50.csv" using 2:(-$5) with lines lw 2 dt 1 lc rgb blue
k = 3; @panel
set title "Jumps between neighbours" font ",15"
set format y "10^{%T}"; set logscale y; set xtics 20
set ylabel "jump over the largest speed" offset 0.8,0
plot [-60:60] [1e-12:1e-1] folder."/euler-60.csv" using 2:($3 > 1e-12 ? $3 : 1e-12) with points pt 7 ps 0.15 lc rgb vermilion, \
  folder."/exact-60.csv" using 2:($3 > 1e-12 ? $3 : 1e-12) with points pt 7 ps 0.15 lc rgb blue
# The key, below all three.
unset title; unset xlabel; unset ylabel; unset tics; unset border; unset logscale y; unset grid
set lmargin at screen 0.05; set rmargin at screen 0.98; set tmargin at screen 0.09; set bmargin at screen 0.02
set key center center horizontal Left reverse noenhanced samplen 3 width 2
plot [0:1] [0:1] NaN notitle, keyentry with lines lw 2 dt (12,4) lc rgb ink title "measured (the 2010 paper's fit)", \
  keyentry with lines lw 2 dt 1 lc rgb blue title "the exact limit (left: e = 0.98)", \
  keyentry with lines lw 2 dt 1 lc rgb vermilion title "pooltool's steps"
unset multiplot
END
gnuplot -e "out='$out'; folder='$work'; style='$(dirname "$0")/../cli/figures/style.gp'" "$work/draw.gp"
