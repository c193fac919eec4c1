// Conditions, scores and ranks: every pair by brute force from the language's own page, and that
// what rests costs nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "im/filter.h"
#include "im/pairs/pair_filter.h"
#include "tests/im/layouts.h"
#include "tests/im/recount.h"

namespace rink::im {
namespace conditions {  // short names, of which a translation unit has more
namespace {

/// All that a party may be asked for, as the test knows it.
struct Known {
  Region region;
  Role role;
  Facts facts;
  Heading heading;  ///< of a subscriber
};
using Rule = std::function<bool(const Known& me, const Known& its, double now)>;
using Score = std::function<double(const Known& me, const Known& its, double now)>;

double mid_x(const Known& k) { return (k.region.low_x + k.region.high_x) / 2.0; }
double mid_y(const Known& k) { return (k.region.low_y + k.region.high_y) / 2.0; }
double away(const Known& a, const Known& b) {
  return std::sqrt((mid_x(b) - mid_x(a)) * (mid_x(b) - mid_x(a)) +
                   (mid_y(b) - mid_y(a)) * (mid_y(b) - mid_y(a)));
}
double speed_of(const Known& k) {
  return std::sqrt(k.facts.velocity_x * k.facts.velocity_x +
                   k.facts.velocity_y * k.facts.velocity_y);
}

/// A filter, what it was handed, and its changes replayed.
class Play {
 public:
  Play(const std::string& expression, std::uint64_t seed)
      : filter_(make_filter(expression, {.world = {0.0, 0.0, side, side}, .cell_size = 1.0})),
        random_(seed) {}

  Filter* filter() { return filter_.get(); }
  const std::map<std::uint32_t, Known>& entities() const { return entities_; }
  const std::map<std::uint32_t, Known>& subscribers() const { return subscribers_; }
  double now() const { return now_; }
  const Pairs& pairs() const { return pairs_; }

  /// Some come, go, move, or change in what they are.
  void step() {
    now_ += 0.25;
    filter_->set_time(now_);
    for (std::uint32_t id = 0; id < 24; ++id) {
      if (chance(0.5)) put_entity(id);
      if (id < 7 && chance(0.4)) put_subscriber(id);
      if (chance(0.03)) remove(id);
    }
    match();
  }
  void match() {
    for (const Change& change : filter_->match()) {
      const std::pair pair{change.subscriber, change.entity};
      if (change.transition == Transition::entered) {
        ASSERT_TRUE(pairs_.insert(pair).second);
      } else if (change.transition == Transition::left) {
        ASSERT_EQ(pairs_.erase(pair), 1u);
      }
    }
  }

 private:
  bool chance(double share) { return between(random_, 0.0, 1.0) < share; }
  /// Quarters: ties everywhere.
  double quarter(double low, double high) {
    return std::round(4.0 * between(random_, low, high)) / 4.0;
  }
  Role role() {
    return {.team = chance(0.3) ? Role::none : static_cast<std::uint32_t>(between(random_, 0, 3)),
            .owner = chance(0.5) ? Role::none : static_cast<std::uint32_t>(between(random_, 0, 7)),
            .is_always_relevant = chance(0.1)};
  }
  Facts facts() {
    Facts all{.velocity_x = quarter(-3.0, 3.0), .velocity_y = quarter(-3.0, 3.0)};
    all.kind = static_cast<EntityKind>(between(random_, 0.0, 3.99));
    if (chance(0.3)) all.heading = {quarter(-1.0, 1.0), 1.0};
    if (chance(0.8)) all.changed_at = now_ - quarter(0.0, 4.0);
    return all;
  }
  void put_entity(std::uint32_t id) {
    Known& known = entities_[id];
    if (chance(0.7))
      known.region = around(quarter(0.0, side), quarter(0.0, side), quarter(0.0, 0.5));
    filter_->set_update_region(id, known.region);
    if (chance(0.5)) filter_->set_entity_role(id, known.role = role());
    if (chance(0.6)) filter_->set_entity_facts(id, known.facts = facts());
  }
  void put_subscriber(std::uint32_t id) {
    Known& known = subscribers_[id];
    if (chance(0.7))
      known.region = around(quarter(0.0, side), quarter(0.0, side), quarter(1.0, 5.0));
    filter_->set_subscription_region(id, known.region);
    if (chance(0.5)) filter_->set_subscriber_role(id, known.role = role());
    if (chance(0.6)) filter_->set_subscriber_facts(id, known.facts = facts());
    if (chance(0.3))
      filter_->set_heading(
          id, known.heading =
                  chance(0.3) ? Heading{} : Heading{quarter(-1.0, 1.0), quarter(0.25, 1.0)});
  }
  void remove(std::uint32_t id) {
    filter_->remove_entity(id), filter_->remove_subscriber(id);
    entities_.erase(id), subscribers_.erase(id);
    std::erase_if(pairs_, [id](const auto& p) { return p.first == id || p.second == id; });
  }

