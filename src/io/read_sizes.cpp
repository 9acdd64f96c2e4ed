// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML formats: K. Martin et al., VTK file formats, "XML file formats".
#include <pgdr/io/read_sizes.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <zlib.h>

#include "file_text.h"
#include "numbers.h"
#include "readers.h"

namespace pgdr {
namespace {

using Kind = Input_problem::Kind;

/// An element of the header: its tag with attributes, and what is between it and its end.
struct Element {
  std::string_view tag, content;
};

std::string_view attribute(std::string_view tag, const std::string& name) {
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
std::optional<Element> find_element(std::string_view text, const std::string& name, std::size_t from = 0) {
  for (std::size_t at = from; (at = text.find("<" + name, at)) != std::string_view::npos; ++at) {
    const std::size_t after = at + 1 + name.size();
    if (after >= text.size() || (text[after] != ' ' && text[after] != '>' && text[after] != '/' && text[after] != '\n' && text[after] != '\r' && text[after] != '\t')) continue;
    const std::size_t end = text.find('>', after);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view tag = text.substr(at, end - at);
    if (tag.ends_with('/')) return Element{tag, text.substr(end + 1, 0)};
    const std::size_t close = text.find("</" + name, end);
    if (close == std::string_view::npos) return std::nullopt;
    return Element{tag, text.substr(end + 1, close - end - 1)};
  }
  return std::nullopt;
}

/// A stream of bytes that are stored as such or in base64; each block of base64 begins anew.
class Bytes {
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

class Vtk_reader {
 public:
  Vtk_reader(std::string_view text, const std::filesystem::path& path) : path_(path) {
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

  Nodal_values read(const std::string& array) const {
    if (type_ == "UnstructuredGrid") return read_grid(array);
    if (type_ == "ImageData") return read_image(array);
    fail("it holds '" + std::string(type_) + "', not an unstructured grid or image data");
  }

 private:
  Nodal_values read_grid(const std::string& array) const {
    const auto points = find_element(text_, "Points");
    const auto coordinates = points ? find_element(points->content, "DataArray") : std::nullopt;
    if (!coordinates) fail("it has no points");
    const std::vector<double> c = numbers(*coordinates);
    if (c.size() % 3 != 0) fail("its points have no three coordinates each");
    Nodal_values nodes;
    for (std::size_t i = 0; i + 2 < c.size(); i += 3) nodes.points.push_back({c[i], c[i + 1], c[i + 2]});
    const auto [values, is_of_cells] = values_of(array);
    if (!is_of_cells) {
      nodes.values = values;
    } else {
      nodes = averaged(std::move(nodes), values);
    }
    if (nodes.values.size() != nodes.points.size())
      fail("its array '" + array + "' has " + std::to_string(nodes.values.size()) + " values for " + std::to_string(nodes.points.size()) + " points");
    return nodes;
  }

  /// Values of cells at their nodes; nodes of no cell are left out.
  Nodal_values averaged(Nodal_values nodes, const std::vector<double>& of_cells) const {
    const auto cells = find_element(text_, "Cells");
    std::vector<double> connectivity, offsets;
    if (cells)
      for (std::size_t at = 0; const auto e = find_element(cells->content, "DataArray", at);) {
        at = static_cast<std::size_t>(e->tag.data() - cells->content.data()) + 1;
        if (attribute(e->tag, "Name") == "connectivity") connectivity = numbers(*e);
        if (attribute(e->tag, "Name") == "offsets") offsets = numbers(*e);
      }
    if (offsets.size() != of_cells.size()) fail("it has " + std::to_string(of_cells.size()) + " values for " + std::to_string(offsets.size()) + " cells");
    std::vector<double> sum(nodes.points.size()), count(nodes.points.size());
    std::size_t i = 0;
    for (std::size_t cell = 0; cell < offsets.size(); ++cell)
      for (; static_cast<double>(i) < offsets[cell]; ++i) {
        if (i >= connectivity.size() || !(connectivity[i] >= 0 && connectivity[i] < static_cast<double>(sum.size()))) fail("its cells name points that are not there");
        const auto v = static_cast<std::size_t>(connectivity[i]);
        sum[v] += of_cells[cell];
        count[v] += 1;
      }
    Nodal_values result;
    for (std::size_t v = 0; v < sum.size(); ++v)
      if (count[v] > 0) {
        result.points.push_back(nodes.points[v]);
        result.values.push_back(sum[v] / count[v]);
      }
    return result;
  }

  Nodal_values read_image(const std::string& array) const {
    const auto image = find_element(text_, "ImageData");
    const auto extent = image ? numbers_in(attribute(image->tag, "WholeExtent")) : std::vector<double>{};
    if (extent.size() != 6) fail("its image has no extent");
    auto origin = numbers_in(attribute(image->tag, "Origin")), spacing = numbers_in(attribute(image->tag, "Spacing"));
    origin.resize(3, 0);
    spacing.resize(3, 1);
    const auto [values, is_of_cells] = values_of(array);
    Nodal_values nodes;
    const double shift = is_of_cells ? 0.5 : 0;
    const auto last = [&](std::size_t d) { return extent[2 * d + 1] - (is_of_cells ? 1 : 0); };
    if (!((last(0) - extent[0] + 1) * (last(1) - extent[2] + 1) * (last(2) - extent[4] + 1) == static_cast<double>(values.size())))
      fail("its array '" + array + "' does not fit the image's extent");
    for (double z = extent[4]; z <= last(2); ++z)
      for (double y = extent[2]; y <= last(1); ++y)
        for (double x = extent[0]; x <= last(0); ++x)
          nodes.points.push_back({origin[0] + (x + shift) * spacing[0], origin[1] + (y + shift) * spacing[1], origin[2] + (z + shift) * spacing[2]});
    nodes.values = values;
    return nodes;
  }

  /// Of points, else of cells.
  std::pair<std::vector<double>, bool> values_of(const std::string& array) const {
    std::string known;
    for (const bool is_of_cells : {false, true}) {
      const auto data = find_element(text_, is_of_cells ? "CellData" : "PointData");
      if (!data) continue;
      for (std::size_t at = 0; const auto e = find_element(data->content, "DataArray", at);) {
        at = static_cast<std::size_t>(e->tag.data() - data->content.data()) + 1;
        const std::string_view name = attribute(e->tag, "Name");
        const std::string_view components = attribute(e->tag, "NumberOfComponents");
        if (name == array && (components.empty() || components == "1")) return {numbers(*e), is_of_cells};
        known += (known.empty() ? "" : ", ") + std::string(name);
      }
    }
    fail("it has no array '" + array + "' of one component" + (known.empty() ? "" : ", but " + known));
  }

  static std::vector<double> numbers_in(std::string_view text) {
    std::vector<double> numbers;
    constexpr std::string_view blanks = " \t\r\n";
    for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
      double value = std::nan("");
      io_detail::parse_real(text.substr(at, end - at), value);
      numbers.push_back(value);
      at = text.find_first_not_of(blanks, end);
    }
    return numbers;
  }

  std::vector<double> numbers(const Element& array) const {
    const std::string_view format = attribute(array.tag, "format");
    const std::string_view data = array.content.substr(0, array.content.find('<'));  // behind it VTK tells more of the array
    if (format == "ascii") return numbers_in(data);
    if (format == "binary") return decoded(Bytes(data, true), attribute(array.tag, "type"));
    std::size_t offset = 0;
    if (format != "appended" || !io_detail::parse_integer(attribute(array.tag, "offset"), offset) || offset > appended_.size())
      fail("an array has a format or an offset that VTK does not have");
    return decoded(Bytes(appended_.substr(offset), appended_base64_), attribute(array.tag, "type"));
  }

  std::uint64_t header_number(const std::string& bytes, std::size_t i) const {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + i * header_size(), header_size());
    return value;
  }
  std::size_t header_size() const { return wide_ ? 8 : 4; }

  std::vector<double> decoded(Bytes bytes, std::string_view type) const {
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
        constexpr std::uint64_t most = std::uint64_t{1} << 30;
        if (size > most) fail_short();
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

  std::vector<double> converted(const std::string& data, std::string_view type) const {
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

  [[noreturn]] void fail_short() const { fail("an array ends before it should"); }
  [[noreturn]] void fail(const std::string& what) const { io_detail::fail_at(path_, 0, Kind::unreadable, what); }

  std::filesystem::path path_;
  std::string_view text_, appended_, type_;
  bool appended_base64_ = false, is_compressed_ = false, wide_ = false;
};

}  // namespace

Nodal_values read_nodal_values(const std::filesystem::path& path, const std::string& array) {
  static_assert(std::endian::native == std::endian::little, "arrays are copied as they stand in the file");
  const io_detail::File_text text(path);
  Nodal_values values = Vtk_reader(text.view(), path).read(array);
  if (values.points.empty()) io_detail::fail_at(path, 0, Kind::empty, "it has no points");
  return values;
}

}  // namespace pgdr
