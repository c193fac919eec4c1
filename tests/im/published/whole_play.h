// Random play judged by rules that must see all entities at once, as those of stages that choose
// among them do.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>

#include "tests/im/long_play.h"

namespace rink::im {

/// From the middle of a subscription to that of an entity.
struct Offset {
  double x, y;
  double squared() const { return x * x + y * y; }
};

inline Offset offset_of(const Region& s, const Region& u) {
  return {middle(u.low_x, u.high_x) - middle(s.low_x, s.high_x),
          middle(u.low_y, u.high_y) - middle(s.low_y, s.high_y)};
}

/// Seeds from `first` on, of so many matches each.
struct Span {
  std::uint64_t first, count;
  int matches;
};

/// Plays `text` on every layout; `rule_for(settings)` gives `rule(judged, subscription, update)`.
template <class RuleFor>
void play_whole(const std::string& text, const Span& seeds, const RuleFor& rule_for) {
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed) {
    const FilterSettings settings = settings_for(seed);
    const auto rule = rule_for(settings);
    for (const Layout& layout : layouts) {
      SCOPED_TRACE(text + " on " + layout.name + " with seed " + std::to_string(seed));
      const Judged* all = nullptr;
      Judged judged(make_filter(text, settings),
                    [&](const Observer& me, const Body& its) { return rule(*all, me, its); });
      all = &judged;
      Random random(seed);
      for (int i = 0; i < seeds.matches; ++i) {
        constexpr std::array activities{1.0, 0.3, 0.05};
        disturb(judged, random, layout,
                activities[static_cast<std::size_t>(i) % activities.size()]);
        judged.check_match();
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

/// Who entered at a match.
inline std::set<Entity> told(Filter& filter) {
  std::set<Entity> entities;
  for (const Change& change : filter.match())
    if (change.transition == Transition::entered) entities.insert(change.entity);
  return entities;
}

}  // namespace rink::im
