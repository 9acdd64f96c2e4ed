// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/atomic_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include <pgdr/io/output_error.h>

namespace pgdr {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = std::size_t(1) << 20;

[[noreturn]] void cannot_write(const fs::path& target, const std::string& why) {
  throw Output_error("cannot write '" + target.string() + "': " + why);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The file that a rename has to replace, or to make; a link keeps pointing where it did.
fs::path behind_links(const fs::path& target) {
  std::error_code error;
  if (!fs::is_symlink(target, error)) return target;
  fs::path resolved = fs::canonical(target, error);
  if (!error) return resolved;
  resolved = folder_of(target) / fs::read_symlink(target, error);  // nothing is there yet
  return error || fs::is_symlink(resolved, error) ? target : resolved;
}

/// What a rename would do without asking: replace a device, or a file that its owner protected.
void check_target(const fs::path& target, const fs::path& resolved) {
  if (target.empty() || !target.has_filename()) cannot_write(target, "it names no file");
  std::error_code error;
  const fs::path folder = folder_of(resolved);
  const fs::file_status folder_status = fs::status(folder, error);
  if (!fs::exists(folder_status)) cannot_write(target, "the folder '" + folder.string() + "' does not exist");
  if (!fs::is_directory(folder_status)) cannot_write(target, "'" + folder.string() + "' is not a folder");
  const fs::file_status status = fs::status(resolved, error);
  if (fs::is_directory(status)) cannot_write(target, "it is a folder");
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) cannot_write(target, "it is not a regular file");
  if (::access(resolved.c_str(), W_OK) != 0) cannot_write(target, std::generic_category().message(errno));
}

}  // namespace

Atomic_file::Atomic_file(const std::filesystem::path& target)
    : target_(target), resolved_(behind_links(target)), buffer_(buffer_size) {
  check_target(target_, resolved_);
  static std::atomic<unsigned> counter{0};
  do {
    temporary_ = resolved_;
    temporary_ += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && (errno == EEXIST || errno == EINTR));
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail(error);
  }
  // A file that is replaced keeps its permissions; not a reason to fail where that is not possible.
  struct stat existing;
  if (::stat(resolved_.c_str(), &existing) == 0 && ::fchmod(descriptor_, existing.st_mode & 07777) != 0)
    errno = 0;
}

Atomic_file::~Atomic_file() { discard(); }

void Atomic_file::write(const void* bytes, std::size_t size) {
  // What is large goes past the buffer.
  if (size > buffer_.size() - buffered_) flush();
  if (size >= buffer_.size() / 8) {
    flush();
    put(static_cast<const char*>(bytes), size);
    return;
  }
  std::memcpy(buffer_.data() + buffered_, bytes, size);
  buffered_ += size;
}

void Atomic_file::overwrite(std::uint64_t position, const void* bytes, std::size_t size) {
  flush();
  const char* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = ::pwrite(descriptor_, next, size, static_cast<off_t>(position));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : EIO);
    next += written;
    position += static_cast<std::uint64_t>(written);
    size -= static_cast<std::size_t>(written);
  }
}

void Atomic_file::commit() {
  flush();
  // A failed close can be the first news of a full disk; the descriptor is gone in either case.
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (std::rename(temporary_.c_str(), resolved_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void Atomic_file::flush() { put(buffer_.data(), std::exchange(buffered_, 0)); }

void Atomic_file::put(const char* next, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : EIO);
    next += written;
    size -= static_cast<std::size_t>(written);
    flushed_ += static_cast<std::uint64_t>(written);
  }
}

void Atomic_file::fail(int error) const { cannot_write(target_, std::generic_category().message(error)); }

void Atomic_file::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void check_writable(const std::filesystem::path& target) {
  // Only the attempt itself knows about read-only file systems, quotas and access lists.
  Atomic_file probe(target);
}

}  // namespace pgdr
