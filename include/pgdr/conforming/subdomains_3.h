// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SUBDOMAINS_3_H
#define PGDR_CONFORMING_SUBDOMAINS_3_H

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/feature_refiner_3.h>

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
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c) {
      c->set_subdomain(volumes_[static_cast<std::size_t>(c->subdomain())].label);
      for (int i = 0; i < 4; ++i)
        if (c->subfacet(i) != Complex::none)
          complex_.note_side(complex_.subfacet(c->subfacet(i)).facet, complex_.is_in_front(c, i), c->subdomain());
    }
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

  struct Volume {
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
    const auto v = static_cast<std::int32_t>(volumes_.size());
    volumes_.emplace_back();
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
              volumes_.back().first_vertex = std::min(volumes_.back().first_vertex, c->vertex(j)->index());
          const std::uint64_t facet = complex_.subfacet(c->subfacet(i)).facet;
          volumes_.back().first_side = std::min(volumes_.back().first_side, 2 * facet + !complex_.is_in_front(c, i));
        }
      }
    }
  }

  void measure_depths() {
    for (auto c = tr_.all_cells_begin(); c != tr_.all_cells_end(); ++c)
      for (int i = 0; i < 4; ++i)
        if (c->subfacet(i) != Complex::none && c->neighbor(i)->subdomain() != c->subdomain())
          volumes_[static_cast<std::size_t>(c->subdomain())].neighbors.push_back(c->neighbor(i)->subdomain());
    std::deque<std::size_t> front{0};
    volumes_[0].depth = 0;
    while (!front.empty()) {
      const std::size_t v = front.front();
      front.pop_front();
      for (const std::int32_t n : volumes_[v].neighbors) {
        Volume& w = volumes_[static_cast<std::size_t>(n)];
        if (w.depth >= 0) continue;
        w.depth = volumes_[v].depth + 1;
        front.push_back(static_cast<std::size_t>(n));
      }
    }
  }

  Volume& volume_of(const typename Tr::Point& p) {
    return volumes_[static_cast<std::size_t>(tr_.locate(p)->subdomain())];
  }

  void decide(bool ignore_region_sizes) {
    const auto& domain = complex_.domain();
    for (const auto& h : domain.holes) volume_of(h).hole = true;
    for (std::size_t r = 0; r < domain.regions.size(); ++r) {
      Volume& v = volume_of(domain.regions[r].point);
      if (v.region < 0) v.region = static_cast<std::int32_t>(r);
    }
    table_.assign(1, Subdomain{});
    std::vector<Volume*> unnamed;
    for (std::size_t i = 1; i < volumes_.size(); ++i) {
      Volume& v = volumes_[i];
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
    std::ranges::sort(unnamed, {}, [](const Volume* v) { return std::pair(v->first_vertex, v->first_side); });
    int next = 1;
    for (Volume* v : unnamed) {
      while (std::any_of(domain.regions.begin(), domain.regions.end(), [&](const auto& r) { return r.id == next; }))
        ++next;
      v->label = static_cast<std::int32_t>(table_.size());
      table_.push_back({next++});
    }
  }

  Tr& tr_;
  Complex& complex_;
  std::vector<Volume> volumes_;
  std::vector<Subdomain> table_;
};

}  // namespace pgdr

#endif
