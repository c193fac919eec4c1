// A node that hosts matches tells the others what cannot be of a lost one: they name it and play
// on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/node/hosting_nodes.h"

namespace rink::game::lost_hosts {
namespace {

struct Lie {
  std::string name;
  std::function<void(LastWords&)> tell;
};

/// Of each field of LastWords, in each way that another node can check.
std::vector<Lie> lies() {
  constexpr peer::PeerNumber lost = 1;
  const auto last_round = [](std::uint64_t ahead) {
    return [ahead](LastWords& words) {
      words.last_rounds = {{.node = lost, .round = words.round + ahead}};
    };
  };
  return {{"a round far ahead", [](LastWords& words) { words.round += 3; }},
          {"a round far behind", [](LastWords& words) { words.round -= 3; }},
          {"a word of a node that is there",
           [](LastWords& words) { words.words.push_back({.node = 0, .round = words.round}); }},
          {"a word that is no round",
           [](LastWords& words) {
             words.words = {{.node = lost, .round = words.round, .bytes = {1}}};
           }},
          {"a word of long ago",
           [](LastWords& words) {
             words.words = {{.node = lost, .round = words.round - 2, .bytes = {0x80}}};
           }},
          {"the last round of a node that is there",
           [](LastWords& words) { words.last_rounds = {{.node = 0, .round = words.round}}; }},
          {"a last round that is over", last_round(std::uint64_t(-2))},
          {"a last round of which it has no word",
           [](LastWords& words) {
             words.words.clear();
             words.last_rounds = {{.node = lost, .round = words.round + 2}};
           }},
          {"a last round that is still to come", last_round(3)},
          {"a last round of any time", last_round(std::uint64_t(1) << 40)},
          {"words of the referee that nobody has said",
           [](LastWords& words) { words.referee.count += 1u << 20; }},
          {"news that come after all words",
           [](LastWords& words) { words.referee.news.number = words.referee.count + 1; }},
          {"a decision that comes after all words", [](LastWords& words) {
             words.referee.decisions.push_back({.number = words.referee.count + 1});
           }}};
}

TEST_F(LostHosts, NameWhoTellsOfThemWhatCannotBe) {
  for (const Lie& lie : lies()) {
    SCOPED_TRACE(lie.name);
    host(4, "100");
    at(3).mortality.lie = lie.tell;
    seat_both(0, 2);
    ASSERT_TRUE(play_to(MatchPhase::playing));
    ASSERT_TRUE(play_for(0.2));
    at(1).mortality.is_due = true;
    const auto names_liar = [](HostNode& node) {
      return std::ranges::any_of(node.news(), [](const std::string& news) {
        return news.find("peer 3 ") != std::string::npos;
      });
    };
    ASSERT_TRUE(play([&] {
      return names_liar(at(0)) && names_liar(at(2)) && !at(3).failure.empty();
    })) << testing::PrintToString(at(0).news())
        << testing::PrintToString(at(2).news());
    ASSERT_TRUE(play_for(0.3)) << at(0).failure << at(2).failure;
    EXPECT_EQ(expect_one_game(), 2u);
  }
}

}  // namespace
}  // namespace rink::game::lost_hosts
