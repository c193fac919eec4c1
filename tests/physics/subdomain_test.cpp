// Parts of a world: bodies put in and taken out, windows undone and played again.
#include "game/physics/subdomain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// Everything that a portion must carry: bats under keys, rest contacts, drag, goals.
World whole_of(std::uint64_t number) {
  WorldSpec spec = rink_of(4.0, 2.0, number % 2 == 0 ? 0.0 : 0.7, 0.2, 1.0);
  if (number % 3 == 0) spec.field.goal_width = 0.5;
  if (number % 4 == 1) spec.puck_friction = 0.6;
  World world(spec);
  std::mt19937_64 random(number);
  scatter_posts(world, random, 2);
  scatter_bats(world, random, 6);
  scatter_pucks(world, random, 40, 0.05, 2.0);
  return world;
}

void put_all(Subdomain& portion, const World& world) {
  for (std::uint32_t body = 0; body < world.body_count(); ++body)
    portion.put(body, Subdomain::state_in(world, body));
}

/// The next 50 ms, with keys.
template <class Playable>
void play(Playable& world, std::uint64_t number, int window) {
  std::mt19937_64 random(1000 * number +
                         static_cast<std::uint64_t>(window) /
                             8);  // keys are held for a while, so that something gets pressed
  const auto bat = static_cast<std::uint32_t>(2 + random() % 6);
  const double x = static_cast<double>(random() % 3) - 1.0,
               y = static_cast<double>(random() % 3) - 1.0;
  if constexpr (std::is_same_v<Playable, World>) {
    world.set_thrust({bat}, {6.0 * x, 6.0 * y});
    RandomKeys::advance(world, 0.05 * (window + 1));
  } else {
    world.set_thrust(bat, {6.0 * x, 6.0 * y});
    world.advance(0.05 * (window + 1));
  }
}

TEST(Subdomain, OfAllBodiesGoesOnAsTheWorldDoesHoweverOftenItsWindowsAreUndone) {
  std::size_t held = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    World world = whole_of(number);
    Subdomain portion(world.spec(), world.body_count());
    put_all(portion, world);
    for (int window = 0; window < 60; ++window) {
      play(world, number, window);
      portion.begin_window();
      const std::uint64_t before = hash_of(portion);
      for (int attempt = 0; attempt < 2; ++attempt) {
        play(portion, number, window);
        portion.undo();
        EXPECT_EQ(hash_of(portion), before) << "scene " << number << ", window " << window;
      }
      play(portion, number, window);
      held += portion.rest_contacts().size();
      ASSERT_EQ(hash_of(portion), world.hash()) << "scene " << number << ", window " << window;
    }
  }
  EXPECT_GT(held, 100u);
}

TEST(Subdomain, GoesOnAsTheWorldDoesWhoeverIsTakenOutAndPutBackBetweenWindows) {
  std::size_t held = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    World world = whole_of(number);
    Subdomain portion(world.spec(), world.body_count());
    put_all(portion, world);
    std::mt19937_64 random(77 + number);
    for (int window = 0; window < 60; ++window) {
      const std::vector<RestContact> rest_contacts = portion.rest_contacts();
      held += rest_contacts.size();
      std::vector<std::pair<std::uint32_t, BodyState>> out;
      for (std::uint32_t body = 0; body < world.body_count(); ++body)
        if (random() % 4 == 0) out.emplace_back(body, portion.state(body));
      for (const auto& [body, state] : out) portion.drop(body);
      std::shuffle(out.begin(), out.end(), random);
      for (const auto& [body, state] : out) portion.put(body, state);
      portion.set_rest_contacts(rest_contacts);
      portion.begin_window();
      play(portion, number, window);
      portion.undo();
      play(portion, number, window);
      play(world, number, window);
      ASSERT_EQ(hash_of(portion), world.hash()) << "scene " << number << ", window " << window;
      for (const Change& change : portion.journal().changes)
        ASSERT_TRUE(change.body < world.body_count() && portion.is_there(change.body));
    }
  }
  EXPECT_GT(held, 50u);
}

TEST(Subdomain, HasOnlyWhatIsPutThereAndForgetsWhatIsDropped) {
  const World world = whole_of(1);
  Subdomain portion(world.spec(), world.body_count());
  portion.advance(1.0);
  EXPECT_EQ(portion.world().counters().predictions, 0u);
  const std::uint32_t body = world.body_count() - 1;
  portion.put(body, Subdomain::state_in(world, body));
  EXPECT_TRUE(portion.is_there(body));
  EXPECT_EQ(portion.world().motion({body}).velocity, world.motion({body}).velocity);
  portion.drop(body);
  EXPECT_FALSE(portion.is_there(body));
  EXPECT_FALSE(portion.world().is_in_play({body}));
  const std::uint64_t events = portion.world().counters().events();
  portion.advance(20.0);
  EXPECT_EQ(portion.world().counters().events(), events);
}

/// Contacts are listed by slots, of which a dropped body's is the next one's.
TEST(Subdomain, ForgetsTheContactsOfWhatIsDroppedBeforeAnotherComes) {
  World world(rink_of(4.0, 2.0));
  for (const double x : {1.0, 1.25, 1.5, 3.0})
    world.add(BatSpec{.position = {x, 1.0}, .half_extent = {0.125, 0.125}});
  Subdomain portion(world.spec(), world.body_count());
  for (const std::uint32_t body : {0u, 1u, 2u}) portion.put(body, Subdomain::state_in(world, body));
  const auto contact = [](std::uint32_t low, std::uint32_t high) {
    return RestContact{.low = low,
                       .high = high,
                       .axis = 0,
                       .pull_time = 1e300,
                       .force = 0.0,
                       .turn_time = 1e300,
                       .age = {}};
  };
  portion.set_rest_contacts({contact(0, 1), contact(1, 2)});
  portion.drop(2);
  portion.put(3, Subdomain::state_in(world, 3));
  ASSERT_EQ(portion.rest_contacts().size(), 1u);
  EXPECT_EQ(portion.rest_contacts().front().low, 0u);
  EXPECT_EQ(portion.rest_contacts().front().high, 1u);
}

