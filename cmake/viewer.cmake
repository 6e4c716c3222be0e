# The web page, bundled into ${CMAKE_BINARY_DIR}/viewer/viewer.html. Needs npm (and its registry, once); without it
# the rest of cloudgen is built as usual, and the page format says that it was not.
option(CLOUDGEN_VIEWER "Build the web page if npm is there" ON)
find_program(NPM npm)
find_program(NODE node)
find_program(FLATC flatc REQUIRED)
if(NOT CLOUDGEN_VIEWER OR NOT NPM OR NOT NODE)
  message(STATUS "The web page is not built: ${CMAKE_CURRENT_LIST_FILE} needs npm, node and CLOUDGEN_VIEWER=ON")
  return()
endif()

set(viewer_source "${PROJECT_SOURCE_DIR}/templates/viewer")
set(viewer_build "${CMAKE_BINARY_DIR}/viewer/build")
set(viewer_page "${CMAKE_BINARY_DIR}/viewer/viewer.html")
set(viewer_schema "${PROJECT_SOURCE_DIR}/schemas/runtime_pack.fbs")
file(GLOB_RECURSE viewer_sources CONFIGURE_DEPENDS "${viewer_source}/src/*.ts" "${viewer_source}/src/*.css" "${viewer_source}/test/*.ts" "${viewer_source}/*.mjs")

# Packages are installed in the build folder, so that the source tree stays as it was.
add_custom_command(
  OUTPUT "${viewer_build}/installed"
  COMMAND ${CMAKE_COMMAND} -E make_directory "${viewer_build}"
  COMMAND ${CMAKE_COMMAND} -E copy "${viewer_source}/package.json" "${viewer_source}/package-lock.json" "${viewer_build}"
  COMMAND ${CMAKE_COMMAND} -E chdir "${viewer_build}" "${NPM}" ci --no-audit --no-fund --loglevel=error
  COMMAND ${CMAKE_COMMAND} -E touch "${viewer_build}/installed"
  DEPENDS "${viewer_source}/package.json" "${viewer_source}/package-lock.json"
  COMMENT "Installing the packages of the web page (-DCLOUDGEN_VIEWER=OFF leaves the page out)"
  VERBATIM)
add_custom_command(
  OUTPUT "${viewer_page}"
  COMMAND ${CMAKE_COMMAND} -E rm -rf "${viewer_build}/src" "${viewer_build}/test"
  COMMAND ${CMAKE_COMMAND} -E copy "${viewer_source}/bundle.mjs" "${viewer_source}/coast.mjs" "${viewer_source}/test.mjs" "${viewer_source}/viewer.html" "${viewer_build}"
  COMMAND ${CMAKE_COMMAND} -E copy_directory "${viewer_source}/src" "${viewer_build}/src"
  COMMAND ${CMAKE_COMMAND} -E copy_directory "${viewer_source}/test" "${viewer_build}/test"
  COMMAND "${FLATC}" --ts -o "${viewer_build}/dist/schema" "${viewer_schema}"
  COMMAND "${NODE}" "${viewer_build}/bundle.mjs" "${viewer_page}"
  DEPENDS "${viewer_build}/installed" ${viewer_sources} "${viewer_schema}" "${viewer_source}/viewer.html"
  COMMENT "Bundling the web page"
  VERBATIM)
add_custom_target(cloudgen_viewer ALL DEPENDS "${viewer_page}")
install(FILES "${viewer_page}" DESTINATION share/cloudgen/viewer OPTIONAL)
if(CLOUDGEN_TESTS)
  add_test(NAME viewer COMMAND "${NODE}" "${viewer_build}/test.mjs")
  set_tests_properties(viewer PROPERTIES ENVIRONMENT "CLOUDGEN_LIST_PUFFS=${CMAKE_BINARY_DIR}/tests/support/list_puffs")
endif()
