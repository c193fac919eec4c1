// Side messages that came before anybody listens, or that their listener is not ready for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "game/peer/protocol.h"

namespace rink::game {

class DeferredAsides {
 public:
  /// No honest sender is so far ahead of its receivers.
  static constexpr std::size_t count_max = 4096;
  struct Aside {
    peer::PeerNumber from = 0;
    std::vector<std::uint8_t> bytes;
  };

  /// False if too many wait already.
  bool add(peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
    if (waiting_.size() >= count_max) return false;
    keep(from, std::move(bytes));
    return true;
  }
  /// One that was taken before.
  void keep(peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
    waiting_.push_back({from, std::move(bytes)});
  }
  /// The first; nothing if none waits.
  std::optional<Aside> take() {
    if (waiting_.empty()) return std::nullopt;
    std::optional<Aside> first = std::move(waiting_.front());
    waiting_.pop_front();
    return first;
  }

 private:
  std::deque<Aside> waiting_;
};

}  // namespace rink::game
