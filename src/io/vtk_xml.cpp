// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_xml.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include <zlib.h>

#include <pgdr/domain/input_error.h>

#include "file_text.h"
#include "numbers.h"

namespace pgdr::io_detail {

static_assert(std::endian::native == std::endian::little, "arrays are copied as they stand in the file");

/// An element of the header: its tag with attributes, and what is between it and its end.
struct Vtk_xml::Element {
  std::string_view tag, content;
};

std::string_view Vtk_xml::attribute(std::string_view tag, const std::string& name) {
  for (std::size_t at = 0; (at = tag.find(name, at)) != std::string_view::npos; ++at) {
    std::size_t i = at + name.size();
    if (at == 0 || (tag[at - 1] != ' ' && tag[at - 1] != '\n' && tag[at - 1] != '\t' && tag[at - 1] != '\r')) continue;
    while (i < tag.size() && (tag[i] == ' ' || tag[i] == '=')) ++i;
    if (i >= tag.size() || (tag[i] != '"' && tag[i] != '\'')) continue;
    const std::size_t end = tag.find(tag[i], i + 1);
    if (end != std::string_view::npos) return tag.substr(i + 1, end - i - 1);
  }
  return {};
}

/// The first element of a kind from a place in the text on.
std::optional<Vtk_xml::Element> Vtk_xml::find_element(std::string_view text, const std::string& name, std::size_t from) {
  for (std::size_t at = from; (at = text.find("<" + name, at)) != std::string_view::npos; ++at) {
    const std::size_t after = at + 1 + name.size();
    if (after >= text.size() || (text[after] != ' ' && text[after] != '>' && text[after] != '/' && text[after] != '\n' && text[after] != '\r' && text[after] != '\t')) continue;
    std::size_t end = after;
    for (char quote = 0; end < text.size() && (quote != 0 || text[end] != '>'); ++end)
      if (quote != 0 ? text[end] == quote : text[end] == '"' || text[end] == '\'') quote = quote != 0 ? 0 : text[end];
    if (end == text.size()) return std::nullopt;
    const std::string_view tag = text.substr(at, end - at);
    if (tag.ends_with('/')) return Element{tag, text.substr(end + 1, 0)};
    const std::size_t close = text.find("</" + name, end);
    if (close == std::string_view::npos) return std::nullopt;
    return Element{tag, text.substr(end + 1, close - end - 1)};
  }
  return std::nullopt;
}

/// A stream of bytes that are stored as such or in base64; each block of base64 begins anew.
class Vtk_xml::Bytes {
 public:
  Bytes(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  /// The next `count` bytes; false where there are not so many.
  bool read(std::size_t count, std::string& out) {
    out.clear();
    if (!is_base64_) {
      if (count > text_.size()) return false;
      out = text_.substr(0, count);
      text_.remove_prefix(count);
      return true;
    }
    if (count > text_.size()) return false;
    while (out.size() < count) {
      std::uint32_t bits = 0;
      int digits = 0, padding = 0;
      for (; digits < 4 && !text_.empty(); text_.remove_prefix(1)) {
        const char c = text_.front();
        const int value = 'A' <= c && c <= 'Z' ? c - 'A' : 'a' <= c && c <= 'z' ? c - 'a' + 26 : '0' <= c && c <= '9' ? c - '0' + 52 : c == '+' ? 62 : c == '/' ? 63 : c == '=' ? 0 : -1;
        if (value < 0) {
          if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
          return false;
        }
        padding += c == '=';
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        ++digits;
      }
      if (digits < 4) return false;
      for (int k = 0; k < 3 - padding; ++k) out += static_cast<char>(bits >> (16 - 8 * k) & 0xff);
      if (padding > 0 && out.size() < count) return false;
    }
    out.resize(count);  // the rest of a block of base64 that goes on is read anew by `part`
    return true;
  }

  /// What stands behind a header of `bytes` bytes that was encoded by itself.
  Bytes behind(std::size_t bytes) const {
    if (!is_base64_) return Bytes(text_.substr(std::min(bytes, text_.size())), false);
    std::string_view rest = text_;
    std::size_t skip = (bytes + 2) / 3 * 4;
    while (skip > 0 && !rest.empty()) {
      const char c = rest.front();
      rest.remove_prefix(1);
      skip -= c != ' ' && c != '\n' && c != '\r' && c != '\t';
    }
    return Bytes(rest, true);
  }

 private:
  std::string_view text_;
  bool is_base64_;
};

namespace {

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  constexpr std::string_view blanks = " \t\r\n";
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    double value = std::nan("");
    parse_real(text.substr(at, end - at), value);
    numbers.push_back(value);
    at = text.find_first_not_of(blanks, end);
  }
  return numbers;
}

}  // namespace

