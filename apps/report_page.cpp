// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <string_view>

#include <nlohmann/json.hpp>

#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/quality/measures.h>
#include <pgdr/report/format.h>

#include "arguments.h"
#include "page.h"

namespace pgdr::app {

namespace {

using nlohmann::json;

/// Tetrahedra in the picture at most: about 10 MB of page, and seconds to open.
constexpr std::size_t most_drawn = 300'000;
constexpr std::size_t most_tasks = 3000, most_moments = 400, most_worst = 12, most_regions = 8;

template <class T>
std::string base64(const std::vector<T>& values) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
  const std::size_t size = values.size() * sizeof(T);
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t n = std::min<std::size_t>(3, size - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// The measures of a tetrahedron that the page shows.
struct Shape {
  float dihedral, ratio;
};

std::vector<Shape> shapes_of(const Indexed_mesh_3& mesh) {
  std::vector<Shape> shapes;
  shapes.reserve(mesh.tetrahedra.size());
  for (const auto& t : mesh.tetrahedra) {
    const auto &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
    shapes.push_back({static_cast<float>(smallest_dihedral_angle_deg(a, b, c, d)), static_cast<float>(radius_edge_ratio(a, b, c, d))});
  }
  return shapes;
}

std::int32_t region_of(const Indexed_mesh_3& mesh, std::size_t i) { return i < mesh.tetrahedron_references.size() ? mesh.tetrahedron_references[i] : 0; }

std::string region_name(const Indexed_mesh_3& mesh, std::int32_t region) {
  const auto named = mesh.names.regions.find(region);
  return named == mesh.names.regions.end() ? "region " + std::to_string(region) : named->second;
}

/// Counts by bin and region; regions beyond the first ones together.
class Histogram {
 public:
  Histogram(const Indexed_mesh_3& mesh, std::vector<double> limits) : mesh_(mesh), limits_(std::move(limits)) {}

  void add(double value, std::int32_t region) {
    const auto above = std::ranges::upper_bound(limits_, value);
    const auto bin = std::clamp<std::ptrdiff_t>(above - limits_.begin() - 1, 0, static_cast<std::ptrdiff_t>(limits_.size()) - 2);
    auto& counts = counts_[region];
    counts.resize(limits_.size() - 1);
    ++counts[static_cast<std::size_t>(bin)];
  }

  json to_json(const std::string& title, const std::string& unit) const {
    json bins = json::array();
    std::vector<std::string> names;
    std::vector<std::size_t> others(limits_.size() - 1);
    const auto put = [&](const std::vector<std::size_t>& counts, const std::string& name) {
      for (std::size_t b = 0; b < counts.size(); ++b)
        if (counts[b] > 0) bins.push_back({rounded(limits_[b]), rounded(limits_[b + 1]), counts[b], name});
      names.push_back(name);
    };
    for (const auto& [region, counts] : counts_) {
      if (names.size() < most_regions) put(counts, region_name(mesh_, region));
      else std::ranges::transform(others, counts, others.begin(), std::plus<>());
    }
    if (counts_.size() > most_regions) put(others, "others");
    return {{"title", title}, {"unit", unit}, {"bins", std::move(bins)}, {"regions", names}};
  }

 private:
  static double rounded(double x) { return std::stod(significant(x, 5)); }

  const Indexed_mesh_3& mesh_;
  std::vector<double> limits_;
  std::map<std::int32_t, std::vector<std::size_t>> counts_;
};

std::vector<double> steps(double from, double to, std::size_t count) {
  std::vector<double> limits;
  for (std::size_t i = 0; i <= count; ++i) limits.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(count));
  return limits;
}

json histograms_of(const Indexed_mesh_3& mesh, const std::vector<Shape>& shapes, double ratio_bound) {
  const double unit = unit_of(mesh);
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  const auto for_each_edge = [&](const auto& f) {
    for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b) f(unit * std::sqrt(squared_distance(mesh.points[mesh.tetrahedra[i][a]], mesh.points[mesh.tetrahedra[i][b]])), region_of(mesh, i));
  };
  for_each_edge([&](double length, std::int32_t) {
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  });
  const bool is_wide = longest > 20 * shortest;  // then lengths are by powers
  std::vector<double> lengths = is_wide ? steps(std::log(shortest), std::log(longest), 40) : steps(0, longest, 40);
  if (is_wide) std::ranges::transform(lengths, lengths.begin(), [](double x) { return std::exp(x); });
  Histogram dihedral(mesh, steps(0, 75, 30)), ratio(mesh, steps(0.5, std::max(2.5, 1.25 * ratio_bound), 32)), length(mesh, std::move(lengths));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    dihedral.add(static_cast<double>(shapes[i].dihedral), region_of(mesh, i));
    ratio.add(static_cast<double>(shapes[i].ratio), region_of(mesh, i));
  }
  for_each_edge([&](double l, std::int32_t region) { length.add(l, region); });
  json all = {dihedral.to_json("smallest dihedral angle of each tetrahedron", "degrees"), ratio.to_json("radius-edge ratio", "circumradius over shortest edge"),
              length.to_json("edge lengths, each edge once for every tetrahedron that has it", "length")};
  if (ratio_bound > 0) all[1]["bound"] = ratio_bound;
  all[2]["log"] = is_wide;
  return all;
}

