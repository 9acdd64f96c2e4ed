// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_OCTREE_LINEAR_OCTREE_3_H
#define PGDR_OCTREE_LINEAR_OCTREE_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <pgdr/octree/octree_box.h>
#include <pgdr/octree/octree_key.h>

namespace pgdr {

/// An octree as the list of its leaves along the Morton curve; inner nodes are not stored. It never changes: `split`
/// makes a new one. Const members may be called by several threads at once.
///
/// A leaf is known by its index. Leaves are half-open cubes that tile the root; neighbour relations are those of the
/// closed cubes. Lists of leaves are ascending, without repetition, and replace what was in `out`.
class Linear_octree_3 {
 public:
  /// One leaf, the root.
  explicit Linear_octree_3(const Octree_box& box) : Linear_octree_3(box, {Octree_key{}}) {}

  /// Throws `std::invalid_argument` unless `is_valid(leaves)`.
  Linear_octree_3(const Octree_box& box, std::vector<Octree_key> leaves)
      : box_(box), leaves_(std::move(leaves)) {
    if (!is_valid(leaves_)) throw std::invalid_argument("the leaves do not tile the root of the octree");
    index();
  }

  /// All 8^level leaves of a level. Throws `std::invalid_argument` for a level below 0 or above 9.
  static Linear_octree_3 uniform(const Octree_box& box, int level) {
    if (level < 0 || level > 9) throw std::invalid_argument("a uniform octree has 0 to 9 levels");
    std::vector<Octree_key> leaves{Octree_key{}};
    for (int l = 0; l < level; ++l) leaves = children(leaves);
    return {box, std::move(leaves)};
  }

  const Octree_box& box() const { return box_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(leaves_.size()); }
  const Octree_key& operator[](std::uint32_t i) const { return leaves_[i]; }
  const std::vector<Octree_key>& leaves() const { return leaves_; }

  double edge(std::uint32_t i) const { return box_.edge(leaves_[i].level); }
  std::array<double, 3> lower(std::uint32_t i) const { return box_.lower(leaves_[i]); }
  std::array<double, 3> upper(std::uint32_t i) const { return box_.upper(leaves_[i]); }

  /// The leaf that contains `p`; points outside the root are moved to the nearest point of the smallest grid.
  std::uint32_t find(const std::array<double, 3>& p) const { return find_code(box_.locate(p).morton()); }

  /// The leaf that contains the lower corner of a node: the leaf that is or contains the node, or the first below it.
  std::uint32_t find(const Octree_key& node) const { return find_code(node.morton()); }

