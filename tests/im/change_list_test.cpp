// The order in which changes come out, however many there are and whoever they are about.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "im/matching/change_list.h"

namespace rink::im {
namespace {

/// `count` pairs of subscribers below `subscriber_count` with entities from `first_entity` on, half
/// found by either; every tenth is found by both, having entered and left.
void order(std::uint64_t seed, std::size_t count, std::uint32_t subscriber_count,
           std::uint32_t first_entity, std::uint32_t entity_count) {
  SCOPED_TRACE(std::to_string(count) + " changes of " + std::to_string(subscriber_count) +
               " subscribers, seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::map<std::pair<Subscriber, Entity>, Transition> expected;
  std::set<std::pair<Subscriber, Entity>> drawn;
  std::vector<std::uint64_t> by_subscriber, by_entity;
  for (std::size_t i = 0; i < count; ++i) {
    const auto subscriber = static_cast<std::uint32_t>(random() % subscriber_count),
               entity = static_cast<std::uint32_t>(first_entity + random() % entity_count);
    if (!drawn.insert({subscriber, entity}).second) continue;
    const bool is_entered = random() % 2 == 0, undoes = random() % 10 == 0;
    const auto found = [&](std::uint32_t asker, std::uint32_t who, bool entered) {
      return std::uint64_t{asker} << 32 | who | (entered ? entered_bit : 0u);
    };
    if (undoes || i % 2 == 0) by_subscriber.push_back(found(subscriber, entity, is_entered));
    if (undoes || i % 2 == 1) by_entity.push_back(found(entity, subscriber, undoes != is_entered));
    if (!undoes)
      expected[{subscriber, entity}] = is_entered ? Transition::entered : Transition::left;
  }
  std::shuffle(by_subscriber.begin(), by_subscriber.end(), random),
      std::shuffle(by_entity.begin(), by_entity.end(), random);
  ChangeList list;
  list.add_by_entity(by_entity);
  list.add_by_subscriber(by_subscriber);
  std::vector<Change> wanted;
  for (const auto& [pair, transition] : expected)
    wanted.push_back({pair.first, pair.second, transition});
  const std::span<const Change> changes = list.ordered(subscriber_count);
  ASSERT_TRUE(std::equal(changes.begin(), changes.end(), wanted.begin(), wanted.end()));
  list.check();
}

TEST(ChangeList, OrdersByDigitsBySubscribersAndByComparing) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const std::size_t count : {3u, 60u, 70u, 500u, 5'000u, 40'000u})
      for (const std::uint32_t subscribers : {1u, 30u, 4'000u, 100'000u})
        order(seed, count, subscribers, 0, 100'000);
}
TEST(ChangeList, OrdersTheLargestIds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    order(seed, 5'000, 50'000, RegionHistory::id_max - 3'000, 3'000);
    order(seed, 5'000, RegionHistory::id_max, RegionHistory::id_max - 3'000, 3'000);
  }
}

}  // namespace
}  // namespace rink::im
