// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_BENCH_REPLAY_TRACE_H
#define PGDR_BENCH_REPLAY_TRACE_H

#include <cstdint>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

#include <pgdr/octree/octree_key.h>

namespace pgdr::bench {

/// A trace that is not what `pgdr mesh --trace` writes.
struct Trace_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One run of one leaf task.
struct Leaf_task {
  Octree_key key;
  std::uint32_t epoch = 0, wave = 0;
  double start = 0;    ///< seconds
  double seconds = 0;  ///< how long it ran
  bool is_part = false;  ///< of a leaf's work, divided among territories; touches none of the others
};

/// Something that happened between waves, with the whole machine to itself.
struct Section {
  std::string name;
  double start = 0;    ///< seconds
  double seconds = 0;  ///< as recorded, on `Trace::threads` threads
  bool parallel = false;
};

/// What a run of the parallel refinement did, in the order of time.
struct Trace {
  unsigned threads = 1;  ///< of the recorded run
  std::vector<Leaf_task> tasks;
  std::vector<Section> sections;
};

/// Reads a trace in Chrome's trace-event format:
///
///   {"otherData": {"threads": N}, "traceEvents": [
///     {"ph": "X", "cat": "leaf", "name": "leaf", "ts": us, "dur": us, "tid": t,
///      "args": {"epoch": e, "wave": w, "level": l, "x": i, "y": j, "z": k, "inserted": n, "territory": t}},
///     {"ph": "X", "cat": "serial", "name": "...", "ts": us, "dur": us, "tid": t},
///     {"ph": "X", "cat": "parallel", "name": "...", "ts": us, "dur": us, "tid": t}, ...]}
///
/// Only complete events ("ph": "X") of these categories count; others, such as the names of threads, are skipped, and
/// so are members that are not listed. A territory other than 0 makes a task a part; it may be left out. Tasks are sorted by (epoch, wave, start, key), sections by start.
/// The file is never held as a tree, so that millions of events fit. Throws Trace_error, with the number of the event.
Trace read_trace(std::istream& in);

}  // namespace pgdr::bench

#endif
