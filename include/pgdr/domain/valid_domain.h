// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_VALID_DOMAIN_H
#define PGDR_DOMAIN_VALID_DOMAIN_H

#include <cstddef>
#include <optional>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>

namespace pgdr {

/// A domain and what is wrong with it.
struct Understood {
  Domain_3<Default_kernel> domain;
  std::vector<Input_problem> problems;  ///< of `validate_domain_3`

  /// Whether the problems are only warnings.
  bool is_valid() const;

  /// Throws `Input_error` with all that is wrong, unless these are only warnings.
  void require_valid() const;
};

/// `make_domain_3` and `validate_domain_3` in one, compiled in the library.
/// \param max_pairs see `validate_domain_3`
/// Throws `Input_error` for what cannot be understood at all.
Understood understand(const Plc& plc, double coplanar_tolerance, bool triangulate = false, std::size_t max_pairs = 10);

/// What `understand` understands. Throws `Input_error` with all that is wrong, unless these are only warnings.
Domain_3<Default_kernel> valid_domain(const Plc& plc, double coplanar_tolerance, bool triangulate = false);

/// `plc` with such facets alone (`fused_with_none`) as would intersect others once they are fused: sheets may be closer to each other than
/// triangles are bent that become one facet.
/// \return none if it is not valid unfused either
std::optional<Plc> fused_where_valid(Plc plc, double coplanar_tolerance, bool triangulate = false);

}  // namespace pgdr

#endif
