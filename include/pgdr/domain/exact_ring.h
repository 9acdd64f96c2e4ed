// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_EXACT_RING_H
#define PGDR_DOMAIN_EXACT_RING_H

#include <CGAL/Exact_rational.h>
#include <CGAL/Mpzf.h>
#include <CGAL/number_utils.h>

namespace pgdr {

/// Exact numbers, made of doubles, for what takes no division, like determinants. `CGAL::Mpzf`, where there is GMP, has no fractions that
/// would have to be reduced: the ball of a flat tetrahedron takes 2.5 microseconds instead of 51.
#ifdef CGAL_HAS_MPZF
using Exact_ring = CGAL::Mpzf;
#else
using Exact_ring = CGAL::Exact_rational;
#endif

}  // namespace pgdr

#endif
