// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_INDEXED_MESH_OF_3_H
#define PGDR_REFINEMENT_INDEXED_MESH_OF_3_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <stdexcept>
#include <string>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/indexed_mesh_3.h>
#include <pgdr/mesh/prefetch.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/parallel/parallel_sort.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/refinement/canonical_order.h>
#include <pgdr/refinement/refined_mesh_3.h>
#include <pgdr/refinement/sort_tetrahedra.h>

namespace pgdr {

namespace internal {

/// Gathers a refined mesh into plain arrays. Two steps, so that the triangulation can go in between: a large mesh
/// need not be held twice.
///
/// The first step goes once through the triangulation and takes everything as it comes: vertices have the numbers of
/// their places in the container, which may differ from run to run. The second step finds the canonical numbers and
/// sorts, after which nothing is left of that order. Beside the triangulation there are about 22 bytes for each
/// tetrahedron: its vertices, its subdomain, and its share of the vertices.
template <class K>
class Indexed_mesh_builder_3 {
  using Mesh = Refined_mesh_3<K>;
  using Tr = typename Mesh::Triangulation;
  using Complex = typename Mesh::Complex;
  using Cell_handle = typename Tr::Cell_handle;
  static constexpr std::uint32_t none = 0xffffffffu;

 public:
  /// `most`: vertices or tetrahedra that may be numbered; more would not fit into 32 bits, of which one value means none.
  explicit Indexed_mesh_builder_3(std::size_t most = none) : most_(most) {}

  /// All that needs the triangulation. Throws `std::length_error` for a mesh too large to be numbered.
  void gather(const Mesh& mesh) {
    const Domain_3<K>& domain = mesh.domain();
    if (std::max(mesh.triangulation().number_of_vertices(), mesh.triangulation().tds().number_of_cells()) > most_)
      throw std::length_error("the mesh has more than " + std::to_string(most_) + " tetrahedra: they cannot be numbered");
    for (std::size_t k = 0; k < 3; ++k) lower_[k] = domain.lower[k], upper_[k] = domain.upper[k];
    exponent_ = domain.exponent;
    names_ = domain.names;
    squared_bound_ = mesh.radius_edge_ratio() * mesh.radius_edge_ratio();
    for (const Subdomain& s : mesh.subdomains()) ids_.push_back(s.id);
    gather_vertices(mesh);
    gather_cells(mesh);
    gather_edges(mesh);
  }

  /// Sorts what was gathered into canonical order.
  Indexed_mesh_3 finish() {
    Indexed_mesh_3 out;
    out.exponent = exponent_;
    out.names = std::move(names_);
    const std::vector<std::uint32_t> number = number_vertices(out);
    Tetrahedron_sorter(std::move(*pool_), number, out.points.size())
        .sort(ids_, out.tetrahedra, out.tetrahedron_references);
    sort_elements(triangles_, number, out.triangles, out.triangle_references);
    sort_elements(edges_, number, out.edges, out.edge_references);
    find_unrefined(out, number);
    find_exempt(out);
    return out;
  }

 private:
  template <std::size_t N>
  struct Element {
    std::array<std::uint32_t, N> vertices;
    std::int32_t reference;
    bool operator<(const Element& o) const {
      return vertices != o.vertices ? vertices < o.vertices : reference < o.reference;
    }
  };

  /// Copies the finite vertices and numbers them as they come.
  void gather_vertices(const Mesh& mesh) {
    const Tr& tr = mesh.triangulation();
    const std::vector<int>& markers = mesh.domain().vertex_markers;
    const std::size_t n = tr.number_of_vertices();
    points_.resize(n);
    references_.resize(n);
    dimensions_.resize(n);
    used_.resize(n);
    corners_.resize(mesh.domain().vertices.size(), none);
    parallel_walk(tr.finite_vertices_begin(), tr.finite_vertices_end(), default_grain,
                  [&](std::size_t i, auto it, std::size_t count) {
                    for (const std::size_t end = i + count; i < end; ++i, ++it) {
                      const typename Tr::Vertex_handle v = it;
                      v->set_number(static_cast<std::uint32_t>(i));
                      const Vec_3 p = position(v);
                      points_[i] = {p.x, p.y, p.z};
                      dimensions_[i] = static_cast<std::uint8_t>(v->in_dimension());
                      if (v->in_dimension() != 0) continue;
                      references_[i] = markers[v->index()];
                      corners_[v->index()] = static_cast<std::uint32_t>(i);
                    }
                    return 0;
                  });
  }

