// How densely impacts have followed each other for each body, and whether it has had its fill.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/body_records.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body_state.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Part of the physical state: these counts decide which bodies are pressed or have no room.
class ImpactHistory {
 public:
  ImpactHistory(const WorldSpec& spec, Bodies& bodies, const Observers& observers);
  ImpactHistory(const ImpactHistory&) = delete;
  ImpactHistory& operator=(const ImpactHistory&) = delete;

  /// Of the next body, by number.
  void add() {
    assert(impact_counts_.size() < bodies_.count());
    impact_counts_.emplace_back();
  }
  /// All of them at once.
  const std::vector<ImpactCounts>& impact_counts() const { return impact_counts_; }
  void restore(std::vector<ImpactCounts> impact_counts) {
    assert(impact_counts.size() == bodies_.count());
    impact_counts_ = std::move(impact_counts);
  }
  void read(std::uint32_t body, BodyState& state) const;
  void write(std::uint32_t body, const BodyState& state);

  void note_impact(std::uint32_t body, Real time);
  /// Whether its impacts, with one more at `time`, would follow each other so closely that they are
  /// one contact, at any speed.
  bool would_be_worn(std::uint32_t body, Real time) const;
  /// Back to earlier counts of its impacts and of those at one instant; nothing where they are not
  /// earlier. Of several counts the first remains, in whatever order they are given.
  void take_back(std::uint32_t body, const ImpactCounts& before);
  /// Whether impacts of one of the two follow each other so closely that they are one contact.
  bool is_pressed_hard(const Contact& contact, Real approach, Real time) const;

  /// All `members` take part in a hop.
  void note_hop(std::span<const std::uint32_t> members, Real time);
  /// In the present series, the last one included.
  std::uint32_t hops(std::uint32_t body) const { return impact_counts_[body].hops; }
  /// When the last one was, or when the glide ends that it began [s].
  Real last_hop(std::uint32_t body) const { return impact_counts_[body].last_hop; }
  /// The last hop goes on until `end` [s].
  void hop_until(std::uint32_t body, Real end) { impact_counts_[body].last_hop = end; }
  /// Whether glides seem to end as soon as they begin.
  bool is_restless(const Contact& contact) const;
  void forget_hops(std::uint32_t body) { impact_counts_[body].hops = 0; }

  /// Counts the impacts of both at an instant that began at `instant_begin`.
  void count_meeting(const Contact& contact, Real instant_begin);
  /// Whether one of the two has so little room that even lossless impacts at one instant do not
  /// end: elastic series between unequal masses take fewer.
  bool is_jammed(const Contact& contact) const;
  /// Whether nothing that parts them has helped.
  bool is_stalled(const Contact& contact) const;

  /// Where bodies may start in overlap: counts the impact at `time`; whether one of the two has had
  /// its fill.
  bool is_stuck(const Contact& contact, Real time);
  /// Counts the attempt at rest; whether there were so many at `time` that it should hop.
  bool has_rested_enough(std::uint32_t body, Real time);

 private:
  bool is_worn(std::uint32_t body, Real approach, Real time) const;
  std::uint32_t first_contacts(const Contact& contact) const;

  Bodies& bodies_;
  const Observers& observers_;
  Real contact_time_, rest_speed_;
  std::vector<ImpactCounts> impact_counts_;
};

}  // namespace rink::physics::inline RINK_PRECISION
