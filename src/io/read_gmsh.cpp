// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/io/gmsh.h>

#include "file_text.h"
#include "numbers.h"

namespace pgdr {
namespace {

using Kind = Input_problem::Kind;

/// What Gmsh numbers the types of elements by.
constexpr int line = 1, triangle = 2, tetrahedron = 4, line_3 = 8, triangle_6 = 9, tetrahedron_10 = 11, single_point = 15;

/// How many nodes an element has; 0 for types that are not read.
std::size_t nodes_of(int type) {
  static const std::map<int, std::size_t> nodes{{line, 2}, {triangle, 3}, {3, 4}, {tetrahedron, 4}, {line_3, 3}, {triangle_6, 6}, {10, 9}, {tetrahedron_10, 10}, {single_point, 1}, {16, 8}};
  const auto found = nodes.find(type);
  return found == nodes.end() ? 0 : found->second;
}

/// Steps through the numbers of a file, text or binary.
class Numbers {
 public:
  Numbers(std::string_view text, const std::filesystem::path& path) : text_(text), path_(path) {}

  bool is_binary = false;

  [[noreturn]] void fail(const std::string& what, Kind kind = Kind::unreadable) const {
    io_detail::fail_at(path_, is_binary ? 0 : io_detail::line_of(text_, std::min(at_, text_.size())), kind, what);
  }

  /// To the line after the next "$Name"; the name, empty at the end of the file.
  std::string next_section() {
    while (at_ < text_.size()) {
      const std::string_view l = rest_of_line();
      if (!l.empty() && l[0] == '$') return std::string(l.substr(1));
    }
    return {};
  }

  void skip_section(const std::string& name) {
    const std::size_t end = text_.find("$End" + name, at_);
    if (end == std::string_view::npos) fail("the section $" + name + " has no end");
    at_ = end;
    rest_of_line();
  }

  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view l = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    while (!l.empty() && is_blank(l.back())) l.remove_suffix(1);
    return l;
  }

  std::string_view word() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  template <class T>
  T next(const char* what) {
    T value{};
    if (is_binary) {
      if (text_.size() - at_ < sizeof value) fail(std::string("the file ends before ") + what);
      std::memcpy(&value, text_.data() + at_, sizeof value);
      at_ += sizeof value;
    } else {
      const std::string_view token = word();
      bool is_number;
      if constexpr (std::is_floating_point_v<T>) is_number = io_detail::parse_real(token, value);
      else is_number = io_detail::parse_integer(token, value);
      if (!is_number) fail(std::string(what) + " is not a number that fits");
    }
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(value)) fail(std::string(what) + " is not finite", Kind::bad_coordinate);
    return value;
  }

  /// Of things that take at least a byte each: a wrong one fails before memory is asked for.
  std::size_t count(const char* what) {
    const auto value = next<std::uint64_t>(what);
    if (value > text_.size() - at_) fail(std::string(what) + " is " + std::to_string(value) + ", but the file is too short for that");
    return value;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

  std::string_view text_;
  std::filesystem::path path_;
  std::size_t at_ = 0;
};

class Gmsh_reader {
 public:
  Gmsh_reader(std::string_view text, const std::filesystem::path& path) : in_(text, path) {}

  Indexed_mesh_3 read() {
    if (in_.next_section() != "MeshFormat") in_.fail("it does not begin with $MeshFormat");
    read_format();
    for (std::string name = in_.next_section(); !name.empty(); name = in_.next_section()) {
      if (name.starts_with("End")) continue;
      if (name == "PhysicalNames") read_names();
      else if (name == "Entities") read_entities();
      else if (name == "Nodes") is_version_4_ ? read_nodes() : read_nodes_2();
      else if (name == "Elements") is_version_4_ ? read_elements() : read_elements_2();
      else if (name == "PartitionedEntities") in_.fail("a mesh in partitions is not read: save it without");
      else in_.skip_section(name);
    }
    if (mesh_.points.empty()) in_.fail("it has no nodes", Kind::empty);
    mesh_.point_references.assign(mesh_.points.size(), 0);
    return std::move(mesh_);
  }

