// The same bits whatever the cell size, the queue, the rate of output, and however often the world
// is saved and restored on the way.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "game/physics/extended/extended_world.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Ways to play one scene, none of which may show in its history.
struct Way {
  const char* name;
  double cell_size = 0.0;
  QueuePolicy queue = QueuePolicy::calendar;
  double stop_every = never;    ///< s, on average: output
  double window_every = never;  ///< s, on average: save, restore, go on from the bytes
};

const Way ways[] = {{.name = "in one go"},
                    {.name = "large cells", .cell_size = 0.7},
                    {.name = "one cell", .cell_size = 10.0},
                    {.name = "a heap", .queue = QueuePolicy::heap},
                    {.name = "a heap and large cells at 1 kHz",
                     .cell_size = 0.4,
                     .queue = QueuePolicy::heap,
                     .stop_every = 1e-3},
                    {.name = "windows", .queue = QueuePolicy::windows},
                    {.name = "windows and large cells, stopped and restored at random",
                     .cell_size = 0.4,
                     .queue = QueuePolicy::windows,
                     .stop_every = 0.01,
                     .window_every = 0.1},
                    {.name = "random stops", .stop_every = 0.05},
                    {.name = "restored now and then", .window_every = 0.2},
                    {.name = "restored often, between stops",
                     .cell_size = 0.3,
                     .stop_every = 0.02,
                     .window_every = 0.01}};

struct History {
  std::uint64_t hash = 0, events = 0;
  double energy = 0.0;
  std::uint32_t windows = 0,
                windows_held = 0;  ///< how often it was restored, and with rest contacts or jams
  friend bool operator==(const History& a, const History& b) {
    return a.hash == b.hash && a.events == b.events && a.energy == b.energy;
  }
};

/// Six pucks that touch, and one that is about to hit them in the middle: contacts that close at
/// one instant.
void add_rack(World& world) {
  constexpr double reach = 0.0625 + 4e-16;
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i <= row; ++i)
      world.add(PuckSpec{
          .position = {2.0 + 0.5 * std::sqrt(3.0) * reach * row, 1.0 + reach * (i - 0.5 * row)},
          .radius = 0.03125,
          .mass = row == 1 ? 3.0 : 1.0});
  world.add(PuckSpec{.position = {1.9, 1.0}, .velocity = {2.0, 0.0}, .radius = 0.03125});
}

/// Scene k of many: pucks alone, with drag, with bats under keys, with goals, with a rack to break,
/// with friction of the table and of surfaces, which turns pucks; restitution 0 to 1; equal and
/// unequal masses.
class Scene {
 public:
  explicit Scene(std::uint64_t number) : number_(number) {
    static const double restitutions[] = {0.0, 1.0, 0.5, 0.9, 0.1, 0.0, 0.7};
    spec_ = rink_of(4.0, 2.0, restitutions[number % 7], number % 3 == 0 ? 0.0 : 0.2, 1.0);
    if (number % 4 == 3) spec_.field.goal_width = 0.5;
    if (number % 4 == 1) spec_.puck_friction = 0.6;
    if (number % 4 == 2 || number % 8 == 5)
      spec_.surface_friction = SurfaceFriction{PairTable(1, 0.2), RestitutionTable(1, 0.3)};
    bat_count_ = number % 5 == 0 ? 0 : 6;
    mass_low_ = number % 2 == 0 ? 1.0 : 0.05;
    has_rack_ = number % 3 == 1;
  }

  History play(const Way& way, double duration) const {
    WorldSpec spec = spec_;
    spec.cell_size = way.cell_size;
    spec.queue = way.queue;
    World world(spec);
    std::mt19937_64 random(number_), stops(7 * number_ + 1);
    if (has_rack_) add_rack(world);
    scatter_posts(world, random, 2);
    const std::vector<BodyId> bats = scatter_bats(world, random, bat_count_);
    scatter_pucks(world, random, 40, mass_low_, 1.0);
    RandomKeys keys{std::mt19937_64(number_ + 100), 0.05};
    History history;
    const auto after = [&](double now, double interval) {
      return interval == never ? never : now + uniform(stops, 0.0, 2.0 * interval);
    };
    double stop = after(0.0, way.stop_every), window = after(0.0, way.window_every);
    for (double now = 0.0; now < duration;) {
      now = std::min({stop, window, duration});
      if (bats.empty()) RandomKeys::advance(world, now);
      else keys.play(world, bats, now);
      if (now == stop)
        history.energy += world.kinetic_energy(),
            stop = after(now, way.stop_every);  // asking changes nothing
      if (now == window) restore(world, history), window = after(now, way.window_every);
    }
    history.hash = world.hash();
    history.events = world.counters().events();
    history.energy = world.kinetic_energy();
    if (has_rack_ && !spec_.surface_friction) {
      EXPECT_GT(world.counters().joint_impacts, 0u);
    }
    return history;
  }

 private:
  static void restore(World& world, History& history) {
    ++history.windows;
    for (BodyId body; body.index < world.body_count(); ++body.index)
      if (world.is_held(body)) {
        ++history.windows_held;
        break;
      }
    std::optional<World> restored = World::restore(world.save());
    ASSERT_TRUE(restored);
    ASSERT_EQ(restored->hash(), world.hash());
    ASSERT_EQ(restored->now(), world.now());
    ASSERT_EQ(restored->counters(), world.counters());
    world = std::move(*restored);
  }

