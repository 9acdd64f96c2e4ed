# SPDX-License-Identifier: GPL-3.0-or-later
# Builds consumer/ against pgdr, the WAY it says, and runs it. Any failure ends the script with an error.
# As a subdirectory the whole library would be compiled again, as long as all of it took the first time: that is for
# scripts/nightly (PGDR_NIGHTLY); else the consumer's own file is compiled, with what its target gets from the library's.

set(prefix ${SCRATCH_DIR}/prefix)
set(build ${SCRATCH_DIR}/build)
file(REMOVE_RECURSE ${SCRATCH_DIR})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

if(WAY STREQUAL "find_package")
  run(${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${prefix})
  set(where -D CMAKE_PREFIX_PATH=${prefix})
else()
  set(where -D PGDR_SUBDIRECTORY=${SOURCE_DIR} -D PGDR_SANITIZE=${SANITIZE} -D PGDR_UNITY=${UNITY})
endif()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${build} -G ${GENERATOR}
  -D CMAKE_BUILD_TYPE=${BUILD_TYPE}
  -D CMAKE_CXX_FLAGS=${CXX_FLAGS}
  -D CMAKE_CXX_COMPILER=${COMPILER}
  -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  -D CGAL_DIR=${CGAL_DIR}
  ${where})
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
if(WAY STREQUAL "find_package" OR DEFINED ENV{PGDR_NIGHTLY})
  run(${CMAKE_COMMAND} --build ${build} --parallel ${cores})
  run(${build}/consumer)
elseif(GENERATOR MATCHES "Ninja")
  run(${CMAKE_COMMAND} --build ${build} --target CMakeFiles/consumer.dir/main.cpp.o)
else()
  run(${CMAKE_COMMAND} --build ${build} --target main.cpp.o)
endif()
