// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DEFAULT_KERNEL_H
#define PGDR_DOMAIN_DEFAULT_KERNEL_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pgdr/domain/plc.h>

namespace pgdr {

/// The kernel that the library is instantiated for: exact decisions on double coordinates.
using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Default_kernel = Epick;

/// The PLC that files are read into.
using Plc = Piecewise_linear_complex_3<Default_kernel>;

}  // namespace pgdr

#endif
