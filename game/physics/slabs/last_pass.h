// What no tile could play, in the order of the whole field.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/physics/bodies/before_images.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/engine/engine.h"
#include "game/physics/events/event_order.h"
#include "game/physics/real.h"
#include "game/physics/slabs/tile.h"

namespace rink::physics::inline RINK_PRECISION {

/// Keeps what the engine's own events change, for the undo.
class LastPass final : public ChangeObserver {
 public:
  LastPass(Engine& engine, SharedWindow& shared, std::uint32_t number, std::uint32_t count);

  void begin_window();
  /// Plays all that is left of the window. Its tile keeps the courses.
  void play();
  Tile& tile() { return tile_; }
  const Tile& tile() const { return tile_; }
  /// What the engine's own events changed, as it was before.
  const BeforeImages& images() const { return images_; }
  /// Whether it did what only the order of the whole field can tell: more than two bodies at once,
  /// or what depends on how many events come at one instant.
  bool solver_failed() const { return solver_failed_; }
  /// A goal, at which time stops: nothing was played from there on, by this pass. Or infinite.
  Real goal() const { return goal_; }
  /// The order of each event that was written down here.
  const std::vector<EventOrder>& orders() const { return orders_; }
  std::uint64_t played() const { return played_; }

  void keep(std::uint32_t body) override;
  void keep_flight(std::uint32_t body, const Flight& flight) override;
  void keep_state(std::uint32_t body, const BodyState& before) override;

 private:
  bool crosses(std::uint32_t body) const;
  bool scores(std::uint32_t body) const;
  void process(std::uint32_t body, const EventOrder& order);
  void replace(std::uint32_t body, const Flight& flight, std::uint32_t version);

  Engine& engine_;
  Engine::Parts parts_;
  SharedWindow& shared_;
  Tile tile_;
  BeforeImages images_;
  std::vector<std::uint32_t> changed_;  // by the event at hand
  Real time_ = 0.0;                     // of it
  bool solver_failed_ = false;
  Real goal_ = infinity;
  std::uint64_t played_ = 0;
  std::vector<EventOrder> orders_;
  std::vector<EnergyTransfer> transfers_;  // of the event at hand
};

}  // namespace rink::physics::inline RINK_PRECISION
