// SPDX-License-Identifier: GPL-3.0-or-later
#include "messages.h"

#include <algorithm>
#include <cstddef>
#include <iostream>

namespace pgdr::app {

void print_message(const std::string& text) {
  std::string line = text;
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::cerr << "pgdr: " << line << std::endl;
}

void print_problems(const std::vector<Input_problem>& problems) {
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, problems.size()); ++i) print_message(problems[i].message);
  if (problems.size() > most)
    print_message("and " + std::to_string(problems.size() - most) + " more (--problems FILE.vtu writes them all)");
}

}  // namespace pgdr::app
