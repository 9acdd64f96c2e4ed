// SPDX-License-Identifier: GPL-3.0-or-later
#include "messages.h"

#include <algorithm>
#include <iostream>

namespace pgdr::app {

void print_message(const std::string& text) {
  std::string line = text;
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::cerr << "pgdr: " << line << std::endl;
}

void print_problems(const std::vector<Input_problem>& problems) {
  for (const Input_problem& problem : problems) print_message(problem.message);
}

}  // namespace pgdr::app
