// Of nodes that host matches some die or fall silent in each phase: the others play on by the same
// words, to the game of one engine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "tests/node/hosting_nodes.h"

namespace rink::game::lost_hosts {
namespace {

using testing::HasSubstr;

TEST_F(LostHosts, LeaveOthersInTheSameMatchWhicheverWordWasTheirLast) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_ = RandomStream(seed + 1);
    are_pressing_ = true;
    const std::uint32_t count = 2 + static_cast<std::uint32_t>(seed % 3);
    host(count, "100");
    const std::uint32_t lost = random_.below(count);
    at(lost).mortality.last_word = 1 + random_.below(100 * (count - 1));
    seat_both(random_.below(count), random_.below(count));
    ASSERT_TRUE(play([&] { return at(lost).mortality.is_dead.load(); }));
    const std::array places = places_;
    // A match that both players have left is over.
    const std::uint32_t match = places[0] == lost && places[1] == lost ? 2 : 1;
    are_pressing_ = false;
    const std::uint32_t other = (lost + 1) % count;
    come_back(other);
    ASSERT_TRUE(play_to(MatchPhase::playing, match)) << at(other).failure;
    if (places_ != places) {
      are_pressing_ = false;
      ASSERT_TRUE(play_for(0.3));
      for (const std::uint32_t player : {0u, 1u})
        if (places_[player] != places[player]) {
          EXPECT_EQ(held_by(player), KeysHeld()) << "released, and not pressed again";
        }
    }
    are_pressing_ = true;
    ASSERT_TRUE(play_for(0.6)) << at(other).failure;
    EXPECT_EQ(expect_one_game(), count - 1);
    for (const auto& each : nodes_)
      if (is_there(*each)) {
        EXPECT_EQ(each->news().size(), 1u);
      }
  }
}

TEST_F(LostHosts, MayBeLostBeforeAnybodyPlays) {
  for (const std::uint32_t lost : {0u, 1u, 2u}) {
    host(3, "100");
    at(lost).mortality.is_due = true;
    ASSERT_TRUE(play([&] { return all_are([](HostNode& node) { return !node.news().empty(); }); }));
    seat_both((lost + 1) % 3, (lost + 2) % 3);
    ASSERT_TRUE(play_to(MatchPhase::playing));
    ASSERT_TRUE(play_for(0.5));
    EXPECT_EQ(expect_one_game(), 2u);
  }
}

TEST_F(LostHosts, MayBeLostInAPauseWhichGoesOn) {
  for (const std::uint32_t lost : {0u, 1u, 2u}) {
    SCOPED_TRACE("node " + std::to_string(lost));
    host(3, "100");
    seat_both(1, 2);
    ASSERT_TRUE(play_to(MatchPhase::playing));
    ASSERT_TRUE(play_for(0.3));
    at(2).node.match()->pause(true);
    ASSERT_TRUE(play_to(MatchPhase::paused));
    at(lost).mortality.is_due = true;
    ASSERT_TRUE(play([&] { return all_are([](HostNode& node) { return !node.news().empty(); }); }));
    const std::uint32_t other = (lost + 1) % 3;
    if (lost == 0) {
      EXPECT_TRUE(play_to(MatchPhase::paused));
      at(1).node.match()->pause(false);
    } else {
      EXPECT_TRUE(play_to(MatchPhase::away));
      come_back(other);
    }
    ASSERT_TRUE(play_to(MatchPhase::playing));
    ASSERT_TRUE(play_for(0.5));
    EXPECT_EQ(expect_one_game(), 2u);
  }
}

TEST_F(LostHosts, MayBeLostBetweenMatches) {
  for (const std::uint32_t lost : {0u, 1u, 2u}) {
    SCOPED_TRACE("node " + std::to_string(lost));
    host(3, "1");
    seat_both(1, 2);
    ASSERT_TRUE(play_to(MatchPhase::over));
    at(lost).mortality.is_due = true;
    ASSERT_TRUE(play([&] { return all_are([](HostNode& node) { return !node.news().empty(); }); }));
    if (lost == 0) {
      EXPECT_TRUE(play_to(MatchPhase::over));
    } else {
      come_back(3 - lost);
    }
    // Who comes while another leaves takes its place, which is no reason for a new match.
    for (const std::uint32_t player : {0u, 1u})
      at(places_[player]).node.match()->ask_rematch(player);
    ASSERT_TRUE(play([&] {
      return all_are([](const HostNode& node) {
        return node.state.number == 2 && node.state.phase == MatchPhase::playing;
      });
    }));
    ASSERT_TRUE(play_for(0.3));
    EXPECT_EQ(expect_one_game(), 2u);
    EXPECT_EQ(at(first_there()).matches.size(), 2u);
  }
}

