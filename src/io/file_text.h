// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SRC_IO_FILE_TEXT_H
#define PGDR_SRC_IO_FILE_TEXT_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <pgdr/domain/input_error.h>

namespace pgdr::io_detail {

/// The bytes of a whole file. A copy and not a map: a file that shrinks while it is mapped kills the process.
class File_text {
 public:
  /// Throws `Input_error` when the file is missing, unreadable or a folder.
  explicit File_text(const std::filesystem::path& path);

  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// "'file', line 12: what"; without a line when it is 0.
std::string located(const std::filesystem::path& path, std::size_t line, const std::string& what);

/// Throws `Input_error` with the located message.
[[noreturn]] void fail_at(const std::filesystem::path& path, std::size_t line, Input_problem::Kind kind,
                          const std::string& what);

/// 1-based line of a place in a text.
std::size_t line_of(std::string_view text, std::size_t offset);

}  // namespace pgdr::io_detail

#endif
