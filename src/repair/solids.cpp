// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <CGAL/Bbox_3.h>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/volumes_3.h>

#include "steps.h"

namespace pgdr::repair_detail {

namespace {

constexpr std::size_t nobody = static_cast<std::size_t>(-1);

/// A triangle between two owners.
struct Kept {
  Triangle triangle;
  std::size_t front, back;
};

/// What one group of triangles encloses.
struct Body {
  Index part = 0;
  std::vector<Corners> triangles;
  CGAL::Bbox_3 box;

  bool contains(const std::vector<Vec_3>& points, const Vec_3& p) const {
    if (p.x < box.xmin() || p.x > box.xmax() || p.y < box.ymin() || p.y > box.ymax() || p.z < box.zmin() || p.z > box.zmax()) return false;
    return winding_number(points, triangles, p) > 0.5;
  }
};

std::vector<Body> bodies(const Soup& soup, const std::vector<Index>& group) {
  std::vector<Body> result(group.empty() ? 0 : *std::ranges::max_element(group) + 1);
  for (Index t = 0; t < group.size(); ++t) {
    Body& body = result[group[t]];
    body.part = soup.triangles[t].part;
    body.triangles.push_back(soup.triangles[t].corners);
    for (const Index v : soup.triangles[t].corners) body.box += domain_detail::to_work_point(soup.points[v]).bbox();
  }
  return result;
}

/// With no two of them fused: sheets that part by no more than rounding would be taken for one plane, and what is between them for a part of it.
Domain_3<Default_kernel> domain_of_triangles(Plc plc) {
  for (auto& facet : plc.facets) facet.group = fused_with_none;
  return make_domain_3(plc, 0.0, true);
}

/// How thick each volume is between its facets, on average; the first volume is what is outside.
std::vector<double> thicknesses(const Soup& arranged, const Domain_3<Default_kernel>& domain, const Volumes_3<Default_kernel>& volumes) {
  const std::size_t n = volumes.volumes().size();
  std::vector<double> volume(n, 0), surface(n, 0), result;
  const Vec_3 origin = arranged.points[arranged.triangles[0].corners[0]];
  for (Index f = 0; f < domain.facets.size(); ++f)
    for (const bool is_front : {true, false}) {
      const std::size_t v = volumes.beside(f, 0, is_front);
      for (const Index t : domain.facets[f].input_facets) {
        const double part = signed_volume(arranged, arranged.triangles[t], origin);
        volume[v] += is_front ? part : -part;
        surface[v] += area(arranged, arranged.triangles[t]);
      }
    }
  for (std::size_t v = 0; v < n; ++v) result.push_back(2 * std::abs(volume[v]) / surface[v]);
  return result;
}

/// Of groups of triangles, how large they are.
class Group_areas {
 public:
  Group_areas(const Soup& soup, const std::vector<Index>& group) : all_(group.empty() ? 0 : *std::ranges::max_element(group) + 1, 0) {
    for (Index t = 0; t < group.size(); ++t) {
      group_of_[{soup.triangles[t].part, soup.triangles[t].facet}] = group[t];
      all_[group[t]] += area(soup, soup.triangles[t]);
    }
  }

  /// How much of each group's area some pieces of it have, whose corners are points of `arranged`.
  std::vector<double> shares(const Soup& arranged, const std::vector<Triangle>& pieces) const {
    std::vector<double> result(all_.size(), 0);
    for (const Triangle& t : pieces) result[group_of_.at({t.part, t.facet})] += area(arranged, t);
    for (std::size_t g = 0; g < all_.size(); ++g) result[g] /= all_[g];
    return result;
  }

