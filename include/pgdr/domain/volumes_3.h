// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_VOLUMES_3_H
#define PGDR_DOMAIN_VOLUMES_3_H

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/facet_sides.h>
#include <pgdr/domain/detail/triangle_soup.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/reproducible_functions.h>

namespace pgdr {

/// A connected part of space between the facets of a domain.
struct Volume {
  bool outside = false;     ///< the unbounded one
  double volume = 0;        ///< 0 for the outside
  int depth = 0;            ///< least number of facets between it and the outside
  bool is_hole = false;     ///< a hole seed lies in it
  bool has_region = false;  ///< a region seed lies in it
  bool material = false;    ///< to be meshed
  int region_id = 0;        ///< of its region seed, else a number of its own; 0 where there is no material
  double max_volume = 0;    ///< of its region seed; not positive: no bound
  double max_circumradius = 0;  ///< the same
  Index first_vertex = std::numeric_limits<Index>::max();  ///< smallest vertex on its boundary
};

/// The volumes that the facets of a domain enclose, found from the facets alone, without any tetrahedra.
///
/// Facet sides that face each other at a segment belong to one volume; rays join the shells that float inside
/// it.
/// \pre the facets meet only in common vertices and segments (see `validate_domain_3`); otherwise
///   the answer means nothing, but there is one.
template <class K>
class Volumes_3 {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  explicit Volumes_3(const Domain_3<K>& domain) : soup_(domain), rays_(soup_), diagonal_(domain.diagonal) {
    const domain_detail::Facet_shells shells(domain, soup_);
    middle_ = 0.5 * (to_vec(domain.lower) + to_vec(domain.upper));
    collect(shells);
    measure_depth();
    apply_seeds(domain);
  }

  /// The outside first, then by the smallest vertex on the boundary.
  const std::vector<Volume>& volumes() const { return volumes_; }

  /// Index of the volume that holds `p`; `none` when it lies on a facet.
  std::size_t locate(const typename K::Point_3& p) const { return find(p).volume; }

  /// Where a point is.
  struct Location {
    std::size_t volume = none;  ///< `none` on a facet
    std::size_t facet = none;   ///< that it lies on, if it does
  };
  Location find(const typename K::Point_3& p) const {
    using Outcome = domain_detail::Ray_caster::Outcome;
    const Vec_3 source = to_vec(p);
    for (std::size_t attempt = 0; attempt < 64; ++attempt) {
      const Vec_3 target =
          source + (diagonal_ > 0 ? diagonal_ : 1) * domain_detail::scattered_direction(attempt);
      const auto ray = rays_.cast(domain_detail::to_work_point(source), domain_detail::to_work_point(target));
      if (ray.outcome == Outcome::starts_on_triangle) return {none, soup_.facet[ray.hits[0].triangle]};
      if (ray.outcome == Outcome::degenerate) continue;
      if (ray.hits.empty()) return {0, none};
      return {volume_of_side(ray.hits[0].triangle, ray.hits[0].from_front), none};
    }
    return {};
  }

  /// The volume in front of (where the normal points to) or behind a triangle of a facet.
  /// \param position in `Domain_3::Facet::triangles`.
  std::size_t beside(Index facet, std::size_t position, bool front) const {
    return volume_of_side(soup_.offset[facet] + position, front);
  }

  /// A point well inside a volume: midway between two facets on some line, or nothing if none was found.
  std::optional<Vec_3> interior_point(std::size_t volume) const {
    using namespace domain_detail;
    std::optional<Vec_3> best;
    double longest = 0;
    std::size_t tried = 0;
    for (std::size_t t = 0; t < soup_.triangles.size() && tried < 16; ++t) {
      if ((volume_of_side(t, true) == volume) == (volume_of_side(t, false) == volume)) continue;
      const Vec_3 source = middle_ + 4 * diagonal_ * scattered_direction(tried++);
      const Vec_3 target = soup_.centroid(t);
      const auto ray = rays_.cast(to_work_point(source), to_work_point(target));
      if (ray.outcome != Ray_caster::Outcome::proper) continue;
      for (std::size_t i = 0; i + 1 < ray.hits.size(); ++i) {
        if (volume_of_side(ray.hits[i].triangle, !ray.hits[i].from_front) != volume) continue;
        const Vec_3 a = soup_.crossing(source, target, ray.hits[i].triangle);
        const Vec_3 b = soup_.crossing(source, target, ray.hits[i + 1].triangle);
        const Vec_3 point = 0.5 * (a + b);
        const double chord = length(b - a);  // not a number, or infinite, beside triangles that are flat but for rounding
        if (!(chord > longest) || !std::isfinite(chord) || locate({point.x, point.y, point.z}) != volume) continue;
        longest = chord;
        best = point;
      }
    }
    return best;
  }

  /// Whether anything is enclosed at all.
  bool closed() const { return volumes_.size() > 1; }

