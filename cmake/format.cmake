# One command formats, one checks: cmake --build build --target format (or format-check). clang-format leaves comments and
# formula sheets as they are, so that the test of columns looks at every line.
find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
file(GLOB_RECURSE formatted CONFIGURE_DEPENDS include/*.h src/*.[ch] src/*.cpp cli/*.[ch] lab/*.[ch] tests/*.[ch] examples/*.[ch]
     plan/*.[ch] python/*.[ch])
list(FILTER formatted EXCLUDE REGEX /about/project\\.h$) # names and addresses may be long
if(CLANG_FORMAT)
  add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${formatted} VERBATIM)
  add_custom_target(format-check COMMAND ${CLANG_FORMAT} --dry-run --Werror ${formatted} VERBATIM)
  if(CAROM_TESTS)
    add_test(NAME format COMMAND ${CLANG_FORMAT} --dry-run --Werror ${formatted})
    add_test(NAME format/columns COMMAND sh -c "! LC_ALL=C.UTF-8 grep -nE '.{101,}' \"$@\"" columns ${formatted})
  endif()
else()
  message(STATUS "clang-format not found: no targets format, format-check")
endif()