  std::uint64_t number_;
  WorldSpec spec_;
  int bat_count_;
  double mass_low_;
  bool has_rack_;
};

void expect_one_history(std::uint64_t first, std::uint64_t last, double duration) {
  std::uint32_t windows = 0, windows_held = 0;
  for (std::uint64_t number = first; number < last; ++number) {
    const Scene scene(number);
    const History expected = scene.play(ways[0], duration);
    for (const Way& way : ways) {
      SCOPED_TRACE(testing::Message() << "scene " << number << ", " << way.name);
      const History history = scene.play(way, duration);
      EXPECT_EQ(history.hash, expected.hash);
      EXPECT_TRUE(history == expected);
      windows += history.windows, windows_held += history.windows_held;
    }
  }
  EXPECT_GT(windows, 20u * (last - first));
  EXPECT_GT(windows_held, windows / 10);
}

TEST(Determinism, OneHistoryWhateverCellsQueueStopsAndWindows) { expect_one_history(0, 14, 2.0); }

TEST(DeterminismLong, OneHistoryWhateverCellsQueueStopsAndWindows) {
  expect_one_history(100, 400, 4.0);
}

TEST(Determinism, LookingAheadAmongManyPucksChangesNothing) {
  const auto hash = [](QueuePolicy queue) {
    WorldSpec spec = test::rink_of(40.0, 40.0);
    spec.field.goal_width = 20.0;
    spec.queue = queue;
    World world(spec);
    std::mt19937_64 random(8);
    constexpr std::uint32_t columns = 190;
    for (std::uint32_t k = 0; k < columns * columns; ++k) {
      PuckSpec puck;
      puck.position = Vector2(k % columns + 0.5, k / columns + 0.5) * (40.0 / columns);
      const double vx = test::uniform(random, -2.0, 2.0), vy = test::uniform(random, -2.0, 2.0);
      puck.velocity = {vx, vy};
      world.add(puck);
    }
    for (int tenth = 1; tenth <= 3; ++tenth) {
      while (world.advance(0.1 * tenth)) {
      }
      for (int k = 0; k < 100; ++k)
        world.remove({static_cast<std::uint32_t>(random() % (columns * columns))});
    }
    EXPECT_GT(world.counters().goals, 10u);
    return world.hash();
  };
  EXPECT_EQ(hash(QueuePolicy::calendar), hash(QueuePolicy::heap));
  EXPECT_EQ(hash(QueuePolicy::calendar), hash(QueuePolicy::windows));
}

TEST(Snapshot, IsRefusedIfAnyByteIsAltered) {
  World world(rink_of(2, 1, 0.5, 0.1, 1.0));
  std::mt19937_64 random(3);
  scatter_posts(world, random, 1);
  const std::vector<BodyId> bats = scatter_bats(world, random, 1);
  scatter_pucks(world, random, 3);
  world.set_thrust(bats[0], {6.0, 0.0});
  world.advance(5.0);
  const std::vector<std::uint8_t> bytes = world.save();
  ASSERT_TRUE(World::restore(bytes));
  EXPECT_EQ(World::restore(bytes)->save(), bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::uint8_t> altered = bytes;
    altered[i] = static_cast<std::uint8_t>(altered[i] ^ (1u << (i % 8)));
    EXPECT_FALSE(World::restore(altered)) << i;
  }
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(World::restore(std::span(bytes).first(length))) << length;
}

TEST(Snapshot, BelongsToItsScalar) {
  ExtendedWorld extended(rink_of(2, 1));
  extended.add(PuckSpec{.position = {0.5, 0.5}, .velocity = {1.0 / 3.0, 0.7}});
  extended.add(PuckSpec{.position = {0.7, 0.6}, .velocity = {-1.0 / 7.0, 0.2}});
  extended.advance(3.3L);
  EXPECT_FALSE(World::restore(extended.save()));
  std::optional<ExtendedWorld> restored = ExtendedWorld::restore(extended.save());
  ASSERT_TRUE(restored);
  extended.advance(9.0L);
  restored->advance(9.0L);
  EXPECT_GT(extended.counters().impacts(), 5u);
  EXPECT_EQ(restored->hash(), extended.hash());
}

TEST(Snapshot, KeepsAPinnedPuckPinnedAtNoCost) {
  World world(rink_of(4, 2, 0.5, 0.2, 1.0));
  const BodyId bat = world.add(BatSpec{.position = {1.0, 1.0}}),
               puck = world.add(PuckSpec{.position = {0.5, 1.0}});
  world.set_thrust(bat, {-6.0, 0.0});
  world.advance(5.0);
  ASSERT_TRUE(world.is_held(puck));
  std::optional<World> restored = World::restore(world.save());
  ASSERT_TRUE(restored);
  const std::uint64_t events = restored->counters().events();
  restored->advance(15.0);
  EXPECT_TRUE(restored->is_held(puck));
  EXPECT_EQ(restored->counters().events(), events);
  restored->set_thrust(bat, {6.0, 0.0});
  restored->advance(15.5);
  EXPECT_FALSE(restored->is_held(bat));
  EXPECT_GT(restored->position(bat).x(), world.position(bat).x() + 0.1);
}

}  // namespace
}  // namespace rink::physics::test
