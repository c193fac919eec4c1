// Relevance by contact: against brute force, and against what the physics then does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "game/model/random_stream.h"
#include "game/players/random_plan.h"
#include "loadgen/measure/truth/encounters.h"
#include "loadgen/measure/truth/reach.h"
#include "loadgen/measure/truth/replay.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

constexpr double wide_field = 1e3;
const Vector2 middle(0.5 * wide_field, 0.5 * wide_field), diagonal = Vector2(1.0, 1.0).normalized();

physics::WorldSpec wide(double drag, double friction = 0.0) {
  physics::WorldSpec spec;
  spec.field.length = spec.field.width = wide_field;
  spec.puck_drag = spec.bat_drag = drag, spec.puck_friction = friction;
  return spec;
}

/// How far a lone puck gets.
double puck_path(const physics::WorldSpec& spec, double speed, double time_s) {
  physics::World world(spec);
  const physics::BodyId puck =
      world.add(physics::PuckSpec{.position = middle, .velocity = speed * diagonal});
  world.advance(time_s);
  return (world.position(puck) - middle).norm();
}
/// How far a lone bat does.
double bat_path(const physics::WorldSpec& spec, double speed, const Vector2& thrust,
                double time_s) {
  physics::World world(spec);
  const physics::BodyId bat =
      world.add(physics::BatSpec{.position = middle, .velocity = speed * diagonal});
  world.set_thrust(bat, thrust);
  world.advance(time_s);
  return (world.position(bat) - middle).norm();
}

TEST(Reach, IsWhereAPuckGetsAndABatThatIsDrivenTheWayItMoves) {
  constexpr double thrust = 6.9, rounding = 1e-9;
  for (const double drag : {0.0, 0.25, 3.0})
    for (const double time_s : {0.1, 0.5, 3.0})
      for (const double speed : {0.0, 0.4, 5.0}) {
        for (const double friction : {0.0, 0.7})
          EXPECT_NEAR(Reach(time_s, drag, friction).of(speed),
                      puck_path(wide(drag, friction), speed, time_s), rounding)
              << drag << " " << time_s << " " << speed << " " << friction;
        const double farthest = Reach(time_s, drag, 0.0).of(speed, thrust);
        EXPECT_NEAR(farthest, bat_path(wide(drag), speed, thrust * diagonal, time_s), rounding)
            << drag << " " << time_s << " " << speed;
        for (const double angle : {0.0, 1.6, 3.1, 4.5}) {
          const Vector2 elsewhere(std::cos(angle), std::sin(angle));
          EXPECT_LE(bat_path(wide(drag), speed, thrust * elsewhere, time_s), farthest + rounding);
        }
      }
}

double depth_of(const Reaching& a, const Reaching& b) {
  return a.around + b.around - (a.centre - b.centre).norm();
}

std::vector<Relevant> by_brute_force(const std::vector<Reaching>& bodies, const Reaching& own) {
  std::vector<Relevant> found;
  for (const Reaching& each : bodies) {
    if (each.entity == own.entity) continue;
    double deepest = depth_of(own, each);
    for (const Reaching& puck : bodies) {
      if (!puck.is_puck || puck.entity == own.entity || puck.entity == each.entity) continue;
      deepest = std::max(deepest, std::min(depth_of(own, puck), depth_of(puck, each)));
    }
    if (deepest >= 0.0) found.push_back({each.entity, deepest});
  }
  return found;
}