TEST(Subdomain, KnowsHowABodyWasBeforeTheWindow) {
  World world = whole_of(3);
  Subdomain portion(world.spec(), world.body_count());
  put_all(portion, world);
  portion.begin_window();
  portion.advance(1.0);
  EXPECT_GT(portion.journal().changes.size(), 20u);
  for (std::uint32_t body = 0; body < world.body_count(); ++body) {
    const BodyState before = portion.state_before(body), then = Subdomain::state_in(world, body);
    EXPECT_EQ(before.flight.x, then.flight.x);
    EXPECT_EQ(before.flight.vy, then.flight.vy);
    EXPECT_EQ(before.flight.time, then.flight.time);
    EXPECT_EQ(before.impacts, then.impacts);
    EXPECT_EQ(before.acceleration, then.acceleration);
  }
}

TEST(Subdomain, PredictsWhenARestContactEndsAnewIfTheOtherSideIsPut) {
  // A bat pushes another one and slides along its face, until that ends.
  World world(rink_of(4.0, 2.0, 0.0, 0.0, 1.0));
  const BodyId pushing = world.add(BatSpec{.position = {1.0, 1.0}, .half_extent = {0.125, 0.125}}),
               pushed = world.add(BatSpec{.position = {1.25, 1.0}, .half_extent = {0.125, 0.125}});
  world.set_thrust(pushing, {6.0, 1.0});
  world.advance(0.25);
  ASSERT_TRUE(world.is_held(pushed));
  const auto portion_of = [&] {
    auto portion = std::make_unique<Subdomain>(world.spec(), world.body_count());
    portion->advance(world.now());
    for (const BodyId body : {pushing, pushed})
      portion->put(body.index, Subdomain::state_in(world, body.index));
    portion->set_rest_contacts({{.low = pushing.index,
                                 .high = pushed.index,
                                 .axis = 0,
                                 .pull_time = 1e300,
                                 .force = 0.0,
                                 .turn_time = 1e300,
                                 .age = {}}});
    portion->begin_window();
    return portion;
  };
  const auto corrected = portion_of(), fresh = portion_of();
  corrected->advance(0.26);  // now it has been predicted
  fresh->advance(0.26);
  for (const double speed : {0.75, -0.25}) {
    BodyState other = corrected->state(pushing.index);
    other.flight.vy = speed;
    corrected->put(pushing.index, other);
    corrected->set_rest_contacts(corrected->rest_contacts());
    fresh->put(pushing.index, other);
    fresh->put(pushed.index, fresh->state(pushed.index));
    fresh->set_rest_contacts(fresh->rest_contacts());
    const double until = corrected->world().now() + 0.02;
    corrected->advance(until);
    fresh->advance(until);
  }
  EXPECT_FALSE(fresh->rest_contacts().empty());
  const double until = corrected->world().now() + 1.2;
  corrected->advance(until);
  fresh->advance(until);
  EXPECT_TRUE(fresh->rest_contacts().empty());
  EXPECT_EQ(hash_of(*corrected), hash_of(*fresh));
}

TEST(Subdomain, CountsWhatAnotherWorldMayCountAtOneInstant) {
  const double rounding = 0x1p-52 * 2.0, begin = 1.0;
  // A world that begins to count with the second one finds three within its 16 roundings; one that
  // begins with the first, two and then two.
  const std::vector<double> times{begin, begin + 10 * rounding, begin + 17 * rounding,
                                  begin + 26 * rounding, begin + 1.0};
  EXPECT_GE(most_at_once(times), 3u);
  EXPECT_LE(most_at_once(times), 4u);
  EXPECT_EQ(most_at_once({}), 0u);
  EXPECT_EQ(most_at_once(std::vector<double>{0.1, 0.2, 0.2 + 1e-12, 0.3}), 1u);
  EXPECT_EQ(most_at_once(std::vector<double>(70, 5.0)), 70u);
}

TEST(Subdomain, KeepsJamsThatDoNotTouchApart) {
  // A bat jams a puck between two posts, twice, 2 m from each other.
  World world(rink_of(4.0, 4.0, 0.5, 0.0, 1.0));
  for (const double y : {1.0, 3.0}) {
    for (const double side : {-0.1, 0.1})
      world.add(PostSpec{.position = {2.0, y + side}, .radius = 0.0625});
    world.add(PuckSpec{.position = {1.8, y}, .radius = 0.0625});
    world.set_thrust(world.add(BatSpec{.position = {1.5, y}, .half_extent = {0.0625, 0.25}}),
                     {6.0, 0.0});
  }
  world.advance(5.0);
  ASSERT_GT(world.counters().freezes, 1u);
  Subdomain portion(world.spec(), world.body_count());
  put_all(portion, world);
  for (const std::uint32_t first : {0u, 4u}) {
    std::vector<std::uint32_t> group = portion.group_of(first + 2);
    std::sort(group.begin(), group.end());
    EXPECT_EQ(group, (std::vector<std::uint32_t>{first + 2, first + 3}));
  }
}

}  // namespace
}  // namespace rink::physics::test
