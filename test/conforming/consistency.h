// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a constraint complex agrees with itself and with the triangulation that carries its marks.
#ifndef PGDR_TEST_CONFORMING_CONSISTENCY_H
#define PGDR_TEST_CONFORMING_CONSISTENCY_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/mesh_cell_base_3.h>

namespace pgdr_test {

/// Looks a complex over; the answers are empty where all is well, else a sentence about the first fault.
template <class Tr>
class Complex_audit {
 public:
  using Complex = pgdr::Constraint_complex_3<Tr>;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Cell_handle = typename Tr::Cell_handle;

  Complex_audit(const Tr& tr, const Complex& complex) : tr_(tr), complex_(complex) {}

  /// Links between subfacets and subsegments, orientations, and the area of every facet.
  std::string sheets() const {
    std::vector<double> area(complex_.domain().facets.size(), 0);
    for (std::uint32_t t = 0; t < complex_.subfacet_slots(); ++t) {
      if (!complex_.subfacet(t).alive()) continue;
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::string fault = edge_of_subfacet(t, i); !fault.empty()) return fault;
      const auto& s = complex_.subfacet(t);
      if (complex_.orientation(s.facet, s.vertices[0]->point(), s.vertices[1]->point(),
                               s.vertices[2]->point()) != CGAL::POSITIVE)
        return name("subfacet", t) + " is not counterclockwise";
      area[s.facet] +=
          triangle_area(position(s.vertices[0]), position(s.vertices[1]), position(s.vertices[2]));
    }
    for (std::uint32_t s = 0; s < complex_.subsegment_slots(); ++s)
      if (complex_.subsegment(s).alive())
        if (const std::string fault = links_of_subsegment(s); !fault.empty()) return fault;
    return areas(area);
  }