/// A few bodies are fast enough to cross half the field, but for the first seed, and some have left
/// it.
TEST(Encounters, FindWhatLookingAtEveryPairAndEveryPuckBetweenFinds) {
  for (const std::uint64_t seed : {3u, 4u, 5u}) {
    game::RandomStream random(seed);
    std::vector<Reaching> bodies;
    for (std::uint32_t i = 0; i < 120; ++i) {
      const double around =
          seed != 3 && i % 40 == 0 ? random.uniform(1.0, 4.0) : random.uniform(0.2, 1.2);
      bodies.push_back(
          {i, {random.uniform(-1.0, 21.0), random.uniform(-1.0, 11.0)}, around, i % 4 != 0});
    }
    Encounters encounters(20.0, 10.0);
    encounters.build(std::vector<Reaching>(bodies.begin(), bodies.begin() + 60));
    encounters.build(bodies);
    encounters.check();
    std::vector<Relevant> found;
    std::size_t through_pucks = 0;
    for (const Reaching& own : bodies) {
      const std::vector<Relevant> expected = by_brute_force(bodies, own);
      encounters.find(own.entity, found);
      ASSERT_EQ(found.size(), expected.size()) << "around " << own.entity << ", seed " << seed;
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].entity, expected[i].entity)
            << "around " << own.entity << ", seed " << seed;
        const Encounters::Way way = encounters.way(own.entity, found[i].entity);
        ASSERT_NEAR(way.depth, expected[i].depth, 1e-12);
        if (!way.via) continue;
        ++through_pucks;
        ASSERT_TRUE(bodies[*way.via].is_puck);
        ASSERT_NEAR(way.depth,
                    std::min(depth_of(own, bodies[*way.via]),
                             depth_of(bodies[*way.via], bodies[found[i].entity])),
                    1e-12);
      }
    }
    EXPECT_GT(through_pucks, 200u) << "or the test shows nothing";
  }
}

/// A crowd whose players press random keys, and all that happened in it.
class PlayedCrowd {
 public:
  static constexpr double contact_s = 0.5, played_s = 3.0;

  explicit PlayedCrowd(std::uint64_t seed) {
    trace_.choice.scene = "crowd";
    trace_.choice.seed = seed;
    trace_.choice.bats = 20;
    trace_.rate_hz = 30.0;
    trace_.keys = game::random_plan(seed, 20, played_s);
    game::Game game = played();
    game.record_events(true);
    game.advance(played_s);
    events_.assign(game.events().begin(), game.events().end());
    find_speeds();
  }
  game::Game played() const {
    game::Game game(game::chosen_scene(trace_.choice));
    for (const game::InputEvent& key : trace_.keys) game.submit(key);
    return game;
  }
  const game::ServerTrace& trace() const { return trace_; }
  const std::vector<physics::Event>& events() const { return events_; }
  /// Whether what happened to `body` at `time` made it faster.
  bool is_sped_up(std::uint32_t body, double time) const { return sped_up_.contains({time, body}); }

 private:
  void find_speeds() {
    game::Game game = played();
    for (std::size_t first = 0; first < events_.size();) {
      std::size_t last = first;
      std::map<std::uint32_t, double> before;
      const double time = events_[first].time;
      game.advance(std::max(game.now(), time - 1e-9));
      for (; last < events_.size() && events_[last].time == time; ++last) {
        before[events_[last].body.index] = game.velocity(events_[last].body).norm();
        if (events_[last].other)
          before[events_[last].other->index] = game.velocity(*events_[last].other).norm();
      }
      game.advance(time);
      for (const auto& [body, speed] : before)
        if (game.velocity({body}).norm() > speed) sped_up_.insert({time, body});
      first = last;
    }
  }

  game::ServerTrace trace_;
  std::vector<physics::Event> events_;
  std::set<std::pair<double, std::uint32_t>> sped_up_;
};

/// What came to pass within `contact_s` after one look, for all bats.
class Aftermath {
 public:
  struct Counts {
    std::uint64_t contacts = 0, relevant = 0;  ///< of bats, with whom ever
    std::uint64_t strikes = 0,
                  strikes_relevant = 0;  ///< others' meetings with a puck that then met the bat
    std::uint64_t first_contacts = 0, through_pucks = 0,
                  broken = 0;  ///< of which there is a promise, and how often it was broken
    std::uint64_t pairs = 0, of_pairs = 0;
  };

