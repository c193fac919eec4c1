// Interest at the sender: which bodies are in the scope of which peer's player, and the updates
// that follow.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "game/peer/peer.h"
#include "game/replication/scheme_reach.h"
#include "game/replication/trajectory.h"
#include "im/filter.h"
#include "rti/wire/bytes.h"

namespace rink::game {

/// A player's view as it is sent to the owners of the zones that it meets: by cells if the scheme
/// has some, since equal cells are equal interest.
struct EncodedInterest {
  enum class Form : std::uint8_t { away, region, cells };
  Form form = Form::away;
  float low_x = 0.0f, low_y = 0.0f, high_x = 0.0f,
        high_y = 0.0f;  ///< m; of cells, their numbers from the first to the last
  friend bool operator==(const EncodedInterest&, const EncodedInterest&) = default;
};

/// `region` in cells of side `cell_size` [m], or unchanged if that is 0.
EncodedInterest interest_at(const im::Region& region, double cell_size);
/// The region that a receiver uses for it: within each named cell.
im::Region region_of(const EncodedInterest& encoded, double cell_size);
std::vector<std::byte> bytes_of(const EncodedInterest& encoded);
/// Nothing unless the bytes are one whole, possible interest.
std::optional<EncodedInterest> interest_from(rti::Bytes bytes);

/// Filters as a server does, for the bodies that are here.
class SenderInterest {
 public:
  /// `scheme` and `policy` ("periodic" or "on-event") must be known (asserted).
  /// What the schemes `always`, `team` and `owner` go by are the `roles` of all bodies, of which
  /// the largest extends so far from its middle [m].
  SenderInterest(const std::string& scheme, const im::FilterSettings& settings,
                 const std::string& policy, std::vector<im::Role> roles, double extent_max);

  /// Adds the player of peer `player`, which moves `bat`. With a scheme that is not selective its
  /// scope is everything from now on; with others it follows its first view.
  void add_player(peer::PeerNumber player, std::uint32_t bat);
  /// Forgets a player with its view and updates.
  void remove_player(peer::PeerNumber player);

  /// Side of the cells [m] if the scheme uses only cells of regions; 0 otherwise.
  double cell_size() const { return cell_size_; }
  /// True if decisions depend on players' views.
  bool is_selective() const { return is_selective_; }
  /// The distance from a player's view within which owners must know it.
  const SchemeReach& reach() const { return reach_; }
  bool sends_trajectories() const { return sends_trajectories_; }

  void look(peer::PeerNumber player, const im::Region& region);
  /// The player does not look here any more, and was told to forget.
  void look_away(peer::PeerNumber player);

  /// Takes the bodies that are here, own ones and ghosts, and decides the scope of each player.
  void match(const peer::Peer& peer);
  /// The scope of a player among all bodies here, ascending; `player` is one that was added, the
  /// own one included.
  const std::vector<std::uint32_t>& scope_of(peer::PeerNumber player) const {
    return scopes_[player];
  }
  /// Between the handovers and the commit of window `window`: the updates of own bodies for
  /// `player` that it does not simulate itself. `felt`: the keys in effect on its own bat, if not
  /// acknowledged yet. Empty if there is nothing.
  std::vector<std::byte> updates_for(
      const peer::Peer& peer, peer::PeerNumber player, std::uint32_t window,
      const std::function<std::optional<std::uint32_t>(std::uint32_t body)>& felt);

  const im::FilterCounters& counters() const { return filter_->counters(); }
  std::uint64_t motions_sent() const { return motions_sent_; }

 private:
  struct LastSent {
    SentTrajectory sent;
    std::uint32_t window = 0xffffffffu;  ///< in which it was last looked at
    bool is_due = false;
    std::vector<std::byte> coded;
  };
  const LastSent& last_sent_of(const physics::PartWorld& world, std::uint32_t body,
                               std::uint32_t window);

  std::unique_ptr<im::Filter> filter_;
  im::Region world_;
  double cell_size_;
  SchemeReach reach_;
  bool is_selective_, remembers_, sends_trajectories_;  ///< `remembers`: decisions depend on
                                                        ///< earlier ones, so two owners may differ
  std::vector<im::Role> body_roles_, player_roles_;     ///< by body, by peer
  std::vector<std::vector<std::uint32_t>> scopes_,
      sent_;  ///< by peer, ascending: its scope; and the bodies sent to it and not withdrawn
  std::vector<std::vector<std::uint32_t>>
      handed_over_;  ///< by peer, ascending: bodies that became another's since the last window
  std::vector<std::uint8_t> is_here_;  ///< by body: in the filter
  std::vector<std::uint32_t> here_;
  std::unordered_map<std::uint32_t, LastSent>
      last_sent_;  ///< by body that is here: the state that every interested peer was sent
  std::uint64_t motions_sent_ = 0;
};

}  // namespace rink::game
