// What bodies were before they changed in a window of time: what it takes to undo it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/observers.h"
#include "game/physics/body_state.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

class Bodies;
class ImpactHistory;
class Jams;

/// A free impact changes the flights of bodies alone, so that nearly always no more is kept.
class BeforeImages final : public ChangeObserver {
 public:
  struct KeptFlight {
    std::uint32_t body;
    Flight flight;
  };
  struct KeptState {
    std::uint32_t body;
    BodyState state;  ///< but for the flight
  };

  BeforeImages(const Bodies& bodies, const ImpactHistory& history, const Jams& jams,
               std::uint32_t body_count)
      : bodies_(bodies), history_(history), jams_(jams), marks_(body_count) {}

  /// From here on is another window.
  void begin();
  /// Before the body changes otherwise than in a free impact.
  void keep(std::uint32_t body) override;
  /// Before it changes in a free impact; or in any, then with `flight` from before that.
  void keep_flight(std::uint32_t body, const Flight& flight) override {
    if (marks_[body].number >= number_) return;
    marks_[body] = {number_, static_cast<std::uint32_t>(flights_.size()), 0};
    flights_.push_back({body, flight});
  }

  void keep_state(std::uint32_t body, const BodyState& before) override;

  /// Whether the body has changed in this window; and by nothing but free impacts.
  bool has_changed(std::uint32_t body) const { return marks_[body].number >= number_; }
  bool has_flown_freely(std::uint32_t body) const { return marks_[body].number == number_; }
  /// As it was when the window began.
  BodyState state(std::uint32_t body) const;
  std::uint8_t flags(std::uint32_t body) const;

  std::span<const KeptFlight> flights() const { return flights_; }
  std::span<const KeptState> states() const { return states_; }

 private:
  /// What is kept of a body, and where: its flight if `number` is that of this window, all of it if
  /// it is one more.
  struct Mark {
    std::uint32_t number = 0, flight = 0, state = 0;
  };

  const Bodies& bodies_;
  const ImpactHistory& history_;
  const Jams& jams_;
  std::vector<Mark> marks_;  // by body
  std::uint32_t number_ = 2;
  std::vector<KeptFlight> flights_;  // of all that changed
  std::vector<KeptState> states_;    // of those that changed otherwise than in a free impact
};

/// All that the future of a body depends on.
BodyState state_of(std::uint32_t body, const Bodies& bodies, const ImpactHistory& history,
                   const Jams& jams);

}  // namespace rink::physics::inline RINK_PRECISION
