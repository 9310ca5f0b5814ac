# What every target of the project is compiled with.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_C_STANDARD 17)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(carom_options INTERFACE)
target_compile_options(
  carom_options
  INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla
            # isnan() and the like of MinGW's headers convert to float, in a branch that is not taken.
            $<$<BOOL:${MINGW}>:-Wno-float-conversion>
            $<$<BOOL:${CAROM_WERROR}>:-Werror>
            # Parity with pooltool to the last bit: a*b + c stays two roundings unless a source asks for fma().
            -ffp-contract=off)
# Where core/src/platform/promise.h asks what comments promise.
set(checked $<$<CONFIG:Debug>:CAROM_CHECKED>)
if(CAROM_SANITIZE) # its commas would part the expression
  set(checked CAROM_CHECKED)
endif()
target_compile_definitions(carom_options INTERFACE ${checked} $<$<NOT:$<BOOL:${CAROM_PLAN}>>:CAROM_WITHOUT_PLAN>)
# -g1: lines for the reports; more would double the time that gcc takes. -O1 halves it again, without the checks of pointers whose faults the
# address sanitizer tells where memory is read or written.
if(CAROM_SANITIZE)
  set(CAROM_SANITIZED -fsanitize=${CAROM_SANITIZE} -fno-sanitize=null,object-size,pointer-overflow -fno-omit-frame-pointer
                      -fno-sanitize-recover=all -g1 -O1
                      # which needs the runtime library of C++, that nothing of carom links
                      $<$<C_COMPILER_ID:Clang>:-fno-sanitize=function>)
  target_compile_options(carom_options INTERFACE ${CAROM_SANITIZED})
  target_link_options(carom_options INTERFACE -fsanitize=${CAROM_SANITIZE})
endif()
