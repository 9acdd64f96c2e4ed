// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_INPUTS_H
#define PGDR_TEST_INPUTS_H

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace pgdr_test {

/// The project's own shapes.
inline std::filesystem::path data_file(const std::string& name) {
  return std::filesystem::path(PGDR_DATA_DIR) / name;
}

/// The folder of real models, which are not part of the project: the environment's PGDR_INPUTS,
/// else what the build was configured with. It need not exist.
inline std::filesystem::path inputs_folder() {
  const char* folder = std::getenv("PGDR_INPUTS");
  return folder != nullptr && *folder != '\0' ? folder : PGDR_INPUTS_DEFAULT;
}

/// A real model, or nothing where it is absent; the test then calls PGDR_SKIP.
inline std::optional<std::filesystem::path> input_model(const std::string& name) {
  const std::filesystem::path path = inputs_folder() / name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  return path;
}

/// The program under test: the environment's PGDR_APP, else the one of this build.
inline std::filesystem::path app() {
  const char* path = std::getenv("PGDR_APP");
  return path != nullptr && *path != '\0' ? path : PGDR_APP_DEFAULT;
}

/// An interpreter of Python 3, one with meshio if there is any.
inline std::string python() {
  const char* path = std::getenv("PGDR_PYTHON");
  return path != nullptr && *path != '\0' ? path : PGDR_PYTHON_DEFAULT;
}

}  // namespace pgdr_test

#endif
