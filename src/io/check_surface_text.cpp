// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pgdr/domain/reference_names.h>

#include "line_scanner.h"
#include "readers.h"

namespace pgdr::io_detail {
namespace {

using Kind = Input_problem::Kind;

/// Puts numbers, in full precision, and words into the text that CGAL gets.
class Plain_text {
 public:
  template <class T>
  Plain_text& number(T value) {
    char digits[max_number_length];
    text.append(digits, put_number(digits, value));
    text += ' ';
    return *this;
  }
  Plain_text& word(const char* w) {
    text += w;
    return *this;
  }
  Plain_text& point(const std::array<double, 3>& p) { return number(p[0]).number(p[1]).number(p[2]); }

  std::string text;
};

[[noreturn]] void bad_vertex(const Line_scanner& in, Label facet, long long number, long long first,
                             long long last) {
  in.fail(Kind::bad_index, facet.text() + " names vertex " + std::to_string(number) + ", which is not in " +
                               std::to_string(first) + ".." + std::to_string(last));
}

void check_corner_count(const Line_scanner& in, Label facet, std::size_t count) {
  if (count < 3) {
    in.fail(Kind::degenerate_facet, facet.text() + " has " + std::to_string(count) +
                                        (count == 1 ? " vertex" : " vertices") + ", fewer than three");
  }
}

/// What follows the corners of a face: nothing, the number of a colour in a table, or red, green, blue (and alpha), up to 255 or, with a
/// decimal point, up to 1.
std::string off_color(Line_scanner& in) {
  std::vector<std::string_view> words;
  while (!in.at_end_of_line()) words.push_back(in.word());
  if (words.size() == 1) return "color_" + std::string(words[0]);
  if (words.size() < 3) return {};
  const bool is_share = std::any_of(words.begin(), words.begin() + 3, [](std::string_view w) { return w.find('.') != std::string_view::npos; });
  std::array<double, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!parse_real(words[i], rgb[i])) return {};
    if (is_share) rgb[i] *= 255;
  }
  return color_name(rgb);
}

}  // namespace

Checked_surface check_off(std::string_view text, const std::filesystem::path& path, Markers_from markers) {
  Line_scanner in(text, path);
  in.need_line("the keyword OFF");
  const std::string keyword(in.word());
  // Colours, normals and texture coordinates follow the coordinates on a line; [ST][C][N]OFF announces them.
  if (keyword != "OFF" && keyword != "COFF" && keyword != "NOFF" && keyword != "CNOFF" &&
      keyword != "STOFF" && keyword != "STCOFF" && keyword != "STNOFF" && keyword != "STCNOFF") {
    in.fail(Kind::unreadable, "the file does not begin with the keyword OFF of a three-dimensional surface");
  }
  if (in.at_end_of_line()) in.need_line("the number of vertices");
  if (text.find("BINARY") < text.find('\n'))
    in.fail(Kind::unreadable, "binary OFF files are not read, only ASCII ones");
  Checked_surface result;
  result.vertices = in.count("the number of vertices");
  if (in.at_end_of_line()) in.need_line("the number of facets");
  result.facets = in.count("the number of facets");

  Plain_text plain;
  plain.word("OFF\n").number(result.vertices).number(result.facets).word("0\n");
  for (std::size_t i = 0; i < result.vertices; ++i) {
    in.need_line({"vertex", i});
    plain.point(in.point({"vertex", i})).word("\n");
  }
  for (std::size_t i = 0; i < result.facets; ++i) {
    const Label facet{"facet", i};
    in.need_line(facet);
    const std::size_t size = in.count("the number of vertices", facet);
    check_corner_count(in, facet, size);
    plain.number(size);
    for (std::size_t j = 0; j < size; ++j) {
      const auto vertex = in.integer<long long>("a vertex", facet);
      const auto last = static_cast<long long>(result.vertices) - 1;
      if (vertex < 0 || vertex > last) bad_vertex(in, facet, vertex, 0, last);
      plain.number(vertex);
    }
    plain.word("\n");
    if (markers != Markers_from::colors) continue;
    result.groups.enter(off_color(in));
    result.groups.add_facet();
  }
  result.text = std::move(plain.text);
  return result;
}

Checked_surface check_obj(std::string_view text, const std::filesystem::path& path, Markers_from markers) {
  struct Corner {
    long long vertex;  ///< 1-based, relative ones resolved
    std::size_t line;
    std::size_t facet;
  };
  Line_scanner in(text, path);
  Checked_surface result;
  Plain_text vertices, facets;
  const bool named = markers == Markers_from::names;
  std::string object, group, material;
  Corner highest{0, 0, 0};  // a face may come before its vertices, so this is looked at when all are known
  while (in.next_line()) {
    const std::string_view keyword = in.word();
    if (keyword == "v") {
      ++result.vertices;
      vertices.word("v ").point(in.point({"vertex", result.vertices})).word("\n");
    } else if (keyword == "f" || keyword == "fo") {
      const Label facet{"facet", ++result.facets};
      facets.word("f ");
      std::size_t corners = 0;
      for (; !in.at_end_of_line(); ++corners) {
        std::string_view corner = in.word();
        const bool continued = corner.back() == '\\';  // the face goes on in the next line
        if (continued) corner.remove_suffix(1);
        if (continued && in.at_end_of_line()) in.need_line("a vertex", facet);
        if (corner.empty()) corner = in.word();
        long long vertex = 0;  // of vertex/texture/normal
        if (!parse_integer(corner.substr(0, corner.find('/')), vertex)) {
          in.fail(Kind::unreadable, "a vertex of " + facet.text() + " is not an integer");
        }
        const auto known = static_cast<long long>(result.vertices);
        if (vertex == 0 || vertex < -known) bad_vertex(in, facet, vertex, 1, known);
        if (vertex < 0) vertex += known + 1;
        if (vertex > highest.vertex) highest = {vertex, in.line(), result.facets};
        facets.number(vertex);
      }
      check_corner_count(in, facet, corners);
      facets.word("\n");
      if (!named) continue;
      result.groups.enter({group.empty() ? object : group, material});
      result.groups.add_facet();
    } else if (named && (keyword == "o" || keyword == "g" || keyword == "usemtl")) {
      (keyword == "o" ? object : keyword == "g" ? group : material) = in.rest();
    }
    // Everything else (normals, lines, ...) is no part of the surface.
  }
  if (highest.vertex > static_cast<long long>(result.vertices)) {
    fail_at(path, highest.line, Kind::bad_index,
            "facet " + std::to_string(highest.facet) + " names vertex " + std::to_string(highest.vertex) +
                ", which is not in 1.." + std::to_string(result.vertices));
  }
  result.text = std::move(vertices.text) + facets.text;
  return result;
}

