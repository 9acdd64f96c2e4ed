// SPDX-License-Identifier: GPL-3.0-or-later
// Random walls between the cells of a cubic lattice: what the facets tell, against a flood fill of the cells.
#include "catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/plc_from_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/domain/volumes_3.h>

#include "domain/shapes.h"

using namespace pgdr_test;

namespace {

/// A PLC of unit squares, and which cells are connected.
struct Lattice {
  explicit Lattice(std::mt19937& random)
      : size(4 + static_cast<int>(random() % 4)), joined(static_cast<std::size_t>(size * size * size)) {
    const unsigned density = random() % 9;
    const bool with_markers = random() % 2 != 0;
    for (std::size_t c = 0; c < cells(); ++c)
      for (int k = 0; k < 3; ++k) {
        std::array<int, 3> next = position(c);
        if (++next[static_cast<std::size_t>(k)] == size) continue;
        const bool both_outer = outer(position(c)) && outer(next);
        if (both_outer || random() % 10 >= density)
          joined.union_set(c, cell(next));
        else
          add_wall(next, static_cast<std::size_t>(k), with_markers ? static_cast<int>(random() % 3) : 0,
                   random() % 4);
      }
    std::shuffle(plc.facets.begin(), plc.facets.end(), random);
  }

  std::size_t cells() const { return static_cast<std::size_t>(size * size * size); }
  std::size_t cell(const std::array<int, 3>& p) const {
    return static_cast<std::size_t>((p[0] * size + p[1]) * size + p[2]);
  }
  std::array<int, 3> position(std::size_t c) const {
    const int i = static_cast<int>(c);
    return {i / (size * size), i / size % size, i % size};
  }

  int size;
  boost::disjoint_sets_with_storage<> joined;
  Plc plc;

 private:
  bool outer(const std::array<int, 3>& p) const {
    return std::any_of(p.begin(), p.end(), [&](int x) { return x == 0 || x == size - 1; });
  }

  void add_wall(const std::array<int, 3>& corner, std::size_t axis, int marker, unsigned shape) {
    std::array<Index, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<int, 3> p = corner;
      p[(axis + 1) % 3] += i == 1 || i == 2;
      p[(axis + 2) % 3] += i >= 2;
      const auto [found, is_new] = vertices_.try_emplace(p, static_cast<Index>(plc.vertices.size()));
      if (is_new) plc.vertices.emplace_back(p[0], p[1], p[2]);
      c[i] = found->second;
    }
    // As a square of either orientation, or as two triangles.
    const std::vector<std::vector<std::vector<Index>>> shapes{{{c[0], c[1], c[2], c[3]}},
                                                              {{c[3], c[2], c[1], c[0]}},
                                                              {{c[0], c[1], c[2]}, {c[2], c[0], c[3]}},
                                                              {{c[1], c[2], c[3]}, {c[0], c[1], c[3]}}};
    for (const auto& polygon : shapes[shape]) plc.facets.push_back({{polygon}, {}, marker});
  }

  std::map<std::array<int, 3>, Index> vertices_;
};

void check(Lattice& lattice, bool tilt) {
  std::map<std::size_t, double> cells_of;
  for (std::size_t c = 0; c < lattice.cells(); ++c) cells_of[lattice.joined.find_set(c)] += 1;
  cells_of.erase(lattice.joined.find_set(0));
  std::vector<double> expected;
  for (const auto& [root, n] : cells_of) expected.push_back(n);
  std::sort(expected.begin(), expected.end());

  const auto d = pgdr::make_domain_3(tilt ? tilted(lattice.plc) : lattice.plc);
  CHECK(count(pgdr::validate_domain_3(d), pgdr::Input_problem::Kind::self_intersection) == 0);
  const auto volumes = pgdr::volumes_3(d);
  std::vector<double> found;
  for (const pgdr::Volume& v : volumes.volumes())
    if (!v.outside) found.push_back(v.volume);
  std::sort(found.begin(), found.end());
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]));

  Plc centers;
  for (std::size_t c = 0; c < lattice.cells(); ++c) {
    const auto p = lattice.position(c);
    centers.vertices.emplace_back(p[0] + 0.5, p[1] + 0.5, p[2] + 0.5);
  }
  if (tilt) centers = tilted(centers);
  std::map<std::size_t, std::size_t> volume_of;
  bool located = true;
  for (std::size_t c = 0; c < lattice.cells(); ++c) {
    const std::size_t v = volumes.locate(centers.vertices[c]);
    located = located && volume_of.try_emplace(lattice.joined.find_set(c), v).first->second == v;
  }
  CHECK(located);

  const auto again = pgdr::make_domain_3(pgdr::plc_from_domain_3(d));
  REQUIRE(again.facets.size() == d.facets.size());
  REQUIRE(again.segments.size() == d.segments.size());
  bool same = true;
  for (std::size_t f = 0; f < d.facets.size(); ++f)
    same = same && again.facets[f].segments == d.facets[f].segments &&
           again.facets[f].vertices == d.facets[f].vertices &&
           again.facets[f].triangles.size() == d.facets[f].triangles.size();
  CHECK(same);
}

}  // namespace

TEST_CASE("walls in a lattice enclose what a flood fill finds") {
  std::mt19937 random(20);
  for (int i = 0; i < 60; ++i) {
    INFO("lattice " << i);
    Lattice lattice(random);
    if (!lattice.plc.facets.empty()) check(lattice, i % 2 != 0);
  }
}
