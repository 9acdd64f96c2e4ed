// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/repair/repair.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/free_numbers.h>
#include <pgdr/domain/scale.h>
#include <pgdr/repair/degenerate_facets.h>

#include "steps.h"

namespace pgdr {

namespace {

using namespace repair_detail;

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", x);
  return buffer;
}

std::string place(const Vec_3& at, double unit) { return std::string("(") + text(unit * at.x) + ", " + text(unit * at.y) + ", " + text(unit * at.z) + ")"; }

/// Holes that are wider than may be filled, of groups most of which bounds nothing. Where most of it does, what hangs on it was spare.
std::vector<Input_problem> open_groups(const Soup& soup, const std::vector<Index>& group, const std::vector<double>& kept,
                                       const std::vector<Hole>& holes, const Repair_options& options, double unit) {
  std::vector<Input_problem> problems;
  for (const Hole& hole : holes) {
    if (kept[group[hole.triangle]] > 0.5) continue;
    const Triangle& t = soup.triangles[hole.triangle];
    problems.push_back({Input_problem::Kind::open_surface,
                        "the rim of " + std::to_string(hole.rim.size()) + " edges through " + place(soup.points[hole.rim.front()], unit) + " is " +
                            text(unit * hole.diameter) + " wide, and holes are filled up to " + text(options.largest_hole),
                        {t.facet}});
  }
  return problems;
}

/// Groups without holes that enclose something, most of which has one volume on both sides all the same: it leaks where edges belong to three triangles or more.
std::vector<Input_problem> leaking_groups(const Soup& soup, const std::vector<Index>& group, const Solids& solids, const std::vector<Hole>& holes, double tolerance, double unit) {
  std::vector<double> volume(solids.hanging.size(), 0), surface = volume;
  std::vector<Index> first(volume.size());  // triangle
  for (Index t = static_cast<Index>(group.size()); t-- > 0;) {
    volume[group[t]] += signed_volume(soup, soup.triangles[t], soup.points[0]);
    surface[group[t]] += area(soup, soup.triangles[t]);
    first[group[t]] = t;
  }
  std::vector<Input_problem> problems;
  for (std::size_t g = 0; g < volume.size(); ++g) {
    if (solids.hanging[g] <= 0.5 || std::abs(volume[g]) <= tolerance * surface[g]) continue;
    if (std::ranges::any_of(holes, [&](const Hole& hole) { return group[hole.triangle] == g; })) continue;
    const Triangle& t = soup.triangles[first[g]];
    problems.push_back({Input_problem::Kind::open_surface,
                        "the surface through " + place(soup.points[t.corners[0]], unit) + " has no hole, but leaks where edges belong to three triangles or more",
                        {t.facet}});
  }
  return problems;
}

void require_some(const auto& triangles) {
  if (triangles.empty()) throw Input_error(Input_problem::Kind::open_surface, "the triangles enclose nothing");
}

/// Of the tolerance. What it bends is bent by as much, and planes are sought within the tolerance: with all of it, a printer's bed of 3,270 facets that can be made plane
/// has 1,736.
constexpr double part_for_wedges = 0.1;

/// Of the surface of solids; `enclosed(surface, report)`: what a changed one encloses. What is bent meets others, sometimes at angles as small, so that there
/// are wedges again: as long as they become fewer.
template <class F>
void close_all_wedges(Solids& result, double tolerance, F enclosed, Repair_report& report) {
  for (std::size_t most = std::numeric_limits<std::size_t>::max();;) {
    Soup surface = result.surface;
    Repair_report now;
    const std::size_t wedges = close_wedges(surface, part_for_wedges * tolerance, now.largest_move);
    if (wedges == 0 || wedges >= most) return;
    most = wedges;
    try {
      result = enclosed(surface, now);
      report.inner_triangles += now.inner_triangles;
      report.largest_move = std::max(report.largest_move, now.largest_move);
    } catch (const Input_error&) {
      return;  // small angles are better than intersections
    }
  }
}

Plc repaired(std::span<const Plc> parts, const Repair_options& options, Repair_report& report) {
  Soup soup;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Plc part = parts[p];
    report.degenerate_triangles += take_degenerate_facets_away(part);  // what they closed would be open without
    add_to_soup(soup, part, static_cast<Index>(p), report);
  }
  const double unit = unit_of(parts[0]);
  const double tolerance = options.tolerance / unit;
  remove_degenerate(soup, report);
  close_cracks(soup, tolerance, report);
  orient_shells(soup, report);
  const std::vector<Hole> holes = fill_holes(soup, options.largest_hole / unit, report);
  require_some(soup.triangles);
  if (parts.size() > 1)
    for (Triangle& t : soup.triangles)
      if (t.marker == 0) t.marker = static_cast<int>(t.part) + 1;
  const auto pairs = meeting_pairs(soup);
  report.intersecting_pairs = pairs.size();
  if (report.is_none() && holes.empty() && parts.size() == 1) return parts[0];
  const std::vector<Index> group = orient_groups(soup, pairs, report);
  Plc plc;
  if (pairs.empty() && holes.empty() && parts.size() == 1) {
    plc = as_plc(soup);
  } else {
    Solids result = solids(arrangement(soup, pairs, tolerance, report), soup, group, parts.size(), tolerance, report);
    const auto enclosed = [&](const Soup& surface, Repair_report& r) {
      return solids(arrangement(surface, meeting_pairs(surface), tolerance, r), soup, group, parts.size(), tolerance, r);
    };
    close_all_wedges(result, tolerance, enclosed, report);
    if (auto problems = open_groups(soup, group, result.kept, holes, options, unit); !problems.empty()) throw Input_error(std::move(problems));
    if (auto problems = leaking_groups(soup, group, result, holes, tolerance, unit); !problems.empty()) throw Input_error(std::move(problems));
    plc = std::move(result.plc);
  }
  require_some(plc.facets);
  report.largest_move *= unit;
  plc.exponent = parts[0].exponent;
  return plc;
}

