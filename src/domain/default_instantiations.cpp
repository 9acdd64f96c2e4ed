// SPDX-License-Identifier: GPL-3.0-or-later
// The templates of the room for the default kernel.
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/plc_from_domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/summarize_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/domain/volumes_3.h>

namespace pgdr {
template Domain_3<Default_kernel> make_domain_3(const Plc&, double, bool);
template std::vector<Input_problem> validate_domain_3(const Domain_3<Default_kernel>&, std::size_t);
template Small_angles small_angles_3(const Domain_3<Default_kernel>&);
template Plc plc_from_domain_3(const Domain_3<Default_kernel>&);
template Domain_summary summarize_domain_3(const Domain_3<Default_kernel>&, std::size_t, const std::vector<Input_problem>*);
template class Volumes_3<Default_kernel>;
}  // namespace pgdr
