# SPDX-License-Identifier: GPL-3.0-or-later
# The page of --report and `pgdr view`, bundled by npm from apps/page when the build is configured. Sets PGDR_PAGE_SOURCE to a C++ file that
# holds it, or nothing where there is no npm, or it cannot fetch what it needs: then the program is built without.
set(PGDR_PAGE_SOURCE ${PROJECT_BINARY_DIR}/page/no_page.cpp)
file(CONFIGURE OUTPUT ${PGDR_PAGE_SOURCE} CONTENT "// Made by cmake/Page.cmake.
#include \"page.h\"
namespace pgdr::app {
const char* const page_script = nullptr;
const char* const page_style = nullptr;
}  // namespace pgdr::app
")
find_program(PGDR_NPM npm)
mark_as_advanced(PGDR_NPM)
if(NOT PGDR_NPM)
  message(STATUS "npm not found: the program is built without --report and view")
  return()
endif()

set(from ${PROJECT_SOURCE_DIR}/apps/page)
set(folder ${PROJECT_BINARY_DIR}/page)
file(GLOB page_sources CONFIGURE_DEPENDS ${from}/src/*.js)
list(APPEND page_sources ${from}/package.json ${from}/package-lock.json ${from}/style.css)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_sources})
set(state "")
foreach(file IN LISTS page_sources ITEMS ${CMAKE_CURRENT_LIST_FILE})
  file(SHA256 ${file} hash)
  string(APPEND state ${hash})
endforeach()
set(known "")
if(EXISTS ${folder}/state)
  file(READ ${folder}/state known)
endif()
if(NOT known STREQUAL state)
  file(REMOVE ${folder}/state)
  file(COPY ${from}/ DESTINATION ${folder} PATTERN node_modules EXCLUDE)
  message(STATUS "Bundling the page of --report (npm)")
  execute_process(COMMAND ${PGDR_NPM} ci --no-audit --no-fund WORKING_DIRECTORY ${folder} RESULT_VARIABLE failed OUTPUT_FILE ${folder}/npm.log ERROR_FILE ${folder}/npm.err)
  if(NOT failed)
    execute_process(COMMAND ${PGDR_NPM} run --silent build -- --outfile=${folder}/page.js WORKING_DIRECTORY ${folder} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_FILE ${folder}/npm.err)
  endif()
  if(failed)
    message(STATUS "npm failed (${folder}/npm.err): the program is built without --report and view")
    return()
  endif()
  file(READ ${folder}/page.js script)
  file(READ ${folder}/style.css style)
  file(WRITE ${folder}/page.cpp "// Made by cmake/Page.cmake.
#include \"page.h\"
#pragma GCC diagnostic ignored \"-Woverlength-strings\"
namespace pgdr::app {
const char* const page_script = R\"pgdrpage(${script})pgdrpage\";
const char* const page_style = R\"pgdrpage(${style})pgdrpage\";
}  // namespace pgdr::app
")
  file(WRITE ${folder}/state "${state}")
endif()
set(PGDR_PAGE_SOURCE ${folder}/page.cpp)
