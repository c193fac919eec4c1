// The wish of a user or of the system that a command end in good order: records written, peers
// told.
#pragma once

#include <csignal>
#include <initializer_list>

namespace rink::game {

/// Set once a signal asked for the end.
inline volatile std::sig_atomic_t is_interrupted = 0;

/// From now on SIGINT, SIGTERM and SIGHUP set `is_interrupted`, and a peer that is gone is an error
/// of writing instead of a signal.
inline void hear_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, [](int) { is_interrupted = 1; });
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace rink::game
