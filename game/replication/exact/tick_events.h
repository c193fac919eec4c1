// What happened to whom in a tick, as far as others must know it: keys, and groups of bodies whose
// motions depend on each other.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "game/control/game.h"
#include "game/physics/world_journal.h"
#include "game/replication/exact/exact_state.h"

namespace rink::game {

/// A bat is driven otherwise from `time` [s] on.
struct DriveChange {
  double time = 0.0;
  std::uint32_t bat = 0;  ///< body
  Drive before, after;
};

/// Collects over the advances of a tick. A *group* are bodies that the events of the tick joined,
/// directly or through others, together with all that were or are in rest contact or in one jam
/// with one of them: who knows all of a group computes it, and who knows some cannot.
class TickEvents {
 public:
  /// Looks at `game` from now on, which must outlive it.
  explicit TickEvents(const Game& game);

  /// After each advance of the game.
  void look(const Game& game);
  /// The tick is over: finds its groups.
  void close(const Game& game);
  /// The next tick begins.
  void forget();

  struct Group {
    std::span<const std::uint32_t> bodies;  ///< one or more
    bool is_unforeseeable = false;  ///< the rules moved one of them, or it has no room on the
                                    ///< network grid: nobody can compute it
  };
  /// Those of two and more bodies, and those that nobody can compute.
  std::span<const Group> groups() const { return groups_; }
  std::span<const DriveChange> drive_changes() const { return drive_changes_; }
  /// Bodies that left the game.
  std::span<const std::uint32_t> removed() const { return removed_; }
  Drive drive_of(std::uint32_t body) const {
    return body < drives_.size() ? drives_[body] : Drive{};
  }

 private:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  std::uint32_t root_of(std::uint32_t body);
  void join(std::uint32_t a, std::uint32_t b);
  void concern(std::uint32_t body);
  void list_drive_changes();
  void join_events();
  void join_contacts(const Pairs& contacts);

  physics::WorldJournal journal_;
  std::vector<Drive> drives_;  ///< by body
  std::vector<DriveChange> drive_changes_;
  std::vector<std::uint32_t> removed_, left_off_;
  std::vector<std::uint8_t> was_out_of_play_;  ///< by body, as of the tick before
  Pairs contacts_before_;
  std::vector<std::uint32_t> parents_;  ///< by body: a forest of the groups
  std::vector<std::uint8_t> is_concerned_;
  std::vector<std::uint32_t> concerned_;  ///< in this tick
  std::vector<Group> groups_;
};

}  // namespace rink::game
