// What a filter says: which entities became relevant to which subscribers, and which ceased to be.
#pragma once

#include <compare>
#include <cstdint>

namespace rink::im {

/// Small dense numbers chosen by the caller; they may be used again after removal.
using Entity = std::uint32_t;
using Subscriber = std::uint32_t;

enum class Transition : std::uint8_t { entered, left, tier_changed };

/// `entity` became relevant (or stopped being relevant) to `subscriber`, or goes on being so at
/// another rate.
struct Change {
  Subscriber subscriber;
  Entity entity;
  Transition transition;
  std::uint8_t tier = 0;  ///< from 0, the nearest, where the stage `tiers` says so
  friend auto operator<=>(const Change&, const Change&) = default;
};

}  // namespace rink::im
