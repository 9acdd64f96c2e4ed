// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_REFERENCE_NAMES_H
#define PGDR_DOMAIN_REFERENCE_NAMES_H

#include <map>
#include <string>
#include <string_view>

namespace pgdr {

/// What users call the numbers that files refer to: patches of the boundary by marker, subdomains by region id. Not all need have a name, and
/// two may have the same.
struct Reference_names {
  std::map<int, std::string> markers;
  std::map<int, std::string> regions;
};

/// The same with no name twice, for files that have one list of them: a marker that is called as a region is gets "_surface" behind its name, and what
/// still has another's name its number. Upper and lower case count as the same (Abaqus), empty names are left out.
Reference_names distinct_names(const Reference_names& names);

/// With A to Z as a to z.
std::string in_lower_case(std::string_view text);

}  // namespace pgdr

#endif
