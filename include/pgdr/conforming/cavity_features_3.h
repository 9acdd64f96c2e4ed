// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_CAVITY_FEATURES_3_H
#define PGDR_CONFORMING_CAVITY_FEATURES_3_H

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/facet_star_3.h>
#include <pgdr/mesh/cavity_3.h>

namespace pgdr {

/// The subsegments and subfacets on the cells of a cavity, and which of them the insertion would delete.
///
/// A feature with p in its diametral or equatorial ball always shows up here: one of the cells on it is in
/// conflict with p.
template <class Tr>
class Cavity_features_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;

  struct Feature {
    std::uint32_t slot;
    bool deleted;
  };

  /// In the order in which the cavity's cells show them.
  const std::vector<Feature>& subsegments() const { return subsegments_; }
  const std::vector<Feature>& subfacets() const { return subfacets_; }

  /// Whether the insertion would delete any of them.
  bool deletes_any() const {
    const auto is_deleted = [](const Feature& f) { return f.deleted; };
    return std::ranges::any_of(subsegments_, is_deleted) || std::ranges::any_of(subfacets_, is_deleted);
  }

  void gather(Complex& complex, const Cavity_3<Tr>& cavity) {
    subsegments_.clear();
    subfacets_.clear();
    for (const Cell_handle c : cavity.cells()) {
      if (c->has_subfacet()) gather_subfacets(complex, c);
      if (c->subsegment_edges()) gather_subsegments(complex, c);
    }
    if (!subsegments_.empty()) spare_boundary_edges(complex, cavity);
    for (const Feature& f : subsegments_) complex.subsegment(f.slot).scratch = 0;
    mark_deleted(complex, false);
  }

  /// Marks the subfacets that the cavity deletes, for `Facet_star_3`, or takes the marks back.
  void mark_deleted(Complex& complex, bool on) const {
    for (const Feature& f : subfacets_)
      complex.subfacet(f.slot).scratch = on && f.deleted ? Facet_star_3<Tr>::deleted_bit : std::uint8_t{0};
  }

 private:
  void gather_subfacets(Complex& complex, Cell_handle c) {
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t t = c->subfacet(i);
      if (t == Complex::none) continue;
      const bool deleted = Cavity_3<Tr>::contains(c->neighbor(i));
      // A deleted one shows from both sides; note it once.
      if (deleted && complex.subfacet(t).scratch) continue;
      if (deleted) complex.subfacet(t).scratch = Facet_star_3<Tr>::deleted_bit;
      subfacets_.push_back({t, deleted});
    }
  }

  void gather_subsegments(Complex& complex, Cell_handle c) {
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (!(c->subsegment_edges() & edge_bit(i, j))) continue;
        const std::uint32_t s = complex.find_subsegment(c->vertex(i), c->vertex(j));
        if (s == Complex::none || complex.subsegment(s).scratch) continue;
        complex.subsegment(s).scratch = 1;
        subsegments_.push_back({s, true});
      }
  }

  void spare_boundary_edges(Complex& complex, const Cavity_3<Tr>& cavity) {
    for (const auto& f : cavity.boundary()) {
      const std::uint8_t edges = f.first->subsegment_edges() & static_cast<std::uint8_t>(~edges_at(f.second));
      if (!edges) continue;
      for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
          if (edges & edge_bit(i, j)) {
            const std::uint32_t s = complex.find_subsegment(f.first->vertex(i), f.first->vertex(j));
            if (s != Complex::none) complex.subsegment(s).scratch = 2;
          }
    }
    for (Feature& f : subsegments_) f.deleted = complex.subsegment(f.slot).scratch == 1;
  }

  std::vector<Feature> subsegments_;
  std::vector<Feature> subfacets_;
};

}  // namespace pgdr

#endif
