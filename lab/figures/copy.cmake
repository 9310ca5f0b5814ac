# Copies into TO every SVG of FROM that is there by name.
file(GLOB pictures RELATIVE ${TO} ${TO}/*.svg)
foreach(picture ${pictures})
  if(EXISTS ${FROM}/${picture})
    file(COPY ${FROM}/${picture} DESTINATION ${TO})
    message(STATUS "docs/figures/${picture}")
  endif()
endforeach()
