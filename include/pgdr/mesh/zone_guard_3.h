// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_ZONE_GUARD_3_H
#define PGDR_MESH_ZONE_GUARD_3_H

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <pgdr/domain/region_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>

namespace pgdr {

/// Checks in a checked run that a task stays within its reach, and that no two running tasks touch the same cell.
///
/// A task owns what it touched until it ends. Throws `std::logic_error` from the task that comes second, or that goes
/// too far: neither can happen as long as the zone theorem holds, and the program does what it demands.
template <class Tr>
class Zone_guard_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;

  /// `tag` names the running task and is not 0.
  void open(const Tr& tr, const Region_3& reach, std::uint16_t tag) {
    tr_ = &tr;
    reach_ = reach;
    tag_ = tag;
  }

  void touch(Cell_handle c) {
    if (!tr_) return;
    const std::uint16_t before = c->owner().exchange(tag_, std::memory_order_relaxed);
    if (before == tag_) return;
    if (before != 0) throw std::logic_error("two running tasks touched one tetrahedron");
    owned_.push_back(c);
    for (int i = 0; i < 4; ++i)
      if (!tr_->is_infinite(c->vertex(i)) && !reach_.contains_closed(position(c->vertex(i))))
        throw std::logic_error("a task touched a tetrahedron beyond the zone of its leaf");
  }

  /// A cell that the task has just made.
  void adopt(Cell_handle c) {
    if (!tr_) return;
    c->owner().store(tag_, std::memory_order_relaxed);
    owned_.push_back(c);
  }

  void close() {
    for (const Cell_handle c : owned_) c->owner().store(0, std::memory_order_relaxed);
    owned_.clear();
    tr_ = nullptr;
  }

 private:
  const Tr* tr_ = nullptr;
  Region_3 reach_;
  std::uint16_t tag_ = 0;
  std::vector<Cell_handle> owned_;
};

}  // namespace pgdr

#endif
