// Peers that die, are cut off, or leave: whoever is left has the states of one engine, every double
// of them, at every window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>

#include "tests/peer/session_play.h"

namespace rink::peer::test {
namespace {

TEST(Session, HasTheStatesOfOneEngineWithoutALoss) {
  for (const std::uint64_t number : {0, 2, 6, 7}) {
    Play play(number, 3, 20);
    play.run();
    EXPECT_EQ(play.count(Fate::done), 3u);
    expect_whole(play);
    for (const SessionCounters& counters : play.counters) EXPECT_EQ(counters.recoveries, 0u);
  }
}

/// Bats on both sides of the cut press against posts that are further from it than they are: the
/// other peer has the bat as a ghost, but not the post.
SharedScene leaning_scene(std::uint64_t number, double until) {
  SharedScene scene{physics::World(physics::test::rink_of(4.0, 2.0, 0.5, 0.1, 1.0)), {}};
  Random random(number);
  for (int k = 0; k < 8; ++k) {
    const double side = k % 2 == 0 ? 1.0 : -1.0, y = 0.2 + 0.2 * k,
                 distance = uniform(random, 0.25, 0.5);
    scene.world.add(physics::PostSpec{.position = {2.0 + side * distance, y}, .radius = 0.05});
    const physics::BodyId bat = scene.world.add(physics::BatSpec{
        .position = {2.0 + side * 0.1, y}, .half_extent = {0.05, 0.08}, .mass = 5.0});
    for (double time = 0.05; time < until; time += uniform(random, 0.2, 0.6)) {
      const double thrust = below(random, 4) == 0 ? -6.0 : 6.0;
      scene.keys.push_back({time, bat.index, {side * thrust, 0.0}, 0});
    }
  }
  add_gas(scene.world, random, 0.02, 1.0, 1.0);
  return scene;
}

TEST(Session, GoesOnWhileGhostsLeanOnPostsThatAreFarAway) {
  for (const std::uint64_t number : {0, 1, 2}) {
    Play play(number, 2, 300, leaning_scene);
    play.run();
    EXPECT_EQ(play.count(Fate::done), 2u);
    expect_whole(play);
    for (const SessionCounters& counters : play.counters) EXPECT_EQ(counters.recoveries, 0u);
    EXPECT_THAT(play.last_losses, testing::Each(""));
  }
}

/// So whoever needs memory may give it up before the session makes room for its own part.
TEST(Session, AsksForTheWholeNoMoreOnceItHasTakenItsPart) {
  constexpr std::uint64_t window_count = 10;
  SharedScene truth = shared_scene(0, 0.1);
  auto start = std::make_unique<SharedScene>(shared_scene(0, 0.1));
  LossyOffice office(1);
  LossyMail mail(office, 0, {}, {}, [](std::uint64_t) {});
  SessionSettings settings{
      .number = 0, .peer_count = 1, .halo = 0.2, .window_count = window_count, .end_of = {}};
  settings.end_of = [](std::uint64_t k) { return window_length * static_cast<double>(k); };
  Session session(start->world, Cuts::whole(truth.world.spec().field), std::move(settings), mail,
                  [&] { start.reset(); });
  ASSERT_EQ(start, nullptr);
  while (!session.is_over()) session.advance();
  physics::test::RandomKeys::advance(truth.world,
                                     window_length * static_cast<double>(window_count));
  EXPECT_EQ(hash_of_whole(truth.world.spec(), truth.world.body_count(), session.end()),
            truth.world.hash());
}

TEST(Session, GoesOnWhereverInTheProtocolAPeerIsKilled) {
  std::uint64_t recoveries = 0, shifts = 0, snapshots = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 4), victim = below(random, peer_count);
    const std::uint64_t last_word = 1 + below(random, 20 * 8 * (peer_count - 1));
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_word = [&](End peer, std::uint64_t word) {
      if (peer != victim || word != last_word) return;
      play.office().kill(victim);
      throw Killed();
    };
    play.run();
    EXPECT_EQ(play.count(Fate::killed) + play.count(Fate::done), peer_count);
    EXPECT_GE(play.count(Fate::done), peer_count - 1);
    expect_whole(play);
    for (const SessionCounters& counters : play.counters)
      recoveries += counters.recoveries, shifts += counters.shifts,
          snapshots += counters.replica_snapshots;
  }
  std::cout << recoveries << " recoveries, " << shifts << " shifts of zones, " << snapshots
            << " snapshots\n";
  EXPECT_GT(snapshots, 100u);
  EXPECT_GT(shifts, 50u);
  EXPECT_GT(recoveries, 100u);
}

