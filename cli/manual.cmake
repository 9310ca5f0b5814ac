# Writes a page of the manual, which is the program's own help: cmake -DPROGRAM=... -DCOMMAND=hit -DVERSION=... -DPAGE=carom-hit.1 -P
execute_process(COMMAND ${PROGRAM} ${COMMAND} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
cmake_path(GET PAGE STEM name)
string(REGEX MATCH "\n\n([^.]*)" about "${help}") # the first sentence below the usage
string(REPLACE "\n" " " about "${CMAKE_MATCH_1}")
# What roff would take for requests and escapes is put right.
string(REGEX REPLACE "\n([.'])" "\n\\\\&\\1" help "${help}")
string(REPLACE "-" "\\-" help "${help}")
file(WRITE ${PAGE} ".TH ${name} 1 \"\" \"carom ${VERSION}\"\n.SH NAME\n${name} \\- ${about}\n.SH DESCRIPTION\n.nf\n${help}.fi\n")
