// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_LIMIT_WATCH_H
#define PGDR_SCHEDULE_LIMIT_WATCH_H

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <stop_token>
#include <thread>

#include <pgdr/report/memory.h>

namespace pgdr {

/// Looks from a thread of its own, as long as it lives, whether the caller has cancelled, or an amount of time or memory is spent, and
/// sets a flag then. Without limits there is no thread, and the flag is the caller's.
class Limit_watch {
 public:
  enum class Limit { none, caller, memory, time };

  /// `cancel`: the caller's flag, or null. `bytes` of resident memory; `seconds` from now; 0: no limit.
  Limit_watch(const std::atomic<bool>* cancel, std::size_t bytes, double seconds) : cancel_(cancel) {
    if (bytes == 0 && seconds <= 0) return;
    const auto start = std::chrono::steady_clock::now();
    thread_ = std::jthread([this, bytes, seconds, start](const std::stop_token& token) {
      // A refinement allocates some ten megabytes in this time on each thread, and nobody notices it.
      constexpr std::chrono::milliseconds interval(20);
      std::unique_lock lock(mutex_);
      while (!sleep_.wait_for(lock, token, interval, [] { return false; }) && !token.stop_requested()) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (is_cancelled())
          reach(Limit::caller);
        else if (bytes > 0 && resident_memory_bytes() >= bytes)
          reach(Limit::memory);
        else if (seconds > 0 && spent.count() >= seconds)
          reach(Limit::time);
        if (flag_) return;
      }
    });
  }

  /// To be polled by whoever works.
  const std::atomic<bool>* flag() const { return thread_.joinable() ? &flag_ : cancel_; }

  /// What set the flag.
  Limit reached() const {
    if (flag_) return reached_;
    return is_cancelled() ? Limit::caller : Limit::none;
  }

 private:
  bool is_cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }
  void reach(Limit limit) {
    reached_ = limit;
    flag_ = true;
  }

  const std::atomic<bool>* cancel_;
  std::atomic<bool> flag_{false};
  Limit reached_ = Limit::none;
  std::mutex mutex_;
  std::condition_variable_any sleep_;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace pgdr

#endif
