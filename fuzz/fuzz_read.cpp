// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as a file of every format that is read: what comes is an object or an `Input_error`, nothing else. The first byte chooses the format.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/io/read_mesh.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/io/read_sizes.h>
#include <pgdr/quality/check_mesh.h>

namespace {

// What is a mesh comes last. As sizes, .vtu and .vti.
constexpr std::array<const char*, 10> extensions{".poly", ".smesh", ".off", ".stl", ".ply", ".obj", ".mesh", ".vtu", ".msh", ".vti"};
constexpr std::size_t first_mesh = 6, vtu = 7, vti = 9;

std::filesystem::path file_for(const char* extension) {
  return std::filesystem::temp_directory_path() / ("pgdr-fuzz-" + std::to_string(getpid()) + extension);
}

/// Those of a mesh need not be there, but it may be one all the same.
void read_sizes(const std::filesystem::path& path) {
  try {
    (void)pgdr::read_nodal_values(path, "reference");
  } catch (const pgdr::Input_error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  const std::size_t format = data[0] % extensions.size();
  const std::filesystem::path path = file_for(extensions[format]);
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  try {
    if (format == vti) (void)pgdr::read_nodal_values(path, "h");
    if (format < first_mesh) {
      (void)pgdr::make_domain_3(pgdr::read_plc(path));
    } else if (format != vti) {
      if (format == vtu) read_sizes(path);
      (void)pgdr::check_mesh(pgdr::read_mesh(path));
      (void)pgdr::make_domain_3(pgdr::read_plc(path));
    }
  } catch (const pgdr::Input_error& error) {
    if (error.problems().empty() || std::string(error.what()).empty()) std::abort();
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return 0;
}
