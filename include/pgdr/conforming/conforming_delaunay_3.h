// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_CONFORMING_DELAUNAY_3_H
#define PGDR_CONFORMING_CONFORMING_DELAUNAY_3_H

#include <cstdint>
#include <utility>
#include <vector>

#include <pgdr/conforming/cocircular_polygon_3.h>
#include <pgdr/conforming/feature_refiner_3.h>
#include <pgdr/conforming/initial_complex_3.h>
#include <pgdr/conforming/presence_3.h>

namespace pgdr {

namespace internal {

/// Queues a present subsegment that some vertex encroaches. If the ball holds any vertex, it holds one of the link.
template <class Tr>
void queue_if_encroached_subsegment(const Tr& tr, Feature_refiner_3<Tr>& refiner, Vertex_star_3<Tr>& star, std::uint32_t slot) {
  const auto& s = refiner.complex().subsegment(slot);
  const auto c = star.find_edge(s.vertices[0], s.vertices[1]);
  if (c == typename Tr::Cell_handle()) return;
  auto around = tr.incident_cells(c, c->index(s.vertices[0]), c->index(s.vertices[1])), done = around;
  do {
    for (int k = 0; k < 4; ++k) {
      const auto v = around->vertex(k);
      if (tr.is_infinite(v) || !encroaches(refiner.complex(), s, v)) continue;
      refiner.note_encroached_subsegment(slot, v);
      return;
    }
  } while (++around != done);
}

}  // namespace internal

/// Marks the subsegments that are there and queues those that are not, or that a vertex encroaches.
template <class Tr>
void start_segment_recovery(Tr& tr, Feature_refiner_3<Tr>& refiner) {
  auto& complex = refiner.complex();
  Vertex_star_3<Tr> star;
  const auto slots = [&] { return static_cast<std::uint32_t>(complex.subsegment_slots()); };
  for (std::uint32_t s = 0; s < slots(); ++s)
    if (complex.subsegment(s).alive() && !mark_subsegment(tr, complex, star, s)) refiner.note_missing_subsegment(s);
  refiner.mirror_corners();
  for (std::uint32_t s = 0; s < slots(); ++s)
    if (complex.subsegment(s).present) internal::queue_if_encroached_subsegment(tr, refiner, star, s);
}

/// The same for subfacets, once every subsegment is there; cocircular polygons adopt what the triangulation shows.
template <class Tr>
void start_facet_recovery(const Tr& tr, Feature_refiner_3<Tr>& refiner) {
  auto& complex = refiner.complex();
  Vertex_star_3<Tr> star;
  const auto slots = [&] { return static_cast<std::uint32_t>(complex.subfacet_slots()); };
  for (std::uint32_t t = 0; t < slots(); ++t)
    if (complex.subfacet(t).alive() && !complex.subfacet(t).present) mark_subfacet(complex, star, t);
  Cocircular_polygon_3<Tr> polygon(complex, refiner.pool());
  for (std::uint32_t t = 0; t < slots(); ++t)
    if (complex.subfacet(t).alive() && !complex.subfacet(t).present && !polygon.adopt(t))
      refiner.note_missing_subfacet(t);
  // One walk through the cells tells where all are: where the mesh is not graded, vertices have large stars.
  std::vector<std::pair<typename Tr::Cell_handle, int>> sides(slots());
  for (const auto c : tr.all_cell_handles())
    for (int i = 0; i < 4; ++i)
      if (const std::uint32_t t = c->subfacet(i); t != complex.none) sides[t] = {c, i};
  for (const auto& [c, i] : sides)
    if (c != typename Tr::Cell_handle()) refiner.request_if_encroached(c, i);
}

}  // namespace pgdr

#endif
