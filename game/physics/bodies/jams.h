// Pressed clusters in equilibrium: their members stand still, or move on together, until one of
// them is woken.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/body_state.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

struct JamTable {
  std::vector<std::uint32_t> numbers;  ///< by body: of the jam that a frozen one belongs to
  std::vector<std::uint32_t> frozen;   ///< bodies
  std::uint32_t count = 0;             ///< jams ever made
};

/// No body is in two jams at once.
class Jams {
 public:
  Jams(Bodies& bodies, ImpactHistory& history, const Observers& observers)
      : bodies_(bodies), history_(history), observers_(observers) {}
  Jams(const Jams&) = delete;
  Jams& operator=(const Jams&) = delete;

  /// The next body, by number.
  void add() {
    assert(table_.numbers.size() < bodies_.count());
    table_.numbers.push_back(0);
  }
  const JamTable& table() const { return table_; }
  void restore(JamTable table) {
    assert(table.numbers.size() == bodies_.count());
    table_ = std::move(table);
  }
  /// Bodies restored by write(), in the order in which they had been frozen; of `frozen` those that
  /// still are, for some may have been dropped since.
  void restore(const std::vector<std::uint32_t>& frozen, std::uint32_t count) {
    table_.frozen = frozen, table_.count = count;
    std::erase_if(table_.frozen,
                  [this](std::uint32_t body) { return !bodies_[body].is(Body::frozen); });
  }
  void read(std::uint32_t body, BodyState& state) const;
  /// And lists it, if it is frozen, or not any more.
  void write(std::uint32_t body, const BodyState& state);

  /// Stops `members` where they are, for as long as nothing else acts on them.
  void stop(std::span<const std::uint32_t> members);
  /// Lets `members` move on under `accelerations` [m/s^2], in the same order, up to `end` [s] or
  /// until something else acts on one of them.
  void glide(std::span<const std::uint32_t> members, std::span<const RealVector> accelerations,
             Real end);
  /// Ends the equilibrium of the jam that `body` is part of, if it is in one: all its members yield
  /// to their thrust again.
  void wake(std::uint32_t body, Real time);
  /// All who are in one jam with `body`, without itself.
  template <class Visit>
  void for_each_other(std::uint32_t body, Visit&& visit) const {
    if (!bodies_[body].is(Body::frozen)) return;
    for (const std::uint32_t other : table_.frozen) {
      assert(other < table_.numbers.size());
      if (other != body && table_.numbers[other] == table_.numbers[body]) visit(other);
    }
  }

 private:
  void enlist(std::span<const std::uint32_t> members);

  Bodies& bodies_;
  ImpactHistory& history_;
  const Observers& observers_;
  JamTable table_;
};

}  // namespace rink::physics::inline RINK_PRECISION