namespace {

constexpr std::size_t stl_header = 80, stl_triangle = 50;

std::size_t little_endian_32(std::string_view bytes, std::size_t offset) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::size_t(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
  return value;
}

Checked_surface check_binary_stl(std::string_view text, const std::filesystem::path& path) {
  if (text.size() < stl_header + 4)
    fail_at(path, 0, Kind::unreadable, "the file ends within the header of a binary STL file");
  Checked_surface result;
  result.facets = little_endian_32(text, stl_header);
  const std::size_t room = (text.size() - stl_header - 4) / stl_triangle;
  if (room < result.facets) {
    const auto is_text = [](char c) { return (' ' <= c && c <= '~') || c == '\n' || c == '\r' || c == '\t'; };
    if (std::ranges::all_of(text.substr(0, stl_header + 4), is_text))
      fail_at(path, 0, Kind::unreadable, "the file is text, but does not begin with 'solid' as STL files that are text do");
    fail_at(path, 0, Kind::unreadable,
            "the file announces " + std::to_string(result.facets) + " triangles, but ends after " +
                std::to_string(room));
  }
  for (std::size_t i = 0; i < result.facets; ++i) {
    for (std::size_t j = 3; j < 12; ++j) {
      const auto bits =
          static_cast<std::uint32_t>(little_endian_32(text, stl_header + 4 + i * stl_triangle + 4 * j));
      if (std::isfinite(std::bit_cast<float>(bits))) continue;
      fail_at(path, 0, Kind::bad_coordinate,
              "triangle " + std::to_string(i) + " has a coordinate that is not finite");
    }
  }
  // A header that begins with "solid" would have CGAL try the file as text first.
  result.text = std::string(stl_header, '\0');
  result.text += text.substr(stl_header);
  return result;
}

/// One corner or one keyword per line is what writers do, but blanks are all that the format asks for.
Checked_surface check_ascii_stl(std::string_view text, const std::filesystem::path& path, Markers_from markers) {
  Line_scanner in(text, path);
  Checked_surface result;
  Plain_text plain;
  plain.word("solid\n");
  bool inside = false, closed = false;
  std::size_t corners = 0;
  while (in.next_line()) {
    while (!in.at_end_of_line()) {
      const std::string word = in_lower_case(in.word());
      const Label facet{"triangle", result.facets};
      if (word == "solid" || word == "endsolid") {
        if (inside) in.fail(Kind::unreadable, facet.text() + " lacks endfacet");
        closed = word == "endsolid";
        std::string name(in.rest_with_comment());  // any words
        if (!closed && markers == Markers_from::names) result.groups.enter(std::move(name));
      } else if (word == "facet") {
        if (inside) in.fail(Kind::unreadable, facet.text() + " lacks endfacet");
        inside = true;
        corners = 0;
        plain.word("facet\n");
      } else if (word == "vertex") {
        if (!inside) in.fail(Kind::unreadable, "a vertex stands outside of every triangle");
        if (++corners > 3) in.fail(Kind::unreadable, facet.text() + " has more than three vertices");
        plain.word("vertex ").point(in.point(facet)).word("\n");
      } else if (word == "endfacet") {
        if (!inside || corners != 3)
          in.fail(Kind::unreadable, facet.text() + " has fewer than three vertices");
        inside = false;
        ++result.facets;
        if (markers == Markers_from::names) result.groups.add_facet();
        plain.word("endfacet\n");
      } else if (word == "normal") {
        for (int i = 0; i < 3 && !in.at_end_of_line(); ++i) in.word();  // not used, so not checked
      } else if (word != "outer" && word != "loop" && word != "endloop") {
        in.fail(Kind::unreadable, "a word that STL does not have stands near " + facet.text());
      }
    }
  }
  if (inside || !closed) in.fail(Kind::unreadable, "the file ends before endsolid");
  plain.word("endsolid\n");
  result.text = std::move(plain.text);
  return result;
}

}  // namespace

Checked_surface check_stl(std::string_view text, const std::filesystem::path& path, Markers_from markers) {
  // Binary files may begin with "solid" as well; their size tells them apart.
  const bool binary_size = text.size() >= stl_header + 4 &&
                           text.size() == stl_header + 4 + stl_triangle * little_endian_32(text, stl_header);
  std::size_t start = 0;
  while (start < text.size() && std::isspace(static_cast<unsigned char>(text[start]))) ++start;
  const bool solid = in_lower_case(text.substr(start, 5)) == "solid";
  if (text.empty()) fail_at(path, 0, Kind::empty, "the file is empty");
  return solid && !binary_size ? check_ascii_stl(text, path, markers) : check_binary_stl(text, path);
}

}  // namespace pgdr::io_detail