/// Gives facets without a marker that of their part. Those whose marker stands for a name of their part's, or is somebody else's number too, get numbers
/// that nobody else has, and names. Returns what all are called.
Reference_names mark_parts(std::vector<Plc>& parts) {
  const int count = static_cast<int>(parts.size());
  const auto markers_of = [](const Plc& part) {
    std::set<int> markers;
    for (const auto& facet : part.facets) markers.insert(facet.marker);
    markers.erase(0);
    return markers;
  };
  std::map<int, std::size_t> users;  // of numbers that mean something to the user
  for (const Plc& part : parts)
    for (const int m : markers_of(part))
      if (!part.names.markers.contains(m)) ++users[m];
  Reference_names names;
  Free_numbers numbers(users, count + 1);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Plc& part = parts[p];
    const int own = static_cast<int>(p) + 1;
    if (!part.name.empty()) names.markers[own] = names.regions[own] = part.name;
    std::map<int, int> marker{{0, own}};
    for (const int m : markers_of(part)) {
      const auto named = part.names.markers.find(m);
      const bool is_named = named != part.names.markers.end();
      if (!is_named && users[m] == 1 && (m < 1 || m > count)) continue;
      const int number = marker[m] = numbers.next();
      const std::string name = is_named ? named->second : std::to_string(m);
      names.markers[number] = part.name.empty() ? name : part.name + ":" + name;
    }
    for (auto& facet : part.facets)
      if (const auto found = marker.find(facet.marker); found != marker.end()) facet.marker = found->second;
  }
  return names;
}

/// What is inside a part is told by its surface alone: a part with volumes of its own would lose some of them.
void require_surface(const Plc& part) {
  bool is_divided = !part.regions.empty() || !part.holes.empty();
  if (part.nesting == Nesting::fill && !is_divided) {
    std::map<Index_pair, int> sides;
    for (const auto& facet : part.facets)
      for (const auto& polygon : facet.polygons)
        for (std::size_t i = 0; i < polygon.size() && polygon.size() > 2; ++i)
          is_divided |= ++sides[sorted_pair(polygon[i], polygon[(i + 1) % polygon.size()])] > 2;
  }
  if (is_divided)
    throw Input_error(Input_problem::Kind::open_surface, "'" + part.name + "' has regions, holes or facets inside, and the parts of an assembly are closed surfaces: make it the only input");
}

}  // namespace

Plc repair(const Plc& plc, const Repair_options& options, Repair_report* report) {
  if (exponent_for(plc) != 0) return repair(normalized(plc), options, report);
  Repair_report ignored;
  Repair_report& done = report ? *report : ignored;
  done = {};
  Plc result = repaired({&plc, 1}, options, done);
  if (done.is_none()) return result;
  result.nesting = plc.nesting;
  result.holes = plc.holes;
  result.regions = plc.regions;
  result.name = plc.name;
  result.names = plc.names;
  return result;
}

Plc assemble(std::span<const Plc> parts, const Repair_options& options, Repair_report* report) {
  Repair_report ignored;
  Repair_report& done = report ? *report : ignored;
  done = {};
  if (parts.empty()) throw Input_error(Input_problem::Kind::empty, "an assembly of no parts");
  std::vector<Plc> marked;
  for (const Plc& part : parts) {
    require_surface(part);
    marked.push_back(normalized(part));
    if (marked.back().exponent != marked.front().exponent) throw Input_error(Input_problem::Kind::bad_coordinate, "the parts of the assembly are too different in size");
  }
  const Reference_names names = mark_parts(marked);
  Plc result = repaired(marked, options, done);
  result.names = names;
  return result;
}

}  // namespace pgdr
