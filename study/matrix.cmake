# The matrix: the target and the version of the compiler are variables of the study. `clang`, the newest that is installed,
# and `gcc` come from configs.cmake. With CAROM_LADDER_MATRIX, every further clang follows under the name of its version,
# such as clang14, and each compiler builds two more sets for the target of the paper:
#
#     target    -march     default  archnative  novec  o3
#     native    native     default  archnative  novec  o3
#     znver2    znver2     zen2     archzen2    novec  o3      novec and o3 name no processor
#
# One more set, `ordered`, is `zen2` without regrouping of sums and products. It tells whether regrouping is why one
# compiler's code is slower than another's. study/matrix.py reads these names.
set(ladder_family_clang clang)
set(ladder_family_gcc gcc)

# Versions before 14 were not tried; 30 is later than any that exists.
set(oldest_clang 14)
set(latest_clang 30)

# compiler_version(command variable): what the compiler says of its version.
function(compiler_version command variable)
  execute_process(COMMAND ${command} -dumpfullversion -dumpversion OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  set(${variable} "${said}" PARENT_SCOPE)
endfunction()

foreach(compiler ${ladder_compilers})
  compiler_version(${ladder_command_${compiler}} ladder_version_${compiler})
endforeach()

if(CAROM_LADDER_MATRIX AND CAROM_LADDER_CLANG)
  foreach(version RANGE ${latest_clang} ${oldest_clang} -1)
    find_program(CAROM_LADDER_CLANG_${version} NAMES clang-${version} DOC "a further clang for the matrix of compilers")
    mark_as_advanced(CAROM_LADDER_CLANG_${version})
    if(CAROM_LADDER_CLANG_${version} AND NOT ladder_version_clang MATCHES "^${version}\\.")
      list(APPEND ladder_compilers clang${version})
      set(ladder_command_clang${version} ${CAROM_LADDER_CLANG_${version}})
      set(ladder_family_clang${version} clang)
      set(ladder_flags_novec_clang${version} ${ladder_flags_novec_clang})
      compiler_version(${CAROM_LADDER_CLANG_${version}} ladder_version_clang${version})
    endif()
  endforeach()
endif()
if(CAROM_LADDER_MATRIX AND "zen2" IN_LIST ladder_configs)
  list(APPEND ladder_configs archzen2 ordered)
  set(ladder_flags_archzen2 -O3 -march=znver2)
  set(ladder_flags_ordered ${ladder_flags_zen2} -fno-associative-math)
endif()
