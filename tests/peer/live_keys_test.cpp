// Keys pressed while peers play: they go to whoever owns the bat, and a replay of the owners' logs
// is the same game.
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <map>

#include "game/peer/assembly.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

struct Counts {
  std::uint64_t keys = 0, foreign_keys = 0, timed_keys = 0, observations = 0, moved_bats = 0;
  std::uint64_t keys_at_once = 0;  ///< felt from the start of the window on that they came before
};

/// Scene `number` of those with bats, each of which a random peer plays, at random, by what it is
/// shown.
class LiveGame {
 public:
  LiveGame(std::uint64_t number, double window, bool comes_early = false)
      : random_(number),
        window_(window),
        comes_early_(comes_early),
        scene_(shared_scene(6 + number % 2 + 10 * (number / 2), 0.0)),
        peer_count_(2 + below(random_, 5)),
        division_(random_division(scene_.world.spec().field, random_, peer_count_)),
        assembly_(scene_.world, division_, 0.2, window) {
    scene_.keys.clear();
    for (std::uint32_t body = 0; body < scene_.world.body_count(); ++body) {
      if (scene_.world.kind({body}) != physics::BodyKind::bat) continue;
      const double period = std::array{window, 3.5 * window, 0.0}[below(random_, 3)];
      seats_[body] = {.bat = body,
                      .peer = below(random_, peer_count_),
                      .period = period,
                      .phase = uniform(random_, 0.0, 0.999 * window),
                      .puck_count = 4};
      owners_[body] = division_.owner_of(scene_.world.position({body}));
    }
    for (Peer& peer : assembly_.peers())
      for (const auto& [bat, seat] : seats_) peer.players().seat(seat);
  }

  void play(int window_count, Counts& counts) {
    for (int k = 1; k <= window_count && !testing::Test::HasFailure(); ++k) {
      assembly_.advance();
      replay(window_ * k, counts);
      for (std::uint32_t body = 0; body < scene_.world.body_count(); ++body)
        ASSERT_EQ(bytes_of(assembly_.state(body)),
                  bytes_of(physics::Subdomain::state_in(scene_.world, body)))
            << "window " << k << ", body " << body;
      EXPECT_EQ(assembly_.misowned(), 0u);
      for (Peer& peer : assembly_.peers()) look_and_press(peer, window_ * k, counts);
    }
  }

 private:
  /// On one engine, what the owners logged.
  void replay(double until, Counts& counts) {
    std::vector<Key> log;
    for (const Peer& peer : assembly_.peers())
      log.insert(log.end(), peer.log().begin(), peer.log().end());
    std::stable_sort(log.begin(), log.end(), [](const Key& a, const Key& b) {
      return a.time != b.time ? a.time < b.time : a.bat < b.bat;
    });
    counts.keys += log.size();
    for (const Key& key : log) {
      physics::test::RandomKeys::advance(scene_.world, key.time);
      scene_.world.set_thrust({key.bat}, key.thrust);
      const Wish wish =
          wishes_[key.bat]
              .front();  // none is lost, none comes twice, in the order in which they were pressed
      EXPECT_EQ(key.input, wish.press.input);
      const bool is_at_once = comes_early_ && key.time == wish.window_start;
      EXPECT_TRUE(is_at_once || key.time == std::clamp(wish.press.time, wish.window_end,
                                                       wish.window_end + LivePlayers::ahead_max));
      counts.timed_keys += key.time != wish.window_end;
      counts.keys_at_once += is_at_once;
      wishes_[key.bat].pop_front();
    }
    physics::test::RandomKeys::advance(scene_.world, until);
  }

