# Writes a page of the manual, between its head and SEE ALSO the program's own text:
# cmake -DPROGRAM=... -DCOMMAND=hit -DVERSION=... -DPAGE=carom-hit.1 "-DALL=carom carom-hit ..." -P
execute_process(COMMAND ${PROGRAM} ${COMMAND} --manual OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
cmake_path(GET PAGE STEM name)
separate_arguments(others UNIX_COMMAND "${ALL}")
list(REMOVE_ITEM others ${name})
list(TRANSFORM others REPLACE "(.+)" ".BR \\1 (1)")
list(JOIN others ",\n" others)
string(REPLACE "-" "\\-" others "${others}")
file(WRITE ${PAGE} ".TH ${name} 1 \"\" \"carom ${VERSION}\" \"carom\"\n.nh\n.ad l\n${text}.SH SEE ALSO\n${others}\n.PP\n"
     "The documentation of carom has a manual of the command with worked questions, docs/using/command.md.\n")
