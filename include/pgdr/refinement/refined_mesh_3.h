// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_REFINED_MESH_3_H
#define PGDR_REFINEMENT_REFINED_MESH_3_H

#include <memory>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/subdomains_3.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/report/run_statistics.h>

namespace pgdr {

/// What `refine_mesh_3` returns: the refined Delaunay triangulation, the constraints in it and how it came about.
///
/// Cells with `subdomain() != 0` are the mesh; the others are the outside and the holes.
template <class K>
class Refined_mesh_3 {
 public:
  using Triangulation = Mesh_triangulation_3<K>;
  using Complex = Constraint_complex_3<Triangulation>;

  explicit Refined_mesh_3(Domain_3<K> domain)
      : domain_(std::make_unique<Domain_3<K>>(std::move(domain))),
        triangulation_(std::make_unique<Triangulation>()),
        complex_(std::make_unique<Complex>(*domain_)) {}

  const Domain_3<K>& domain() const { return *domain_; }
  Triangulation& triangulation() { return *triangulation_; }
  const Triangulation& triangulation() const { return *triangulation_; }
  Complex& complex() { return *complex_; }
  const Complex& complex() const { return *complex_; }
  /// The table that the cells' `subdomain()` points into.
  std::vector<Subdomain>& subdomains() { return subdomains_; }
  const std::vector<Subdomain>& subdomains() const { return subdomains_; }
  Run_statistics& statistics() { return statistics_; }
  const Run_statistics& statistics() const { return statistics_; }
  /// The radius-edge ratio that was asked for.
  double radius_edge_ratio() const { return radius_edge_ratio_; }
  void set_radius_edge_ratio(double b) { radius_edge_ratio_ = b; }

 private:
  std::unique_ptr<Domain_3<K>> domain_;
  std::unique_ptr<Triangulation> triangulation_;
  std::unique_ptr<Complex> complex_;
  std::vector<Subdomain> subdomains_;
  Run_statistics statistics_;
  double radius_edge_ratio_ = 2;
};

}  // namespace pgdr

#endif
