// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_SORT_TETRAHEDRA_H
#define PGDR_REFINEMENT_SORT_TETRAHEDRA_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/refinement/canonical_order.h>

namespace pgdr::internal {

/// Tetrahedra in the order in which they were found, with numbers of vertices that are not final, and labels.
///
/// The arrays have room for more than there are; what is not used is never touched, so that it takes no memory.
struct Tetrahedron_pool {
  /// `count` tetrahedra from `position` on.
  struct Run {
    std::size_t position = 0;
    std::size_t count = 0;
  };

  /// `labels`: how many different ones there are.
  Tetrahedron_pool(std::size_t capacity, std::size_t labels)
      : vertices(std::make_unique_for_overwrite<std::array<std::uint32_t, 4>[]>(capacity)) {
    if (labels <= 256)
      small_labels = std::make_unique_for_overwrite<std::uint8_t[]>(capacity);
    else
      large_labels = std::make_unique_for_overwrite<std::uint32_t[]>(capacity);
  }

  std::size_t label(std::size_t i) const { return small_labels ? small_labels[i] : large_labels[i]; }
  void set_label(std::size_t i, std::size_t label) {
    if (small_labels)
      small_labels[i] = static_cast<std::uint8_t>(label);
    else
      large_labels[i] = static_cast<std::uint32_t>(label);
  }

  std::unique_ptr<std::array<std::uint32_t, 4>[]> vertices;
  std::unique_ptr<std::uint8_t[]> small_labels;
  std::unique_ptr<std::uint32_t[]> large_labels;
  std::vector<Run> runs;
};

/// Sorts tetrahedra in two steps, each of which works on parts of its own: first into buckets of consecutive smallest
/// vertices, then within the buckets, which fit into a processor's own cache.
class Tetrahedron_sorter {
  using Tetrahedron = std::array<std::uint32_t, 4>;

 public:
  /// `number`: the final number of each vertex, below `vertices`.
  Tetrahedron_sorter(Tetrahedron_pool pool, const std::vector<std::uint32_t>& number, std::size_t vertices)
      : pool_(std::move(pool)), number_(number), vertices_(vertices) {
    cut_into_slabs();
    while ((vertices_ >> shift_) * bucket_size > size_ && shift_ < 31) ++shift_;
    buckets_ = (vertices_ >> shift_) + 1;
  }

  /// Fills the arrays with the tetrahedra in canonical order; the reference of label l is `references_of[l]`.
  void sort(const std::vector<std::int32_t>& references_of, std::vector<Tetrahedron>& tetrahedra,
            std::vector<std::int32_t>& references) {
    std::vector<std::size_t> begin = make_canonical();
    const std::vector<std::size_t> begin_of_bucket = add_up(begin);
    tetrahedra.resize(size_);
    references.resize(size_);
    parallel_for(0, slabs_.size() - 1, [&](std::size_t slab) {
      std::size_t* const next = &begin[slab * buckets_];
      for_each_of_slab(slab, [&](std::size_t i) {
        const Tetrahedron& t = pool_.vertices[i];
        const std::size_t to = next[t[0] >> shift_]++;
        tetrahedra[to] = t;
        references[to] = references_of[pool_.label(i)];
      });
    });
    { const Tetrahedron_pool gone = std::move(pool_); }
    parallel_for(0, buckets_, [&](std::size_t b) {
      const std::size_t first = begin_of_bucket[b];
      sort_bucket(b << shift_, begin_of_bucket[b + 1] - first, tetrahedra.data() + first, references.data() + first);
    });
  }

 private:
  struct Element {
    Tetrahedron vertices;
    std::int32_t reference;
    bool operator<(const Element& o) const { return vertices < o.vertices; }
  };

  static constexpr std::size_t bucket_size = 8192;  ///< tetrahedra, about
  static constexpr std::size_t max_slabs = 128;

