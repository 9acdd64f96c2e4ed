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
#include <pgdr/io/medit.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/quality/check_mesh.h>

namespace {

constexpr std::array<const char*, 7> extensions{".poly", ".smesh", ".off", ".stl", ".ply", ".obj", ".mesh"};

std::filesystem::path file_for(const char* extension) {
  return std::filesystem::temp_directory_path() / ("pgdr-fuzz-" + std::to_string(getpid()) + extension);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  const std::size_t format = data[0] % extensions.size();
  const std::filesystem::path path = file_for(extensions[format]);
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  try {
    if (format + 1 == extensions.size())
      (void)pgdr::check_mesh(pgdr::read_medit(path));
    else
      (void)pgdr::make_domain_3(pgdr::read_plc(path));
  } catch (const pgdr::Input_error& error) {
    if (error.problems().empty() || std::string(error.what()).empty()) std::abort();
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return 0;
}
