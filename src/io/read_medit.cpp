// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pgdr/domain/reference_names.h>
#include <pgdr/io/medit.h>

#include "file_text.h"
#include "numbers.h"

namespace pgdr {
namespace {

using io_detail::parse_real;
using Kind = Input_problem::Kind;

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

class Medit_reader {
 public:
  Medit_reader(std::string_view text, const std::filesystem::path& path)
      : text_(text), path_(path), next_(text.data()), end_(text.data() + text.size()) {}

  Indexed_mesh_3 read() {
    if (keyword() != "meshversionformatted")
      fail(Kind::unreadable, "the file does not begin with MeshVersionFormatted");
    integer("the version");
    for (std::string section = keyword(); section != "end"; section = keyword()) {
      if (section == "dimension")
        read_dimension();
      else if (section == "vertices")
        read_points();
      else if (section == "edges")
        read_elements("an edge", mesh_.edges, mesh_.edge_references, edges_);
      else if (section == "triangles")
        read_elements("a triangle", mesh_.triangles, mesh_.triangle_references, triangles_);
      else if (section == "tetrahedra")
        read_elements("a tetrahedron", mesh_.tetrahedra, mesh_.tetrahedron_references, tetrahedra_);
      else if (section == "hexahedra" || section == "prisms" || section == "pyramids" ||
               section == "quadrilaterals")
        refuse(section);
      else
        skip_section();
    }
    if (points_ == nullptr) fail(Kind::empty, "there is no section Vertices");
    if (tetrahedra_ == nullptr) fail(Kind::empty, "there is no section Tetrahedra");
    check_indices("an edge", mesh_.edges, edges_);
    check_indices("a triangle", mesh_.triangles, triangles_);
    check_indices("a tetrahedron", mesh_.tetrahedra, tetrahedra_);
    return std::move(mesh_);
  }

 private:
  void read_dimension() {
    if (integer("the dimension") != 3) fail(Kind::unreadable, "the dimension is not 3");
  }

  void read_points() {
    const std::size_t count = begin_section("Vertices", 4, points_);
    mesh_.points.resize(count);
    mesh_.point_references.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (double& x : mesh_.points[i]) {
        x = real("a coordinate");
        if (!std::isfinite(x)) fail(Kind::bad_coordinate, "a coordinate is not finite");
      }
      mesh_.point_references[i] = reference();
    }
  }

  /// Indices are kept 1-based until all sections are known; the vertices may come last.
  template <std::size_t N>
  void read_elements(const char* what, std::vector<std::array<std::uint32_t, N>>& elements,
                     std::vector<std::int32_t>& references, const char*& section) {
    const std::size_t count = begin_section(what, N + 1, section);
    elements.resize(count);
    references.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::uint32_t& vertex : elements[i]) {
        const long long value = integer(what);
        if (value < 1 || value > std::numeric_limits<std::uint32_t>::max()) bad_index(what, value);
        vertex = static_cast<std::uint32_t>(value);
      }
      references[i] = reference();
    }
  }

  template <std::size_t N>
  void check_indices(const char* what, std::vector<std::array<std::uint32_t, N>>& elements,
                     const char* section) {
    const std::size_t count = mesh_.points.size();
    for (std::size_t i = 0; i < elements.size(); ++i) {
      for (std::uint32_t& vertex : elements[i]) {
        if (vertex > count) {
          next_ = section;  // once more up to here, for the line
          for (std::size_t k = 0; k < (i + 1) * (N + 1); ++k) integer(what);
          bad_index(what, vertex);
        }
        --vertex;
      }
    }
  }

  /// Reads the count of a section and remembers where its rows begin.
  std::size_t begin_section(const char* what, std::size_t columns, const char*& section) {
    if (section != nullptr) fail(Kind::unreadable, "a section is there a second time");
    const long long count = integer("the number of rows");
    const long long room = (end_ - next_) / static_cast<long long>(2 * columns) + 1;
    if (count < 0 || count > room) {
      fail(Kind::unreadable,
           "the section announces " + std::to_string(count) + " rows, but the file is too short for that");
    }
    if (count > std::numeric_limits<std::uint32_t>::max())
      fail(Kind::unreadable, std::string("there are too many rows: ") + what);
    section = next_;
    return static_cast<std::size_t>(count);
  }

  void refuse(const std::string& section) {
    if (integer("the number of rows") != 0)
      fail(Kind::unreadable, "the mesh has " + section + ", and only tetrahedral meshes are read");
  }

  /// To the next keyword.
  void skip_section() {
    for (;;) {
      skip_blanks();
      if (next_ == end_ || std::isalpha(static_cast<unsigned char>(*next_))) return;
      word();
    }
  }

  void skip_blanks() {
    while (next_ != end_) {
      if (is_blank(*next_))
        ++next_;
      else if (*next_ == '#')
        while (next_ != end_ && *next_ != '\n') ++next_;
      else
        return;
    }
  }

  std::string_view word() {
    skip_blanks();
    word_ = next_;
    while (next_ != end_ && !is_blank(*next_) && *next_ != '#') ++next_;
    return {word_, static_cast<std::size_t>(next_ - word_)};
  }

  /// The next keyword in lower case.
  std::string keyword() {
    std::string result(word());
    if (result.empty()) fail(Kind::unreadable, "the file ends before the keyword End");
    if (!std::isalpha(static_cast<unsigned char>(result.front()))) {
      fail(Kind::unreadable,
           "a number stands where a keyword is due: the section has more rows than it announces");
    }
    return in_lower_case(result);
  }

  long long integer(const char* what) {
    skip_blanks();
    word_ = next_;
    long long value = 0;
    const auto [end, error] = std::from_chars(next_, end_, value);
    if (error == std::errc() && (end == end_ || is_blank(*end) || *end == '#')) {
      next_ = end;
      return value;
    }
    not_a(what, " is not an integer");
  }

  double real(const char* what) {
    const std::string_view text = word();
    double value = 0;
    if (!parse_real(text, value)) {
      next_ = word_;
      not_a(what, " is not a number");
    }
    return value;
  }

  std::int32_t reference() {
    const long long value = integer("a reference");
    if (value < std::numeric_limits<std::int32_t>::min() ||
        value > std::numeric_limits<std::int32_t>::max()) {
      fail(Kind::unreadable, "a reference does not fit 32 bits");
    }
    return static_cast<std::int32_t>(value);
  }

  [[noreturn]] void bad_index(const char* what, long long value) const {
    fail(Kind::bad_index,
         std::string(what) + " names vertex " + std::to_string(value) + ", which is not there");
  }
  [[noreturn]] void not_a(const char* what, const char* complaint) const {
    if (word_ == end_) fail(Kind::unreadable, std::string("the file ends before ") + what);
    fail(Kind::unreadable, std::string(what) + complaint);
  }
  [[noreturn]] void fail(Kind kind, const std::string& what) const {
    io_detail::fail_at(path_, io_detail::line_of(text_, static_cast<std::size_t>(word_ - text_.data())), kind,
                       what);
  }

  std::string_view text_;
  std::filesystem::path path_;
  const char* next_;
  const char* end_;
  const char* word_ = text_.data();  ///< the last one looked at
  const char* points_ = nullptr;     ///< where the rows of each section begin; null: not there yet
  const char* edges_ = nullptr;
  const char* triangles_ = nullptr;
  const char* tetrahedra_ = nullptr;
  Indexed_mesh_3 mesh_;
};

}  // namespace

Indexed_mesh_3 read_medit(const std::filesystem::path& path) {
  const io_detail::File_text text(path);
  return Medit_reader(text.view(), path).read();
}

}  // namespace pgdr
