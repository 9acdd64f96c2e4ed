// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_FACET_SIDES_H
#define PGDR_DOMAIN_DETAIL_FACET_SIDES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/detail/triangle_soup.h>

namespace pgdr::domain_detail {

/// Side 2t of triangle t is where its normal points to, 2t + 1 the other one.
inline std::size_t front_side(std::size_t triangle) { return 2 * triangle; }
inline std::size_t back_side(std::size_t triangle) { return 2 * triangle + 1; }

/// Groups the sides of all facet triangles into shells: what one could walk over without crossing a facet.
///
/// A shell is a connected piece of the boundary of one volume. Its signed volume is positive where it
/// encloses the volume that it faces, and not positive where that volume surrounds it.
class Facet_shells {
 public:
  template <class K>
  Facet_shells(const Domain_3<K>& domain, const Triangle_soup& soup) {
    boost::disjoint_sets_with_storage<> sides(2 * soup.triangles.size());
    join_within_facets(domain, soup, sides);
    join_around_segments(domain, soup, sides);
    number_shells(sides, 2 * soup.triangles.size());
    add_volumes(soup);
  }

  std::size_t size() const { return volume_.size(); }
  Index shell(std::size_t side) const { return shell_[side]; }
  double volume(std::size_t shell) const { return volume_[shell]; }
  bool encloses(std::size_t shell) const { return encloses_[shell]; }

 private:
  using Sets = boost::disjoint_sets_with_storage<>;

  template <class K>
  static void join_within_facets(const Domain_3<K>& domain, const Triangle_soup& soup, Sets& sides) {
    std::vector<std::pair<std::array<Index, 2>, std::size_t>> edges;
    std::vector<std::array<Index, 2>> segments;
    for (std::size_t f = 0; f < domain.facets.size(); ++f) {
      if (soup.offset[f + 1] - soup.offset[f] < 2) continue;
      edges.clear();
      segments.clear();
      for (Index s : domain.facets[f].segments) segments.push_back(domain.segments[s].vertices);
      std::sort(segments.begin(), segments.end());
      for (std::size_t t = soup.offset[f]; t < soup.offset[f + 1]; ++t)
        for (std::size_t i = 0; i < 3; ++i) {
          const auto [a, b] = std::minmax(soup.triangles[t][i], soup.triangles[t][(i + 1) % 3]);
          edges.push_back({{a, b}, t});
        }
      std::sort(edges.begin(), edges.end());
      for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (edges[i].first != edges[i + 1].first) continue;
        if (std::binary_search(segments.begin(), segments.end(), edges[i].first)) continue;
        sides.union_set(front_side(edges[i].second), front_side(edges[i + 1].second));
        sides.union_set(back_side(edges[i].second), back_side(edges[i + 1].second));
      }
    }
  }

  /// Around a segment, each sheet faces the next one.
  template <class K>
  static void join_around_segments(const Domain_3<K>& domain, const Triangle_soup& soup, Sets& sides) {
    const Facet_edges edges(domain);
    std::vector<Sheet> sheets;
    for (std::size_t s = 0; s < domain.segments.size(); ++s) {
      sheets.assign(edges.sheets(s).begin(), edges.sheets(s).end());
      if (sheets.size() > 2) sort_around(domain.segments[s].vertices, soup, sheets);
      for (std::size_t i = 0; i < sheets.size(); ++i) {
        const Sheet& here = sheets[i];
        const Sheet& next = sheets[i + 1 < sheets.size() ? i + 1 : 0];
        const std::size_t t = soup.offset[here.facet] + here.triangle;
        const std::size_t u = soup.offset[next.facet] + next.triangle;
        // Counterclockwise about the segment, a sheet that runs forward faces along its normal.
        sides.union_set(here.forward ? front_side(t) : back_side(t),
                        next.forward ? back_side(u) : front_side(u));
      }
    }
  }

