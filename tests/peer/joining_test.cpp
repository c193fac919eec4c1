// Newcomers while others play, leave, die and are cut off: one owner per body at each window, and
// every double of it as on one engine.
#include <iostream>

#include "tests/peer/session_play.h"

namespace rink::peer::test {
namespace {

constexpr std::uint64_t joining_window_count = 30;

TEST(Joining, OneAloneIsJoinedByOthersAndAllHaveTheStatesOfOneEngine) {
  for (std::uint64_t seed = 0; seed < 20 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(seed, 1, joining_window_count);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_window = [&](Session& session, End end) {
      if (end == 0 && session.window() % 5 == 1 && session.window() < 20) play.invite(0);
      // Windows of tests are short, and a newcomer's thread may have to wait for a processor:
      // nobody is left behind.
      if (end == 0 && session.window() > 20 && session.members().size() < 5)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    };
    play.run();
    expect_whole(play);
    EXPECT_EQ(play.count(Fate::done), 5u);
    EXPECT_EQ(play.sent_away, 0u);
  }
}

TEST(Joining, ThroughDifferentPeersAtTheSameWindowGivesDifferentNumbers) {
  for (std::uint64_t seed = 0; seed < 20 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(seed, 3, joining_window_count);
    play.before_window = [&](Session& session, End end) {
      if (session.window() == 3 && end < 3) play.invite(end), play.invite(end);
      if (session.window() > 3 && end == 0 && session.members().size() < 9)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    };
    play.run();
    expect_whole(play);
    EXPECT_EQ(play.count(Fate::done), 9u);
  }
}

TEST(Joining, GoesOnWhenTheFirstHasLeftAndWhenOnlyNewcomersAreLeft) {
  for (std::uint64_t seed = 0; seed < 20 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(seed, 1, 60);
    play.before_window = [&](Session& session, End end) {
      const auto is_in = [&](PeerNumber peer) { return State::is_in(session.members(), peer); };
      if (end == 0 && session.window() == 2) play.invite(0);
      if (end == 1 && play.windows_played[1] == 3) play.invite(1);
      if ((end == 0 && is_in(1)) || (end == 1 && is_in(2))) session.leave();
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    };
    play.run();
    expect_whole(play);
    EXPECT_EQ(play.count(Fate::left), 2u);
    EXPECT_EQ(play.fates[2], Fate::done);
  }
}

TEST(Joining, PlaysBatsOfItsOwnAndTheUnionOfTheLogsIsTheSameGame) {
  std::size_t keys = 0, joined = 0;
  for (std::uint64_t seed = 0; seed < 12 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Play play(6 + seed % 2 + 10 * seed, 2, joining_window_count);
    play.is_live = true, play.spare_bats = 3;
    play.before_window = [&](Session& session, End end) {
      if (end < 2 && session.window() == 4) play.invite(end, 1);
      if (end == 0 && session.window() == 12) session.leave();
    };
    play.run();
    const bool has_ended = play.expect_truth_of_logs();
    play.expect_one_owner_each();
    EXPECT_TRUE(has_ended);
    keys += play.key_count(), joined += play.count(Fate::done) - 1;
  }
  std::cout << keys << " keys, " << joined << " joined\n";
  EXPECT_GT(keys, 200u);
  EXPECT_GT(joined, 12u);
}

struct Storm {
  std::uint64_t done = 0, left = 0, killed = 0, halted = 0, recoveries = 0, sent_away = 0,
                newcomers = 0;
};

/// Joins, leaves, deaths and partitions at random words.
void play_storm(std::uint64_t seed, bool has_partition, Storm& storm) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed + 1000);
  const PeerNumber peer_count = 1 + below(random, 4);
  Play play(below(random, 800), peer_count, joining_window_count);
  play.balance_windows = static_cast<std::uint32_t>(seed % 3);
  // By end: who leaves when, and who dies at which word. Most do neither.
  std::vector<std::uint64_t> leaving(LossyOffice::ends_max, 99), dying(LossyOffice::ends_max, 0);
  for (End end = 0; end < LossyOffice::ends_max; ++end) {
    if (below(random, 4) == 0) leaving[end] = below(random, joining_window_count);
    if (!has_partition && below(random, 5) == 0) dying[end] = 1 + below(random, 400);
  }
  std::vector<std::vector<std::uint64_t>> joining(LossyOffice::ends_max);
  for (std::uint32_t count = 2 + below(random, 5); count > 0; --count)
    joining[below(random, peer_count + 2)].push_back(1 + below(random, 20));
  const std::uint64_t side = random(), cut_word = has_partition ? 1 + below(random, 500) : 0;
  const auto is_one = [&](End end) { return (side >> end & 1) != 0; };
  std::atomic<std::uint64_t> words = 0;
  play.before_word = [&](End end, std::uint64_t word) {
    if (cut_word != 0 && ++words == cut_word) play.office().cut_off(is_one);
    if (word != dying[end]) return;
    play.office().kill(end);
    throw Killed();
  };
  play.before_window = [&](Session& session, End end) {
    while (!joining[end].empty() && joining[end].back() <= session.window())
      play.invite(end), joining[end].pop_back();
    if (session.window() >= leaving[end]) session.leave();
  };
  play.run();
  expect_whole(play);
  for (End a = 0; has_partition && a < LossyOffice::ends_max; ++a)
    for (End b = 0; b < a; ++b) {
      const bool went_on = play.fates[a] == Fate::done && play.fates[b] == Fate::done,
                 was_cut = play.counters[a].recoveries > 0 && play.counters[b].recoveries > 0;
      EXPECT_FALSE(went_on && was_cut && is_one(a) != is_one(b) && !play.is_of_two)
          << a << " and " << b;
    }
  EXPECT_EQ(play.count(Fate::playing), 0u);
  for (End end = peer_count; end < LossyOffice::ends_max; ++end)
    storm.newcomers += play.windows_played[end] > 0;
  storm.done += play.count(Fate::done), storm.left += play.count(Fate::left),
      storm.killed += play.count(Fate::killed), storm.halted += play.count(Fate::halted);
  storm.sent_away += play.sent_away;
  for (const SessionCounters& counters : play.counters) storm.recoveries += counters.recoveries;
}

