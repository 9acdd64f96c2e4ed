// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <pgdr/io/atomic_file.h>
#include <pgdr/io/gmsh.h>

#include "mesh_groups.h"

namespace pgdr {
namespace {

using io_detail::Mesh_group;
using io_detail::put_char;
using io_detail::put_number;

/// Gmsh's types of elements, of first and of second order.
constexpr std::int32_t triangle_types[2] = {2, 9}, tetrahedron_types[2] = {4, 11};

/// The groups of one dimension, with what their elements are.
template <class Nodes>
struct Elements {
  std::int32_t dimension, type;
  Nodes nodes;
  std::vector<Mesh_group> groups;
  std::size_t first;  ///< number of the first element
};

class Gmsh_writer {
 public:
  Gmsh_writer(const Indexed_mesh_3& mesh, const std::filesystem::path& path)
      : mesh_(mesh), out_(path), triangles_{2, triangle_types[!mesh.triangle_nodes.empty()], io_detail::triangles_of(mesh), io_detail::markers_of(mesh, io_detail::quotable), 1},
        tetrahedra_{3, tetrahedron_types[!mesh.tetrahedron_nodes.empty()], io_detail::tetrahedra_of(mesh, io_detail::edges_in_gmsh),
                    io_detail::regions_of(mesh, io_detail::quotable), 1 + mesh.triangles.size()} {}

  void write(Gmsh_format format) {
    const bool is_binary = format == Gmsh_format::binary_4_1;
    out_.write(std::string("$MeshFormat\n") + (format == Gmsh_format::ascii_2_2 ? "2.2" : "4.1") + (is_binary ? " 1 8\n" : " 0 8\n"));
    if (is_binary) {
      put(std::int32_t{1});  // so that a reader sees in which order bytes are
      out_.write("\n");
    }
    out_.write("$EndMeshFormat\n");
    write_names();
    switch (format) {
      case Gmsh_format::binary_4_1: write_binary(); break;
      case Gmsh_format::ascii_4_1: write_ascii(); break;
      case Gmsh_format::ascii_2_2: write_version_2(); break;
    }
    out_.commit();
  }

 private:
  void line(const std::string& text) { out_.write(text + "\n"); }

  void write_names() {
    line("$PhysicalNames");
    line(std::to_string(triangles_.groups.size() + tetrahedra_.groups.size()));
    for_both([&](const auto& e) {
      for (const Mesh_group& g : e.groups) line(std::to_string(e.dimension) + " " + std::to_string(g.tag) + " \"" + g.name + "\"");
    });
    line("$EndPhysicalNames");
  }

  void for_both(const auto& f) const {
    f(triangles_);
    f(tetrahedra_);
  }

  /// Lower and upper corner of what a group's elements fill.
  template <class Nodes>
  std::array<double, 6> box(const Elements<Nodes>& e, const Mesh_group& g) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 6> box{far, far, far, -far, -far, -far};
    const double unit = unit_of(mesh_);
    for (const std::uint32_t i : g.elements)
      for (const std::uint32_t v : e.nodes.corners[i])
        for (std::size_t d = 0; d < 3; ++d) {
          box[d] = std::min(box[d], unit * mesh_.points[v][d]);
          box[3 + d] = std::max(box[3 + d], unit * mesh_.points[v][d]);
        }
    return box;
  }

  /// Calls row(text, number, element) for all elements of a group, formatted on all threads.
  template <class Row>
  void write_group(const Mesh_group& g, std::size_t first, std::size_t columns, const Row& row) {
    io_detail::write_rows(out_, g.elements.size(), columns, [&](std::size_t from, std::size_t to, char* text) {
      for (std::size_t i = from; i < to; ++i) text = put_char(row(text, first + i, g.elements[i]), '\n');
      return text;
    });
  }

  void write_ascii() {
    const std::size_t points = mesh_.points.size(), elements = mesh_.triangles.size() + mesh_.tetrahedra.size();
    line("$Entities");
    line("0 0 " + std::to_string(triangles_.groups.size()) + " " + std::to_string(tetrahedra_.groups.size()));
    for_both([&](const auto& e) {
      for (const Mesh_group& g : e.groups) {
        char text[8 * (io_detail::max_number_length + 1)];
        char* end = put_number(text, g.tag);
        for (const double x : box(e, g)) end = put_number(put_char(end, ' '), x);
        line(std::string(text, end) + " 1 " + std::to_string(g.tag) + " 0");
      }
    });
    line("$EndEntities");
    const std::string count = std::to_string(points);
    line("$Nodes");
    line("1 " + count + " 1 " + count);
    line("3 " + std::to_string(owner_of_nodes()) + " 0 " + count);
    io_detail::write_rows(out_, points, 1, [&](std::size_t first, std::size_t last, char* text) {
      for (std::size_t i = first; i < last; ++i) text = put_char(put_number(text, i + 1), '\n');
      return text;
    });
    io_detail::write_rows(out_, points, 4, [&](std::size_t first, std::size_t last, char* text) {
      for (std::size_t i = first; i < last; ++i) text = put_char(io_detail::put_point(text, mesh_, i, ' '), '\n');
      return text;
    });
    line("$EndNodes");
    line("$Elements");
    line(std::to_string(triangles_.groups.size() + tetrahedra_.groups.size()) + " " + std::to_string(elements) + " 1 " + std::to_string(elements));
    for_both([&](const auto& e) {
      std::size_t first = e.first;
      for (const Mesh_group& g : e.groups) {
        line(std::to_string(e.dimension) + " " + std::to_string(g.tag) + " " + std::to_string(e.type) + " " + std::to_string(g.elements.size()));
        write_group(g, first, 11, [&e](char* text, std::size_t number, std::size_t i) { return io_detail::put_nodes(put_number(text, number), e.nodes, i, 1, ' '); });
        first += g.elements.size();
      }
    });
    line("$EndElements");
  }

