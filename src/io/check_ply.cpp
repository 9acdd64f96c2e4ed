// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "file_text.h"
#include "numbers.h"
#include "readers.h"

namespace pgdr::io_detail {
namespace {

using Kind = Input_problem::Kind;

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

std::optional<Type> type_of(std::string_view name) {
  static constexpr std::pair<const char*, Type> names[] = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& [known, type] : names) {
    if (name == known) return type;
  }
  return std::nullopt;
}

std::size_t size_of(Type type) {
  switch (type) {
    case Type::i8:
    case Type::u8:
      return 1;
    case Type::i16:
    case Type::u16:
      return 2;
    case Type::i32:
    case Type::u32:
    case Type::f32:
      return 4;
    case Type::f64:
      break;
  }
  return 8;
}

struct Property {
  std::string name;
  Type type = Type::f64;
  std::optional<Type> size_type;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

/// Walks through a PLY file, header and values, the way that CGAL's reader does.
class Ply_checker {
 public:
  Ply_checker(std::string_view text, const std::filesystem::path& path, Markers_from markers)
      : text_(text), path_(path), is_colored_(markers == Markers_from::colors) {}

  Checked_surface check() {
    read_header();
    for (const Element& element : elements_) {
      if (element.name == "vertex") result_.vertices = element.count;
    }
    for (const Element& element : elements_) {
      for (std::size_t i = 0; i < element.count; ++i) check_item(element, i);
      if (element.name == "face") result_.facets = element.count;
    }
    result_.text = text_;
    return std::move(result_);
  }

 private:
  void read_header() {
    std::size_t line = 0;
    for (;;) {
      if (next_ >= text_.size()) fail_line(line, "the file ends before end_header");
      const std::size_t end = std::min(text_.find('\n', next_), text_.size());
      const std::vector<std::string> words = split(text_.substr(next_, end - next_));
      next_ = end + 1;
      ++line;
      if (line == 1) {
        if (words != std::vector<std::string>{"ply"})
          fail_line(line, "the file does not begin with the keyword ply");
      } else if (line == 2) {
        read_format(words);
      } else if (words.empty()) {
        fail_line(line, "a line of the header is empty");
      } else if (words[0] == "element") {
        read_element(words, line);
      } else if (words[0] == "property") {
        read_property(words, line);
      } else if (words[0] == "end_header") {
        break;
      }
    }
    check_properties(line);
  }

  void read_format(const std::vector<std::string>& words) {
    const std::string format = words.size() == 3 && words[0] == "format" ? words[1] : std::string();
    if (format == "ascii")
      encoding_ = Encoding::ascii;
    else if (format == "binary_little_endian")
      encoding_ = Encoding::little_endian;
    else if (format == "binary_big_endian")
      encoding_ = Encoding::big_endian;
    else
      fail_line(2, "it does not name the format ascii, binary_little_endian or binary_big_endian");
  }

  void read_element(const std::vector<std::string>& words, std::size_t line) {
    Element element;
    if (words.size() != 3 || !parse_integer(words[2], element.count))
      fail_line(line, "an element needs a name and a count");
    if (element.count > text_.size()) {
      fail_line(line,
                "the file announces " + words[2] + " times " + words[1] + ", but is too short for that");
    }
    element.name = words[1] == "vertices" ? "vertex" : words[1] == "faces" ? "face" : words[1];
    for (const Element& other : elements_) {
      if (other.name == element.name) fail_line(line, "the element " + element.name + " is there twice");
    }
    elements_.push_back(std::move(element));
  }

  void read_property(const std::vector<std::string>& words, std::size_t line) {
    const bool list = words.size() == 5 && words[1] == "list";
    if (elements_.empty() || (!list && words.size() != 3))
      fail_line(line, "a property needs a type and a name");
    Property property;
    property.name = words.back();
    const auto type = type_of(words[words.size() - 2]);
    if (list) property.size_type = type_of(words[2]);
    if (!type || (list && (!property.size_type || *property.size_type > Type::u32))) {
      fail_line(line, "the property " + property.name + " has a type that PLY does not have");
    }
    property.type = *type;
    elements_.back().properties.push_back(std::move(property));
  }

  void check_properties(std::size_t line) const {
    for (const Element& element : elements_) {
      if (element.properties.empty() && element.count > 0)
        fail_line(line, "the element " + element.name + " has no properties");
      int coordinates = 0, lists = 0;
      for (const Property& p : element.properties) {
        if (p.name == "x" || p.name == "y" || p.name == "z")
          coordinates += !p.size_type && p.type >= Type::f32;
        if (is_corner_list(p)) lists += p.type == Type::i32 || p.type == Type::u32;
      }
      if (element.name == "vertex" && coordinates != 3)
        fail_line(line, "a vertex needs the properties x, y and z of a floating-point type");
      if (element.name == "face" && lists != 1)
        fail_line(line, "a face needs the property vertex_indices, a list of 32-bit integers");
    }
  }

