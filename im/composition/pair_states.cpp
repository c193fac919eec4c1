// Gathers the changes of all filters, one entry per pair.
#include "im/composition/pair_states.h"

#include <cassert>

namespace rink::im {

void PairStates::touch_entity(Entity entity) {
  for (Subscriber subscriber = 0; subscriber < entries_.size(); ++subscriber)
    if (entries_.find(subscriber, entity)) news_.push_back({subscriber, entity, 0, 0});
}

void PairStates::touch_subscriber(Subscriber subscriber) {
  if (subscriber >= entries_.size()) return;
  for (const Entry& entry : entries_[subscriber].span())
    news_.push_back({subscriber, entry.entity, 0, 0});
}

void PairStates::take(std::size_t k, std::span<const Change> changes) {
  assert(k < filter_max);
  const auto bit = static_cast<Decisions>(1u << k);
  for (const Change& change : changes) {
    assert(change.transition != Transition::tier_changed);  // an operand only lets pairs in or out
    if (change.transition == Transition::entered)
      news_.push_back({change.subscriber, change.entity, bit, 0});
    if (change.transition == Transition::left)
      news_.push_back({change.subscriber, change.entity, 0, bit});
  }
}

void PairStates::join_news() {
  if (!std::is_sorted(news_.data(), news_.data() + news_.size(), is_before))
    std::sort(news_.data(), news_.data() + news_.size(), is_before);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < news_.size(); ++i) {
    if (kept > 0 && !is_before(news_[kept - 1], news_[i])) {
      News& last = news_[kept - 1];
      last.on = static_cast<Decisions>(last.on | news_[i].on),
      last.off = static_cast<Decisions>(last.off | news_[i].off);
    } else {
      news_[kept++] = news_[i];
    }
  }
  news_.resize(kept);
}

void PairStates::check() const {
  entries_.check([](const Entry& entry) {
    return (entry.decisions != 0 || entry.level != 0) && entry.level <= filter_max;
  });
}

}  // namespace rink::im
