// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/report/progress_line.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <system_error>

#include <sys/ioctl.h>
#include <unistd.h>

#include <pgdr/report/format.h>

namespace pgdr {

namespace {

/// As much of `text` as there is room for.
template <std::size_t N>
void assign(std::array<char, N>& to, std::string_view text) {
  const std::size_t n = std::min(text.size(), N - 1);
  std::memcpy(to.data(), text.data(), n);
  to[n] = '\0';
}

int terminal_width(std::FILE* stream) {
  struct winsize size {};
  return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

}  // namespace

Progress_line::Progress_line(bool enabled, const std::atomic<bool>* interrupt, std::FILE* stream)
    : stream_(enabled ? stream : nullptr), interrupt_(interrupt), is_terminal_(enabled && isatty(fileno(stream)) == 1) {
  if (stream_ == nullptr) return;
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  } catch (const std::system_error&) {
    // no more threads: the calls write what they can
  }
}

Progress_line::~Progress_line() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  erase();
}

void Progress_line::show(std::string_view text) {
  if (stream_ == nullptr) return;
  const std::lock_guard lock(mutex_);
  assign(phase_, text);
  detail_[0] = '\0';
  phase_began_ = written_ = Clock::now();
  is_active_ = true;
  if (is_terminal_) write_in_place();
}

void Progress_line::expect(double vertices) {
  const std::lock_guard lock(mutex_);
  expected_ = vertices;
}

/// Of the phase, from 0 to less than 1; 0 where it cannot be told. The refinement adds vertices until there are as many as expected; what comes
/// after it takes what waits, and little new comes up.
double Progress_line::share_done(const Progress& now) const {
  static constexpr double most = 0.99;
  const auto share = [](double done, double all) { return all > 0 ? std::clamp(done / all, 0.0, most) : 0.0; };
  const std::string_view phase = now.phase;
  if (phase == "refinement") return share(static_cast<double>(now.vertices) - static_cast<double>(first_.vertices), expected_ - static_cast<double>(first_.vertices));
  if (phase == "conforming") return 0;
  return share(static_cast<double>(first_.pending) - static_cast<double>(now.pending), static_cast<double>(first_.pending));
}

void Progress_line::update(const Progress& progress) {
  if (stream_ == nullptr) return;
  std::string detail = with_separators(progress.vertices) + " vertices, " + with_separators(progress.pending) + " elements pending";
  if (phase_.data() != std::string_view(progress.phase)) {
    show(progress.phase);
    first_ = progress;
  }
  const std::lock_guard lock(mutex_);
  const double share = share_done(progress);
  const double seconds = std::chrono::duration<double>(Clock::now() - phase_began_).count();
  constexpr double least_share = 0.02, least_seconds = 1;  // before that, what is left is anybody's guess
  if (share >= least_share && seconds >= least_seconds)
    detail = std::to_string(static_cast<int>(100 * share)) + " %, about " + std::to_string(static_cast<int>(std::ceil(seconds / share * (1 - share)))) + " s left, " + detail;
  assign(detail_, detail);
}

void Progress_line::erase() {
  if (stream_ == nullptr) return;
  const std::lock_guard lock(mutex_);
  is_active_ = false;
  erase_in_place();
}

void Progress_line::set_pace(Pace pace) {
  const std::lock_guard lock(mutex_);
  pace_ = pace;
  wake_.notify_all();
}

/// Takes no memory: it runs while there may be none left.
void Progress_line::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    wake_.wait_for(lock, stop, pace_.look, [&, pace = pace_.look] { return pace != pace_.look; });
    if (stop.stop_requested()) return;
    confirm_interrupt();
    if (!is_active_) continue;
    if (is_terminal_) write_in_place();
    else if (Clock::now() - written_ >= pace_.log) write_to_log();
  }
}

void Progress_line::confirm_interrupt() {
  if (is_confirmed_ || interrupt_ == nullptr || !interrupt_->load(std::memory_order_relaxed)) return;
  is_confirmed_ = true;
  erase_in_place();
  std::fputs("stopping: what there is will be written (interrupt again to end at once)\n", stream_);
  std::fflush(stream_);
}

/// "refinement, 12 s: 1,000 vertices, 20 elements pending", without its end.
void Progress_line::write_line() {
  char line[2 * sizeof(Text) + 32];
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - phase_began_).count();
  int n = std::snprintf(line, sizeof line, "%s", phase_.data());
  if (seconds > 0) n += std::snprintf(line + n, sizeof line - static_cast<std::size_t>(n), ", %lld s", static_cast<long long>(seconds));
  if (detail_[0] != '\0') n += std::snprintf(line + n, sizeof line - static_cast<std::size_t>(n), ": %s", detail_.data());
  if (is_terminal_) n = std::min(n, terminal_width(stream_) - 1);  // a line that wraps could not be taken back
  std::fprintf(stream_, "%.*s", n, line);
}

void Progress_line::write_in_place() {
  std::fputc('\r', stream_);
  write_line();
  std::fputs("\x1b[K", stream_);  // "erase to the end of the line" (ECMA-48): a shorter line leaves nothing of a longer one
  std::fflush(stream_);
  is_shown_ = true;
}

void Progress_line::write_to_log() {
  write_line();
  std::fputc('\n', stream_);
  std::fflush(stream_);
  written_ = Clock::now();
}

void Progress_line::erase_in_place() {
  if (!is_shown_) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
  is_shown_ = false;
}

}  // namespace pgdr
