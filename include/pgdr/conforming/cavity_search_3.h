// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_CAVITY_SEARCH_3_H
#define PGDR_CONFORMING_CAVITY_SEARCH_3_H

#include <cstdint>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/presence_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/conflict_walk_3.h>
#include <pgdr/mesh/vertex_star_3.h>
#include <pgdr/mesh/zone_reach_3.h>

namespace pgdr {

/// What became of the search for a cavity.
enum class Search_result : std::uint8_t {
  found,    ///< the cavity is marked
  nothing,  ///< nothing is in conflict with the point, which is rounding; or the way to it leaves the zone
  foreign   ///< the cavity, or the way to it, is not within the territory
};

/// Finds the cavities of points on features, within the territory of the cavity's object.
template <class Tr>
class Cavity_search_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Point = typename Tr::Point;

  Cavity_search_3(const Tr& tr, const Complex& complex, Cavity_3<Tr>& cavity) : tr_(tr), complex_(complex), cavity_(cavity) {}

  Search_result from_cell(const Point& p, Cell_handle c) {
    if (has_vertex_at(tr_, c, p)) return Search_result::nothing;
    if (cavity_.find(p, c)) return Search_result::found;
    return cavity_.is_foreign() ? Search_result::foreign : Search_result::nothing;
  }

  /// What the task of a leaf may look at; everything to begin with.
  const Zone_reach_3<Tr>& zone() const { return zone_; }
  /// \param near the leaf grown by ell*/4
  void set_zone(const Region_3& near) { zone_ = {near, tr_.infinite_vertex()}; }

  /// From an own vertex that is not far from p.
  Search_result from_vertex(const Point& p, Vertex_handle v) {
    if (!zone_.is_everything()) {
      const Cell_handle c = zone_.is_near(v) ? walk_to_conflict(tr_, zone_, v, p) : Cell_handle();
      return c == Cell_handle() ? Search_result::nothing : from_cell(p, c);
    }
    // CGAL's walk is the faster one, but nobody can tell it where to stop.
    if (territory().is_everything()) return from_cell(p, tr_.locate(p, v->cell()));
    const Cell_handle c = walk_to_conflict(tr_, territory(), v, p);
    return c == Cell_handle() ? Search_result::foreign : from_cell(p, c);
  }

  /// For a point of the subsegment, which is own.
  Search_result from_subsegment(const Point& p, const typename Complex::Subsegment& s) {
    const Cell_handle c = s.present ? star_.find_edge(s.vertices[0], s.vertices[1]) : Cell_handle();
    return c != Cell_handle() ? from_cell(p, c) : from_vertex(p, s.vertices[0]);
  }

  /// For a point in the facet; `at` holds the point, `from` is the own subfacet that is being split.
  Search_result from_subfacet(const Point& p, std::uint32_t at, std::uint32_t from) {
    for (const std::uint32_t slot : {at, from}) {
      const auto& t = complex_.subfacet(slot);
      if (!territory().owns(t.vertices)) return Search_result::foreign;
      const Cell_handle c = t.present ? star_.find_facet(t.vertices[0], t.vertices[1], t.vertices[2]) : Cell_handle();
      if (c == Cell_handle()) continue;
      for (const Cell_handle side : {c, c->neighbor(index_of_fourth<Tr>(c, t.vertices))})
        if (const Search_result r = from_cell(p, side); r != Search_result::nothing) return r;
    }
    return from_vertex(p, complex_.subfacet(at).vertices[0]);
  }

  Vertex_star_3<Tr>& star() { return star_; }

 private:
  const Territory_3<Tr>& territory() const { return cavity_.territory(); }

  const Tr& tr_;
  const Complex& complex_;
  Cavity_3<Tr>& cavity_;
  Vertex_star_3<Tr> star_;
  Zone_reach_3<Tr> zone_;
};

}  // namespace pgdr

#endif
