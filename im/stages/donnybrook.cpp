// The stage `donnybrook`: full updates of the few entities that have a subscriber's attention, and
// guidance at a low rate about all others (Bharambe et al. 2008).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/composition/reviewed_parts.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// Attention is the sum of three shares, each from 0 to 1: proximity, which falls evenly to 0 at
/// the rim of the subscription's disc; aim, which falls with the cosine from 1 ahead to 0 behind;
/// and recency, 1 at the entity's last contact or key and half of that 1 s later. What is the
/// subscriber's own takes nobody's place in the set.
double attention(const rink_party& me, const rink_party& its) {
  if (me.owner != RINK_NONE && its.owner == me.owner)
    return -std::numeric_limits<double>::infinity();
  const double x = its.x - me.x, y = its.y - me.y, distance = std::sqrt(x * x + y * y);
  const double reach = 0.5 * std::min(me.high_x - me.low_x, me.high_y - me.low_y);
  const double proximity = distance < reach ? 1.0 - distance / reach : 0.0;
  const double length =
      distance * std::sqrt(me.heading_x * me.heading_x + me.heading_y * me.heading_y);
  const double aim = length > 0.0 && std::isfinite(length)
                         ? 0.5 + 0.5 * ((x * me.heading_x + y * me.heading_y) / length)
                         : 0.0;
  return proximity + aim + 1.0 / (1.0 + its.age);
}

/// Part 0 is the inner filter, part 1 the interest set of it, part 2 what is the subscriber's own.
class Donnybrook final : public ReviewedParts {
 public:
  Donnybrook(std::vector<std::unique_ptr<Filter>> parts, unsigned guidance_tier)
      : ReviewedParts(std::move(parts)),
        guidance_level_(static_cast<PairStates::Level>(1 + guidance_tier)) {
    assert(parts_.size() == 3 && guidance_tier >= 1);
  }
  std::span<const Change> match() override {
    return matched([this](Subscriber, Entity, PairStates::Decisions decisions, PairStates::Level) {
      if ((decisions & 1u) == 0) return PairStates::Level{0};
      return (decisions & 6u) != 0 ? PairStates::Level{1} : guidance_level_;
    });
  }
  Traits traits() const override {
    Traits own = Parts::traits();
    own.decides_tiers = true;
    return own;
  }

 private:
  PairStates::Level guidance_level_;
};

}  // namespace

std::unique_ptr<Filter> make_donnybrook(std::unique_ptr<Filter> inner,
                                        std::unique_ptr<Filter> same_inner,
                                        std::unique_ptr<Filter> own, std::uint32_t count,
                                        unsigned guidance_tier) {
  std::vector<std::unique_ptr<Filter>> parts;
  parts.push_back(std::move(inner));
  parts.push_back(
      make_rank(std::move(same_inner),
                make_pair_function(&attention, {.roles = true, .motion = true, .age = true}), count,
                "donnybrook"));
  parts.push_back(std::move(own));
  return std::make_unique<Donnybrook>(std::move(parts), guidance_tier);
}

}  // namespace rink::im
