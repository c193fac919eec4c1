// What is owed after losses, against a brute-force record of every datagram; and lists that many
// ledgers share.
#include "rti/buffering/datagram_ledger.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace rink::rti {
namespace {

SentRecord list_of(const std::map<std::uint32_t, std::uint32_t>& said) {
  SentRecord list;
  for (const auto& [handle, bits] : said) {
    list.begin_group(AttributeSet(bits));
    list.add(handle);
  }
  list.end_group();
  return list;
}

TEST(SentRecord, NamesWhatWasAddedInAboutAByteForEachNeighbour) {
  SentRecord list;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> wanted, is;
  for (const std::uint32_t bits : {1u, 6u}) {
    list.begin_group(AttributeSet(bits));
    for (std::uint32_t handle = 7; handle < 282; ++handle) {
      list.add(handle);
      wanted.emplace_back(handle, bits);
    }
  }
  list.end_group();
  for_each_sent(list.groups(),
                [&](std::uint32_t handle, AttributeSet set) { is.emplace_back(handle, set.bits); });
  EXPECT_EQ(is, wanted);
  EXPECT_LE(list.groups().size(), 2u * (275u + 2u))
      << "a fourth of what the handles themselves take";
}

TEST(DatagramLedger, OwesWhatNoLaterDatagramSaysAndLetsGoOfEveryList) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    SentRecordPool lists;
    {
      DatagramLedger ledger(lists);
      struct Sent {
        std::map<std::uint32_t, std::uint32_t> said;
        double at = 0.0;
        bool is_settled = false;
      };
      std::vector<Sent> sent(1);
      double now = 0.0;
      std::map<std::uint32_t, std::uint32_t> owed, wanted;
      // By the definition: of what a lost datagram said, what none after it says.
      const auto lose = [&](std::size_t number) {
        sent[number].is_settled = true;
        for (auto [handle, bits] : sent[number].said) {
          for (std::size_t later = number + 1; later < sent.size(); ++later)
            if (const auto found = sent[later].said.find(handle); found != sent[later].said.end())
              bits &= ~found->second;
          if (bits != 0) wanted[handle] |= bits;
        }
      };
      std::vector<DatagramLedger::Lost> lost;
      std::set<std::uint32_t> arrived;
      for (int step = 0; step < 300; ++step) {
        now += 0.005;
        if (random() % 3 != 0) {
          Sent next{.said = {}, .at = now, .is_settled = false};
          const auto count = static_cast<unsigned>(random() % 4);
          for (unsigned i = 0; i < count; ++i) {
            const auto handle = static_cast<std::uint32_t>(random() % 6);
            next.said[handle] |= static_cast<std::uint32_t>(1 + random() % 7);
          }
          const SentRecordPool::Number list =
              count == 0 ? SentRecordPool::none : lists.add(list_of(next.said).groups());
          EXPECT_EQ(ledger.note(now, list), sent.size());
          sent.push_back(next);
          if (random() % 10 < 7) arrived.insert(static_cast<std::uint32_t>(sent.size() - 1));
        } else if (!arrived.empty()) {
          AcknowledgeDatagramsMessage message{*arrived.rbegin(), 0};
          for (std::uint32_t age = 1; age <= 64 && age < message.newest; ++age)
            if (arrived.contains(message.newest - age))
              message.before |= std::uint64_t{1} << (age - 1);
          for (std::uint32_t number = 1; number <= message.newest; ++number) {
            if (sent[number].is_settled) continue;
            if (arrived.contains(number)) sent[number].is_settled = true;
            else if (message.newest - number >= 3) lose(number);
          }
          EXPECT_TRUE(ledger.acknowledge(message, now, lost));
        }
      }
      for (std::size_t number = 1; number < sent.size(); ++number)
        if (!sent[number].is_settled) lose(number);
      ledger.abandon(lost);
      for (const DatagramLedger::Lost& each : lost)
        owed[each.handle] |= static_cast<std::uint32_t>(each.attributes.bits);
      EXPECT_EQ(owed, wanted);
      EXPECT_EQ(ledger.unsettled(), 0u);
      EXPECT_FALSE(ledger.acknowledge({static_cast<std::uint32_t>(sent.size()), 0}, now, lost))
          << "of one that was never sent";
      EXPECT_EQ(lists.in_use(), 0u);
      ledger.note(now, lists.add(list_of({{1, 1}}).groups()));
      EXPECT_EQ(lists.in_use(), 1u);
    }
    EXPECT_EQ(lists.in_use(), 0u);
  }
}

TEST(SentRecordPool, AreSharedUntilTheLastHolderLetsGo) {
  SentRecordPool lists;
  const SentRecordPool::Number list = lists.add(list_of({{3, 1}, {4, 1}}).groups());
  std::vector<DatagramLedger::Lost> lost;
  {
    DatagramLedger one(lists), other(lists);
    for (DatagramLedger* each : {&one, &other}) {
      lists.hold(list);
      each->note(0.0, list);
    }
    lists.release(list);
    EXPECT_TRUE(one.acknowledge({1, 0}, 0.01, lost));
    EXPECT_TRUE(lost.empty());
    EXPECT_EQ(lists.in_use(), 1u) << "the other still needs it";
    other.expire(10.0, lost);
    EXPECT_EQ(lost.size(), 2u);
    EXPECT_EQ(lists.in_use(), 0u);
  }
}

}  // namespace
}  // namespace rink::rti
