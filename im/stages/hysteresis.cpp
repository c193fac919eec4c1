// The stage `hysteresis`: an entity stays relevant until it leaves a larger region, so that none
// flips at an edge.
#include <algorithm>
#include <cassert>

#include "im/composition/reviewed_parts.h"
#include "im/schemes/cells.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

Region grown(const Region& region, double margin) {
  const auto bounded = [](double coordinate) { return std::clamp(coordinate, -largest, largest); };
  return {bounded(region.low_x - margin), bounded(region.low_y - margin),
          bounded(region.high_x + margin), bounded(region.high_y + margin)};
}

class Hysteresis final : public ReviewedParts {
 public:
  Hysteresis(std::vector<std::unique_ptr<Filter>> enter_and_stay, double margin)
      : ReviewedParts(std::move(enter_and_stay)), margin_(margin) {
    assert(parts_.size() == 2 && margin_ >= 0.0);
  }

  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    parts_[0]->set_subscription_region(subscriber, region);
    parts_[1]->set_subscription_region(subscriber, grown(region, margin_));
  }
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override {
    parts_[0]->set_swept_subscription_region(subscriber, from, to);
    parts_[1]->set_swept_subscription_region(subscriber, grown(from, margin_), grown(to, margin_));
  }
  std::span<const Change> match() override {
    return matched([this](Subscriber, Entity, PairStates::Decisions decisions,
                          PairStates::Level was) { return decide(decisions, was); });
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({"hysteresis", "pairs that stayed beyond the region", stayed_});
  }

 private:
  PairStates::Level decide(PairStates::Decisions decisions, PairStates::Level was) {
    const bool enters = (decisions & 1u) != 0, stays = was != 0 && (decisions & 2u) != 0;
    if (!enters && stays) ++stayed_;
    return PairStates::Level{enters || stays};
  }

  double margin_;
  std::uint64_t stayed_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_hysteresis(std::unique_ptr<Filter> enter, std::unique_ptr<Filter> stay,
                                        double margin) {
  std::vector<std::unique_ptr<Filter>> parts;
  parts.push_back(std::move(enter));
  parts.push_back(std::move(stay));
  return std::make_unique<Hysteresis>(std::move(parts), margin);
}

}  // namespace rink::im