void tell(const Storm& storm) {
  std::cout << storm.newcomers << " newcomers played, " << storm.done << " peers to the end, "
            << storm.left << " left, " << storm.killed << " were killed, " << storm.halted
            << " halted, " << storm.sent_away << " were sent away, " << storm.recoveries
            << " recoveries\n";
}

TEST(Joining, StormsOfJoinsLeavesAndKillsLeaveOneOwnerPerBody) {
  Storm storm;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) play_storm(seed, false, storm);
  tell(storm);
  EXPECT_GT(storm.newcomers, 60u);
  EXPECT_GT(storm.done, 60u);
  EXPECT_GT(storm.recoveries, 60u);
}

TEST(Joining, StormsWithAPartitionLeaveOneOwnerPerBody) {
  Storm storm;
  for (std::uint64_t seed = 100; seed < 140 && !HasFailure(); ++seed) play_storm(seed, true, storm);
  tell(storm);
  EXPECT_GT(storm.newcomers, 20u);
}

class StormLong : public testing::TestWithParam<int> {};

TEST_P(StormLong, LeavesOneOwnerPerBody) {
  Storm storm;
  for (std::uint64_t seed = 0; seed < 100 && !HasFailure(); ++seed)
    play_storm(1000 + 100 * static_cast<std::uint64_t>(GetParam()) + seed, seed % 4 == 3, storm);
  tell(storm);
}

INSTANTIATE_TEST_SUITE_P(Joining, StormLong, testing::Range(0, 10));

}  // namespace
}  // namespace rink::peer::test
