// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_MEMORY_H
#define PGDR_REPORT_MEMORY_H

#include <cstddef>
#include <optional>

namespace pgdr {

/// The most memory in bytes that this process has had resident so far; 0 where the system does not tell.
std::size_t peak_memory_bytes();

/// The memory in bytes that this process has resident now; 0 where the system does not tell. Cheap: fit to be asked often.
std::size_t resident_memory_bytes();

/// How much memory in bytes this process may have resident: what it has, and what is free on the machine and in the control groups
/// (version 2) that the process is in. Nothing where the system does not tell.
std::optional<std::size_t> attainable_memory_bytes();

}  // namespace pgdr

#endif
