// Seats: who gets which, who has been told, and whose turn is done.
#include "game/net/server/players/seats.h"

#include <gtest/gtest.h>

#include <vector>

namespace rink::game {
namespace {

constexpr rti::FederateHandle first{3}, second{1};

TEST(Seats, AreFoundByNameAndElseTheFirstThatIsFree) {
  Seats seats(3);
  EXPECT_EQ(seats.free("bat-2"), 2u);
  EXPECT_EQ(seats.free("somebody"), 0u);
  seats.enter(first, 0);
  EXPECT_EQ(seats.free("bat-0"), 1u) << "it is taken";
  seats.enter(second, 1);
  seats.enter({7}, 2);
  EXPECT_FALSE(seats.free("bat-1"));
  EXPECT_EQ(seats.player_count(), 3u);
}

TEST(Seats, BearTheNamesOfBatsAndNoOthers) {
  const Seats seats(12);
  EXPECT_EQ(seats.named("bat-0"), 0u);
  EXPECT_EQ(seats.named("bat-11"), 11u);
  for (const char* other : {"", "bat", "bat-", "bat-12", "bat-01", "bat--1", "bat-1 ", "7", "cat-7",
                            "bat-4294967297", "bat-99999999999999999999"})
    EXPECT_EQ(seats.named(other), std::nullopt) << other;
}

TEST(Seats, NameTheFederateOfAPlayerUntilItLeaves) {
  Seats seats(2);
  seats.enter(first, 1);
  EXPECT_EQ(seats.federate_of(1), first);
  EXPECT_FALSE(seats.federate_of(0));
  ASSERT_NE(seats.find(first), nullptr);
  EXPECT_EQ(seats.find(first)->player, 1u);
  seats.leave(first, false);
  EXPECT_FALSE(seats.federate_of(1));
  EXPECT_EQ(seats.find(first), nullptr);
  EXPECT_EQ(seats.find({99}), nullptr);
}

TEST(Seats, KnowABatThatGoesWithItsPlayerUntilTheNextOneSitsDown) {
  Seats seats(2);
  seats.enter(first, 0);
  seats.enter(second, 1);
  seats.leave(first, true);
  seats.leave(second, false);
  EXPECT_TRUE(seats.is_leaving(0));
  EXPECT_FALSE(seats.is_leaving(1));
  seats.enter(first, 0);
  EXPECT_FALSE(seats.is_leaving(0));
}

TEST(Seats, AreOfferedUntilTheOfferCanBeMadeAndNoLonger) {
  Seats seats(2);
  seats.enter(first, 0);
  seats.enter(second, 1);
  std::vector<std::uint32_t> asked;
  const auto offer_to_all_but = [&](std::uint32_t waiting) {
    asked.clear();
    seats.offer([&](rti::FederateHandle, std::uint32_t player) {
      asked.push_back(player);
      return player != waiting;
    });
  };
  offer_to_all_but(0);
  EXPECT_EQ(asked, (std::vector<std::uint32_t>{1, 0})) << "in order of federates";
  ASSERT_EQ(seats.offered().size(), 1u);
  EXPECT_EQ(seats.offered()[0].federate, second);
  EXPECT_FALSE(seats.find(first)->is_offered);
  offer_to_all_but(9);
  EXPECT_EQ(asked, std::vector<std::uint32_t>{0});
  EXPECT_EQ(seats.offered()[0].federate, first);
  offer_to_all_but(9);
  EXPECT_TRUE(asked.empty());
  EXPECT_TRUE(seats.offered().empty());
}

TEST(Seats, CountEachPlayersTurnOnce) {
  Seats seats(2);
  EXPECT_FALSE(seats.are_all_turns_done()) << "nobody plays";
  seats.enter(first, 0);
  seats.enter(second, 1);
  seats.end_turn(first);
  seats.end_turn(first);
  EXPECT_FALSE(seats.are_all_turns_done());
  seats.end_turn(second);
  EXPECT_TRUE(seats.are_all_turns_done());
  seats.begin_turns();
  EXPECT_FALSE(seats.are_all_turns_done());
}

TEST(Seats, WaitForTheOthersWhereOneLeavesWhoseTurnIsDone) {
  Seats seats(2);
  seats.enter(first, 0);
  seats.enter(second, 1);
  seats.end_turn(first);
  seats.leave(first, true);
  EXPECT_FALSE(seats.are_all_turns_done());
  seats.end_turn(second);
  EXPECT_TRUE(seats.are_all_turns_done());
}

}  // namespace
}  // namespace rink::game
