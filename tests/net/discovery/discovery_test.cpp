// Hosts of matches and who looks for them, by this machine's loopback interface.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <random>
#include <string>

#include "game/net/discovery/match_announcer.h"
#include "game/net/discovery/match_search.h"
#include "rti/wire/membership_messages.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using namespace std::chrono_literals;

/// A port of this test, so that those at the same time do not hear each other.
rti::MulticastGroup own_group() {
  rti::MulticastGroup group = discovery_group();
  group.port = static_cast<std::uint16_t>(
      20'000 + std::hash<std::string>{}(test::unique_name("group")) % 10'000);
  return group;
}

std::function<std::uint64_t()> drawing() {
  return [random = std::mt19937_64(7)]() mutable { return random(); };
}

rti::Bytes whole(const DiscoveryBytes& bytes) { return bytes; }

class Neighbourhood : public ::testing::Test {
 protected:
  /// All answer and listen until `is_done`, or for a second of virtual time.
  bool talk(const std::function<bool()>& is_done) {
    for (int step = 0; step < 100; ++step) {
      search_.search(now_s_);
      for (MatchAnnouncer* host : hosts_) host->socket().wait(2ms), host->attend(now_s_ += 0.005);
      search_.search(now_s_ += 0.005);
      if (is_done()) return true;
    }
    return false;
  }

  rti::MulticastGroup group_ = own_group();
  MatchSearch search_{group_, drawing()};
  std::vector<MatchAnnouncer*> hosts_;
  double now_s_ = 100.0;
};

TEST_F(Neighbourhood, ListsTwoHostsOfOneNameApartWithTheirPlacesAndPings) {
  MatchAnnouncer one({.name = "Kitchen", .host = 1, .port = 4711}, group_, now_s_),
      other({.name = "Kitchen", .host = 2, .port = 4720}, group_, now_s_),
      attic({.name = "Attic", .host = 3, .port = 5000}, group_, now_s_);
  hosts_ = {&one, &other, &attic};
  ASSERT_TRUE(one.is_open());
  ASSERT_TRUE(talk([&] { return search_.found().size() == 3; }));
  EXPECT_EQ(search_.found()[0].name, "Attic");
  EXPECT_TRUE(search_.found()[0].place.ends_with(":5000")) << search_.found()[0].place;
  EXPECT_TRUE(search_.found()[1].place.ends_with(":4711"));
  EXPECT_TRUE(search_.found()[2].place.ends_with(":4720"));
  for (const FoundMatch& each : search_.found()) {
    EXPECT_GT(each.ping_s, 0.0);
    EXPECT_LT(each.ping_s, 1.0);
    EXPECT_TRUE(each.is_same_version);
  }
}

TEST_F(Neighbourhood, ForgetsAHostThatFellSilent) {
  MatchAnnouncer host({.name = "Kitchen", .host = 1, .port = 4711}, group_, now_s_);
  hosts_ = {&host};
  ASSERT_TRUE(talk([&] { return search_.found().size() == 1; }));
  now_s_ += MatchSearch::forgets_after_s + 0.1;
  hosts_.clear();
  search_.search(now_s_);
  EXPECT_TRUE(search_.found().empty());
}

TEST_F(Neighbourhood, AnswersFewTimesASecondAndNeverAtLength) {
  MatchAnnouncer host({.name = "Kitchen", .host = 1, .port = 4711}, group_, now_s_);
  rti::MulticastSocket flood(group_, rti::MulticastSocket::Role::asks);
  const int ways = flood.send_to_group(encoded(DiscoveryQuery{1}));
  ASSERT_GT(ways, 0);
  for (std::uint64_t k = 2; k <= 200; ++k) flood.send_to_group(encoded(DiscoveryQuery{k}));
  for (int round = 0; round < 20; ++round) host.socket().wait(1ms), host.attend(now_s_);
  EXPECT_EQ(host.counters().answered, static_cast<std::uint64_t>(MatchAnnouncer::answers_per_s));
  EXPECT_GT(host.counters().over_limit, 0u);
  std::array<std::byte, 2 * discovery_size> room{};
  std::size_t answers = 0;
  while (const auto answer = flood.receive(room)) {
    EXPECT_EQ(answer->size, discovery_size);
    ++answers;
  }
  EXPECT_LE(answers, host.counters().answered);
  EXPECT_GT(answers, 0u);
}

