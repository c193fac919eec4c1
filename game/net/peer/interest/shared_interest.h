// Interest among peers, seen from one of them: where its player looks, what the others receive of
// the bodies here, and what it receives of theirs. No clock, no socket.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/peer/interest/key_counts.h"
#include "game/net/peer/interest/peer_replicas.h"
#include "game/net/peer/interest/sender_interest.h"
#include "game/net/peer/traffic.h"
#include "game/net/relevant_kinds.h"
#include "game/peer/peer.h"

namespace rink::game {

/// In the place of the bat of a peer that nobody plays.
inline constexpr std::uint32_t no_bat = 0xffffffffu;

/// The same for all peers, but for what only concerns the own player.
struct InterestSettings {
  std::string scheme = "region", policy = "on-event";  ///< see SenderInterest
  double cell_size = 0.0;                              ///< m; 0 lets the scheme choose
  double half_side = 1.0, margin = 0.0;  ///< m: of a player's view, and by how much its region
                                         ///< exceeds it (game::ClientSettings)
  RelevantKinds always_relevant;         ///< what the scheme `always` lets through
  double rate_hz = 20.0;  ///< windows per second of simulated time: the k-th ends at k / rate_hz
  std::vector<std::uint32_t>
      bats;              ///< by peer, the body that its player moves; or no_bat. Of those who begin
  bool is_late = false;  ///< others have played before: the bat is not where it started
};

/// Keys are counted by who owns the bat, as a server that replays does. Throws nothing.
class SharedInterest {
 public:
  using Send =
      std::function<void(peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> content)>;
  /// Of as many members as there are bats. `peer` and `division` must outlive it, and may be made
  /// anew where they are (then `begin_again`). What is sent must come before what the protocol
  /// sends to the same peer afterwards.
  SharedInterest(const Game& start, const InterestSettings& settings, const peer::Peer& peer,
                 const peer::Division& division, Send send);
  SharedInterest(const SharedInterest&) = delete;
  SharedInterest& operator=(const SharedInterest&) = delete;

  /// The steps of a window. Before it is played:
  void begin_window() { keys_.begin_window(); }
  /// After the run, before it is agreed upon: so that others know where the player looks when they
  /// tell of this window. A view need not be exact.
  void look_around();
  /// All have accepted window `window`, and the others have been sent what they need for the next;
  /// it is not committed yet.
  void finish(std::uint32_t window);
  /// It is; and once before the first.
  void note_places();

  /// From now on these are the members (sorted), and `bats` theirs, by number. Who was one goes on
  /// with what was told and heard; with who comes all begins, with who is gone it ends. All call
  /// this before they hear what a newcomer says.
  void set_members(std::span<const peer::PeerNumber> members, std::vector<std::uint32_t> bats);
  /// Sets the members after windows were undone: everybody forgets what was told and where others
  /// look, and tells everybody anew. All who are left call this at the same window.
  void begin_again(std::span<const peer::PeerNumber> members, std::vector<std::uint32_t> bats);

  /// From a member. False for what is no message of its kind.
  bool receive(peer::PeerNumber from, Traffic about, rti::Bytes content);
  /// The own player pressed or released a key, which goes to the bat's owner.
  void press();
  /// How many of the player's keys its bat has felt, by what is known here.
  std::uint32_t felt() const;

  /// What the player sees: bodies here within its view, and others of which it receives updates.
  void list_scope(std::vector<std::uint32_t>& bodies) const;
  /// Where the player believes a body to be that it sees [m], at `instant` [s].
  physics::Vector2 position_at(std::uint32_t body, double instant) const;
  /// How the player believes it to move: a copy that may be evaluated at any later time.
  physics::Motion motion_of(std::uint32_t body) const;

  std::uint32_t bat() const { return settings_.bats[peer_.number()]; }
  bool owns(std::uint32_t body) const { return places_[body] == Place::own; }
  const SenderInterest& sender() const { return interest_; }
  PeerReplicas& replicas() { return replicas_; }
  const PeerReplicas& replicas() const { return replicas_; }

 private:
  enum class KeyWord : std::uint8_t { pressed, received };
  enum class Place : std::uint8_t { away, own, ghost };

  void send(peer::PeerNumber to, Traffic about, rti::Bytes content);
  void send_updates(std::uint32_t window);
  void hand_keys_over();
  void keep_in_sight();
  bool receive_keys(rti::Bytes content);
  void send_keys(peer::PeerNumber to, KeyWord word, peer::PeerNumber player, std::uint32_t count);
  std::optional<physics::Vector2> bat_place();
  peer::PeerNumber owner_of_bat(peer::PeerNumber player) const;
  bool is_member(peer::PeerNumber peer) const {
    return std::binary_search(members_.begin(), members_.end(), peer);
  }
  void forget(peer::PeerNumber peer);

  InterestSettings settings_;
  const peer::Peer& peer_;
  const peer::Division& division_;
  Send send_;
  SenderInterest interest_;
  PeerReplicas replicas_;
  std::vector<peer::PeerNumber> members_;  ///< sorted
  std::vector<Place> places_;              ///< by body
  std::vector<std::uint32_t> here_;
  std::vector<std::uint32_t> parted_,
      parting_;  ///< own bodies that are others' since the last window and from now on, as they
                 ///< were then in the picture
  EncodedInterest encoded_interest_;
  std::optional<physics::Vector2> seen_bat_;  ///< where the player's bat was last seen [m]
  bool is_undone_ = false;                    ///< what was said before counts no more
  std::vector<bool> is_informed_;  ///< by peer: it knows the present interest, or an earlier one,
                                   ///< and must be told of its end
  KeyCounts keys_;                 ///< by peer, of its player
  std::vector<peer::PeerNumber> handed_to_;  ///< by peer: who got its bat from us
};

}  // namespace rink::game
