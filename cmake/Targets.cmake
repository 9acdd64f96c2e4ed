# SPDX-License-Identifier: GPL-3.0-or-later

# pgdr_compile_options(<target>): warnings, sanitizers and processor as the options PGDR_* say.
# None of it reaches those who link <target>.
function(pgdr_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow
    # GCC 12 sees overlapping copies in `"literal" + std::string` (its bug 105651).
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
  if(PGDR_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(PGDR_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
  if(PGDR_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${PGDR_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
      # oneTBB casts a task to its type after it was destroyed (_flow_graph_impl.h, destruct_and_deallocate), to free its memory.
      $<$<CXX_COMPILER_ID:GNU>:-fno-sanitize=vptr>)
    target_link_options(${target} PUBLIC -fsanitize=${PGDR_SANITIZE})
  endif()
endfunction()

# pgdr_add_program(<target> <sources>...): an executable that uses the library.
function(pgdr_add_program target)
  add_executable(${target} ${ARGN})
  target_link_libraries(${target} PRIVATE pgdr::pgdr)
  pgdr_compile_options(${target})
endfunction()

# pgdr_compile_together(<target> [<folder>...]): with PGDR_UNITY, one translation unit for all sources, or for those in each
# folder. Nearly all of the time to compile one of them goes into headers that they share.
function(pgdr_compile_together target)
  if(NOT PGDR_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  # GCC takes a source for a header where another file includes it, and warns of types that it shares with nobody; names of one
  # source hide those of another.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  if(ARGN)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(folder IN LISTS ARGN)
      set(group ${sources})
      list(FILTER group INCLUDE REGEX "/${folder}/[^/]+\\.cpp$")
      set_source_files_properties(${group} PROPERTIES UNITY_GROUP ${folder})
    endforeach()
  endif()
endfunction()
