# One command formats, one checks: cmake --build build --target format (or format-check); both run
# tools/format. The tests docs/format and docs/lint run it and tools/lint.
set(format ${PROJECT_SOURCE_DIR}/tools/format)
add_custom_target(format COMMAND sh ${format} USES_TERMINAL VERBATIM)
add_custom_target(format-check COMMAND sh ${format} --check USES_TERMINAL VERBATIM)
if(CAROM_TESTS)
  add_test(NAME docs/format COMMAND sh ${format} --check)
  add_test(NAME docs/lint COMMAND sh ${PROJECT_SOURCE_DIR}/tools/lint)
  # Both get their tools into one folder.
  set_tests_properties(docs/format docs/lint PROPERTIES LABELS docs SKIP_RETURN_CODE 77 RESOURCE_LOCK checks)
endif()
