# Functions that register the tests of every part with ctest. The tests of a part are in its folder `tests` (of the page and
# the npm package: web/test).
#
# A test is named PART/NAME or PART/KIND/NAME. Each word of the name but the last is a label, so `ctest -L '^core$'` runs the
# tests of the core. Further labels: `threads` marks tests that start threads, and `before_release` marks tests that only
# `./test --release` runs. For each part the target PART_tests builds its test programs.
find_package(PkgConfig REQUIRED)
pkg_check_modules(CHECK REQUIRED IMPORTED_TARGET check)
set(data_dir ${PROJECT_SOURCE_DIR}/data)

# A test takes as long as the machine needs. This number of seconds ends a test that hangs.
set(hangs 14400)

# Tests that use Python run in a virtual environment, which the first of them makes.
set(test_python ${PROJECT_BINARY_DIR}/python/bin/python3)
add_test(NAME tools/python COMMAND ${PROJECT_SOURCE_DIR}/tools/python --version)
set_tests_properties(
  tools/python
  PROPERTIES FIXTURES_SETUP python TIMEOUT ${hangs} LABELS tools
             ENVIRONMENT "CAROM_PYTHON_ENVIRONMENT=${PROJECT_BINARY_DIR}/python;CAROM_PYTHON_MODULES=jinja2 numpy pycparser pytest")

# The words of a name but the last.
function(carom_labels_of name result)
  string(REPLACE "/" ";" words ${name})
  list(POP_BACK words)
  set(${result} ${words} PARENT_SCOPE)
endfunction()

# carom_tests_of(NAME TARGET): the targets PART_tests and, where the name has a kind, PART_KIND_tests build this target too.
function(carom_tests_of name target)
  carom_labels_of(${name} words)
  set(group "")
  foreach(word ${words})
    string(APPEND group "${word}_")
    if(NOT TARGET ${group}tests)
      add_custom_target(${group}tests)
    endif()
    add_dependencies(${group}tests ${target})
  endforeach()
endfunction()

# carom_command_test(NAME COMMAND...): a test that is a command. It exits with 77 if it was skipped, and prints a line
# "skipped: WHY" for everything that it skips, which ./test repeats.
function(carom_command_test name)
  carom_labels_of(${name} labels)
  add_test(NAME ${name} COMMAND ${ARGN} COMMAND_EXPAND_LISTS)
  set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT ${hangs} SKIP_RETURN_CODE 77
                                          ENVIRONMENT "CAROM_BUILD=${PROJECT_BINARY_DIR}")
  if(${test_python} IN_LIST ARGN)
    set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED python)
  endif()
endfunction()

# carom_script_test(NAME SCRIPT ARGUMENTS...): a test that is a script of the calling folder, in Python or in sh.
function(carom_script_test name script)
  set(runner sh)
  if(script MATCHES "\\.py$")
    set(runner ${test_python})
  endif()
  carom_command_test(${name} ${runner} ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN})
endfunction()

# carom_c_test(NAME SOURCE LIBRARIES...): a suite of Check, of which main() is in core/tests/support.c. The program is
# called test_ and the last word of the name.
function(carom_c_test name source)
  cmake_path(GET name FILENAME program)
  add_executable(test_${program} ${source})
  target_include_directories(test_${program} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(test_${program} PRIVATE carom_test_support ${ARGN} carom_static carom_options)
  carom_command_test(${name} test_${program})
  carom_tests_of(${name} test_${program})
endfunction()

# carom_fuzz_test(TARGET NAME EXECUTIONS LIBRARIES...): a fuzz target of the folder fuzz. The test runs the inputs of the
# corpus and then so many random inputs; without a sanitizer, which finds most faults of this kind, a quarter of them.
function(carom_fuzz_test target name executions)
  if(NOT CAROM_SANITIZE)
    math(EXPR executions "${executions} / 4")
  endif()
  add_executable(fuzz_${target} fuzz/${target}.c ${PROJECT_SOURCE_DIR}/core/tests/fuzz/random.c)
  target_include_directories(fuzz_${target} PRIVATE ${PROJECT_SOURCE_DIR}/core/tests/fuzz ${PROJECT_SOURCE_DIR}/core/src)
  target_link_libraries(fuzz_${target} PRIVATE ${ARGN} carom_static carom_options)
  carom_command_test(${name} fuzz_${target} ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus-${target}.txt ${executions})
  carom_tests_of(${name} fuzz_${target})
endfunction()

# carom_before_release(NAMES...): these tests of the calling folder are left to `./test --release`. A name of no test is an
# error of CMake.
function(carom_before_release)
  set_property(TEST ${ARGN} APPEND PROPERTY LABELS before_release)
endfunction()
