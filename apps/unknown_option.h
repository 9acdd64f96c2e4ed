// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_UNKNOWN_OPTION_H
#define PGDR_APPS_UNKNOWN_OPTION_H

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace pgdr::app {

/// What to say of the first option that `parser` does not know, with the one that was probably meant; none where it knows all.
std::optional<std::string> unknown_option_text(const CLI::App& parser);

/// Of the options that were given, the first one with a value that is empty, as that of a shell's variable that is not set.
std::optional<std::string> empty_value_text(const CLI::App& parser);

}  // namespace pgdr::app

#endif