Vtk_xml::Vtk_xml(std::string_view text, const std::filesystem::path& path) : path_(path) {
  std::size_t header = text.find("<AppendedData");
  if (header != std::string_view::npos) {
    const std::size_t end = text.find('>', header), begin = text.find('_', end);
    if (begin == std::string_view::npos) fail("its appended data have no beginning");
    appended_base64_ = attribute(text.substr(header, end - header), "encoding") == "base64";
    appended_ = text.substr(begin + 1);
    text = text.substr(0, header);
  }
  text_ = text;
  const auto file = text_.find("<VTKFile");
  if (file == std::string_view::npos) fail("it is no VTK XML file");
  const std::string_view tag = text_.substr(file, text_.find('>', file) - file);
  type_ = attribute(tag, "type");
  if (attribute(tag, "byte_order") == "BigEndian") fail("its numbers begin with their highest byte, which is not read");
  const auto compressor = attribute(tag, "compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") fail("it is compressed by " + std::string(compressor) + ", which is not read");
  is_compressed_ = !compressor.empty();
  wide_ = attribute(tag, "header_type") == "UInt64";
  if (const auto first = text_.find("<Piece"); first != std::string_view::npos && text_.find("<Piece", first + 1) != std::string_view::npos)
    fail("it has several pieces, which is not read");
}

template <class Visit>
void Vtk_xml::for_each_array(const std::string& section, const Visit& visit) const {
  const auto data = find_element(text_, section);
  if (!data) return;
  for (std::size_t at = 0; const auto e = find_element(data->content, "DataArray", at);) {
    at = static_cast<std::size_t>(e->tag.data() - data->content.data()) + 1;
    visit(*e);
  }
}

std::optional<std::vector<double>> Vtk_xml::array(const std::string& section, const std::string& name, std::size_t components) const {
  std::optional<Element> found;
  for_each_array(section, [&](const Element& e) {
    const std::string_view text = attribute(e.tag, "NumberOfComponents");
    std::size_t n = 1;
    if (!text.empty()) parse_integer(text, n);
    if (!found && (name.empty() || attribute(e.tag, "Name") == name) && n == components) found = e;
  });
  if (!found) return std::nullopt;
  return numbers(*found);
}

std::vector<std::string> Vtk_xml::names(const std::string& section) const {
  std::vector<std::string> names;
  for_each_array(section, [&](const Element& e) { names.emplace_back(attribute(e.tag, "Name")); });
  return names;
}

std::vector<Vtk_xml::Group> Vtk_xml::groups() const {
  std::vector<Group> groups;
  for_each_array("FieldData", [&](const Element& e) {
    if (attribute(e.tag, "NumberOfTuples") != "2" || attribute(e.tag, "type") == "String") return;
    const std::vector<double> pair = numbers(e);
    constexpr double most = 2147483647;
    if (pair.size() != 2 || !(std::abs(pair[0]) <= most) || !(pair[1] == 2 || pair[1] == 3)) return;
    std::string name(attribute(e.tag, "Name"));
    for (const auto& [coded, plain] : {std::pair<std::string, std::string>{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}})
      for (std::size_t at = 0; (at = name.find(coded, at)) != std::string::npos; at += plain.size()) name.replace(at, coded.size(), plain);
    groups.push_back({std::move(name), static_cast<int>(pair[0]), static_cast<int>(pair[1])});
  });
  return groups;
}

std::vector<double> Vtk_xml::attribute_numbers(const std::string& element, const std::string& name) const {
  const auto e = find_element(text_, element);
  return e ? numbers_in(attribute(e->tag, name)) : std::vector<double>{};
}