  Aftermath(const PlayedCrowd& crowd, const game::Game& then, Replay& replay, Counts& counts)
      : counts_(counts), now_(then.now()) {
    const physics::World& world = then.world();
    touched_.resize(world.body_count()), struck_by_.resize(world.body_count()),
        strikers_.resize(world.body_count());
    for (std::uint32_t body = 0; body < world.body_count(); ++body)
      touched_[body] = world.is_held({body}) || !world.is_in_play({body}) ? 1u : 0u;
    for (const game::Entity& entity : then.entities()) {
      if (entity.kind == physics::BodyKind::puck) pucks_.insert(entity.id.index);
      if (entity.kind != physics::BodyKind::bat) continue;
      std::vector<Relevant> found;
      replay.find(entity.id.index, found);
      for (const Relevant& each : found) relevant_[entity.id.index].insert(each.entity);
      counts_.pairs += found.size(), counts_.of_pairs += then.entities().size() - 1;
      relevant_.try_emplace(entity.id.index);
    }
    for (const physics::Event& event : crowd.events())
      if (event.time > now_ && event.time <= now_ + PlayedCrowd::contact_s) judge(crowd, event);
  }

 private:
  void judge(const PlayedCrowd& crowd, const physics::Event& event) {
    const std::uint32_t a = event.body.index;
    if (!event.other) {
      if (event.kind == physics::EventKind::goal || event.kind > physics::EventKind::thrust)
        ++touched_[a];
      return;
    }
    const std::uint32_t b = event.other->index;
    if (physics::is_impact(event.kind)) meet(a, b), meet(b, a);
    if (pucks_.contains(a)) note_strike(crowd, a, b, event.time);
    if (pucks_.contains(b)) note_strike(crowd, b, a, event.time);
    ++touched_[a], ++touched_[b];
  }

  /// `puck` met `other`, both for the first time, and is no faster for it.
  void note_strike(const PlayedCrowd& crowd, std::uint32_t puck, std::uint32_t other, double time) {
    strikers_[puck].insert(other);
    if (touched_[puck] == 0 && touched_[other] == 0 && !crowd.is_sped_up(puck, time))
      struck_by_[puck] = other;
  }

  void meet(std::uint32_t bat, std::uint32_t other) {
    const auto relevant = relevant_.find(bat);
    if (relevant == relevant_.end()) return;
    ++counts_.contacts;
    counts_.relevant += relevant->second.contains(other) ? 1u : 0u;
    for (const std::uint32_t striker : strikers_[other]) {
      if (striker == bat) continue;
      ++counts_.strikes;
      counts_.strikes_relevant += relevant->second.contains(striker) ? 1u : 0u;
    }
    if (touched_[bat] > 0) return;
    if (touched_[other] == 0) {
      ++counts_.first_contacts;
      expect(relevant->second, other);
    } else if (touched_[other] == 1 && struck_by_[other] && *struck_by_[other] != bat) {
      ++counts_.through_pucks;
      expect(relevant->second, other), expect(relevant->second, *struck_by_[other]);
    }
  }
  void expect(const std::set<std::uint32_t>& relevant, std::uint32_t entity) {
    counts_.broken += relevant.contains(entity) ? 0u : 1u;
  }

  Counts& counts_;
  double now_;
  std::vector<std::uint32_t> touched_;                   ///< how often since the look, by body
  std::vector<std::optional<std::uint32_t>> struck_by_;  ///< likewise, see note_strike
  std::vector<std::set<std::uint32_t>> strikers_;        ///< all it met since
  std::set<std::uint32_t> pucks_;
  std::map<std::uint32_t, std::set<std::uint32_t>> relevant_;  ///< by bat
};

