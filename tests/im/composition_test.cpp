// Schemes put together with and, or and not: read, judged by brute force, and refused by name where
// they are wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "im/usage.h"
#include "tests/im/long_play.h"

namespace rink::im {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string complaint(const std::string& expression, const FilterSettings& settings = {}) {
  return complaint_about(expression, settings).value_or("");
}

/// An expression together with what it means.
struct Composed {
  std::string text;
  Relevant rule;
};

Composed draw(Random& random, int depth, const FilterSettings& settings) {
  const double kind = depth == 0 ? 0.0 : between(random, 0.0, 4.0);
  if (kind < 1.0) {
    static const std::vector<std::string> names = schemes_of_pairs();
    const std::string& name =
        names[static_cast<std::size_t>(between(random, 0.0, static_cast<double>(names.size())))];
    return {name, rule_of(name, settings)};
  }
  const Composed a = draw(random, depth - 1, settings);
  if (kind < 2.0)
    return {"not " + (a.text.find(' ') == std::string::npos ? a.text : "(" + a.text + ")"),
            [rule = a.rule](const Observer& s, const Body& u) { return !rule(s, u); }};
  const Composed b = draw(random, depth - 1, settings);
  if (kind < 3.0)
    return {"(" + a.text + " and " + b.text + ")",
            [one = a.rule, other = b.rule](const Observer& s, const Body& u) {
              return one(s, u) && other(s, u);
            }};
  return {"(" + a.text + " or " + b.text + ")",
          [one = a.rule, other = b.rule](const Observer& s, const Body& u) {
            return one(s, u) || other(s, u);
          }};
}

void play_composed(std::uint64_t seed, int matches) {
  FilterSettings settings = settings_for(seed);
  Random random(seed);
  const Composed composed = draw(random, 3, settings);
  SCOPED_TRACE(composed.text);
  play(seed, matches, [&] { return Judged(make_filter(composed.text, settings), composed.rule); });
}

TEST(Composition, ReplaysToTheRecountOnEveryLayout) {
  for (std::uint64_t seed = 1; seed <= 20 && !HasFatalFailure(); ++seed) play_composed(seed, 12);
}

TEST(CompositionLong, ReplaysToTheRecountOverAThousandSeeds) {
  for (std::uint64_t seed = 1000; seed < 2000 && !HasFatalFailure(); ++seed)
    play_composed(seed, 12);
}

TEST(Composition, BindsNotBeforeAndBeforeOr) {
  const FilterSettings settings = settings_for(2);
  const auto is = [&](const char* text, auto meaning) {
    SCOPED_TRACE(text);
    play(5, 6, [&] { return Judged(make_filter(text, settings), meaning); });
  };
  const Relevant region = rule_of("region", settings), grid = rule_of("grid", settings),
                 team = rule_of("team", settings);
  is("region or grid and not team",
     [&](const Observer& s, const Body& u) { return region(s, u) || (grid(s, u) && !team(s, u)); });
  is("not region and grid or team",
     [&](const Observer& s, const Body& u) { return (!region(s, u) && grid(s, u)) || team(s, u); });
  is("not not region", region);
  is("  ( region  or none )and  region", region);
}

TEST(Composition, TakesParametersOfItsSchemes) {
  FilterSettings settings = settings_for(2);
  settings.cell_size = 3.0, settings.half_angle_deg = 90.0;
  FilterSettings other = settings;
  other.cell_size = 0.5, other.half_angle_deg = 45.0;
  const Relevant grid = rule_of("grid", other), cone = rule_of("cone", other),
                 coarse = rule_of("grid", settings);
  play(7, 12, [&] {
    return Judged(
        make_filter("grid(cell_size=0.5) and not grid or cone( half_angle=45 )", settings),
        [&](const Observer& s, const Body& u) {
          return (grid(s, u) && !coarse(s, u)) || cone(s, u);
        });
  });
  EXPECT_EQ(make_filter("aura and (grid(cell_size=2) or hex)", settings)->cell_size(), 2.0);
}

TEST(Composition, TakesASizeOfCellsWhereASchemeWithCellsLeavesItOpen) {
  for (const char* open : {"grid", "not hex", "aura or (hybrid and strips)",
                           "grid(cell_size=2) or grid", "hierarchical with dwell(matches=3)"})
    EXPECT_TRUE(takes_cell_size(open)) << open;
  for (const char* fixed : {"region", "grid(cell_size=2)", "not (aura or hex(cell_size=1))",
                            "strips(cell_size=3) with dwell(matches=3)", "gird", "grid and"})
    EXPECT_FALSE(takes_cell_size(fixed)) << fixed;
}

TEST(Composition, IsNetAndCostsNothingAtRest) {
  const auto filter =
      make_filter("(aura and not team) or always", {.world = {0.0, 0.0, 100.0, 100.0}});
  for (std::uint32_t id = 0; id < 50; ++id) {
    filter->set_subscription_region(id, around(2.0 * id, 50.0, 10.0));
    filter->set_update_region(id, around(2.0 * id, 50.0, 0.1));
  }
  filter->set_entity_role(7, {.is_always_relevant = true});
  EXPECT_GT(filter->match().size(), 500u);
  const FilterCounters before = filter->counters();
  EXPECT_EQ(before.entries, before.changes);
  for (std::uint32_t id = 0; id < 50; ++id)
    filter->set_update_region(id, around(2.0 * id, 50.0, 0.1));
  EXPECT_TRUE(filter->match().empty());
  EXPECT_EQ(filter->counters().pairs_tested, before.pairs_tested);
  EXPECT_EQ(filter->counters().regions_moved, before.regions_moved);
  filter->set_entity_role(7, {});
  filter->set_entity_role(7, {.is_always_relevant = true});
  EXPECT_TRUE(filter->match().empty()) << "net";
}

TEST(Roles, MakeATeamAndAnOwnerAndWhoIsAlwaysRelevant) {
  const auto filter = make_filter("team or owner or always", {});
  filter->set_entity_role(0, {.team = 3});  // nobody yet
  for (std::uint32_t id = 0; id < 4; ++id) filter->set_update_region(id, {});
  filter->set_subscription_region(0, {});
  EXPECT_THAT(filter->match(), IsEmpty()) << "nobody has a role, and none is not a team";
  filter->set_subscriber_role(0, {.team = 3, .owner = 8});
  filter->set_entity_role(0, {.team = 3, .owner = 9});
  filter->set_entity_role(1, {.team = 8, .owner = 8});
  filter->set_entity_role(2, {.is_always_relevant = true});
  EXPECT_THAT(filter->match(),
              ElementsAre(Change{0, 0, Transition::entered}, Change{0, 1, Transition::entered},
                          Change{0, 2, Transition::entered}));
  filter->remove_entity(1);
  filter->set_update_region(1, {});
  EXPECT_THAT(filter->match(), IsEmpty()) << "whoever comes again has no role";
}

TEST(Traits, SayWhatAFilterMakesUseOf) {
  const auto of = [](const char* expression) {
    const Traits traits = make_filter(expression, {})->traits();
    return std::string(traits.uses_roles ? "roles " : "") +
           (traits.uses_headings ? "headings " : "") + (traits.uses_flights ? "flights " : "") +
           (traits.decides_tiers ? "tiers" : "") + (traits.holds_updates ? "held" : "");
  };
  for (const char* plain : {"none", "region", "aura and not sight",
                            "grid with hysteresis(margin=1) with dwell(matches=3) with priority"})
    EXPECT_EQ(of(plain), "") << plain;
  EXPECT_EQ(of("aura or team"), "roles ");
  EXPECT_EQ(of("(region and not cone) with hysteresis(margin=1)"), "headings ");
  EXPECT_EQ(of("(always or cone) with swept(horizon=1) with tiers(at=0.5) with priority"),
            "roles headings flights tiers");
  EXPECT_EQ(of("region with vfc(at=0.5 matches=3) with priority"), "held");
}

TEST(Expression, IsRefusedByNameWhereItIsWrong) {
  EXPECT_EQ(complaint("aura and not sight"), "");
  EXPECT_THAT(complaint(""),
              HasSubstr("expected the name of a scheme, 'not' or '(' where it ends"));
  EXPECT_THAT(complaint("aura und sight"),
              HasSubstr("expected 'and', 'or', 'with' or the end at 'und'"));
  EXPECT_THAT(complaint("aura and nonesuch"),
              HasSubstr("no scheme is called 'nonesuch'; there are always, aura"));
  EXPECT_THAT(complaint("aura with nonesuch"),
              HasSubstr("no stage is called 'nonesuch'; there are donnybrook, dwell"));
  EXPECT_THAT(complaint("(aura"), HasSubstr("expected ')'"));
  EXPECT_THAT(complaint("aura)"), HasSubstr("at ')'"));
  EXPECT_EQ(complaint("aura(cell_size=2)"), "aura has no parameter cell_size, nor any other");
  EXPECT_EQ(complaint("grid(size=2)"), "grid has no parameter size; it has cell_size");
  EXPECT_EQ(complaint("grid(cell_size=0)"),
            "grid: cell_size = 0 is not a number from 0.001 to 1000000");
  EXPECT_EQ(complaint("grid(cell_size=1 cell_size=2)"), "grid: cell_size is given twice");
  EXPECT_THAT(complaint("grid(cell_size=nan)"), HasSubstr("expected a number after 'cell_size='"));
  EXPECT_THAT(complaint("grid(cell_size=1e999)"),
              HasSubstr("expected a number after 'cell_size='"));
  EXPECT_THAT(complaint("grid(cell_size 2)"), HasSubstr("expected '=' after 'cell_size'"));
  EXPECT_EQ(complaint("aura with hysteresis"), "hysteresis needs margin=NUMBER");
  EXPECT_EQ(complaint("aura with dwell(matches=1.5)"),
            "dwell: matches = 1.5 is not a whole number from 1 to 100000");
  EXPECT_EQ(complaint("aura with tiers(at=0.5 at=0.2)"), "tiers: at must ascend");
  EXPECT_THAT(complaint("aura with tiers(at=0.5) with dwell(matches=2)"),
              HasSubstr("after tiers nothing may follow but priority"));
  EXPECT_EQ(complaint("aura with tiers(at=0.5) with priority"), "");
  EXPECT_THAT(complaint(std::string(3000, '(')), HasSubstr("more than 32 levels"));
  EXPECT_EQ(complaint(std::string(32, '(') + "aura" + std::string(32, ')')), "");
  EXPECT_THAT(complaint(std::string(33, '(') + "aura" + std::string(33, ')')),
              HasSubstr("more than 32 levels"));
  EXPECT_THAT(complaint("grid(cell_size=1e-7)"), HasSubstr("cell_size = 1e-07 is not"));
  std::string chain = "aura";
  for (int i = 0; i < 20'000; ++i) chain += " or aura";
  const auto stacked = [](int count) {
    std::string text = "aura";
    for (int i = 0; i < count; ++i) text += " with hysteresis(margin=0.1)";
    return text;
  };
  EXPECT_EQ(complaint(stacked(8)), "");
  EXPECT_THAT(complaint(stacked(9)), HasSubstr("more than 8 stages"));
  EXPECT_THAT(complaint(chain), HasSubstr("longer than 4000 characters"));
  std::string many = "aura";
  for (int i = 0; i < 14; ++i) many += " or aura";
  EXPECT_EQ(complaint(many), "");
  EXPECT_EQ(complaint(many + " or aura"), "more than 15 schemes in one combination");
  for (const std::string& name : filter_names()) EXPECT_EQ(complaint(name), "");
}

TEST(Expression, IsTaughtByNameWithItsParameters) {
  EXPECT_EQ(usage_of("aura"), "aura");
  EXPECT_EQ(usage_of("cone"), "cone([half_angle=0..180])");
  EXPECT_EQ(usage_of("tiers"), "tiers(at=0.000001..1 ...)");
  EXPECT_EQ(usage_of("vfc"),
            "vfc(at=0..1 ... [distance=0..1000000000 ...] [matches=0..100000 ...] "
            "[updates=0..100000 ...])");
  EXPECT_EQ(usage_of("swept"), "swept([disc=0..1] [drag=0..1000000] horizon=0..1000000)");
}

TEST(Settings, AreRefusedByNameWhereTheyAreWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint("sight", {.posts = {{0, 0, 1}, {0, nan, 1}}}),
            "post 1 is not finite: a number is infinite or not a number");
  EXPECT_EQ(complaint("sight", {.posts = {{0, 0, -1}}}), "post 0 has a negative radius");
  EXPECT_EQ(complaint("cone", {.half_angle_deg = 181.0}),
            "the half angle of a view is not a number from 0 to 180");
  EXPECT_EQ(complaint("cone", {.drag = -1.0}), "the drag of flights is not a finite number from 0");
  EXPECT_EQ(complaint("grid", {.world = {0, 0, 0, 1}}), "the world has no area");
  EXPECT_EQ(complaint("grid", {.cell_size = nan}), "the cell size is not a positive finite number");
  EXPECT_FALSE(make_filter("grid", {.cell_size = nan}));
}

TEST(Expression, MakesANameForFilesThatNoOtherMakes) {
  EXPECT_EQ(file_name_of("aura and not (sight or grid(cell_size=2))"),
            "aura_and_not_[sight_or_grid[cell_size=2]]");
  EXPECT_EQ(file_name_of("region"), "region");
}

/// Of more than 100 characters the first 83 are kept, and the 16 digits of the FNV-1a digest of
/// all: here one that begins with a nought, by another program.
TEST(Expression, ShortensALongNameForFilesToOneThatNoOtherMakes) {
  std::string expression;
  for (int i = 0; i < 10; ++i) expression += "region or ";
  const std::string name = file_name_of(expression + "aura2400");
  EXPECT_EQ(name,
            "region_or_region_or_region_or_region_or_region_or_region_or_region_or_region_or_reg-"
            "02d2f4dc37c09004");
  EXPECT_NE(file_name_of(expression + "aura"), name);
}

}  // namespace
}  // namespace rink::im