  /// Copies the meshed cells, marks their vertices as used, and collects the subfacets on them.
  void gather_cells(const Mesh& mesh) {
    const Tr& tr = mesh.triangulation();
    pool_.emplace(tr.tds().number_of_cells(), ids_.size());
    meshed_subsegments_.resize(mesh.complex().subsegment_slots());
    struct Part {
      Tetrahedron_pool::Run run;
      std::vector<Element<3>> triangles;
      std::vector<std::array<std::uint32_t, 4>> unrefined;
    };
    const auto gather = [&](std::size_t position, auto it, std::size_t count) {
      Part part{{position, 0}, {}, {}};
      // The vertices lie anywhere in memory: they are called for some cells before they are looked at.
      std::array<Cell_handle, 16> cells;
      while (count > 0) {
        std::size_t n = 0;
        for (; count > 0 && n < cells.size(); --count, ++it) {
          cells[n] = it;
          if (cells[n]->subdomain() == 0 || tr.is_infinite(cells[n])) continue;
          for (int k = 0; k < 4; ++k) prefetch(cells[n]->vertex(k));
          ++n;
        }
        for (std::size_t i = 0; i < n; ++i) {
          gather_cell(cells[i], position + part.run.count++);
          const Cell_state state = cells[i]->state();
          if (state == Cell_state::poor || state == Cell_state::limited)
            part.unrefined.push_back(pool_->vertices[part.run.position + part.run.count - 1]);
          if (cells[i]->subsegment_edges() != 0) mark_subsegments(mesh, cells[i]);
          if (cells[i]->has_subfacet()) gather_subfacets(mesh, cells[i], part.triangles);
        }
      }
      return part;
    };
    for (Part& part : parallel_walk(tr.all_cells_begin(), tr.all_cells_end(), default_grain, gather)) {
      pool_->runs.push_back(part.run);
      triangles_.insert(triangles_.end(), part.triangles.begin(), part.triangles.end());
      unrefined_.insert(unrefined_.end(), part.unrefined.begin(), part.unrefined.end());
    }
  }

  void gather_cell(Cell_handle c, std::size_t i) {
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t v = c->vertex(k)->number();
      pool_->vertices[i][static_cast<std::size_t>(k)] = v;
      const std::atomic_ref<std::uint8_t> used(used_[v]);
      if (used.load(std::memory_order_relaxed) == 0) used.store(1, std::memory_order_relaxed);
    }
    pool_->set_label(i, static_cast<std::size_t>(c->subdomain()));
  }

  /// A segment may lie in a void between two vertices of the mesh: only those on meshed cells are in it.
  void mark_subsegments(const Mesh& mesh, Cell_handle c) {
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        if (c->subsegment_edges() & edge_bit(i, j))
          if (const std::uint32_t s = mesh.complex().find_subsegment(c->vertex(i), c->vertex(j)); s != Complex::none)
            std::atomic_ref<std::uint8_t>(meshed_subsegments_[s]).store(1, std::memory_order_relaxed);
  }

  static int id_of(const Mesh& mesh, Cell_handle c) {
    return mesh.subdomains()[static_cast<std::size_t>(c->subdomain())].id;
  }

  /// Each subfacet is seen from both sides and written once: by the meshed side, between two subdomains by that with
  /// the smaller id, inside one by the side behind the facet, counterclockwise about its normal.
  static void gather_subfacets(const Mesh& mesh, Cell_handle c, std::vector<Element<3>>& triangles) {
    for (int i = 0; i < 4; ++i) {
      if (c->subfacet(i) == Complex::none) continue;
      const auto& t = mesh.complex().subfacet(c->subfacet(i));
      std::array<std::uint32_t, 3> seen, stored;
      for (int k = 0; k < 3; ++k) {
        // CGAL's triple is counterclockwise from inside the cell.
        seen[static_cast<std::size_t>(k)] = c->vertex(Tr::vertex_triple_index(i, 2 - k))->number();
        stored[static_cast<std::size_t>(k)] = t.vertices[static_cast<std::size_t>(k)]->number();
      }
      const Cell_handle n = c->neighbor(i);
      if (n->subdomain() != 0) {
        const int here = id_of(mesh, c), there = id_of(mesh, n);
        if (here != there ? here > there : canonical(stored) != canonical(seen)) continue;
      }
      triangles.push_back({seen, mesh.domain().facets[t.facet].marker});
    }
  }

  void gather_edges(const Mesh& mesh) {
    for (std::uint32_t i = 0; i < mesh.complex().subsegment_slots(); ++i) {
      const auto& s = mesh.complex().subsegment(i);
      if (!s.alive() || !s.present) continue;
      const std::uint32_t a = s.vertices[0]->number(), b = s.vertices[1]->number();
      if (meshed_subsegments_[i]) edges_.push_back({{a, b}, mesh.domain().segments[s.segment].marker});
    }
  }

