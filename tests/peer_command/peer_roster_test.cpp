// Who takes part in a session, who waited too long, and what a loss means: no connection is needed.
#include "game/net/peer/network/peer_roster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "game/net/peer/network/leaving_time.h"
#include "game/net/peer/network/patience.h"
#include "game/net/peer/network/peer_losses.h"

namespace rink::game {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::uint64_t session = 77;

PeerInfo info(std::uint16_t port, std::uint32_t bats, std::uint64_t token = 0) {
  return {.place = {"127.0.0.1", port}, .bat_count = bats, .token = token};
}

Terms terms_of(std::uint32_t peers) { return {.peer_count = peers, .until = 10.0, .window = 0.1}; }

PeerRoster first_peer(std::uint32_t peers) {
  PeerRoster roster(info(1, 2), 7, {}, session);
  roster.found(terms_of(peers));
  return roster;
}

/// As peer `number` of three, before the game.
PeerRoster entered(std::uint32_t number) {
  PeerRoster roster(info(9, 1), 7, {}, 0);
  Welcome welcome{.session = session, .terms = terms_of(3), .number = number, .others = {}};
  for (std::uint32_t k = 0; k < number; ++k)
    welcome.others.push_back({k, true, info(static_cast<std::uint16_t>(k + 1), 1)});
  roster.enter(welcome);
  return roster;
}

std::string refusal(std::variant<Welcome, Refused> answer) {
  return std::holds_alternative<Refused>(answer) ? std::get<Refused>(answer).reason : "";
}

TEST(PeerRoster, GivesNewcomersNumbersAndBatsInTheOrderOfTheirComing) {
  PeerRoster roster = first_peer(3);
  const Welcome second = std::get<Welcome>(roster.seat(info(2, 4)));
  EXPECT_EQ(second.number, 1u);
  EXPECT_EQ(second.first_bat, 2u);
  EXPECT_EQ(second.others.size(), 1u);
  const Welcome third = std::get<Welcome>(roster.seat(info(3, 1)));
  EXPECT_EQ(third.number, 2u);
  EXPECT_EQ(third.first_bat, 6u);
  ASSERT_EQ(third.others.size(), 2u);
  EXPECT_EQ(third.others[1].info.first_bat, 2u);
  EXPECT_EQ(roster.infos()[2].place.port, 3);
}

TEST(PeerRoster, RefusesWhoIsNotReachedWhoComesTooLateAndWhoWantsTooManyBats) {
  PeerRoster roster = first_peer(2);
  EXPECT_THAT(refusal(roster.seat(info(0, 1))), HasSubstr("where others reach it"));
  EXPECT_THAT(refusal(roster.seat(info(2, 6))), HasSubstr("6 bats, of 7 here 5 are free"));
  EXPECT_EQ(refusal(roster.seat(info(2, 5))), "");
  EXPECT_THAT(refusal(roster.seat(info(3, 0))), HasSubstr("all 2 peers"));
}

TEST(PeerRoster, KnowsWhoMayIntroduceItself) {
  using Standing = PeerRoster::Standing;
  const PeerRoster outside(info(9, 1), 7, {}, session);
  EXPECT_EQ(outside.standing_of({session, 1, info(2, 1)}), Standing::early);
  PeerRoster roster = entered(1);
  EXPECT_EQ(roster.standing_of({session, 2, info(2, 1)}), Standing::due);
  EXPECT_EQ(roster.standing_of({session + 1, 2, info(2, 1)}), Standing::unknown);
  EXPECT_EQ(roster.standing_of({session, 2, info(0, 1)}), Standing::unknown);
  EXPECT_EQ(roster.standing_of({session, 1, info(2, 1)}), Standing::unknown);
  EXPECT_EQ(roster.standing_of({session, 3, info(2, 1)}), Standing::unknown);
  roster.begin();
  EXPECT_EQ(roster.standing_of({session, 5, info(2, 1, 42)}), Standing::early);
  EXPECT_EQ(roster.standing_of({session, peer::numbers_max, info(2, 1)}), Standing::unknown);
  roster.expect(5, info(2, 1, 42));
  EXPECT_EQ(roster.standing_of({session, 5, info(2, 1, 42)}), Standing::expected);
  EXPECT_EQ(roster.standing_of({session, 5, info(2, 1, 43)}), Standing::early);
  roster.expect_no_more(5);
  EXPECT_EQ(roster.standing_of({session, 5, info(2, 1, 42)}), Standing::early);
}

TEST(PeerRoster, NamesMembersAndEarlierCandidatesToACandidateByNumber) {
  const PeerRoster roster = entered(2);
  const auto candidate = [](peer::PeerNumber number) {
    return peer::Candidate{
        .number = number, .first_bat = 3, .newcomer = {.place = bytes_of(Place{"::1", 8})}};
  };
  peer::State state{.cuts = peer::Cuts::whole({})};
  state.members = {0, 2};
  state.candidates = {candidate(1), candidate(4), candidate(5)};
  const Welcome welcome = roster.welcome_of(candidate(4), state);
  EXPECT_TRUE(welcome.is_playing);
  EXPECT_EQ(welcome.sponsor, 2u);
  std::vector<std::uint32_t> numbers;
  for (const Introduced& one : welcome.others) numbers.push_back(one.number);
  EXPECT_THAT(numbers, ElementsAre(0u, 1u, 2u));
  EXPECT_FALSE(welcome.others[1].is_member);
  EXPECT_EQ(welcome.others[1].info.place.text(), "[::1]:8");
}

TEST(Patience, EndsWithSilenceButNotForWhoWasItselfStopped) {
  Patience patience(10.0, 5.0, 0.0);
  for (const double now : {4.0, 8.0, 10.0}) patience.look(now);
  EXPECT_FALSE(patience.is_over());
  patience.look(10.1);
  EXPECT_TRUE(patience.is_over());
  EXPECT_FALSE(patience.is_over(1.0));
  patience.look(20.0);  // stopped for longer than a gap may last: the wait begins anew
  EXPECT_FALSE(patience.is_over());
  EXPECT_FALSE(patience.is_over(1.0));
  for (const double now : {25.0, 30.0, 30.1}) patience.look(now);
  EXPECT_TRUE(patience.is_over(1.0));
}

TEST(LeavingTime, IsThreeSecondsAndThreeOfTheLongestWindows) {
  LeavingTime early;
  early.interrupt(1.0);
  EXPECT_FALSE(early.is_left(1.0, 0.1));  // there is nothing to hand over yet
  LeavingTime leaving;
  for (const double now : {0.0, 2.0, 3.0}) leaving.note_window(now);
  leaving.interrupt(4.0);
  leaving.interrupt(8.0);
  EXPECT_TRUE(leaving.is_left(13.0, 0.1));
  EXPECT_FALSE(leaving.is_left(13.01, 0.1));
  EXPECT_TRUE(leaving.is_left(19.0, 4.0));
}

TEST(PeerLosses, EndTheSessionUntilPartsAreReplicated) {
  PeerLink link;
  PeerLosses losses;
  losses.check();
  losses.lose(link, ExitStatus::connection_lost, "gone");
  losses.fail(ExitStatus::failed, "and more");
  EXPECT_EQ(link.loss, "");
  try {
    losses.check();
    FAIL() << "a loss before the game ends the session";
  } catch (const SessionError& error) {
    EXPECT_EQ(error.status(), ExitStatus::connection_lost);
    EXPECT_STREQ(error.what(), "gone");
  }
  PeerLosses survived;
  survived.begin(true);
  survived.lose(link, ExitStatus::connection_lost, "gone");
  survived.lose(link, ExitStatus::connection_lost, "gone again");
  EXPECT_EQ(link.loss, "gone");
  survived.check();
}

}  // namespace
}  // namespace rink::game
