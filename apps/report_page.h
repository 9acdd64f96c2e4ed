// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_REPORT_PAGE_H
#define PGDR_APPS_REPORT_PAGE_H

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/mesh/indexed_mesh_3.h>
#include <pgdr/parameters.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/report/run_summary.h>

namespace pgdr::app {

using Rows = std::vector<std::pair<std::string, std::string>>;

/// How the number of vertices grew: some hundred moments of a run, however long it is.
class Progress_record {
 public:
  struct Moment {
    double seconds;
    std::size_t vertices;
    const char* phase;
  };
  /// From any thread.
  void add(const Progress& now);
  const std::vector<Moment>& moments() const { return moments_; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t stride_ = 1, calls_ = 0;
  std::vector<Moment> moments_;
  std::mutex mutex_;
};

/// What a page tells besides what it finds in the mesh.
struct Report {
  std::string title, subtitle;
  Rows input;                        ///< empty: nothing is known of it
  double ratio_bound = 0;            ///< 0: not known
  const Run_summary* run = nullptr;  ///< null for a mesh from a file
  const Progress_record* progress = nullptr;
};

/// Throws `Usage_error` where the program was built without the page.
void require_page(const std::string& option);

/// Writes one HTML file that needs no network: tables, histograms, the worst tetrahedra, times, and a picture that can be cut open. At most some
/// 15 MB: of a large mesh a sample of tetrahedra is in the picture. \pre the mesh has tetrahedra. Throws `Output_error`.
void write_report(const Indexed_mesh_3& mesh, const Report& report, const std::filesystem::path& path);

}  // namespace pgdr::app

#endif
