# SPDX-License-Identifier: GPL-3.0-or-later
# `find_package(pgdr)` finds what this installs; `test/install` shows that it does.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(pgdr_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pgdr)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/pgdrConfig.cmake.in
  ${PROJECT_BINARY_DIR}/pgdrConfig.cmake INSTALL_DESTINATION ${pgdr_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pgdrConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)

install(TARGETS pgdr EXPORT pgdrTargets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT pgdrTargets NAMESPACE pgdr:: DESTINATION ${pgdr_package_dir})
install(FILES ${PROJECT_BINARY_DIR}/pgdrConfig.cmake ${PROJECT_BINARY_DIR}/pgdrConfigVersion.cmake
  DESTINATION ${pgdr_package_dir})
if(TARGET pgdr-app)
  install(TARGETS pgdr-app)
endif()
