// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/read_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/volumes_3.h>
#include <pgdr/io/gmsh.h>
#include <pgdr/io/medit.h>
#include <pgdr/parallel/parallel_sort.h>
#include <pgdr/quality/measures.h>

#include "file_text.h"
#include "mesh_groups.h"
#include "readers.h"
#include "vtk_xml.h"

namespace pgdr {
namespace {

using Kind = Input_problem::Kind;
using io_detail::Vtk_xml;

Indexed_mesh_3 read_vtu_mesh(const std::filesystem::path& path) {
  const io_detail::File_text text(path);
  const Vtk_xml file(text.view(), path);
  if (file.type() != "UnstructuredGrid") file.fail("it holds '" + std::string(file.type()) + "', not an unstructured grid");
  Indexed_mesh_3 mesh;
  const auto numbers = [&](const char* section, const char* name, std::size_t components) {
    auto values = file.array(section, name, components);
    if (!values) file.fail(std::string("it has no ") + (*name ? name : "points"));
    return std::move(*values);
  };
  const std::vector<double> coordinates = numbers("Points", "", 3);
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    const std::array<double, 3> p{coordinates[i], coordinates[i + 1], coordinates[i + 2]};
    if (!std::ranges::all_of(p, [](double x) { return std::isfinite(x); })) file.fail("point " + std::to_string(i / 3) + " has a coordinate that is not finite");
    mesh.points.push_back(p);
  }
  mesh.point_references.resize(mesh.points.size(), 0);
  const std::vector<double> connectivity = numbers("Cells", "connectivity", 1), offsets = numbers("Cells", "offsets", 1), types = numbers("Cells", "types", 1);
  if (types.size() != offsets.size()) file.fail("it has " + std::to_string(types.size()) + " types for " + std::to_string(offsets.size()) + " cells");
  const auto reference_array = [&](const char* name) {
    auto values = file.array("CellData", name);
    if (!values) values = file.array("CellData", "attribute");
    if (values && values->size() != offsets.size()) file.fail(std::string("its array '") + name + "' does not have a value for each cell");
    return values;
  };
  const auto regions = reference_array("region"), markers = reference_array("marker");
  const auto reference = [&](const std::optional<std::vector<double>>& values, std::size_t cell) {
    if (!values) return std::int32_t{0};
    const double value = (*values)[cell];
    if (!(std::abs(value) <= std::numeric_limits<std::int32_t>::max()) || value != std::floor(value)) file.fail("cell " + std::to_string(cell) + " has a region or marker that is no 32-bit integer");
    return static_cast<std::int32_t>(value);
  };
  constexpr double triangle = 5, tetrahedron = 10, quadratic_triangle = 22, quadratic_tetrahedron = 24;  // VTK's types of cells
  double begin = 0;
  for (std::size_t cell = 0; cell < offsets.size(); begin = offsets[cell++]) {
    const bool is_second_order = types[cell] == quadratic_tetrahedron || types[cell] == quadratic_triangle;
    const bool is_tetrahedron = types[cell] == tetrahedron || types[cell] == quadratic_tetrahedron;
    if (!is_tetrahedron && types[cell] != triangle && types[cell] != quadratic_triangle) continue;
    const std::size_t corners = is_tetrahedron ? 4 : 3, nodes = is_second_order ? (is_tetrahedron ? 10 : 6) : corners;
    if (offsets[cell] - begin != static_cast<double>(nodes) || !(begin >= 0) || !(offsets[cell] <= static_cast<double>(connectivity.size())))
      file.fail("cell " + std::to_string(cell) + " does not have the corners of its type");
    std::array<std::uint32_t, 4> c{};
    for (std::size_t k = 0; k < corners; ++k) {
      const double v = connectivity[static_cast<std::size_t>(begin) + k];
      if (!(v >= 0 && v < static_cast<double>(mesh.points.size()))) file.fail("cell " + std::to_string(cell) + " names a point that is not there");
      c[k] = static_cast<std::uint32_t>(v);
    }
    if (is_tetrahedron) {
      mesh.tetrahedra.push_back(c);
      mesh.tetrahedron_references.push_back(reference(regions, cell));
    } else {
      mesh.triangles.push_back({c[0], c[1], c[2]});
      mesh.triangle_references.push_back(reference(markers, cell));
    }
  }
  for (const Vtk_xml::Group& g : file.groups()) (g.dimension == 3 ? mesh.names.regions : mesh.names.markers)[g.number] = g.name;
  return mesh;
}

/// A face of a tetrahedron, by its corners in ascending order.
struct Face {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t tetrahedron;
  std::uint8_t side;
  bool operator<(const Face& o) const { return corners != o.corners ? corners < o.corners : tetrahedron != o.tetrahedron ? tetrahedron < o.tetrahedron : side < o.side; }
};

class Plc_builder {
 public:
  explicit Plc_builder(const Indexed_mesh_3& mesh) : mesh_(mesh) {}

