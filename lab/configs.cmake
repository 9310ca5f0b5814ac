# The compiler configurations of the seed paper, section 4.4, its default first.
set(ladder_configs default novec o3 archnative)
set(ladder_flags_default -O3 -march=native -ffast-math -fno-finite-math-only)
set(ladder_flags_o3 -O3)
set(ladder_flags_archnative -O3 -march=native)
set(ladder_flags_novec -O3 -fno-tree-vectorize) # and, spelt differently, no vectors out of straight-line code:
set(ladder_flags_novec_clang -fno-slp-vectorize)
set(ladder_flags_novec_gcc -fno-tree-slp-vectorize)

# One more where it can run: the default for the paper's processor by name. lab/bound counts the operations of this code, so its
# time is the one to compare with the counts and their bounds.
set(processor_flags "")
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo processor_flags REGEX "^flags" LIMIT_COUNT 1)
endif()
if(processor_flags MATCHES " avx2 " AND processor_flags MATCHES " fma " AND processor_flags MATCHES " bmi2 ")
  list(APPEND ladder_configs zen2)
  set(ladder_flags_zen2 -O3 -march=znver2 -ffast-math -fno-finite-math-only)
endif()

# The compilers, the paper's first choice first; the newest clang that is installed, and gcc.
find_program(CAROM_LADDER_CLANG NAMES clang-21 clang-20 clang-19 clang-18 clang-17 clang-16 clang-15 clang-14 clang
             DOC "clang that compiles the ladder; empty for none")
find_program(CAROM_LADDER_GCC NAMES gcc gcc-15 gcc-14 gcc-13 gcc-12 DOC "gcc that compiles the ladder; empty for none")
set(ladder_compilers)
if(CAROM_LADDER_CLANG)
  list(APPEND ladder_compilers clang)
  set(ladder_command_clang ${CAROM_LADDER_CLANG})
endif()
if(CAROM_LADDER_GCC)
  list(APPEND ladder_compilers gcc)
  set(ladder_command_gcc ${CAROM_LADDER_GCC})
endif()