  void check_item(const Element& element, std::size_t number) {
    const bool is_face = element.name == "face", is_vertex = element.name == "vertex";
    std::array<double, 3> rgb{};
    bool has_color = false;
    const auto owner = [&] { return element.name + " " + std::to_string(number); };
    for (const Property& property : element.properties) {
      if (!property.size_type) {
        const double value = read(property.type, owner);
        const bool coordinate =
            is_vertex && (property.name == "x" || property.name == "y" || property.name == "z");
        if (coordinate && !std::isfinite(value)) {
          fail(Kind::bad_coordinate, "the " + property.name + " coordinate of " + owner() + " is not finite");
        }
        for (std::size_t k = 0; k < 3; ++k) {
          if (property.name != colors[k]) continue;
          rgb[k] = property.type < Type::f32 ? value : 255 * value;
          has_color = true;
        }
        continue;
      }
      const double size = read(*property.size_type, owner);
      const bool corners = is_face && is_corner_list(property);
      if (size < 0 || (corners && size < 3)) {
        fail(Kind::degenerate_facet,
             owner() + " has a list of " + std::to_string(static_cast<long long>(size)) + " values");
      }
      const auto values = static_cast<std::uint64_t>(std::min(1e18, size));  // the file ends before
      for (std::uint64_t i = 0; i < values; ++i) {
        const double value = read(property.type, owner);
        if (corners && (value < 0 || value >= static_cast<double>(result_.vertices))) {
          fail(Kind::bad_index, owner() + " names vertex " + std::to_string(static_cast<long long>(value)) +
                                    ", which is not in 0.." +
                                    std::to_string(static_cast<long long>(result_.vertices) - 1));
        }
      }
    }
    if (!is_face || !is_colored_) return;
    result_.groups.enter(has_color ? color_name(rgb) : std::string());
    result_.groups.add_facet();
  }

  static constexpr std::string_view colors[3] = {"red", "green", "blue"};

  static bool is_corner_list(const Property& p) {
    return p.size_type && (p.name == "vertex_indices" || p.name == "vertex_index");
  }

  template <class Owner>
  double read(Type type, const Owner& owner) {
    if (encoding_ == Encoding::ascii) return read_word(type, owner);
    const std::size_t size = size_of(type);
    if (next_ > text_.size() || text_.size() - next_ < size)
      fail(Kind::unreadable, "the file ends within " + owner());
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = encoding_ == Encoding::little_endian ? i : size - 1 - i;
      bits |= std::uint64_t(static_cast<unsigned char>(text_[next_ + i])) << (8 * place);
    }
    next_ += size;
    switch (type) {
      case Type::i8:
        return static_cast<std::int8_t>(bits);
      case Type::i16:
        return static_cast<std::int16_t>(bits);
      case Type::i32:
        return static_cast<std::int32_t>(bits);
      case Type::f32:
        return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
      case Type::f64:
        return std::bit_cast<double>(bits);
      case Type::u8:
      case Type::u16:
      case Type::u32:
        break;
    }
    return static_cast<double>(bits);
  }

  template <class Owner>
  double read_word(Type type, const Owner& owner) {
    constexpr std::string_view blanks = " \t\r\n";
    next_ = std::min(text_.find_first_not_of(blanks, std::min(next_, text_.size())), text_.size());
    if (next_ == text_.size()) fail(Kind::unreadable, "the file ends within " + owner());
    const std::size_t end = std::min(text_.find_first_of(blanks, next_), text_.size());
    const std::string_view word = text_.substr(next_, end - next_);
    double value = 0;
    long long integer = 0;
    const bool real = type >= Type::f32;
    if (real ? !parse_real(word, value) : !parse_integer(word, integer)) {
      fail(Kind::unreadable, "a value of " + owner() + (real ? " is not a number" : " is not an integer"));
    }
    next_ = end;
    if (type == Type::f32 && std::abs(value) > std::numeric_limits<float>::max()) {
      return std::numeric_limits<double>::infinity();
    }
    if (real) return value;
    const unsigned bits = static_cast<unsigned>(8 * size_of(type));
    const bool is_signed = type == Type::i8 || type == Type::i16 || type == Type::i32;
    const long long lowest = is_signed ? -(1LL << (bits - 1)) : 0;
    const long long highest = is_signed ? (1LL << (bits - 1)) - 1 : (1LL << bits) - 1;
    if (integer < lowest || integer > highest)
      fail(Kind::unreadable, "a value of " + owner() + " does not fit its type");
    return static_cast<double>(integer);
  }

  static std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < line.size();) {
      const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
      if (end > begin) words.emplace_back(line.substr(begin, end - begin));
      begin = end + 1;
    }
    return words;
  }

  [[noreturn]] void fail_line(std::size_t line, const std::string& what) const {
    fail_at(path_, line, Kind::unreadable, what);
  }
  [[noreturn]] void fail(Kind kind, const std::string& what) const {
    fail_at(path_, encoding_ == Encoding::ascii ? line_of(text_, next_) : 0, kind, what);
  }

  std::string_view text_;
  std::filesystem::path path_;
  bool is_colored_;
  std::size_t next_ = 0;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  Checked_surface result_;
};

}  // namespace

Checked_surface check_ply(std::string_view text, const std::filesystem::path& path, Markers_from markers) {
  return Ply_checker(text, path, markers).check();
}

}  // namespace pgdr::io_detail
