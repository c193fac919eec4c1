// Clients' replicas against the server's own state: filters change the traffic, never the game.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "game/net/fom_file.h"
#include "game/replication/trajectory_codec.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

bool holds(const im::Region& view, const Vector2& centre) {
  return overlaps(view, centre, {0.0, 0.0});
}

class MirrorUnderScheme : public testing::TestWithParam<const char*> {
 protected:
  /// Whether `scheme` must (or, for the exact ones, must not) tell of an entity there.
  bool must_know(const im::Region& view, const Entity& entity, const Vector2& centre) const {
    const std::string scheme = GetParam();
    if (scheme == "none") return true;
    return scheme == "grid" ? holds(view, centre) : overlaps(view, centre, entity.half_extent);
  }
  bool is_exact() const { return std::string(GetParam()) != "grid"; }
};

/// One tick: what each client knows of each entity, against the server's state at the tick that all
/// were told of.
void expect_mirrors_equal_the_server(
    LockstepRink& rink, const std::vector<im::Region>& views,
    const std::function<bool(const im::Region&, const Entity&, const Vector2&)>& must_know,
    bool is_exact) {
  const Game& game = rink.server().game();
  for (std::size_t k = 0; k < rink.client_count(); ++k) {
    for (const Entity& entity : game.entities()) {
      const Vector2 centre = game.position(entity.id);
      const EntityReplica* mirrored =
          rink.client(k).replicas().find(rink.server().publisher().object(entity.id));
      const bool is_known = mirrored != nullptr && mirrored->in_scope;
      const bool must = must_know(views[k], entity, centre);
      ASSERT_TRUE(is_known || !must)
          << "client " << k << " misses entity " << entity.id.index << " at t = " << game.now();
      ASSERT_TRUE(must || !is_known || !is_exact)
          << "client " << k << " is told of entity " << entity.id.index
          << ", which is out of its region";
      ASSERT_TRUE(!is_known || mirrored->position == rounded(centre))
          << "client " << k << ", entity " << entity.id.index << ", t = " << game.now();
    }
  }
}

TEST_P(MirrorUnderScheme, EqualsTheServersStateInsideTheInterestRegionAtEveryTick) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = GetParam(),
                            .clients = 12,
                            .view_fraction = 0.1,
                            .server = {.replay = keys_for(scene, 5, 4.0)}});
  rink.start();
  for (int tick = 0; tick < 120; ++tick) {
    rink.settle();
    std::vector<im::Region> views;
    for (std::size_t k = 0; k < rink.client_count(); ++k) views.push_back(rink.client(k).view());
    rink.tick();
    expect_mirrors_equal_the_server(
        rink, views,
        [&](const im::Region& view, const Entity& entity, const Vector2& centre) {
          return must_know(view, entity, centre);
        },
        is_exact());
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(rink.client(0).replicas().counters().malformed, 0u);
}

TEST_P(MirrorUnderScheme, LateJoinerKnowsItsSurroundingsAfterOneTickAndDiscoversNothingTwice) {
  const Scene scene = small_crowd();
  LockstepRink rink(
      scene, {.scheme = GetParam(), .clients = 2, .server = {.replay = keys_for(scene, 6, 3.0)}});
  rink.start();
  rink.run(1.0);
  Client& late = rink.add_client("bat-7");
  rink.tick();
  rink.tick();
  rink.tick();
  ASSERT_EQ(late.state(), Client::State::playing);
  ASSERT_NE(late.bat(), nullptr);
  EXPECT_EQ(late.bat()->position,
            rounded(rink.server().game().position(*rink.server().game().bat(7))));
  std::size_t in_scope = 0;
  for (const EntityReplica& entity : late.replicas().entities())
    in_scope += entity.in_scope ? 1u : 0u;
  EXPECT_EQ(in_scope, late.replicas().counters().entered - late.replicas().counters().left);
}

INSTANTIATE_TEST_SUITE_P(Schemes, MirrorUnderScheme, testing::Values("none", "grid", "region"),
                         [](const auto& info) { return std::string(info.param); });

