// The stage `donnybrook` by brute force: the interest set sorted from the definition of attention,
// and everybody else at the rate of guidance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/im/cases.h"
#include "tests/im/long_play.h"
#include "tests/im/stage_counts.h"

namespace rink::im {
namespace {

using Tiers = std::map<std::pair<Subscriber, Entity>, unsigned>;

/// Keeps the tier of each pair that a filter let through.
void follow(Filter& filter, Tiers& tiers) {
  for (const Change& change : filter.match()) {
    const std::pair pair{change.subscriber, change.entity};
    ASSERT_EQ(tiers.contains(pair), change.transition != Transition::entered);
    if (change.transition == Transition::left) {
      tiers.erase(pair);
      continue;
    }
    ASSERT_FALSE(change.transition == Transition::tier_changed && tiers[pair] == change.tier);
    tiers[pair] = change.tier;
  }
}

struct Player : Region {
  Facts facts;
  Role role;
};

Player draw_player(Random& random, double half) {
  Player player{draw_random(random, half), {}, {}};
  player.facts = {.velocity_x = between(random, -2.0, 2.0),
                  .velocity_y = between(random, -2.0, 2.0),
                  .heading = draw_heading(random),
                  .changed_at = between(random, -5.0, 0.0)};
  if (between(random, 0.0, 1.0) < 0.2) player.facts = {};
  player.role.owner = between(random, 0.0, 1.0) < 0.5
                          ? Role::none
                          : static_cast<std::uint32_t>(between(random, 0.0, 6.0));
  return player;
}

bool is_own(const Player& me, const Player& its) {
  return me.role.owner != Role::none && me.role.owner == its.role.owner;
}

/// By angles, in long double.
long double attention(const Player& me, const Player& its, double now) {
  const long double x = middle(its.low_x, its.high_x) - middle(me.low_x, me.high_x),
                    y = middle(its.low_y, its.high_y) - middle(me.low_y, me.high_y),
                    reach = std::min(me.high_x - me.low_x, me.high_y - me.low_y) / 2.0L;
  const Heading ahead = me.facts.heading == Heading{}
                            ? Heading{me.facts.velocity_x, me.facts.velocity_y}
                            : me.facts.heading;
  const long double angle = std::atan2(y, x) - std::atan2(ahead.y + 0.0L, ahead.x + 0.0L);
  return std::max(0.0L, 1.0L - std::hypot(x, y) / reach) +
         (ahead == Heading{} ? 0.0L : (1.0L + std::cos(angle)) / 2.0L) +
         1.0L / (1.0L + now - its.facts.changed_at);
}

Tiers expected(const std::vector<Player>& subscribers, const std::vector<Player>& entities,
               const Relevant& relevant, double now, std::size_t count, unsigned guidance) {
  Tiers tiers;
  for (Subscriber s = 0; s < subscribers.size(); ++s) {
    const Player& me = subscribers[s];
    std::vector<std::pair<long double, Entity>> others;
    for (Entity e = 0; e < entities.size(); ++e) {
      if (!relevant(Observer{me, {}, me.role}, Body{entities[e], entities[e].role})) continue;
      if (is_own(me, entities[e])) tiers[{s, e}] = 0;
      else others.push_back({-attention(me, entities[e], now), e});
    }
    std::sort(others.begin(), others.end());
    for (std::size_t i = 0; i < others.size(); ++i)
      tiers[{s, others[i].second}] = i < count ? 0 : guidance;
  }
  return tiers;
}

void play_donnybrook(const std::string& inner, std::uint64_t seed) {
  SCOPED_TRACE(inner + " with seed " + std::to_string(seed));
  Random random(seed);
  const FilterSettings settings = settings_for(seed);
  const Relevant relevant = rule_of(inner, settings);
  const auto filter = make_filter(inner + " with donnybrook(k=3 guidance=4)", settings);
  std::vector<Player> entities(40), subscribers(8);
  Tiers tiers;
  for (int round = 0; round < 40; ++round) {
    const double share = round == 0 ? 1.0 : round % 3 == 0 ? 0.0 : 0.2, now = 0.1 * round;
    filter->set_time(now);
    for (Entity e = 0; e < entities.size(); ++e) {
      if (between(random, 0.0, 1.0) >= share) continue;
      entities[e] = draw_player(random, 0.5);
      filter->set_update_region(e, entities[e]);
      filter->set_entity_facts(e, entities[e].facts);
      filter->set_entity_role(e, entities[e].role);
    }
    for (Subscriber s = 0; s < subscribers.size(); ++s) {
      if (between(random, 0.0, 1.0) >= share) continue;
      subscribers[s] = draw_player(random, 5.0);
      filter->set_subscription_region(s, subscribers[s]);
      filter->set_subscriber_facts(s, subscribers[s].facts);
      filter->set_subscriber_role(s, subscribers[s].role);
    }
    follow(*filter, tiers);
    ASSERT_EQ(tiers, expected(subscribers, entities, relevant, now, 3, 4)) << "round " << round;
  }
}

TEST(Donnybrook, SendsTheInterestSetInFullAndGuidanceAboutTheRest) {
  for (const char* inner : {"none", "region", "aura", "sight", "team"})
    for (std::uint64_t seed = 1; seed <= 10 && !HasFatalFailure(); ++seed)
      play_donnybrook(inner, seed);
}

/// A view of radius 10 around (0, 0) that looks to the right.
std::unique_ptr<Filter> looking_right(const std::string& stage) {
  auto filter = make_filter("none with " + stage, hundred);
  filter->set_subscription_region(0, around(0.0, 0.0, 10.0));
  filter->set_heading(0, {1.0, 0.0});
  return filter;
}

TEST(Donnybrook, PrefersWhatIsNearAheadAndNew) {
  const auto filter = looking_right("donnybrook(k=1)");
  filter->set_update_region(0, point(-4.0, 0.0));  // 0.6 + 0
  filter->set_update_region(1, point(0.0, 5.0));   // 0.5 + 0.5
  filter->set_update_region(2, point(9.0, 0.0));   // 0.1 + 1
  filter->set_update_region(3, point(20.0, 0.0));  // 0 + 1
  Tiers tiers;
  follow(*filter, tiers);
  EXPECT_EQ(tiers, (Tiers{{{0, 0}, 5}, {{0, 1}, 5}, {{0, 2}, 0}, {{0, 3}, 5}}));
  filter->set_time(6.5);
  filter->set_entity_facts(0, {.changed_at = 6.0});
  follow(*filter, tiers);
  EXPECT_EQ(tiers.at({0, 0}), 0u) << "0.6 + 0.67 half a second after its contact";
  EXPECT_EQ(tiers.at({0, 2}), 5u);
  filter->set_time(7.5);
  follow(*filter, tiers);
  EXPECT_EQ(tiers.at({0, 0}), 5u) << "0.6 + 0.4 a second later";
  EXPECT_EQ(tiers.at({0, 2}), 0u);
}

TEST(Donnybrook, PutsTheSmallerIdFirstAndTheOwnBesideTheSet) {
  const auto filter = looking_right("donnybrook(k=1 guidance=2)");
  filter->set_subscriber_role(0, {.owner = 3});
  for (Entity id = 0; id < 3; ++id) filter->set_update_region(id, point(2.0, 0.0));
  filter->set_entity_role(0, {.owner = 3});
  Tiers tiers;
  follow(*filter, tiers);
  EXPECT_EQ(tiers, (Tiers{{{0, 0}, 0}, {{0, 1}, 0}, {{0, 2}, 2}}));
  filter->remove_entity(1), tiers.erase({0, 1});
  follow(*filter, tiers);
  EXPECT_EQ(tiers, (Tiers{{{0, 0}, 0}, {{0, 2}, 0}}));
  EXPECT_EQ(count(*filter, "entities left out"), 3u) << "2 at first, the own each time";
}

TEST(Donnybrook, IsRefusedWithTheFaultNamed) {
  const auto objection = [](const std::string& text) {
    return complaint_about(text, {}).value_or("");
  };
  EXPECT_EQ(objection("none with donnybrook with priority"), "");
  EXPECT_EQ(objection("none with donnybrook(k=2.5)"),
            "donnybrook: k = 2.5 is not a whole number from 1 to 1000000");
  EXPECT_EQ(objection("none with donnybrook(guidance=7)"),
            "donnybrook: guidance = 7 is not a whole number from 1 to 6");
  EXPECT_EQ(objection("none with donnybrook with dwell(matches=2)"),
            "after donnybrook nothing may follow but priority: it decides more than whether a pair "
            "is relevant");
  EXPECT_TRUE(make_filter("none with donnybrook", {})->traits().decides_tiers);
}

}  // namespace
}  // namespace rink::im
