// Teams, owners and what is always relevant in a running federation, against a recount from the
// game itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "game/replication/region_sweep.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

/// What an expression means for one player and one entity that is not his own bat: `is_near` is
/// what `aura` says.
using Meaning = std::function<bool(const Entity& bat, const Entity& other, bool is_near)>;

bool is_mate(const Entity& bat, const Entity& other) {
  return other.kind == physics::BodyKind::bat && other.team == bat.team && bat.team != Team::none;
}

/// The entity's box and the disc that `view` holds touch; nothing if rounding could decide.
std::optional<bool> touches(const im::Region& view, const im::Region& box) {
  const double x = (view.low_x + view.high_x) / 2.0, y = (view.low_y + view.high_y) / 2.0,
               radius = std::min(view.high_x - view.low_x, view.high_y - view.low_y) / 2.0;
  const double distance = std::hypot(std::clamp(x, box.low_x, box.high_x) - x,
                                     std::clamp(y, box.low_y, box.high_y) - y);
  if (std::abs(distance - radius) < 1e-5) return std::nullopt;
  return distance < radius;
}

std::vector<rti::SubscribedRegion> subscribed_views(LockstepRink& rink) {
  std::vector<rti::SubscribedRegion> views;
  rink.execution().list_subscribed_regions(views);
  return views;
}

/// Plays a tick and holds every player's scope against `meaning`; returns how many pairs were in
/// scope.
std::size_t recount(LockstepRink& rink, const Meaning& meaning) {
  const auto views =
      subscribed_views(rink);  // before the players hear of the tick and look elsewhere
  rink.tick();
  const Game& game = rink.server().game();
  std::size_t in_scope = 0;
  for (const auto& [federate, view] : views) {
    const auto own =
        std::ranges::find_if(game.entities(), [&, federate = federate](const Entity& each) {
          return rink.server().bat_of(federate) == rink.server().publisher().object(each.id);
        });
    if (own == game.entities().end()) continue;
    for (const Entity& each : game.entities()) {
      const bool is_heard =
          rink.execution().is_in_scope(federate, rink.server().publisher().object(each.id));
      in_scope += is_heard ? 1 : 0;
      const auto is_near = touches(view, bounding_box(game.position(each.id), each.half_extent));
      if (each.id != own->id && !is_near) continue;
      const bool is_expected = each.id == own->id || meaning(*own, each, *is_near);
      EXPECT_EQ(is_heard, is_expected) << "entity " << each.id.index << " for player "
                                       << *own->player << " under " << rink.scheme();
    }
  }
  return in_scope;
}

struct Case {
  const char* scheme;
  Meaning meaning;
};

TEST(Roles, SayInAFederationWhatTheirNamesSay) {
  const Case cases[] = {
      {"aura or owner or team", [](const Entity& bat, const Entity& other,
                                   bool is_near) { return is_near || is_mate(bat, other); }},
      {"team", [](const Entity& bat, const Entity& other, bool) { return is_mate(bat, other); }},
      {"owner", [](const Entity&, const Entity&, bool) { return false; }},
      {"aura and not team", [](const Entity& bat, const Entity& other,
                               bool is_near) { return is_near && !is_mate(bat, other); }},
      {"not (team or always)",
       [](const Entity& bat, const Entity& other, bool) {
         return !is_mate(bat, other) && other.kind != physics::BodyKind::post;
       }},
      {"always or aura", [](const Entity&, const Entity& other, bool is_near) {
         return is_near || other.kind == physics::BodyKind::post;
       }}};
  const Scene scene = small_crowd();
  for (const auto& [scheme, meaning] : cases) {
    LockstepRink rink(
        scene, {.scheme = scheme, .clients = 5, .server = {.replay = keys_for(scene, 3, 2.0)}});
    rink.start();
    std::size_t pairs = 0;
    for (int tick = 0; tick < 30; ++tick) pairs += recount(rink, meaning);
    EXPECT_GE(pairs, 150u) << scheme;
    EXPECT_EQ(rink.client(4).state(), Client::State::playing) << scheme;
  }
}

TEST(Roles, LetNobodyWaitForHisOwnBatForEver) {
  for (const char* scheme :
       {"region and not cone", "not region", "always", "not always", "region and not owner",
        "not none", "aura and not aura with tiers(at=0.5)"}) {
    LockstepRink rink(match(), {.scheme = scheme, .clients = 2});
    rink.start();
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_EQ(rink.client(k).state(), Client::State::playing) << scheme;
    rink.client(0).press(Key::up);
    rink.run(0.5);
    const EntityReplica* own = rink.client(0).bat();
    ASSERT_NE(own, nullptr) << scheme;
    EXPECT_TRUE(own->in_scope) << scheme;
    EXPECT_NEAR(own->position_at(rink.now).y(),
                rink.server().game().position(*rink.server().game().bat(0)).y(), 1e-6)
        << scheme << ": and hears where it goes";
  }
}

TEST(Roles, OfAMatchMakeThePuckRelevantToBothPlayersAlways) {
  LockstepRink rink(match(), {.scheme = "always", .clients = 2, .view_fraction = 0.01});
  rink.start();
  rink.run(0.2);
  for (const Entity& each : rink.server().game().entities())
    EXPECT_EQ(rink.execution().is_in_scope(*rink.server().seats().federate_of(0),
                                           rink.server().publisher().object(each.id)),
              each.kind != physics::BodyKind::bat || each.player == 0u);
}

TEST(Roles, AreWhatTheServerIsToldWhereItIsTold) {
  RelevantKinds bats;
  bats.add(physics::BodyKind::bat);
  LockstepRink rink(
      small_crowd(),
      {.scheme = "always", .clients = 2, .server = {.replay = {}, .always_relevant = bats}});
  rink.start();
  rink.run(0.2);
  EXPECT_EQ(recount(rink, [](const Entity&, const Entity& other,
                             bool) { return other.kind == physics::BodyKind::bat; }),
            2u * 12u);
}

TEST(Roles, FollowWhoLeavesAndComesBack) {
  const auto meaning = [](const Entity& bat, const Entity& other, bool) {
    return is_mate(bat, other);
  };
  LockstepRink rink(small_crowd(), {.scheme = "team", .clients = 4});
  rink.start();
  rink.run(0.2);
  rink.kill(0), rink.kill(1);
  rink.run(0.2);
  recount(rink, meaning);
  rink.add_client("bat-1");  // takes the place of a federate of the other side
  rink.add_client("bat-0");
  rink.run(0.5);
  EXPECT_GE(recount(rink, meaning), 4u * 5u);
}

}  // namespace
}  // namespace rink::game
