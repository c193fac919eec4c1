// Answers who asks the local network for matches.
#pragma once

#include <cstdint>
#include <string>

#include "game/net/discovery/discovery_message.h"
#include "rti/admission/token_bucket.h"

namespace rink::game {

struct AnnouncedMatch {
  std::string name;            ///< as match_name() gives it
  std::uint64_t host = 0;      ///< drawn at random
  std::uint16_t port = 0;      ///< of TCP
  bool is_local_only = false;  ///< reached by this machine's own loopback address alone, so no
                               ///< other machine is answered
};

struct AnnouncerCounters {
  std::uint64_t answered = 0, refused = 0,  ///< the latter were no queries: malformed or oversize
      over_limit = 0, from_elsewhere = 0;   ///< not answered, see is_local_only
};

/// Knows no clock: `now_s` is real time [s], which never falls.
class MatchAnnouncer {
 public:
  static constexpr double answers_per_s = 50.0;

  /// `group`: discovery_group(), or a test's own.
  MatchAnnouncer(const AnnouncedMatch& match, const rti::MulticastGroup& group, double now_s);
  /// False where no socket for it is to be had; then nobody is answered.
  bool is_open() const { return socket_.is_open(); }

  /// Answers what has come.
  void attend(double now_s);
  const rti::MulticastSocket& socket() const { return socket_; }
  const AnnouncerCounters& counters() const { return counters_; }

 private:
  AnnouncedMatch match_;
  rti::MulticastSocket socket_;
  rti::TokenBucket allowance_;
  AnnouncerCounters counters_;
};

}  // namespace rink::game
