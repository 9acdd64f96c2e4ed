// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_PHASE_TIMER_H
#define PGDR_REPORT_PHASE_TIMER_H

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace pgdr {

/// Wall-clock seconds per named phase, in order of execution.
class Phase_timer {
 public:
  /// Ends the phase under way and books it under `name`.
  void end_phase(const std::string& name) {
    const Clock::time_point now = Clock::now();
    seconds_.emplace_back(name, std::chrono::duration<double>(now - phase_start_).count());
    phase_start_ = now;
  }

  /// Books phases that somebody else measured, in place of the one under way.
  void end_phases(const std::vector<std::pair<std::string, double>>& seconds) {
    seconds_.insert(seconds_.end(), seconds.begin(), seconds.end());
    phase_start_ = Clock::now();
  }

  /// Since construction.
  double total_seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_ = Clock::now();
  Clock::time_point phase_start_ = start_;
  std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace pgdr

#endif
