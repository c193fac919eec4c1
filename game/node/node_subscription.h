// What a node wants to be told of by others: the bodies that its clients may see.
#pragma once

#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "game/node/cells.h"
#include "game/replication/scheme_reach.h"

namespace rink::game {

/// The cells that the regions of all clients meet, grown by the reach of the scheme and by half a
/// cell, which covers their motion until the others know. A cell stays until it is another half
/// cell away. The owners of bodies match these cells plainly and the scheme runs where the client
/// is, so that what remembers, ranks or looks never runs in two places.
class NodeSubscription {
 public:
  /// Until the first look everything is wanted.
  NodeSubscription(const physics::Field& field, const SchemeReach& reach)
      : field_(field), reach_(reach), cells_(Cells::all_of(field)) {}

  /// The server's thread: the clients look at these regions now, or at everything.
  void look(std::span<const im::Region> regions, bool at_everything);
  /// The thread that shares the simulation: the cells, if they are others than were taken last.
  std::optional<Cells> take() {
    const std::lock_guard lock(mutex_);
    if (changed_) taken_ = changed_;
    return std::exchange(changed_, std::nullopt);
  }
  /// The same thread: the others have forgotten what was taken.
  void take_again() {
    const std::lock_guard lock(mutex_);
    if (!changed_) changed_ = taken_;
  }

 private:
  Cells around(std::span<const im::Region> regions);
  double side_for(std::span<const im::Region> regions) const;

  physics::Field field_;
  SchemeReach reach_;
  Cells cells_;
  double side_ = 0.0;  ///< of cells around regions [m]; 0: none yet
  std::mutex mutex_;
  std::optional<Cells> changed_;  ///< guarded by `mutex_`
  std::optional<Cells> taken_;    ///< last
};

}  // namespace rink::game