TEST_F(LostHosts, MayBeLostAboutTheWinningGoalWhichCountsOnce) {
  are_pressing_ = false;
  host(3, "1");
  seat_both(1, 2);
  ASSERT_TRUE(play_to(MatchPhase::over));
  const std::uint64_t hash = at(0).matches.at(1).game.hash(), words = at(0).mortality.words;
  for (std::uint64_t last = 0; last < 9; ++last) {
    SCOPED_TRACE("the last word but " + std::to_string(last));
    host(3, "1");
    const std::uint32_t lost = last % 3 == 0 ? 0 : static_cast<std::uint32_t>(last / 2 % 3);
    at(lost).mortality.last_word = words - last;
    seat_both(1, 2);
    ASSERT_TRUE(play([&] {
      return all_are([](const HostNode& node) {
               return node.state.number > 0 &&
                      (node.state.winner.has_value() || node.state.phase == MatchPhase::waiting ||
                       node.state.phase == MatchPhase::away);
             }) &&
             (at(lost).mortality.is_dead || last == 0);
    }));
    if (last == 0) at(lost).mortality.is_due = true;
    come_back(first_there());
    ASSERT_TRUE(play([&] {
      return all_are([](const HostNode& node) {
        return node.state.number == 2 || node.state.winner == Team::right;
      });
    }));
    for (const auto& each : nodes_)
      if (is_there(*each)) {
        EXPECT_EQ(each->matches.at(1).game.hash(), hash);
      }
  }
}

TEST_F(LostHosts, MayBeLostOneAfterTheOther) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random_ = RandomStream(seed + 300);
    host(4, "100");
    const std::uint32_t first = 1, second = 2 + random_.below(2);
    const std::uint64_t word = 20 + random_.below(200);
    at(first).mortality.last_word = word;
    at(second).mortality.last_word = word + 1 + random_.below(30);
    seat_both(first, 5 - second);
    ASSERT_TRUE(play([&] { return at(first).mortality.is_dead.load(); }));
    come_back(5 - second);
    ASSERT_TRUE(play([&] { return at(second).mortality.is_dead.load(); }));
    ASSERT_TRUE(play_to(MatchPhase::playing));
    ASSERT_TRUE(play_for(0.5)) << at(0).failure << at(5 - second).failure;
    EXPECT_EQ(expect_one_game(), 2u);
  }
}

TEST_F(LostHosts, LetNoHalfWithoutTheFirstGoOn) {
  host(4, "100");
  seat_both(2, 3);
  ASSERT_TRUE(play_to(MatchPhase::playing));
  at(0).mortality.is_due = at(1).mortality.is_due = true;
  ASSERT_TRUE(play([&] {
    return (!at(2).failure.empty() && !at(3).failure.empty()) ||
           at(2).news().size() + at(3).news().size() == 4;
  }));
  // Both may be seen to go at once, or one after the other; then each time a majority is left.
  if (at(2).news().empty() && at(3).news().empty()) {
    for (const std::uint32_t left : {2u, 3u})
      EXPECT_THAT(at(left).failure, HasSubstr("it halts, for the others may go on"));
  }
}

TEST_F(LostHosts, LeaveTheSecondOfTwoAloneWhichSaysSo) {
  for (const std::uint32_t lost : {0u, 1u}) {
    host(2, "100");
    seat_both(0, 1);
    ASSERT_TRUE(play_to(MatchPhase::playing));
    at(lost).mortality.is_due = true;
    ASSERT_TRUE(play([&] { return !at(1 - lost).news().empty(); }));
    EXPECT_THAT(at(1 - lost).news(), testing::ElementsAre(HasSubstr("this peer continues alone")));
    EXPECT_EQ(at(1 - lost).news()[0].find("others may have done so too") != std::string::npos,
              lost == 0);
    come_back(1 - lost);
    ASSERT_TRUE(play_to(MatchPhase::playing));
    ASSERT_TRUE(play_for(0.3));
    EXPECT_EQ(expect_one_game(), 1u);
  }
}

TEST_F(LostHosts, AreLostWhenTheyFallSilentAndAreToldSo) {
  for (const std::uint32_t count : {2u, 3u}) {
    SCOPED_TRACE(std::to_string(count) + " nodes");
    host(count, "100", 16.0);
    const std::uint32_t lost = count == 2 ? 1 : 0;
    at(lost).mortality.is_frozen = true;
    seat_both(count - 1 - lost, count - 1 - lost);
    ASSERT_TRUE(play_to(MatchPhase::playing));
    ASSERT_TRUE(play_for(0.3));
    at(lost).mortality.is_due = true;
    ASSERT_TRUE(play([&] { return all_are([](HostNode& node) { return !node.news().empty(); }); }));
    ASSERT_TRUE(play_for(0.3));
    EXPECT_EQ(expect_one_game(), count - 1);
    at(lost).mortality.is_due = false;
    at(lost).mortality.is_thawed = true;
    ASSERT_TRUE(play([&] { return !at(lost).failure.empty(); }));
    EXPECT_THAT(at(lost).failure, HasSubstr("halts"));
  }
}

}  // namespace
}  // namespace rink::game::lost_hosts
