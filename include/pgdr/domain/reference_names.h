// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_REFERENCE_NAMES_H
#define PGDR_DOMAIN_REFERENCE_NAMES_H

#include <map>
#include <string>

namespace pgdr {

/// What users call the numbers that files refer to: patches of the boundary by marker, subdomains by region id. Not all need have a name, and
/// two may have the same.
struct Reference_names {
  std::map<int, std::string> markers;
  std::map<int, std::string> regions;
};

}  // namespace pgdr

#endif
