// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/refinement/indexed_mesh_of_3.h>

namespace pgdr {
template Indexed_mesh_3 indexed_mesh_3(const Refined_mesh_3<Default_kernel>&);
template Indexed_mesh_3 indexed_mesh_3(Refined_mesh_3<Default_kernel>&&);
}  // namespace pgdr
