// What a stranger hosts: scenes that can't be played are refused, and states are put in the
// scene's order, or wait until none is missing.
#include "game/net/client/hosted_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "game/model/scene_file.h"
#include "tests/net/rink_model.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using physics::BodyKind;
using testing::HasSubstr;

std::string match_text() { return scene_text(test::source_folder() + "/scenes/match.toml"); }
/// With `count` pucks more.
std::string match_with(int count) {
  std::string text = match_text();
  for (int puck = 0; puck < count; ++puck)
    text += "\n[[puck]]\nname = \"more " + std::to_string(puck) + "\"\nposition = [1.5, " +
            std::to_string(0.15 + 0.15 * puck) + "]\nradius = 0.04\nmass = 0.05\n";
  return text;
}

/// A body as the test says that it is, and as it is told.
struct Told {
  rti::ObjectHandle object;
  BodyKind kind = BodyKind::puck;
  std::uint8_t team = 0;
  Input input{};
  Vector2 position{0.5, 0.5}, velocity{0.0, 0.0};
};

/// What a federate has received.
struct Received {
  const ObjectModel& model = rink_model();
  ReplicaSet replicas{model};
  HostedScene scene;
  std::vector<std::byte> bytes;
  rti::Stamp stamp{2.5, 75};

  explicit Received(int more_pucks) { EXPECT_EQ(scene.read(match_with(more_pucks)), std::nullopt); }
  void tell(const Told& body) {
    replicas.discover(body.object, model.entity);
    const Shape shape{static_cast<std::uint8_t>(body.kind), body.team, 0.04f, 0.04f};
    replicas.reflect(body.object, {model.shape, model.input}, encode(bytes, shape, body.input),
                     stamp);
    move(body);
    replicas.set_scope(body.object, true);
  }
  void move(const Told& body) {
    const Trajectory law{.time = stamp.time,
                         .position = body.position,
                         .velocity = body.velocity,
                         .drag = {0.0, 0.0}};
    replicas.reflect(body.object, {model.trajectory}, encode(bytes, law), stamp);
  }
  std::optional<ReceivedRink> rink() const { return scene.received(replicas, nullptr); }
};

/// Two bats and `puck_count` pucks, whose objects have random handles.
std::vector<Told> all_of(int puck_count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0.1, 1.1), speed(-2.0, 2.0);
  std::vector<std::uint32_t> handles(50);
  std::iota(handles.begin(), handles.end(), 1u);
  std::shuffle(handles.begin(), handles.end(), random);
  std::vector<Told> all;
  for (int body = 0; body < 2 + puck_count; ++body)
    all.push_back({.object = {handles[static_cast<std::size_t>(body)]},
                   .kind = body < 2 ? BodyKind::bat : BodyKind::puck,
                   .team = static_cast<std::uint8_t>(body < 2 ? body : 2),
                   .input = {.count = static_cast<std::uint32_t>(random() % 100),
                             .held = static_cast<std::uint8_t>(random() % 16)},
                   .position = {place(random), place(random)},
                   .velocity = {speed(random), speed(random)}});
  return all;
}

void expect_body(const ReceivedBody& body, const Told& told) {
  EXPECT_EQ(body.position, told.position);
  EXPECT_EQ(body.velocity, told.velocity);
  EXPECT_EQ(body.held.bits(), told.input.held);
  EXPECT_TRUE(body.is_known);
}

/// Bats by team, pucks by the order in which they were registered.
TEST(AHostedScene, OrdersBodiesHoweverTheyAreDiscovered) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    Received received(4);
    std::vector<Told> all = all_of(5, random), heard = all;
    std::shuffle(heard.begin(), heard.end(), random);
    for (const Told& each : heard) {
      EXPECT_FALSE(received.rink()) << "one is missing, seed " << seed;
      received.tell(each);
    }
    const auto rink = received.rink();
    ASSERT_TRUE(rink) << "seed " << seed;
    EXPECT_EQ(rink->time, 2.5);
    std::sort(all.begin() + 2, all.end(),
              [](const Told& a, const Told& b) { return a.object < b.object; });
    ASSERT_EQ(rink->bats.size(), 2u);
    ASSERT_EQ(rink->pucks.size(), 5u);
    for (std::size_t bat = 0; bat < 2; ++bat) expect_body(rink->bats[bat], all[bat]);
    for (std::size_t puck = 0; puck < 5; ++puck) expect_body(rink->pucks[puck], all[puck + 2]);
  }
}

