// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_SIMPLIFY_WITHIN_H
#define PGDR_SIMPLIFY_SIMPLIFY_WITHIN_H

#include <optional>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/simplify/planarize.h>
#include <pgdr/simplify/simplify.h>
#include <pgdr/simplify/surface_distance.h>

namespace pgdr {

/// What `simplify_within` did.
struct Simplification_within {
  Simplification simplification;
  Planarization planarization;  ///< of all passes: facets and moves added up, a vertex once for each pass that moved it
  /// The tolerance that was used: the one asked for, or less.
  double used = 0;
  /// For the distance of the result from what it was made of; 0: it has not changed by more than facets are fused.
  double limit = 0;
  Surface_distance distance;  ///< as measured, where there is a limit
  /// The result as `understand` makes it, with nothing but warnings, where it had to be looked at whether it is valid: with a million
  /// facets that takes seconds.
  std::optional<Understood> understood;

  bool is_none() const { return simplification.is_none() && planarization.is_none(); }
};

/// Changes the boundary by at most a tolerance, so that elements are not small without need: what is smaller than it is taken away
/// (`simplify`), and neighboring triangles within it of a common plane become a plane facet (`planarize`), whose edges constrain nothing any more. In
/// CAD exports most triangles of a hundredth of a degree are strips of such facets.
///
/// Where the tolerance is no more than `coplanar_tolerance` of the diagonal, what is fused anyway is all that is made plane.
/// \param tolerance a length; 0 or less: nothing is changed
/// \param coplanar_tolerance, triangulate as `make_domain_3` will understand the result
/// The result is valid, its distance from `plc` was measured (`surface_distance`), and it is no narrower (`Narrowness`) than if only noise was
/// taken away. Of what the tolerance leads to, with and without vertices taken away, it is the less narrow one. Where that is nothing of the kind half the
/// tolerance is tried, a tenth and a twentieth, and so on, so that a tolerance does no worse than a tenth of it; at last `plc` itself is returned.
/// \return a PLC whose facets `make_domain_3` fuses again
Plc simplify_within(const Plc& plc, double tolerance, double coplanar_tolerance, bool triangulate = false, Simplification_within* done = nullptr);

/// `simplify_within`, with facets alone where fusing makes a PLC invalid that is valid without (`fused_where_valid`). One that is not valid
/// then either is simplified as if it were.
Plc simplify_as_far_as_valid(const Plc& plc, double tolerance, double coplanar_tolerance, bool triangulate = false, Simplification_within* done = nullptr);

}  // namespace pgdr

#endif
