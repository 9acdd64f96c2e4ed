// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_TRACE_FILE_H
#define PGDR_APPS_TRACE_FILE_H

#include <filesystem>

#include <pgdr/report/schedule_statistics.h>

namespace pgdr::app {

/// Writes the recorded tasks in the Chrome trace-event format, one row per thread; times in microseconds. Leaf tasks
/// have the category `leaf` and carry epoch, wave, octree position and insertions; what happens between waves is
/// `serial` or `parallel`. Complete or not at all. Throws `Output_error`.
void write_trace(const Schedule_statistics& schedule, const std::filesystem::path& path);

}  // namespace pgdr::app

#endif
