// Clients' mirrors against the server's own state: filters change the traffic, never the game.
#include <gtest/gtest.h>

#include <functional>

#include "game/net/fom_file.h"
#include "game/replication/trajectory_codec.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

bool holds(const im::Region& view, const Vector2& centre) { return overlaps(view, centre, {0.0, 0.0}); }

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

/// One tick: what each client knows of each entity, against the server's state at the tick that all were told of.
void expect_mirrors_equal_the_server(LockstepRink& rink, const std::vector<im::Region>& views, const std::function<bool(const im::Region&, const Entity&, const Vector2&)>& must_know,
                                     bool is_exact) {
  const Game& game = rink.server().game();
  for (std::size_t k = 0; k < rink.client_count(); ++k) {
    for (const Entity& entity : game.entities()) {
      const Vector2 centre = game.position(entity.id);
      const MirroredEntity* mirrored = rink.client(k).mirror().find(rink.server().object(entity.id));
      const bool is_known = mirrored != nullptr && mirrored->in_scope;
      const bool must = must_know(views[k], entity, centre);
      ASSERT_TRUE(is_known || !must) << "client " << k << " misses entity " << entity.id.index << " at t = " << game.now();
      ASSERT_TRUE(must || !is_known || !is_exact) << "client " << k << " is told of entity " << entity.id.index << ", which is out of its region";
      ASSERT_TRUE(!is_known || mirrored->position == rounded(centre)) << "client " << k << ", entity " << entity.id.index << ", t = " << game.now();
    }
  }
}

TEST_P(MirrorUnderScheme, EqualsTheServersStateInsideTheInterestRegionAtEveryTick) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = GetParam(), .clients = 12, .view_fraction = 0.1, .server = {.replay = keys_for(scene, 5, 4.0)}});
  rink.start();
  for (int tick = 0; tick < 120; ++tick) {
    rink.settle();
    std::vector<im::Region> views;
    for (std::size_t k = 0; k < rink.client_count(); ++k) views.push_back(rink.client(k).view());
    rink.tick();
    expect_mirrors_equal_the_server(
        rink, views, [&](const im::Region& view, const Entity& entity, const Vector2& centre) { return must_know(view, entity, centre); }, is_exact());
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(rink.client(0).mirror().counters().malformed, 0u);
}

TEST_P(MirrorUnderScheme, LateJoinerKnowsItsSurroundingsAfterOneTickAndDiscoversNothingTwice) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = GetParam(), .clients = 2, .server = {.replay = keys_for(scene, 6, 3.0)}});
  rink.start();
  rink.run(1.0);
  Client& late = rink.add_client("bat-7");
  rink.tick();
  rink.tick();
  rink.tick();
  ASSERT_EQ(late.state(), Client::State::playing);
  ASSERT_NE(late.bat(), nullptr);
  EXPECT_EQ(late.bat()->position, rounded(rink.server().game().position(*rink.server().game().bat(7))));
  std::size_t in_scope = 0;
  for (const MirroredEntity& entity : late.mirror().entities()) in_scope += entity.in_scope ? 1u : 0u;
  EXPECT_EQ(in_scope, late.mirror().counters().entered - late.mirror().counters().left);
}

INSTANTIATE_TEST_SUITE_P(Schemes, MirrorUnderScheme, testing::Values("none", "grid", "region"), [](const auto& info) { return std::string(info.param); });

TEST(Mirror, KnowsThatItWasNotToldYetWhereADiscoveredEntityIs) {
  const rti::Fom fom = load_rink_fom(fom_file());
  const ObjectModel model(fom);
  Mirror mirror(model);
  const rti::ObjectHandle object{7};
  mirror.discover(object, model.entity);
  ASSERT_NE(mirror.find(object), nullptr);
  EXPECT_FALSE(mirror.find(object)->is_placed);
  std::vector<std::byte> bytes;
  const Input input{};
  mirror.reflect(object, rti::AttributeSet{model.input}, encode(bytes, input), {});
  EXPECT_FALSE(mirror.find(object)->is_placed);
  const Position there{1.0f, 2.0f};
  mirror.reflect(object, rti::AttributeSet{model.position}, encode(bytes, there), {});
  EXPECT_TRUE(mirror.find(object)->is_placed);
  EXPECT_EQ(mirror.find(object)->position, there);
  mirror.set_scope(object, true);
  EXPECT_TRUE(mirror.find(object)->is_placed) << "the state may come before the word that it entered, or after";
  mirror.set_scope(object, false);
  mirror.set_scope(object, true);
  EXPECT_FALSE(mirror.find(object)->is_placed) << "where it was when it left is not where it is";
  mirror.reflect(object, rti::AttributeSet{model.position}, encode(bytes, there), {});
  EXPECT_TRUE(mirror.find(object)->is_placed);
}

}  // namespace
}  // namespace rink::game