  Plc build() {
    plc_.exponent = mesh_.exponent;
    plc_.names = mesh_.names;
    number_points();
    std::vector<std::array<std::uint32_t, 3>> listed;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      listed.push_back(io_detail::sorted_corners(mesh_.triangles[i]));
      add_triangle(mesh_.triangles[i], io_detail::reference_of(mesh_.triangle_references, i));
    }
    std::ranges::sort(listed);
    find_neighbors(listed);
    for (std::size_t i = 0; i < mesh_.edges.size(); ++i)
      plc_.segments.push_back({number_[mesh_.edges[i][0]], number_[mesh_.edges[i][1]], io_detail::reference_of(mesh_.edge_references, i)});
    add_seeds();
    add_holes();
    // A .vtu has them all, and mostly no triangles.
    std::erase_if(plc_.names.markers, [this](const auto& name) { return std::ranges::none_of(plc_.facets, [&](const auto& facet) { return facet.marker == name.first; }); });
    return std::move(plc_);
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  /// Those that something uses.
  void number_points() {
    number_.assign(mesh_.points.size(), none);
    const auto use = [&](const auto& elements) {
      for (const auto& e : elements)
        for (const std::uint32_t v : e) {
          if (v >= number_.size()) throw Input_error(Kind::bad_index, "the mesh names points that are not there");
          number_[v] = 0;
        }
    };
    use(mesh_.tetrahedra);
    use(mesh_.triangles);
    use(mesh_.edges);
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] == none) continue;
      number_[v] = static_cast<std::uint32_t>(plc_.vertices.size());
      plc_.vertices.emplace_back(mesh_.points[v][0], mesh_.points[v][1], mesh_.points[v][2]);
    }
  }

  void add_triangle(const std::array<std::uint32_t, 3>& t, int marker) { plc_.facets.push_back({{{number_[t[0]], number_[t[1]], number_[t[2]]}}, {}, marker}); }

  /// Which tetrahedra are of one part, and triangles where they are not.
  void find_neighbors(const std::vector<std::array<std::uint32_t, 3>>& listed) {
    std::vector<Face> faces;
    faces.reserve(4 * mesh_.tetrahedra.size());
    for (std::uint32_t t = 0; t < mesh_.tetrahedra.size(); ++t)
      for (std::uint8_t k = 0; k < 4; ++k) faces.push_back({io_detail::sorted_face(mesh_.tetrahedra[t], k), t, k});
    parallel_sort(faces.begin(), faces.end());
    neighbors_.assign(4 * mesh_.tetrahedra.size(), none);
    for (std::size_t i = 0, j = 0; i < faces.size(); i = j) {
      while (j < faces.size() && faces[j].corners == faces[i].corners) ++j;
      if (j - i > 2) throw Input_error(Kind::unreadable, "more than two tetrahedra of the mesh share a triangle");
      const bool is_listed = std::ranges::binary_search(listed, faces[i].corners);
      const bool is_inner = j - i == 2 && region(faces[i].tetrahedron) == region(faces[i + 1].tetrahedron);
      if (is_inner && !is_listed) {
        neighbors_[4 * std::size_t{faces[i].tetrahedron} + faces[i].side] = faces[i + 1].tetrahedron;
        neighbors_[4 * std::size_t{faces[i + 1].tetrahedron} + faces[i + 1].side] = faces[i].tetrahedron;
      } else if (!is_listed) {
        add_triangle(faces[i].corners, 0);
      }
    }
  }

  std::int32_t region(std::uint32_t t) const { return io_detail::reference_of(mesh_.tetrahedron_references, t); }

  /// In the largest tetrahedron of each part.
  void add_seeds() {
    std::vector<std::uint8_t> is_reached(mesh_.tetrahedra.size(), 0);
    std::vector<std::uint32_t> part;
    for (std::uint32_t start = 0; start < mesh_.tetrahedra.size(); ++start) {
      if (is_reached[start]) continue;
      part.assign(1, start);
      is_reached[start] = 1;
      std::uint32_t largest = start;
      double volume = -1;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const auto& c = mesh_.tetrahedra[part[i]];
        const double v = std::abs(signed_volume(mesh_.points[c[0]], mesh_.points[c[1]], mesh_.points[c[2]], mesh_.points[c[3]]));
        if (v > volume) {
          volume = v;
          largest = part[i];
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const std::uint32_t n = neighbors_[4 * std::size_t{part[i]} + k];
          if (n == none || is_reached[n]) continue;
          is_reached[n] = 1;
          part.push_back(n);
        }
      }
      std::array<double, 3> center{};
      for (const std::uint32_t v : mesh_.tetrahedra[largest])
        for (std::size_t k = 0; k < 3; ++k) center[k] += mesh_.points[v][k] / 4;
      Plc_region<Default_kernel> seed;
      seed.point = {center[0], center[1], center[2]};
      seed.id = region(largest);
      plc_.regions.push_back(seed);
    }
  }

  /// In volumes that have no tetrahedra.
  void add_holes() {
    const Domain_3<Default_kernel> domain = make_domain_3(plc_, 0.0, true);
    const Volumes_3<Default_kernel> volumes(domain);
    for (std::size_t v = 1; v < volumes.volumes().size(); ++v) {
      if (volumes.volumes()[v].has_region) continue;
      if (const auto p = volumes.interior_point(v)) plc_.holes.emplace_back(p->x, p->y, p->z);
    }
  }

  const Indexed_mesh_3& mesh_;
  Plc plc_;
  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> neighbors_;  ///< of tetrahedron t behind corner k: 4 t + k; none across a triangle
};

}  // namespace

const std::vector<std::string>& readable_mesh_extensions() {
  static const std::vector<std::string> extensions{".mesh", ".vtu", ".msh"};
  return extensions;
}

Indexed_mesh_3 read_mesh(const std::filesystem::path& path) {
  const std::string extension = io_detail::lower_extension(path);
  if (extension == ".mesh") return read_medit(path);
  if (extension == ".vtu") return read_vtu_mesh(path);
  if (extension == ".msh") return read_gmsh(path);
  io_detail::fail_at(path, 0, Kind::unreadable, "the extension '" + extension + "' is not one of .mesh, .vtu, .msh");
}

Plc plc_of_mesh(const Indexed_mesh_3& mesh) { return Plc_builder(mesh).build(); }

}  // namespace pgdr