  /// A slab is what one task counts and moves: consecutive runs.
  void cut_into_slabs() {
    for (const auto& run : pool_.runs) size_ += run.count;
    const std::size_t target = size_ / max_slabs + 1;
    std::size_t in_slab = 0;
    slabs_.push_back(0);
    for (std::size_t r = 0; r < pool_.runs.size(); ++r) {
      in_slab += pool_.runs[r].count;
      if (in_slab < target && r + 1 < pool_.runs.size()) continue;
      slabs_.push_back(r + 1);
      in_slab = 0;
    }
  }

  template <class F>
  void for_each_of_slab(std::size_t slab, const F& f) const {
    for (std::size_t r = slabs_[slab]; r < slabs_[slab + 1]; ++r)
      for (std::size_t i = 0; i < pool_.runs[r].count; ++i) f(pool_.runs[r].position + i);
  }

  /// Renumbers the vertices and counts the tetrahedra of each bucket, slab by slab.
  std::vector<std::size_t> make_canonical() {
    std::vector<std::size_t> counts((slabs_.size() - 1) * buckets_);
    parallel_for(0, slabs_.size() - 1, [&](std::size_t slab) {
      std::size_t* const count = &counts[slab * buckets_];
      for_each_of_slab(slab, [&](std::size_t i) {
        Tetrahedron& t = pool_.vertices[i];
        t = canonical(Tetrahedron{number_[t[0]], number_[t[1]], number_[t[2]], number_[t[3]]});
        ++count[t[0] >> shift_];
      });
    });
    return counts;
  }

  /// Turns the counts into where each slab's part of each bucket begins; returns where the buckets begin.
  std::vector<std::size_t> add_up(std::vector<std::size_t>& counts) const {
    std::vector<std::size_t> begin_of_bucket;
    begin_of_bucket.reserve(buckets_ + 1);
    std::size_t sum = 0;
    for (std::size_t b = 0; b < buckets_; ++b) {
      begin_of_bucket.push_back(sum);
      for (std::size_t i = b; i < counts.size(); i += buckets_) {
        const std::size_t count = counts[i];
        counts[i] = sum;
        sum += count;
      }
    }
    begin_of_bucket.push_back(sum);
    return begin_of_bucket;
  }

  /// Sorts `n` tetrahedra whose smallest vertices are among the 2^shift_ from `base` on: by counting these, and what
  /// has the same one, a handful, by insertion.
  void sort_bucket(std::size_t base, std::size_t n, Tetrahedron* tetrahedra, std::int32_t* references) const {
    if (n < 2) return;
    std::vector<std::uint32_t> end(std::min(vertices_ - base, std::size_t{1} << shift_) + 1);
    for (std::size_t i = 0; i < n; ++i) ++end[tetrahedra[i][0] - base + 1];
    for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
    const auto sorted = std::make_unique_for_overwrite<Element[]>(n);
    for (std::size_t i = 0; i < n; ++i) sorted[end[tetrahedra[i][0] - base]++] = {tetrahedra[i], references[i]};
    std::size_t begin = 0;
    for (std::size_t v = 0; v + 1 < end.size(); begin = end[v++]) sort_group(&sorted[begin], sorted.get() + end[v]);
    for (std::size_t i = 0; i < n; ++i) {
      tetrahedra[i] = sorted[i].vertices;
      references[i] = sorted[i].reference;
    }
  }

  static void sort_group(Element* first, Element* last) {
    if (last - first > 32) return std::sort(first, last);
    for (Element* i = first; i < last; ++i) {
      const Element e = *i;
      Element* j = i;
      for (; j != first && e < j[-1]; --j) *j = j[-1];
      *j = e;
    }
  }

  Tetrahedron_pool pool_;
  const std::vector<std::uint32_t>& number_;
  std::size_t vertices_;
  std::size_t size_ = 0;
  std::vector<std::size_t> slabs_;  ///< slab s has the runs [slabs_[s], slabs_[s + 1])
  unsigned shift_ = 0;              ///< a bucket has 2^shift_ smallest vertices
  std::size_t buckets_ = 0;
};

}  // namespace pgdr::internal

#endif
