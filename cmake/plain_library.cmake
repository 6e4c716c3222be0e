# plain_library(TARGET HEADER LIBRARY...): an imported target for a library whose own CMake package is broken on
# Debian 12 (OpenImageIO's wants OpenCV, Python and its tools installed; ecCodes's wants its tools).
function(plain_library TARGET HEADER)
  find_path(${TARGET}_INCLUDE_DIR ${HEADER} REQUIRED)
  add_library(${TARGET} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${TARGET} INTERFACE "${${TARGET}_INCLUDE_DIR}")
  foreach(library IN LISTS ARGN)
    find_library(${TARGET}_${library} ${library} REQUIRED)
    target_link_libraries(${TARGET} INTERFACE "${${TARGET}_${library}}")
  endforeach()
endfunction()