void Vtk_xml::fail(const std::string& what) const { fail_at(path_, 0, Input_problem::Kind::unreadable, what); }

std::vector<double> Vtk_xml::numbers(const Element& array) const {
  const std::string_view format = attribute(array.tag, "format");
  const std::string_view data = array.content.substr(0, array.content.find('<'));  // behind it VTK tells more of the array
  if (format == "ascii") return numbers_in(data);
  if (format == "binary") return decoded(Bytes(data, true), attribute(array.tag, "type"));
  std::size_t offset = 0;
  if (format != "appended" || !parse_integer(attribute(array.tag, "offset"), offset) || offset > appended_.size())
    fail("an array has a format or an offset that VTK does not have");
  return decoded(Bytes(appended_.substr(offset), appended_base64_), attribute(array.tag, "type"));
}

std::uint64_t Vtk_xml::header_number(const std::string& bytes, std::size_t i) const {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + i * header_size(), header_size());
  return value;
}

std::vector<double> Vtk_xml::decoded(Bytes bytes, std::string_view type) const {
  std::string data;
  if (!is_compressed_) {
    std::string all;
    Bytes first = bytes;
    if (!first.read(header_size(), all)) fail_short();
    const std::uint64_t size = header_number(all, 0);
    if (size > text_.size() + appended_.size() || !bytes.read(header_size() + size, all)) fail_short();
    data = all.substr(header_size());
  } else {
    std::string header;
    Bytes first = bytes;
    if (!first.read(3 * header_size(), header)) fail_short();
    const std::uint64_t blocks = header_number(header, 0), block_size = header_number(header, 1), last_size = header_number(header, 2);
    if (blocks > text_.size() + appended_.size()) fail_short();
    const std::size_t header_bytes = (3 + blocks) * header_size();
    Bytes whole = bytes;
    if (!whole.read(header_bytes, header)) fail_short();
    std::size_t compressed = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) compressed += header_number(header, 3 + b);
    Bytes body = bytes.behind(header_bytes);
    std::string packed;
    if (compressed > text_.size() + appended_.size() || !body.read(compressed, packed)) fail_short();
    std::size_t at = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      const std::uint64_t size = b + 1 == blocks && last_size > 0 ? last_size : block_size;
      constexpr std::uint64_t most = std::uint64_t{1} << 30, most_per_byte = 1032;  // which is what deflate can do
      if (header_number(header, 3 + b) > packed.size() - at) fail_short();
      if (size > most || size / most_per_byte > header_number(header, 3 + b)) fail_short();
      const std::size_t old = data.size();
      data.resize(old + size);
      uLongf length = size;
      if (uncompress(reinterpret_cast<Bytef*>(data.data() + old), &length, reinterpret_cast<const Bytef*>(packed.data() + at), header_number(header, 3 + b)) != Z_OK || length != size)
        fail("a block of it cannot be decompressed");
      at += header_number(header, 3 + b);
    }
  }
  return converted(data, type);
}

std::vector<double> Vtk_xml::converted(const std::string& data, std::string_view type) const {
  std::vector<double> numbers;
  const auto all = [&](auto zero) {
    using T = decltype(zero);
    numbers.reserve(data.size() / sizeof(T));
    for (std::size_t i = 0; i + sizeof(T) <= data.size(); i += sizeof(T)) {
      T value;
      std::memcpy(&value, data.data() + i, sizeof(T));
      numbers.push_back(static_cast<double>(value));
    }
    return true;
  };
  const bool is_known = type == "Float64"  ? all(double{})
                        : type == "Float32" ? all(float{})
                        : type == "Int8"    ? all(std::int8_t{})
                        : type == "UInt8"   ? all(std::uint8_t{})
                        : type == "Int16"   ? all(std::int16_t{})
                        : type == "UInt16"  ? all(std::uint16_t{})
                        : type == "Int32"   ? all(std::int32_t{})
                        : type == "UInt32"  ? all(std::uint32_t{})
                        : type == "Int64"   ? all(std::int64_t{})
                        : type == "UInt64"  ? all(std::uint64_t{})
                                            : false;
  if (!is_known) fail("an array has the type '" + std::string(type) + "', which VTK does not have");
  return numbers;
}

}  // namespace pgdr::io_detail
