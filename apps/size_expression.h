// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_SIZE_EXPRESSION_H
#define PGDR_APPS_SIZE_EXPRESSION_H

#include <string>

#include <pgdr/sizing/combined_sizing_field.h>

namespace pgdr::app {

/// A size from an expression in x, y and z, as muParser reads it: "0.1 + 0.2*x", "min(1, 0.1 + 0.3*sqrt(x^2+y^2))". Each thread evaluates by a
/// parser of its own. Throws `Usage_error` for what is no such expression.
Combined_sizing_field::Function parse_size_expression(const std::string& text);

}  // namespace pgdr::app

#endif
