# SPDX-License-Identifier: GPL-3.0-or-later
# A vcpkg port of a checkout; put a vcpkg_from_git in place of SOURCE_PATH for a registry. Not tried: there was no vcpkg where it was written.
get_filename_component(SOURCE_PATH ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
vcpkg_check_features(OUT_FEATURE_OPTIONS options FEATURES tools PGDR_BUILD_APP)
vcpkg_cmake_configure(SOURCE_PATH ${SOURCE_PATH} OPTIONS ${options} -DPGDR_BUILD_TESTS=OFF -DPGDR_BUILD_BENCH=OFF -DPGDR_BUILD_PYTHON=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/pgdr)
if(PGDR_BUILD_APP)
  vcpkg_copy_tools(TOOL_NAMES pgdr AUTO_CLEAN)
endif()
file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include ${CURRENT_PACKAGES_DIR}/debug/share)
vcpkg_install_copyright(FILE_LIST ${SOURCE_PATH}/LICENSE)
