// What a node takes from another about its part, and what it refuses.
#include "game/node/part_receiver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "game/node/node.h"
#include "tests/peer/shared_scenes.h"

namespace rink::game {
namespace {

using testing::HasSubstr;

/// Node 0 of two, which own the halves of a field with a puck each; the second has a post, too.
class PartReceiverTest : public testing::Test {
 protected:
  PartReceiverTest() : share_(world_.spec(), world_.body_count(), 2) {}

  /// Of node 1, in the window that ends so.
  peer::PartChange change(std::uint64_t step, std::uint32_t body) const {
    return {.step = step,
            .time = end_of_window(terms_, step),
            .is_whole = false,
            .bodies = {{body, physics::Subdomain::state_in(world_, body)}},
            .gone = {},
            .rest_contacts = {},
            .keys = {},
            .log = {}};
  }
  void play(std::uint64_t step) {
    feed_.expect({}, end_of_window(terms_, step + 1));
    receiver_.finish_window({.step = step,
                             .time = end_of_window(terms_, step),
                             .bodies = {},
                             .gone = {},
                             .rest_contacts = {},
                             .keys = {},
                             .log = {}},
                            division_, share_);
  }

  static constexpr std::uint32_t near = 0, far = 1, post = 2;
  const physics::World world_ = [] {
    physics::World world(physics::test::rink_of(4.0, 2.0));
    for (const double x : {1.0, 3.0}) world.add(physics::PuckSpec{.position = {x, 1.0}});
    world.add(physics::PostSpec{.position = {3.5, 0.5}, .radius = 0.1});
    return world;
  }();
  const peer::Division division_ = peer::Division::into_strips(world_.spec().field, 2);
  const Terms terms_ = terms_of_nodes(2, 1.0, 0.1);
  WindowFeed feed_{2, end_of_window(terms_, 1)};
  PartReceiver receiver_{world_, terms_, 0, feed_};
  peer::Share share_;
};

TEST_F(PartReceiverTest, PassesAWindowOnOnceBothHavePlayedIt) {
  EXPECT_TRUE(receiver_.receive(1, change(1, far)));
  EXPECT_FALSE(feed_.take(1.0)) << "it is not played here yet";
  play(1);
  const auto window = feed_.take(1.0);
  ASSERT_TRUE(window);
  EXPECT_EQ(window->changes[1].bodies.front().number, far);
  play(2);
  EXPECT_FALSE(feed_.take(1.0));
  EXPECT_TRUE(receiver_.receive(1, change(2, far)));
  EXPECT_TRUE(feed_.take(1.0));
}

TEST_F(PartReceiverTest, NamesWhoTellsOfABodyOutsideItsZones) {
  play(1);
  try {
    receiver_.receive(1, change(1, near));
    FAIL() << "it was taken";
  } catch (const peer::ProtocolError& error) {
    EXPECT_THAT(error.what(), HasSubstr("peer 1 tells of body 0, which is in none of its zones"));
  }
}

TEST_F(PartReceiverTest, FindsAFlightOutsideTheZonesOnceItKnowsThese) {
  peer::PartChange early = change(1, far);
  early.bodies.clear();
  early.free_flights = {
      {.position = {1.5, 1.0}, .velocity = {0.0, 0.0}, .time = 0.1, .number = far}};
  EXPECT_TRUE(receiver_.receive(1, early));
  EXPECT_THROW(play(1), peer::ProtocolError);
}

TEST_F(PartReceiverTest, RefusesWhatNoNodeSays) {
  const std::vector<std::function<void(peer::PartChange&)>> lies{
      [](peer::PartChange& lie) { lie.step = 2; },
      [](peer::PartChange& lie) { lie.step = 0; },
      [](peer::PartChange& lie) { lie.is_whole = true; },
      [](peer::PartChange& lie) { lie.time = 0.2; },
      [](peer::PartChange& lie) { lie.bodies.front().number = 77; },
      [](peer::PartChange& lie) { lie.bodies.front().number = post; },
      [](peer::PartChange& lie) { lie.bodies.front().state.flags |= 1; },  // removed
      [](peer::PartChange& lie) { lie.gone = {77}; },
      [](peer::PartChange& lie) { lie.gone = {post}; },
      [](peer::PartChange& lie) { lie.log = {{.time = 0.05, .bat = far, .input = 1}}; },
  };
  for (std::size_t k = 0; k < lies.size(); ++k) {
    peer::PartChange lie = change(1, far);
    lies[k](lie);
    EXPECT_FALSE(receiver_.receive(1, lie)) << k;
  }
  EXPECT_FALSE(receiver_.receive(0, change(1, near))) << "its own part";
  EXPECT_FALSE(receiver_.receive(2, change(1, far))) << "of nobody";
  EXPECT_TRUE(receiver_.receive(1, change(1, far)));
  EXPECT_FALSE(receiver_.receive(1, change(2, far))) << "too far ahead";
}

TEST_F(PartReceiverTest, RefusesAWindowThatItsNodeKeptBack) {
  play(1), play(2);
  EXPECT_FALSE(receiver_.receive(1, change(1, far)));
}

}  // namespace
}  // namespace rink::game
