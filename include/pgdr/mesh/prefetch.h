// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_PREFETCH_H
#define PGDR_MESH_PREFETCH_H

#include <cstddef>

namespace pgdr {

/// Asks for the memory of what a handle points to, which is not read: a walk that goes all over the mesh, and knows where it will be soon, so
/// hides part of the way to memory.
template <class Handle>
void prefetch([[maybe_unused]] Handle h) {
#if defined(__GNUC__)
  constexpr std::size_t line = 64, size = sizeof(*h);
  const char* const first = reinterpret_cast<const char*>(&*h);
  for (std::size_t at = 0; at < size; at += line) __builtin_prefetch(first + at);
#endif
}

}  // namespace pgdr

#endif