TEST(Session, GoesOnWhenAPeerIsKilledWhileOthersRecoverOrSaysSo) {
  std::uint64_t done = 0, halted = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 5 + below(random, 2), first = below(random, peer_count),
                     second = (first + 1 + below(random, peer_count - 1)) % peer_count;
    const std::uint64_t last_word = 1 + below(random, 20 * 6 * (peer_count - 1)),
                        further = below(random, 6 * (peer_count - 1));
    std::atomic<bool> is_first_dead = false;
    std::atomic<std::uint64_t> words_since = 0;
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_word = [&](End peer, std::uint64_t word) {
      const bool dies_first = peer == first && word == last_word,
                 dies_second = peer == second && is_first_dead && words_since++ == further;
      if (!dies_first && !dies_second) return;
      play.office().kill(peer);
      if (dies_first) is_first_dead = true;
      throw Killed();
    };
    play.run();
    expect_whole(play);
    done += play.count(Fate::done), halted += play.count(Fate::halted);
    EXPECT_EQ(play.count(Fate::done) + play.count(Fate::halted) + play.count(Fate::killed),
              peer_count);
    EXPECT_TRUE(play.count(Fate::halted) == 0 || play.count(Fate::done) == 0);
    for (const std::string& message : play.messages)
      EXPECT_TRUE(message.empty() || message.find("and with them what peer") != std::string::npos)
          << message;
  }
  std::cout << done << " peers went on to the end, " << halted
            << " halted since both copies of a part were lost\n";
  EXPECT_GT(done, halted);
}

/// Nobody can know whether its last word has come. Who is cut off when all have told each other
/// their ends, and has everybody's confirmation, ends; who has not recovers, from the same last
/// step to the same result.
bool have_ended_as_one(const Play& play, PeerNumber a, PeerNumber b) {
  const bool has_one_ended_before =
      (play.counters[a].recoveries == 0) != (play.counters[b].recoveries == 0);
  return has_one_ended_before && play.hash_of(play.ends[a]) == play.hash_of(play.ends[b]);
}

TEST(Session, IsGoneOnWithByOneSideOfAPartitionAtMost) {
  std::uint64_t done = 0, halted = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 4);
    const std::uint64_t side = 1 + below(random, (1u << peer_count) - 2),
                        last_word = 1 + below(random, 20 * 6 * (peer_count - 1));
    const auto is_one = [&](End peer) { return (side >> peer & 1) != 0; };
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_word = [&](End peer, std::uint64_t word) {
      if (peer == 0 && word == last_word) play.office().cut_off(is_one);
    };
    play.run();
    expect_whole(play);
    for (PeerNumber a = 0; a < peer_count; ++a)
      for (PeerNumber b = 0; b < a; ++b) {
        const bool went_on = play.fates[a] == Fate::done && play.fates[b] == Fate::done;
        const bool was_cut = play.counters[a].recoveries > 0 || play.counters[b].recoveries > 0;
        EXPECT_TRUE(!went_on || !was_cut || is_one(a) == is_one(b) || have_ended_as_one(play, a, b))
            << a << " and " << b;
      }
    done += play.count(Fate::done), halted += play.count(Fate::halted);
    EXPECT_EQ(play.count(Fate::done) + play.count(Fate::halted), peer_count);
  }
  std::cout << done << " peers went on to the end, " << halted << " halted\n";
  EXPECT_GT(done, 0u);
  EXPECT_GT(halted, 0u);
}

TEST(Session, OfTwoIsGoneOnWithAlone) {
  Play play(7, 2, 20);
  play.before_word = [&](End peer, std::uint64_t word) {
    if (peer == 1 && word == 50) {
      play.office().kill(1);
      throw Killed();
    }
  };
  play.run();
  EXPECT_EQ(play.fates[0], Fate::done);
  EXPECT_EQ(play.fates[1], Fate::killed);
  expect_whole(play);
}

TEST(Session, IsLeftInGoodOrder) {
  for (std::uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 2 + below(random, 5);
    std::vector<std::uint64_t> windows;
    for (PeerNumber peer = 0; peer < peer_count; ++peer) windows.push_back(below(random, 40));
    windows[below(random, peer_count)] = 99;
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_window = [&](Session& session, End peer) {
      if (session.window() >= windows[peer]) session.leave();
    };
    play.run();
    expect_whole(play);
    EXPECT_GT(play.count(Fate::done), 0u);
    EXPECT_EQ(play.count(Fate::done) + play.count(Fate::left), peer_count);
    for (PeerNumber peer = 0; peer < peer_count; ++peer)
      EXPECT_TRUE(windows[peer] >= 18 || play.fates[peer] == Fate::left) << peer;
  }
}

TEST(Session, KeepsTheLogsOfThoseWhoAreGone) {
  std::size_t keys = 0;
  for (std::uint64_t seed = 0; seed < 30 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 3), victim = below(random, peer_count),
                     leaver = (victim + 1 + below(random, peer_count - 1)) % peer_count;
    const std::uint64_t last_word = 1 + below(random, 20 * 6 * (peer_count - 1)),
                        last_window = below(random, 30);
    Play play(6 + seed % 2 + 10 * seed, peer_count, 20);
    play.is_live = true;
    play.before_word = [&](End peer, std::uint64_t word) {
      if (peer != victim || word != last_word) return;
      play.office().kill(victim);
      throw Killed();
    };
    play.before_window = [&](Session& session, End peer) {
      if (peer == leaver && session.window() >= last_window) session.leave();
    };
    play.run();
    const bool has_ended = play.expect_truth_of_logs();
    keys += play.key_count();
    EXPECT_TRUE(has_ended || play.count(Fate::halted) > 0);
  }
  std::cout << keys << " keys\n";
  EXPECT_GT(keys, 500u);
}

}  // namespace
}  // namespace rink::peer::test
