// The stage `hysteresis`: who is in stays in until he is out of a larger region, so that nobody flaps at an edge.
#include <algorithm>
#include <limits>

#include "im/composition/pair_states.h"
#include "im/composition/parts.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

constexpr double largest = std::numeric_limits<double>::max();

Region grown(const Region& region, double margin) {
  const auto bounded = [](double coordinate) { return std::clamp(coordinate, -largest, largest); };
  return {bounded(region.low_x - margin), bounded(region.low_y - margin), bounded(region.high_x + margin), bounded(region.high_y + margin)};
}

class Hysteresis final : public Parts {
 public:
  Hysteresis(std::vector<std::unique_ptr<Filter>> enter_and_stay, double margin) : Parts(std::move(enter_and_stay)), margin_(margin) {}

  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    parts_[0]->set_subscription_region(subscriber, region);
    parts_[1]->set_subscription_region(subscriber, grown(region, margin_));
  }
  void remove_entity(Entity entity) override {
    Parts::remove_entity(entity);
    pairs_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    Parts::remove_subscriber(subscriber);
    pairs_.remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    for (std::size_t k = 0; k < 2; ++k) pairs_.take(k, parts_[k]->match());
    changes_.clear();
    pairs_tested_ += pairs_.review([this](PairStates::Says says, PairStates::Level was) { return decide(says, was); }, changes_);
    return reported(changes_.span());
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({"hysteresis", "pairs that stayed beyond the region", stayed_});
  }

 private:
  PairStates::Level decide(PairStates::Says says, PairStates::Level was) {
    const bool enters = (says & 1u) != 0, stays = was != 0 && (says & 2u) != 0;
    if (!enters && stays) ++stayed_;
    return PairStates::Level{enters || stays};
  }

  double margin_;
  std::uint64_t stayed_ = 0;
  PairStates pairs_;
};

}  // namespace

std::unique_ptr<Filter> make_hysteresis(std::unique_ptr<Filter> enter, std::unique_ptr<Filter> stay, double margin) {
  std::vector<std::unique_ptr<Filter>> parts;
  parts.push_back(std::move(enter));
  parts.push_back(std::move(stay));
  return std::make_unique<Hysteresis>(std::move(parts), margin);
}

}  // namespace rink::im
