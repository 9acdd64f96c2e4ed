// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/write_poly.h>

#include <cstddef>
#include <string_view>

#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>

#include "numbers.h"

namespace pgdr {
namespace {

class Poly_writer {
 public:
  Poly_writer(const Plc& plc, Atomic_file& out) : plc_(plc), out_(out) {}

  void write() {
    write_vertices();
    write_facets();
    write_holes();
    write_regions();
  }

 private:
  void write_vertices() {
    const bool markers = !plc_.vertex_markers.empty();
    out_.write("# vertices\n");
    numbers(plc_.vertices.size(), 3, 0, markers ? 1 : 0).end_line();
    for (std::size_t i = 0; i < plc_.vertices.size(); ++i) {
      numbers(plc_.first_index + i).point(plc_.vertices[i]);
      if (markers) numbers(plc_.vertex_markers[i]);
      end_line();
    }
  }

  void write_facets() {
    out_.write("# facets\n");
    numbers(plc_.facets.size() + plc_.segments.size(), 1).end_line();
    for (const auto& facet : plc_.facets) {
      numbers(facet.polygons.size(), facet.holes.size(), facet.marker).end_line();
      for (const auto& polygon : facet.polygons) {
        numbers(polygon.size());
        for (const Index vertex : polygon) numbers(plc_.first_index + vertex);
        end_line();
      }
      for (std::size_t i = 0; i < facet.holes.size(); ++i) {
        numbers(plc_.first_index + i).point(facet.holes[i]).end_line();
      }
    }
    for (const Plc_segment& segment : plc_.segments) {
      numbers(1, 0, segment.marker).end_line();
      numbers(2, plc_.first_index + segment.source, plc_.first_index + segment.target).end_line();
    }
  }

  void write_holes() {
    out_.write("# holes\n");
    numbers(plc_.holes.size()).end_line();
    for (std::size_t i = 0; i < plc_.holes.size(); ++i)
      numbers(plc_.first_index + i).point(plc_.holes[i]).end_line();
  }

  void write_regions() {
    out_.write("# regions: point, attribute, largest volume or -1\n");
    numbers(plc_.regions.size()).end_line();
    for (std::size_t i = 0; i < plc_.regions.size(); ++i) {
      const auto& region = plc_.regions[i];
      numbers(plc_.first_index + i).point(region.point).numbers(region.id);
      if (region.max_volume > 0)
        numbers(std::ldexp(region.max_volume, 3 * plc_.exponent)).end_line();
      else
        numbers(-1).end_line();
    }
  }

  template <class... T>
  Poly_writer& numbers(T... values) {
    (number(values), ...);
    return *this;
  }

  Poly_writer& point(const Plc::Point_3& p) { return numbers(unit_ * p.x(), unit_ * p.y(), unit_ * p.z()); }

  template <class T>
  void number(T value) {
    char text[io_detail::max_number_length + 1];
    char* begin = text;
    if (!first_in_line_) *begin++ = ' ';
    first_in_line_ = false;
    out_.write(text, static_cast<std::size_t>(io_detail::put_number(begin, value) - text));
  }

  void end_line() {
    out_.write("\n");
    first_in_line_ = true;
  }

  const Plc& plc_;
  Atomic_file& out_;
  double unit_ = unit_of(plc_);
  bool first_in_line_ = true;
};

}  // namespace

void write_poly(const Plc& plc, const std::filesystem::path& path) {
  Atomic_file out(path);
  Poly_writer(plc, out).write();
  out.commit();
}

}  // namespace pgdr
