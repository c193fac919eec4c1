// Interest at the sender: which peer's player sees which of our bodies, and what it is therefore
// told.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "game/net/peer/interest/scheme_reach.h"
#include "game/peer/peer.h"
#include "game/replication/trajectory.h"
#include "im/filter.h"
#include "rti/wire/bytes.h"

namespace rink::game {

/// Where a player looks, as it is sent to those whose zones it meets: by cells if the scheme has
/// some, for then the same cells are the same interest.
struct EncodedInterest {
  enum class Form : std::uint8_t { away, region, cells };
  Form form = Form::away;
  float low_x = 0.0f, low_y = 0.0f, high_x = 0.0f,
        high_y = 0.0f;  ///< m; of cells, their numbers from the first to the last
  friend bool operator==(const EncodedInterest&, const EncodedInterest&) = default;
};

/// `region` in cells of side `cell_size` [m], or as it is if that is 0.
EncodedInterest interest_at(const im::Region& region, double cell_size);
/// The region that stands for it with whoever receives it: within each cell that it names.
im::Region region_of(const EncodedInterest& encoded, double cell_size);
std::vector<std::byte> bytes_of(const EncodedInterest& encoded);
/// Nothing unless the bytes are one whole interest that a player could have.
std::optional<EncodedInterest> interest_from(rti::Bytes bytes);

/// Filters as a server does, for the bodies that are here. Bodies and peers are numbered as
/// everywhere.
class SenderInterest {
 public:
  /// `scheme` and `policy` ("periodic" or "on-event") must be known (asserted).
  /// What the schemes `always`, `team` and `owner` go by are the `roles` of all bodies, of which
  /// the largest extends so far from its middle [m].
  SenderInterest(const std::string& scheme, const im::FilterSettings& settings,
                 const std::string& policy, std::vector<im::Role> roles, double extent_max);

  /// Peer `player` has a player, who moves `bat`. With a scheme that is not selective he looks at
  /// all from now on; with others when he says where.
  void add_player(peer::PeerNumber player, std::uint32_t bat);
  /// He is gone: nothing that he was told or looked at counts any more.
  void remove_player(peer::PeerNumber player);

  /// Side of the cells by which alone the scheme looks at regions [m]; 0 if it looks at them
  /// otherwise.
  double cell_size() const { return cell_size_; }
  /// Whether it matters where players look.
  bool is_selective() const { return is_selective_; }
  /// So far from where a player looks its owner must know that he does.
  const SchemeReach& reach() const { return reach_; }
  bool sends_trajectories() const { return sends_trajectories_; }

  void look(peer::PeerNumber player, const im::Region& region);
  /// The player does not look here any more, and has been told to forget.
  void look_away(peer::PeerNumber player);

  /// The bodies that are here now, own ones and ghosts; decides who sees which.
  void match(const peer::Peer& peer);
  /// Of all that are here, ascending; `player` is that of any peer which was added, the own one
  /// included.
  const std::vector<std::uint32_t>& scope_of(peer::PeerNumber player) const {
    return scopes_[player];
  }
  /// Between the handovers and the commit of window `window`: what `player` is to be told of our
  /// bodies that it will not have itself. `felt`: of its own bat, if it has not been told. Empty if
  /// there is nothing.
  std::vector<std::byte> updates_for(
      const peer::Peer& peer, peer::PeerNumber player, std::uint32_t window,
      const std::function<std::optional<std::uint32_t>(std::uint32_t body)>& felt);

  const im::FilterCounters& counters() const { return filter_->counters(); }
  std::uint64_t motions_sent() const { return motions_sent_; }

 private:
  struct LastSent {
    Trajectory trajectory;
    double until_s = -1.0;
    std::uint32_t window = 0xffffffffu;  ///< in which it was last looked at
    bool is_due = false;
    std::vector<std::byte> coded;
  };
  const LastSent& last_sent_of(const physics::World& world, std::uint32_t body,
                               std::uint32_t window);

  std::unique_ptr<im::Filter> filter_;
  im::Region world_;
  double cell_size_;
  SchemeReach reach_;
  bool is_selective_, remembers_, sends_trajectories_;  ///< `remembers`: decisions depend on
                                                        ///< earlier ones, so two owners may differ
  std::vector<im::Role> body_roles_, player_roles_;     ///< by body, by peer
  std::vector<std::vector<std::uint32_t>> scopes_,
      sent_;  ///< by peer, ascending: who sees what; what each was told of last and not told to
              ///< forget
  std::vector<std::vector<std::uint32_t>>
      handed_over_;  ///< by peer, ascending: bodies that became another's since the last window
  std::vector<std::uint8_t> is_here_;  ///< by body: in the filter
  std::vector<std::uint32_t> here_;
  std::unordered_map<std::uint32_t, LastSent>
      last_sent_;  ///< by body that is here: the state that every interested peer was sent
  std::uint64_t motions_sent_ = 0;
};

}  // namespace rink::game
