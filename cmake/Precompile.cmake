# SPDX-License-Identifier: GPL-3.0-or-later
# With PGDR_UNITY, headers of others are parsed once for all targets: pgdr_precompile(<target>) makes <target> start from them. A
# translation unit that uses the triangulation spends 7 seconds less; to make them takes 30 (GCC 12).
function(pgdr_precompile target)
  if(PGDR_UNITY)
    target_compile_options(${target} PRIVATE -fPIC)  # must be the same for all who share them
    target_precompile_headers(${target} REUSE_FROM pgdr-headers)
  endif()
endfunction()

if(PGDR_UNITY)
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/headers.cpp CONTENT "// A library wants a source.\n")
  add_library(pgdr-headers OBJECT ${PROJECT_BINARY_DIR}/headers.cpp)
  target_precompile_headers(pgdr-headers PRIVATE
    <CGAL/Exact_predicates_inexact_constructions_kernel.h> <CGAL/Delaunay_triangulation_3.h> $<$<BOOL:${PGDR_TBB}>:<tbb/tbb.h$<ANGLE-R>>
    <algorithm> <filesystem> <fstream> <functional> <iostream> <map> <random> <regex> <sstream> <thread> <unordered_map>)
  # As whoever links the library; not linked itself, since the library waits for these headers.
  target_link_libraries(pgdr-headers PRIVATE CGAL::CGAL $<$<BOOL:${PGDR_TBB}>:TBB::tbb>)
  target_compile_definitions(pgdr-headers PRIVATE $<TARGET_PROPERTY:pgdr,INTERFACE_COMPILE_DEFINITIONS>)
  target_compile_options(pgdr-headers PRIVATE $<TARGET_PROPERTY:pgdr,INTERFACE_COMPILE_OPTIONS> -fPIC)
  target_compile_features(pgdr-headers PRIVATE cxx_std_20)
  set_target_properties(pgdr-headers PROPERTIES CXX_EXTENSIONS OFF)
  pgdr_compile_options(pgdr-headers)
endif()
