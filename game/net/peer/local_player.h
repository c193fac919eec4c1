// A person's side in the peer's own thread: it takes keys before each window, and returns a picture
// after it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "game/control/game.h"
#include "game/net/peer/input_queue.h"
#include "game/net/peer/interest/viewer.h"
#include "game/net/peer/shared_game.h"

namespace rink::game {

class LocalPlayer final : public WindowParticipant {
 public:
  /// Plays bat `player` of `game`, which must outlive it, as `input` must.
  LocalPlayer(const SharedGame& game, std::uint32_t player, InputQueue& input);

  void before_window(peer::Session& session) override;
  void after_window(const peer::Session& session) override;
  std::uint64_t presses() const { return presses_; }
  /// The viewer that knows bodies beyond the halo, or null.
  const Viewer* viewer = nullptr;
  /// Bytes that the peer sent, for the window's figures.
  std::function<std::uint64_t()> bytes_sent = [] { return std::uint64_t{0}; };

 private:
  /// A key on its way: it was sent with the claims of window `window`.
  struct Sent {
    std::uint64_t window;
    double stamp, wanted;  ///< s
    Key key;
    bool is_down;
  };
  void count_felt(const peer::Session& session);
  PeerSight sight_of(const peer::Session& session) const;
  void add_replicas(PeerSight& sight) const;
  void add_bodies(const peer::Peer& peer, const std::vector<std::uint32_t>& bodies,
                  KnownBody::Source source, PeerSight& sight) const;

  const SharedGame& game_;
  InputQueue& input_;
  BatController pressed_, felt_;   ///< all keys pressed, and those that have taken effect
  peer::Observation observation_;  ///< the newest
  std::vector<KeyInput> waiting_;  ///< until an owner sends an observation of the bat
  std::deque<Sent> sent_;
  std::uint64_t presses_ = 0;
  std::size_t lost_ = 0;  ///< peers
  double since_ = 0.0;
};

}  // namespace rink::game
