// A filter's output: which entities became relevant to which subscribers, and which ceased to be.
#pragma once

#include <compare>
#include <cstdint>

namespace rink::im {

/// Small dense numbers chosen by the caller; they may be used again after removal.
using Entity = std::uint32_t;
using Subscriber = std::uint32_t;

enum class Transition : std::uint8_t { entered, left, tier_changed, due };

/// `entity` became relevant to `subscriber`, stopped being relevant, or stays so in another tier;
/// `due`: it stays so, and its newest state is told now, where a stage holds updates back.
struct Change {
  Subscriber subscriber;
  Entity entity;
  Transition transition;
  std::uint8_t tier = 0;  ///< from 0, the nearest, under the stage `tiers`
  friend auto operator<=>(const Change&, const Change&) = default;
};

}  // namespace rink::im
