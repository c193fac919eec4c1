// Interest in a running session: what a peer's player sees beyond the peer's own part, and updates
// to the other players, window by window.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "game/net/peer/interest/shared_interest.h"
#include "game/net/peer/network/side_channel.h"
#include "game/net/peer/shared_game.h"
#include "game/net/peer/traffic.h"

namespace rink::game {

/// Pass it to SharedGame::play as its observer. The first byte of each side message is its purpose
/// (Traffic). New members begin with nothing, and those that leave are forgotten; when one is lost,
/// and windows are undone, all that are left send everything anew.
class Viewer : public WindowObserver {
 public:
  /// `game` and `side_channel` must outlive it. Throws peer::ProtocolError for an unknown scheme or
  /// policy of the settings.
  Viewer(const SharedGame& game, InterestSettings settings, SideChannel& side_channel);
  ~Viewer() override;

  /// All have accepted a window; and all updates of others about it have come, so that the player's
  /// picture is whole.
  std::function<void()> on_final, on_commit;

  void begin(const peer::Session& session) override;
  void when_played() override;
  void when_told() override;
  void when_stepped() override;
  void end() override;

  /// Only between `begin` and `end`.
  SharedInterest& interest() { return *interest_; }
  const SharedInterest& interest() const { return *interest_; }
  /// How many windows are final.
  std::uint64_t windows() const { return session_->window(); }
  /// At the end: bodies in the player's scope, and the replicas among them.
  std::size_t in_view() const { return in_view_; }
  std::size_t told_of() const { return told_of_; }
  /// Bytes of side messages, without frames and with them, and messages, by purpose.
  const TrafficBytes& sent() const { return sent_; }
  const TrafficBytes& framed_bytes() const { return framed_bytes_; }
  const TrafficBytes& messages_sent() const { return messages_sent_; }

 private:
  bool receive(peer::PeerNumber from, std::vector<std::uint8_t> bytes);
  bool apply(peer::PeerNumber from, std::span<const std::uint8_t> bytes);
  bool is_recovering() const { return session_->lost().size() != lost_; }
  void settle();
  std::vector<std::uint32_t> bats() const;

  const SharedGame& game_;
  InterestSettings settings_;
  SideChannel& side_channel_;
  const peer::Session* session_ = nullptr;
  std::optional<SharedInterest> interest_;
  std::vector<peer::PeerNumber> members_;
  std::size_t lost_ = 0, in_view_ = 0,
              told_of_ = 0;  ///< `lost_`: number of lost peers when all was last sent anew
  std::vector<std::pair<peer::PeerNumber, std::vector<std::uint8_t>>>
      put_off_;  ///< received while the session recovers
  TrafficBytes sent_{}, framed_bytes_{}, messages_sent_{};
};

}  // namespace rink::game
