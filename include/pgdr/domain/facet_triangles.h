// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_FACET_TRIANGLES_H
#define PGDR_DOMAIN_FACET_TRIANGLES_H

#include <array>
#include <vector>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// A part of a facet.
struct Facet_triangle {
  std::array<Index, 3> corners;  ///< vertices of the PLC
  Index facet;                   ///< position among its facets
};

/// The facets of a PLC as triangles, none fused with another: those that are triangles as they are, then the others, holes left out.
/// Throws `Input_error` for facets that are none.
std::vector<Facet_triangle> facet_triangles(const Plc& plc);

}  // namespace pgdr

#endif
