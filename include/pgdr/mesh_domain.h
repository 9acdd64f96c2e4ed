// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_DOMAIN_H
#define PGDR_MESH_DOMAIN_H

#include <functional>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/mesh/indexed_mesh_3.h>
#include <pgdr/parameters.h>
#include <pgdr/report/run_statistics.h>
#include <pgdr/sizing/combined_sizing_field.h>

namespace pgdr {

/// A mesh as arrays, and how it came about.
struct Meshed_domain {
  Indexed_mesh_3 mesh;
  Run_statistics statistics;
};

/// `refine_mesh_3` and `indexed_mesh_3` in one, compiled in the library: a front door without templates, for those who want arrays only, in a
/// second to compile instead of half a minute. \param refined called between the two
/// Throws what they throw.
Meshed_domain mesh_domain(Domain_3<Default_kernel> domain, const Combined_sizing_field& sizing, const Parameters& parameters = {},
                          const std::function<void(const Run_statistics&)>& refined = {});

}  // namespace pgdr

#endif
