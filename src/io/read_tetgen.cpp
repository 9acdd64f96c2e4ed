// SPDX-License-Identifier: GPL-3.0-or-later
// TetGen's PLC formats as its manual describes them (H. Si, TetGen user's manual 1.5, section 5.2).
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "file_text.h"
#include "line_scanner.h"
#include "readers.h"

namespace pgdr::io_detail {
namespace {

using Kind = Input_problem::Kind;
using Point_3 = Plc::Point_3;
using Facet = Plc_facet<Default_kernel>;

class Tetgen_reader {
 public:
  Tetgen_reader(std::string_view text, const std::filesystem::path& path, Tetgen_format format)
      : in_(text, path), format_(format) {}

  Plc read() {
    in_.need_line("the number of vertices");
    if (!read_vertices(in_)) read_node_file();
    read_facets();
    if (read_holes()) read_regions();
    return std::move(plc_);
  }

 private:
  /// The node list, the header line being current; false when it is in a file of its own.
  bool read_vertices(Line_scanner& in) {
    const std::size_t count = in.count("the number of vertices");
    const int dimension = in.at_end_of_line() ? 3 : in.integer<int>("the dimension");
    const std::size_t attributes = in.at_end_of_line() ? 0 : in.count("the number of vertex attributes");
    const bool markers = !in.at_end_of_line() && in.integer<int>("the vertex marker flag") != 0;
    if (dimension != 3)
      in.fail(Kind::unreadable, "the dimension is " + std::to_string(dimension) + ", not 3");
    if (count == 0) return false;
    if (count > std::numeric_limits<Index>::max()) in.fail(Kind::unreadable, "there are too many vertices");

    plc_.vertices.reserve(count);
    if (markers) plc_.vertex_markers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      Label vertex{"vertex", plc_.first_index + i};
      in.need_line(vertex);
      const auto number = in.integer<long long>("the number", vertex);
      if (i == 0) {
        if (number != 0 && number != 1) {
          in.fail(Kind::bad_index, "the first vertex has number " + std::to_string(number) + ", not 0 or 1");
        }
        plc_.first_index = vertex.number = static_cast<std::size_t>(number);
      } else if (number != static_cast<long long>(plc_.first_index) + static_cast<long long>(i)) {
        in.fail(Kind::bad_index, "vertex number " + std::to_string(number) + " stands where " +
                                     std::to_string(plc_.first_index + i) + " is due");
      }
      const auto p = in.point(vertex);
      plc_.vertices.emplace_back(p[0], p[1], p[2]);
      for (std::size_t a = 0; a < attributes; ++a) in.real("an attribute", vertex);
      if (markers) plc_.vertex_markers.push_back(in.integer<int>("the marker", vertex));
    }
    return true;
  }

  void read_node_file() {
    const std::filesystem::path path = node_file(in_.path());
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
      in_.fail(Kind::empty, "there are no vertices, and no file '" + path.string() + "' that holds them");
    }
    const File_text text(path);
    Line_scanner nodes(text.view(), path);
    nodes.need_line("the number of vertices");
    if (!read_vertices(nodes)) nodes.fail(Kind::empty, "there are no vertices");
  }

