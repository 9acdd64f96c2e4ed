// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_OUTPUT_ERROR_H
#define PGDR_IO_OUTPUT_ERROR_H

#include <stdexcept>

namespace pgdr {

/// Thrown when a file cannot be written; `what()` is one sentence that names it.
class Output_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pgdr

#endif
