// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_DIVIDE_SLIVERS_3_H
#define PGDR_SLIVERS_DIVIDE_SLIVERS_3_H

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/refinement/divide_worklist_3.h>
#include <pgdr/refinement/territory_map.h>
#include <pgdr/slivers/sliver_3.h>

namespace pgdr {

/// Slivers, divided among territories.
template <class Tr>
struct Divided_slivers_3 {
  Territories_3<Tr> territories;
  std::vector<std::vector<std::size_t>> parts;  ///< of each: the positions of its slivers, ascending
  std::vector<std::size_t> left;                ///< of those that are in none alone
};

/// With n territories that have about as many slivers each, up to the share of them that is below each cut, and with all threads of the caller's arena.
template <class Tr>
Divided_slivers_3<Tr> divide_slivers(Tr& tr, const Constraint_complex_3<Tr>& complex, const std::vector<Sliver_3<Tr>>& slivers, std::size_t n, double share) {
  const auto for_all = [&slivers](const auto& f) {
    parallel_for_chunks(slivers.size(), default_grain, [&f](std::size_t k, std::size_t end) {
      for (; k < end; ++k) f(k);
    });
  };
  std::vector<Territory_map::Item> sample(slivers.size());
  for_all([&](std::size_t k) {
    const Vec_3 center = slivers[k].center();
    sample[k] = {center, {center, center}};
  });
  Divided_slivers_3<Tr> divided{{tr, {std::move(sample), n, share}}, std::vector<std::vector<std::size_t>>(n), {}};
  const Territory_of_3<Tr> number_of(complex, divided.territories);
  std::vector<std::uint16_t> numbers(slivers.size());
  for_all([&](std::size_t k) { numbers[k] = number_of({slivers[k].cell, slivers[k].generation}); });
  for (std::size_t k = 0; k < slivers.size(); ++k) (numbers[k] == 0 ? divided.left : divided.parts[numbers[k] - 1u]).push_back(k);
  return divided;
}

}  // namespace pgdr

#endif
