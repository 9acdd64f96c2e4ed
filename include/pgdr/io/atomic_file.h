// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_ATOMIC_FILE_H
#define PGDR_IO_ATOMIC_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace pgdr {

/// A file that appears under its name complete or not at all.
///
/// Bytes go to a temporary file beside the target; `commit()` renames it. Without `commit()` the
/// destructor removes the temporary file and an existing target stays as it was.
/// Every failed system call throws `Output_error`.
class Atomic_file {
 public:
  /// Opens the temporary file. The target is a new or a regular file.
  explicit Atomic_file(const std::filesystem::path& target);
  ~Atomic_file();
  Atomic_file(const Atomic_file&) = delete;
  Atomic_file& operator=(const Atomic_file&) = delete;

  /// Appends bytes.
  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Number of bytes written so far.
  std::uint64_t position() const { return flushed_ + buffered_; }

  /// Replaces bytes that were written before, for sizes that are only known later.
  void overwrite(std::uint64_t position, const void* bytes, std::size_t size);

  /// Writes out what is buffered, closes and renames. Nothing may be written after.
  void commit();

 private:
  void flush();
  void put(const char* bytes, std::size_t size);
  [[noreturn]] void fail(int error) const;
  void discard() noexcept;

  std::filesystem::path target_;     ///< as the user named it
  std::filesystem::path resolved_;   ///< behind symbolic links
  std::filesystem::path temporary_;  ///< empty when there is none
  int descriptor_ = -1;
  std::vector<char> buffer_;
  std::size_t buffered_ = 0;
  std::uint64_t flushed_ = 0;
};

/// Throws `Output_error` when `target` could not be written now: its folder is missing or closed to
/// this user, or the name belongs to a folder, a device or a write-protected file. Leaves nothing behind.
void check_writable(const std::filesystem::path& target);

}  // namespace pgdr

#endif