TEST(AHostedScene, HasNoStatesWhileAnyIsMissingOrThereAreTooMany) {
  std::mt19937_64 random(1);
  const std::vector<Told> all = all_of(2, random);
  Received received(1);
  for (const Told& each : all) received.tell(each);
  ASSERT_TRUE(received.rink());
  for (const Told& each : all) {
    received.replicas.set_scope(each.object, false);
    EXPECT_FALSE(received.rink()) << "of one it hears no more";
    received.replicas.set_scope(each.object, true);
    received.move(each);
    EXPECT_TRUE(received.rink());
  }
  received.tell({.object = {90}, .kind = BodyKind::bat, .team = 2});
  EXPECT_TRUE(received.rink()) << "a bat of no team plays no part";
  received.tell({.object = {91}});
  EXPECT_FALSE(received.rink()) << "a puck more than the scene has";
}

TEST(AHostedScene, TakesNoSpeedOrTimeThatNoMatchReaches) {
  std::mt19937_64 random(1);
  std::vector<Told> all = all_of(1, random);
  all[2].velocity = {-1e9, 250.0};
  all[0].velocity = {3.0, 101.0};
  Received received(0);
  for (const Told& each : all) received.tell(each);
  auto rink = received.rink();
  ASSERT_TRUE(rink);
  EXPECT_EQ(rink->pucks[0].velocity, Vector2(-100.0, 100.0));
  EXPECT_EQ(rink->bats[0].velocity, Vector2(3.0, 100.0));
  for (const double time : {1.5e9, -1.5e9}) {
    received.stamp = {time, 76};
    received.move(all[2]);
    EXPECT_FALSE(received.rink()) << "at " << time << " s";
  }
}

/// Each number of a trajectory is checked when it comes, but not where they lead.
TEST(AHostedScene, HasNoStatesWhileABodyIsNowhere) {
  std::mt19937_64 random(1);
  const std::vector<Told> all = all_of(1, random);
  Received received(0);
  for (const Told& each : all) received.tell(each);
  received.stamp = {1000.0, 76};
  for (const Told& each : all) {
    ASSERT_TRUE(received.rink());
    const Trajectory law{.time = 0.0,
                         .position = {1e308, 0.5},
                         .velocity = {1e308, 0.0},
                         .acceleration = {-1e308, 0.0},
                         .drag = {0.0, 0.0}};
    received.replicas.reflect(each.object, {received.model.trajectory}, encode(received.bytes, law),
                              received.stamp);
    EXPECT_FALSE(received.rink());
    received.move(each);
  }
}

TEST(AHostedScene, KnowsThePuckInAGoalAndHowManyOwnKeysWereFelt) {
  std::mt19937_64 random(1);
  std::vector<Told> all = all_of(3, random);
  std::sort(all.begin() + 2, all.end(),
            [](const Told& a, const Told& b) { return a.object < b.object; });
  all[2].position = {-0.01, 0.6};
  all[3].position = {2.41, 0.6};
  Received received(2);
  for (const Told& each : all) received.tell(each);
  const auto rink =
      received.scene.received(received.replicas, received.replicas.find(all[1].object));
  ASSERT_TRUE(rink);
  EXPECT_EQ(rink->own_felt, all[1].input.count);
  EXPECT_EQ(received.rink()->own_felt, 0u) << "of one who watches";
  EXPECT_FALSE(rink->pucks[0].is_in_play);
  EXPECT_FALSE(rink->pucks[1].is_in_play);
  EXPECT_TRUE(rink->pucks[2].is_in_play);
}

TEST(AHostedScene, IsReadOnceItCanBePlayed) {
  HostedScene scene;
  EXPECT_EQ(scene.scene(), nullptr);
  ASSERT_EQ(scene.read(match_with(2)), std::nullopt);
  ASSERT_NE(scene.scene(), nullptr);
  std::vector<BodyKind> kinds;
  for (const Thing& thing : scene.things()) kinds.push_back(thing.kind);
  using enum BodyKind;
  EXPECT_THAT(kinds, testing::ElementsAre(bat, bat, puck, puck, puck, post, post));
}

TEST(AHostedScene, SaysWhyItCannotBePlayed) {
  std::string one_bat = match_text();
  one_bat.erase(one_bat.find("[[bat]]\nname = \"right\""),
                one_bat.find("[[puck]]") - one_bat.find("[[bat]]\nname = \"right\""));
  const std::vector<std::pair<std::string, std::string>> scenes{
      {"[[population]]\ncount = 4000000000\n", "a match has no populations"},
      {"no toml at all", "match.toml"},
      {one_bat, "two bats"},
      {std::string(1000, '['), "match.toml"}};
  HostedScene scene;
  for (const auto& [text, why] : scenes) {
    const auto objection = scene.read(text);
    ASSERT_TRUE(objection) << why;
    EXPECT_THAT(*objection, HasSubstr(why));
    EXPECT_EQ(scene.scene(), nullptr);
  }
  ASSERT_FALSE(scene.read(match_text()));
  EXPECT_TRUE(scene.read("no toml at all"));
  ASSERT_NE(scene.scene(), nullptr) << "the one that was read before";
  EXPECT_EQ(scene.scene()->bodies.pucks.size(), 1u);
}

}  // namespace
}  // namespace rink::game
