// SPDX-License-Identifier: GPL-3.0-or-later
// The front door for the default kernel.
#include <pgdr/refine_mesh_3.h>

#include <functional>
#include <utility>

#include <pgdr/mesh_domain.h>

namespace pgdr {

template Refined_mesh_3<Default_kernel> refine_mesh_3(Domain_3<Default_kernel>, const Combined_sizing_field&, const Parameters&);
template Refined_mesh_3<Default_kernel> refine_mesh_3(const Plc&, const Combined_sizing_field&, const Parameters&);

template <>
Refined_mesh_3<Default_kernel> refine_mesh_3(Domain_3<Default_kernel> domain, const Uniform_sizing_field& sizing,
                                             const Parameters& parameters) {
  return refine_mesh_3(std::move(domain), Combined_sizing_field(sizing), parameters);
}
template Refined_mesh_3<Default_kernel> refine_mesh_3(const Plc&, const Uniform_sizing_field&, const Parameters&);

Meshed_domain mesh_domain(Domain_3<Default_kernel> domain, const Combined_sizing_field& sizing, const Parameters& parameters,
                          const std::function<void(const Run_statistics&)>& refined) {
  auto mesh = refine_mesh_3(std::move(domain), sizing, parameters);
  Run_statistics statistics = std::move(mesh.statistics());
  if (refined) refined(statistics);
  return {indexed_mesh_3(std::move(mesh)), std::move(statistics)};
}

}  // namespace pgdr
