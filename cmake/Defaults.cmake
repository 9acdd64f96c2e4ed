# SPDX-License-Identifier: GPL-3.0-or-later
# What a stranger gets who types `cmake -B build` and nothing else.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo or MinSizeRel" FORCE)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(PGDR_CCACHE ccache)
if(PGDR_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PGDR_CCACHE})
  if(PGDR_UNITY AND NOT DEFINED ENV{CCACHE_SLOPPINESS})
    # What ccache's manual asks for where headers are precompiled; without it, it keeps nothing of them.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${PGDR_CCACHE})
  endif()
endif()
