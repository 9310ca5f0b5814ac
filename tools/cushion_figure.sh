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
set datafile separator ","
set terminal svg size 1080, 400 font "sans-serif,13" background "white"
set output out
set grid lc rgb "#dddddd"
set border 3 lc rgb "#666666"
set tics nomirror
set key left top Left reverse
set multiplot layout 1, 3
set title "Perpendicular rolling balls"
set xlabel "speed before (m/s)"; set ylabel "speed after (m/s)"
set arrow 1 from 2.5, 0 to 2.5, 3.4 nohead dt 2 lc rgb "#999999"
plot [0.28:3.5] [0:3.4] -0.0877*x**2 + 1.131*x - 0.0953 lw 2 lc rgb "#d55e00" title "measured (fit)", \
  folder."/rebound.csv" using 1:(-$3) with lines lw 2 lc rgb "#0072b2" title "exact limit, e = 0.98"
unset arrow 1
set title "Fine sweep of the side spin"
set xlabel "side spin before (rad/s)"; set ylabel "velocity along the cushion after (m/s)"
set format y "%.4f"; set xtics 1
plot folder."/euler-50.csv" using 2:4 with lines lw 1 lc rgb "#d55e00" title "pooltool's steps", \
  folder."/exact-50.csv" using 2:4 with lines lw 2 lc rgb "#0072b2" title "exact limit"
set title "Jumps between neighbours"
set format y "10^{%L}"; set logscale y; set xtics auto
set ylabel "jump, over the largest speed"
plot [-60:60] [1e-12:1e-1] folder."/euler-60.csv" using 2:($3 > 1e-12 ? $3 : 1e-12) with dots lc rgb "#d55e00" title "pooltool's steps", \
  folder."/exact-60.csv" using 2:($3 > 1e-12 ? $3 : 1e-12) with dots lc rgb "#0072b2" title "exact limit"
END
gnuplot -e "out='$work/figure.svg'; folder='$work'" "$work/draw.gp"
cp "$work/figure.svg" "$out"