  double total_material_volume() const {
    double total = 0;
    for (const Volume& v : volumes_)
      if (v.material) total += v.volume;
    return total;
  }

  /// A seed that names no volume: outside, or on a facet.
  struct Lost_seed {
    std::size_t seed;   ///< position in `Domain_3::holes` or `Domain_3::regions`
    std::size_t facet;  ///< that it lies on; `none`: it is outside
  };
  const std::vector<Lost_seed>& lost_holes() const { return lost_holes_; }
  const std::vector<Lost_seed>& lost_regions() const { return lost_regions_; }

  /// A region seed in a volume that another one gives another id, or a hole seed leaves empty.
  struct Overruled_seed {
    std::size_t seed;  ///< position in `Domain_3::regions`
    std::size_t by;    ///< position of the other one, in `Domain_3::holes` if `by_hole`
    bool by_hole;
  };
  const std::vector<Overruled_seed>& overruled_regions() const { return overruled_regions_; }

 private:
  std::size_t volume_of_side(std::size_t triangle, bool front) const {
    return side_volume_[front ? domain_detail::front_side(triangle) : domain_detail::back_side(triangle)];
  }

  /// Joins shells into volumes: consecutive triangles on a ray face the same volume.
  void collect(const domain_detail::Facet_shells& shells) {
    using namespace domain_detail;
    const std::size_t outside = shells.size();
    boost::disjoint_sets_with_storage<> joined(shells.size() + 1);
    std::vector<std::vector<std::size_t>> samples(shells.size());
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t)
      for (std::size_t side : {front_side(t), back_side(t)})
        if (auto& sample = samples[shells.shell(side)]; sample.size() < 16) sample.push_back(t);
    for (std::size_t s = 0; s < shells.size(); ++s) {
      if (shells.encloses(s)) continue;
      bool placed = false;
      for (std::size_t attempt = 0; attempt < 64 && !placed; ++attempt) {
        const std::size_t t = samples[s][attempt % samples[s].size()];
        const Vec_3 target = soup_.centroid(t);
        const Vec_3 source = middle_ + 4 * diagonal_ * scattered_direction(attempt);
        const auto ray = rays_.cast(to_work_point(source), to_work_point(target));
        if (ray.outcome != Ray_caster::Outcome::proper) continue;
        if (std::none_of(ray.hits.begin(), ray.hits.end(), [&](const auto& h) { return h.triangle == t; }))
          continue;
        std::size_t current = outside;
        for (const auto& hit : ray.hits) {
          const std::size_t front = shells.shell(front_side(hit.triangle)),
                            back = shells.shell(back_side(hit.triangle));
          joined.union_set(current, hit.from_front ? front : back);
          current = hit.from_front ? back : front;
        }
        joined.union_set(current, outside);
        placed = true;
      }
      if (!placed) joined.union_set(s, outside);
    }
    number_volumes(shells, joined, outside);
  }

  void number_volumes(const domain_detail::Facet_shells& shells, boost::disjoint_sets_with_storage<>& joined,
                      std::size_t outside) {
    // Volumes may have their smallest vertex in common, but no side of a facet.
    struct Place {
      Index vertex = std::numeric_limits<Index>::max();
      std::size_t side = std::numeric_limits<std::size_t>::max();
      auto operator<=>(const Place&) const = default;
    };
    std::vector<Place> first(shells.size() + 1);
    for (std::size_t side = 0; side < 2 * soup_.triangles.size(); ++side) {
      Place& place = first[joined.find_set(shells.shell(side))];
      const auto& triangle = soup_.triangles[side / 2];
      place.vertex = std::min(place.vertex, *std::ranges::min_element(triangle));
      place.side = std::min(place.side, 2 * std::size_t{soup_.facet[side / 2]} + side % 2);
    }
    std::vector<double> volume(shells.size() + 1, 0);
    std::vector<char> listed(shells.size() + 1, 0);
    std::vector<std::size_t> roots;
    for (std::size_t s = 0; s < shells.size(); ++s) {
      const std::size_t root = joined.find_set(s);
      if (!listed[root]) roots.push_back(root);
      listed[root] = 1;
      volume[root] += shells.volume(s);
    }
    const std::size_t outside_root = joined.find_set(outside);
    std::erase(roots, outside_root);
    std::stable_sort(roots.begin(), roots.end(),
                     [&](std::size_t a, std::size_t b) { return first[a] < first[b]; });
    roots.insert(roots.begin(), outside_root);
    std::vector<std::size_t> number(shells.size() + 1, 0);
    for (std::size_t i = 0; i < roots.size(); ++i) {
      number[roots[i]] = i;
      Volume v;
      v.outside = i == 0;
      v.volume = v.outside ? 0 : volume[roots[i]];
      v.first_vertex = first[roots[i]].vertex;
      volumes_.push_back(v);
    }
    side_volume_.resize(2 * soup_.triangles.size());
    for (std::size_t side = 0; side < side_volume_.size(); ++side)
      side_volume_[side] = static_cast<Index>(number[joined.find_set(shells.shell(side))]);
  }

