// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_SCHEDULE_STATISTICS_H
#define PGDR_REPORT_SCHEDULE_STATISTICS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pgdr {

/// One epoch of the parallel refinement: the octree stays as it is while its leaves are worked on in waves.
struct Epoch_statistics {
  std::size_t leaves = 0;       ///< of the octree
  std::size_t waves = 0;        ///< task graphs, one after the other
  std::size_t tasks = 0;        ///< leaf tasks in all of them
  std::size_t most_ready = 0;   ///< tasks that waited for no other at the start of a wave, at most
  std::size_t active = 0;       ///< elements above their leaf's target at the start
  std::size_t deferred = 0;     ///< elements left for smaller leaves at the end
  std::size_t inserted = 0;     ///< points
  std::size_t inserted_alone = 0;  ///< points inserted while only one task could be worked on
  double seconds = 0;           ///< wall time
  double serial_seconds = 0;    ///< of them with work for one thread only: in lone leaf tasks, or in neither tasks nor parallel loops
};

/// One leaf task, or one section of work between two waves.
struct Task_record {
  enum class Kind : std::uint8_t { leaf, serial, parallel };
  Kind kind = Kind::leaf;
  std::uint8_t level = 0;             ///< of the leaf; x, y, z in units of its edge
  std::uint16_t thread = 0;
  std::uint32_t x = 0, y = 0, z = 0;
  std::uint32_t epoch = 0, wave = 0;  ///< waves are numbered through the epochs
  std::uint32_t inserted = 0;
  std::uint16_t territory = 0;        ///< not 0: beside other tasks on the same leaf
  const char* name = "leaf";
  double start = 0;    ///< seconds since the refinement began
  double seconds = 0;
};

/// How the refinement was scheduled.
struct Schedule_statistics {
  unsigned threads = 1;
  std::vector<Epoch_statistics> epochs;
  std::size_t far_parcels = 0;  ///< that had to be delivered between waves, beyond the leaves that touch
  std::size_t settled = 0;      ///< points inserted alone because a facet was torn beyond one leaf
  double seconds = 0;
  double serial_seconds = 0;    ///< of them with work for one thread only
  std::array<double, 3> root_lower{};  ///< lower corner of the octree's root
  double root_edge = 0;
  std::vector<Task_record> records;  ///< empty unless asked for
};

}  // namespace pgdr

#endif