std::string with_commas(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

TEST(RelevanceByContact, HeldAtEveryLookWhateverThenMetTheBatFirstOrAPuckThatMetItNext) {
  Aftermath::Counts counts;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const PlayedCrowd crowd(seed);
    game::Game game = crowd.played();
    Replay replay(crowd.trace(),
                  {.shape = RelevanceArea::Shape::contact, .contact_s = PlayedCrowd::contact_s});
    for (double now = 0.05; now + PlayedCrowd::contact_s < PlayedCrowd::played_s; now += 0.05) {
      game.advance(now);
      replay.advance(now);
      replay.look_around();
      Aftermath(crowd, game, replay, counts);
    }
  }
  EXPECT_EQ(counts.broken, 0u) << "of " << counts.first_contacts << " first contacts and "
                               << counts.through_pucks << " by way of a puck";
  EXPECT_GT(counts.first_contacts, 1'000u);
  EXPECT_GT(counts.through_pucks, 100u);
  EXPECT_GT(counts.strikes, 2'000u);
  const double contacts_missed =
      static_cast<double>(counts.contacts - counts.relevant) / static_cast<double>(counts.contacts);
  const double strikes_missed = static_cast<double>(counts.strikes - counts.strikes_relevant) /
                                static_cast<double>(counts.strikes);
  const std::string document = test::text_of(test::source_folder() + "/docs/metrics.md");
  EXPECT_EQ(counts.relevant, counts.contacts);
  EXPECT_EQ(counts.strikes_relevant, counts.strikes);
  EXPECT_THAT(document,
              testing::HasSubstr("all of " + with_commas(counts.contacts) +
                                 " contacts of bats within 0.5 s of a look were with somebody "
                                 "relevant at the look, and so were all of " +
                                 with_commas(counts.strikes) + " who had met the puck before"));
  EXPECT_LE(contacts_missed, 1e-3)
      << "those set off by others included, of which there is no promise";
  EXPECT_LE(strikes_missed, 1e-3) << "likewise";
  const double share = static_cast<double>(counts.pairs) / static_cast<double>(counts.of_pairs);
  EXPECT_LT(share, 0.5) << "or all are relevant to all";
}

/// Means over the players, at 30 looks in the first 3 s of seed 1.
TEST(RelevanceByContact, OfACrowdHasAsManyRelevantAsTheDocumentSays) {
  game::ServerTrace trace;
  trace.choice.scene = "crowd";
  trace.rate_hz = 30.0;
  trace.end_s = trace.until_s = 3.0;
  const game::Scene scene = game::chosen_scene(trace.choice);
  const auto players = static_cast<std::uint32_t>(scene.bodies.bats.size());
  ASSERT_EQ(players, 100u);
  ASSERT_EQ(scene.bodies.pucks.size(), 1'000u);
  trace.keys = game::random_plan(1, players, trace.end_s);
  const auto relevant = [&](const RelevanceArea& area) {
    Replay replay(trace, area);
    std::size_t pairs = 0;
    for (int look = 1; look <= 30; ++look) {
      replay.advance(0.1 * look);
      replay.look_around();
      std::vector<Relevant> found;
      for (std::uint32_t player = 0; player < players; ++player)
        replay.find(*replay.bat_of(player), found), pairs += found.size();
    }
    return std::to_string(std::lround(static_cast<double>(pairs) / 30.0 / players));
  };
  const auto by_contact = [&](double contact_s) {
    return relevant({.shape = RelevanceArea::Shape::contact, .contact_s = contact_s});
  };
  const double half_side =
      0.5 * std::sqrt(0.05 * scene.world.field.length * scene.world.field.width);
  EXPECT_THAT(
      test::text_of(test::source_folder() + "/docs/metrics.md"),
      testing::HasSubstr(by_contact(0.5) + " entities are relevant to a player within 0.5 s, " +
                         by_contact(0.25) + " within 0.25 s, and " +
                         relevant({.shape = RelevanceArea::Shape::square, .reach = half_side}) +
                         " by a rectangle of 5 % of the field"));
}

}  // namespace
}  // namespace rink::loadgen
