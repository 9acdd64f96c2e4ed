// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_STATS_FILE_H
#define PGDR_APPS_STATS_FILE_H

#include <filesystem>
#include <string>

#include <pgdr/report/run_summary.h>

namespace pgdr::app {

/// The summary as a JSON object. Keys are only ever added: scripts read them.
std::string stats_json(const Run_summary& run);

/// Writes `stats_json` to `path`, complete or not at all. Throws `Output_error`.
void write_stats(const Run_summary& run, const std::filesystem::path& path);

}  // namespace pgdr::app

#endif
