// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_EXIT_CODE_H
#define PGDR_APPS_EXIT_CODE_H

namespace pgdr::app {

/// What the program tells the shell; part of its interface.
enum Exit_code {
  exit_done = 0,
  exit_failed =
      1,  ///< a check that fails, an output that cannot be written, anything without a number of its own
  exit_usage = 2,  ///< options that make no sense
  exit_bad_input = 3,
  exit_stopped = 4  ///< by a limit or by the user; what was written, if there is anything to write, is valid
};

}  // namespace pgdr::app

#endif
