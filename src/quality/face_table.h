// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/quality: the faces of the tetrahedra, with the tetrahedra on them.
#ifndef PGDR_SRC_QUALITY_FACE_TABLE_H
#define PGDR_SRC_QUALITY_FACE_TABLE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr::quality_detail {

/// All faces of all tetrahedra, grouped: 12 bytes for each of the four faces of a tetrahedron.
///
/// Sorted by their ascending vertices, so that it depends on nothing but the mesh, and equal faces are
/// neighbours.
class Face_table {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// One face as seen from one tetrahedron: `tetrahedron_face` is 4 * tetrahedron + position of the opposite
  /// vertex.
  struct Half_face {
    std::uint32_t second;  ///< middle vertex; the smallest one is known from the bucket
    std::uint32_t third;
    std::uint32_t tetrahedron_face;
    std::uint32_t tetrahedron() const { return tetrahedron_face / 4; }
  };

  /// `mesh` must have valid indices and fewer than 2^30 tetrahedra; it has to outlive the table.
  explicit Face_table(const Indexed_mesh_3& mesh);

  /// Calls f(vertices ascending, first position, number of tetrahedra) for every face.
  template <class F>
  void for_each(F f) const {
    for (std::uint32_t v = 0; v + 1 < begin_.size(); ++v)
      for (std::size_t i = begin_[v]; i < begin_[v + 1];) {
        const std::size_t n = group_size(i, begin_[v + 1]);
        f(Triangle{v, halves_[i].second, halves_[i].third}, i, n);
        i += n;
      }
  }

  const Half_face& operator[](std::size_t position) const { return halves_[position]; }

  /// First position of the face with these vertices in any order, and the number of tetrahedra on it; 0 if
  /// none.
  std::array<std::size_t, 2> find(Triangle t) const;

  /// The face at `position`, so ordered that it is counterclockwise as seen from outside of its (positive)
  /// tetrahedron.
  Triangle outward(std::size_t position) const;

  /// Whether the ascending order of the vertices is an even permutation of `outward`.
  bool ascending_is_outward(std::size_t position) const;

  /// Whether the face at `first` is a listed triangle of the mesh.
  bool listed(std::size_t first) const { return listed_[first]; }

  std::size_t size() const { return halves_.size(); }

 private:
  std::size_t group_size(std::size_t i, std::size_t end) const {
    std::size_t n = 1;
    while (i + n < end && halves_[i + n].second == halves_[i].second &&
           halves_[i + n].third == halves_[i].third)
      ++n;
    return n;
  }

  const Indexed_mesh_3& mesh_;
  std::vector<std::size_t> begin_;  ///< where the faces of each smallest vertex start; one more at the end
  std::vector<Half_face> halves_;
  std::vector<bool> listed_;  ///< by position
};

}  // namespace pgdr::quality_detail

#endif
