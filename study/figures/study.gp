# What the study's figures share beyond the style of all: the machine at the foot, and how a kernel looks.
call (strstrt(ARG0, "/") ? system("dirname '".ARG0."'") : ".")."/../../command/figures/style.gp" ARG1 ARG2 ARG3

# Where and with what the data were measured: two lines at the foot, which need a bottom margin of about 105 points.
# The compiler named is that of what is drawn: the ladder's, by its configuration such as clang-default, the library's, or both, as
# where speedup is over a kernel of the ladder.
configs = system("awk -F, '/^#/ { next } !at { for (k = 1; k <= NF; k++) if ($k == \"config\") at = k; if (!at) at = NF + 1; next } \
  $at != \"\" && !seen[$at]++ { print $at }' '".data."' | tr '\\n' ' '")
drawn = ""; do for [name in configs] { if (strstrt(name, "-") > 0 && strlen(drawn) == 0) { drawn = name } }
if (!exists("build")) build = drawn
compiler = strlen(build) > 0 ? build.": ".note(build) : "compiler: ".note("compiler").(strlen(note("flags")) > 0 ? ", ".note("flags") : "")
if (strlen(build) > 0 && place_in(configs, "library") > 0) compiler = "library: ".note("compiler")."; ".compiler
date = note("date")
machine = note("processor").(strlen(note("processor family")) > 0 ? ", family ".note("processor family") : "")
set label 1001 machine."; ".date[1:10]."; carom at commit ".note("commit") at screen 0.012, screen 0.055 font ",10" textcolor rgb grey noenhanced
set label 1002 compiler at screen 0.012, screen 0.022 font ",10" textcolor rgb grey noenhanced

# A kernel looks the same in every figure: these have their line types, others take what is left.
known = "base double float double_vec float_vec euler exact fast"
line_of(name, k) = place_in(known, name) > 0 ? place_in(known, name) : words(known) + k
colour_of(name, k) = word(colours, (line_of(name, k) - 1) % 8 + 1)
