// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SUBDOMAINS_3_H
#define PGDR_CONFORMING_SUBDOMAINS_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/feature_refiner_3.h>
#include <pgdr/domain/volumes_3.h>

namespace pgdr {

/// One meshed part of the domain, or what is not meshed (entry 0).
struct Subdomain {
  int id = 0;             ///< reference in the output
  double max_volume = 0;  ///< of a tetrahedron; not positive: no bound
  double max_circumradius = 0;  ///< the same
};

/// Labels every cell with its subdomain, by flooding the triangulation up to subfacets. \pre none is missing.
///
/// Returns the table that the cells' `subdomain()` points into; entry 0 is the outside and the holes. Volumes
/// without a seed get the smallest positive ids that no seed uses, ordered by their smallest domain vertex.
template <class Tr>
class Subdomain_labeler_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Complex = Constraint_complex_3<Tr>;

  Subdomain_labeler_3(Tr& tr, Complex& complex) : tr_(tr), complex_(complex) {}

  std::vector<Subdomain> label(bool ignore_region_sizes) {
    flood_all();
    measure_depths();
    decide(ignore_region_sizes);
    set_labels();
    return table_;
  }

  /// The same where pieces are missing: only the volumes that no missing subfacet bounds are meshed, since through a gap one would flow
  /// into the next, or out. `left_out` becomes the number of the others that should have been.
  std::vector<Subdomain> label_closed(const Volumes_3<typename Tr::Geom_traits>& exact, bool ignore_region_sizes, std::size_t& left_out) {
    const Facet_sides sides(complex_, exact);
    left_out = 0;
    table_.assign(1, Subdomain{});
    std::vector<std::int32_t> label(exact.volumes().size(), 0);
    for (std::size_t v = 0; v < label.size(); ++v) {
      const Volume& volume = exact.volumes()[v];
      if (!volume.material) continue;
      left_out += sides.open[v];
      if (sides.open[v]) continue;
      label[v] = static_cast<std::int32_t>(table_.size());
      table_.push_back({volume.region_id, ignore_region_sizes ? 0 : volume.max_volume, volume.max_circumradius});
    }
    // A flooded part with a side of a closed volume is that volume.
    flood_all();
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c)
      for (int i = 0; i < 4; ++i) {
        if (c->subfacet(i) == Complex::none) continue;
        const std::size_t v = sides.volume[complex_.subfacet(c->subfacet(i)).facet][complex_.is_in_front(c, i)];
        if (label[v] > 0) parts_[static_cast<std::size_t>(c->subdomain())].label = label[v];
      }
    set_labels();
    return table_;
  }

  /// Labels cells that were made while a facet was torn, from their neighbours, and empties the list.
  void mend(std::vector<typename Feature_refiner_3<Tr>::Cell_id>& cells) {
    std::erase_if(cells, [](const auto& id) { return !id.is_live(); });
    std::deque<Cell_handle> front;
    std::vector<std::int32_t> old;
    for (const auto& id : cells) {
      old.push_back(id.cell->subdomain());
      id.cell->set_subdomain(unlabelled);
    }
    for (const auto& id : cells)
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = id.cell->neighbor(i);
        if (id.cell->subfacet(i) == Complex::none && n->subdomain() != unlabelled) front.push_back(n);
      }
    while (!front.empty()) {
      const Cell_handle c = front.front();
      front.pop_front();
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = c->neighbor(i);
        if (n->subdomain() != unlabelled || c->subfacet(i) != Complex::none) continue;
        n->set_subdomain(c->subdomain());
        front.push_back(n);
      }
    }
    // What subfacets enclose altogether takes after what was there before, on the same side of the same facet.
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (cells[k].cell->subdomain() != unlabelled) continue;
      std::int32_t label = Complex::unknown_side;
      const std::vector<Cell_handle> part = collect(cells[k].cell);
      for (const Cell_handle c : part)
        for (int i = 0; i < 4 && label < 0; ++i)
          if (c->subfacet(i) != Complex::none)
            label = complex_.side(complex_.subfacet(c->subfacet(i)).facet, complex_.is_in_front(c, i));
      for (const Cell_handle c : part) c->set_subdomain(label < 0 ? old[k] : label);
    }
    cells.clear();
  }

 private:
  void set_labels() {
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c) {
      c->set_subdomain(parts_[static_cast<std::size_t>(c->subdomain())].label);
      for (int i = 0; i < 4; ++i)
        if (c->subfacet(i) != Complex::none)
          complex_.note_side(complex_.subfacet(c->subfacet(i)).facet, complex_.is_in_front(c, i), c->subdomain());
    }
  }

  static constexpr std::int32_t unlabelled = std::numeric_limits<std::int32_t>::min(), visited = unlabelled + 1;

  /// The unlabelled cells around one that can be reached without crossing a subfacet.
  static std::vector<Cell_handle> collect(Cell_handle seed) {
    std::vector<Cell_handle> part{seed};
    seed->set_subdomain(visited);
    for (std::size_t k = 0; k < part.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = part[k]->neighbor(i);
        if (n->subdomain() != unlabelled || part[k]->subfacet(i) != Complex::none) continue;
        n->set_subdomain(visited);
        part.push_back(n);
      }
    return part;
  }

  /// Which volumes lie behind and in front of the facets, and which of them have gaps: a subfacet is missing, or a facet has several
  /// volumes on one side, so that nobody knows which of them one of its subfacets bounds.
  struct Facet_sides {
    std::vector<std::array<std::size_t, 2>> volume;  ///< by facet; behind, in front
    std::vector<char> open;                          ///< by volume

    Facet_sides(const Complex& complex, const Volumes_3<typename Tr::Geom_traits>& exact) : open(exact.volumes().size(), 0) {
      std::vector<char> is_missing(complex.domain().facets.size(), 0);
      for (std::uint32_t t = 0; t < complex.subfacet_slots(); ++t)
        if (const auto& s = complex.subfacet(t); s.alive() && !s.present) is_missing[s.facet] = 1;
      for (Index f = 0; f < is_missing.size(); ++f) {
        volume.push_back({exact.beside(f, 0, false), exact.beside(f, 0, true)});
        for (const bool front : {false, true}) {
          bool is_open = is_missing[f];
          const std::size_t n = complex.domain().facets[f].triangles.size();
          for (std::size_t k = 0; k < n; ++k) is_open |= exact.beside(f, k, front) != volume[f][front];
          for (std::size_t k = 0; k < n && is_open; ++k) open[exact.beside(f, k, front)] = 1;
        }
      }
    }
  };

  struct Part {
    int depth = -1;                ///< facets between it and the outside
    Index first_vertex = std::numeric_limits<Index>::max();
    std::uint64_t first_side = std::numeric_limits<std::uint64_t>::max();  ///< twice the facet's number, and 1 for its back
    bool hole = false;
    std::int32_t region = -1;      ///< seed that names it
    std::int32_t label = 0;
    std::vector<std::int32_t> neighbors;
  };

  void flood_all() {
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c) c->set_subdomain(unlabelled);
    flood(tr_.infinite_cell());
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c)
      if (c->subdomain() == unlabelled) flood(c);
  }

  void flood(Cell_handle seed) {
    const auto v = static_cast<std::int32_t>(parts_.size());
    parts_.emplace_back();
    std::vector<Cell_handle> stack{seed};
    seed->set_subdomain(v);
    while (!stack.empty()) {
      const Cell_handle c = stack.back();
      stack.pop_back();
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = c->neighbor(i);
        if (c->subfacet(i) == Complex::none) {
          if (n->subdomain() != unlabelled) continue;
          n->set_subdomain(v);
          stack.push_back(n);
        } else {
          for (int j = 0; j < 4; ++j)
            if (j != i && c->vertex(j)->in_dimension() == 0)
              parts_.back().first_vertex = std::min(parts_.back().first_vertex, c->vertex(j)->index());
          const std::uint64_t facet = complex_.subfacet(c->subfacet(i)).facet;
          parts_.back().first_side = std::min(parts_.back().first_side, 2 * facet + !complex_.is_in_front(c, i));
        }
      }
    }
  }

  void measure_depths() {
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c)
      for (int i = 0; i < 4; ++i)
        if (c->subfacet(i) != Complex::none && c->neighbor(i)->subdomain() != c->subdomain())
          parts_[static_cast<std::size_t>(c->subdomain())].neighbors.push_back(c->neighbor(i)->subdomain());
    std::deque<std::size_t> front{0};
    parts_[0].depth = 0;
    while (!front.empty()) {
      const std::size_t v = front.front();
      front.pop_front();
      for (const std::int32_t n : parts_[v].neighbors) {
        Part& w = parts_[static_cast<std::size_t>(n)];
        if (w.depth >= 0) continue;
        w.depth = parts_[v].depth + 1;
        front.push_back(static_cast<std::size_t>(n));
      }
    }
  }

  Part& part_of(const typename Tr::Point& p) {
    return parts_[static_cast<std::size_t>(tr_.locate(p)->subdomain())];
  }

  void decide(bool ignore_region_sizes) {
    const auto& domain = complex_.domain();
    for (const auto& h : domain.holes) part_of(h).hole = true;
    for (std::size_t r = 0; r < domain.regions.size(); ++r) {
      Part& v = part_of(domain.regions[r].point);
      if (v.region < 0) v.region = static_cast<std::int32_t>(r);
    }
    table_.assign(1, Subdomain{});
    std::vector<Part*> unnamed;
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      Part& v = parts_[i];
      if (v.hole) continue;
      if (v.region >= 0) {
        const auto& r = domain.regions[static_cast<std::size_t>(v.region)];
        v.label = static_cast<std::int32_t>(table_.size());
        table_.push_back({r.id, ignore_region_sizes ? 0 : r.max_volume, r.max_circumradius});
      } else if (domain.nesting == Nesting::fill || v.depth % 2 == 1) {
        unnamed.push_back(&v);
      }
    }
    // The order of `Volumes_3`, which numbers them from the facets alone.
    std::ranges::sort(unnamed, {}, [](const Part* v) { return std::pair(v->first_vertex, v->first_side); });
    int next = 1;
    for (Part* v : unnamed) {
      while (std::any_of(domain.regions.begin(), domain.regions.end(), [&](const auto& r) { return r.id == next; }))
        ++next;
      v->label = static_cast<std::int32_t>(table_.size());
      table_.push_back({next++});
    }
  }

  Tr& tr_;
  Complex& complex_;
  std::vector<Part> parts_;
  std::vector<Subdomain> table_;
};

}  // namespace pgdr

#endif