 private:
  std::map<std::pair<Index, Index>, Index> group_of_;  ///< of a part's facet
  std::vector<double> all_;
};

/// For voids that are enclosed, and for whose each volume is. \param plc the triangles of `boundary`
void add_seeds(Plc& plc, const std::vector<Kept>& boundary) {
  const Domain_3<Default_kernel> domain = domain_of_triangles(plc);
  const Volumes_3<Default_kernel> volumes(domain);
  std::vector<std::size_t> owner(volumes.volumes().size(), nobody);
  for (Index f = 0; f < domain.facets.size(); ++f) {
    const Kept& k = boundary[domain.facets[f].input_facets[0]];
    owner[volumes.beside(f, 0, true)] = k.front;
    owner[volumes.beside(f, 0, false)] = k.back;
  }
  plc.nesting = Nesting::fill;
  for (std::size_t v = 1; v < owner.size(); ++v) {
    const auto p = volumes.interior_point(v);
    if (!p) continue;
    if (owner[v] == nobody)
      plc.holes.emplace_back(p->x, p->y, p->z);
    else
      plc.regions.push_back({.point = {p->x, p->y, p->z}, .id = static_cast<int>(owner[v]) + 1});
  }
}

}  // namespace

Plc as_plc(const Soup& soup) {
  Plc plc;
  std::vector<Index> number(soup.points.size(), static_cast<Index>(-1));
  for (const Triangle& t : soup.triangles) {
    std::vector<Index> polygon;
    for (const Index v : t.corners) {
      if (number[v] == static_cast<Index>(-1)) {
        number[v] = static_cast<Index>(plc.vertices.size());
        plc.vertices.emplace_back(soup.points[v].x, soup.points[v].y, soup.points[v].z);
      }
      polygon.push_back(number[v]);
    }
    Plc_facet<Default_kernel>& facet = plc.facets.emplace_back();
    facet.polygons = {polygon};
    facet.marker = t.marker;
  }
  return plc;
}

Solids solids(const Soup& arranged, const Soup& soup, const std::vector<Index>& group, std::size_t parts, double tolerance, Repair_report& report) {
  const Group_areas areas(soup, group);
  if (arranged.triangles.empty()) return {arranged, {}, areas.shares(arranged, {}), areas.shares(arranged, {})};
  const std::vector<Body> all = bodies(soup, group);
  const auto owner_at = [&](const Vec_3& p) {
    std::vector<std::size_t> layers(parts, 0);
    for (const Body& body : all) layers[body.part] += body.contains(soup.points, p);
    std::size_t owner = nobody, claims = 0;
    for (std::size_t part = 0; part < parts; ++part)
      if (layers[part] % 2 == 1) {
        owner = part;
        ++claims;
      }
    report.overlaps += claims > 1;
    return owner;
  };

  const Domain_3<Default_kernel> domain = domain_of_triangles(as_plc(arranged));
  const Volumes_3<Default_kernel> volumes(domain);
  std::vector<std::optional<std::size_t>> owner(volumes.volumes().size());
  owner[0] = nobody;
  const std::vector<double> thickness = thicknesses(arranged, domain, volumes);
  for (std::size_t v = 1; v < owner.size(); ++v)
    if (thickness[v] > tolerance)
      if (const auto p = volumes.interior_point(v)) owner[v] = owner_at(*p);
  // What is thinner than the tolerance, or has no room for a point, has the owner of a neighbor.
  for (bool some = true; some;) {
    some = false;
    for (Index f = 0; f < domain.facets.size(); ++f) {
      const std::size_t front = volumes.beside(f, 0, true), back = volumes.beside(f, 0, false);
      if (owner[front].has_value() == owner[back].has_value()) continue;
      (owner[front] ? owner[back] : owner[front]) = owner[front] ? owner[front] : owner[back];
      some = true;
    }
  }

  std::vector<Kept> boundary;
  std::vector<Triangle> hanging;
  for (Index f = 0; f < domain.facets.size(); ++f) {
    const std::size_t before = volumes.beside(f, 0, true), behind = volumes.beside(f, 0, false);
    const auto front = owner[before], back = owner[behind];
    for (const Index t : domain.facets[f].input_facets) {
      if (front == back) {
        ++report.inner_triangles;
        if (before == behind) hanging.push_back(arranged.triangles[t]);
        continue;
      }
      Kept& k = boundary.emplace_back(Kept{arranged.triangles[t], *front, *back});
      k.triangle.times = 1;
      if (back == nobody) {
        std::swap(k.triangle.corners[1], k.triangle.corners[2]);
        std::swap(k.front, k.back);
      }
    }
  }
  std::ranges::sort(boundary, {}, [](const Kept& k) { return std::pair{k.triangle.part, k.triangle.facet}; });
  Soup kept{arranged.points, {}};
  for (const Kept& k : boundary) kept.triangles.push_back(k.triangle);
  Solids result{kept, as_plc(kept), areas.shares(arranged, kept.triangles), areas.shares(arranged, hanging)};
  if (parts > 1) add_seeds(result.plc, boundary);
  return result;
}

}  // namespace pgdr::repair_detail
