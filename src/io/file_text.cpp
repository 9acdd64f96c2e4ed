// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_text.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace pgdr::io_detail {
namespace {

[[noreturn]] void cannot_read(const std::filesystem::path& path, const std::string& why) {
  throw Input_error(Input_problem::Kind::unreadable, "cannot read '" + path.string() + "': " + why);
}

struct Descriptor {
  int value = -1;
  explicit Descriptor(int d) : value(d) {}
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

}  // namespace

File_text::File_text(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.value < 0) cannot_read(path, errno == ENOENT ? "there is no such file" : std::generic_category().message(errno));
  struct stat status;
  if (::fstat(file.value, &status) != 0) cannot_read(path, std::generic_category().message(errno));
  if (S_ISDIR(status.st_mode)) cannot_read(path, "it is a folder");

  // A pipe has no size; it and a file that grows meanwhile are read in growing steps.
  std::size_t capacity = std::max<std::size_t>(static_cast<std::size_t>(status.st_size) + 1, 4096);
  bytes_.reset(new char[capacity]);
  for (;;) {
    if (size_ == capacity) {
      std::unique_ptr<char[]> larger(new char[2 * capacity]);
      std::memcpy(larger.get(), bytes_.get(), size_);
      bytes_ = std::move(larger);
      capacity *= 2;
    }
    const ssize_t count = ::read(file.value, bytes_.get() + size_, capacity - size_);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) cannot_read(path, std::generic_category().message(errno));
    if (count == 0) return;
    size_ += static_cast<std::size_t>(count);
  }
}

std::string located(const std::filesystem::path& path, std::size_t line, const std::string& what) {
  return "'" + path.string() + "'" + (line > 0 ? ", line " + std::to_string(line) : std::string()) + ": " +
         what;
}

void fail_at(const std::filesystem::path& path, std::size_t line, Input_problem::Kind kind,
             const std::string& what) {
  throw Input_error(kind, located(path, line, what));
}

std::size_t line_of(std::string_view text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

}  // namespace pgdr::io_detail
