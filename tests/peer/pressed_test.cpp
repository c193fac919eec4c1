// Heaps of pucks that bats press together across borders: the states of one engine at every window,
// and few windows that are played twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include "game/peer/assembly.h"
#include "game/peer/cuts.h"
#include "tests/peer/session_play.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

struct Pressed {
  PeerCounters counters;
  std::uint64_t hops = 0, annexes = 0;  ///< of the truth; announced, summed over windows
};

/// Stops at the first window at which they differ.
Pressed play_pressed(std::uint64_t number, PeerNumber peer_count, int windows) {
  const double length = 0.01;
  SharedScene scene = pressed_scene(number, length * windows);
  physics::World& world = scene.world;
  std::vector<Vector2> places;
  for (std::uint32_t body = 0; body < world.body_count(); ++body)
    places.push_back(world.position({body}));
  Random random(number);
  const Division division =
      number % 2 == 0 ? random_division(world.spec().field, random, peer_count)
                      : Cuts::by_count(world.spec().field, places, peer_count).division(peer_count);
  Assembly assembly(world, division, uniform(random, 0.1, 0.3), length);
  std::stable_sort(scene.keys.begin(), scene.keys.end(), [](const Key& a, const Key& b) {
    return a.time != b.time ? a.time < b.time : a.bat < b.bat;
  });
  for (const Key& key : scene.keys) assembly.press(key);
  Pressed played;
  std::size_t next = 0;
  for (int window = 1; window <= windows && !testing::Test::HasFailure(); ++window) {
    for (; next < scene.keys.size() && scene.keys[next].time <= length * window; ++next) {
      physics::test::RandomKeys::advance(world, scene.keys[next].time);
      world.set_thrust({scene.keys[next].bat}, scene.keys[next].thrust);
    }
    physics::test::RandomKeys::advance(world, length * window);
    assembly.advance();
    for (std::uint32_t body = 0; body < world.body_count(); ++body)
      if (bytes_of(assembly.state(body)) != bytes_of(physics::Subdomain::state_in(world, body))) {
        ADD_FAILURE() << "scene " << number << ", " << peer_count << " peers, window " << window
                      << ", body " << body;
        break;
      }
    for (const Peer& peer : assembly.peers())
      played.annexes += peer.halos().annexes(peer.number()).size();
  }
  for (const Peer& peer : assembly.peers()) played.counters += peer.counters();
  played.hops = world.counters().hops;
  return played;
}

void expect_same_pressed(std::uint64_t first, std::uint64_t last, int windows) {
  for (const PeerNumber peer_count : {2, 4, 8}) {
    Pressed all;
    for (std::uint64_t number = first; number < last; ++number) {
      const Pressed played = play_pressed(number, peer_count, windows);
      all.counters += played.counters, all.hops += played.hops, all.annexes += played.annexes;
    }
    EXPECT_GT(all.hops, 0u);
    std::cout << peer_count << " peers repeat " << all.counters.repeats << " of "
              << all.counters.windows << " windows, with " << all.annexes << " annexes; "
              << all.counters.own_events << " own events, " << all.counters.ghost_events
              << " of ghosts alone\n";
  }
}

TEST(Pressed, HeapsEqualOneEngineAmongAnyNumberOfPeers) { expect_same_pressed(0, 4, 30); }

class PressedLong : public testing::TestWithParam<std::uint64_t> {};
TEST_P(PressedLong, HeapsEqualOneEngineAmongAnyNumberOfPeers) {
  expect_same_pressed(10 + 10 * GetParam(), 20 + 10 * GetParam(), 150);
}
INSTANTIATE_TEST_SUITE_P(Part, PressedLong, testing::Range<std::uint64_t>(0, 10));

/// One of three is lost in the midst of it.
TEST(Pressed, HeapsEqualOneEngineThroughALoss) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Play play(first_pressed_scene + seed, 3, 20);
    const std::uint64_t last_word = 10 + below(random, 200);
    play.before_word = [&](End peer, std::uint64_t word) {
      if (peer != 1 || word != last_word) return;
      play.office().kill(1);
      throw Killed();
    };
    play.run();
    expect_whole(play);
    EXPECT_EQ(play.fates[0], Fate::done) << play.messages[0];
    EXPECT_EQ(play.fates[2], Fate::done) << play.messages[2];
  }
}

TEST(Pressed, HeapsEqualOneEngineThoughSomebodyJoins) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(first_pressed_scene + seed, 2, 30);
    play.balance_windows = 3;
    play.before_window = [&](Session& session, End peer) {
      if (peer == 0 && session.window() == 4) play.invite(0);
      // Nobody is left behind whose thread has to wait for a processor.
      if (peer == 0 && session.window() > 12 && session.members().size() < 3)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    };
    play.run();
    expect_whole(play);
    EXPECT_EQ(play.count(Fate::done), 3u);
  }
}

}  // namespace
}  // namespace rink::peer::test