 private:
  void read_format() {
    const std::string version(in_.word());
    is_version_4_ = version == "4.1";
    const bool is_binary = in_.next<int>("the type of the file") == 1;
    const int size = in_.next<int>("the size of numbers");
    if (!is_version_4_ && (version.substr(0, 2) != "2." || is_binary)) in_.fail("of Gmsh's formats 4.1 and, as text, 2.2 are read, not " + version + (is_binary ? " binary" : ""));
    in_.rest_of_line();
    if (!is_binary) return;
    in_.is_binary = true;
    if (size != 8 || in_.next<std::int32_t>("the number 1") != 1) in_.fail("its numbers have other sizes, or another order of bytes, than here");
  }

  /// Names may hold any character but quotes.
  void read_names() {
    const bool was_binary = std::exchange(in_.is_binary, false);  // always text
    for (std::size_t n = in_.count("the number of names"); n > 0; --n) {
      const int dimension = in_.next<int>("the dimension of a name"), tag = in_.next<int>("the tag of a name");
      std::string_view name = in_.rest_of_line();
      name.remove_prefix(std::min(name.find('"'), name.size()));
      if (name.size() < 2 || name.back() != '"') in_.fail("the name of a physical group is not in quotes");
      name = name.substr(1, name.size() - 2);
      if (dimension == 3) mesh_.names.regions[tag] = name;
      if (dimension == 2) mesh_.names.markers[tag] = name;
    }
    in_.is_binary = was_binary;
  }