  /// Counterclockwise about the segment from its first vertex to its second, by exact predicates.
  static void sort_around(const std::array<Index, 2>& segment, const Triangle_soup& soup,
                          std::vector<Sheet>& sheets) {
    const Work_point a = soup.point(segment[0]), b = soup.point(segment[1]);
    struct Entry {
      int sector;
      Work_point apex;
      Sheet sheet;
    };
    std::vector<Entry> entries;
    for (const Sheet& s : sheets) {
      const auto& t = soup.triangles[soup.offset[s.facet] + s.triangle];
      Index apex = t[0];
      for (Index v : t)
        if (v != segment[0] && v != segment[1]) apex = v;
      entries.push_back({0, soup.point(apex), s});
    }
    const Work_point reference = entries.front().apex;
    for (Entry& e : entries) {
      const CGAL::Orientation side = CGAL::orientation(a, b, reference, e.apex);
      if (side == CGAL::POSITIVE) e.sector = 1;
      if (side == CGAL::NEGATIVE) e.sector = 3;
      if (side == CGAL::COPLANAR)
        e.sector = CGAL::coplanar_orientation(a, b, reference, e.apex) == CGAL::POSITIVE ? 0 : 2;
    }
    std::stable_sort(entries.begin(), entries.end(), [&](const Entry& x, const Entry& y) {
      if (x.sector != y.sector) return x.sector < y.sector;
      return x.sector % 2 == 1 && CGAL::orientation(a, b, x.apex, y.apex) == CGAL::POSITIVE;
    });
    for (std::size_t i = 0; i < sheets.size(); ++i) sheets[i] = entries[i].sheet;
  }

  void number_shells(Sets& sides, std::size_t count) {
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> number(count, none);
    shell_.resize(count);
    Index next = 0;
    for (std::size_t side = 0; side < count; ++side) {
      Index& n = number[sides.find_set(side)];
      if (n == none) n = next++;
      shell_[side] = n;
    }
    volume_.assign(next, 0);
    encloses_.assign(next, 0);
  }

  void add_volumes(const Triangle_soup& soup) {
    if (soup.points.empty()) return;
    // Relative to a point in the middle, so that little cancels.
    Vec_3 lower = soup.points[0], upper = soup.points[0];
    for (const Vec_3& p : soup.points)
      for (int k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], p[k]);
        upper[k] = std::max(upper[k], p[k]);
      }
    const Vec_3 middle = 0.5 * (lower + upper);
    std::vector<double> magnitude(size(), 0), lost(size(), 0);
    const auto add = [&](Index shell, double x) {
      // Neumaier's compensated sum.
      const double total = volume_[shell] + x;
      lost[shell] += std::abs(volume_[shell]) >= std::abs(x) ? (volume_[shell] - total) + x
                                                             : (x - total) + volume_[shell];
      volume_[shell] = total;
      magnitude[shell] += std::abs(x);
    };
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const auto& v = soup.triangles[t];
      const double sixth =
          dot(soup.points[v[0]] - middle, cross(soup.points[v[1]] - middle, soup.points[v[2]] - middle)) / 6;
      if (shell_[front_side(t)] == shell_[back_side(t)]) continue;
      add(shell_[back_side(t)], sixth);  // the normal points out of what lies behind
      add(shell_[front_side(t)], -sixth);
    }
    for (std::size_t s = 0; s < size(); ++s) {
      volume_[s] += lost[s];
      encloses_[s] = std::abs(volume_[s]) > 1e-9 * magnitude[s] ? volume_[s] > 0 : exact_sign(soup, s) > 0;
    }
  }

  int exact_sign(const Triangle_soup& soup, std::size_t shell) const {
    using Rational = CGAL::Exact_rational;
    const auto exact = [&](Index v) {
      const Vec_3& p = soup.points[v];
      return std::array<Rational, 3>{Rational(p.x), Rational(p.y), Rational(p.z)};
    };
    Rational total = 0;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const bool front = shell_[front_side(t)] == shell, back = shell_[back_side(t)] == shell;
      if (front == back) continue;
      const auto a = exact(soup.triangles[t][0]), b = exact(soup.triangles[t][1]),
                 c = exact(soup.triangles[t][2]);
      const Rational sixfold = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                               a[2] * (b[0] * c[1] - b[1] * c[0]);
      if (back) total += sixfold;
      if (front) total -= sixfold;
    }
    return static_cast<int>(CGAL::sign(total));
  }

  std::vector<Index> shell_;    ///< per side
  std::vector<double> volume_;  ///< signed, per shell
  std::vector<char> encloses_;  ///< whether it is positive, per shell
};

}  // namespace pgdr::domain_detail

#endif
