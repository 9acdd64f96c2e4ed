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
      -fsanitize=${PGDR_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${PGDR_SANITIZE})
  endif()
endfunction()

# pgdr_add_program(<target> <sources>...): an executable that uses the library.
function(pgdr_add_program target)
  add_executable(${target} ${ARGN})
  target_link_libraries(${target} PRIVATE pgdr::pgdr)
  pgdr_compile_options(${target})
endfunction()
