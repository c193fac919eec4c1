// What is shown to somebody who watches a crowd.
#include <gtest/gtest.h>

#include <algorithm>

#include "game/net/client/network_match.h"
#include "game/replication/trajectory_codec.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

TEST(Watching, ShowsUnderABudgetWhoWasToldOfAndNobodyElse) {
  const Scene scene = small_crowd();
  LockstepRink rink(scene, {.scheme = "none with priority(budget=200)",
                            .clients = 2,
                            .view_fraction = 1.0,
                            .server = {.replay = keys_for(scene, 5, 4.0)}});
  const rti::Fom fom = load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml");
  const ObjectModel model(fom);
  rti::InProcessEndpoint endpoint(rink.network());
  NetworkMatch watcher(fom, model, endpoint, endpoint.connect("rti"),
                       {.federation = "rink", .name = "watcher", .only_watches = true});
  const auto exchange = [&] {
    for (int round = 0; round < 6; ++round) rink.settle(), watcher.advance(rink.now);
  };
  exchange();
  rink.start();
  std::size_t shown = 0, most_waiting = 0;
  for (int tick = 0; tick < 40; ++tick) {
    rink.tick();
    exchange();
    const std::vector<Thing>& things = watcher.sight().things;
    most_waiting =
        std::max(most_waiting, watcher.client().replicas().entities().size() - things.size());
    for (const Thing& thing : things)
      EXPECT_GT(thing.half_extent.minCoeff(), 0.0) << "thing " << thing.id << " at tick " << tick;
    EXPECT_GE(things.size(), shown);
    shown = things.size();
  }
  EXPECT_GT(most_waiting, 50u) << "all are in scope at once, and what they are has to wait";
  EXPECT_EQ(shown, watcher.client().replicas().entities().size()) << "in the end nobody is missing";
}

}  // namespace
}  // namespace rink::game
