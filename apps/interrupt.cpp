// SPDX-License-Identifier: GPL-3.0-or-later
#include "interrupt.h"

namespace pgdr::app {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only write lock-free atomics");

extern "C" void pgdr_note_interrupt(int) { interrupted = true; }

}  // namespace

Interrupt_guard::Interrupt_guard() {
  interrupted = false;
  struct sigaction action {};
  action.sa_handler = pgdr_note_interrupt;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &previous_interrupt_);
  sigaction(SIGTERM, &action, &previous_terminate_);
  // Whoever started the program without Ctrl-C (nohup, a background job of sh) keeps it so.
  if (previous_interrupt_.sa_handler == SIG_IGN) sigaction(SIGINT, &previous_interrupt_, nullptr);
}

Interrupt_guard::~Interrupt_guard() {
  interrupted = false;
  sigaction(SIGINT, &previous_interrupt_, nullptr);
  sigaction(SIGTERM, &previous_terminate_, nullptr);
}

const std::atomic<bool>& Interrupt_guard::flag() { return interrupted; }

}  // namespace pgdr::app
