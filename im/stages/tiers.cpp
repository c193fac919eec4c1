// The stage `tiers`: how near an entity is, in rings, so that what is far may be updated less
// often.
#include <algorithm>
#include <bit>
#include <cassert>

#include "im/composition/reviewed_parts.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// A square around the middle of `region`, of which `fraction` of the radius that its shorter side
/// allows is inscribed.
Region ring_of(const Region& region, double fraction) {
  const double x = 0.5 * region.low_x + 0.5 * region.high_x,
               y = 0.5 * region.low_y + 0.5 * region.high_y;
  const double half = fraction * std::min(0.5 * region.high_x - 0.5 * region.low_x,
                                          0.5 * region.high_y - 0.5 * region.low_y);
  return {x - half, y - half, x + half, y + half};
}

/// Part 0 is the inner filter, part 1 + k the ring of tier k.
class Tiers final : public ReviewedParts {
 public:
  Tiers(std::vector<std::unique_ptr<Filter>> parts, std::vector<double> fractions)
      : ReviewedParts(std::move(parts)), fractions_(std::move(fractions)) {
    assert(parts_.size() == 1 + fractions_.size() && !fractions_.empty());
    assert(std::is_sorted(fractions_.begin(), fractions_.end()) && fractions_.front() > 0.0);
  }

  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    parts_[0]->set_subscription_region(subscriber, region);
    for (std::size_t k = 0; k < fractions_.size(); ++k)
      parts_[1 + k]->set_subscription_region(subscriber, ring_of(region, fractions_[k]));
  }
  std::span<const Change> match() override {
    const auto level = [this](Subscriber, Entity, PairStates::Decisions decisions,
                              PairStates::Level) {
      if ((decisions & 1u) == 0) return PairStates::Level{0};
      const auto tier = std::min(
          static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(decisions >> 1))),
          fractions_.size());
      return static_cast<PairStates::Level>(1 + tier);
    };
    const std::span<const Change> changes = matched(level);
    for (const Change& change : changes)
      tier_changes_ += change.transition == Transition::tier_changed ? 1u : 0u;
    return changes;
  }
  Traits traits() const override {
    Traits own = Parts::traits();
    own.decides_tiers = true;
    return own;
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({"tiers", "changes of tier", tier_changes_});
  }

 private:
  std::vector<double> fractions_;
  std::uint64_t tier_changes_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_tiers(std::unique_ptr<Filter> inner,
                                   std::vector<std::unique_ptr<Filter>> rings,
                                   std::vector<double> fractions) {
  std::vector<std::unique_ptr<Filter>> parts;
  parts.push_back(std::move(inner));
  for (auto& ring : rings) parts.push_back(std::move(ring));
  return std::make_unique<Tiers>(std::move(parts), std::move(fractions));
}

}  // namespace rink::im