  /// Marks: what is present is marked on all its cells, and what is marked is present.
  std::string marks() const {
    for (std::uint32_t s = 0; s < complex_.subsegment_slots(); ++s)
      if (complex_.subsegment(s).alive() && complex_.subsegment(s).present && !is_marked_subsegment(s))
        return name("subsegment", s) + " is present but not marked on all cells around it";
    for (std::uint32_t t = 0; t < complex_.subfacet_slots(); ++t)
      if (complex_.subfacet(t).alive() && complex_.subfacet(t).present && !is_marked_subfacet(t))
        return name("subfacet", t) + " is present but not marked on both of its cells";
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c)
      if (const std::string fault = marks_of_cell(c); !fault.empty()) return fault;
    return {};
  }

  /// Pieces that the triangulation lacks.
  std::size_t missing() const {
    std::size_t n = 0;
    for (std::uint32_t s = 0; s < complex_.subsegment_slots(); ++s)
      n += complex_.subsegment(s).alive() && !complex_.subsegment(s).present;
    for (std::uint32_t t = 0; t < complex_.subfacet_slots(); ++t)
      n += complex_.subfacet(t).alive() && !complex_.subfacet(t).present;
    return n;
  }

 private:
  static pgdr::Vec_3 position(Vertex_handle v) { return pgdr::to_vec(v->point()); }
  static double triangle_area(const pgdr::Vec_3& a, const pgdr::Vec_3& b, const pgdr::Vec_3& c) {
    return 0.5 * pgdr::length(pgdr::cross(b - a, c - a));
  }
  static std::string name(const char* what, std::uint32_t slot) {
    return std::string(what).append(" ").append(std::to_string(slot));
  }

  std::string edge_of_subfacet(std::uint32_t t, std::size_t i) const {
    const auto& s = complex_.subfacet(t);
    const std::uint32_t n = s.neighbors[i];
    const Vertex_handle u = s.vertices[(i + 1) % 3], w = s.vertices[(i + 2) % 3];
    if (n == Complex::none) return name("subfacet", t) + " has an open edge";
    if (n & Complex::subsegment_bit) {
      const std::uint32_t slot = n & ~Complex::subsegment_bit;
      if (slot >= complex_.subsegment_slots() || !complex_.subsegment(slot).alive())
        return name("subfacet", t) + " borders on a dead subsegment";
      const auto& e = complex_.subsegment(slot);
      if (!(e.vertices[0] == u && e.vertices[1] == w) && !(e.vertices[0] == w && e.vertices[1] == u))
        return name("subfacet", t) + " borders on a subsegment with other ends";
      if (std::count(e.subfacets.begin(), e.subfacets.end(), t) != 1)
        return name("subfacet", t) + " is not once in the list of its subsegment";
      return {};
    }
    if (n >= complex_.subfacet_slots() || !complex_.subfacet(n).alive())
      return name("subfacet", t) + " borders on a dead subfacet";
    const auto& o = complex_.subfacet(n);
    if (o.facet != s.facet) return name("subfacet", t) + " borders on a subfacet of another facet";
    for (std::size_t j = 0; j < 3; ++j)
      if (o.neighbors[j] == t && o.vertices[(j + 1) % 3] == w && o.vertices[(j + 2) % 3] == u) return {};
    return name("subfacet", t) + " is not the neighbour of its neighbour " + std::to_string(n);
  }

  std::string links_of_subsegment(std::uint32_t s) const {
    const auto& e = complex_.subsegment(s);
    const auto& segment = complex_.domain().segments[e.segment];
    if (complex_.find_subsegment(e.vertices[0], e.vertices[1]) != s ||
        complex_.find_subsegment(e.vertices[1], e.vertices[0]) != s)
      return name("subsegment", s) + " is not found from its ends";
    for (const Vertex_handle v : e.vertices)
      if (!complex_.is_on_segment(v, e.segment)) return name("subsegment", s) + " ends off its segment";
    std::set<pgdr::Index> facets;
    for (const std::uint32_t t : e.subfacets) {
      if (!complex_.subfacet(t).alive()) return name("subsegment", s) + " lists a dead subfacet";
      if (complex_.edge_with_neighbor(t, s | Complex::subsegment_bit) < 0)
        return name("subsegment", s) + " lists a subfacet that does not border on it";
      facets.insert(complex_.subfacet(t).facet);
    }
    if (!std::equal(facets.begin(), facets.end(), segment.facets.begin(), segment.facets.end()))
      return name("subsegment", s) + " lists other facets than its segment";
    return {};
  }

  std::string areas(const std::vector<double>& area) const {
    const auto& domain = complex_.domain();
    for (std::size_t f = 0; f < area.size(); ++f) {
      double expected = 0;
      for (const auto& t : domain.facets[f].triangles)
        expected += triangle_area(pgdr::to_vec(domain.vertices[t[0]]), pgdr::to_vec(domain.vertices[t[1]]),
                                  pgdr::to_vec(domain.vertices[t[2]]));
      if (std::abs(area[f] - expected) > 1e-6 * expected)
        return "facet " + std::to_string(f) + " has area " + std::to_string(area[f]) + " instead of " +
               std::to_string(expected);
    }
    return {};
  }

  bool is_marked_subsegment(std::uint32_t s) const {
    const auto& e = complex_.subsegment(s);
    Cell_handle c;
    int i, j;
    if (!tr_.is_edge(e.vertices[0], e.vertices[1], c, i, j)) return false;
    auto around = tr_.incident_cells(c, i, j);
    const auto done = around;
    do {
      const Cell_handle d = around;
      const auto bit = pgdr::edge_bit(d->index(e.vertices[0]), d->index(e.vertices[1]));
      if (!(d->subsegment_edges() & bit)) return false;
    } while (++around != done);
    return true;
  }

  bool is_marked_subfacet(std::uint32_t t) const {
    const auto& s = complex_.subfacet(t);
    Cell_handle c;
    int i, j, k;
    if (!tr_.is_facet(s.vertices[0], s.vertices[1], s.vertices[2], c, i, j, k)) return false;
    const int m = 6 - i - j - k;
    const Cell_handle n = c->neighbor(m);
    return c->subfacet(m) == t && n->subfacet(n->index(c)) == t;
  }

  std::string marks_of_cell(Cell_handle c) const {
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t t = c->subfacet(i);
      if (t == Complex::none) continue;
      if (t >= complex_.subfacet_slots() || !complex_.subfacet(t).alive() || !complex_.subfacet(t).present)
        return "a cell is marked with the dead or missing " + name("subfacet", t);
      for (const Vertex_handle v : complex_.subfacet(t).vertices)
        if (!c->has_vertex(v) || c->index(v) == i)
          return "a cell is marked with the wrong " + name("subfacet", t);
    }
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (!(c->subsegment_edges() & pgdr::edge_bit(i, j))) continue;
        const std::uint32_t s = tr_.is_infinite(c->vertex(i)) || tr_.is_infinite(c->vertex(j))
                                    ? Complex::none
                                    : complex_.find_subsegment(c->vertex(i), c->vertex(j));
        if (s == Complex::none || !complex_.subsegment(s).alive() || !complex_.subsegment(s).present)
          return "a cell has an edge marked as subsegment that is none";
      }
    return {};
  }

  const Tr& tr_;
  const Complex& complex_;
};

/// The first fault in the complex of a mesh, or an empty string. Nothing may be missing unless `partial`.
template <class Tr>
std::string inconsistency(const Tr& tr, const pgdr::Constraint_complex_3<Tr>& complex, bool partial = false) {
  const Complex_audit<Tr> audit(tr, complex);
  if (std::string fault = audit.sheets(); !fault.empty()) return fault;
  if (std::string fault = audit.marks(); !fault.empty()) return fault;
  if (!partial && audit.missing() > 0) return std::to_string(audit.missing()) + " pieces are missing";
  return {};
}

}  // namespace pgdr_test

#endif