/// Coordinates in the picture: a unit cube around the origin holds it.
class Frame {
 public:
  explicit Frame(const Indexed_mesh_3& mesh) : mesh_(mesh) {
    std::array<double, 3> lower = mesh.points[0], upper = lower;
    for (const auto& p : mesh.points)
      for (std::size_t k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], p[k]);
        upper[k] = std::max(upper[k], p[k]);
      }
    for (std::size_t k = 0; k < 3; ++k) {
      center_[k] = lower[k] / 2 + upper[k] / 2;
      extent_ = std::max(extent_, upper[k] - lower[k]);
    }
  }
  std::array<float, 3> operator()(std::uint32_t v) const {
    std::array<float, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = static_cast<float>((mesh_.points[v][k] - center_[k]) / extent_);
    return p;
  }

 private:
  const Indexed_mesh_3& mesh_;
  std::array<double, 3> center_{};
  double extent_ = 0;
};

/// Every tetrahedron, or so many that hold together: those nearest to a plane through the middle, that a first look cuts open.
std::vector<std::uint32_t> drawn_of(const Indexed_mesh_3& mesh, const Frame& frame) {
  std::vector<std::uint32_t> drawn(mesh.tetrahedra.size());
  std::iota(drawn.begin(), drawn.end(), 0u);
  if (drawn.size() <= most_drawn) return drawn;
  std::vector<float> distance(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    float y = 0;
    for (const std::uint32_t v : mesh.tetrahedra[i]) y += frame(v)[1] / 4;
    distance[i] = y < 0 ? -8 * y : y;  // more of what is behind the plane, which is seen
  }
  std::ranges::nth_element(drawn, drawn.begin() + most_drawn, [&](std::uint32_t a, std::uint32_t b) { return std::pair(distance[a], a) < std::pair(distance[b], b); });
  drawn.resize(most_drawn);
  std::ranges::sort(drawn);
  return drawn;
}

