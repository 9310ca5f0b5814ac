# The target uninstall removes what the last `cmake --install` of this build installed. Run as a script (-P) it does so.
if(CMAKE_SCRIPT_MODE_FILE)
  if(NOT EXISTS ${MANIFEST})
    message(FATAL_ERROR "nothing to uninstall: there is no ${MANIFEST}")
  endif()
  file(STRINGS ${MANIFEST} files)
  foreach(file ${files})
    message(STATUS "Removing: $ENV{DESTDIR}${file}")
    file(REMOVE "$ENV{DESTDIR}${file}")
  endforeach()
else()
  add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt -P ${CMAKE_CURRENT_LIST_FILE}
                              VERBATIM)
endif()
