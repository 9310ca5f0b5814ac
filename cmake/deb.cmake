# `cpack -G DEB` in the build folder makes a Debian package of all that is installed, for /usr: configure with
# -DCMAKE_INSTALL_PREFIX=/usr. SOURCE_DATE_EPOCH in the environment sets the times of the files: the same sources give the same bytes.
# CPack runs this file once more, before it packs, to put files where Debian wants them.
if(CPACK_TEMPORARY_DIRECTORY)
  set(share ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
  file(RENAME ${share}/doc/carom/LICENSE ${share}/doc/carom/copyright)
  file(RENAME ${share}/doc/carom/CHANGELOG.md ${share}/doc/carom/changelog)
  set(docs ${share}/doc/carom)
  set(headers ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/include)
  include(${CMAKE_CURRENT_LIST_DIR}/installed_docs.cmake)
  file(GLOB manuals ${share}/man/man1/*.1)
  execute_process(COMMAND gzip -9n ${share}/doc/carom/changelog ${manuals} COMMAND_ERROR_IS_FATAL ANY)
  return()
endif()
set(CPACK_PACKAGE_CONTACT "The developers of carom <developers@carom.invalid>" CACHE STRING "Maintainer of the Debian package")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "collisions and whole shots of billiards: C library and command")
set(CPACK_PACKAGE_DESCRIPTION "Collisions of billiard balls and cushions, one or millions of them, and
whole shots event by event: the C library with its headers, the command
carom, their manuals and examples.")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_FILE})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS gnuplot-nox)
include(CPack)