  std::unique_ptr<Filter> filter_;
  Random random_;
  double now_ = 0.0;
  std::map<std::uint32_t, Known> entities_, subscribers_;
  Pairs pairs_;
};

Pairs recount(const Play& play, const Rule& rule) {
  Pairs expected;
  for (const auto& [s, me] : play.subscribers())
    for (const auto& [e, its] : play.entities())
      if (rule(me, its, play.now())) expected.insert({s, e});
  return expected;
}

void expect_rule(const std::string& expression, const Rule& rule) {
  SCOPED_TRACE(expression);
  std::size_t relevant = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Play play(expression, seed);
    ASSERT_NE(play.filter(), nullptr) << complaint_about(expression, {}).value_or("");
    for (int i = 0; i < 40; ++i) {
      ASSERT_NO_FATAL_FAILURE(play.step());
      ASSERT_EQ(play.pairs(), recount(play, rule)) << "seed " << seed << ", match " << i;
      relevant += play.pairs().size();
      all += play.subscribers().size() * play.entities().size();
    }
  }
  EXPECT_GT(relevant, all / 200) << "hardly anything is ever relevant";
  EXPECT_LT(relevant, all) << "all is always relevant";
}

bool overlaps(const Known& me, const Known& its) { return overlap_closed(me.region, its.region); }
double age_of(const Known& k, double now) { return std::max(0.0, now - k.facts.changed_at); }

TEST(Condition, IsJudgedByBruteForceOverAllPairs) {
  expect_rule("when \"distance < 4 and (team == mine or speed > 2)\"",
              [](const Known& me, const Known& its, double) {
                const bool is_mate = its.role.team != Role::none && its.role.team == me.role.team;
                return overlaps(me, its) && away(me, its) < 4.0 && (is_mate || speed_of(its) > 2.0);
              });
  expect_rule("anywhere \"distance < 4 and (team == mine or speed > 2)\"",
              [](const Known& me, const Known& its, double) {
                const bool is_mate = its.role.team != Role::none && its.role.team == me.role.team;
                return away(me, its) < 4.0 && (is_mate || speed_of(its) > 2.0);
              });
  expect_rule("when 'kind == puck or kind != mine and not always'", [](const Known& me,
                                                                       const Known& its, double) {
    return overlaps(me, its) && (its.facts.kind == EntityKind::puck ||
                                 (its.facts.kind != me.facts.kind && !its.role.is_always_relevant));
  });
  expect_rule("anywhere 'age <= 1.5 and size >= 0.5'",
              [](const Known&, const Known& its, double now) {
                return age_of(its, now) <= 1.5 && its.region.high_x - its.region.low_x >= 0.5;
              });
  expect_rule("when 'owner == none or owner == mine or team != my.team'",
              [](const Known& me, const Known& its, double) {
                const bool is_own = its.role.owner != Role::none && its.role.owner == me.role.owner;
                const bool is_mate = its.role.team != Role::none && its.role.team == me.role.team;
                return overlaps(me, its) && (its.role.owner == Role::none || is_own || !is_mate);
              });
  expect_rule(
      "anywhere 'abs(offset_x) + abs(offset_y) <= reach or closing > 1.5'",
      [](const Known& me, const Known& its, double) {
        const double x = mid_x(its) - mid_x(me), y = mid_y(its) - mid_y(me);
        const double reach =
            std::min(me.region.high_x - me.region.low_x, me.region.high_y - me.region.low_y) / 2.0;
        const double closing = away(me, its) == 0.0
                                   ? 0.0
                                   : -(x * (its.facts.velocity_x - me.facts.velocity_x) +
                                       y * (its.facts.velocity_y - me.facts.velocity_y)) /
                                         away(me, its);
        return std::abs(x) + std::abs(y) <= reach || closing > 1.5;
      });
  expect_rule(
      "anywhere 'gap < 3 and speed - my.speed > -1 and y / 2 < max(x, 3) * -(0 - 1)'",
      [](const Known& me, const Known& its, double) {
        const double x = std::clamp(mid_x(me), its.region.low_x, its.region.high_x) - mid_x(me),
                     y = std::clamp(mid_y(me), its.region.low_y, its.region.high_y) - mid_y(me);
        return std::sqrt(x * x + y * y) < 3.0 && speed_of(its) - speed_of(me) > -1.0 &&
               mid_y(its) / 2.0 < std::max(mid_x(its), 3.0);
      });
}

/// Degrees come from atan2; the truth here is the cosine, with room for the rounding of either.
TEST(Condition, KnowsAnglesAndHeadings) {
  const auto is = [](const char* expression, const Heading& heading, double x, double y) {
    const auto filter = make_filter(expression, {.world = {0.0, 0.0, 10.0, 10.0}});
    filter->set_subscription_region(0, around(5.0, 5.0, 4.0));
    filter->set_heading(0, heading);
    filter->set_update_region(0, {5.0 + x, 5.0 + y, 5.0 + x, 5.0 + y});
    filter->set_entity_facts(0, {.velocity_x = -1.0, .velocity_y = 0.0});
    return filter->match().size() == 1;
  };
  for (int degrees = 1; degrees < 180; ++degrees) {
    const double angle = (degrees + 0.5) * 3.14159265358979323846 / 180.0;
    EXPECT_EQ(is("when 'angle < 60'", {2.0, 0.0}, std::cos(angle), std::sin(angle)), degrees < 60)
        << degrees;
    EXPECT_EQ(is("when 'angle < 60'", {2.0, 0.0}, std::cos(angle), -std::sin(angle)), degrees < 60);
  }
  EXPECT_FALSE(is("when 'angle < 180'", {}, 1.0, 0.0)) << "no heading is known";
  EXPECT_TRUE(is("when 'heading == 180 and my.heading == 90'", {0.0, 0.5}, 1.0, 0.0));
}

TEST(Condition, TestsNothingAtRestAndOnlyWhatChanged) {
  for (const char* expression :
       {"when 'distance < 4 and speed > 0.5'", "anywhere 'team == mine or distance < 3'",
        "when 'distance < 4' with nearest(k=3)", "region with top(k=2) by 'speed - distance'"}) {
    SCOPED_TRACE(expression);
    Play play(expression, 1);
    for (int i = 0; i < 10; ++i) play.step();
    const FilterCounters before = play.filter()->counters();
    ASSERT_NO_FATAL_FAILURE(play.match());
    for (const auto& [id, known] : play.entities()) {
      play.filter()->set_update_region(id, known.region);
      play.filter()->set_entity_role(id, known.role);
      play.filter()->set_entity_facts(id, known.facts);
    }
    EXPECT_TRUE(play.filter()->match().empty());
    EXPECT_EQ(play.filter()->counters().pairs_tested, before.pairs_tested);
    const auto [id, known] = *play.entities().begin();
    Facts faster = known.facts;
    faster.velocity_x += 1.0;
    play.filter()->set_entity_facts(id, faster);
    play.filter()->match();
    EXPECT_LE(play.filter()->counters().pairs_tested,
              before.pairs_tested + play.subscribers().size() * play.entities().size());
  }
  const auto places = make_filter("anywhere 'distance < 3'", {});
  EXPECT_FALSE(places->traits().uses_facts) << "it asks for places alone";
  EXPECT_FALSE(places->traits().uses_roles);
  const auto all = make_filter("when 'team == mine and age < 2 and speed > 1'", {});
  EXPECT_TRUE(all->traits().uses_facts && all->traits().uses_roles && all->traits().uses_time);
}

/// The k best of those that `rule` holds relevant, by score and then by id.
void expect_rank(const std::string& expression, std::size_t k, const Rule& rule,
                 const Score& score) {
  SCOPED_TRACE(expression);
  std::size_t cut = 0, ties = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Play play(expression, seed);
    ASSERT_NE(play.filter(), nullptr) << complaint_about(expression, {}).value_or("");
    for (int i = 0; i < 40; ++i) {
      ASSERT_NO_FATAL_FAILURE(play.step());
      Pairs expected;
      for (const auto& [s, me] : play.subscribers()) {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (const auto& [e, its] : play.entities())
          if (rule(me, its, play.now())) order.push_back({-score(me, its, play.now()), e});
        std::sort(order.begin(), order.end());
        if (order.size() > k) {
          ++cut;
          if (order[k].first == order[k - 1].first) ++ties;
          order.resize(k);
        }
        for (const auto& [_, e] : order) expected.insert({s, e});
      }
      ASSERT_EQ(play.pairs(), expected) << "seed " << seed << ", match " << i;
    }
  }
  EXPECT_GT(cut, 100u);
  EXPECT_GT(ties, 0u) << "no tie was ever decided";
}

TEST(Rank, KeepsTheFirstByScoreAndThenById) {
  expect_rank(
      "region with nearest(k=3)", 3,
      [](const Known& me, const Known& its, double) { return overlaps(me, its); },
      [](const Known& me, const Known& its, double) { return -away(me, its); });
  expect_rank(
      "none with nearest(k=5)", 5, [](const Known&, const Known&, double) { return true; },
      [](const Known& me, const Known& its, double) { return -away(me, its); });
  expect_rank(
      "(region or team) with top(k=2) by 'speed'", 2,
      [](const Known& me, const Known& its, double) {
        return overlaps(me, its) || (its.role.team != Role::none && its.role.team == me.role.team);
      },
      [](const Known&, const Known& its, double) { return speed_of(its); });
  expect_rank(
      "none with top(k=4) by '-age - distance'", 4,
      [](const Known&, const Known&, double) { return true; },
      [](const Known& me, const Known& its, double now) {
        return -age_of(its, now) - away(me, its);
      });
}

TEST(Rank, MovesTheNextUpWhenAnEntityIsRemoved) {
  const auto filter = make_filter("none with nearest(k=1)", {});
  filter->set_subscription_region(0, {});
  filter->set_update_region(0, {1.0, 0.0, 1.0, 0.0});
  filter->set_update_region(1, {2.0, 0.0, 2.0, 0.0});
  EXPECT_EQ(filter->match().size(), 1u);
  filter->remove_entity(0);
  const auto changes = filter->match();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0], (Change{0, 1, Transition::entered}));
}

