// A repeated step is no change: a federate may receive the same notice twice.
#include "loadgen/measure/truth/scope_history.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace rink::loadgen {

void ScopeHistory::advance(double instant_s) {
  for (; next_ < steps_.size() && steps_[next_].instant_s <= instant_s; ++next_) {
    const ScopeStep& step = steps_[next_];
    if (step.entity >= entered_s_.size()) entered_s_.resize(step.entity + 1);
    if (!step.is_in) entered_s_[step.entity].reset();
    else if (!entered_s_[step.entity]) entered_s_[step.entity] = step.instant_s;
  }
}

void ScopeHistory::list(std::uint32_t own, std::vector<std::uint32_t>& entities) const {
  entities.clear();
  for (std::uint32_t entity = 0; entity < entered_s_.size(); ++entity)
    if (entered_s_[entity] && entity != own) entities.push_back(entity);
}

ScopeChanges count_changes(std::span<const ScopeStep> steps, std::uint32_t own, double from_s,
                           double until_s) {
  struct Known {
    bool is_in = false;
    double left_s = -std::numeric_limits<double>::infinity();
  };
  assert(std::ranges::is_sorted(steps, {}, &ScopeStep::instant_s));
  std::vector<Known> known;
  ScopeChanges changes;
  for (const ScopeStep& step : steps) {
    if (step.instant_s >= until_s) break;
    if (step.entity >= known.size()) known.resize(step.entity + 1);
    Known& entity = known[step.entity];
    if (entity.is_in == step.is_in) continue;
    entity.is_in = step.is_in;
    const bool is_counted = step.instant_s >= from_s && step.entity != own;
    if (!step.is_in) entity.left_s = step.instant_s;
    if (!is_counted) continue;
    ++(step.is_in ? changes.entries : changes.exits);
    if (step.is_in && step.instant_s - entity.left_s < flap_s) ++changes.flaps;
  }
  assert(changes.flaps <= changes.entries);
  return changes;
}

}  // namespace rink::loadgen