  void measure_depth() {
    std::set<std::pair<std::size_t, std::size_t>> neighbors;
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      const std::size_t a = volume_of_side(t, true), b = volume_of_side(t, false);
      if (a == b) continue;
      neighbors.insert({a, b});
      neighbors.insert({b, a});
    }
    std::vector<char> reached(volumes_.size(), 0);
    std::vector<std::size_t> queue{0};
    reached[0] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (auto n = neighbors.lower_bound({queue[next], 0}); n != neighbors.end() && n->first == queue[next];
           ++n) {
        if (reached[n->second]) continue;
        reached[n->second] = 1;
        volumes_[n->second].depth = volumes_[queue[next]].depth + 1;
        queue.push_back(n->second);
      }
  }

  void apply_seeds(const Domain_3<K>& domain) {
    std::set<int> taken;
    std::map<std::size_t, std::size_t> hole_of, region_of;  // of a volume, the first one
    for (std::size_t i = 0; i < domain.holes.size(); ++i) {
      const auto [v, facet] = find(domain.holes[i]);
      if (v == none || v == 0) {
        lost_holes_.push_back({i, facet});
      } else {
        volumes_[v].is_hole = true;
        hole_of.try_emplace(v, i);
      }
    }
    for (std::size_t i = 0; i < domain.regions.size(); ++i) {
      const auto& region = domain.regions[i];
      taken.insert(region.id);
      const auto [v, facet] = find(region.point);
      if (v == none || v == 0) {
        lost_regions_.push_back({i, facet});
        continue;
      }
      if (const auto hole = hole_of.find(v); hole != hole_of.end())
        overruled_regions_.push_back({i, hole->second, true});
      else if (volumes_[v].has_region && volumes_[v].region_id != region.id)
        overruled_regions_.push_back({i, region_of[v], false});
      if (!volumes_[v].has_region) {  // the first seed of a volume counts
        region_of[v] = i;
        volumes_[v].has_region = true;
        volumes_[v].region_id = region.id;
        volumes_[v].max_volume = region.max_volume;
        volumes_[v].max_circumradius = region.max_circumradius;
      }
    }
    int next_id = 1;
    for (Volume& v : volumes_) {
      v.material =
          !v.outside && !v.is_hole && (v.has_region || domain.nesting == Nesting::fill || v.depth % 2 == 1);
      if (!v.material) v.region_id = 0;
      if (!v.material || v.has_region) continue;
      while (taken.count(next_id) != 0) ++next_id;
      v.region_id = next_id++;
    }
  }

  domain_detail::Triangle_soup soup_;
  domain_detail::Ray_caster rays_;
  double diagonal_;
  Vec_3 middle_;
  std::vector<Volume> volumes_;
  std::vector<Index> side_volume_;
  std::vector<Lost_seed> lost_holes_;
  std::vector<Lost_seed> lost_regions_;
  std::vector<Overruled_seed> overruled_regions_;
};

/// The volumes of a domain, with the material among them decided by seeds and nesting.
template <class K>
Volumes_3<K> volumes_3(const Domain_3<K>& domain) {
  return Volumes_3<K>(domain);
}

/// A power of two, at most the circumradius of the regular tetrahedron with a volume, which has more than all others in its circumsphere.
inline double circumradius_for(double volume) { return floor_cube_root(9 * std::sqrt(3.0) / 8 * volume); }

/// For each vertex of the domain the largest circumradius that the bounds of the volumes around it allow, or infinity.
template <class K>
std::vector<double> region_sizes_at_vertices(const Volumes_3<K>& volumes, const Domain_3<K>& domain, bool ignore_max_volume) {
  const auto size_of = [ignore_max_volume](const Volume& v) {
    double size = v.max_circumradius > 0 ? v.max_circumradius : std::numeric_limits<double>::infinity();
    if (v.max_volume > 0 && !ignore_max_volume) size = std::min(size, circumradius_for(v.max_volume));
    return size;
  };
  std::vector<double> sizes(domain.vertices.size(), std::numeric_limits<double>::infinity());
  for (Index f = 0; f < domain.facets.size(); ++f)
    for (std::size_t t = 0; t < domain.facets[f].triangles.size(); ++t)
      for (const bool front : {false, true}) {
        const double size = size_of(volumes.volumes()[volumes.beside(f, t, front)]);
        for (const Index v : domain.facets[f].triangles[t]) sizes[v] = std::min(sizes[v], size);
      }
  return sizes;
}

// Compiled in the library.
extern template class Volumes_3<Default_kernel>;
}  // namespace pgdr

#endif
