// Signals by which a user or the system ends a command in good order: records are written, peers
// notified.
#pragma once

#include <atomic>
#include <csignal>

namespace rink::game {

/// Set once a signal asked for the end; the latter if the terminal closed.
inline std::atomic<bool> is_interrupted = false, is_hung_up = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may come at any time");

/// Makes SIGINT, SIGTERM and SIGHUP set `is_interrupted`, and a closed connection or pipe an error
/// of writing instead of a signal.
inline void hear_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, [](int number) {
      is_interrupted = true;
      if (number == SIGHUP) is_hung_up = true;
    });
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace rink::game
