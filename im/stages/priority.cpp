// The stage `priority`: keeps relevant pairs and how long they have waited, and sorts them when
// asked.
#include <algorithm>
#include <cmath>

#include "im/basics/checked.h"
#include "im/composition/parts.h"
#include "im/stages/priority_order.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

class Priority final : public Parts {
 public:
  Priority(std::unique_ptr<Filter> inner, std::size_t budget)
      : Parts(std::move(inner)), order_(budget) {}

  void set_update_region(Entity entity, const Region& region) override {
    order_.place_entity(entity, region);
    Parts::set_update_region(entity, region);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    order_.place_subscriber(subscriber, region);
    Parts::set_subscription_region(subscriber, region);
  }
  void remove_entity(Entity entity) override {
    order_.remove_entity(entity);
    Parts::remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    order_.remove_subscriber(subscriber);
    Parts::remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    const std::span<const Change> changes = parts_.front()->match();
    order_.take(changes);
    return reported(changes);
  }
  PriorityOrder* priority() override { return &order_; }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    const PriorityCounts& own = order_.counts();
    for (const StageCount& count :
         {StageCount{"priority", "states on entry sent", own.states},
          StageCount{"priority", "bytes of states on entry", own.state_bytes},
          StageCount{"priority", "updates sent", own.updates},
          StageCount{"priority", "bytes of updates", own.update_bytes},
          StageCount{"priority", "put off", own.put_off}})
      counts.push_back(count);
  }

 private:
  PriorityOrder order_;
};

}  // namespace

void PriorityOrder::place(std::vector<Region>& places, std::uint32_t id, const Region& region) {
  if (id >= places.size()) places.resize(id + std::size_t{1});
  places[id] = region;
}

void PriorityOrder::take(std::span<const Change> changes) {
  ++now_;
  for (const Change& change : changes) {
    Buffer<Entry>& entries = entries_.list_of(change.subscriber);
    Entry* const entry = PairLists<Entry>::find(entries, change.entity);
    assert((entry == nullptr) == (change.transition == Transition::entered));
    if (change.transition == Transition::due) continue;
    if (change.transition == Transition::tier_changed) entry->tier = change.tier;
    else if (entry) PairLists<Entry>::erase(entries, entry);
    else PairLists<Entry>::insert(entries, {change.entity, change.tier, true, now_});
  }
  if constexpr (checks_whole_structures) check();
}

void PriorityOrder::check() const {
  entries_.check(
      [this](const Entry& entry) { return entry.entity < entities_.size() && entry.sent <= now_; });
}

// Halved, as everywhere: the differences of the largest numbers have no double.
PriorityOrder::Watch::Watch(const Region& own)
    : x(0.25 * own.low_x + 0.25 * own.high_x),
      y(0.25 * own.low_y + 0.25 * own.high_y),
      reach(std::min(0.5 * own.high_x - 0.5 * own.low_x, 0.5 * own.high_y - 0.5 * own.low_y)) {}

double PriorityOrder::urgency(const Watch& watch, const Entry& entry) const {
  assert(entry.entity < entities_.size() && entry.sent <= now_);
  const Region& at = entities_[entry.entity];
  const double x = (0.25 * at.low_x + 0.25 * at.high_x) - watch.x,
               y = (0.25 * at.low_y + 0.25 * at.high_y) - watch.y;
  const double distance = 2.0 * std::sqrt(x * x + y * y),
               weight =
                   watch.reach > 0.0 ? 1.0 / (1.0 + std::min(distance / watch.reach, 1e9)) : 1.0;
  const double waited = static_cast<double>(now_ - entry.sent) + (entry.is_state ? 1.0 : 0.0);
  assert(0.0 < weight && weight <= 1.0);  // a heap of what is not a number has no order
  constexpr unsigned tier_max = 31;       // there are at most 15
  return waited * weight / static_cast<double>(1u << std::min<unsigned>(entry.tier, tier_max));
}

std::size_t PriorityOrder::gather_states() {
  Ranked* const end = ranked_.data() + ranked_.size();
  return static_cast<std::size_t>(
      std::partition(ranked_.data(), end, [](const Ranked& each) { return each.item.is_state; }) -
      ranked_.data());
}

std::span<const PriorityOrder::Item> PriorityOrder::order(Subscriber subscriber) {
  items_.clear();
  const std::size_t states = rank(subscriber, [](const Item&) { return std::size_t{1}; });
  const auto is_more_urgent = [](const Ranked& a, const Ranked& b) { return is_less_urgent(b, a); };
  std::sort(ranked_.data(), ranked_.data() + states, is_more_urgent);
  std::sort(ranked_.data() + states, ranked_.data() + ranked_.size(), is_more_urgent);
  for (const Ranked& each : ranked_.span()) items_.push_back(each.item);
  return items_.span();
}

void PriorityOrder::sent(Subscriber subscriber, const Item& item, std::size_t bytes) {
  Entry* const entry = entries_.find(subscriber, item.entity);
  if (!entry) return;
  ++(entry->is_state ? counts_.states : counts_.updates);
  (entry->is_state ? counts_.state_bytes : counts_.update_bytes) += bytes;
  entry->is_state = false;
  entry->sent = now_;
}

std::unique_ptr<Filter> make_priority(std::unique_ptr<Filter> inner, std::size_t budget) {
  return std::make_unique<Priority>(std::move(inner), budget);
}

}  // namespace rink::im
