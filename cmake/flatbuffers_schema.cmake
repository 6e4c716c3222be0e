# flatbuffers_schema(TARGET FILE.fbs): an interface target with the header that flatc makes of a schema
# (<FILE_generated.h>); what links it may include <flatbuffers/...>.
find_program(FLATC flatc REQUIRED)

function(flatbuffers_schema TARGET SCHEMA)
  get_filename_component(name "${SCHEMA}" NAME_WE)
  set(folder "${CMAKE_BINARY_DIR}/schemas")
  add_custom_command(
    OUTPUT "${folder}/${name}_generated.h"
    COMMAND "${FLATC}" --cpp --scoped-enums --gen-object-api -o "${folder}" "${SCHEMA}"
    DEPENDS "${SCHEMA}"
    COMMENT "Making ${name}_generated.h"
    VERBATIM)
  add_custom_target(${TARGET}_header DEPENDS "${folder}/${name}_generated.h")
  add_library(${TARGET} INTERFACE)
  add_dependencies(${TARGET} ${TARGET}_header)
  target_include_directories(${TARGET} SYSTEM INTERFACE "${folder}")
  target_link_libraries(${TARGET} INTERFACE flatbuffers)
endfunction()
