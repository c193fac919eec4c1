// The tournament and the queue of time management against lists, over random steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "im/basics/seeded_stream.h"
#include "rti/time/least_tree.h"
#include "rti/time/time_queue.h"

namespace rink::rti {
namespace {

TEST(LeastTree, HoldsTheLeastOfAListThatChanges) {
  SeededStream random(3);
  LeastTree tree;
  std::vector<double> list(40, LeastTree::none);
  for (int step = 0; step < 2'000; ++step) {
    const std::uint32_t index = random.below(static_cast<std::uint32_t>(list.size()));
    list[index] = random.below(3) == 0 ? LeastTree::none : random.below(20);
    tree.set(index, list[index]);
    tree.check();
    const auto least = std::min_element(list.begin(), list.end());
    ASSERT_EQ(tree.least(), *least);
    if (*least != LeastTree::none) {
      ASSERT_EQ(tree.where(), static_cast<std::size_t>(least - list.begin()));
    }
  }
}

TEST(TimeQueue, GivesWhatWaitsInOrderAndNothingThatWasWithdrawn) {
  SeededStream random(4);
  TimeQueue queue;
  std::vector<TimedEntry> waiting;
  for (std::uint64_t number = 0; number < 2'000; ++number) {
    if (const std::uint32_t step = random.below(4); step < 2 || waiting.empty()) {
      const TimedEntry entry{static_cast<double>(random.below(50)), random.below(3), number, 0, 0};
      queue.push(entry);
      waiting.insert(std::ranges::upper_bound(waiting, entry), entry);
    } else if (step == 2) {
      ASSERT_EQ(queue.pop(), waiting.front());
      waiting.erase(waiting.begin());
    } else {
      const auto place =
          waiting.begin() +
          static_cast<std::ptrdiff_t>(random.below(static_cast<std::uint32_t>(waiting.size())));
      queue.withdraw(*place);
      waiting.erase(place);
    }
    queue.check();
    ASSERT_EQ(queue.next_time(), waiting.empty() ? time_unbounded : waiting.front().time);
  }
}

}  // namespace
}  // namespace rink::rti
