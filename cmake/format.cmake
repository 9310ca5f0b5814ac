# One command formats, one checks: cmake --build build --target format (or format-check); both run tools/format.
set(format ${PROJECT_SOURCE_DIR}/tools/format)
add_custom_target(format COMMAND sh ${format} USES_TERMINAL VERBATIM)
add_custom_target(format-check COMMAND sh ${format} --check USES_TERMINAL VERBATIM)
if(CAROM_TESTS)
  add_test(NAME docs/format COMMAND sh ${format} --check)
  set_tests_properties(docs/format PROPERTIES LABELS docs SKIP_RETURN_CODE 77)
endif()
