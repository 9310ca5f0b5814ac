# What all figures share; each begins by calling it. They are called as `gnuplot -c NAME.gp DATA.csv PICTURE [TITLE [narrow]]`, where
# the picture's ending, .svg or .png, decides what it is; an ending alone stands for standard output. A narrow one is for screens of 500 pixels: 470 wide and `tall`, its panels
# below each other and its key below the plot, the letters as large as in the wide one. The letters of one that is 760 wide have 9 pixels where
# it is shown 500 wide.
#
# Colours are Okabe and Ito's, which stay apart without colour vision; marks and dashes differ too.

data = ARG1
picture = ARG2
heading = ARGC > 2 ? ARG3 : ""
narrow = ARGC > 3 && ARG4 eq "narrow"
if (!exists("width")) width = 920
if (!exists("height")) height = 560
if (narrow) { width = 470; height = exists("tall") ? tall : 520 }
px(y) = y / (1.0 * height)

# The upper and lower edge of panel k of n below each other, with so many pixels above, below and between them.
panel(n, above, below, gap) = (height - above - below - (n - 1) * gap) / (1.0 * n)
upper(k, n, above, below, gap) = 1 - px(above + (k - 1) * (panel(n, above, below, gap) + gap))
lower(k, n, above, below, gap) = upper(k, n, above, below, gap) - px(panel(n, above, below, gap))

if (picture[strlen(picture)-3:] eq ".pdf") {
  set terminal pdfcairo size width/90.0, height/90.0 font "DejaVu Sans,11.2" linewidth 1 background "white"
} else { if (picture[strlen(picture)-3:] eq ".png") {
  set terminal pngcairo size 2*width, 2*height font "DejaVu Sans,12" fontscale 1.75 linewidth 2 pointscale 2 background "white"
} else {
  set terminal svg size width, height fixed font "Helvetica, Arial, DejaVu Sans, sans-serif,14" linewidth 1 background "white"
}
}
if (strlen(picture) > 4) set output picture
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
large = narrow ? ",14" : ",17"
if (strlen(heading) > 0) set title heading font large textcolor rgb ink offset 0,0.3

# What the data's line "# what: text" says.
note(what) = system("sed -n 's/^# ".what.": //p' '".data."' | head -n 1")
set bmargin at screen (narrow ? px(110) : 0.205)

place_in(list, name) = sum [k=1:words(list)] (word(list, k) eq name ? k : 0)

# The distinct values of a column, in their order, as one text of words.
words_of(column) = system("awk -F, -v want=".column." '/^#/ { next } !at { for (k = 1; k <= NF; k++) if ($k == want) at = k; next } ".\
  "!seen[$at]++ { printf \"%s \", $at }' '".data."'")
