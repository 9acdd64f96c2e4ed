// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/reference_names.h>

#include <set>

namespace pgdr {

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

Reference_names distinct_names(const Reference_names& names) {
  Reference_names result;
  std::set<std::string> taken;
  const auto add = [&taken](std::map<int, std::string>& to, int number, std::string name) {
    while (!taken.insert(in_lower_case(name)).second) name.append("_").append(std::to_string(number));
    to[number] = std::move(name);
  };
  for (const auto& [id, name] : names.regions)
    if (!name.empty()) add(result.regions, id, name);
  const std::set<std::string> regions = taken;
  for (const auto& [marker, name] : names.markers)
    if (!name.empty()) add(result.markers, marker, regions.contains(in_lower_case(name)) ? name + "_surface" : name);
  return result;
}

}  // namespace pgdr