/// A score that is no number ranks last.
TEST(Rank, PutsWhatHasNoScoreLast) {
  const auto filter = make_filter("none with top(k=1) by 'sqrt(x)'", {});
  filter->set_subscription_region(0, {});
  filter->set_update_region(0, {-1.0, 0.0, -1.0, 0.0});
  filter->set_update_region(1, {1.0, 0.0, 1.0, 0.0});
  const auto changes = filter->match();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0], (Change{0, 1, Transition::entered}));
}

TEST(PairFunction, IsAShortPathToAPredicateThatAsksMore) {
  const auto is_faster = [](const rink_party& me, const rink_party& its) {
    return std::abs(its.velocity_x) > std::abs(me.velocity_x);
  };
  const auto filter = make_pair_filter({.world = {0.0, 0.0, 10.0, 10.0}},
                                       make_pair_function(is_faster, {.motion = true}));
  filter->set_subscription_region(0, {0.0, 0.0, 10.0, 10.0});
  filter->set_update_region(0, {1.0, 1.0, 2.0, 2.0});
  EXPECT_TRUE(filter->match().empty());
  filter->set_entity_facts(0, {.velocity_x = -1.0});
  EXPECT_EQ(filter->match().size(), 1u);
  filter->set_subscriber_facts(0, {.velocity_x = 2.0});
  EXPECT_EQ(filter->match().size(), 1u);
}

}  // namespace
}  // namespace conditions
}  // namespace rink::im
