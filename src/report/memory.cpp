// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <pgdr/report/memory.h>

namespace pgdr {

namespace {

/// The number behind a name in a file of lines `name number ...`.
std::optional<std::size_t> number_behind(const std::filesystem::path& file, const std::string& name) {
  std::ifstream in(file);
  std::string word;
  while (in >> word) {
    std::size_t number = 0;
    if (word == name && in >> number) return number;
    in.clear();
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::nullopt;
}

/// A file that holds a number and nothing else; nothing if it is not there, or says `max`.
std::optional<std::size_t> number_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::size_t number = 0;
  if (in >> number) return number;
  return std::nullopt;
}

/// What a control group leaves, its caches given back; nothing if it has no limit.
std::optional<std::size_t> free_in_group(const std::filesystem::path& group) {
  const auto most = number_in(group / "memory.max"), used = number_in(group / "memory.current");
  if (!most || !used) return std::nullopt;
  const std::size_t cache = std::min(*used, number_behind(group / "memory.stat", "inactive_file").value_or(0));
  const std::size_t needed = *used - cache;
  return *most - std::min(*most, needed);
}

/// The least that the control groups of this process leave, from its own to the root.
std::optional<std::size_t> free_in_groups() {
  std::ifstream in("/proc/self/cgroup");
  std::string line;
  while (std::getline(in, line) && !line.starts_with("0::")) {}
  if (!line.starts_with("0::/")) return std::nullopt;
  const std::filesystem::path root("/sys/fs/cgroup");
  std::optional<std::size_t> least;
  for (std::filesystem::path group = root / line.substr(4);; group = group.parent_path()) {
    if (const auto free = free_in_group(group)) least = std::min(least.value_or(*free), *free);
    if (group == root || group.string().size() <= root.string().size()) return least;
  }
}

}  // namespace

std::size_t peak_memory_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
  return static_cast<std::size_t>(usage.ru_maxrss);
#else
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux and the BSDs count in KiB
#endif
}

std::size_t resident_memory_bytes() {
  // Without an allocation: it is asked when there may be nothing left. The file holds numbers of pages: of all memory, of what is resident, ...
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  std::array<char, 128> text{};
  const ssize_t size = read(file, text.data(), text.size());
  close(file);
  const char* const end = text.data() + std::max<ssize_t>(size, 0);
  const char* const second = std::find(static_cast<const char*>(text.data()), end, ' ');
  std::size_t pages = 0;
  if (second == end || std::from_chars(second + 1, end, pages).ec != std::errc()) return 0;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::optional<std::size_t> attainable_memory_bytes() {
  const auto kib = number_behind("/proc/meminfo", "MemAvailable:");
  if (!kib) return std::nullopt;
  return resident_memory_bytes() + std::min(*kib * 1024, free_in_groups().value_or(std::numeric_limits<std::size_t>::max()));
}

}  // namespace pgdr