TEST_F(Neighbourhood, RefusesAndCountsWhatIsNoQuery) {
  MatchAnnouncer host({.name = "Kitchen", .host = 1, .port = 4711}, group_, now_s_);
  rti::MulticastSocket stranger(group_, rti::MulticastSocket::Role::asks);
  const std::vector<std::byte> empty, huge(1200, std::byte{'R'});
  std::uint64_t sent = 0;
  for (const rti::Bytes& bytes : {rti::Bytes(empty), rti::Bytes(huge)})
    sent += static_cast<std::uint64_t>(stranger.send_to_group(bytes));
  DiscoveryBytes long_tail = encoded(DiscoveryQuery{5});
  long_tail.back() = std::byte{1};
  sent += static_cast<std::uint64_t>(stranger.send_to_group(long_tail));
  ASSERT_GT(sent, 0u);
  for (int round = 0; round < 20; ++round) host.socket().wait(1ms), host.attend(now_s_);
  EXPECT_GE(host.counters().refused, 3u);
  EXPECT_EQ(host.counters().answered, 0u);
}

/// A stranger who heard the query can answer with another number only by guessing.
TEST_F(Neighbourhood, TakesNoAnswerThatItDidNotAskFor) {
  rti::MulticastSocket stranger(group_, rti::MulticastSocket::Role::listens);
  search_.search(now_s_);
  stranger.wait(100ms);
  std::array<std::byte, discovery_size> room{};
  const auto query = stranger.receive(room);
  ASSERT_TRUE(query);
  const std::uint64_t number = query_of(room)->number;
  for (const std::uint64_t answered : {number + 1, number}) {
    stranger.send_to(query->from,
                     encoded(DiscoveryAnswer{
                         .number = answered, .host = 1, .port = 1, .protocol = 1, .name = "Trap"}));
    for (int round = 0; round < 20 && search_.counters().answers + search_.counters().refused == 0;
         ++round) {
      stranger.wait(1ms);
      search_.search(now_s_);
    }
    if (answered == number + 1) {
      EXPECT_EQ(search_.counters().refused, 1u);
      EXPECT_TRUE(search_.found().empty());
    }
  }
  search_.search(now_s_ += 0.01);
  ASSERT_EQ(search_.found().size(), 1u);
  EXPECT_FALSE(search_.found()[0].is_same_version);
}

TEST_F(Neighbourhood, HearsOfAHostOfThisMachineAloneByItsLoopback) {
  MatchAnnouncer host({.name = "Desk", .host = 1, .port = 4711, .is_local_only = true}, group_,
                      now_s_);
  hosts_ = {&host};
  ASSERT_TRUE(talk([&] { return search_.found().size() == 1; }));
  EXPECT_TRUE(search_.found()[0].place == "127.0.0.1:4711" ||
              search_.found()[0].place == "[::1]:4711")
      << search_.found()[0].place;
}

TEST(ADiscoveryMessage, IsReadAsItWasWrittenAndIsOfOneSize) {
  const DiscoveryBytes query = encoded(DiscoveryQuery{0x0123456789abcdefu});
  EXPECT_EQ(query_of(query)->number, 0x0123456789abcdefu);
  EXPECT_FALSE(answer_of(query));
  const DiscoveryAnswer answer{.number = ~0ull,
                               .host = 77,
                               .port = 65535,
                               .protocol = rti::protocol_version,
                               .name = std::string(match_name_size_max, 'x')};
  const DiscoveryBytes bytes = encoded(answer);
  EXPECT_EQ(bytes.size(), query.size()) << "nothing is amplified";
  const auto read = answer_of(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->number, answer.number);
  EXPECT_EQ(read->host, 77u);
  EXPECT_EQ(read->port, 65535u);
  EXPECT_EQ(read->name, answer.name);
  EXPECT_FALSE(query_of(bytes));
}

/// Each byte altered by each bit: what is read must be written so.
TEST(ADiscoveryMessage, IsRefusedIfItIsMalformed) {
  const DiscoveryBytes answer =
      encoded(DiscoveryAnswer{.number = 1, .host = 2, .port = 3, .protocol = 4, .name = "Kitchen"});
  for (std::size_t at = 0; at < answer.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      DiscoveryBytes altered = answer;
      altered[at] ^= static_cast<std::byte>(1 << bit);
      const auto read = answer_of(altered);
      if (read) {
        EXPECT_EQ(encoded(*read), altered) << at;
      }
      EXPECT_FALSE(read && at < 5) << "mark or version";
      EXPECT_FALSE(query_of(altered));
    }
  EXPECT_FALSE(answer_of(whole(answer).first(discovery_size - 1)));
  std::vector<std::byte> longer(answer.begin(), answer.end());
  longer.push_back(std::byte{0});
  EXPECT_FALSE(answer_of(longer));
}

TEST(AMatchName, IsCutAtACharactersEndAndHasNoControlCharacters) {
  EXPECT_EQ(match_name("Kit\nchen\x7f\t"), "Kitchen");
  EXPECT_EQ(match_name(std::string(40, 'a')), std::string(32, 'a'));
  EXPECT_EQ(match_name(std::string(31, 'a') + "\xc3\xa4"), std::string(31, 'a'));
  EXPECT_EQ(match_name(""), "");
}

}  // namespace
}  // namespace rink::game
