// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_IO_READ_BACK_H
#define PGDR_TEST_IO_READ_BACK_H

#include <sys/wait.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "../inputs.h"

namespace pgdr_test {

/// Runs a shell command; its exit code.
inline int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Exit code of read_back.py on a mesh that it is told the truth about, or a lie.
inline int read_back(const std::filesystem::path& file, std::size_t points, std::size_t tetrahedra,
                     const std::string& more = "") {
  const auto script = pgdr_test::data_file("../test/io/read_back.py").lexically_normal();
  return run("'" + pgdr_test::python() + "' -B '" + script.string() + "' '" + file.string() + "' " +
             std::to_string(points) + " " + std::to_string(tetrahedra) + more);
}

}  // namespace pgdr_test

#endif