  void read_facets() {
    in_.need_line("the number of facets");
    const std::size_t count = in_.count("the number of facets");
    const bool markers = !in_.at_end_of_line() && in_.integer<int>("the facet marker flag") != 0;
    if (count == 0) in_.fail(Kind::empty, "there are no facets");
    plc_.facets.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Label label{"facet", plc_.first_index + i};
      in_.need_line(label);
      Facet facet;
      if (format_ == Tetgen_format::poly) {
        read_poly_facet(facet, markers, label);
      } else {
        facet.polygons.push_back(read_polygon(label));
        if (markers && !in_.at_end_of_line()) facet.marker = in_.integer<int>("the marker", label);
      }
      keep(std::move(facet));
    }
  }

  void read_poly_facet(Facet& facet, bool markers, Label label) {
    const std::size_t polygons = in_.count("the number of polygons", label);
    const std::size_t holes = in_.at_end_of_line() ? 0 : in_.count("the number of holes", label);
    if (markers && !in_.at_end_of_line()) facet.marker = in_.integer<int>("the marker", label);
    if (polygons == 0) in_.fail(Kind::degenerate_facet, label.text() + " has no polygon");
    for (std::size_t j = 0; j < polygons; ++j) {
      in_.need_line("a polygon", label);
      facet.polygons.push_back(read_polygon(label));
      if (!in_.at_end_of_line()) {
        in_.fail(Kind::unreadable,
                 "a polygon of " + label.text() + " has more vertices on its line than it announces");
      }
    }
    for (std::size_t j = 0; j < holes; ++j) {
      in_.need_line("a hole", label);
      in_.integer<long long>("the number of a hole", label);
      const auto p = in_.point({"a hole of facet", label.number});
      facet.holes.emplace_back(p[0], p[1], p[2]);
    }
  }

  /// A vertex count and as many vertex numbers, which may go on over several lines.
  std::vector<Index> read_polygon(Label label) {
    const std::size_t size = in_.count("the number of vertices of a polygon", label);
    if (size == 0) in_.fail(Kind::degenerate_facet, "a polygon of " + label.text() + " has no vertices");
    std::vector<Index> polygon(size);
    for (Index& vertex : polygon) {
      if (in_.at_end_of_line()) in_.need_line("a vertex", label);
      const auto number = in_.integer<long long>("a vertex", label);
      const auto first = static_cast<long long>(plc_.first_index);
      const auto last = first + static_cast<long long>(plc_.vertices.size()) - 1;
      if (number < first || number > last) {
        in_.fail(Kind::bad_index, label.text() + " names vertex " + std::to_string(number) +
                                      ", which is not in " + std::to_string(first) + ".." +
                                      std::to_string(last));
      }
      vertex = static_cast<Index>(number - first);
    }
    if (polygon.size() > 3 && polygon.front() == polygon.back()) polygon.pop_back();
    return polygon;
  }

  /// Keeps a facet; one that is nothing but segments stands for explicit segments.
  void keep(Facet facet) {
    bool only_segments = facet.holes.empty();
    for (const auto& polygon : facet.polygons) only_segments = only_segments && polygon.size() == 2;
    if (!only_segments) {
      plc_.facets.push_back(std::move(facet));
      return;
    }
    for (const auto& polygon : facet.polygons)
      plc_.segments.push_back({polygon[0], polygon[1], facet.marker});
  }

  /// False when the file ends before; the hole and the region list may be left out.
  bool read_holes() {
    if (!in_.next_line()) return false;
    const std::size_t count = in_.count("the number of holes");
    for (std::size_t i = 0; i < count; ++i) {
      const Label hole{"hole", plc_.first_index + i};
      in_.need_line(hole);
      in_.integer<long long>("the number", hole);
      const auto p = in_.point(hole);
      plc_.holes.emplace_back(p[0], p[1], p[2]);
    }
    return true;
  }

  void read_regions() {
    if (!in_.next_line()) return;
    const std::size_t count = in_.count("the number of regions");
    for (std::size_t i = 0; i < count; ++i) {
      const Label label{"region", plc_.first_index + i};
      in_.need_line(label);
      in_.integer<long long>("the number", label);
      const auto p = in_.point(label);
      Plc_region<Default_kernel> region;
      region.point = Point_3(p[0], p[1], p[2]);
      const double attribute = in_.real("the attribute", label);
      if (!(attribute >= std::numeric_limits<int>::min() && attribute <= std::numeric_limits<int>::max()) ||
          attribute != std::floor(attribute)) {
        in_.fail(Kind::unreadable,
                 "the attribute of " + label.text() + " is not an integer, so it cannot name a region");
      }
      region.id = static_cast<int>(attribute);
      const double volume = in_.at_end_of_line() ? -1 : in_.real("the largest volume", label);
      if (!std::isfinite(volume))
        in_.fail(Kind::unreadable, "the largest volume of " + label.text() + " is not finite");
      region.max_volume = volume > 0 ? volume : 0;
      plc_.regions.push_back(region);
    }
    if (in_.next_line()) in_.fail(Kind::unreadable, "there is text after the last region");
  }

  Line_scanner in_;
  Tetgen_format format_;
  Plc plc_;
};

}  // namespace

Plc read_tetgen(const std::filesystem::path& path, Tetgen_format format) {
  const File_text text(path);
  return Tetgen_reader(text.view(), path, format).read();
}

bool has_node_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const File_text text(path);
  Line_scanner in(text.view(), path);
  return in.next_line() && in.word() == "0";
}

}  // namespace pgdr::io_detail