json picture_of(const Indexed_mesh_3& mesh, const std::vector<Shape>& shapes, const Frame& frame) {
  const std::vector<std::uint32_t> drawn = drawn_of(mesh, frame);
  constexpr std::uint32_t none = 0xffffffffu;
  std::vector<std::uint32_t> number(mesh.points.size(), none), tetrahedra;
  std::vector<float> points;
  std::vector<std::uint8_t> angles, regions;
  std::map<std::int32_t, std::uint8_t> position;  // of a region among those of the histograms
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) position.try_emplace(region_of(mesh, i));
  std::size_t next = 0;
  for (auto& [region, at] : position) at = static_cast<std::uint8_t>(std::min(next++, most_regions));
  for (const std::uint32_t t : drawn) {
    for (const std::uint32_t v : mesh.tetrahedra[t]) {
      if (number[v] == none) {
        number[v] = static_cast<std::uint32_t>(points.size() / 3);
        for (const float x : frame(v)) points.push_back(x);
      }
      tetrahedra.push_back(number[v]);
    }
    regions.push_back(position.at(region_of(mesh, t)));
    angles.push_back(static_cast<std::uint8_t>(std::min(2 * shapes[t].dihedral, 255.0f)));  // in halves of a degree
  }
  const std::string note = drawn.size() < mesh.tetrahedra.size()
                               ? "The mesh has " + with_separators(mesh.tetrahedra.size()) + "; the picture has those around the middle in y."
                               : "Drag to turn, wheel to zoom.";
  return {{"points", base64(points)}, {"tetrahedra", base64(tetrahedra)}, {"angles", base64(angles)}, {"regions", base64(regions)}, {"note", note}};
}

json worst_of(const Indexed_mesh_3& mesh, const std::vector<Shape>& shapes, const Frame& frame) {
  std::vector<std::uint32_t> order(shapes.size());
  std::iota(order.begin(), order.end(), 0u);
  const std::size_t count = std::min(most_worst, order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count),
                            [&](std::uint32_t a, std::uint32_t b) { return std::pair(shapes[a].dihedral, a) < std::pair(shapes[b].dihedral, b); });
  json worst = json::array();
  const double unit = unit_of(mesh);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& t = mesh.tetrahedra[order[i]];
    std::array<double, 3> at{};
    json corners = json::array();
    for (const std::uint32_t v : t) {
      for (std::size_t k = 0; k < 3; ++k) at[k] += unit * mesh.points[v][k] / 4;
      corners.push_back(frame(v));
    }
    worst.push_back({{"number", order[i]},
                     {"dihedral", significant(static_cast<double>(shapes[order[i]].dihedral), 4)},
                     {"ratio", significant(static_cast<double>(shapes[order[i]].ratio), 4)},
                     {"region", region_name(mesh, region_of(mesh, order[i]))},
                     {"at", at},
                     {"corners", std::move(corners)}});
  }
  return worst;
}

json tasks_of(const Schedule_statistics& schedule) {
  std::vector<const Task_record*> records;
  for (const Task_record& r : schedule.records) records.push_back(&r);
  if (records.size() > most_tasks) {
    std::ranges::stable_sort(records, [](const Task_record* a, const Task_record* b) { return a->seconds > b->seconds; });
    records.resize(most_tasks);
  }
  json tasks = json::array();
  for (const Task_record* r : records)
    tasks.push_back({r->thread, r->start, r->start + r->seconds,
                     r->kind == Task_record::Kind::leaf ? "refining" : r->kind == Task_record::Kind::serial ? "alone" : "on all threads"});
  return tasks;
}

Rows output_rows(const Indexed_mesh_3& mesh, const Mesh_quality& q, const Report& report) {
  Rows rows{{"vertices", with_separators(q.vertices)}, {"tetrahedra", with_separators(q.tetrahedra)}, {"triangles on facets", with_separators(q.triangles)},
            {"edges on segments", with_separators(q.edges)}};
  for (const auto& [region, volume] : q.region_volumes)
    if (rows.size() < 4 + most_regions)
      rows.emplace_back(region_name(mesh, region), with_separators(q.region_tetrahedra.at(region)) + " tetrahedra, volume " + significant(volume, 6));
  rows.emplace_back("largest radius-edge ratio", significant(q.max_radius_edge_ratio, 4) + " (" + significant(q.mean_radius_edge_ratio, 3) + " on average)");
  rows.emplace_back("dihedral angles", significant(q.min_dihedral_deg, 4) + " to " + significant(q.max_dihedral_deg, 4) + " degrees");
  for (std::size_t i = 0; i < q.tetrahedra_below.size(); ++i)
    if (q.tetrahedra_below[i] > 0)
      rows.emplace_back("with one below " + significant(Mesh_quality::small_angles_deg[i], 2) + " degrees", with_separators(q.tetrahedra_below[i]));
  if (!report.run) return rows;
  rows.emplace_back("exempt, next to small angles", with_separators(report.run->exempt_tetrahedra));
  if (report.run->unrefined_tetrahedra > 0) rows.emplace_back("over a bound, since a limit stopped the run", with_separators(report.run->unrefined_tetrahedra));
  if (!report.run->stop_message.empty()) rows.emplace_back("stopped", report.run->stop_message);
  return rows;
}

