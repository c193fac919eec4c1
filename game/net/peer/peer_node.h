// One peer with a player: its windows, what its player presses, where that looks and what it knows. No clock, no socket; time and messages are handed in.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/net/peer/player_picture.h"
#include "game/net/peer/sender_interest.h"
#include "game/net/peer/shared_game.h"
#include "game/net/peer/traffic.h"
#include "game/peer/window_play.h"

namespace rink::game {

/// The same for all peers, but for what only concerns the own player.
struct NodeSettings {
  std::string scheme = "region", policy = "on-event";  ///< see SenderInterest
  double cell_size = 0.0;                              ///< m; 0 lets the scheme choose
  double half_side = 1.0, margin = 0.0;                ///< m: of a player's view, and by how much its region exceeds it (game::ClientSettings)
  double rate_hz = 20.0;                               ///< windows per second of simulated time: the k-th ends at k / rate_hz
  std::vector<std::uint32_t> bats;                     ///< by peer, the body that its player moves
};

/// A division with one of these bats in each zone, and who of them is which peer's: the body by peer.
struct SeatedDivision {
  peer::Division division;
  std::vector<std::uint32_t> bats;
};
/// Of the first `peer_count` players (at most as many as there are: asserted).
SeatedDivision seated_division(const Game& start, peer::PeerNumber peer_count);

/// Keys are those of the shared game, which all know; what the player presses is sent for the record, and counted by who owns the bat, as a server that replays does.
class PeerNode {
 public:
  using Send = std::function<void(peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> content)>;
  PeerNode(const SharedGame& game, const NodeSettings& settings, const peer::Division& division, peer::PeerNumber number, Send send);
  PeerNode(const PeerNode&) = delete;
  PeerNode& operator=(const PeerNode&) = delete;

  /// The own bodies' states at the end of a window stand; and, when all has come that others tell of it, the whole picture of it does.
  std::function<void()> on_final, on_commit;

  /// The instant of the next window's end has come: it is played now, or as soon as the one before it is done. Throws peer::ProtocolError, as `hear` does.
  void due();
  /// False for what is no message of its kind.
  bool hear(peer::PeerNumber from, Traffic about, std::vector<std::uint8_t> content);
  /// The own player pressed or released a key.
  void press();

  /// How many of the player's keys its bat has felt, by what is known here.
  std::uint32_t felt() const;
  std::uint32_t windows_final() const { return final_; }
  bool is_idle() const { return !play_.is_playing() && waiting_ == 0; }

  /// What the player sees: bodies here within its view, and others that it is told of.
  void list_scope(std::vector<std::uint32_t>& bodies) const;
  /// Where the player believes a body to be that it sees.
  physics::Vector2 position_at(std::uint32_t body, double instant) const;
  std::uint32_t bat() const { return settings_.bats[peer_->number()]; }

  const peer::Peer& peer() const { return *peer_; }
  const SenderInterest& interest() const { return interest_; }
  PlayerPicture& picture() { return picture_; }
  bool owns(std::uint32_t body) const { return places_[body] == Place::own; }
  /// Contents sent, without frames, and messages, by what they are about.
  const TrafficBytes& sent() const { return sent_; }
  const TrafficBytes& messages_sent() const { return messages_sent_; }

 private:
  enum class KeyWord : std::uint8_t { pressed, heard };
  enum class Place : std::uint8_t { away, own, ghost };

  void say(peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> content);
  void say(peer::PeerNumber to, Traffic about, rti::Bytes content);
  void play_next();
  void finish();
  void look_around();
  void tell();
  void hand_keys_over();
  void note_places();
  bool hear_keys(rti::Bytes content);
  void say_keys(peer::PeerNumber to, KeyWord word, peer::PeerNumber player, std::uint32_t count);
  std::optional<physics::Vector2> bat_place() const;
  peer::PeerNumber owner_of_bat(peer::PeerNumber player) const;
  double end_of(std::uint64_t window) const { return static_cast<double>(window) / settings_.rate_hz; }
  double now() const { return peer_->world().now(); }

  NodeSettings settings_;
  peer::Division division_;
  Send send_;
  std::unique_ptr<peer::Peer> peer_;
  peer::WindowPlay play_;
  SenderInterest interest_;
  PlayerPicture picture_;
  double extent_max_ = 0.0;
  std::uint32_t begun_ = 0, final_ = 0, waiting_ = 0;      ///< windows; the last: whose end has come, and that are not played yet
  std::vector<Place> places_;                              ///< by body
  std::vector<std::uint32_t> here_;
  Gaze gaze_;
  std::vector<bool> is_told_;                              ///< by peer: it knows the present gaze, or an earlier one, and must be told of its end
  std::vector<std::uint32_t> heard_, playing_, felt_, told_felt_;  ///< by peer, keys of its player: that came here; and, as the bat's owner, in the window that is played, in final ones, told to it
  std::vector<peer::PeerNumber> handed_to_;                ///< by peer: who got its bat from us
  std::uint32_t pressed_ = 0;
  TrafficBytes sent_{}, messages_sent_{};
};

}  // namespace rink::game
