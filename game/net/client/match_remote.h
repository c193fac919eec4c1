// A player's messages to a hosted match beside the keys: pushes, pause, rematch, and the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "game/model/push.h"
#include "game/replication/object_model.h"
#include "rti/ambassador.h"

namespace rink::game {

class MatchRemote {
 public:
  /// The server's answer to ping(): its number, and when it arrived on the server's real clock [s].
  struct Pong {
    std::uint64_t number = 0;
    double server_s = 0.0;
  };

  /// Publishes and subscribes to the messages of a match. Both must outlive the remote.
  MatchRemote(rti::Ambassador& ambassador, const ObjectModel& model);

  /// Pushes the bat from the simulated `instant` [s] on, as a key takes effect. The client must be
  /// playing a match whose host takes pushes.
  void push(const Push& push, double instant);
  std::uint32_t pushes_sent() const { return pushes_sent_; }
  /// Pauses or resumes the match.
  void pause(bool is_wanted);
  void ask_rematch() { ambassador_.send_interaction(model_.rematch, {}, {}); }
  void ping(std::uint64_t number) {
    ambassador_.send_interaction(model_.ping, {}, {.time = 0.0, .tag = number});
  }
  void receive(const Pong& pong) { pong_ = pong; }
  /// Returns the newest answer, once.
  std::optional<Pong> take_pong() { return std::exchange(pong_, std::nullopt); }

 private:
  rti::Ambassador& ambassador_;
  const ObjectModel& model_;
  std::optional<Pong> pong_;
  std::vector<std::byte> encoded_;
  std::uint32_t pushes_sent_ = 0;
};

}  // namespace rink::game
