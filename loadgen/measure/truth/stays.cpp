// Opens, settles and closes stays, look by look.
#include "loadgen/measure/truth/stays.h"

#include <algorithm>
#include <cassert>
#include <functional>

namespace rink::loadgen {

void Stays::look(double instant_s, std::span<const Relevant> relevant,
                 const ScopeHistory& delivered, const Passed& passed) {
  assert(std::ranges::adjacent_find(relevant, std::greater_equal<>(), &Relevant::entity) ==
         relevant.end());
  assert((looks_ == 0 || instant_s >= last_s_) && "instants ascend");
  const bool is_first = ++looks_ == 1;
  for (const Relevant& each : relevant) {
    if (each.entity >= stays_.size()) stays_.resize(each.entity + 1);
    Stay& stay = stays_[each.entity];
    if (!stay.is_open) {
      const double part = is_first ? 1.0 : passed(each);
      stay = {.begin_s = last_s_ + (instant_s - last_s_) * part,
              .seen = 0,
              .is_open = true,
              .is_settled = is_first};
      open_.push_back(each.entity);
    }
    stay.seen = looks_;
    if (stay.is_settled || !delivered.contains(each.entity)) continue;
    lateness_s_.push_back(std::max(0.0, *delivered.entered_s(each.entity) - stay.begin_s));
    delivered_after_s_.push_back(lateness_s_.back());
    stay.is_settled = true;
  }
  last_s_ = instant_s;
  std::erase_if(open_, [&](std::uint32_t entity) {
    if (stays_[entity].seen == looks_) return false;
    close(stays_[entity], instant_s);
    return true;
  });
}

void Stays::close(Stay& stay, double instant_s) {
  assert(stay.is_open);
  stay.is_open = false;
  if (stay.is_settled) return;
  lateness_s_.push_back(instant_s - stay.begin_s);
  ++never_delivered_;
}

void Stays::end() {
  for (const std::uint32_t entity : open_) close(stays_[entity], last_s_);
  open_.clear();
  assert(lateness_s_.size() == delivered_after_s_.size() + never_delivered_);
}

}  // namespace rink::loadgen
