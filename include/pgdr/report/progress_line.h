// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_PROGRESS_LINE_H
#define PGDR_REPORT_PROGRESS_LINE_H

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string_view>
#include <thread>

#include <pgdr/parameters.h>

namespace pgdr {

/// Says what is going on and for how long, whatever the program is busy with: a thread of its own writes it, on a terminal in one line that
/// is rewritten in place ten times a second, elsewhere as a line every ten seconds. Gone when the object is.
///
/// Calls may come from any thread. Where no thread can be had, the line changes with the calls only.
class Progress_line {
 public:
  /// `enabled` false: write nothing at all. `interrupt`: a flag whose rise is confirmed within a tenth of a second.
  explicit Progress_line(bool enabled, const std::atomic<bool>* interrupt = nullptr, std::FILE* stream = stderr);
  ~Progress_line();
  Progress_line(const Progress_line&) = delete;
  Progress_line& operator=(const Progress_line&) = delete;

  /// A phase begins: `text` is shown at once.
  void show(std::string_view text);
  /// How many vertices the refinement will have, estimated; 0: nobody knows. From then on its share that is done is told, and the time that is left.
  void expect(double vertices);
  /// How far the refinement is; its phase begins with the first call that names it.
  void update(const Progress& progress);
  /// Nothing is shown until the next `show` or `update`.
  void erase();

  /// How often the thread looks, and how often it writes where there is no terminal; tests set other values.
  struct Pace {
    std::chrono::milliseconds look{100};
    std::chrono::milliseconds log{10'000};
  };
  void set_pace(Pace pace);

 private:
  using Clock = std::chrono::steady_clock;
  using Text = std::array<char, 256>;

  double share_done(const Progress& now) const;
  void run(const std::stop_token& stop);
  void confirm_interrupt();
  void write_line();
  void write_in_place();
  void write_to_log();
  void erase_in_place();

  std::FILE* stream_;
  const std::atomic<bool>* interrupt_;
  bool is_terminal_;
  bool is_active_ = false;  ///< there is something to say
  bool is_shown_ = false;   ///< it stands on the terminal
  bool is_confirmed_ = false;
  Text phase_{};
  Text detail_{};
  double expected_ = 0;
  Progress first_{};  ///< of the phase
  Pace pace_;
  Clock::time_point phase_began_{};
  Clock::time_point written_{};
  std::mutex mutex_;  ///< of all the above
  std::condition_variable_any wake_;
  std::jthread thread_;  ///< last: it ends before the rest goes
};

}  // namespace pgdr

#endif