json page_data(const Indexed_mesh_3& mesh, const Report& report) {
  const std::vector<Shape> shapes = shapes_of(mesh);
  const Frame frame(mesh);
  json data{{"title", report.title},
            {"subtitle", report.subtitle},
            {"output", output_rows(mesh, report.run ? report.run->quality : mesh_quality(mesh), report)},
            {"histograms", histograms_of(mesh, shapes, report.ratio_bound)},
            {"worst", worst_of(mesh, shapes, frame)},
            {"mesh", picture_of(mesh, shapes, frame)},
            {"footer", "Made by pgdr " PGDR_VERSION ". The notices of three.js, Observable Plot and what they are made of stand at the end of this file's script."}};
  if (!report.input.empty()) data["input"] = report.input;
  if (!report.run) return data;
  Rows phases;
  for (const auto& [phase, seconds] : report.run->seconds) phases.emplace_back(phase, significant(seconds, 3) + " s");
  phases.emplace_back("together", significant(report.run->total_seconds, 3) + " s on " + counted(report.run->threads, "thread", "threads") + ", " +
                                      memory_size(report.run->peak_memory_bytes) + " of memory");
  data["phases"] = phases;
  data["progress"] = json::array();
  if (report.progress)
    for (const auto& m : report.progress->moments()) data["progress"].push_back({m.seconds, m.vertices, m.phase});
  data["tasks"] = tasks_of(report.run->schedule);
  const std::size_t all = report.run->schedule.records.size();
  data["tasks_caption"] = "what each thread did while the mesh was refined" + (all > most_tasks ? ": the longest " + with_separators(most_tasks) + " of " + with_separators(all) + " tasks" : std::string());
  return data;
}

}  // namespace

void Progress_record::add(const Progress& now) {
  const std::lock_guard lock(mutex_);
  if (calls_++ % stride_ != 0 && !moments_.empty() && std::string_view(moments_.back().phase) == now.phase) return;
  moments_.push_back({std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(), now.vertices, now.phase});
  if (moments_.size() < most_moments) return;
  stride_ *= 2;
  for (std::size_t i = 0; 2 * i < moments_.size(); ++i) moments_[i] = moments_[2 * i];
  moments_.resize((moments_.size() + 1) / 2);
}

void require_page(const std::string& option) {
  if (page_script == nullptr) throw Usage_error(option + " is not there: this program was built without npm, which its page is made by");
}

void write_report(const Indexed_mesh_3& mesh, const Report& report, const std::filesystem::path& path) {
  std::string data = page_data(mesh, report).dump(-1, ' ', false, json::error_handler_t::replace);
  for (std::size_t at = 0; (at = data.find("</", at)) != std::string::npos; at += 3) data.replace(at, 2, "<\\/");  // ends no script
  Atomic_file file(path);
  file.write("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>pgdr</title>\n<style>\n");
  file.write(page_style);
  file.write("</style>\n</head>\n<body>\n<script type=\"application/json\" id=\"data\">");
  file.write(data);
  file.write("</script>\n<script>\n");
  file.write(page_script);
  file.write("</script>\n</body>\n</html>\n");
  file.commit();
}

}  // namespace pgdr::app