  void write_version_2() {
    line("$Nodes");
    line(std::to_string(mesh_.points.size()));
    io_detail::write_rows(out_, mesh_.points.size(), 5, [&](std::size_t first, std::size_t last, char* text) {
      for (std::size_t i = first; i < last; ++i) text = put_char(io_detail::put_point(put_number(text, i + 1), mesh_, i, ' '), '\n');
      return text;
    });
    line("$EndNodes");
    line("$Elements");
    line(std::to_string(mesh_.triangles.size() + mesh_.tetrahedra.size()));
    for_both([&](const auto& e) {
      std::size_t first = e.first;
      for (const Mesh_group& g : e.groups) {
        // Two tags: the physical group, and the entity.
        write_group(g, first, 15, [&](char* text, std::size_t number, std::size_t i) {
          text = put_number(put_char(put_number(text, number), ' '), e.type);
          text = put_number(put_char(put_number(put_char(text, ' '), 2), ' '), g.tag);
          return io_detail::put_nodes(put_number(put_char(text, ' '), g.tag), e.nodes, i, 1, ' ');
        });
        first += g.elements.size();
      }
    });
    line("$EndElements");
  }

  template <class T>
  void put(T value) {
    static_assert(std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::uint64_t> || std::is_same_v<T, double>);
    out_.write(&value, sizeof value);
  }

  void write_binary() {
    out_.write("$Entities\n");
    for (const std::size_t n : {std::size_t{0}, std::size_t{0}, triangles_.groups.size(), tetrahedra_.groups.size()}) put(std::uint64_t{n});
    for_both([&](const auto& e) {
      for (const Mesh_group& g : e.groups) {
        put(g.tag);
        for (const double x : box(e, g)) put(x);
        put(std::uint64_t{1});
        put(g.tag);
        put(std::uint64_t{0});
      }
    });
    out_.write("\n$EndEntities\n$Nodes\n");
    const std::uint64_t points = mesh_.points.size(), elements = mesh_.triangles.size() + mesh_.tetrahedra.size();
    for (const std::uint64_t n : {std::uint64_t{1}, points, std::uint64_t{1}, points}) put(n);
    put(std::int32_t{3});
    put(owner_of_nodes());
    put(std::int32_t{0});
    put(points);
    for (std::uint64_t i = 1; i <= points; ++i) put(i);
    const double unit = unit_of(mesh_);
    for (const auto& p : mesh_.points)
      for (const double x : p) put(unit * x);
    out_.write("\n$EndNodes\n$Elements\n");
    for (const std::uint64_t n : {std::uint64_t{triangles_.groups.size() + tetrahedra_.groups.size()}, elements, std::uint64_t{1}, elements}) put(n);
    for_both([&](const auto& e) {
      std::uint64_t number = e.first;
      for (const Mesh_group& g : e.groups) {
        put(e.dimension);
        put(g.tag);
        put(e.type);
        put(std::uint64_t{g.elements.size()});
        for (const std::uint32_t i : g.elements) {
          put(number++);
          for (std::size_t k = 0; k < e.nodes.nodes_of_each(); ++k) put(std::uint64_t{e.nodes.node(i, k)} + 1);
        }
      }
    });
    out_.write("\n$EndElements\n");
  }

  /// The volume under which all nodes are listed: which one says nothing about the mesh.
  std::int32_t owner_of_nodes() const { return tetrahedra_.groups.empty() ? 1 : tetrahedra_.groups.front().tag; }

  const Indexed_mesh_3& mesh_;
  Atomic_file out_;
  Elements<io_detail::Triangle_nodes> triangles_;
  Elements<io_detail::Tetrahedron_nodes> tetrahedra_;
};

}  // namespace

std::optional<Gmsh_format> gmsh_format_named(std::string_view name) {
  if (name == "4.1") return Gmsh_format::binary_4_1;
  if (name == "4.1-ascii") return Gmsh_format::ascii_4_1;
  if (name == "2.2") return Gmsh_format::ascii_2_2;
  return std::nullopt;
}

void write_gmsh(const Indexed_mesh_3& mesh, const std::filesystem::path& path, Gmsh_format format) {
  Gmsh_writer(mesh, path).write(format);
}

}  // namespace pgdr
