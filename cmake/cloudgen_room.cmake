# A room of the house: one folder = one static library = one namespace.
#
#   cloudgen_room(NAME SOURCES a.cpp b.cpp ROOMS base field PRIVATE some::library)
#
# ROOMS are linked publicly (their headers may be included), PRIVATE libraries stay inside the folder.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(CCACHE ccache)
if(CCACHE)
  # Precompiled headers are cached only with these.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${CCACHE}")
endif()

add_library(cloudgen_options INTERFACE)
target_include_directories(cloudgen_options INTERFACE "${PROJECT_SOURCE_DIR}/src")
# No fused multiply-add and no relaxed arithmetic: the same bytes on every machine.
target_compile_options(cloudgen_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers -ffp-contract=off)
if(CCACHE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(cloudgen_options INTERFACE -fpch-preprocess)
endif()
if(CLOUDGEN_WERROR)
  target_compile_options(cloudgen_options INTERFACE -Werror)
endif()
if(CLOUDGEN_ASSERTS)
  target_compile_options(cloudgen_options INTERFACE -UNDEBUG)
endif()
if(CLOUDGEN_SANITIZE)
  target_compile_options(cloudgen_options INTERFACE -fsanitize=${CLOUDGEN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(cloudgen_options INTERFACE -fsanitize=${CLOUDGEN_SANITIZE})
endif()
if(CLOUDGEN_LIBFUZZER)
  target_compile_options(cloudgen_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

set(CLOUDGEN_COMMON_HEADERS <algorithm> <cmath> <cstdint> <filesystem> <functional> <map> <string> <vector> <fmt/format.h>)

function(cloudgen_room NAME)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;PRIVATE;PUBLIC" ${ARGN})
  add_library(cloudgen_${NAME} STATIC ${ROOM_SOURCES})
  add_library(cloudgen::${NAME} ALIAS cloudgen_${NAME})
  target_link_libraries(cloudgen_${NAME} PUBLIC cloudgen_options ${ROOM_PUBLIC})
  foreach(room IN LISTS ROOM_ROOMS)
    target_link_libraries(cloudgen_${NAME} PUBLIC cloudgen::${room})
  endforeach()
  target_link_libraries(cloudgen_${NAME} PRIVATE ${ROOM_PRIVATE})
  # One precompiled header for all rooms.
  if(NAME STREQUAL "base")
    target_precompile_headers(cloudgen_${NAME} PRIVATE ${CLOUDGEN_COMMON_HEADERS})
  else()
    target_precompile_headers(cloudgen_${NAME} REUSE_FROM cloudgen_base)
  endif()
endfunction()
