// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/reproducible_functions.h>

#include "steps.h"

namespace pgdr::repair_detail {

namespace {

void turn(Triangle& t) { std::swap(t.corners[1], t.corners[2]); }

/// A number for each class, ascending with its first member.
std::vector<Index> numbered(boost::disjoint_sets_with_storage<>& sets, std::size_t size) {
  constexpr Index none = static_cast<Index>(-1);
  std::vector<Index> number(size, none), result(size);
  Index next = 0;
  for (std::size_t i = 0; i < size; ++i) {
    Index& n = number[sets.find_set(i)];
    if (n == none) n = next++;
    result[i] = n;
  }
  return result;
}

/// Shells: triangles of one part that hang together across edges.
std::vector<Index> shells(const Soup& soup) {
  boost::disjoint_sets_with_storage<> sets(soup.triangles.size());
  const Triangle_edges all(soup.triangles);
  all.for_each([&](std::size_t i, std::size_t j) {
    for (std::size_t k = i; k < j; ++k)
      for (std::size_t l = k + 1; l < j; ++l)
        if (soup.triangles[all.edges[k].triangle].part == soup.triangles[all.edges[l].triangle].part)
          sets.union_set(all.edges[k].triangle, all.edges[l].triangle);
  });
  return numbered(sets, soup.triangles.size());
}

/// The members of each class.
std::vector<std::vector<Index>> members(const std::vector<Index>& number) {
  std::vector<std::vector<Index>> result(number.empty() ? 0 : *std::ranges::max_element(number) + 1);
  for (Index i = 0; i < number.size(); ++i) result[number[i]].push_back(i);
  return result;
}

}  // namespace

double area(const Soup& soup, const Triangle& t) {
  const Vec_3& a = soup.points[t.corners[0]];
  return length(cross(soup.points[t.corners[1]] - a, soup.points[t.corners[2]] - a)) / 2;
}

double signed_volume(const Soup& soup, const Triangle& t, const Vec_3& origin) {
  return dot(soup.points[t.corners[0]] - origin, cross(soup.points[t.corners[1]] - origin, soup.points[t.corners[2]] - origin)) / 6;
}

double winding_number(const std::vector<Vec_3>& points, const std::vector<Corners>& triangles, const Vec_3& at) {
  double sum = 0;  // of solid angles (Van Oosterom, Strackee 1983), halved
  for (const Corners& t : triangles) {
    const Vec_3 a = points[t[0]] - at, b = points[t[1]] - at, c = points[t[2]] - at;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += arc_tangent(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

void orient_shells(Soup& soup, Repair_report& report) {
  // Across edges that two triangles of a part share, and no third one; in breadth first order, relative to the first of each patch.
  const Triangle_edges all(soup.triangles);
  std::vector<std::vector<std::pair<Index, bool>>> neighbors(soup.triangles.size());  // and whether they are oriented alike
  all.for_each([&](std::size_t i, std::size_t j) {
    for (std::size_t k = i; k < j; ++k)
      for (std::size_t l = k + 1; l < j; ++l) {
        const auto &e = all.edges[k], &f = all.edges[l];
        const auto in_part = [&](const auto& g) { return soup.triangles[g.triangle].part == soup.triangles[e.triangle].part; };
        if (!in_part(f) || std::count_if(all.edges.begin() + static_cast<std::ptrdiff_t>(i), all.edges.begin() + static_cast<std::ptrdiff_t>(j), in_part) != 2)
          continue;
        neighbors[e.triangle].emplace_back(f.triangle, e.runs_forward != f.runs_forward);
        neighbors[f.triangle].emplace_back(e.triangle, e.runs_forward != f.runs_forward);
      }
  });
  enum : char { unseen, as_it_is, turned };
  std::vector<char> state(soup.triangles.size(), unseen);
  std::vector<Index> patch;
  for (Index first = 0; first < soup.triangles.size(); ++first) {
    if (state[first] != unseen) continue;
    patch = {first};
    state[first] = as_it_is;
    for (std::size_t next = 0; next < patch.size(); ++next)
      for (const auto& [t, is_alike] : neighbors[patch[next]]) {
        if (state[t] != unseen) continue;  // a patch with one side only is cut somewhere
        state[t] = is_alike == (state[patch[next]] == as_it_is) ? as_it_is : turned;
        patch.push_back(t);
      }
    double balance = 0;
    for (const Index t : patch) balance += state[t] == as_it_is ? area(soup, soup.triangles[t]) : -area(soup, soup.triangles[t]);
    for (const Index t : patch)
      if ((state[t] == turned) == (balance >= 0)) {
        turn(soup.triangles[t]);
        ++report.turned_triangles;
      }
  }
}

std::vector<Index> orient_groups(Soup& soup, const std::vector<std::pair<Index, Index>>& pairs, Repair_report& report) {
  const std::vector<Index> shell = shells(soup);
  const std::vector<std::vector<Index>> of_shell = members(shell);
  boost::disjoint_sets_with_storage<> joined(of_shell.size());
  const auto join = [&](Index s, Index t) {
    if (soup.triangles[s].part == soup.triangles[t].part) joined.union_set(shell[s], shell[t]);
  };
  for (const auto& [s, t] : pairs) join(s, t);
  std::vector<std::pair<std::pair<Index, Index>, Index>> at_vertex;  // part and vertex, triangle
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (const Index v : soup.triangles[t].corners) at_vertex.push_back({{soup.triangles[t].part, v}, t});
  std::ranges::sort(at_vertex);
  for (std::size_t i = 1; i < at_vertex.size(); ++i)
    if (at_vertex[i].first == at_vertex[i - 1].first) join(at_vertex[i].second, at_vertex[i - 1].second);
  const std::vector<Index> group_of_shell = numbered(joined, of_shell.size());

  // A shell whose inside is outside of all others of its group should face outwards; one that lies within them may be a void.
  for (const std::vector<Index>& own_shells : members(group_of_shell))
    for (const Index s : own_shells) {
      const Vec_3 origin = soup.points[soup.triangles[of_shell[s][0]].corners[0]];
      double volume = 0;
      for (const Index t : of_shell[s]) volume += signed_volume(soup, soup.triangles[t], origin);
      if (volume >= 0) continue;
      std::vector<Corners> others;
      for (const Index o : own_shells)
        if (o != s)
          for (const Index t : of_shell[o]) others.push_back(soup.triangles[t].corners);
      constexpr std::size_t most_samples = 32;
      const std::size_t stride = 1 + of_shell[s].size() / most_samples;
      bool is_within = !others.empty();
      for (std::size_t i = 0; i < of_shell[s].size() && is_within; i += stride) {
        const Corners& c = soup.triangles[of_shell[s][i]].corners;
        const Vec_3 middle = (1.0 / 3) * (soup.points[c[0]] + soup.points[c[1]] + soup.points[c[2]]);
        is_within = std::abs(winding_number(soup.points, others, middle)) > 0.5;
      }
      if (is_within) continue;
      for (const Index t : of_shell[s]) turn(soup.triangles[t]);
      report.turned_triangles += of_shell[s].size();
    }

  std::vector<Index> group(soup.triangles.size());
  for (Index t = 0; t < group.size(); ++t) group[t] = group_of_shell[shell[t]];
  return group;
}

}  // namespace pgdr::repair_detail
