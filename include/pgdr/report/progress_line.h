// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_PROGRESS_LINE_H
#define PGDR_REPORT_PROGRESS_LINE_H

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include <unistd.h>

#include <pgdr/parameters.h>
#include <pgdr/report/format.h>

namespace pgdr {

/// One line on a terminal that says what is going on, rewritten in place at most ten times a second.
///
/// It writes nothing where the stream is no terminal, and is gone when the object is.
class Progress_line {
 public:
  /// `enabled` false: write nothing at all.
  explicit Progress_line(bool enabled, std::FILE* stream = stderr)
      : stream_(enabled && isatty(fileno(stream)) == 1 ? stream : nullptr) {}
  ~Progress_line() { erase(); }
  Progress_line(const Progress_line&) = delete;
  Progress_line& operator=(const Progress_line&) = delete;

  /// Shows `text` at once: the beginning of a phase.
  void show(std::string_view text) {
    if (stream_ == nullptr) return;
    last_ = Clock::now();
    // \r and "erase to the end of the line" (ECMA-48): a shorter line leaves nothing of a longer one.
    std::fprintf(stream_, "\r%.*s\x1b[K", static_cast<int>(text.size()), text.data());
    std::fflush(stream_);
    shown_ = true;
  }

  /// Shows how far the refinement is, unless the line is fresh.
  void update(const Progress& progress) {
    if (stream_ == nullptr || Clock::now() - last_ < std::chrono::milliseconds(100)) return;
    show(std::string(progress.phase) + ": " + with_separators(progress.vertices) + " vertices, " +
         with_separators(progress.pending) + " elements pending");
  }

  void erase() {
    if (!shown_) return;
    std::fputs("\r\x1b[K", stream_);
    std::fflush(stream_);
    shown_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::FILE* stream_;
  Clock::time_point last_{};
  bool shown_ = false;
};

}  // namespace pgdr

#endif