TEST(ReplicaSet, KnowsThatItWasNotToldYetWhereADiscoveredEntityIs) {
  const rti::Fom fom = load_rink_fom(fom_file());
  const ObjectModel model(fom);
  ReplicaSet replicas(model);
  const rti::ObjectHandle object{7};
  replicas.discover(object, model.entity);
  ASSERT_NE(replicas.find(object), nullptr);
  EXPECT_FALSE(replicas.find(object)->is_placed);
  std::vector<std::byte> bytes;
  const Input input{};
  replicas.reflect(object, rti::AttributeSet{model.input}, encode(bytes, input), {});
  EXPECT_FALSE(replicas.find(object)->is_placed);
  const Position there{1.0f, 2.0f};
  replicas.reflect(object, rti::AttributeSet{model.position}, encode(bytes, there), {});
  EXPECT_TRUE(replicas.find(object)->is_placed);
  EXPECT_EQ(replicas.find(object)->position, there);
  replicas.set_scope(object, true);
  EXPECT_TRUE(replicas.find(object)->is_placed)
      << "the state may come before the word that it entered, or after";
  replicas.set_scope(object, false);
  replicas.set_scope(object, true);
  EXPECT_FALSE(replicas.find(object)->is_placed) << "where it was when it left is not where it is";
  replicas.reflect(object, rti::AttributeSet{model.position}, encode(bytes, there), {});
  EXPECT_TRUE(replicas.find(object)->is_placed);
}

/// x(t) = x0 + v (1 - exp(-g t)) / g: by the drag that is the field's, whether that was told before
/// the path or after it.
TEST(ReplicaSet, FollowsAPathByTheFieldsDragThoughThatComesLater) {
  const rti::Fom fom = load_rink_fom(fom_file());
  const ObjectModel model(fom);
  const rti::ObjectHandle field{1}, puck{7}, bat{8};
  const Extent extent{.length = 20.0f, .width = 10.0f};
  const Drag drag{.pucks = 0.8, .bats = 2.5, .puck_friction = 0.0};
  for (const bool is_late : {false, true})
    for (const bool is_snapshot : {false, true}) {
      ReplicaSet replicas(model);
      std::vector<std::byte> bytes;
      replicas.discover(field, model.field);
      const auto tell_drag = [&] {
        replicas.reflect(field, rti::AttributeSet{model.extent, model.drag},
                         encode(bytes, extent, drag), {});
      };
      if (!is_late) tell_drag();
      for (const auto& [object, kind] :
           {std::pair{puck, physics::BodyKind::puck}, {bat, physics::BodyKind::bat}}) {
        replicas.discover(object, model.entity);
        const Shape shape{
            .kind = static_cast<std::uint8_t>(kind), .half_length = 0.04f, .half_width = 0.04f};
        replicas.reflect(object, rti::AttributeSet{model.shape}, encode(bytes, shape), {});
        const Trajectory path{.time = 1.0, .position = {3.0, 4.0}, .velocity = {2.0, -1.0}};
        const Snapshot seen{.position = {3.0, 4.0}, .velocity = {2.0, -1.0}};
        if (is_snapshot)
          replicas.reflect(object, rti::AttributeSet{model.snapshot}, encode(bytes, seen),
                           {.time = 1.0, .tag = 0});
        else
          replicas.reflect(object, rti::AttributeSet{model.trajectory}, encode(bytes, path),
                           {.time = 1.0, .tag = 0});
      }
      if (is_late) tell_drag();
      for (const auto& [object, g] : {std::pair{puck, drag.pucks}, {bat, drag.bats}}) {
        const double s = (1.0 - std::exp(-g * 0.5)) / g;
        const physics::Vector2 there = replicas.find(object)->position_at(1.5);
        EXPECT_NEAR(there.x(), 3.0 + 2.0 * s, 1e-6)
            << "drag " << g << (is_late ? ", told late" : "");
        EXPECT_NEAR(there.y(), 4.0 - 1.0 * s, 1e-6);
      }
      EXPECT_EQ(replicas.counters().malformed, 0u);
    }
}

}  // namespace
}  // namespace rink::game
