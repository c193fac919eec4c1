// What the next events will look into, fetched before they come.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/engine/next_events.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Changes nothing but speed.
class LookAhead {
 public:
  LookAhead(const Bodies& bodies, const CellGrid& grid, const NextEvents& events)
      : bodies_(bodies), grid_(grid), events_(events) {}

  /// Whether it is worth it: with few bodies all is near at hand.
  bool is_worthwhile() const;
  /// Whether the schedule has gone on to another bucket since the last fetch().
  bool is_due() const { return events_.upcoming().current() != seen_.back() - 1; }
  /// In steps, as one thing leads to the next: who comes, whom he meets and in which cells, who is
  /// there.
  void fetch();
  /// The buckets of the schedule are others.
  void restart() { seen_ = {}; }

 private:
  void fetch_body(std::uint32_t body) const;
  void fetch_collected(std::uint32_t count) const;
  bool meets(std::uint32_t body) const;
  bool meets_listed(std::uint32_t body) const;
  template <class Visit>
  void step(std::size_t number, Visit&& visit);

  const Bodies& bodies_;
  const CellGrid& grid_;
  const NextEvents& events_;
  std::array<std::int64_t, 4> seen_{};  // the last bucket that each step has seen
  std::vector<std::uint32_t> candidates_;
};

}  // namespace rink::physics::inline RINK_PRECISION
