// Threads that are federates of one run: they begin together, and their ends are counted.
#pragma once

#include <time.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bench/standard/work.h"

namespace rink_driver {

inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
inline double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Times what lies between `begin` and `end`.
class Stopwatch {
 public:
  void begin() { wall_ = wall_seconds(), processor_ = processor_seconds(); }
  void end(Outcome& outcome) const {
    outcome.seconds = wall_seconds() - wall_;
    outcome.processor_seconds = processor_seconds() - processor_;
  }

 private:
  double wall_ = 0.0, processor_ = 0.0;
};

/// What the threads of one run share.
class Meeting {
 public:
  std::atomic<int> ready{0};
  std::atomic<bool> is_over{false};

  void fail(const std::string& why) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (fault_.empty()) fault_ = why;
    is_over = true;
  }
  std::string fault() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return fault_;
  }
  /// False once a thread has failed or `patience_s` are over.
  template <class Condition, class Turn>
  bool wait(const Condition& is_so, const Turn& turn, double patience_s = 60.0) {
    const double until = wall_seconds() + patience_s;
    while (!is_so()) {
      if (is_over) return false;
      if (wall_seconds() > until) {
        fail("nothing more comes");
        return false;
      }
      turn();
    }
    return true;
  }

 private:
  std::mutex mutex_;
  std::string fault_;
};

inline void rest() { std::this_thread::sleep_for(std::chrono::microseconds(20)); }

}  // namespace rink_driver
