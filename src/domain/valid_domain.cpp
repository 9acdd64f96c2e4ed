// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/valid_domain.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <pgdr/domain/bend.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>

namespace pgdr {

bool Understood::is_valid() const { return std::ranges::all_of(problems, &Input_problem::is_warning); }

void Understood::require_valid() const {
  if (!is_valid()) throw Input_error(problems);
}

Understood understand(const Plc& plc, double coplanar_tolerance, bool triangulate, std::size_t max_pairs) {
  Domain_3<Default_kernel> domain = make_domain_3(plc, coplanar_tolerance, triangulate);
  std::vector<Input_problem> problems = validate_domain_3(domain, max_pairs);
  return {std::move(domain), std::move(problems)};
}

Domain_3<Default_kernel> valid_domain(const Plc& plc, double coplanar_tolerance, bool triangulate) {
  Understood understood = understand(plc, coplanar_tolerance, triangulate);
  understood.require_valid();
  return std::move(understood.domain);
}

std::optional<Plc> fused_where_valid(Plc plc, double coplanar_tolerance, bool triangulate) {
  constexpr auto all = std::numeric_limits<std::size_t>::max();
  constexpr Index none = std::numeric_limits<Index>::max();
  try {
    while (true) {
      const Understood understood = understand(plc, coplanar_tolerance, triangulate, all);
      if (understood.is_valid()) return plc;
      const auto& facets = understood.domain.facets;
      std::vector<Index> bent(plc.facets.size(), none);  // of the input facet that a problem names, the one fused of it and others
      for (Index f = 0; f < facets.size(); ++f)
        if (facets[f].input_facets.size() > 1 && bend(understood.domain, f) > 0) bent[facets[f].input_facets[0]] = f;
      for (const Input_problem& problem : understood.problems) {
        if (problem.is_warning()) continue;
        if (std::ranges::all_of(problem.facets, [&](Index i) { return bent[i] == none; })) return std::nullopt;
        for (const Index i : problem.facets)
          if (bent[i] != none)
            for (const Index fused : facets[bent[i]].input_facets) plc.facets[fused].group = fused_with_none;
      }
    }
  } catch (const Input_error&) {  // not even understood
    return std::nullopt;
  }
}

}  // namespace pgdr
