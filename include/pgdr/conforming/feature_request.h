// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FEATURE_REQUEST_H
#define PGDR_CONFORMING_FEATURE_REQUEST_H

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include <pgdr/acute/split_guard_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/fifo.h>
#include <pgdr/conforming/spread_queue.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// What became of a split.
enum class Split_outcome : std::uint8_t {
  inserted,  ///< a point was inserted, here or on the subsegment that was in the way
  refused,   ///< nothing was inserted: the edges would become too short
  elsewhere  ///< nothing was inserted: the point lies in another leaf
};

/// The point and the piece at which a split was `elsewhere`.
struct Split_elsewhere {
  Vec_3 at;
  Piece_id piece;
  bool is_subsegment = false;
};

/// A piece that is in the way of a point. Slots of subsegments and subfacets are counted apart, so that a number without the kind may
/// name either.
struct Obstacle_id {
  Piece_id piece;
  bool is_subsegment = false;

  friend bool operator==(const Obstacle_id&, const Obstacle_id&) = default;
};

/// A piece that waits to be split.
struct Feature_request {
  Piece_id piece;
  Split_reason reason;
  double floor = 0;
  double reach = 0;    ///< like the floor, see `Split_guard`
  double relaxed = 0;  ///< the same

  static Feature_request encroached(Piece_id piece, const Split_guard& guard) {
    return {piece, Split_reason::encroached, guard.floor, guard.reach, guard.relaxed};
  }
  Split_guard guard() const { return {.floor = floor, .reach = reach, .relaxed = relaxed}; }
};

/// The pieces of one leaf that wait to be split, subsegments before subfacets. (Subfacets as they came: spread as well, one of 118 parts had no
/// end in `--tolerance 0`, where facets meet at 17 degrees.)
struct Feature_queues {
  Spread_queue<Feature_request> subsegments;
  Fifo<Feature_request> subfacets;

  void push(bool is_subsegment, const Feature_request& r) { is_subsegment ? subsegments.push(r) : subfacets.push(r); }
  /// \pre there is one
  const Feature_request& next(bool is_subsegment) const { return is_subsegment ? subsegments.next() : subfacets[0]; }
  Feature_request pop(bool is_subsegment) { return is_subsegment ? subsegments.pop() : subfacets.pop(); }

  bool empty() const { return subsegments.empty() && subfacets.empty(); }
  std::size_t size() const { return subsegments.size() + subfacets.size(); }
  void take_all(Feature_queues& from) {
    subsegments.take_all(from.subsegments);
    subfacets.take_all(from.subfacets);
  }
};

/// A tetrahedron as it was when it was noted.
template <class Cell_handle>
struct Cell_id_3 {
  Cell_handle cell;
  unsigned int generation = 0;
  float radius = 0;  ///< of the circumball, rounded up; 0: not measured
  bool is_live() const { return cell->generation() == generation; }
};

/// A split on its way to the leaf that holds the split point, on behalf of a client in the leaf that it comes from. Or
/// a point to be put on a feature, `on`, at `home`, since there is one at the like place, `by`, on a feature close by.
template <class Cell_handle>
struct Feature_errand_3 {
  using Vertex_handle = typename std::iterator_traits<Cell_handle>::value_type::Vertex_handle;

  Piece_id piece;
  bool is_subsegment = false;
  Split_reason reason = Split_reason::encroached;
  Split_guard guard;

  enum class Client : std::uint8_t {
    none,
    subfacet,    ///< `request` is queued again when a point was inserted
    tetrahedron  ///< `cell` goes back `home`, with `obstacle` among `refused` if nothing was inserted
  };
  Client client = Client::none;
  Feature_request request{};
  Cell_id_3<Cell_handle> cell;
  Vec_3 home;
  Obstacle_id obstacle;
  std::vector<Obstacle_id> refused;
  Vertex_handle by{};
  Feature_id on{};
  bool is_image() const { return by != Vertex_handle(); }
};

}  // namespace pgdr

#endif
