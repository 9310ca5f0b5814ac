# Writes HEADER with the commit of SOURCE; leaves it alone if it says so already, so that nothing is built again for it.
find_program(GIT git)
set(commit "unknown (no git here)")
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=12 OUTPUT_VARIABLE said RESULT_VARIABLE code
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(code EQUAL 0)
    set(commit "${said}")
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define CAROM_COMMIT \"${commit}\"\n" @ONLY)
