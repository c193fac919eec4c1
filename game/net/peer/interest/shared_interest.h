// Interest among peers, seen from one of them: its player's view, updates to the others about
// bodies here, and their updates. No clock, no socket.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/following_view.h"
#include "game/net/peer/interest/key_counts.h"
#include "game/net/peer/interest/peer_replicas.h"
#include "game/net/peer/interest/sender_interest.h"
#include "game/net/peer/traffic.h"
#include "game/net/relevant_kinds.h"
#include "game/peer/peer.h"

namespace rink::game {

/// The bat of a peer without a player.
inline constexpr std::uint32_t no_bat = 0xffffffffu;

/// Equal for all peers, but for values that concern the own player only.
struct InterestSettings {
  std::string scheme = "region", policy = "on-event";  ///< see SenderInterest
  double cell_size = 0.0;                              ///< m; 0 lets the scheme choose
  double half_side = 1.0, margin = 0.0;  ///< m: of a player's view, and by how much its region
                                         ///< exceeds it (game::ClientSettings)
  RelevantKinds always_relevant;         ///< what the scheme `always` lets through
  double rate_hz = 20.0;  ///< windows per second of simulated time: the k-th ends at k / rate_hz
  std::vector<std::uint32_t>
      bats;              ///< by peer, the body that its player moves, or no_bat; of the first peers
  bool is_late = false;  ///< others have played before: the bat is not where it started
};

/// A shared game before anything has moved; the widest body reaches `extent_max` [m] from its
/// middle.
struct SharedStart {
  const Scene& scene;
  const Game& game;
  double extent_max;
};

/// The owner of a bat counts its keys, as a server that replays does. Throws nothing.
class SharedInterest {
 public:
  using Send =
      std::function<void(peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> content)>;
  /// There are as many members as bats. `peer` and `division` must outlive it, and may be made anew
  /// in place (then call `begin_again`); `start` need not. Messages sent must arrive before later
  /// ones of the protocol to the same peer.
  SharedInterest(const SharedStart& start, const InterestSettings& settings, const peer::Peer& peer,
                 const peer::Division& division, Send send);
  SharedInterest(const SharedInterest&) = delete;
  SharedInterest& operator=(const SharedInterest&) = delete;

  /// The steps of a window. Before it is played:
  void begin_window() { keys_.begin_window(); }
  /// After the run, before the agreement, so that others know the player's view when they send this
  /// window. A view need not be exact.
  void look_around();
  /// All have accepted window `window`, and the others have been sent what they need for the next;
  /// it is not committed yet.
  void finish(std::uint32_t window);
  /// After the commit, and once before the first window.
  void note_places();

  /// Sets the members (sorted) and their `bats`, by number. Members that stay keep their state, new
  /// ones begin, and those that are gone end. All call this before they handle a newcomer's
  /// messages.
  void set_members(std::span<const peer::PeerNumber> members, std::vector<std::uint32_t> bats);
  /// Sets the members after windows were undone: all forget updates and others' views, and send
  /// everything anew. All that are left call this at the same window.
  void begin_again(std::span<const peer::PeerNumber> members, std::vector<std::uint32_t> bats);

  /// Receives a member's message. False for a malformed one.
  bool receive(peer::PeerNumber from, Traffic about, rti::Bytes content);
  /// The own player pressed or released a key, which goes to the bat's owner.
  void press();
  /// The number of the player's keys in effect, as known here.
  std::uint32_t felt() const;

  /// Lists the player's scope: bodies here within its view, and replicas.
  void list_scope(std::vector<std::uint32_t>& bodies) const;
  /// The believed position of a body in scope [m], at `instant` [s].
  physics::Vector2 position_at(std::uint32_t body, double instant) const;
  /// The believed motion of a body: a copy that may be evaluated at any later time.
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
  FollowingView view_;
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
  bool is_undone_ = false;                    ///< earlier messages no longer count
  std::vector<bool> is_informed_;  ///< by peer: it knows the present interest, or an earlier one,
                                   ///< and must be notified of its end
  KeyCounts keys_;                 ///< by peer, of its player
  std::vector<peer::PeerNumber> handed_to_;  ///< by peer: the peer that got its bat from this one
};

}  // namespace rink::game
