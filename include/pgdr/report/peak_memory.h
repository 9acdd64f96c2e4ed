// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_PEAK_MEMORY_H
#define PGDR_REPORT_PEAK_MEMORY_H

#include <cstddef>

#include <sys/resource.h>

namespace pgdr {

/// The most memory in bytes that this process has had resident so far; 0 where the system does not tell.
inline std::size_t peak_memory_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
  return static_cast<std::size_t>(usage.ru_maxrss);
#else
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux and the BSDs count in KiB
#endif
}

}  // namespace pgdr

#endif
