# Copies the C sources that dual numbers differentiate, line for line, with `number` in place of `double`:
#
#     cmake -D "text=TEXT..." -D "include=FOLDER..." -D copies=COPIES -P dual_copies.cmake
#
# A TEXT includes the copies, as "dual/shot/models.c" for that of shot/models.c. The sources, and the headers that they include in turn, stand
# in the folders of `include`. COPIES/dual gets the copies, and COPIES/dual.d the list of all files that were read.
#
#     in a source                            in its copy
#     double                                 number, which has derivatives: dual.h
#     #include "table/table.h"               #include "dual/table/table.h"
#     CAROM_SRC_TABLE_TABLE_H                DUAL_CAROM_SRC_TABLE_TABLE_H
#     extern "C" { ... }, CAROM_API          nothing: the text puts the copies into a namespace, which no linker sees
#     _Static_assert                         static_assert
#     CAROM_RAILS_MOST = 32 and the like     the following sizes, because numbers with derivatives fill a stack sooner
#
# A contact is one of two balls, which have the indices 0 and 1, or of ball 0 and part 0 of the table. The rails that jaw 0 continues are the first two. A triangle of 15 balls has 30 contacts.
cmake_minimum_required(VERSION 3.25)
set(sizes "CAROM_RAILS_MOST = 2" "CAROM_JAWS_MOST = 1" "CAROM_POCKETS_MOST = 0" "CAROM_BALLS_MOST = 2" "CAROM_COLUMN = 0" "CAROM_CLUSTER_CONTACTS = 38")
# Sources without numbers, and those that dual.h has for its own.
set(shared "^(schema/.*|platform/(arithmetic|promise|dependence)\\.h)$")

# The names of the files that a text includes, of which the pattern is the part in quotes.
function(included_names text pattern names)
  string(REGEX MATCHALL "#include \"${pattern}\"" lines "${text}")
  list(TRANSFORM lines REPLACE "#include \"(dual/)?(.*)\"" "\\2")
  set(${names} ${lines} PARENT_SCOPE)
endfunction()

function(copy name file)
  file(READ ${file} text)
  included_names("${text}" "[^\"]+" headers)
  list(FILTER headers EXCLUDE REGEX ${shared})
  foreach(header IN LISTS headers)
    string(REPLACE "#include \"${header}\"" "#include \"dual/${header}\"" text "${text}")
  endforeach()
  string(REGEX REPLACE "([^A-Za-z0-9_])double([^A-Za-z0-9_])" "\\1number\\2" text "${text}")
  string(REGEX REPLACE "(#ifndef|#define) (CAROM_([A-Z_]*_)?H\n)" "\\1 DUAL_\\2" text "${text}")
  string(REPLACE "#ifdef __cplusplus\nextern \"C\" {\n#endif\n" "\n\n\n" text "${text}")
  string(REPLACE "#ifdef __cplusplus\n}\n#endif\n" "\n\n\n" text "${text}")
  string(REPLACE "\nCAROM_API " "\n" text "${text}")
  string(REPLACE "_Static_assert" "static_assert" text "${text}")
  foreach(size IN LISTS sizes)
    string(REGEX REPLACE "=.*" "= [0-9]+" larger "${size}")
    string(REGEX REPLACE "${larger}" "${size}" text "${text}")
  endforeach()
  file(WRITE ${copies}/dual/${name} "${text}")
  set(names ${names} ${headers} PARENT_SCOPE)
endfunction()

set(names "")
set(files ${text})
foreach(one IN LISTS text)
  file(READ ${one} lines)
  included_names("${lines}" "dual/[^\"]+" copied)
  list(APPEND names ${copied})
endforeach()
set(done "")
while(names)
  list(POP_FRONT names name)
  if(NOT name IN_LIST done)
    list(APPEND done ${name})
    find_file(file_of_${name} ${name} PATHS ${include} NO_DEFAULT_PATH REQUIRED NO_CACHE)
    copy(${name} ${file_of_${name}})
    list(APPEND files ${file_of_${name}})
  endif()
endwhile()
list(JOIN files " \\\n  " list)
file(WRITE ${copies}/dual.d "${copies}/dual.stamp: ${list}\n")
file(TOUCH ${copies}/dual.stamp)
