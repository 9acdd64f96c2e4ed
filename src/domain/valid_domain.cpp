// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/valid_domain.h>

#include <algorithm>
#include <utility>
#include <vector>

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

}  // namespace pgdr
