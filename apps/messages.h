// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_MESSAGES_H
#define PGDR_APPS_MESSAGES_H

#include <string>
#include <vector>

#include <pgdr/domain/input_error.h>

namespace pgdr::app {

/// One line on stderr: "pgdr: ", then `text` with its line breaks turned into spaces.
void print_message(const std::string& text);

/// One line on stderr for each problem.
void print_problems(const std::vector<Input_problem>& problems);

}  // namespace pgdr::app

#endif
