// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_UNKNOWN_OPTION_H
#define PGDR_APPS_UNKNOWN_OPTION_H

#include <string>

#include <CLI/CLI.hpp>

namespace pgdr::app {

/// What to say of the first argument that `parser` does not know, with the option that was probably meant.
std::string unknown_argument_text(const CLI::App& parser);

}  // namespace pgdr::app

#endif