  void read_entities() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& n : counts) n = in_.count("the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t n = counts[static_cast<std::size_t>(dimension)]; n > 0; --n) {
        const auto tag = in_.next<std::int32_t>("the tag of an entity");
        for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) in_.next<double>("the box of an entity");
        for (std::size_t k = in_.count("the number of physical tags"); k > 0; --k) {
          const auto physical = in_.next<std::int32_t>("a physical tag");
          physical_.try_emplace({dimension, tag}, std::abs(std::max(physical, -std::numeric_limits<std::int32_t>::max())));  // negative where it is turned around
        }
        if (dimension > 0)
          for (std::size_t k = in_.count("the number of bounding entities"); k > 0; --k) in_.next<std::int32_t>("a bounding entity");
      }
  }

  void add_node(std::uint64_t tag, const std::array<double, 3>& p) {
    if (!nodes_.empty() && nodes_.back().first >= tag) are_ascending_ = false;
    nodes_.emplace_back(tag, static_cast<std::uint32_t>(nodes_.size()));
    mesh_.points.push_back(p);
    if (nodes_.size() == std::numeric_limits<std::uint32_t>::max()) in_.fail("it has too many nodes");
  }

  void finish_nodes() {
    if (are_ascending_) return;
    std::ranges::sort(nodes_);
    const auto same = std::ranges::adjacent_find(nodes_, {}, &std::pair<std::uint64_t, std::uint32_t>::first);
    if (same != nodes_.end()) in_.fail("node " + std::to_string(same->first) + " is there twice");
  }

  std::array<double, 3> point() {
    std::array<double, 3> p;
    for (double& x : p) x = in_.next<double>("a coordinate of a node");
    return p;
  }

  void read_nodes() {
    const std::size_t blocks = in_.count("the number of blocks of nodes");
    for (int i = 0; i < 3; ++i) in_.next<std::uint64_t>("the number of nodes");
    std::vector<std::uint64_t> tags;
    for (std::size_t b = 0; b < blocks; ++b) {
      const auto dimension = in_.next<std::int32_t>("the dimension of nodes");
      in_.next<std::int32_t>("the entity of nodes");
      const bool is_parametric = in_.next<std::int32_t>("whether nodes are parametric") != 0;
      tags.resize(in_.count("the number of nodes of a block"));
      for (std::uint64_t& tag : tags) tag = in_.next<std::uint64_t>("the tag of a node");
      for (const std::uint64_t tag : tags) {
        add_node(tag, point());
        for (int i = 0; is_parametric && i < std::clamp(dimension, 0, 3); ++i) in_.next<double>("a parameter of a node");
      }
    }
    finish_nodes();
  }

  void read_nodes_2() {
    for (std::size_t n = in_.count("the number of nodes"); n > 0; --n) {
      const auto tag = in_.next<std::uint64_t>("the number of a node");
      add_node(tag, point());
    }
    finish_nodes();
  }

  std::uint32_t node(std::uint64_t tag) const {
    // Mostly all of them, one after the other.
    if (!nodes_.empty() && tag >= nodes_[0].first && tag - nodes_[0].first < nodes_.size())
      if (const auto& n = nodes_[tag - nodes_[0].first]; n.first == tag) return n.second;
    const auto found = std::ranges::lower_bound(nodes_, tag, {}, &std::pair<std::uint64_t, std::uint32_t>::first);
    if (found == nodes_.end() || found->first != tag) in_.fail("an element names node " + std::to_string(tag) + ", which is not there", Kind::bad_index);
    return found->second;
  }

  /// Nodes beyond the corners are in the middle of edges.
  void read_element(int type, std::int32_t reference) {
    const std::size_t nodes = nodes_of(type);
    if (nodes == 0) in_.fail("it has elements of type " + std::to_string(type) + ", and only tetrahedra, triangles and lines can be refined");
    std::array<std::uint32_t, 4> c{};
    for (std::size_t i = 0; i < nodes; ++i) {
      const std::uint32_t v = node(in_.next<std::uint64_t>("the node of an element"));
      if (i < c.size()) c[i] = v;
    }
    if (type == tetrahedron || type == tetrahedron_10) {
      mesh_.tetrahedra.push_back(c);
      mesh_.tetrahedron_references.push_back(reference);
    } else if (type == triangle || type == triangle_6) {
      mesh_.triangles.push_back({c[0], c[1], c[2]});
      mesh_.triangle_references.push_back(reference);
    } else if ((type == line || type == line_3) && reference != 0) {  // others only say where surfaces end
      mesh_.edges.push_back({c[0], c[1]});
      mesh_.edge_references.push_back(reference);
    }
  }

  void read_elements() {
    const std::size_t blocks = in_.count("the number of blocks of elements");
    for (int i = 0; i < 3; ++i) in_.next<std::uint64_t>("the number of elements");
    for (std::size_t b = 0; b < blocks; ++b) {
      const auto dimension = in_.next<std::int32_t>("the dimension of elements");
      const auto entity = in_.next<std::int32_t>("the entity of elements");
      const auto type = in_.next<std::int32_t>("the type of elements");
      const auto physical = physical_.find({dimension, entity});
      const std::int32_t reference = physical == physical_.end() ? 0 : physical->second;
      for (std::size_t n = in_.count("the number of elements of a block"); n > 0; --n) {
        in_.next<std::uint64_t>("the number of an element");
        read_element(type, reference);
      }
    }
  }

  void read_elements_2() {
    for (std::size_t n = in_.count("the number of elements"); n > 0; --n) {
      in_.next<std::uint64_t>("the number of an element");
      const int type = in_.next<int>("the type of an element");
      const std::size_t tags = in_.count("the number of tags");
      std::int32_t reference = 0;
      for (std::size_t i = 0; i < tags; ++i) {
        const auto tag = in_.next<std::int32_t>("the tag of an element");
        if (i == 0) reference = tag;
      }
      read_element(type, reference);
    }
  }

  Numbers in_;
  bool is_version_4_ = true;
  bool are_ascending_ = true;
  Indexed_mesh_3 mesh_;
  std::map<std::pair<int, std::int32_t>, std::int32_t> physical_;  ///< of entities, by dimension and tag
  std::vector<std::pair<std::uint64_t, std::uint32_t>> nodes_;     ///< tags and positions; ascending when elements are read
};

}  // namespace

Indexed_mesh_3 read_gmsh(const std::filesystem::path& path) {
  const io_detail::File_text text(path);
  return Gmsh_reader(text.view(), path).read();
}

}  // namespace pgdr
