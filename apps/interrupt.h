// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_INTERRUPT_H
#define PGDR_APPS_INTERRUPT_H

#include <atomic>

#include <signal.h>

namespace pgdr::app {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM sets a flag; a second one ends the program as usual.
/// One at a time.
class Interrupt_guard {
 public:
  Interrupt_guard();
  ~Interrupt_guard();
  Interrupt_guard(const Interrupt_guard&) = delete;
  Interrupt_guard& operator=(const Interrupt_guard&) = delete;

  /// False outside of its life.
  static const std::atomic<bool>& flag();

 private:
  struct sigaction previous_interrupt_ {};
  struct sigaction previous_terminate_ {};
};

}  // namespace pgdr::app

#endif
