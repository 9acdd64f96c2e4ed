// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/quality: what the property checks of check_mesh share.
#ifndef PGDR_SRC_QUALITY_CHECK_PARTS_H
#define PGDR_SRC_QUALITY_CHECK_PARTS_H

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <pgdr/domain/volumes_3.h>
#include <pgdr/quality/check_mesh.h>

#include "face_table.h"

namespace pgdr::quality_detail {

using Epick_domain = Domain_3<Epick>;

constexpr std::uint32_t none = 0xffffffffu;

inline Epick::Point_3 point(const Indexed_mesh_3& mesh, std::uint32_t v) {
  const auto& p = mesh.points[v];
  return Epick::Point_3(p[0], p[1], p[2]);
}

/// Text of the arguments one after the other.
template <class... T>
std::string text(const T&... items) {
  std::ostringstream out;
  out.precision(6);
  (out << ... << items);
  return out.str();
}

/// Counts failures and keeps a description of the first.
class Failures {
 public:
  template <class... T>
  void add(const T&... description) {
    if (count_++ == 0) first_ = text(description...);
  }
  std::size_t count() const { return count_; }
  bool none() const { return count_ == 0; }
  /// A line that passes without failures; `figures` come first, then the number of failures and the first of
  /// them.
  Check_line line(const std::string& property, const std::string& figures) const {
    if (none()) return {property, true, figures};
    return {property, false,
            text(figures, "; ", count_, count_ == 1 ? " failure: " : " failures, the first: ", first_)};
  }

 private:
  std::size_t count_ = 0;
  std::string first_;
};

Check_line check_indices(const Indexed_mesh_3& mesh, std::size_t most_tetrahedra);
Check_line check_vertices(const Indexed_mesh_3& mesh);
Check_line check_duplicates(const Indexed_mesh_3& mesh);
Check_line check_orientation(const Indexed_mesh_3& mesh);
Check_line check_faces(const Indexed_mesh_3& mesh, const Face_table& faces);
Check_line check_boundary(const Indexed_mesh_3& mesh, const Face_table& faces);
Check_line check_edges(const Indexed_mesh_3& mesh);
Check_line check_overlap(const Indexed_mesh_3& mesh, const Face_table& faces);
Check_line check_delaunay(const Indexed_mesh_3& mesh);

/// `ratio`, and `dihedral angle` if a smallest one is asked for. `domain` may be null: then nothing excuses a tetrahedron beyond a bound.
std::vector<Check_line> check_shapes(const Indexed_mesh_3& mesh, const Epick_domain* domain, const Check_options& options);

// With a domain.

/// What of the domain a mesh of its material has to show: everything that touches material.
struct Expected {
  std::vector<char> vertices;                      ///< by vertex of the domain
  std::vector<char> segments;                      ///< by segment of the domain
  std::vector<std::vector<char>> facet_triangles;  ///< by facet of the domain and triangle of the facet
};

Expected expected_of(const Epick_domain& domain, const Volumes_3<Epick>& volumes);

/// The mesh's vertex at each vertex of the domain, `none` where there is none.
std::vector<std::uint32_t> match_vertices(const Indexed_mesh_3& mesh, const Epick_domain& domain);

/// Distance up to which a rounded point of a line or plane of the domain counts as on it.
double rounding_distance(const Epick_domain& domain);

Check_line check_input_vertices(const Indexed_mesh_3& mesh, const Epick_domain& domain,
                                const Expected& expected, const std::vector<std::uint32_t>& matched);
Check_line check_segments(const Indexed_mesh_3& mesh, const Epick_domain& domain, const Expected& expected,
                          const std::vector<std::uint32_t>& matched);
/// The lines `facets` and `distance`.
std::vector<Check_line> check_facets(const Indexed_mesh_3& mesh, const Epick_domain& domain,
                                     const Expected& expected);
/// The lines `regions` and `volume`.
std::vector<Check_line> check_regions(const Indexed_mesh_3& mesh, const Face_table& faces,
                                      const Epick_domain& domain, const Volumes_3<Epick>& volumes);

}  // namespace pgdr::quality_detail

#endif