  void look_and_press(Peer& peer, double now, Counts& counts) {
    for (const Observation& observation : peer.observations()) {
      ++counts.observations;
      EXPECT_EQ(seats_.at(observation.bat).peer, peer.number());
      EXPECT_EQ(observation.position, scene_.world.position({observation.bat}));
      EXPECT_EQ(observation.time, now);
      const PeerNumber owner = division_.owner_of(observation.position);
      EXPECT_EQ(observation.owner, owner);
      counts.moved_bats += std::exchange(owners_[observation.bat], owner) != owner;
      double distance = 0.0;
      for (const Observation::Puck& puck : observation.pucks) {
        EXPECT_LE(distance, (puck.position - observation.position).norm());
        distance = (puck.position - observation.position).norm();
      }
      for (std::uint32_t k = below(random_, 3); k > 0; --k) {
        const double x = static_cast<double>(below(random_, 3)) - 1.0,
                     y = static_cast<double>(below(random_, 3)) - 1.0;
        double& wanted = wanted_[observation.bat];
        if (!comes_early_) wanted = std::max(wanted, now + uniform(random_, -1.0, 3.0) * window_);
        const Press press{observation.bat, Vector2(x, y) * 6.0,
                          static_cast<std::uint8_t>(1 + counts.observations % 200), wanted};
        if (comes_early_)
          assembly_.peers()[observation.owner].receive(peer.number(), std::span(&press, 1));
        else peer.players().press(observation.owner, press);
        wishes_[observation.bat].push_back({press, now, peer.end()});
        counts.foreign_keys += owner != peer.number();
      }
    }
  }

  Random random_;
  double window_;
  bool comes_early_;  ///< keys do, ahead of the claims
  SharedScene scene_;
  PeerNumber peer_count_;
  Division division_;
  Assembly assembly_;
  std::map<std::uint32_t, Seat> seats_;
  std::map<std::uint32_t, PeerNumber> owners_;
  struct Wish {
    Press press;
    double window_start, window_end;
  };
  std::map<std::uint32_t, double> wanted_;
  std::map<std::uint32_t, std::deque<Wish>> wishes_;
};

TEST(LiveKeys, GoToTheOwnersWhoseLogsAreTheSameGameToTheLastDigit) {
  Counts counts;
  for (std::uint64_t number = 0; number < 12 && !HasFailure(); ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    LiveGame(number, 0.02).play(120, counts);
  }
  std::cout << counts.keys << " keys, " << counts.foreign_keys
            << " pressed of bats that others own, " << counts.timed_keys
            << " for an instant after their window, by " << counts.observations
            << " glimpses; bats changed their owners " << counts.moved_bats << " times\n";
  for (const std::uint64_t count : {counts.keys, counts.foreign_keys, counts.timed_keys,
                                    counts.observations, counts.moved_bats})
    EXPECT_GT(count, 0u);
}

TEST(LiveKeys, ThatComeEarlyAreFeltAtOnceWhereNobodyElseHasTheBatInTheSameGame) {
  Counts counts;
  for (std::uint64_t number = 0; number < 12 && !HasFailure(); ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    LiveGame(number, 0.02, true).play(120, counts);
  }
  std::cout << counts.keys_at_once << " of " << counts.keys << " keys were felt at once\n";
  EXPECT_GT(counts.keys_at_once, 0u);
  EXPECT_LT(counts.keys_at_once, counts.keys);
}

TEST(LiveKeys, OfABatThatSomebodyElsePlaysAreAnAccusation) {
  const SharedScene scene = shared_scene(6, 1.0);
  std::uint32_t bat = 0;
  while (scene.world.kind({bat}) != physics::BodyKind::bat) ++bat;
  Assembly assembly(scene.world, Division::into_strips(scene.world.spec().field, 2), 0.2, 0.01);
  for (Peer& peer : assembly.peers()) peer.players().seat({.bat = bat, .peer = 0});
  assembly.peers()[1].players().press(0, {bat, {1.0, 0.0}, 1});
  try {
    assembly.advance();
    ADD_FAILURE() << "nobody minds";
  } catch (const std::logic_error& error) {
    EXPECT_EQ(std::string(error.what()), "at peer 0: peer 1 presses a key of bat " +
                                             std::to_string(bat) + ", which it does not play");
  }
}

}  // namespace
}  // namespace rink::peer::test
