// What a node has sent the others, on its way from the thread that plays to the one that reports.
#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "game/net/peer/network/session_network.h"
#include "rti/transport/transport.h"

namespace rink::game {

/// The kernel is asked once per window and node, which takes a microsecond: a span that begins and
/// ends at any instant is off by a window's traffic at most.
class NodeTraffic {
 public:
  /// The thread that plays: a window is over.
  void note(const SessionNetwork& network) {
    std::vector<rti::TransportCounters> sent(network.terms().peer_count);
    for (peer::PeerNumber to = 0; to < sent.size(); ++to)
      if (to != network.number()) sent[to] = network.sent_to(to);
    const std::lock_guard lock(mutex_);
    sent_ = std::move(sent);
  }
  /// Any thread: by number, of itself nothing; empty before the first window is over.
  std::vector<rti::TransportCounters> sent() const {
    const std::lock_guard lock(mutex_);
    return sent_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<rti::TransportCounters> sent_;  ///< guarded by `mutex_`
};

}  // namespace rink::game
