// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_VALID_DOMAIN_H
#define PGDR_DOMAIN_VALID_DOMAIN_H

#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>

namespace pgdr {

/// `make_domain_3` and `validate_domain_3` in one, compiled in the library.
/// \param warnings gets what the domain can be meshed in spite of
/// Throws `Input_error` with all that is wrong.
Domain_3<Default_kernel> valid_domain(const Plc& plc, double coplanar_tolerance, bool triangulate = false, std::vector<Input_problem>* warnings = nullptr);

}  // namespace pgdr

#endif
