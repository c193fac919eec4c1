// Opens, settles and closes intervals of relevance, look by look.
#include "loadgen/measure/truth/relevance_intervals.h"

#include <algorithm>
#include <cassert>
#include <functional>

namespace rink::loadgen {

void RelevanceIntervals::look(double instant_s, std::span<const Relevant> relevant,
                              const ScopeHistory& delivered, const Passed& passed) {
  assert(std::ranges::adjacent_find(relevant, std::greater_equal<>(), &Relevant::entity) ==
         relevant.end());
  assert((looks_ == 0 || instant_s >= last_s_) && "instants ascend");
  const bool is_first = ++looks_ == 1;
  for (const Relevant& each : relevant) {
    if (each.entity >= intervals_.size()) intervals_.resize(each.entity + 1);
    RelevanceInterval& interval = intervals_[each.entity];
    if (!interval.is_open) {
      const double part = is_first ? 1.0 : passed(each);
      interval = {.begin_s = last_s_ + (instant_s - last_s_) * part,
                  .seen = 0,
                  .is_open = true,
                  .is_settled = is_first};
      open_.push_back(each.entity);
    }
    interval.seen = looks_;
    if (interval.is_settled || !delivered.contains(each.entity)) continue;
    lateness_s_.push_back(std::max(0.0, *delivered.entered_s(each.entity) - interval.begin_s));
    delivered_after_s_.push_back(lateness_s_.back());
    interval.is_settled = true;
  }
  last_s_ = instant_s;
  std::erase_if(open_, [&](std::uint32_t entity) {
    if (intervals_[entity].seen == looks_) return false;
    close(intervals_[entity], instant_s);
    return true;
  });
}

void RelevanceIntervals::close(RelevanceInterval& interval, double instant_s) {
  assert(interval.is_open);
  interval.is_open = false;
  if (interval.is_settled) return;
  lateness_s_.push_back(instant_s - interval.begin_s);
  ++never_delivered_;
}

void RelevanceIntervals::end() {
  for (const std::uint32_t entity : open_) close(intervals_[entity], last_s_);
  open_.clear();
  assert(lateness_s_.size() == delivered_after_s_.size() + never_delivered_);
}

}  // namespace rink::loadgen