  /// Numbers the vertices of meshed cells: domain vertices in their order, then the others along a Morton curve.
  /// Fills the points of `out`; returns the number of each gathered vertex.
  std::vector<std::uint32_t> number_vertices(Indexed_mesh_3& out) {
    std::vector<std::uint32_t> order;
    order.reserve(points_.size());
    for (const std::uint32_t v : corners_)
      if (v != none && used_[v]) order.push_back(v);
    const std::size_t corners = order.size();
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (used_[v] && dimensions_[v] != 0) order.push_back(static_cast<std::uint32_t>(v));
    sort_along_curve(std::span(order).subspan(corners), points_, lower_, upper_);

    std::vector<std::uint32_t> number(points_.size());
    out.points.resize(order.size());
    out.point_references.resize(order.size());
    out.point_dimensions.resize(order.size());
    parallel_for_chunks(order.size(), default_grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const std::uint32_t v = order[i];
        number[v] = static_cast<std::uint32_t>(i);
        out.points[i] = points_[v];
        out.point_references[i] = references_[v];
        out.point_dimensions[i] = dimensions_[v];
      }
    });
    points_ = {};
    return number;
  }

  template <std::size_t N>
  static void sort_elements(std::vector<Element<N>>& elements, const std::vector<std::uint32_t>& number,
                            std::vector<std::array<std::uint32_t, N>>& vertices,
                            std::vector<std::int32_t>& references) {
    parallel_for_chunks(elements.size(), default_grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        for (std::uint32_t& v : elements[i].vertices) v = number[v];
        elements[i].vertices = canonical(elements[i].vertices);
      }
    });
    parallel_sort(elements.begin(), elements.end());
    vertices.reserve(elements.size());
    references.reserve(elements.size());
    for (const auto& e : elements) {
      vertices.push_back(e.vertices);
      references.push_back(e.reference);
    }
    elements = {};
  }

  /// Finds again what was left poor. \pre the tetrahedra are in canonical order
  void find_unrefined(Indexed_mesh_3& out, const std::vector<std::uint32_t>& number) {
    for (const auto& [a, b, c, d] : unrefined_) {
      const auto t = canonical(std::array{number[a], number[b], number[c], number[d]});
      out.unrefined.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(out.tetrahedra, t) - out.tetrahedra.begin()));
    }
    unrefined_ = {};
    parallel_sort(out.unrefined.begin(), out.unrefined.end());
  }

  /// Lists the other tetrahedra over the ratio bound.
  void find_exempt(Indexed_mesh_3& out) const {
    out.exempt = parallel_collect(out.tetrahedra.size(), default_grain, [&](std::size_t first, std::size_t last) {
      std::vector<std::uint32_t> exempt;
      for (std::size_t i = first; i < last; ++i) {
        const auto& t = out.tetrahedra[i];
        const Tetrahedron_ball b = tetrahedron_ball(
            {to_vec(out.points[t[0]]), to_vec(out.points[t[1]]), to_vec(out.points[t[2]]), to_vec(out.points[t[3]])});
        if (b.squared_radius > squared_bound_ * b.squared_shortest && !std::ranges::binary_search(out.unrefined, i))
          exempt.push_back(static_cast<std::uint32_t>(i));
      }
      return exempt;
    });
  }

  std::size_t most_;
  // Of the domain and the parameters.
  std::array<double, 3> lower_{}, upper_{};
  int exponent_ = 0;
  Reference_names names_;
  double squared_bound_ = 0;
  std::vector<std::int32_t> ids_;  ///< region ids by subdomain
  // By vertex, in the order in which they were found.
  std::vector<std::array<double, 3>> points_;
  std::vector<std::int32_t> references_;
  std::vector<std::uint8_t> dimensions_;
  std::vector<std::uint8_t> used_;      ///< whether a meshed cell has it
  std::vector<std::uint32_t> corners_;  ///< by domain vertex
  std::vector<std::uint8_t> meshed_subsegments_;  ///< by slot, whether a meshed cell has it
  std::optional<Tetrahedron_pool> pool_;
  std::vector<std::array<std::uint32_t, 4>> unrefined_;
  std::vector<Element<3>> triangles_;
  std::vector<Element<2>> edges_;
};

}  // namespace internal

/// The meshed cells as plain arrays in canonical order: the same for the same mesh, however it was made.
///
/// Subfacets are oriented outwards from the meshed side, between two subdomains from the one with the smaller id.
/// Works on all threads of the caller's arena.
template <class K>
Indexed_mesh_3 indexed_mesh_3(const Refined_mesh_3<K>& mesh) {
  internal::Indexed_mesh_builder_3<K> builder;
  builder.gather(mesh);
  return builder.finish();
}

/// The same, but frees the triangulation as soon as it can.
template <class K>
Indexed_mesh_3 indexed_mesh_3(Refined_mesh_3<K>&& mesh) {
  internal::Indexed_mesh_builder_3<K> builder;
  {
    const Refined_mesh_3<K> last = std::move(mesh);
    builder.gather(last);
  }
  return builder.finish();
}

// Compiled in the library.
extern template Indexed_mesh_3 indexed_mesh_3(const Refined_mesh_3<Default_kernel>&);
extern template Indexed_mesh_3 indexed_mesh_3(Refined_mesh_3<Default_kernel>&&);
}  // namespace pgdr

#endif
