// Which bodies each event of a whole world concerned, for whoever must know who depends on whom.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "game/physics/bodies/journal.h"
#include "game/physics/body_state.h"
#include "game/physics/real.h"
#include "game/physics/world.h"

namespace rink::physics::inline RINK_PRECISION {

/// Never changes the motion. Where tiles play, it is that of the plain loop.
class WorldJournal {
 public:
  WorldJournal() = default;
  WorldJournal(const WorldJournal&) = delete;
  WorldJournal& operator=(const WorldJournal&) = delete;

  /// From now on enters what happens in `world`, and in no other. It must outlive the world's
  /// play, or be detached. Rest contacts that begin from here on have an age.
  void observe(World& world);
  static void detach(World& world);

  /// Since the last forget(); the parts of bodies in one event stand side by side. Posts, which
  /// never change, are not among them, and neither are who was added, removed or placed between
  /// two events.
  std::span<const Change> changes() const { return journal_.changes; }
  /// Bats that are driven otherwise, in the order in which that was so.
  std::span<const Journal::Thrust> thrusts() const { return journal_.thrusts; }
  void forget();

  /// In the order in which they are held.
  static const std::vector<RestContact>& rest_contacts(const World& world);
  /// All bodies in jams, in the order in which they were frozen, with their jam's number.
  static std::vector<std::pair<std::uint32_t, std::uint32_t>> jams(const World& world);

 private:
  Journal journal_;
};

}  // namespace rink::physics::inline RINK_PRECISION