  /// All leaves that touch leaf `i` in a face, an edge or a corner. O(neighbours * log(size)).
  void touching(std::uint32_t i, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (dx != 0 || dy != 0 || dz != 0) add_beside(leaves_[i], {dx, dy, dz}, out);
        }
      }
    }
    sort_unique(out);
  }

  /// N_alpha(L) of the paper: the leaves that share a piece of a face with leaf `i` in direction 0 to 5, which is
  /// -x, +x, -y, +y, -z, +z. Empty at the boundary of the root.
  void face_neighbors(std::uint32_t i, int direction, std::vector<std::uint32_t>& out) const {
    out.clear();
    add_face_neighbors(i, direction, out);
    sort_unique(out);
  }

  /// BUF(L): what one, two or three steps to face neighbours along different axes reach from leaf `i`, for every
  /// order of the axes and every choice of directions. Never contains `i`; `j` is in BUF(`i`) iff `i` is in BUF(`j`),
  /// since the steps can be walked back.
  void buffer(std::uint32_t i, std::vector<std::uint32_t>& out) const {
    out.clear();
    std::vector<std::uint32_t> first, second, third;
    for (int a = 0; a < 6; ++a) {
      face_neighbors(i, a, first);
      out.insert(out.end(), first.begin(), first.end());
      for (int b = 0; b < 6; ++b) {
        if (b / 2 == a / 2) continue;
        step(first, b, second);
        out.insert(out.end(), second.begin(), second.end());
        const int axis = 3 - a / 2 - b / 2;
        for (int c = 2 * axis; c < 2 * axis + 2; ++c) {
          step(second, c, third);
          out.insert(out.end(), third.begin(), third.end());
        }
      }
    }
    sort_unique(out);
  }

  /// l*(L): the shortest edge among leaf `i` and the leaves that touch it.
  double shortest_touching_edge(std::uint32_t i) const {
    std::vector<std::uint32_t> around;
    touching(i, around);
    int level = leaves_[i].level;
    for (const std::uint32_t j : around) level = std::max(level, static_cast<int>(leaves_[j].level));
    return box_.edge(level);
  }

  /// The octree in which the leaves with `which[i] != 0` are replaced by their children. `parent`, if given, becomes
  /// the index here of every leaf there. Throws `std::invalid_argument` if `which` has not one entry per leaf or
  /// names a leaf of the deepest level.
  Linear_octree_3 split(const std::vector<std::uint8_t>& which,
                        std::vector<std::uint32_t>* parent = nullptr) const {
    if (which.size() != leaves_.size()) throw std::invalid_argument("split: one flag per leaf is needed");
    std::vector<Octree_key> leaves;
    leaves.reserve(leaves_.size() +
                   7 * (which.size() - static_cast<std::size_t>(std::count(which.begin(), which.end(), 0))));
    if (parent) parent->clear();
    for (std::uint32_t i = 0; i < size(); ++i) {
      const int count = which[i] != 0 ? 8 : 1;
      if (count == 8 && leaves_[i].level >= Octree_key::max_level) {
        throw std::invalid_argument("split: a leaf is on the deepest level");
      }
      for (int c = 0; c < count; ++c) leaves.push_back(count == 8 ? leaves_[i].child(c) : leaves_[i]);
      if (parent) parent->insert(parent->end(), static_cast<std::size_t>(count), i);
    }
    return {box_, std::move(leaves)};
  }

  /// Edges of leaves that touch, be it in a corner, differ by a factor of at most 2.
  bool is_balanced() const {
    std::vector<std::uint32_t> around;
    for (std::uint32_t i = 0; i < size(); ++i) {
      touching(i, around);
      for (const std::uint32_t j : around) {
        if (leaves_[j].level > leaves_[i].level + 1) return false;
      }
    }
    return true;
  }

  /// The keys are nodes, sorted, without overlap, and cover the root.
  static bool is_valid(const std::vector<Octree_key>& leaves) {
    std::uint64_t expected = 0;
    for (const Octree_key& key : leaves) {
      if (key.level > Octree_key::max_level) return false;
      if ((key.x | key.y | key.z) >> key.level != 0) return false;
      if (key.morton() != expected) return false;
      expected += key.morton_span();
    }
    return expected == codes;
  }

  bool is_valid() const { return is_valid(leaves_); }

 private:
  static constexpr std::uint64_t codes = std::uint64_t{1} << (3 * Octree_key::max_level);

  static std::vector<Octree_key> children(const std::vector<Octree_key>& keys) {
    std::vector<Octree_key> result;
    result.reserve(8 * keys.size());
    for (const Octree_key& key : keys) {
      for (int c = 0; c < 8; ++c) result.push_back(key.child(c));
    }
    return result;
  }

  static void sort_unique(std::vector<std::uint32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  /// `codes_` for the search, and for every node of one level the leaf of its lower corner: about as many nodes as
  /// leaves, so that a search is within a few leaves.
  void index() {
    codes_.resize(leaves_.size());
    std::transform(leaves_.begin(), leaves_.end(), codes_.begin(),
                   [](const Octree_key& k) { return k.morton(); });
    shift_ = 3 * Octree_key::max_level;
    while (shift_ >= 3 && codes >> (shift_ - 3) <= leaves_.size()) shift_ -= 3;
    first_.resize((codes >> shift_) + 1);
    std::uint32_t leaf = 0;
    for (std::size_t node = 0; node + 1 < first_.size(); ++node) {
      while (leaf + 1 < codes_.size() && codes_[leaf + 1] <= std::uint64_t{node} << shift_) ++leaf;
      first_[node] = leaf;
    }
    first_.back() = size() - 1;
  }

  std::uint32_t find_code(std::uint64_t code) const {
    const std::uint64_t node = code >> shift_;
    const auto begin = codes_.begin() + first_[node];
    const auto end = codes_.begin() + first_[node + 1] + 1;
    return static_cast<std::uint32_t>(std::upper_bound(begin, end, code) - codes_.begin() - 1);
  }

  /// Appends the leaves in the cube of the size of `key` that lies beside it in direction `d` (each -1, 0 or 1) and
  /// that touch `key`, or the leaf that contains that cube.
  void add_beside(const Octree_key& key, const std::array<int, 3>& d, std::vector<std::uint32_t>& out) const {
    const std::int64_t end = std::int64_t{1} << key.level;
    const std::int64_t x = std::int64_t{key.x} + d[0], y = std::int64_t{key.y} + d[1],
                       z = std::int64_t{key.z} + d[2];
    if (x < 0 || y < 0 || z < 0 || x >= end || y >= end || z >= end) return;
    add_touching(Octree_key{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                            static_cast<std::uint32_t>(z), key.level},
                 d, out);
  }

  /// The leaves below `node`, or the one that contains it, that reach its side towards -d.
  void add_touching(const Octree_key& node, const std::array<int, 3>& d,
                    std::vector<std::uint32_t>& out) const {
    const std::uint32_t leaf = find(node);
    if (leaves_[leaf].level <= node.level) {
      out.push_back(leaf);
      return;
    }
    for (int c = 0; c < 8; ++c) {
      bool near = true;
      for (int axis = 0; axis < 3; ++axis) {
        const int upper_half = c >> axis & 1;
        const int towards = d[static_cast<std::size_t>(axis)];
        near = near && (towards == 0 || (towards > 0) == (upper_half == 0));
      }
      if (near) add_touching(node.child(c), d, out);
    }
  }

  void add_face_neighbors(std::uint32_t i, int direction, std::vector<std::uint32_t>& out) const {
    std::array<int, 3> d{};
    d[static_cast<std::size_t>(direction / 2)] = direction % 2 == 0 ? -1 : 1;
    add_beside(leaves_[i], d, out);
  }

  void step(const std::vector<std::uint32_t>& from, int direction, std::vector<std::uint32_t>& to) const {
    to.clear();
    for (const std::uint32_t i : from) add_face_neighbors(i, direction, to);
    sort_unique(to);
  }

  Octree_box box_;
  std::vector<Octree_key> leaves_;
  std::vector<std::uint64_t> codes_;
  std::vector<std::uint32_t> first_;
  int shift_ = 3 * Octree_key::max_level;
};

}  // namespace pgdr

#endif
