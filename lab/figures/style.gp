# What all figures share; each begins with: load ... style.gp. Called as `gnuplot -c NAME.gp DATA.csv PICTURE [TITLE]`, where the
# picture's ending, .svg or .png, decides what it is.
#
# Colours are Okabe and Ito's, which stay apart without colour vision; marks and dashes differ too.

data = ARG1
picture = ARG2
heading = ARGC > 2 ? ARG3 : ""
if (!exists("width")) width = 920
if (!exists("height")) height = 560

if (picture[strlen(picture)-3:] eq ".png") {
  set terminal pngcairo size 2*width, 2*height font "DejaVu Sans,12" fontscale 1.7 linewidth 2 pointscale 2 background "white"
} else {
  set terminal svg size width, height fixed font "Helvetica, Arial, DejaVu Sans, sans-serif,14" linewidth 1 background "white"
}
set output picture
set encoding utf8

set datafile separator ","
set datafile commentschars "#"
set datafile missing NaN
set datafile columnheaders

# Lines: colour, dash, mark.
blue = "#0072B2"; vermilion = "#D55E00"; green = "#009E73"; purple = "#CC79A7"; orange = "#E69F00"; sky = "#56B4E9"
ink = "#222222"; grey = "#6b6b6b"; faint = "#dcdcdc"
colours = ink." ".blue." ".vermilion." ".green." ".purple." ".orange." ".sky." ".grey
set linetype 1 lc rgb ink       dt 1          lw 2 pt 5 ps 0.8
set linetype 2 lc rgb blue      dt 1          lw 2 pt 7 ps 0.9
set linetype 3 lc rgb vermilion dt (12,4)     lw 2 pt 9 ps 0.95
set linetype 4 lc rgb green     dt (3,3)      lw 2 pt 11 ps 0.95
set linetype 5 lc rgb purple    dt (10,3,2,3) lw 2 pt 13 ps 0.95
set linetype 6 lc rgb orange    dt (18,4)     lw 2 pt 4 ps 0.9
set linetype 7 lc rgb sky       dt 1          lw 3 pt 7 ps 1.5
set linetype 8 lc rgb grey      dt (2,4)      lw 2 pt 8 ps 0.9
set linetype cycle 8

set border 3 lc rgb grey
set tics nomirror out textcolor rgb ink
set grid xtics ytics lc rgb faint lt 1 lw 1 dt 1
set key textcolor rgb ink samplen 3 spacing 1.15
if (strlen(heading) > 0) set title heading font ",17" textcolor rgb ink offset 0,0.3

# Where and with what the data were measured, from its lines that begin with #.
note(what) = system("sed -n 's/^# ".what.": //p' '".data."' | head -n 1")
if (!exists("build")) build = system("sed -n 's/^# \\([a-z0-9]*-[a-z0-9]*\\): .*/\\1/p' '".data."' | head -n 1")
compiler = strlen(build) > 0 ? build.": ".note(build) : "compiler: ".note("compiler")
date = note("date")
machine = note("processor").", family ".note("processor family")
# Two lines at the foot, which need a bottom margin of about 105 points.
set label 1001 machine."; ".date[1:10] at screen 0.012, screen 0.055 font ",10" textcolor rgb grey noenhanced
set label 1002 compiler at screen 0.012, screen 0.022 font ",10" textcolor rgb grey noenhanced
set bmargin at screen 0.205

# A kernel looks the same in every figure: these have their line types, others take what is left.
known = "base double float double_vec float_vec euler exact"
place_in(list, name) = sum [k=1:words(list)] (word(list, k) eq name ? k : 0)
line_of(name, k) = place_in(known, name) > 0 ? place_in(known, name) : words(known) + k
colour_of(name, k) = word(colours, (line_of(name, k) - 1) % 8 + 1)

# The distinct values of a column, in their order, as one text of words.
words_of(column) = system("awk -F, -v want=".column." '/^#/ { next } !at { for (k = 1; k <= NF; k++) if ($k == want) at = k; next } ".\
  "!seen[$at]++ { printf \"%s \", $at }' '".data."'")
